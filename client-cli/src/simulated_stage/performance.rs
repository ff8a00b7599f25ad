//! A random performance: smooth, overlapping muscle events after a neutral second, and blinks.
//!
//! An event rises and falls as a raised cosine with a plateau of 0.3 of its length.
//! Muscles with a left and a right half mostly contract together, the two a little apart; eyelids only blink.
//! Only events that are still going on are kept, so that a performance of any length takes the same memory.

use std::f64::consts::PI;

use frontalis_analysis::face::muscle::MuscleSet;
use rand::RngExt as _;
use rand_pcg::Pcg64;

use super::NEUTRAL_SECS;

/// Mean events a second for each muscle or pair of muscles.
const EVENTS_PER_SEC: f64 = 1.4 / 9.0;
/// How likely both halves of a pair contract, and not one alone.
const BOTH_SIDES: f64 = 0.75;
/// How much less than the other a half may contract.
const ASYMMETRY: f64 = 0.2;
const BLINK_SECS: f64 = 0.22;
/// The part of an event in which it holds its height.
const PLATEAU: f64 = 0.3;

/// Muscles that contract at will as one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unit {
    Pair { left: usize, right: usize },
    Single(usize),
}

/// One contraction of one muscle.
#[derive(Clone, Copy, Debug)]
struct Event {
    muscle_idx: usize,
    start_secs: f64,
    length_secs: f64,
    height: f64,
}

/// What the face does, asked for at times that do not decrease.
pub(super) struct Performance {
    n_muscles: usize,
    units: Vec<Unit>,
    eyelids: Vec<usize>,
    generator: Pcg64,
    next_event_secs: f64,
    next_blink_secs: f64,
    going_on: Vec<Event>,
}

impl Performance {
    pub(super) fn new(muscles: &MuscleSet, generator: Pcg64) -> Self {
        let mut performance = Self {
            n_muscles: muscles.len(),
            units: units(muscles),
            eyelids: (0..muscles.len())
                .filter(|&it| is_eyelid(&muscles.muscles()[it].name))
                .collect(),
            generator,
            next_event_secs: NEUTRAL_SECS,
            next_blink_secs: NEUTRAL_SECS,
            going_on: Vec::new(),
        };
        performance.next_event_secs += performance.pause_secs();
        performance.next_blink_secs += performance.generator.random_range(0.0..1.5);
        performance
    }

    /// One contraction in [0, 1] a muscle.
    pub(super) fn activations_at(&mut self, time_secs: f64) -> Vec<f64> {
        self.begin_events_until(time_secs);
        self.going_on
            .retain(|event| time_secs < event.start_secs + event.length_secs);
        // What is left relaxed: the product stays smooth and in [0, 1] where events of one muscle overlap.
        let mut relaxed = vec![1.0; self.n_muscles];
        for event in &self.going_on {
            relaxed[event.muscle_idx] *= 1.0 - event.contraction_at(time_secs);
        }
        relaxed.iter().map(|it| 1.0 - it).collect()
    }

    fn begin_events_until(&mut self, time_secs: f64) {
        while !self.units.is_empty() && self.next_event_secs <= time_secs {
            self.begin_event();
            self.next_event_secs += self.pause_secs();
        }
        while !self.eyelids.is_empty() && self.next_blink_secs <= time_secs {
            for &eyelid in &self.eyelids {
                self.going_on.push(Event {
                    muscle_idx: eyelid,
                    start_secs: self.next_blink_secs,
                    length_secs: BLINK_SECS,
                    height: 1.0,
                });
            }
            self.next_blink_secs += self.generator.random_range(1.5..5.0);
        }
    }

    fn begin_event(&mut self) {
        let unit = self.units[self.generator.random_range(0..self.units.len())];
        let length_secs = self.generator.random_range(0.5..2.2);
        let height = self.generator.random_range(0.25..1.0);
        let start_secs = self.next_event_secs;
        let mut begin = |muscle_idx, height| {
            self.going_on.push(Event {
                muscle_idx,
                start_secs,
                length_secs,
                height,
            });
        };
        match unit {
            Unit::Single(muscle) => begin(muscle, height),
            Unit::Pair { left, right } if self.generator.random_bool(BOTH_SIDES) => {
                for side in [left, right] {
                    let share = self.generator.random_range(1.0 - ASYMMETRY..1.0);
                    begin(side, height * share);
                }
            }
            Unit::Pair { left, right } => {
                let side = if self.generator.random() { left } else { right };
                begin(side, height);
            }
        }
    }

    /// Until the next event begins: exponentially distributed, as of events that know nothing of each other.
    fn pause_secs(&mut self) -> f64 {
        let mean_secs = 1.0 / (EVENTS_PER_SEC * self.units.len().max(1) as f64);
        let uniform: f64 = self.generator.random();
        -mean_secs * (1.0 - uniform).ln()
    }
}

