//! What the catalogue knows of an actor's revision without opening its package.

use frontalis_analysis::face::{marker::Marker, muscle::Muscle, region::FaceRegion};
use serde::{Deserialize, Serialize};

use super::CatalogueError;
use crate::name::ActorId;

/// Muscles, markers and figures of one revision.
///
/// Revisions of an actor share muscles and markers, so that a session can move between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// A person's name for the actor.
    pub display_name: String,
    /// The muscle vocabulary's id.
    pub muscle_set: String,
    /// In activation order.
    pub muscles: Vec<Muscle>,
    /// In the default order of a stream.
    pub markers: Vec<Marker>,
    /// Vertices of the neutral face.
    pub n_vertices: u32,
    /// Triangles of the neutral face.
    pub n_triangles: u32,
    /// Condition number of Q per region, upper then lower; infinite when a muscle cannot be told at all.
    pub conditions: [f64; 2],
    /// Pairs of muscles that the markers hardly tell apart, with their correlation.
    pub ambiguous: Vec<(String, String, f64)>,
    /// Imported in spite of a rank-deficient basis.
    pub regularized: bool,
}

/// A revision to be added.
#[derive(Clone, Debug)]
pub struct NewRevision {
    /// The actor, new or existing.
    pub actor: ActorId,
    /// What the package holds.
    pub layout: Layout,
    /// The package as it was uploaded.
    pub package: Vec<u8>,
}

/// A stored revision.
#[derive(Clone, Debug, PartialEq)]
pub struct ActorRevision {
    /// The actor.
    pub actor: ActorId,
    /// Counts from 1.
    pub revision: u32,
    /// When the actor was first imported, Unix nanoseconds.
    pub create_time_nanos: i64,
    /// What the package holds.
    pub layout: Layout,
}

impl Layout {
    /// Whether a session could move from `other` to this: the same muscles and markers in the same order.
    pub(super) fn check_same(&self, other: &Self, revision: u32) -> Result<(), CatalogueError> {
        if self.muscles != other.muscles {
            return Err(CatalogueError::LayoutChanged {
                what: "muscles",
                revision,
            });
        }
        if self.markers != other.markers {
            return Err(CatalogueError::LayoutChanged {
                what: "markers",
                revision,
            });
        }
        Ok(())
    }

    pub(super) fn to_text(&self) -> Result<String, CatalogueError> {
        serde_json::to_string(&Record::from(self)).map_err(|_| UNREADABLE)
    }

    pub(super) fn from_text(text: &str) -> Result<Self, CatalogueError> {
        let record: Record = serde_json::from_str(text).map_err(|_| UNREADABLE)?;
        record.try_into()
    }
}

const UNREADABLE: CatalogueError = CatalogueError::Unreadable {
    what: "actor summary",
};

/// The form in the database.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    display_name: String,
    muscle_set: String,
    muscles: Vec<(String, String)>,
    markers: Vec<(String, String, bool)>,
    n_vertices: u32,
    n_triangles: u32,
    /// JSON has no infinity: absent stands for it.
    conditions: [Option<f64>; 2],
    ambiguous: Vec<(String, String, f64)>,
    regularized: bool,
}

impl From<&Layout> for Record {
    fn from(layout: &Layout) -> Self {
        let muscle = |it: &Muscle| (it.name.clone(), it.region.name().to_owned());
        let marker = |it: &Marker| (it.name.clone(), it.region.name().to_owned(), it.head_fixed);
        Self {
            display_name: layout.display_name.clone(),
            muscle_set: layout.muscle_set.clone(),
            muscles: layout.muscles.iter().map(muscle).collect(),
            markers: layout.markers.iter().map(marker).collect(),
            n_vertices: layout.n_vertices,
            n_triangles: layout.n_triangles,
            conditions: layout.conditions.map(|it| it.is_finite().then_some(it)),
            ambiguous: layout.ambiguous.clone(),
            regularized: layout.regularized,
        }
    }
}

impl TryFrom<Record> for Layout {
    type Error = CatalogueError;

    fn try_from(record: Record) -> Result<Self, CatalogueError> {
        let muscle = |(name, region): (String, String)| {
            Ok(Muscle {
                name,
                region: region_of(&region)?,
            })
        };
        let marker = |(name, region, head_fixed): (String, String, bool)| {
            Ok(Marker {
                name,
                region: region_of(&region)?,
                head_fixed,
            })
        };
        Ok(Self {
            display_name: record.display_name,
            muscle_set: record.muscle_set,
            muscles: record
                .muscles
                .into_iter()
                .map(muscle)
                .collect::<Result<_, CatalogueError>>()?,
            markers: record
                .markers
                .into_iter()
                .map(marker)
                .collect::<Result<_, CatalogueError>>()?,
            n_vertices: record.n_vertices,
            n_triangles: record.n_triangles,
            conditions: record.conditions.map(|it| it.unwrap_or(f64::INFINITY)),
            ambiguous: record.ambiguous,
            regularized: record.regularized,
        })
    }
}

fn region_of(name: &str) -> Result<FaceRegion, CatalogueError> {
    let known = FaceRegion::ALL.into_iter().find(|it| it.name() == name);
    known.ok_or(UNREADABLE)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in crate::catalogue) fn layout() -> Layout {
        Layout {
            display_name: "Actor A".into(),
            muscle_set: "two".into(),
            muscles: vec![Muscle {
                name: "frontalis_left".into(),
                region: FaceRegion::Upper,
            }],
            markers: vec![Marker {
                name: "brow".into(),
                region: FaceRegion::Upper,
                head_fixed: true,
            }],
            n_vertices: 3,
            n_triangles: 1,
            conditions: [1.5, f64::INFINITY],
            ambiguous: vec![("a".into(), "b".into(), -0.25)],
            regularized: true,
        }
    }

    #[test]
    fn a_summary_reads_back_as_it_was_written() {
        let layout = layout();
        let back = Layout::from_text(&layout.to_text().unwrap()).unwrap();
        assert_eq!(back, layout);
    }

    #[test]
    fn a_summary_that_cannot_be_read_is_an_error() {
        for text in ["", "{}", "{\"display_name\": 3}"] {
            assert!(Layout::from_text(text).is_err(), "{text}");
        }
    }
}
