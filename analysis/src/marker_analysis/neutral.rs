//! Several neutral frames to one: registered rigidly to each other and averaged.
//!
//! The head may move while the neutral face is collected; averaging K frames divides the marker noise by √K before the
//! surface projection of the alignment, which would otherwise turn that noise into a wrong binding. Markers that jump in a
//! frame are left out of it.

use nalgebra::{Point3, Vector3};

use crate::{
    numeric::similarity_fit::{Scale, fit},
    space::PerformancePoint,
};

/// Rounds of registering every frame to the mean; each round moves the mean by less than a tenth of the one before.
const ROUNDS: usize = 3;

/// An offset from the mean of more than this many medians of all offsets is no noise: six standard deviations of a coordinate.
const OUTLIER_MEDIANS: f64 = 4.0;

/// And what is nearer does no harm, centimeters: frames without noise have a median of nothing.
const LEAST_OUTLIER_CM: f64 = 0.05;

/// Markers that two frames must share to be registered.
const MARKERS_SHARED: usize = 3;

/// One captured instant, one entry a marker.
type Positions = [Option<PerformancePoint>];

/// The mean neutral face of a performance.
#[derive(Clone, Debug, PartialEq)]
pub struct Neutral {
    /// One entry a marker; `None` when no usable frame shows it.
    pub positions: Vec<Option<PerformancePoint>>,
    /// Standard deviation of a mean position per axis, centimeters: what is left of the marker noise after averaging.
    /// 0 when a single frame cannot tell.
    pub noise_cm: f64,
}

/// The mean position of every marker over `frames`, in the pose of the frame that shows most of them.
///
/// A frame that shares too few markers with the mean is left out.
pub fn average(frames: &[&Positions]) -> Neutral {
    // Of equally complete frames the first: max_by_key would take the last.
    let complete = |frame: &&&Positions| frame.iter().flatten().count();
    let reference = frames.iter().rev().max_by_key(complete);
    let mut neutral = Neutral {
        positions: reference.map_or(Vec::new(), |it| it.to_vec()),
        noise_cm: 0.0,
    };
    neutral = average_from(frames, neutral);
    let Some(kept) = without_outliers(frames, &neutral.positions) else {
        return neutral;
    };
    let kept: Vec<&Positions> = kept.iter().map(Vec::as_slice).collect();
    average_from(&kept, neutral)
}

fn average_from(frames: &[&Positions], mut neutral: Neutral) -> Neutral {
    for _ in 0..ROUNDS {
        neutral = register_all(frames, &neutral.positions);
    }
    neutral
}

/// The frames less the markers that lie further from the mean than noise can put them; `None` when there are none.
///
/// One marker that jumps by a centimeter in one of fifteen frames would move its place on the face by more than the noise
/// of a whole take.
fn without_outliers(
    frames: &[&Positions],
    mean: &Positions,
) -> Option<Vec<Vec<Option<PerformancePoint>>>> {
    let offset = |point: Option<Point3<f64>>, mean: &Option<PerformancePoint>| {
        Some((point? - (*mean)?.0).norm())
    };
    let registered: Vec<_> = frames.iter().map(|it| register(it, mean)).collect();
    let moved = registered.iter().flatten();
    let mut offsets: Vec<f64> = moved
        .flat_map(|it| it.iter().zip(mean))
        .filter_map(|(point, mean)| offset(*point, mean))
        .collect();
    if offsets.is_empty() {
        return None;
    }
    let middle = offsets.len() / 2;
    let (_, median, _) = offsets.select_nth_unstable_by(middle, f64::total_cmp);
    let limit_cm = LEAST_OUTLIER_CM.max(OUTLIER_MEDIANS * *median);
    let mut found = false;
    let kept = frames.iter().zip(&registered).map(|(frame, moved)| {
        let mut frame = frame.to_vec();
        for ((position, point), mean) in frame.iter_mut().zip(moved.iter().flatten()).zip(mean) {
            if offset(*point, mean).is_some_and(|it| it > limit_cm) {
                *position = None;
                found = true;
            }
        }
        frame
    });
    let kept = kept.collect();
    found.then_some(kept)
}

/// Sums over the frames that show one marker.
#[derive(Clone, Copy, Default)]
struct Sums {
    count: f64,
    sum: Vector3<f64>,
    squares: f64,
}

fn register_all(frames: &[&Positions], mean: &Positions) -> Neutral {
    let mut sums = vec![Sums::default(); mean.len()];
    let mut registered = 0.0;
    for frame in frames {
        let Some(moved) = register(frame, mean) else {
            continue;
        };
        registered += 1.0;
        for ((sums, point), mean) in sums.iter_mut().zip(moved).zip(mean) {
            if let (Some(point), Some(mean)) = (point, mean) {
                // Relative to the mean before, so that the squares do not cancel.
                let offset = point - mean.0;
                sums.count += 1.0;
                sums.sum += offset;
                sums.squares += offset.norm_squared();
            }
        }
    }
    let positions = sums.iter().zip(mean).map(|(sums, mean)| {
        let mean = (*mean)?;
        (sums.count > 0.0).then(|| PerformancePoint(mean.0 + sums.sum / sums.count))
    });
    Neutral {
        positions: positions.collect(),
        noise_cm: noise_of_mean(&sums, registered),
    }
}

