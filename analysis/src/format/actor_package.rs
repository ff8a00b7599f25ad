//! Actor packages, `frontalis-actor/1`: an artist's neutral face, one shape a muscle, and the markers.
//!
//! Two containers hold the same content. A ZIP has `actor.json` and OBJ files in the package's unit; a GLB has one mesh
//! in meters with morph targets, and the same object in `mesh.extras.frontalis`.
//! Lengths are rounded to what a GLB holds, `f32` meters (less than a hundredth of a micrometer on a face), whichever way they
//! came: so both containers of one actor give the same bits, and what was read and is written reads back the same.

mod archive;
mod error;
mod in_glb;
mod in_zip;
mod manifest;

pub use error::PackageError;

use crate::{
    face::actor::{Actor, ActorParts, ActorWarning, RankPolicy},
    format::glb::{self, MorphMesh},
    space::LengthUnit,
};

/// The name of the format and its version.
pub const FORMAT: &str = "frontalis-actor/1";
/// Most bytes of a package.
pub const MAX_PACKAGE_BYTES: usize = 64 << 20;

/// An actor from a package.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadActor {
    /// The actor, in centimeters.
    pub actor: Actor,
    /// What is odd about it.
    pub warnings: Vec<ActorWarning>,
    /// The unit in which the package states lengths; meters for a GLB.
    pub unit: LengthUnit,
}

/// Reads a package; its first bytes tell ZIP from GLB.
///
/// # Errors
///
/// The first thing that is wrong, with file and line where there are any; nothing of the package is kept.
pub fn read(bytes: &[u8], rank: RankPolicy) -> Result<ReadActor, PackageError> {
    if bytes.len() > MAX_PACKAGE_BYTES {
        return Err(PackageError::PackageSize { found: bytes.len() });
    }
    let (parts, unit) = match bytes {
        [b'P', b'K', ..] => in_zip::read(bytes)?,
        _ if bytes.starts_with(&glb::MAGIC) => in_glb::read(bytes)?,
        _ if archive::is_compressed(bytes) => return Err(PackageError::Compressed),
        _ => return Err(PackageError::UnknownContainer),
    };
    let (actor, warnings) = Actor::new(rounded(parts), rank)?;
    Ok(ReadActor {
        actor,
        warnings,
        unit,
    })
}

/// The parts with every length as a GLB holds it.
fn rounded(mut parts: ActorParts) -> ActorParts {
    for vertex in &mut parts.mesh.vertices {
        vertex.0.coords = in_glb::rounded(&vertex.0.coords);
    }
    for displacement in parts.basis.displacements_cm.iter_mut().flatten() {
        *displacement = in_glb::rounded(displacement);
    }
    parts
}

/// Writes an actor as a ZIP of `actor.json` and OBJ files, in centimeters; the same actor gives the same bytes.
pub fn write_zip(actor: &Actor) -> Vec<u8> {
    in_zip::write(actor)
}

/// Writes an actor as a GLB, in meters; the same actor gives the same bytes.
pub fn write_glb(actor: &Actor) -> Vec<u8> {
    in_glb::write(actor)
}

/// An actor's neutral face with one morph target a muscle, meters: the mesh of [`write_glb`].
pub fn morph_mesh(actor: &Actor) -> MorphMesh {
    in_glb::morph_mesh(actor)
}

#[cfg(test)]
mod tests;
