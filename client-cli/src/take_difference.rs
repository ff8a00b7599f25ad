//! Where the curves of two takes differ: frame by frame, muscle by muscle.
//!
//! Samples are matched by their frame, which a take that was solved again keeps, and muscles by their name. Both takes are
//! read once, from their first message to their last, and nothing is kept but sums and a [`Timeline`].

pub mod timeline;

use std::cmp::Ordering;

use prost::Message as _;

use self::timeline::Timeline;
use crate::{
    proto::{CurveSample, Timecode},
    recorded_take::{RecordedMessage, RecordedTake, RecordedTakeError},
};

/// What is known of two takes' curves side by side.
#[derive(Clone, Debug)]
pub struct TakeDifference {
    /// Frames that gave a sample in both.
    pub n_frames: u64,
    /// Those of them whose samples agree bit for bit, in everything but their sequence and the server's times.
    pub n_same: u64,
    /// Frames with a sample in the first take only.
    pub n_only_first: u64,
    /// Frames with a sample in the second take only.
    pub n_only_second: u64,
    /// Muscles of both, in the order of the first.
    pub controls: Vec<ControlDifference>,
    /// Muscles of the first take only.
    pub only_first: Vec<String>,
    /// Muscles of the second take only.
    pub only_second: Vec<String>,
    /// The curves of [`Self::controls`], over time.
    pub timeline: Timeline,
}

/// Where one muscle's activations differ.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlDifference {
    /// The muscle.
    pub name: String,
    /// Frames in which they are not the same bits.
    pub n_differing: u64,
    /// Where they are furthest apart; `None` while they are the same.
    pub largest: Option<Largest>,
    sum: f64,
    sum_of_squares: f64,
    n_frames: u64,
}

/// The frame in which two curves are furthest apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Largest {
    /// The frame.
    pub frame: u64,
    /// Its timecode, if it has one.
    pub timecode: Option<Timecode>,
    /// Activation of the first take.
    pub first: f32,
    /// Activation of the second take.
    pub second: f32,
}

impl Largest {
    /// By how much they differ.
    pub fn distance(&self) -> f64 {
        (f64::from(self.second) - f64::from(self.first)).abs()
    }
}

impl ControlDifference {
    fn new(name: String) -> Self {
        Self {
            name,
            n_differing: 0,
            largest: None,
            sum: 0.0,
            sum_of_squares: 0.0,
            n_frames: 0,
        }
    }

    /// The largest difference; 0 while they are the same.
    pub fn max(&self) -> f64 {
        self.largest.as_ref().map_or(0.0, Largest::distance)
    }

    /// Root mean square of the differences over all common frames.
    pub fn rms(&self) -> f64 {
        (self.sum_of_squares / self.n_frames.max(1) as f64).sqrt()
    }

    /// Mean of second minus first over all common frames.
    pub fn mean(&self) -> f64 {
        self.sum / self.n_frames.max(1) as f64
    }

    fn add(&mut self, [first, second]: [f32; 2], sample: &CurveSample) {
        self.n_frames += 1;
        if first.to_bits() == second.to_bits() {
            return;
        }
        let difference = f64::from(second) - f64::from(first);
        self.n_differing += 1;
        self.sum += difference;
        self.sum_of_squares += difference * difference;
        let is_further = |it: &Largest| difference.abs().total_cmp(&it.distance()).is_gt();
        if self.largest.as_ref().is_none_or(is_further) {
            self.largest = Some(Largest {
                frame: sample.frame,
                timecode: sample.timecode,
                first,
                second,
            });
        }
    }
}

