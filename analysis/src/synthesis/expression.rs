//! The expression layer above the muscles: smile, frown, horror and others as named contractions of `choe-ko-16`.
//!
//! Hung & Huang put such a layer on top of the muscle layer; which muscles make an expression follows the
//! Facial Action Coding System (Ekman & Friesen), each action unit given by the muscle that performs it.
//! Expressions are symmetric: a paired muscle contracts alike on both sides.

use crate::face::muscle::MuscleSet;

/// An expression that people recognize by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Expression {
    /// Happiness: action units 6 and 12.
    Smile,
    /// Displeasure: 4, 15 and 24.
    Frown,
    /// Fear: 1, 2, 4, 20 and 26.
    Horror,
    /// 1, 2 and 26.
    Surprise,
    /// 4, 7, 10 and 24.
    Anger,
    /// 1, 4 and 15.
    Sadness,
    /// 4, 7, 9 or 10, and 15.
    Disgust,
    /// 18 and 22, with half-closed eyes.
    Kiss,
}

/// Contractions of single muscles; a paired muscle stands for both sides.
type Contractions = &'static [(&'static str, f64)];

impl Expression {
    /// Every expression, in the order of a menu.
    pub const ALL: [Self; 8] = [
        Self::Smile,
        Self::Frown,
        Self::Horror,
        Self::Surprise,
        Self::Anger,
        Self::Sadness,
        Self::Disgust,
        Self::Kiss,
    ];

    /// The expression called `name`, in lower case.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|it| it.name() == name)
    }

    /// The name, in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Smile => "smile",
            Self::Frown => "frown",
            Self::Horror => "horror",
            Self::Surprise => "surprise",
            Self::Anger => "anger",
            Self::Sadness => "sadness",
            Self::Disgust => "disgust",
            Self::Kiss => "kiss",
        }
    }

    /// One contraction in [0, 1] a muscle of `muscle_set`, in its order.
    ///
    /// Muscles are found by name, so that any set that has the muscles of `choe-ko-16` will do.
    /// `None` when a muscle of this expression is missing: half an expression would be another one.
    ///
    /// ```
    /// use frontalis_analysis::synthesis::{expression::Expression, reference_face};
    ///
    /// let actor = reference_face::actor();
    /// let smile = Expression::Smile.activations(actor.muscle_set()).expect("a set with all muscles");
    /// assert_eq!(smile[8], smile[9]); // zygomatic major, left and right
    /// ```
    pub fn activations(self, muscle_set: &MuscleSet) -> Option<Vec<f64>> {
        let mut activations = vec![0.0; muscle_set.len()];
        for &(name, contraction) in self.contractions() {
            match muscle_set.index_of(name) {
                Some(single) => activations[single] = contraction,
                None => {
                    for side in ["left", "right"] {
                        activations[muscle_set.index_of(&format!("{name}_{side}"))?] = contraction;
                    }
                }
            }
        }
        Some(activations)
    }

    fn contractions(self) -> Contractions {
        match self {
            Self::Smile => &[
                ("zygomatic_major", 0.9),
                ("risorius", 0.25),
                ("orbicularis_oculi", 0.2),
            ],
            Self::Frown => &[
                ("corrugator", 0.9),
                ("depressor_anguli_oris", 0.7),
                ("lips_pressor", 0.3),
            ],
            Self::Horror => &[
                ("frontalis", 0.9),
                ("corrugator", 0.6),
                ("risorius", 0.8),
                ("jaw_rotation", 0.6),
            ],
            Self::Surprise => &[("frontalis", 1.0), ("jaw_rotation", 0.7)],
            Self::Anger => &[
                ("corrugator", 1.0),
                ("orbicularis_oculi", 0.25),
                ("levator_labii_superioris", 0.2),
                ("lips_pressor", 0.7),
            ],
            Self::Sadness => &[
                ("frontalis", 0.35),
                ("corrugator", 0.7),
                ("orbicularis_oculi", 0.2),
                ("depressor_anguli_oris", 0.8),
            ],
            Self::Disgust => &[
                ("corrugator", 0.5),
                ("orbicularis_oculi", 0.3),
                ("levator_labii_superioris", 1.0),
                ("depressor_anguli_oris", 0.35),
            ],
            Self::Kiss => &[("orbicularis_oculi", 0.4), ("orbicularis_oris", 1.0)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        face::{muscle::Muscle, region::FaceRegion},
        synthesis::reference_face,
    };

    #[test]
    fn every_expression_is_found_by_its_name_and_moves_the_reference_face() {
        let actor = reference_face::actor();
        let mut seen: Vec<Vec<f64>> = Vec::new();
        for expression in Expression::ALL {
            assert_eq!(Expression::from_name(expression.name()), Some(expression));
            let activations = expression.activations(actor.muscle_set()).unwrap();
            assert!(activations.iter().all(|it| (0.0..=1.0).contains(it)));
            assert!(
                activations.iter().sum::<f64>() > 1.0,
                "{}",
                expression.name()
            );
            assert!(!seen.contains(&activations), "{}", expression.name());
            seen.push(activations);
        }
        assert_eq!(Expression::from_name("Smile"), None);
    }

    #[test]
    fn every_expression_is_symmetric() {
        let actor = reference_face::actor();
        let muscles = actor.muscle_set();
        for expression in Expression::ALL {
            let activations = expression.activations(muscles).unwrap();
            for (left, muscle) in muscles.muscles().iter().enumerate() {
                if let Some(stem) = muscle.name.strip_suffix("_left") {
                    let right = muscles.index_of(&format!("{stem}_right")).unwrap();
                    assert_eq!(activations[left].to_bits(), activations[right].to_bits());
                }
            }
        }
    }

    #[test]
    fn a_set_without_the_muscles_has_no_expression() {
        let muscle = Muscle {
            name: "jaw_rotation".to_owned(),
            region: FaceRegion::Lower,
        };
        let muscles = MuscleSet::new("jaw-only".to_owned(), vec![muscle]);
        assert!(
            Expression::ALL
                .iter()
                .all(|it| it.activations(&muscles).is_none())
        );
    }
}
