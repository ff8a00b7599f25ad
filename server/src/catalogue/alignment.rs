//! A session's alignment as it is stored, so that a restart need not align again (CONTRACTS D-30a).
//!
//! Every f64 comes back with the same bits: a resumed session gives the curves that it would have given.

use frontalis_analysis::{
    face::marker::VirtualMarker,
    marker_analysis::alignment::Alignment,
    space::{LengthUnit, Similarity},
};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::CatalogueError;

/// An alignment and the stream that it was found on; another unit or other names align again.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredAlignment {
    /// The similarity and the bindings.
    pub alignment: Alignment,
    /// The unit that the publisher declared.
    pub unit: LengthUnit,
    /// The names that the publisher declared, in its order.
    pub marker_names: Vec<String>,
    /// Revision of the actor whose mesh the bindings lie on.
    pub actor_revision: u32,
}

impl StoredAlignment {
    /// As it is stored, and as a take's file holds it.
    ///
    /// # Errors
    ///
    /// When a number is not finite.
    pub fn to_text(&self) -> Result<String, CatalogueError> {
        serde_json::to_string(&Record::from(self)).map_err(|_| UNREADABLE)
    }

    /// What [`Self::to_text`] wrote.
    ///
    /// # Errors
    ///
    /// When it is something else.
    pub fn from_text(text: &str) -> Result<Self, CatalogueError> {
        let record: Record = serde_json::from_str(text).map_err(|_| UNREADABLE)?;
        record.try_into()
    }
}

const UNREADABLE: CatalogueError = CatalogueError::Unreadable { what: "alignment" };

const UNITS: [LengthUnit; 3] = [
    LengthUnit::Millimeter,
    LengthUnit::Centimeter,
    LengthUnit::Meter,
];

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    scale: f64,
    rotation_xyzw: [f64; 4],
    translation_cm: [f64; 3],
    bindings: Vec<Option<Binding>>,
    rms_residual_cm: f64,
    iterations: u32,
    unit: String,
    marker_names: Vec<String>,
    actor_revision: u32,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Binding {
    triangle: usize,
    barycentric: [f64; 3],
}

impl From<&StoredAlignment> for Record {
    fn from(stored: &StoredAlignment) -> Self {
        let similarity = &stored.alignment.model_from_performance;
        let q = similarity.rotation.quaternion();
        let binding = |it: &Option<VirtualMarker>| {
            it.map(|marker| Binding {
                triangle: marker.triangle,
                barycentric: marker.barycentric,
            })
        };
        Self {
            scale: similarity.scale,
            rotation_xyzw: [q.i, q.j, q.k, q.w],
            translation_cm: similarity.translation_cm.into(),
            bindings: stored.alignment.bindings.iter().map(binding).collect(),
            rms_residual_cm: stored.alignment.rms_residual_cm,
            iterations: stored.alignment.iterations,
            unit: stored.unit.symbol().to_owned(),
            marker_names: stored.marker_names.clone(),
            actor_revision: stored.actor_revision,
        }
    }
}

impl TryFrom<Record> for StoredAlignment {
    type Error = CatalogueError;

    fn try_from(record: Record) -> Result<Self, CatalogueError> {
        let [x, y, z, w] = record.rotation_xyzw;
        let unit = UNITS.into_iter().find(|it| it.symbol() == record.unit);
        let binding = |it: Option<Binding>| {
            it.map(|it| VirtualMarker {
                triangle: it.triangle,
                barycentric: it.barycentric,
            })
        };
        Ok(Self {
            alignment: Alignment {
                model_from_performance: Similarity {
                    scale: record.scale,
                    // It was a unit quaternion; normalizing again would change its last bits.
                    rotation: UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z)),
                    translation_cm: Vector3::from(record.translation_cm),
                },
                bindings: record.bindings.into_iter().map(binding).collect(),
                rms_residual_cm: record.rms_residual_cm,
                iterations: record.iterations,
            },
            unit: unit.ok_or(UNREADABLE)?,
            marker_names: record.marker_names,
            actor_revision: record.actor_revision,
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn every_finite_number_comes_back_with_the_same_bits(
            numbers in prop::collection::vec(any::<f64>().prop_filter("finite", |it| it.is_finite()), 12),
            triangle in 0_usize..1_000_000,
            iterations in any::<u32>(),
        ) {
            let q = Quaternion::new(numbers[0], numbers[1], numbers[2], numbers[3]);
            let stored = StoredAlignment {
                alignment: Alignment {
                    model_from_performance: Similarity {
                        scale: numbers[4],
                        rotation: UnitQuaternion::new_unchecked(q),
                        translation_cm: Vector3::new(numbers[5], numbers[6], -0.0),
                    },
                    bindings: vec![None, Some(VirtualMarker {
                        triangle,
                        barycentric: [numbers[7], numbers[8], numbers[9]],
                    })],
                    rms_residual_cm: numbers[10],
                    iterations,
                },
                unit: LengthUnit::Millimeter,
                marker_names: vec!["brow \"outer\" left".into(), String::new()],
                actor_revision: 3,
            };
            let back = StoredAlignment::from_text(&stored.to_text().unwrap()).unwrap();
            prop_assert_eq!(bits(&back), bits(&stored));
            prop_assert_eq!(back.marker_names, stored.marker_names);
            prop_assert_eq!(back.unit, stored.unit);
        }
    }

    fn bits(stored: &StoredAlignment) -> Vec<u64> {
        let it = &stored.alignment;
        let similarity = &it.model_from_performance;
        let bindings = it.bindings.iter().flatten().flat_map(|it| it.barycentric);
        let fixed = [similarity.scale, it.rms_residual_cm];
        similarity
            .rotation
            .coords
            .iter()
            .copied()
            .chain(similarity.translation_cm.iter().copied())
            .chain(bindings)
            .chain(fixed)
            .map(f64::to_bits)
            .collect()
    }
}
