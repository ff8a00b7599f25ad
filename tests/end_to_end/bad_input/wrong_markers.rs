//! Rows A12 to A15: frames in which markers are not where they should be, beside the same frames without the fault.

use std::ops::Range;

use frontalis_proto::v1::{CurveSample, MarkerFrame, Quality, SampleFlag};

use super::{Stage, beside_a_control_session};

/// The first frame that is spoiled: in the middle of the performance, with every muscle active.
const SPOILED: u64 = 200;

/// The curves go on after it.
const LAST: u64 = 250;

/// What a spoiled frame may do to an activation.
const SPIKE: f32 = 0.05;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a12_a_marker_that_jumps_is_masked_and_named() {
    beside_a_control_session("A12 jump", async |stage| {
        for (run, name) in ["chin", "brow_inner_right", "mouth_corner_left"]
            .iter()
            .enumerate()
        {
            let jumping = stage.marker(name);
            let take = Take::spoiled(stage, run, |frame| {
                if frame.number == SPOILED {
                    // 50 mm.
                    frame.positions[3 * jumping] += 30.0;
                    frame.positions[3 * jumping + 1] += 40.0;
                }
            })
            .await;
            let spoiled = take.at(SPOILED);
            assert!(has(spoiled, SampleFlag::Outlier), "{name}: {spoiled:?}");
            assert_eq!(spoiled.outlier_markers, [index(jumping)], "{name}");
            assert!(!has(take.at(SPOILED + 1), SampleFlag::Outlier), "{name}");
            take.assert_unharmed(name);
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a12_two_swapped_markers_are_put_right() {
    beside_a_control_session("A12 swap", async |stage| {
        let pairs = [
            ["forehead_left", "lid_right"],
            ["mouth_corner_left", "mouth_corner_right"],
            ["upper_lip_left", "lower_lip_left"],
        ];
        for (run, pair) in pairs.iter().enumerate() {
            let [first, second] = pair.map(|it| stage.marker(it));
            let take = Take::spoiled(stage, run, |frame| {
                if frame.number == SPOILED {
                    for axis in 0..3 {
                        frame.positions.swap(3 * first + axis, 3 * second + axis);
                    }
                }
            })
            .await;
            let spoiled = take.at(SPOILED);
            assert!(has(spoiled, SampleFlag::Relabeled), "{pair:?}: {spoiled:?}");
            assert!(!has(take.at(SPOILED + 1), SampleFlag::Relabeled));
            take.assert_unharmed(&pair.join(" and "));
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a13_a_face_that_teleports_leaves_no_spike() {
    beside_a_control_session("A13", async |stage| {
        // For good, and for one frame.
        for (run, away) in [SPOILED..u64::MAX, SPOILED..SPOILED + 1]
            .into_iter()
            .enumerate()
        {
            let take = Take::spoiled(stage, run, |frame| {
                if away.contains(&frame.number) {
                    for position in frame.positions.chunks_exact_mut(3) {
                        // One meter.
                        position[0] += 700.0;
                        position[1] -= 140.0;
                        position[2] += 700.0;
                    }
                }
            })
            .await;
            let head = |number| take.at(number).head.unwrap();
            let (before, after) = (head(SPOILED - 1), head(SPOILED));
            let moved_cm = [
                after.tx_cm - before.tx_cm,
                after.ty_cm - before.ty_cm,
                after.tz_cm - before.tz_cm,
            ];
            let moved_cm = moved_cm.iter().map(|it| it * it).sum::<f32>().sqrt();
            assert!((moved_cm - 100.0).abs() < 2.0, "{moved_cm} cm");
            assert!(take.samples().all(|it| it.quality() == Quality::Solved));
            take.assert_unharmed("teleported");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a14_markers_on_a_point_a_line_or_a_plane_are_held() {
    beside_a_control_session("A14", async |stage| {
        let [on_a_point, on_a_line, on_a_plane] =
            [[false; 3], [true, false, false], [true, true, false]];
        for (run, kept) in [on_a_point, on_a_line, on_a_plane].iter().enumerate() {
            let take = Take::spoiled(stage, run, |frame| {
                if frame.number == SPOILED {
                    for position in frame.positions.chunks_exact_mut(3) {
                        for (coordinate, kept) in position.iter_mut().zip(kept) {
                            *coordinate = if *kept { *coordinate } else { 250.0 };
                        }
                    }
                }
            })
            .await;
            take.assert_held(SPOILED..SPOILED + 1, "DEGENERATE_POSE");
            take.assert_unharmed(&format!("{kept:?}"));
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a15_one_two_or_three_markers_are_held() {
    beside_a_control_session("A15", async |stage| {
        // Three of one region, and three of both.
        let sights: [&[&str]; 4] = [
            &["nose_tip"],
            &["mouth_corner_left", "mouth_corner_right"],
            &["mouth_corner_left", "mouth_corner_right", "chin"],
            &["forehead_left", "lid_right", "chin"],
        ];
        for (run, seen) in sights.iter().enumerate() {
            let seen: Vec<_> = seen.iter().map(|it| stage.marker(it)).collect();
            let few = SPOILED..SPOILED + 5;
            let take = Take::spoiled(stage, run, |frame| {
                if few.contains(&frame.number) {
                    hide_all_but(frame, |it| seen.contains(&it));
                }
            })
            .await;
            take.assert_held(few.clone(), "TOO_FEW_MARKERS");
            let regions = &take.at(SPOILED).region_errors;
            let n_seen: u32 = regions.iter().map(|it| it.n_markers).sum();
            assert_eq!(n_seen as usize, seen.len());
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a15_a_region_below_its_minimum_is_held_and_the_other_goes_on() {
    beside_a_control_session("A15 regions", async |stage| {
        let performance = &stage.performance;
        let clean = Take::spoiled(stage, 0, |_| {}).await;
        let n_upper = clean.at(SPOILED).region_errors[0].n_markers as usize;
        let upper: Vec<_> = (0..performance.n_markers())
            .filter(|it| is_upper(&performance.marker_names()[*it]))
            .collect();
        assert_eq!(upper.len(), n_upper);
        let least = (3 * n_upper).div_ceil(5);
        for (run, n_seen) in [(1, least), (2, least - 1)] {
            let hidden = &upper[n_seen..];
            let take = Take::spoiled(stage, run, |frame| {
                if frame.number == SPOILED {
                    hide_all_but(frame, |it| !hidden.contains(&it));
                }
            })
            .await;
            let [upper, lower] = take.at(SPOILED).region_errors.as_slice() else {
                panic!("two regions");
            };
            let is_held = n_seen < least;
            let reason = if is_held { "TOO_FEW_MARKERS" } else { "" };
            assert_eq!(upper.held_reason, reason, "{n_seen} markers");
            assert_eq!(upper.quality() == Quality::Held, is_held);
            assert_eq!(lower.quality(), Quality::Solved);
            assert_eq!(take.at(SPOILED).quality(), Quality::Partial);
            take.assert_unharmed(&format!("{n_seen} markers"));
        }
    })
    .await;
}

/// The markers of the upper region that move with it, as the reference face names them.
fn is_upper(name: &str) -> bool {
    let mut upper = ["forehead", "brow", "lid", "nose_bridge"].iter();
    upper.any(|it| name.starts_with(it))
}

fn hide_all_but(frame: &mut MarkerFrame, is_seen: impl Fn(usize) -> bool) {
    for (marker, position) in frame.positions.chunks_exact_mut(3).enumerate() {
        if !is_seen(marker) {
            position.fill(f32::NAN);
        }
    }
}

/// The samples of one performance, clean and spoiled, from frame 1 on.
struct Take {
    clean: Vec<CurveSample>,
    spoiled: Vec<CurveSample>,
}

impl Take {
    /// The performance as it is, and as `spoil` leaves it, each through a session of its own.
    async fn spoiled(stage: &Stage, run: usize, spoil: impl Fn(&mut MarkerFrame)) -> Self {
        let clean = stage.performance.frames(1..=LAST);
        let mut frames = clean.clone();
        frames.iter_mut().for_each(spoil);
        Self {
            clean: stage.samples_of(&format!("clean-{run}"), clean).await,
            spoiled: stage.samples_of(&format!("spoiled-{run}"), frames).await,
        }
    }

    fn at(&self, number: u64) -> &CurveSample {
        let found = self.samples().find(|it| it.frame == number);
        found.expect("every frame gives a sample")
    }

    fn samples(&self) -> impl Iterator<Item = &CurveSample> {
        self.spoiled.iter()
    }

    /// Activations inside their box, none further than [`SPIKE`] from what the clean frame gives.
    fn assert_unharmed(&self, what: &str) {
        let (mut furthest, mut at) = (0.0, 0);
        for (clean, spoiled) in self.clean.iter().zip(&self.spoiled) {
            assert_eq!(clean.frame, spoiled.frame);
            assert_in_the_box(spoiled);
            for (a, b) in clean.activations.iter().zip(&spoiled.activations) {
                if (a - b).abs() > furthest {
                    (furthest, at) = ((a - b).abs(), spoiled.frame);
                }
            }
        }
        println!("{what}: at most {furthest:.4} from the clean take, in frame {at}");
        assert!(furthest <= SPIKE, "{what}: {furthest} in frame {at}");
    }

    /// The values stand still for these frames, and no longer; the head is turned, never mirrored.
    fn assert_held(&self, held: Range<u64>, reason: &str) {
        let before = self.at(held.start - 1);
        for number in held.clone() {
            let sample = self.at(number);
            assert_in_the_box(sample);
            assert_eq!(sample.quality(), Quality::Held, "frame {number}");
            assert_eq!(u64::from(sample.held_frames), number - held.start + 1);
            assert_eq!(sample.activations, before.activations);
            assert!(
                sample
                    .region_errors
                    .iter()
                    .all(|it| it.held_reason == reason)
            );
        }
        assert_eq!(self.at(held.end).quality(), Quality::Solved);
        for (clean, spoiled) in self.clean.iter().zip(&self.spoiled) {
            let (Some(clean), Some(head)) = (clean.head, spoiled.head) else {
                assert!(held.contains(&spoiled.frame), "frame {}", spoiled.frame);
                continue;
            };
            // A mirrored head would be half a turn away from the right one.
            let cos =
                clean.qx * head.qx + clean.qy * head.qy + clean.qz * head.qz + clean.qw * head.qw;
            assert!(cos.abs() > 0.999, "frame {}: {head:?}", spoiled.frame);
        }
    }
}

fn index(marker: usize) -> u32 {
    u32::try_from(marker).unwrap()
}

fn has(sample: &CurveSample, flag: SampleFlag) -> bool {
    sample.flags().any(|it| it == flag)
}

fn assert_in_the_box(sample: &CurveSample) {
    let mut values = sample.activations.iter();
    assert!(values.all(|it| (0.0..=1.0).contains(it)), "{sample:?}");
}
