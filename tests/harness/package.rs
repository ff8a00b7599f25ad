//! Actor packages of a toy face, small enough to break in one place at a time.
//!
//! The face is a curved sheet of 7 × 7 vertices with three muscles and eight markers.

use std::{
    collections::BTreeMap,
    fmt::Write as _,
    io::{Cursor, Write as _},
};

use frontalis_analysis::{format::actor_package, synthesis::reference_face};
use serde_json::{Value, json};
use zip::{ZipWriter, write::SimpleFileOptions};

/// Vertices along one side of the sheet.
const SIDE: usize = 7;

/// The files of a ZIP package by their path.
pub type PackageFiles = BTreeMap<String, Vec<u8>>;

/// The muscles of the toy face: name, region, and how far and where each pulls.
const MUSCLES: [(&str, &str, Pull); 3] = [
    (
        "frontalis",
        "upper",
        Pull {
            at: [3.0, 5.0],
            by: [0.0, 1.0, 0.1],
        },
    ),
    (
        "zygomatic_left",
        "lower",
        Pull {
            at: [4.5, 1.5],
            by: [0.6, 0.6, 0.0],
        },
    ),
    (
        "jaw",
        "lower",
        Pull {
            at: [2.5, 0.5],
            by: [0.0, -1.2, -0.2],
        },
    ),
];

struct Pull {
    at: [f64; 2],
    by: [f64; 3],
}

/// The toy actor as the files of a ZIP package.
pub fn toy_files() -> PackageFiles {
    let mut files = PackageFiles::new();
    files.insert("actor.json".to_owned(), toy_json().to_string().into_bytes());
    files.insert("neutral.obj".to_owned(), obj(None, true));
    for (muscle, (name, ..)) in MUSCLES.iter().enumerate() {
        files.insert(format!("shapes/{name}.obj"), obj(Some(muscle), false));
    }
    files
}

/// `actor.json` of the toy actor.
pub fn toy_json() -> Value {
    let muscles: Vec<_> = MUSCLES
        .iter()
        .map(|(name, region, _)| json!({"name": name, "region": region, "shape": format!("shapes/{name}.obj")}))
        .collect();
    json!({
        "format": "frontalis-actor/1",
        "display_name": "Toy",
        "unit": "cm",
        "muscle_set": "toy-3",
        "neutral": "neutral.obj",
        "muscles": muscles,
        "markers": toy_markers(),
    })
}

fn toy_markers() -> Vec<Value> {
    [8, 10, 12, 15, 19, 30, 38, 40, 24, 36]
        .into_iter()
        .map(|vertex| {
            let region = if vertex / SIDE >= 4 { "upper" } else { "lower" };
            json!({"name": format!("marker_{vertex}"), "region": region, "vertex": vertex})
        })
        .collect()
}

/// One vertex of the sheet, moved by one muscle or by none, centimeters.
fn vertex(index: usize, muscle: Option<usize>) -> [f64; 3] {
    let (column, row) = ((index % SIDE) as f64, (index / SIDE) as f64);
    let away = (column - 3.0).powi(2) + (row - 3.0).powi(2);
    let neutral = [2.0 * (column - 3.0), 2.0 * (row - 3.0), 10.0 - 0.25 * away];
    let Some(muscle) = muscle else { return neutral };
    let Pull { at, by } = &MUSCLES[muscle].2;
    let weight = (-((column - at[0]).powi(2) + (row - at[1]).powi(2)) / 3.0).exp();
    [0, 1, 2].map(|axis| neutral[axis] + weight * by[axis])
}

