//! An actor as `actor.json` beside OBJ files.

use nalgebra::Vector3;

use super::{
    FORMAT, PackageError,
    archive::{Archive, MAX_FILE_BYTES, pack},
    manifest::{self, MAX_JSON_BYTES, Unit, ZipManifest, ZipMuscle},
};
use crate::{
    face::{
        actor::{Actor, ActorError, ActorParts, MAX_DISPLACEMENTS, MAX_MUSCLES},
        basis::ActuationBasis,
        mesh::FaceMesh,
    },
    format::{
        obj::{self, Obj},
        quoted,
    },
    space::{LengthUnit, ModelPoint},
};

const MANIFEST: &str = "actor.json";
const NEUTRAL: &str = "neutral.obj";

pub(super) fn read(bytes: &[u8]) -> Result<(ActorParts, LengthUnit), PackageError> {
    let mut archive = Archive::open(bytes)?;
    let text = archive.file(MANIFEST, MAX_JSON_BYTES)?;
    let manifest: ZipManifest = manifest::parse(&text, MANIFEST)?;
    manifest::check_format(&manifest.format)?;
    let unit = LengthUnit::from(manifest.unit);
    let neutral = object(&mut archive, &manifest.neutral)?;
    if neutral.triangles.is_empty() {
        let file = quoted(&manifest.neutral);
        return Err(PackageError::NoFaces { file });
    }
    check_size(manifest.muscles.len(), neutral.vertices.len())?;
    let displacements_cm = manifest
        .muscles
        .iter()
        .map(|muscle| displacements_cm(&mut archive, muscle, &neutral, unit))
        .collect::<Result<_, _>>()?;
    let position = |vertex: &[f64; 3]| ModelPoint(in_cm(*vertex, unit).into());
    let markers = manifest.markers.into_iter();
    let parts = ActorParts {
        display_name: manifest.display_name,
        muscle_set: manifest.muscle_set,
        mesh: FaceMesh {
            vertices: neutral.vertices.iter().map(position).collect(),
            triangles: neutral.triangles,
        },
        muscles: manifest
            .muscles
            .iter()
            .map(|it| manifest::muscle(&it.name, it.region))
            .collect(),
        basis: ActuationBasis { displacements_cm },
        markers: markers.map(|it| it.into_marker(unit)).collect(),
    };
    Ok((parts, unit))
}

/// Before any shape is unpacked: what they would come to.
pub(super) fn check_size(muscles: usize, vertices: usize) -> Result<(), ActorError> {
    let displacements = muscles.saturating_mul(vertices);
    let (what, limit, found) = if muscles > MAX_MUSCLES {
        ("muscles", MAX_MUSCLES, muscles)
    } else {
        (
            "displacements (muscles × vertices)",
            MAX_DISPLACEMENTS,
            displacements,
        )
    };
    if found > limit {
        return Err(ActorError::TooMany { what, limit, found });
    }
    Ok(())
}

fn object(archive: &mut Archive<'_>, path: &str) -> Result<Obj, PackageError> {
    let bytes = archive.file(path, MAX_FILE_BYTES)?;
    obj::parse(&bytes).map_err(|error| PackageError::Obj {
        file: quoted(path),
        error,
    })
}

fn displacements_cm(
    archive: &mut Archive<'_>,
    muscle: &ZipMuscle,
    neutral: &Obj,
    unit: LengthUnit,
) -> Result<Vec<Vector3<f64>>, PackageError> {
    let shape = object(archive, &muscle.shape)?;
    let (expected, found) = (neutral.vertices.len(), shape.vertices.len());
    if expected != found {
        return Err(PackageError::from(ActorError::VertexCount {
            shape: quoted(&muscle.shape),
            expected,
            found,
        }));
    }
    if !shape.triangles.is_empty() && shape.triangles != neutral.triangles {
        let file = quoted(&muscle.shape);
        return Err(PackageError::Topology { file });
    }
    let pairs = shape.vertices.iter().zip(&neutral.vertices);
    Ok(pairs
        .map(|(moved, rest)| in_cm(*moved, unit) - in_cm(*rest, unit))
        .collect())
}

fn in_cm(vertex: [f64; 3], unit: LengthUnit) -> Vector3<f64> {
    Vector3::from(vertex) * unit.centimeters()
}

pub(super) fn write(actor: &Actor) -> Vec<u8> {
    let muscles = actor.muscle_set().muscles();
    let paths: Vec<_> = muscles
        .iter()
        .enumerate()
        .map(|(index, muscle)| shape_path(index, &muscle.name))
        .collect();
    let manifest = ZipManifest {
        format: FORMAT.to_owned(),
        display_name: actor.display_name().to_owned(),
        unit: Unit::Centimeter,
        muscle_set: actor.muscle_set().id().to_owned(),
        neutral: NEUTRAL.to_owned(),
        muscles: muscles
            .iter()
            .zip(&paths)
            .map(|(muscle, path)| ZipMuscle {
                name: muscle.name.clone(),
                region: muscle.region.into(),
                shape: path.clone(),
            })
            .collect(),
        markers: manifest::markers_of(actor),
    };
    let text = serde_json::to_string_pretty(&manifest)
        .expect("invariant: names and finite numbers are always JSON");
    let neutral = actor.mesh().vertices.iter().map(|it| it.0.coords.into());
    let neutral = obj::write(neutral, &actor.mesh().triangles);
    let shapes = (0..muscles.len()).map(|muscle| obj::write(shape(actor, muscle), &[]));
    pack(
        [(MANIFEST.to_owned(), text), (NEUTRAL.to_owned(), neutral)]
            .into_iter()
            .chain(paths.into_iter().zip(shapes)),
    )
}

/// `shapes/03_levator_labii_left.obj`; the number keeps names apart that differ only in case or punctuation.
fn shape_path(index: usize, name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = name.chars().map(plain).collect();
    format!("shapes/{index:03}_{name}.obj")
}

/// Eᵢ = E₀ + eᵢ, rounded so that reading it back gives eᵢ again wherever that is possible.
fn shape(actor: &Actor, muscle: usize) -> impl Iterator<Item = [f64; 3]> {
    let moved = &actor.basis().displacements_cm[muscle];
    actor.mesh().vertices.iter().zip(moved).map(|(rest, by)| {
        let axis = |axis: usize| shifted(rest.0[axis], by[axis]);
        [axis(0), axis(1), axis(2)]
    })
}

/// The number whose difference from `rest` rounds to `by`: the rounded sum, or one of its neighbors.
fn shifted(rest: f64, by: f64) -> f64 {
    let sum = rest + by;
    #[expect(
        clippy::float_cmp,
        reason = "the exact bits are what a round trip must keep"
    )]
    let returns = |moved: &f64| *moved - rest == by;
    [sum, sum.next_up(), sum.next_down()]
        .into_iter()
        .find(returns)
        .unwrap_or(sum)
}
