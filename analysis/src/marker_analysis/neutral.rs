//! Several neutral frames to one: registered rigidly to each other and averaged.
//!
//! The head may move while the neutral face is collected; averaging K frames divides the marker noise by √K before the
//! surface projection of the alignment, which would otherwise turn that noise into a wrong binding.

use nalgebra::Point3;

use crate::{
    numeric::similarity_fit::{Scale, fit},
    space::PerformancePoint,
};

/// Rounds of registering every frame to the mean; each round moves the mean by less than a tenth of the one before.
const ROUNDS: usize = 3;

/// Markers that two frames must share to be registered.
const MARKERS_SHARED: usize = 3;

/// One captured instant, one entry a marker.
type Positions = [Option<PerformancePoint>];

/// The mean position of every marker over `frames`, in the pose of the frame that shows most of them.
///
/// `None` for a marker that no usable frame shows. A frame that shares too few markers with the mean is left out.
pub fn average(frames: &[&Positions]) -> Vec<Option<PerformancePoint>> {
    // Of equally complete frames the first: max_by_key would take the last.
    let Some(reference) = frames
        .iter()
        .rev()
        .max_by_key(|frame| frame.iter().flatten().count())
    else {
        return Vec::new();
    };
    (0..ROUNDS).fold(reference.to_vec(), |mean, _| register_all(frames, &mean))
}

fn register_all(frames: &[&Positions], mean: &Positions) -> Vec<Option<PerformancePoint>> {
    let mut sums = vec![(0.0, nalgebra::Vector3::zeros()); mean.len()];
    for frame in frames {
        let Some(moved) = register(frame, mean) else {
            continue;
        };
        for ((count, sum), point) in sums.iter_mut().zip(moved) {
            if let Some(point) = point {
                *count += 1.0;
                *sum += point.coords;
            }
        }
    }
    sums.into_iter()
        .map(|(count, sum)| (count > 0.0).then(|| PerformancePoint(Point3::from(sum / count))))
        .collect()
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
    use nalgebra::{UnitQuaternion, Vector3};

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
        for (mean, truth) in average(&borrowed).iter().zip(&frames[0]) {
            assert!((mean.unwrap().0 - truth.unwrap().0).norm() < 1e-9);
        }
    }

    #[test]
    fn a_marker_that_no_frame_shows_stays_unseen() {
        let frames = [frame(0.0, Some(2)), frame(0.1, Some(2))];
        let borrowed: Vec<&Positions> = frames.iter().map(Vec::as_slice).collect();
        assert_eq!(average(&borrowed)[2], None);
        assert_eq!(average(&borrowed).iter().flatten().count(), 4);
    }
}
