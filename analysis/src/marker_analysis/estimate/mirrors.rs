//! Muscles that are mirror images of each other: where the markers of one are hidden, the other says what it does.
//!
//! Eyelids rest on one marker each, and blink together: while the marker is hidden, to hold the lid or to let it go misses every
//! blink.

use super::super::{evidence::Part, marker_model::MarkerModel};
use crate::{
    face::muscle::MuscleSet,
    numeric::tape::{Tape, TapeError},
};

/// What two mirror images differ by fades by 1/e in this time while one of them is hidden.
const DIFFERENCE_SECS: f64 = 1.0;

/// Pairs of muscles, in the solver's order, and which of them follow the other in this frame.
#[derive(Clone, Debug)]
pub(super) struct Mirrors {
    pairs: Vec<[usize; 2]>,
    /// Of each pair, the first less the second where both were last observed, as far as it has not faded.
    differences: Vec<f64>,
    followers: Vec<Follower>,
}

/// A muscle that is not observed, and its mirror image, which is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Follower {
    pub muscle: usize,
    pub leader: usize,
    /// By how much it still differs from the leader.
    pub difference: f64,
}

impl Mirrors {
    pub fn new(model: &MarkerModel, muscles: &MuscleSet) -> Self {
        let place = |name: &str| {
            let index = muscles.index_of(name)?;
            model.muscles.iter().position(|it| *it == index)
        };
        let names = muscles.muscles().iter().map(|it| it.name.as_str());
        let pairs: Vec<_> = names
            .filter_map(|name| Some([place(name)?, place(&mirror_name(name)?)?]))
            .collect();
        Self {
            followers: Vec::with_capacity(pairs.len()),
            differences: vec![0.0; pairs.len()],
            pairs,
        }
    }

    /// Takes over what the pairs of the same muscles differed by.
    pub fn continue_from(&mut self, before: &Self) {
        if before.pairs == self.pairs {
            self.differences.clone_from(&before.differences);
        }
    }

    /// Names what a frame finds of those before it.
    pub fn lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        tape.reals("differences", &mut self.differences)
    }

    /// All pairs, left and right.
    pub fn pairs(&self) -> &[[usize; 2]] {
        &self.pairs
    }

    /// Finds out which muscles follow in a frame, `elapsed_secs` after what was said before.
    pub fn begin(&mut self, parts: &[Part], elapsed_secs: f64) {
        self.followers.clear();
        let fade = (-elapsed_secs / DIFFERENCE_SECS).exp();
        for (&[a, b], difference) in self.pairs.iter().zip(&mut self.differences) {
            let (muscle, leader, sign) = match [a, b].map(|it| parts[it]) {
                [Part::Unobserved, Part::Solved] => (a, b, 1.0),
                [Part::Solved, Part::Unobserved] => (b, a, -1.0),
                _ => continue,
            };
            *difference *= fade;
            self.followers.push(Follower {
                muscle,
                leader,
                difference: sign * *difference,
            });
        }
    }

    /// Remembers what the pairs differ by of which both are observed.
    pub fn end(&mut self, parts: &[Part], x: &[f64]) {
        for (&[a, b], difference) in self.pairs.iter().zip(&mut self.differences) {
            if [a, b].map(|it| parts[it]) == [Part::Solved; 2] {
                *difference = x[a] - x[b];
            }
        }
    }

    /// The muscles that follow in this frame.
    pub fn followers(&self) -> &[Follower] {
        &self.followers
    }
}

/// The name of a left muscle's mirror image: `zygomatic_major_left` and `mouthSmileLeft`, `frontalis_L` alike.
fn mirror_name(name: &str) -> Option<String> {
    [("left", "right"), ("Left", "Right"), ("_L", "_R")]
        .into_iter()
        .find_map(|(left, right)| Some(format!("{}{right}", name.strip_suffix(left)?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_left_muscle_names_its_mirror_image() {
        let right = mirror_name;
        assert_eq!(right("risorius_left").as_deref(), Some("risorius_right"));
        assert_eq!(right("mouthSmileLeft").as_deref(), Some("mouthSmileRight"));
        assert_eq!(right("frontalis_L").as_deref(), Some("frontalis_R"));
        assert_eq!(right("risorius_right"), None);
        assert_eq!(right("jaw_rotation"), None);
    }
}
