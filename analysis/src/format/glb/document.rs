//! The container and the JSON of a GLB: what is refused before any accessor is looked at.

use std::borrow::Cow;

use gltf::{
    binary::Glb,
    json::{
        self,
        mesh::{Mode, Semantic},
        validation::{Checked, Validate as _},
    },
};

use super::{AccessorProblem, GlbError, MAX_JSON_BYTES, MAX_NODES};
use crate::format::quoted;

/// The JSON and the binary chunk of a GLB.
pub(super) fn open(bytes: &[u8]) -> Result<(json::Root, Cow<'_, [u8]>), GlbError> {
    check_header(bytes)?;
    let glb =
        Glb::from_slice(bytes).map_err(|_| GlbError::Container("its chunks do not add up"))?;
    let root: json::Root =
        json::deserialize::from_slice(&glb.json).map_err(|error| GlbError::Json {
            line: error.line(),
            column: error.column(),
            message: quoted(&error.to_string()),
        })?;
    check_self_contained(&root)?;
    check_nodes(&root)?;
    check_positions(&root)?;
    validate(&root)?;
    Ok((root, glb.bin.unwrap_or_default()))
}

/// The glTF crate subtracts from the header's length without looking, and believes the JSON chunk's.
fn check_header(bytes: &[u8]) -> Result<(), GlbError> {
    let word = |at: usize| {
        bytes
            .get(at..at + 4)
            .and_then(|it| it.try_into().ok())
            .map(u32::from_le_bytes)
    };
    let (Some(length), Some(json_length)) = (word(8), word(12)) else {
        return Err(GlbError::Container("it ends in its header"));
    };
    if length as usize != bytes.len() {
        return Err(GlbError::Container("its length is not that of its header"));
    }
    let found = json_length as usize;
    if found > MAX_JSON_BYTES {
        return Err(GlbError::JsonSize { found });
    }
    Ok(())
}

fn check_self_contained(root: &json::Root) -> Result<(), GlbError> {
    let buffer = root.buffers.iter().position(|it| it.uri.is_some());
    let image = root.images.iter().position(|it| it.uri.is_some());
    for (what, found) in [("buffer", buffer), ("image", image)] {
        if let Some(index) = found {
            return Err(GlbError::ExternalReference { what, index });
        }
    }
    if !root.extensions_required.is_empty() {
        const NAMED: usize = 8;
        let names = root.extensions_required.iter().take(NAMED);
        return Err(GlbError::RequiredExtension {
            names: names.map(|name| quoted(name)).collect(),
        });
    }
    Ok(())
}

/// The validator looks at the accessor of every mesh's positions without asking whether there is one.
fn check_positions(root: &json::Root) -> Result<(), GlbError> {
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let positions = primitives.filter_map(|primitive| {
        primitive
            .attributes
            .get(&Checked::Valid(Semantic::Positions))
    });
    for accessor in positions.map(json::Index::value) {
        if accessor >= root.accessors.len() {
            return Err(GlbError::Accessor {
                accessor,
                problem: AccessorProblem::Dangling,
            });
        }
    }
    Ok(())
}

/// Reports the first thing the validator finds.
fn validate(root: &json::Root) -> Result<(), GlbError> {
    let mut first = None;
    root.validate(root, json::Path::new, &mut |path, error| {
        first.get_or_insert_with(|| (path(), error));
    });
    match first {
        Some((path, error)) => Err(GlbError::Invalid {
            path: quoted(path.as_str()),
            message: error.to_string(),
        }),
        None => Ok(()),
    }
}

/// The nodes are a forest that leaves every mesh where it is.
fn check_nodes(root: &json::Root) -> Result<(), GlbError> {
    let found = root.nodes.len();
    if found > MAX_NODES {
        return Err(GlbError::Nodes { found });
    }
    let parents = parents(root)?;
    for start in 0..found {
        let carries_mesh = root.nodes[start].mesh.is_some();
        let mut next = Some(start);
        // With one parent each, a walk longer than the nodes is a circle.
        for _ in 0..=found {
            let Some(node) = next else { break };
            if carries_mesh && is_transformed(&root.nodes[node]) {
                return Err(GlbError::Transformed { node });
            }
            next = parents[node];
        }
        if next.is_some() {
            return Err(GlbError::NodeTree { node: start });
        }
    }
    Ok(())
}

fn parents(root: &json::Root) -> Result<Vec<Option<usize>>, GlbError> {
    let mut parents = vec![None; root.nodes.len()];
    for (node, parent) in root.nodes.iter().enumerate() {
        for child in parent.children.iter().flatten().map(json::Index::value) {
            match parents.get_mut(child) {
                Some(slot @ None) => *slot = Some(node),
                _ => return Err(GlbError::NodeTree { node: child }),
            }
        }
    }
    Ok(parents)
}

fn is_transformed(node: &json::Node) -> bool {
    const IDENTITY: [f32; 16] = [
        1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    ];
    let differs = |given: &[f32], identity: &[f32]| given != identity;
    node.matrix.is_some_and(|it| differs(&it, &IDENTITY))
        || node.translation.is_some_and(|it| differs(&it, &[0.0; 3]))
        || node.scale.is_some_and(|it| differs(&it, &[1.0; 3]))
        || node
            .rotation
            .is_some_and(|it| differs(&it.0[..3], &[0.0; 3]))
}

/// The mesh and its primitive, when there is exactly one of each.
pub(super) fn only_mesh(
    root: &json::Root,
) -> Result<(&json::Mesh, &json::mesh::Primitive), GlbError> {
    let [mesh] = &root.meshes[..] else {
        let found = root.meshes.len();
        return Err(GlbError::Meshes { found });
    };
    let [primitive] = &mesh.primitives[..] else {
        let found = mesh.primitives.len();
        return Err(GlbError::Primitives { found });
    };
    if primitive.mode != Checked::Valid(Mode::Triangles) {
        return Err(GlbError::NotTriangles);
    }
    Ok((mesh, primitive))
}