/// The residuals' variance over their degrees of freedom (three a marker and frame, less the means and the rigid motions),
/// divided by the frames that went into a mean.
fn noise_of_mean(sums: &[Sums], frames: f64) -> f64 {
    let (mut residual, mut observations, mut markers) = (0.0, 0.0, 0.0);
    for it in sums.iter().filter(|it| it.count > 0.0) {
        residual += it.squares - it.sum.norm_squared() / it.count;
        observations += it.count;
        markers += 1.0;
    }
    let freedom = 3.0 * (observations - markers) - 6.0 * (frames - 1.0);
    if freedom < 1.0 {
        return 0.0;
    }
    (residual.max(0.0) / freedom * markers / observations).sqrt()
}

/// The frame's markers, moved rigidly onto the mean.
fn register(frame: &Positions, mean: &Positions) -> Option<Vec<Option<Point3<f64>>>> {
    let pairs = frame
        .iter()
        .zip(mean)
        .filter_map(|(from, to)| Some((1.0, (*from)?.0, (*to)?.0)));
    if pairs.clone().count() < MARKERS_SHARED {
        return None;
    }
    let motion = fit(pairs, Scale::One)?;
    let moved = frame
        .iter()
        .map(|it| it.map(|it| Point3::from(motion.rotation * it.0.coords + motion.translation)))
        .collect();
    Some(moved)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt as _, SeedableRng as _};
    use rand_pcg::Pcg64;

    use nalgebra::UnitQuaternion;

    use super::*;

    const FACE: [[f64; 3]; 5] = [
        [0.0, 0.0, 9.0],
        [5.0, 1.0, 7.0],
        [-5.0, 1.5, 7.2],
        [0.5, -9.0, 8.0],
        [2.0, -6.0, 9.5],
    ];

    fn frame(yaw: f64, hidden: Option<usize>) -> Vec<Option<PerformancePoint>> {
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.0, yaw, 0.0));
        FACE.iter()
            .enumerate()
            .map(|(i, p)| {
                let moved = rotation * Vector3::from(*p) + Vector3::new(100.0 * yaw, 3.0, -40.0);
                (Some(i) != hidden).then(|| PerformancePoint(Point3::from(moved)))
            })
            .collect()
    }

    #[test]
    fn a_moving_head_and_a_hidden_marker_do_not_disturb_the_mean() {
        let frames = [frame(0.0, None), frame(0.2, Some(1)), frame(-0.1, Some(3))];
        let borrowed: Vec<&Positions> = frames.iter().map(Vec::as_slice).collect();
        let neutral = average(&borrowed);
        for (mean, truth) in neutral.positions.iter().zip(&frames[0]) {
            assert!((mean.unwrap().0 - truth.unwrap().0).norm() < 1e-9);
        }
        assert!(neutral.noise_cm < 1e-7);
    }

    #[test]
    fn a_marker_that_jumps_in_a_frame_does_not_move_its_mean() {
        let mut frames: Vec<_> = (0..15).map(|k| frame(0.01 * f64::from(k), None)).collect();
        frames[4][2].as_mut().unwrap().0.x += 2.0;
        frames[0][1].as_mut().unwrap().0.y -= 0.7;
        let borrowed: Vec<&Positions> = frames.iter().map(Vec::as_slice).collect();
        let neutral = average(&borrowed);
        let face = frame(0.0, None);
        let pairs = neutral
            .positions
            .iter()
            .zip(&face)
            .map(|(mean, truth)| (1.0, mean.unwrap().0, truth.unwrap().0));
        let motion = fit(pairs.clone(), Scale::One).unwrap();
        for (_, mean, truth) in pairs {
            let moved = motion.rotation * mean.coords + motion.translation;
            assert!((moved - truth.coords).norm() < 0.02, "{moved} {truth}");
        }
    }

    #[test]
    fn a_marker_that_no_frame_shows_stays_unseen() {
        let frames = [frame(0.0, Some(2)), frame(0.1, Some(2))];
        let borrowed: Vec<&Positions> = frames.iter().map(Vec::as_slice).collect();
        let positions = average(&borrowed).positions;
        assert_eq!(positions[2], None);
        assert_eq!(positions.iter().flatten().count(), 4);
    }

    #[test]
    fn the_noise_of_the_mean_is_the_marker_noise_over_the_root_of_the_frames() {
        let mut rng = Pcg64::seed_from_u64(7);
        let frames: Vec<Vec<Option<PerformancePoint>>> = (0..400)
            .map(|_| {
                let mut noisy = frame(0.0, None);
                for it in noisy.iter_mut().flatten() {
                    // Uniform over ±0.1 √3: standard deviation 0.1.
                    for axis in 0..3 {
                        it.0[axis] += 0.1 * 3_f64.sqrt() * rng.random_range(-1.0..1.0);
                    }
                }
                noisy
            })
            .collect();
        let borrowed: Vec<&Positions> = frames.iter().map(Vec::as_slice).collect();
        let noise_cm = average(&borrowed).noise_cm;
        assert!((noise_cm / (0.1 / 20.0) - 1.0).abs() < 0.1, "{noise_cm}");
    }
}
