//! An actor as a GLB whose morph targets are the basis and whose mesh extras hold the rest.

use nalgebra::Vector3;
use serde::Deserialize;
use serde_json::Map;

use super::{
    FORMAT, PackageError,
    manifest::{self, GlbManifest, GlbMuscle},
};
use crate::{
    face::{
        actor::{Actor, ActorParts},
        basis::ActuationBasis,
        mesh::FaceMesh,
    },
    format::{
        glb::{self, MorphMesh, MorphTarget},
        quoted,
    },
    space::{LengthUnit, ModelPoint},
};

const PLACE: &str = "mesh.extras.frontalis";
const KEY: &str = "frontalis";
const UNIT: LengthUnit = LengthUnit::Meter;

/// Our part of the mesh's extras; other keys are other people's.
#[derive(Deserialize)]
struct Extras {
    frontalis: Option<GlbManifest>,
}

pub(super) fn read(bytes: &[u8]) -> Result<(ActorParts, LengthUnit), PackageError> {
    let mesh = glb::read(bytes)?;
    let extras = mesh.extras.as_deref().ok_or(PackageError::NotAnActor)?;
    if extras.len() > manifest::MAX_JSON_BYTES {
        return Err(PackageError::FileSize {
            file: PLACE.to_owned(),
            limit_bytes: manifest::MAX_JSON_BYTES,
        });
    }
    let extras: Extras = manifest::parse(extras.as_bytes(), PLACE)?;
    let manifest = extras.frontalis.ok_or(PackageError::NotAnActor)?;
    manifest::check_format(&manifest.format)?;
    let displacements_cm = manifest
        .muscles
        .iter()
        .map(|muscle| displacements_cm(&mesh, &muscle.name))
        .collect::<Result<_, _>>()?;
    let vertices = mesh.positions_m.iter();
    let markers = manifest.markers.into_iter();
    let parts = ActorParts {
        display_name: manifest.display_name,
        muscle_set: manifest.muscle_set,
        mesh: FaceMesh {
            vertices: vertices.map(|it| ModelPoint(in_cm(*it).into())).collect(),
            triangles: mesh.triangles,
        },
        muscles: manifest
            .muscles
            .iter()
            .map(|it| manifest::muscle(&it.name, it.region))
            .collect(),
        basis: ActuationBasis { displacements_cm },
        markers: markers.map(|it| it.into_marker(UNIT)).collect(),
    };
    Ok((parts, UNIT))
}

/// The target of the muscle's name; targets that no muscle names are shapes of other uses.
fn displacements_cm(mesh: &MorphMesh, muscle: &str) -> Result<Vec<Vector3<f64>>, PackageError> {
    let named: Vec<_> = mesh
        .targets
        .iter()
        .filter(|target| target.name.as_deref() == Some(muscle))
        .collect();
    let [target] = named[..] else {
        return Err(PackageError::MorphTarget {
            muscle: quoted(muscle),
            found: named.len(),
        });
    };
    Ok(target.displacements_m.iter().map(|it| in_cm(*it)).collect())
}

fn in_cm(vertex: [f32; 3]) -> Vector3<f64> {
    Vector3::from(vertex.map(f64::from)) * UNIT.centimeters()
}

/// A length or a displacement as it reads back from a GLB, centimeters.
pub(super) fn rounded(vector_cm: &Vector3<f64>) -> Vector3<f64> {
    in_cm(in_meters(vector_cm))
}

pub(super) fn write(actor: &Actor) -> Vec<u8> {
    let muscles = actor.muscle_set().muscles();
    let manifest = GlbManifest {
        format: FORMAT.to_owned(),
        display_name: actor.display_name().to_owned(),
        muscle_set: actor.muscle_set().id().to_owned(),
        muscles: muscles
            .iter()
            .map(|muscle| GlbMuscle {
                name: muscle.name.clone(),
                region: muscle.region.into(),
            })
            .collect(),
        markers: manifest::markers_of(actor),
    };
    let manifest = serde_json::to_value(&manifest)
        .expect("invariant: names and finite numbers are always JSON");
    let mesh = morph_mesh(actor);
    glb::write(&mesh, Map::from_iter([(KEY.to_owned(), manifest)]))
}

/// The neutral face, and its muscles at full contraction.
pub(super) fn morph_mesh(actor: &Actor) -> MorphMesh {
    let muscles = actor.muscle_set().muscles();
    let vertices = actor.mesh().vertices.iter();
    let targets = muscles.iter().zip(&actor.basis().displacements_cm);
    MorphMesh {
        positions_m: vertices.map(|it| in_meters(&it.0.coords)).collect(),
        triangles: actor.mesh().triangles.clone(),
        targets: targets
            .map(|(muscle, shape)| MorphTarget {
                name: Some(muscle.name.clone()),
                displacements_m: shape.iter().map(in_meters).collect(),
            })
            .collect(),
        extras: None,
    }
}

fn in_meters(vector_cm: &Vector3<f64>) -> [f32; 3] {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "glTF stores positions as f32; an actor's coordinates are within its range"
    )]
    let meters = |cm: f64| (cm / UNIT.centimeters()) as f32;
    [
        meters(vector_cm.x),
        meters(vector_cm.y),
        meters(vector_cm.z),
    ]
}
