//! What a session's objective has beyond the paper's least squares, and within which bounds it is minimized.
//!
//! Strengths run from 0, off, to 1; what each costs in lag or bias stands in `docs/methods.md`.

use crate::face::muscle::MuscleSet;

/// Strength at which smoothing and sparsity are those of METHODS 5b.
pub const USUAL_STRENGTH: f64 = 0.5;

/// Largest bound that a contraction may be given: beyond it a basis says nothing.
pub const LARGEST_BOUND: f64 = 2.0;

/// Most pairs of muscles that may exclude each other: each costs up to two more solves a frame.
pub const MAX_EXCLUSIVE_PAIRS: usize = 16;

/// The terms of the objective and its bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct Objective {
    /// Weigh outlying markers down by how far they are from what the others say, mask those that jump, undo swapped labels.
    pub robust: bool,
    /// Strength of the temporal prior: holds are smoothed, jumps pass.
    pub smoothing: f64,
    /// Strength of the L1 term, which keeps relaxed muscles at 0 and vanishes on active ones.
    pub sparsity: f64,
    /// Strength with which a muscle and its mirror image are drawn together.
    pub symmetry: f64,
    /// Muscles with bounds of their own.
    pub bounds: Vec<MuscleBounds>,
    /// Muscles of which at most one is active at a time.
    pub exclusive_pairs: Vec<[String; 2]>,
}

/// The bounds of one muscle's contraction.
#[derive(Clone, Debug, PartialEq)]
pub struct MuscleBounds {
    /// Name of the muscle.
    pub muscle: String,
    /// Smallest contraction, 0 or more.
    pub lower: f64,
    /// Largest contraction, [`LARGEST_BOUND`] or less.
    pub upper: f64,
}

/// What is wrong with an objective; `field` names are those of [`Objective`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ObjectiveError {
    /// A strength outside 0..=1, or undefined.
    #[error("{field} is {found}, expected 0 to 1")]
    Strength {
        /// Which strength.
        field: &'static str,
        /// What it is.
        found: f64,
    },
    /// Bounds that are undefined, empty, or outside 0..=[`LARGEST_BOUND`].
    #[error(
        "bounds of {muscle} are {lower} to {upper}, expected 0 <= lower <= upper <= {LARGEST_BOUND}"
    )]
    Bounds {
        /// Name of the muscle.
        muscle: String,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
    },
    /// A muscle with bounds of its own twice.
    #[error("bounds of {muscle} are given twice")]
    BoundsTwice {
        /// Name of the muscle.
        muscle: String,
    },
    /// A pair of a muscle and itself, or of one that may not be relaxed.
    #[error("{muscle} and {other} cannot exclude each other: {why}")]
    Pair {
        /// Name of one muscle.
        muscle: String,
        /// Name of the other.
        other: String,
        /// Why not.
        why: &'static str,
    },
    /// Too many pairs.
    #[error("{found} exclusive pairs, at most {MAX_EXCLUSIVE_PAIRS} are possible")]
    PairCount {
        /// How many there are.
        found: usize,
    },
    /// A name that the actor's muscle set does not have.
    #[error("{field} names {muscle}, which is not a muscle of {muscle_set}")]
    UnknownMuscle {
        /// Where.
        field: &'static str,
        /// The name.
        muscle: String,
        /// Id of the muscle set.
        muscle_set: String,
    },
}

impl Default for Objective {
    fn default() -> Self {
        Self {
            robust: true,
            smoothing: USUAL_STRENGTH,
            sparsity: USUAL_STRENGTH,
            ..Self::plain()
        }
    }
}

impl Objective {
    /// The paper's objective, nothing added.
    pub fn plain() -> Self {
        Self {
            robust: false,
            smoothing: 0.0,
            sparsity: 0.0,
            symmetry: 0.0,
            bounds: Vec::new(),
            exclusive_pairs: Vec::new(),
        }
    }

    /// Whether no term is added to the paper's objective; bounds and pairs are no terms.
    pub fn is_plain(&self) -> bool {
        !self.robust && self.smoothing <= 0.0 && self.sparsity <= 0.0 && self.symmetry <= 0.0
    }

    /// Checks every number and every name against the actor's muscles.
    ///
    /// # Errors
    ///
    /// The first thing that is wrong.
    pub fn check(&self, muscles: &MuscleSet) -> Result<(), ObjectiveError> {
        self.check_strengths()?;
        self.check_bounds(muscles)?;
        self.check_pairs(muscles)
    }

    fn check_strengths(&self) -> Result<(), ObjectiveError> {
        let strengths = [
            ("smoothing", self.smoothing),
            ("sparsity", self.sparsity),
            ("symmetry", self.symmetry),
        ];
        match strengths
            .into_iter()
            .find(|(_, it)| !(0.0..=1.0).contains(it))
        {
            Some((field, found)) => Err(ObjectiveError::Strength { field, found }),
            None => Ok(()),
        }
    }

    fn check_bounds(&self, muscles: &MuscleSet) -> Result<(), ObjectiveError> {
        for (index, it) in self.bounds.iter().enumerate() {
            known(muscles, "bounds", &it.muscle)?;
            let muscle = it.muscle.clone();
            if !(0.0 <= it.lower && it.lower <= it.upper && it.upper <= LARGEST_BOUND) {
                let (lower, upper) = (it.lower, it.upper);
                return Err(ObjectiveError::Bounds {
                    muscle,
                    lower,
                    upper,
                });
            }
            if self.bounds[..index].iter().any(|it| it.muscle == muscle) {
                return Err(ObjectiveError::BoundsTwice { muscle });
            }
        }
        Ok(())
    }

    fn check_pairs(&self, muscles: &MuscleSet) -> Result<(), ObjectiveError> {
        let found = self.exclusive_pairs.len();
        if found > MAX_EXCLUSIVE_PAIRS {
            return Err(ObjectiveError::PairCount { found });
        }
        for [muscle, other] in &self.exclusive_pairs {
            known(muscles, "exclusive_pairs", muscle)?;
            known(muscles, "exclusive_pairs", other)?;
            let never_relaxed = |name: &String| {
                let mut own = self.bounds.iter();
                own.any(|it| it.muscle == *name && it.lower > 0.0)
            };
            let why = if muscle == other {
                "they are the same muscle"
            } else if never_relaxed(muscle) || never_relaxed(other) {
                "one of them has a lower bound above 0"
            } else {
                continue;
            };
            let (muscle, other) = (muscle.clone(), other.clone());
            return Err(ObjectiveError::Pair { muscle, other, why });
        }
        Ok(())
    }
}

fn known(muscles: &MuscleSet, field: &'static str, name: &str) -> Result<(), ObjectiveError> {
    if muscles.muscles().iter().any(|it| it.name == name) {
        return Ok(());
    }
    Err(ObjectiveError::UnknownMuscle {
        field,
        muscle: name.to_owned(),
        muscle_set: muscles.id().to_owned(),
    })
}
