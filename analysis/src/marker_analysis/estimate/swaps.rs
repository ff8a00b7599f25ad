//! Markers whose labels the capture system exchanged, told by where they were expected.
//!
//! A swap leaves two markers far from where the frame before puts them, each where the other should be.
//! It is undone when exchanging the two labels explains both.

use nalgebra::Vector3;

/// Pairs put right in one frame. More at a time is no slip of the tracking but another order of the markers, or a mirror
/// image, and is not for a frame to mend.
pub(super) const MAX_SWAPS: usize = 2;

/// Markers that are looked at; each is compared with every other.
const MAX_CANDIDATES: usize = 16;

/// A marker this far from where it is expected may be another one, in standard deviations of a coordinate, and at least so
/// many centimeters: less than the smallest distance of two markers on a face.
const FAR_SIGMAS: f64 = 6.0;
const FAR_CM: f64 = 0.4;

/// After the exchange each must be nearer by this factor.
const NEARER: f64 = 3.0;

/// Finds pairs of `used` markers that stand in each other's place.
///
/// `positions` and `expected` are by marker, in one space, centimeters; `sigma_cm` is the scatter of the frame.
pub(super) fn find(
    used: &[usize],
    positions: &[Vector3<f64>],
    expected: &[[f64; 3]],
    sigma_cm: f64,
    swaps: &mut Vec<[usize; 2]>,
) {
    swaps.clear();
    let far = FAR_CM.max(FAR_SIGMAS * sigma_cm);
    let is_far =
        |j: &&usize| (positions[**j] - Vector3::from(expected[**j])).norm_squared() > far * far;
    let mut candidates = [0; MAX_CANDIDATES];
    let mut n = 0;
    for (to, j) in candidates.iter_mut().zip(used.iter().filter(is_far)) {
        *to = *j;
        n += 1;
    }
    let distance = |from: usize, to: usize| (positions[from] - Vector3::from(expected[to])).norm();
    let fits = |from: usize, to: usize| NEARER * distance(from, to) < distance(from, from);
    for (place, &a) in candidates[..n].iter().enumerate() {
        let is_free = |j: usize| !swaps.iter().flatten().any(|it| *it == j);
        if swaps.len() == MAX_SWAPS || !is_free(a) {
            continue;
        }
        let mut others = candidates[place + 1..n].iter();
        if let Some(&b) = others.find(|b| is_free(**b) && fits(a, **b) && fits(**b, a)) {
            swaps.push([a, b]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(positions: &[Vector3<f64>]) -> Vec<[usize; 2]> {
        let expected: Vec<_> = (0..6).map(|j| place(j).into()).collect();
        let used: Vec<_> = (0..6).collect();
        let mut swaps = Vec::new();
        find(&used, positions, &expected, 0.05, &mut swaps);
        swaps
    }

    fn place(j: usize) -> Vector3<f64> {
        Vector3::new(1.2 * j as f64, (j * j) as f64 * 0.3, 8.0)
    }

    #[test]
    fn two_markers_in_each_others_place_are_found() {
        let mut positions: Vec<_> = (0..6).map(place).collect();
        positions.swap(1, 4);
        assert_eq!(found(&positions), [[1, 4]]);
    }

    #[test]
    fn a_single_jump_is_no_swap() {
        let mut positions: Vec<_> = (0..6).map(place).collect();
        positions[2] = place(3);
        assert!(found(&positions).is_empty());
    }

    #[test]
    fn a_mirrored_row_is_not_for_a_frame_to_mend() {
        let positions: Vec<_> = (0..6).rev().map(place).collect();
        assert!(found(&positions).len() <= MAX_SWAPS);
    }
}