impl TakeDifference {
    /// Reads two takes behind their headers, which name their `controls`. `progress` hears how many frames were compared.
    ///
    /// # Errors
    ///
    /// When one of them cannot be read on.
    pub async fn of(
        [first, second]: [&mut RecordedTake; 2],
        controls: [&[String]; 2],
        mut progress: impl FnMut(u64),
    ) -> Result<Self, RecordedTakeError> {
        let matching = Matching::by_name(controls);
        let mut it = Self::nothing(controls, &matching);
        let (mut one, mut other) = (next_sample(first).await?, next_sample(second).await?);
        loop {
            let order = match (&one, &other) {
                (None, None) => return Ok(it),
                (Some(_), None) => Ordering::Less,
                (None, Some(_)) => Ordering::Greater,
                (Some(one), Some(other)) => one.frame.cmp(&other.frame),
            };
            match order {
                Ordering::Less => it.n_only_first += 1,
                Ordering::Greater => it.n_only_second += 1,
                Ordering::Equal => {
                    if let (Some(one), Some(other)) = (&mut one, &mut other) {
                        it.compare(one, other, &matching);
                        progress(it.n_frames);
                    }
                }
            }
            if order.is_le() {
                one = next_sample(first).await?;
            }
            if order.is_ge() {
                other = next_sample(second).await?;
            }
        }
    }

    fn nothing(controls: [&[String]; 2], matching: &Matching) -> Self {
        let [first, second] = controls;
        let without = |names: &[String], others: &[String]| -> Vec<String> {
            let only = names.iter().filter(|it| !others.contains(it));
            only.cloned().collect()
        };
        let common = matching.0.iter().map(|it| first[it[0]].clone());
        Self {
            n_frames: 0,
            n_same: 0,
            n_only_first: 0,
            n_only_second: 0,
            controls: common.map(ControlDifference::new).collect(),
            only_first: without(first, second),
            only_second: without(second, first),
            timeline: Timeline::default(),
        }
    }

    fn compare(&mut self, one: &mut CurveSample, other: &mut CurveSample, matching: &Matching) {
        self.n_frames += 1;
        let pairs: Vec<_> = matching.pairs(one, other).collect();
        self.timeline.add(one.frame, &pairs);
        for (control, pair) in self.controls.iter_mut().zip(&pairs) {
            control.add(*pair, one);
        }
        self.n_same += u64::from(is_same(one, other));
    }

    /// Whether both takes hold the same curves, bit for bit.
    pub fn is_nothing(&self) -> bool {
        self.n_only_first == 0
            && self.n_only_second == 0
            && self.only_first.is_empty()
            && self.only_second.is_empty()
            && self.n_same == self.n_frames
    }

    /// The largest difference of any muscle.
    pub fn max(&self) -> f64 {
        self.controls
            .iter()
            .map(ControlDifference::max)
            .fold(0.0, f64::max)
    }
}

/// Indices of the muscles that both takes have.
struct Matching(Vec<[usize; 2]>);

impl Matching {
    fn by_name([first, second]: [&[String]; 2]) -> Self {
        let place = |name: &String| second.iter().position(|it| it == name);
        let pairs = first.iter().enumerate();
        Self(pairs.filter_map(|(k, it)| Some([k, place(it)?])).collect())
    }

    fn pairs<'a>(
        &'a self,
        one: &'a CurveSample,
        other: &'a CurveSample,
    ) -> impl Iterator<Item = [f32; 2]> + 'a {
        let value = |of: &CurveSample, index: usize| of.activations.get(index).copied();
        // A sample without its activations is none of ours; NaN makes it stand out.
        self.0
            .iter()
            .map(move |[k, l]| [value(one, *k), value(other, *l)].map(|it| it.unwrap_or(f32::NAN)))
    }
}

/// Whether two samples are one but for their sequence and the server's times.
fn is_same(one: &mut CurveSample, other: &mut CurveSample) -> bool {
    for it in [&mut *one, &mut *other] {
        it.sequence = 0;
        it.solved_time_nanos = 0;
        it.capture_time_server_nanos = 0;
    }
    one.encode_to_vec() == other.encode_to_vec()
}

async fn next_sample(take: &mut RecordedTake) -> Result<Option<CurveSample>, RecordedTakeError> {
    while let Some(message) = take.next().await? {
        if let RecordedMessage::Sample(sample) = message {
            return Ok(Some(*sample));
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests;
