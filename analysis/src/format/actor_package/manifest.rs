//! The JSON of a package, strict: unknown keys, duplicate keys and unknown words are refused.
//!
//! serde's derived readers refuse a key they know twice, `deny_unknown_fields` the ones they do not know; `serde_json`
//! refuses nesting beyond 128, numbers beyond `f64`, lone surrogates and what follows the object.

use std::fmt;

use serde::{
    Deserialize, Deserializer, Serialize,
    de::{self, DeserializeOwned, MapAccess, SeqAccess, Visitor, value::MapAccessDeserializer},
};

use super::{FORMAT, PackageError};
use crate::{
    face::{
        actor::{Actor, MarkerPlace},
        marker::{Marker, VirtualMarker},
        muscle::Muscle,
        region::FaceRegion,
    },
    format::quoted,
    space::{LengthUnit, ModelPoint},
};

/// Most bytes of the JSON.
pub(super) const MAX_JSON_BYTES: usize = 1 << 20;

/// `actor.json` of a ZIP.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ZipManifest {
    pub(super) format: String,
    pub(super) display_name: String,
    pub(super) unit: Unit,
    pub(super) muscle_set: String,
    pub(super) neutral: String,
    pub(super) muscles: Vec<ZipMuscle>,
    pub(super) markers: Vec<MarkerEntry>,
}

/// `mesh.extras.frontalis` of a GLB.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GlbManifest {
    pub(super) format: String,
    pub(super) display_name: String,
    pub(super) muscle_set: String,
    pub(super) muscles: Vec<GlbMuscle>,
    pub(super) markers: Vec<MarkerEntry>,
}

#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ZipMuscle {
    pub(super) name: String,
    pub(super) region: Region,
    pub(super) shape: String,
}

#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GlbMuscle {
    pub(super) name: String,
    pub(super) region: Region,
}

#[derive(Debug, Deserialize, Serialize)]
#[serde(try_from = "MarkerKeys")]
pub(super) struct MarkerEntry {
    name: String,
    region: Region,
    position: Place,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    head_fixed: bool,
}

/// A marker as written: its place is the value of `position`, or `vertex`, or `triangle` with `barycentric` beside it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MarkerKeys {
    name: String,
    region: Region,
    position: Option<Place>,
    vertex: Option<usize>,
    triangle: Option<usize>,
    barycentric: Option<[f64; 3]>,
    #[serde(default)]
    head_fixed: bool,
}

impl TryFrom<MarkerKeys> for MarkerEntry {
    type Error = &'static str;

    fn try_from(keys: MarkerKeys) -> Result<Self, Self::Error> {
        let on_mesh = OnMesh {
            vertex: keys.vertex,
            triangle: keys.triangle,
            barycentric: keys.barycentric,
        };
        let position = match keys.position {
            Some(place) if on_mesh.is_empty() => place,
            Some(_) => return Err("a marker has two places"),
            None => on_mesh.place().ok_or(PLACE_EXPECTED)?,
        };
        Ok(Self {
            name: keys.name,
            region: keys.region,
            position,
            head_fixed: keys.head_fixed,
        })
    }
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub(super) enum Unit {
    #[serde(rename = "mm")]
    Millimeter,
    #[serde(rename = "cm")]
    Centimeter,
    #[serde(rename = "m")]
    Meter,
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Region {
    Upper,
    Lower,
}

/// Where a marker is: a point, a vertex, or a place on a triangle.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(untagged)]
enum Place {
    Point([f64; 3]),
    Vertex {
        vertex: usize,
    },
    Triangle {
        triangle: usize,
        barycentric: [f64; 3],
    },
}

/// Written out instead of `untagged`, whose errors say nothing.
impl<'de> Deserialize<'de> for Place {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(PlaceVisitor)
    }
}

struct PlaceVisitor;

impl<'de> Visitor<'de> for PlaceVisitor {
    type Value = Place;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "[x, y, z], {{vertex}} or {{triangle, barycentric}}")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, sequence: A) -> Result<Place, A::Error> {
        let point = de::value::SeqAccessDeserializer::new(sequence);
        Deserialize::deserialize(point).map(Place::Point)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Place, A::Error> {
        OnMesh::deserialize(MapAccessDeserializer::new(map))?
            .place()
            .ok_or_else(|| de::Error::custom(PLACE_EXPECTED))
    }
}

