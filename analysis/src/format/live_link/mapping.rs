//! Which muscles drive which ARKit shapes.
//!
//! A muscle that is named as a shape (a blend-shape set) drives that shape; the muscles of `choe-ko-16` drive those that
//! `arkit_of_muscles.json` says, by way of the action units that both stand for.

use std::{collections::BTreeMap, sync::LazyLock};

use super::{N_SHAPES, SHAPES};
use crate::face::muscle::MuscleSet;

/// The shapes that a muscle drives, and how far at its full contraction.
type Table = BTreeMap<String, BTreeMap<String, f64>>;

static TABLE: LazyLock<Table> = LazyLock::new(|| {
    serde_json::from_str(include_str!("arkit_of_muscles.json"))
        .expect("invariant: the table is part of the program, and a test reads it")
});

/// Shapes from activations: each the sum of its muscles' weighted activations, held between 0 and 1.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeMapping {
    /// Of every shape, the muscles that drive it by their place in the set, and their weights.
    drivers: Vec<Vec<(usize, f64)>>,
}

impl ShapeMapping {
    /// The mapping of a muscle set, by its muscles' names.
    pub fn of(muscles: &MuscleSet) -> Self {
        let names = muscles.muscles().iter().map(|it| it.name.as_str());
        Self::of_names(names)
    }

    /// The mapping of muscles in the order of their names.
    #[expect(
        clippy::missing_panics_doc,
        reason = "a test reads every name of the table"
    )]
    pub fn of_names<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        let mut drivers = vec![Vec::new(); N_SHAPES];
        for (muscle, name) in names.enumerate() {
            if let Some(shape) = shape_named(name) {
                drivers[shape].push((muscle, 1.0));
                continue;
            }
            for (shape, weight) in TABLE.get(name).into_iter().flatten() {
                let shape = shape_named(shape).expect("invariant: a test reads every name");
                drivers[shape].push((muscle, *weight));
            }
        }
        Self { drivers }
    }

    /// The shapes that no muscle drives: they are 0 in every row, and a person should be told.
    pub fn undriven(&self) -> impl Iterator<Item = &'static str> + '_ {
        let shapes = SHAPES.iter().zip(&self.drivers);
        shapes
            .filter(|(_, drivers)| drivers.is_empty())
            .map(|(name, _)| *name)
    }

    /// All shapes in the order of [`SHAPES`]; muscles that `activations` lacks count as relaxed.
    #[expect(
        clippy::missing_panics_doc,
        reason = "there are as many drivers as shapes"
    )]
    pub fn shapes(&self, activations: &[f32]) -> [f64; N_SHAPES] {
        let of_muscle = |&(muscle, weight): &(usize, f64)| {
            let activation = activations.get(muscle).copied().unwrap_or_default();
            weight * f64::from(activation)
        };
        let sum = |drivers: &Vec<_>| drivers.iter().map(of_muscle).sum::<f64>();
        let shapes: Vec<f64> = self.drivers.iter().map(sum).collect();
        let shapes: [f64; N_SHAPES] = shapes.try_into().expect("invariant: one a shape");
        shapes.map(|it| it.clamp(0.0, 1.0))
    }
}

/// The shape that a name means: `EyeBlinkLeft`, as ARKit `eyeBlinkLeft`, or as other programs `eyeBlink_L`.
fn shape_named(name: &str) -> Option<usize> {
    let in_full = match name.rsplit_once('_') {
        Some((name, "L" | "l")) => format!("{name}Left"),
        Some((name, "R" | "r")) => format!("{name}Right"),
        _ => name.to_owned(),
    };
    SHAPES
        .iter()
        .position(|it| it.eq_ignore_ascii_case(&in_full))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthesis::reference_face;

    #[test]
    fn the_table_names_the_reference_faces_muscles_and_shapes_alone() {
        let actor = reference_face::actor();
        let muscles = actor.muscle_set();
        assert_eq!(TABLE.len(), muscles.len());
        for (muscle, shapes) in TABLE.iter() {
            assert!(muscles.index_of(muscle).is_some(), "{muscle}");
            for (shape, weight) in shapes {
                assert!(SHAPES.contains(&shape.as_str()), "{shape}");
                assert!((0.0..=1.0).contains(weight), "{muscle} {shape}");
            }
        }
    }

    #[test]
    fn every_muscle_at_its_full_contraction_drives_its_shapes_to_one() {
        let actor = reference_face::actor();
        let mapping = ShapeMapping::of(actor.muscle_set());
        let shapes = mapping.shapes(&[1.0; 16]);
        let undriven: Vec<_> = mapping.undriven().collect();
        for (name, shape) in SHAPES.iter().zip(shapes) {
            let expected = if undriven.contains(name) { 0.0 } else { 1.0 };
            assert!((shape - expected).abs() < 1e-12, "{name}: {shape}");
        }
        assert_eq!(N_SHAPES - undriven.len(), 23);
    }

    #[test]
    fn shapes_that_are_named_as_arkit_names_them_map_one_to_one() {
        for spelled in ["eyeBlinkLeft", "EyeBlinkLeft", "eyeBlink_L"] {
            let mapping = ShapeMapping::of_names(["jawOpen", spelled].into_iter());
            let shapes = mapping.shapes(&[0.25, 0.5]);
            assert!((shapes[0] - 0.5).abs() < 1e-12 && (shapes[17] - 0.25).abs() < 1e-12);
            assert_eq!(mapping.undriven().count(), N_SHAPES - 2);
        }
        let all = ShapeMapping::of_names(SHAPES.into_iter());
        assert_eq!(all.undriven().count(), 0);
    }

    #[test]
    fn shapes_stay_between_0_and_1() {
        let mapping =
            ShapeMapping::of_names(["jawOpen", "jaw_rotation", "eyeBlinkLeft"].into_iter());
        let shapes = mapping.shapes(&[0.75, 0.75, -0.5]);
        assert!((shapes[17] - 1.0).abs() < 1e-12 && shapes[0].abs() < 1e-12);
    }
}