fn triangles() -> Vec<[usize; 3]> {
    let corner = |row: usize, column: usize| row * SIDE + column;
    (0..SIDE - 1)
        .flat_map(|row| (0..SIDE - 1).map(move |column| (row, column)))
        .flat_map(|(row, column)| {
            let [a, b] = [corner(row, column), corner(row, column + 1)];
            let [c, d] = [corner(row + 1, column + 1), corner(row + 1, column)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

fn obj(muscle: Option<usize>, with_faces: bool) -> Vec<u8> {
    let mut text = String::from("# toy face\n");
    for index in 0..SIDE * SIDE {
        let [x, y, z] = vertex(index, muscle);
        writeln!(text, "v {x:.6} {y:.6} {z:.6}").unwrap();
    }
    if with_faces {
        for [a, b, c] in triangles() {
            writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).unwrap();
        }
    }
    text.into_bytes()
}

/// A ZIP archive of the files.
pub fn zip(files: &PackageFiles) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, bytes) in files {
        archive
            .start_file(path, SimpleFileOptions::default())
            .unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

/// The toy actor as the two chunks of a GLB: its JSON and its binary buffer.
pub fn toy_glb() -> (Value, Vec<u8>) {
    let mut buffer = Vec::new();
    let (mut views, mut accessors) = (Vec::new(), Vec::new());
    let mut add = |bytes: Vec<u8>, accessor: Value| {
        views.push(json!({"buffer": 0, "byteOffset": buffer.len(), "byteLength": bytes.len()}));
        buffer.extend(bytes);
        let mut accessor = accessor;
        accessor["bufferView"] = json!(views.len() - 1);
        accessors.push(accessor);
        accessors.len() - 1
    };
    let indices: Vec<u8> = triangles()
        .iter()
        .flatten()
        .flat_map(|&it| u32::try_from(it).unwrap().to_le_bytes())
        .collect();
    let n_indices = indices.len() / 4;
    let indices = add(
        indices,
        json!({"componentType": 5125, "count": n_indices, "type": "SCALAR"}),
    );
    let points = |muscle| {
        json!({
            "componentType": 5126, "count": SIDE * SIDE, "type": "VEC3",
            "min": [-1.0, -1.0, -1.0], "max": [1.0, 1.0, 1.0], "name": format!("{muscle:?}"),
        })
    };
    let neutral = add(positions_m(None), points(None));
    let targets: Vec<_> = (0..MUSCLES.len())
        .map(|muscle| json!({"POSITION": add(positions_m(Some(muscle)), points(Some(muscle)))}))
        .collect();
    let names: Vec<_> = MUSCLES.iter().map(|(name, ..)| *name).collect();
    let json = json!({
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": buffer.len()}],
        "bufferViews": views,
        "accessors": accessors,
        "scenes": [{"nodes": [0]}],
        "scene": 0,
        "nodes": [{"mesh": 0}],
        "meshes": [{
            "primitives": [{"attributes": {"POSITION": neutral}, "indices": indices, "targets": targets}],
            "extras": {"targetNames": names, "frontalis": toy_extras()},
        }],
    });
    (json, buffer)
}

fn toy_extras() -> Value {
    let mut extras = toy_json();
    let fields = extras.as_object_mut().unwrap();
    fields.remove("neutral");
    fields.remove("unit");
    for muscle in fields["muscles"].as_array_mut().unwrap() {
        muscle.as_object_mut().unwrap().remove("shape");
    }
    extras
}

/// Positions (or, of a muscle, displacements) in meters, as a GLB's buffer holds them.
#[expect(clippy::cast_possible_truncation, reason = "glTF is single precision")]
fn positions_m(muscle: Option<usize>) -> Vec<u8> {
    (0..SIDE * SIDE)
        .flat_map(|index| {
            let (moved, neutral) = (vertex(index, muscle), vertex(index, None));
            [0, 1, 2].map(|axis| match muscle {
                Some(_) => moved[axis] - neutral[axis],
                None => neutral[axis],
            })
        })
        .flat_map(|it| ((it / 100.0) as f32).to_le_bytes())
        .collect()
}

/// A GLB of a JSON chunk and a binary chunk, each padded to four bytes.
pub fn glb(json: &Value, buffer: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut buffer = buffer.to_vec();
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let length = 12 + 8 + text.len() + 8 + buffer.len();
    let word = |it: usize| u32::try_from(it).unwrap().to_le_bytes();
    let mut bytes = Vec::with_capacity(length);
    bytes.extend(b"glTF");
    bytes.extend(word(2));
    bytes.extend(word(length));
    bytes.extend(word(text.len()));
    bytes.extend(b"JSON");
    bytes.extend(text);
    bytes.extend(word(buffer.len()));
    bytes.extend(b"BIN\0");
    bytes.extend(buffer);
    bytes
}

/// The reference face as a GLB.
pub fn reference_package() -> Vec<u8> {
    actor_package::write_glb(&reference_face::actor())
}
