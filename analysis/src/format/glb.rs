//! Binary glTF 2.0: one mesh with morph targets, in meters.
//!
//! Only bytes that are in the file are read: no URI is followed, not even `data:`.
//! The glTF crate parses and validates the JSON; where the bytes of an accessor lie is computed here, because a file may
//! say anything about it.

mod accessor;
mod animation;
mod document;
mod error;
mod write;

pub use animation::{AnimationError, AnimationWriter};
pub use error::{AccessorProblem, GlbError};
pub use write::write;

use std::collections::BTreeMap;

use gltf::json::{self, Index, accessor::Accessor, mesh::Semantic, validation::Checked};
use serde::Deserialize;

use crate::face::actor::{MAX_DISPLACEMENTS, MAX_MUSCLES, MAX_TRIANGLES, MAX_VERTICES};
use accessor::Binary;

/// The first bytes of every GLB.
pub const MAGIC: [u8; 4] = *b"glTF";
/// Most bytes of the JSON chunk: 256 targets and 1,024 markers take a tenth of it.
pub const MAX_JSON_BYTES: usize = 4 << 20;
/// Most nodes; an exported head has a handful.
pub const MAX_NODES: usize = 4_096;

/// A mesh, its shapes, and what its file says about it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MorphMesh {
    /// Vertex positions, meters; may be non-finite.
    pub positions_m: Vec<[f32; 3]>,
    /// Vertex indices from 0; may name vertices that do not exist.
    pub triangles: Vec<[u32; 3]>,
    /// The shapes.
    pub targets: Vec<MorphTarget>,
    /// The mesh's `extras`, JSON.
    pub extras: Option<String>,
}

/// One shape, as displacements from the mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MorphTarget {
    /// From `extras.targetNames`.
    pub name: Option<String>,
    /// One entry a vertex, meters; may be non-finite.
    pub displacements_m: Vec<[f32; 3]>,
}

/// The convention of `mesh.extras.targetNames`; other keys are other people's.
#[derive(Default, Deserialize)]
struct TargetNames {
    #[serde(default, rename = "targetNames")]
    target_names: Option<Vec<String>>,
}

/// Reads the one mesh of a GLB.
///
/// # Errors
///
/// The first thing that is broken, unsupported, external or over a limit.
pub fn read(bytes: &[u8]) -> Result<MorphMesh, GlbError> {
    let (root, binary) = document::open(bytes)?;
    let (mesh, primitive) = document::only_mesh(&root)?;
    let data = Binary {
        root: &root,
        bytes: &binary,
    };
    let positions_m = data.vectors(position(&primitive.attributes)?)?;
    within("vertices", positions_m.len(), MAX_VERTICES)?;
    let indices = primitive.indices.ok_or(GlbError::NoIndices)?;
    let triangles = triangles(&data.indices(indices)?)?;
    let extras = mesh.extras.as_ref().map(|it| it.get().to_owned());
    let targets = targets(&data, primitive, positions_m.len(), extras.as_deref())?;
    Ok(MorphMesh {
        positions_m,
        triangles,
        targets,
        extras,
    })
}

fn within(what: &'static str, found: usize, limit: usize) -> Result<(), GlbError> {
    if found > limit {
        return Err(GlbError::TooMany { what, limit, found });
    }
    Ok(())
}

fn position(
    attributes: &BTreeMap<Checked<Semantic>, Index<Accessor>>,
) -> Result<Index<Accessor>, GlbError> {
    attributes
        .get(&Checked::Valid(Semantic::Positions))
        .copied()
        .ok_or(GlbError::NoPositions)
}

fn triangles(indices: &[u32]) -> Result<Vec<[u32; 3]>, GlbError> {
    let (whole, rest) = indices.as_chunks::<3>();
    if !rest.is_empty() {
        let found = indices.len();
        return Err(GlbError::IndexCount { found });
    }
    within("triangles", whole.len(), MAX_TRIANGLES)?;
    Ok(whole.to_vec())
}

fn targets(
    data: &Binary<'_>,
    primitive: &json::mesh::Primitive,
    n_vertices: usize,
    extras: Option<&str>,
) -> Result<Vec<MorphTarget>, GlbError> {
    let targets = primitive.targets.as_deref().unwrap_or_default();
    within("morph targets", targets.len(), MAX_MUSCLES)?;
    within(
        "displacements (targets × vertices)",
        targets.len().saturating_mul(n_vertices),
        MAX_DISPLACEMENTS,
    )?;
    let mut names = target_names(extras, targets.len())?.into_iter();
    let mut read = Vec::with_capacity(targets.len());
    for (target, shape) in targets.iter().enumerate() {
        let accessor = shape
            .positions
            .ok_or(GlbError::NoTargetPositions { target })?;
        let found = data.count(accessor);
        if found != Some(n_vertices) {
            return Err(GlbError::TargetCount {
                target,
                expected: n_vertices,
            });
        }
        read.push(MorphTarget {
            name: names.next(),
            displacements_m: data.vectors(accessor)?,
        });
    }
    Ok(read)
}

fn target_names(extras: Option<&str>, n_targets: usize) -> Result<Vec<String>, GlbError> {
    let Some(extras) = extras else {
        return Ok(Vec::new());
    };
    let names: TargetNames = serde_json::from_str(extras).map_err(|_| GlbError::TargetNames)?;
    match names.target_names {
        Some(names) if names.len() != n_targets => Err(GlbError::TargetNameCount {
            names: names.len(),
            targets: n_targets,
        }),
        names => Ok(names.unwrap_or_default()),
    }
}

#[cfg(test)]
mod tests;
