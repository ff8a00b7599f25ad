//! Writing a mesh with morph targets.

use std::borrow::Cow;

use gltf::binary::{Glb, Header};
use serde_json::{Map, Value, json};

use super::{MAGIC, MorphMesh};

pub(super) const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// Writes `mesh` as a GLB with one node, its targets as sparse accessors where that is shorter.
///
/// `targetNames` joins `extras`, which must be a JSON object. Target names must all be there, or none.
pub fn write(mesh: &MorphMesh, extras: Map<String, Value>) -> Vec<u8> {
    let mut file = Parts::default();
    let face = face(&mut file, mesh, extras);
    file.finish(&face)
}

/// The mesh's JSON, with its bytes and accessors added to `file`.
pub(super) fn face(file: &mut Parts, mesh: &MorphMesh, mut extras: Map<String, Value>) -> Value {
    let positions = file.vectors(&mesh.positions_m, Some(ARRAY_BUFFER));
    let indices = file.indices(&mesh.triangles);
    let targets: Vec<_> = mesh
        .targets
        .iter()
        .map(|target| json!({ "POSITION": file.target(&target.displacements_m) }))
        .collect();
    let names: Option<Vec<_>> = mesh.targets.iter().map(|it| it.name.as_deref()).collect();
    extras.insert("targetNames".to_owned(), json!(names));
    let mut primitive = json!({ "attributes": { "POSITION": positions }, "indices": indices });
    let mut one_mesh = json!({ "name": "face", "extras": extras });
    if !targets.is_empty() {
        one_mesh["weights"] = json!(vec![0.0; targets.len()]);
        primitive["targets"] = Value::Array(targets);
    }
    one_mesh["primitives"] = json!([primitive]);
    one_mesh
}

/// The growing lists of a document.
#[derive(Default)]
pub(super) struct Parts {
    pub(super) bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Parts {
    pub(super) fn view(
        &mut self,
        bytes: impl IntoIterator<Item = u8>,
        target: Option<u32>,
    ) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let mut view = json!({
            "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start,
        });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        self.views.len() - 1
    }

    /// A view of bytes that are written behind all others.
    pub(super) fn view_of_bytes_to_come(&mut self, n_bytes: u64) -> usize {
        let start = self.bytes.len();
        self.views
            .push(json!({ "buffer": 0, "byteOffset": start, "byteLength": n_bytes }));
        self.views.len() - 1
    }

    pub(super) fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn vectors(&mut self, vectors: &[[f32; 3]], target: Option<u32>) -> usize {
        let view = self.view(bytes_of(vectors), target);
        let (min, max) = range(vectors.iter());
        self.accessor(json!({
            "bufferView": view, "componentType": FLOAT, "count": vectors.len(), "type": "VEC3",
            "min": min, "max": max,
        }))
    }

    fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let bytes = triangles.iter().flatten().flat_map(|it| it.to_le_bytes());
        let view = self.view(bytes, Some(ELEMENT_ARRAY_BUFFER));
        self.accessor(json!({
            "bufferView": view, "componentType": UNSIGNED_INT, "count": 3 * triangles.len(), "type": "SCALAR",
        }))
    }

    /// A target is written sparse when index and value of the moved vertices are shorter than all values.
    fn target(&mut self, displacements: &[[f32; 3]]) -> usize {
        let moved: Vec<u32> = (0u32..)
            .zip(displacements)
            .filter(|(_, displacement)| displacement.iter().any(|axis| axis.abs() > 0.0))
            .map(|(vertex, _)| vertex)
            .collect();
        if moved.is_empty() || moved.len() * 16 >= displacements.len() * 12 {
            return self.vectors(displacements, None);
        }
        let values: Vec<_> = moved
            .iter()
            .map(|&vertex| displacements[vertex as usize])
            .collect();
        let indices = self.view(moved.iter().flat_map(|it| it.to_le_bytes()), None);
        let values_view = self.view(bytes_of(&values), None);
        let (min, max) = range(values.iter().chain([&[0.0; 3]]));
        self.accessor(json!({
            "componentType": FLOAT, "count": displacements.len(), "type": "VEC3", "min": min, "max": max,
            "sparse": {
                "count": moved.len(),
                "indices": { "bufferView": indices, "componentType": UNSIGNED_INT },
                "values": { "bufferView": values_view },
            },
        }))
    }

    /// The document of one node with this mesh, beside `n_bytes` of binary data.
    pub(super) fn document(&mut self, mesh: &Value, n_bytes: u64) -> Value {
        json!({
            "asset": { "version": "2.0", "generator": concat!("frontalis ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0, "name": "face" }],
            "meshes": [mesh],
            "accessors": std::mem::take(&mut self.accessors),
            "bufferViews": std::mem::take(&mut self.views),
            "buffers": [{ "byteLength": n_bytes }],
        })
    }

    fn finish(mut self, mesh: &Value) -> Vec<u8> {
        let document = self.document(mesh, self.bytes.len() as u64);
        let glb = Glb {
            header: Header {
                magic: MAGIC,
                version: 2,
                length: 0,
            },
            json: Cow::Owned(document.to_string().into_bytes()),
            bin: Some(Cow::Owned(self.bytes)),
        };
        glb.to_vec().expect("invariant: a Vec accepts every write")
    }
}

fn bytes_of(vectors: &[[f32; 3]]) -> impl Iterator<Item = u8> {
    vectors.iter().flatten().flat_map(|it| it.to_le_bytes())
}

/// Least and greatest of each component, which glTF demands of positions.
fn range<'a>(vectors: impl Iterator<Item = &'a [f32; 3]>) -> ([f32; 3], [f32; 3]) {
    let start = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    vectors.fold(start, |(min, max), vector| {
        let least = std::array::from_fn(|axis| min[axis].min(vector[axis]));
        let greatest = std::array::from_fn(|axis| max[axis].max(vector[axis]));
        (least, greatest)
    })
}