impl Event {
    fn contraction_at(&self, time_secs: f64) -> f64 {
        let u = (time_secs - self.start_secs) / self.length_secs;
        let ramp = (1.0 - PLATEAU) / 2.0;
        let risen = (u.min(1.0 - u) / ramp).clamp(0.0, 1.0);
        self.height * (0.5 - 0.5 * (PI * risen).cos())
    }
}

/// Every muscle once, pairs joined; eyelids are left out, and so are shapes without motion of their own.
fn units(muscles: &MuscleSet) -> Vec<Unit> {
    let mut units = Vec::new();
    for (muscle_idx, muscle) in muscles.muscles().iter().enumerate() {
        if is_eyelid(&muscle.name) {
            continue;
        }
        match other_side(&muscle.name).map(|(side, other)| (side, muscles.index_of(&other))) {
            Some((Side::Left, Some(right))) => units.push(Unit::Pair {
                left: muscle_idx,
                right,
            }),
            Some((Side::Right, Some(_left))) => {}
            _ => units.push(Unit::Single(muscle_idx)),
        }
    }
    units
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

/// The ways in which muscle sets name sides.
const SIDE_SUFFIXES: [(&str, &str); 3] = [("_left", "_right"), ("_L", "_R"), ("Left", "Right")];

/// Which half of a pair the name means, and the name of the other half.
fn other_side(name: &str) -> Option<(Side, String)> {
    // `JawLeft` is a direction, not a half.
    if name.to_lowercase().starts_with("jaw") {
        return None;
    }
    SIDE_SUFFIXES.iter().find_map(|(left, right)| {
        let is_left = name
            .strip_suffix(left)
            .map(|stem| (Side::Left, format!("{stem}{right}")));
        is_left.or_else(|| {
            name.strip_suffix(right)
                .map(|stem| (Side::Right, format!("{stem}{left}")))
        })
    })
}

fn is_eyelid(name: &str) -> bool {
    let letters: String = name
        .to_lowercase()
        .chars()
        .filter(char::is_ascii_alphabetic)
        .collect();
    letters.contains("orbicularisoculi") || letters.contains("blink")
}

#[cfg(test)]
mod tests {
    use frontalis_analysis::synthesis::reference_face;
    use rand::SeedableRng as _;

    use super::*;

    fn performance(seed: u64) -> Performance {
        let actor = reference_face::actor();
        Performance::new(actor.muscle_set(), Pcg64::seed_from_u64(seed))
    }

    #[test]
    fn knows_the_sides_of_every_naming() {
        let check = |name, expected: Option<(Side, &str)>| {
            let found = other_side(name);
            assert_eq!(
                found,
                expected.map(|(side, other)| (side, other.to_owned())),
                "{name}"
            );
        };
        check("risorius_left", Some((Side::Left, "risorius_right")));
        check("zygomaticus_R", Some((Side::Right, "zygomaticus_L")));
        check("MouthSmileLeft", Some((Side::Left, "MouthSmileRight")));
        check("BrowInnerUp", None);
        check("JawLeft", None);
        check("orbicularis_oris", None);
    }

    #[test]
    fn the_reference_face_has_five_pairs_four_single_muscles_and_two_eyelids() {
        let performance = performance(1);
        let pairs = performance
            .units
            .iter()
            .filter(|it| matches!(it, Unit::Pair { .. }))
            .count();
        assert_eq!((pairs, performance.units.len() - pairs), (5, 4));
        assert_eq!(performance.eyelids, [4, 5]);
    }

    #[test]
    fn is_neutral_first_then_moves_every_muscle_smoothly_within_its_range() {
        let mut performance = performance(7);
        let step_secs = 1.0 / 240.0;
        let mut before = vec![0.0; 16];
        let mut most = vec![0.0_f64; 16];
        for step in 0..240 * 60 {
            let time_secs = f64::from(step) * step_secs;
            let now = performance.activations_at(time_secs);
            for (muscle, contraction) in now.iter().enumerate() {
                assert!((0.0..=1.0).contains(contraction));
                assert!(time_secs > NEUTRAL_SECS || *contraction == 0.0);
                // A blink is the fastest: it rises by 1 in 0.077 s along a cosine.
                assert!((contraction - before[muscle]).abs() < 0.5 * PI * step_secs / 0.077 * 1.1);
                most[muscle] = most[muscle].max(*contraction);
            }
            before = now;
        }
        assert!(most.iter().all(|it| *it > 0.3), "{most:?}");
        assert!(performance.going_on.len() < 40);
    }
}
