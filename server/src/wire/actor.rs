//! Actors on the wire.

use frontalis_analysis::{
    face::{actor::Actor, marker::Marker, muscle::Muscle, region::FaceRegion},
    space::LengthUnit,
};
use frontalis_proto::Timestamp;
use frontalis_proto::v1;

use super::invalid::{FieldError, FieldProblem};
use crate::{
    catalogue::{ActorRevision, Layout},
    name::{ActorId, DisplayName},
};

/// The first message of an import, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportStart {
    /// New or existing.
    pub actor: ActorId,
    /// In place of the package's own, unless it is empty.
    pub display_name: DisplayName,
    /// The package must be in this unit.
    pub unit: Option<LengthUnit>,
    /// Accept a rank-deficient basis.
    pub regularize: bool,
}

impl TryFrom<v1::ImportActorStart> for ImportStart {
    type Error = FieldError;

    fn try_from(start: v1::ImportActorStart) -> Result<Self, FieldError> {
        let unit = v1::LengthUnit::try_from(start.unit)
            .map_err(|_| FieldError::new("unit", FieldProblem::UnknownEnum(start.unit)))?;
        Ok(Self {
            actor: ActorId::parse(&start.actor_id).map_err(FieldError::name("actor_id"))?,
            display_name: DisplayName::parse("display_name", &start.display_name)
                .map_err(FieldError::name("display_name"))?,
            unit: match unit {
                v1::LengthUnit::Unspecified => None,
                v1::LengthUnit::Millimeter => Some(LengthUnit::Millimeter),
                v1::LengthUnit::Centimeter => Some(LengthUnit::Centimeter),
                v1::LengthUnit::Meter => Some(LengthUnit::Meter),
            },
            regularize: start.regularize,
        })
    }
}

/// What the catalogue keeps of an actor that was read; the display name of the request goes first.
pub fn layout(actor: &Actor, start: &ImportStart) -> Layout {
    let muscles = actor.muscle_set().muscles();
    let report = actor.basis_report();
    let name = |muscle: usize| muscles[muscle].name.clone();
    let display_name = match start.display_name.as_str() {
        "" => actor.display_name(),
        chosen => chosen,
    };
    Layout {
        display_name: display_name.to_owned(),
        muscle_set: actor.muscle_set().id().to_owned(),
        muscles: muscles.to_vec(),
        markers: actor.markers().to_vec(),
        n_vertices: count(actor.mesh().vertices.len()),
        n_triangles: count(actor.mesh().triangles.len()),
        conditions: [report.condition_upper, report.condition_lower],
        ambiguous: report
            .ambiguous
            .iter()
            .map(|it| (name(it.first), name(it.second), it.correlation))
            .collect(),
        regularized: start.regularize,
    }
}

/// An actor as the wire shows it.
pub fn actor(revision: &ActorRevision) -> v1::Actor {
    let layout = &revision.layout;
    v1::Actor {
        name: revision.actor.resource(),
        display_name: layout.display_name.clone(),
        revision: revision.revision,
        create_time: Some(timestamp(revision.create_time_nanos)),
        muscles: layout.muscles.iter().map(muscle).collect(),
        markers: layout.markers.iter().map(marker).collect(),
        n_vertices: layout.n_vertices,
        n_triangles: layout.n_triangles,
        regions_trained: false,
        basis: Some(basis_report(layout)),
        muscle_set: layout.muscle_set.clone(),
    }
}

/// Unix nanoseconds as a timestamp.
pub fn timestamp(unix_nanos: i64) -> Timestamp {
    let nanos = unix_nanos.rem_euclid(1_000_000_000);
    Timestamp {
        seconds: unix_nanos.div_euclid(1_000_000_000),
        // Less than 10^9, which always fits.
        nanos: i32::try_from(nanos).unwrap_or(0),
    }
}

/// Unix nanoseconds of a moment, saturating.
pub fn unix_nanos(moment: &Timestamp) -> i64 {
    let seconds = moment.seconds.saturating_mul(1_000_000_000);
    seconds.saturating_add(i64::from(moment.nanos))
}

/// A figure of a header or a status: finite, whatever it was (CONTRACTS N-0).
pub fn finite(figure: f64) -> f64 {
    if figure.is_nan() {
        return 0.0;
    }
    figure.clamp(f64::MIN, f64::MAX)
}

/// A region's number on the wire.
pub fn region(region: FaceRegion) -> v1::FaceRegion {
    match region {
        FaceRegion::Upper => v1::FaceRegion::Upper,
        FaceRegion::Lower => v1::FaceRegion::Lower,
    }
}

fn muscle(it: &Muscle) -> v1::Muscle {
    v1::Muscle {
        name: it.name.clone(),
        region: region(it.region).into(),
    }
}

fn marker(it: &Marker) -> v1::Marker {
    v1::Marker {
        name: it.name.clone(),
        region: region(it.region).into(),
        head_fixed: it.head_fixed,
    }
}

fn basis_report(layout: &Layout) -> v1::BasisReport {
    let pair = |(first, second, correlation): &(String, String, f64)| v1::MusclePair {
        first: first.clone(),
        second: second.clone(),
        correlation: finite(*correlation),
    };
    v1::BasisReport {
        condition_upper: finite(layout.conditions[0]),
        condition_lower: finite(layout.conditions[1]),
        ambiguous: layout.ambiguous.iter().map(pair).collect(),
    }
}

fn count(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_import_start_names_the_field_that_is_refused() {
        let good = v1::ImportActorStart {
            actor_id: "actor-a".into(),
            ..Default::default()
        };
        assert_eq!(ImportStart::try_from(good.clone()).unwrap().unit, None);
        let cases = [
            (
                v1::ImportActorStart {
                    actor_id: "../x".into(),
                    ..good.clone()
                },
                "actor_id",
                "NAME",
            ),
            (
                v1::ImportActorStart {
                    display_name: "a\u{202E}b".into(),
                    ..good.clone()
                },
                "display_name",
                "NAME",
            ),
            (v1::ImportActorStart { unit: 9, ..good }, "unit", "ENUM"),
        ];
        for (start, field, reason) in cases {
            let error = ImportStart::try_from(start).unwrap_err();
            assert_eq!((error.field(), error.reason()), (field, reason));
        }
    }

    #[test]
    fn an_infinite_condition_number_leaves_as_a_finite_one() {
        assert_eq!(finite(f64::INFINITY).to_bits(), f64::MAX.to_bits());
        assert_eq!(finite(f64::NAN).to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn timestamps_before_1970_have_positive_nanos() {
        let before = timestamp(-1);
        assert_eq!((before.seconds, before.nanos), (-1, 999_999_999));
        assert_eq!(unix_nanos(&before), -1);
    }
}