const PLACE_EXPECTED: &str = "expected a position, a vertex, or a triangle with barycentric";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OnMesh {
    vertex: Option<usize>,
    triangle: Option<usize>,
    barycentric: Option<[f64; 3]>,
}

impl OnMesh {
    fn is_empty(&self) -> bool {
        self.vertex.is_none() && self.triangle.is_none() && self.barycentric.is_none()
    }

    fn place(self) -> Option<Place> {
        match (self.vertex, self.triangle, self.barycentric) {
            (Some(vertex), None, None) => Some(Place::Vertex { vertex }),
            (None, Some(triangle), Some(barycentric)) => Some(Place::Triangle {
                triangle,
                barycentric,
            }),
            _ => None,
        }
    }
}

/// Reads a manifest; `place` says in errors where it was found.
pub(super) fn parse<T: DeserializeOwned>(
    bytes: &[u8],
    place: &'static str,
) -> Result<T, PackageError> {
    serde_json::from_slice(bytes).map_err(|error| PackageError::Json {
        place,
        line: error.line(),
        column: error.column(),
        message: quoted(&error.to_string()),
    })
}

pub(super) fn check_format(found: &str) -> Result<(), PackageError> {
    if found == FORMAT {
        return Ok(());
    }
    Err(PackageError::Format {
        found: quoted(found),
    })
}

/// Every marker of an actor, bound.
pub(super) fn markers_of(actor: &Actor) -> Vec<MarkerEntry> {
    let entry = |(marker, place): (&Marker, &VirtualMarker)| MarkerEntry {
        name: marker.name.clone(),
        region: marker.region.into(),
        position: Place::Triangle {
            triangle: place.triangle,
            barycentric: place.barycentric,
        },
        head_fixed: marker.head_fixed,
    };
    let places = actor.virtual_markers();
    actor.markers().iter().zip(places).map(entry).collect()
}

impl MarkerEntry {
    /// The marker, with a position stated in `unit` as centimeters.
    pub(super) fn into_marker(self, unit: LengthUnit) -> (Marker, MarkerPlace) {
        let place = match self.position {
            Place::Point(point) => {
                let [x_cm, y_cm, z_cm] = point.map(|it| it * unit.centimeters());
                MarkerPlace::Position(ModelPoint::new(x_cm, y_cm, z_cm))
            }
            Place::Vertex { vertex } => MarkerPlace::Vertex(vertex),
            Place::Triangle {
                triangle,
                barycentric,
            } => MarkerPlace::OnTriangle(VirtualMarker {
                triangle,
                barycentric,
            }),
        };
        let marker = Marker {
            name: self.name,
            region: self.region.into(),
            head_fixed: self.head_fixed,
        };
        (marker, place)
    }
}

/// A muscle from its entry.
pub(super) fn muscle(name: &str, region: Region) -> Muscle {
    Muscle {
        name: name.to_owned(),
        region: region.into(),
    }
}

impl From<Region> for FaceRegion {
    fn from(region: Region) -> Self {
        match region {
            Region::Upper => Self::Upper,
            Region::Lower => Self::Lower,
        }
    }
}

impl From<FaceRegion> for Region {
    fn from(region: FaceRegion) -> Self {
        match region {
            FaceRegion::Upper => Self::Upper,
            FaceRegion::Lower => Self::Lower,
        }
    }
}

impl From<Unit> for LengthUnit {
    fn from(unit: Unit) -> Self {
        match unit {
            Unit::Millimeter => Self::Millimeter,
            Unit::Centimeter => Self::Centimeter,
            Unit::Meter => Self::Meter,
        }
    }
}
