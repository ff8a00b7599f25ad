//! What of a GLB is read, and what is refused of those that say wrong things about themselves.

use serde_json::{Map, Value, json};

use super::*;

fn small() -> MorphMesh {
    let mut raised = vec![[0.0; 3]; 8];
    raised[5] = [0.0, 0.5, -0.25];
    MorphMesh {
        positions_m: (0u8..8)
            .map(|it| [f32::from(it), 0.5, f32::from(it % 3)])
            .collect(),
        triangles: vec![[0, 1, 2], [2, 1, 3], [4, 5, 7]],
        targets: vec![
            MorphTarget {
                name: Some("raised".to_owned()),
                displacements_m: raised,
            },
            MorphTarget {
                name: Some("moved".to_owned()),
                displacements_m: vec![[0.25, -0.5, 0.0]; 8],
            },
            MorphTarget {
                name: Some("still".to_owned()),
                displacements_m: vec![[0.0; 3]; 8],
            },
        ],
        extras: None,
    }
}

fn chunks(bytes: &[u8]) -> (Value, Vec<u8>) {
    let glb = gltf::binary::Glb::from_slice(bytes).unwrap();
    let document = serde_json::from_slice(&glb.json).unwrap();
    (document, glb.bin.unwrap().into_owned())
}

fn glb_of(document: &str, binary: &[u8]) -> Vec<u8> {
    let header = gltf::binary::Header {
        magic: MAGIC,
        version: 2,
        length: 0,
    };
    let glb = gltf::binary::Glb {
        header,
        json: document.as_bytes().into(),
        bin: Some(binary.into()),
    };
    glb.to_vec().unwrap()
}

/// A valid file after a change of its JSON.
fn changed(change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let (mut document, binary) = chunks(&write(&small(), Map::new()));
    change(&mut document);
    glb_of(&document.to_string(), &binary)
}

fn refused(change: impl FnOnce(&mut Value)) -> GlbError {
    read(&changed(change)).unwrap_err()
}

fn refused_accessor(change: impl FnOnce(&mut Value)) -> AccessorProblem {
    match refused(change) {
        GlbError::Accessor { problem, .. } => problem,
        error => panic!("{error}"),
    }
}

/// The JSON of the accessors, as written: positions, indices, a sparse target, two dense ones.
const POSITIONS: usize = 0;
const INDICES: usize = 1;
const SPARSE: usize = 2;

#[test]
fn what_is_written_reads_back() {
    let mut read = read(&write(&small(), Map::new())).unwrap();
    assert!(read.extras.take().unwrap().contains("raised"));
    assert_eq!(read, small());
}

#[test]
fn a_target_of_few_moved_vertices_is_written_sparse() {
    let (document, _) = chunks(&write(&small(), Map::new()));
    let is_sparse = |it: usize| document["accessors"][it].get("sparse").is_some();
    assert!(is_sparse(SPARSE) && !is_sparse(SPARSE + 1) && !is_sparse(SPARSE + 2));
}

#[test]
fn the_file_follows_the_specification_that_the_gltf_crate_checks() {
    let bytes = write(&small(), Map::new());
    let gltf = gltf::Gltf::from_slice(&bytes).unwrap();
    let blob = gltf.blob.as_deref().unwrap();
    let primitive = gltf.meshes().next().unwrap().primitives().next().unwrap();
    let reader = primitive.reader(|_| Some(blob));
    assert_eq!(
        reader.read_positions().unwrap().collect::<Vec<_>>(),
        small().positions_m
    );
    let targets: Vec<_> = reader
        .read_morph_targets()
        .map(|(positions, ..)| positions.unwrap().collect::<Vec<_>>())
        .collect();
    let expected: Vec<_> = small()
        .targets
        .into_iter()
        .map(|it| it.displacements_m)
        .collect();
    assert_eq!(targets, expected);
}

#[test]
fn d8_counts_and_offsets_outside_the_buffer_are_refused() {
    let outside = [
        refused_accessor(|it| it["accessors"][POSITIONS]["count"] = json!(4_000_000_000_u32)),
        refused_accessor(|it| it["accessors"][POSITIONS]["count"] = json!(u64::MAX)),
        refused_accessor(|it| it["accessors"][POSITIONS]["count"] = json!(9)),
        refused_accessor(|it| it["accessors"][POSITIONS]["byteOffset"] = json!(u64::MAX)),
        refused_accessor(|it| it["accessors"][POSITIONS]["byteOffset"] = json!(1)),
        refused_accessor(|it| it["bufferViews"][0]["byteOffset"] = json!(u64::MAX)),
        refused_accessor(|it| it["bufferViews"][0]["byteLength"] = json!(u64::MAX)),
        refused_accessor(|it| it["bufferViews"][0]["byteStride"] = json!(252)),
        refused_accessor(|it| it["accessors"][INDICES]["count"] = json!(3_000_000_000_u32)),
    ];
    assert!(
        outside.iter().all(|it| *it == AccessorProblem::Outside),
        "{outside:?}"
    );
}

#[test]
fn d8_strides_types_and_references_that_cannot_be_are_refused() {
    let stride = refused_accessor(|it| it["bufferViews"][0]["byteStride"] = json!(4));
    assert_eq!(stride, AccessorProblem::Stride);
    for stride in [0, 1, 253] {
        let error = refused(|it| it["bufferViews"][0]["byteStride"] = json!(stride));
        assert_eq!(error.reason(), "GLTF");
    }
    for (accessor, key, value) in [
        (POSITIONS, "componentType", json!(5123)),
        (POSITIONS, "type", json!("VEC4")),
        (POSITIONS, "normalized", json!(true)),
        (INDICES, "componentType", json!(5126)),
        (INDICES, "type", json!("VEC3")),
    ] {
        let problem = refused_accessor(|it| it["accessors"][accessor][key] = value);
        assert_eq!(problem, AccessorProblem::Type, "{key}");
    }
    let empty = refused_accessor(|it| it["accessors"][POSITIONS]["count"] = json!(0));
    assert_eq!(empty, AccessorProblem::Empty);
    for (place, value) in [
        ("/accessors/0/bufferView", json!(99)),
        ("/accessors/0/componentType", json!(1)),
        ("/accessors/0/count", json!(-1)),
        ("/accessors/0/count", json!(1.5)),
        ("/accessors/0/type", json!("VEC9")),
        ("/bufferViews/0/buffer", json!(1)),
        ("/meshes/0/primitives/0/indices", json!(99)),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(99)),
        ("/meshes/0/primitives/0/targets/0/POSITION", json!(99)),
        ("/scenes/0/nodes/0", json!(99)),
        ("/nodes/0/mesh", json!(99)),
        ("/asset/version", json!(3)),
    ] {
        let error =
            refused(|it| *it.pointer_mut(place).unwrap_or_else(|| panic!("{place}")) = value);
        assert_eq!(error.reason(), "GLTF", "{place}: {error}");
    }
}

#[test]
fn d8_sparse_accessors_are_no_bombs() {
    let sparse =
        |change: fn(&mut Value)| move |it: &mut Value| change(&mut it["accessors"][SPARSE]);
    let huge = refused(sparse(|it| it["count"] = json!(4_000_000_000_u32)));
    assert_eq!(
        huge,
        GlbError::TargetCount {
            target: 0,
            expected: 8
        }
    );
    let no_base = refused_accessor(|it| {
        it["accessors"][SPARSE]["count"] = json!(4_000_000_000_u32);
        it["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(SPARSE);
    });
    assert_eq!(no_base, AccessorProblem::Count);
    let more = refused_accessor(sparse(|it| {
        it["sparse"]["count"] = json!(4_000_000_000_u32);
    }));
    assert_eq!(more, AccessorProblem::Outside);
    let kind = refused(sparse(|it| {
        it["sparse"]["indices"]["componentType"] = json!(5126);
    }));
    assert_eq!(kind.reason(), "GLTF");
    let swapped = refused_accessor(sparse(|it| {
        let values = it["sparse"]["values"]["bufferView"].clone();
        it["sparse"]["indices"]["bufferView"] = values;
        it["sparse"]["indices"]["byteOffset"] = json!(4);
    }));
    assert_eq!(swapped, AccessorProblem::SparseIndices);
}

#[test]
fn d8_nodes_in_a_circle_too_many_or_with_two_parents_are_refused() {
    let circle =
        refused(|it| it["nodes"] = json!([{ "mesh": 0, "children": [1] }, { "children": [0] }]));
    assert_eq!(circle, GlbError::NodeTree { node: 0 });
    let apart = refused(|it| {
        it["nodes"] = json!([{ "mesh": 0 }, { "children": [2] }, { "children": [1] }]);
    });
    assert_eq!(apart, GlbError::NodeTree { node: 1 });
    let own = refused(|it| it["nodes"] = json!([{ "mesh": 0, "children": [0] }]));
    assert_eq!(own, GlbError::NodeTree { node: 0 });
    let two = refused(|it| {
        it["nodes"] = json!([{ "mesh": 0 }, { "children": [0] }, { "children": [0] }]);
    });
    assert_eq!(two, GlbError::NodeTree { node: 0 });
    let beyond = refused(|it| it["nodes"] = json!([{ "mesh": 0, "children": [7] }]));
    assert_eq!(beyond, GlbError::NodeTree { node: 7 });
    let deep: Vec<_> = (0..100_000)
        .map(|it| json!({ "children": [it + 1] }))
        .collect();
    let deep = refused(|it| it["nodes"] = json!(deep));
    assert_eq!(deep, GlbError::Nodes { found: 100_000 });
    let as_deep_as_allowed: Vec<_> = (1..MAX_NODES)
        .map(|it| json!({ "children": [it] }))
        .chain([json!({ "mesh": 0 })])
        .collect();
    assert!(read(&changed(|it| it["nodes"] = json!(as_deep_as_allowed))).is_ok());
}

#[test]
fn a_node_that_moves_the_mesh_is_refused() {
    for (key, value) in [
        ("translation", json!([0, 0, 1])),
        ("scale", json!([0.01, 0.01, 0.01])),
        ("rotation", json!([0.5, 0.0, 0.0, 0.5])),
        (
            "matrix",
            json!([2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]),
        ),
    ] {
        let error = refused(|it| {
            it["nodes"] = json!([{ "mesh": 0 }, { "children": [0] }]);
            it["nodes"][1][key] = value;
        });
        assert_eq!(error, GlbError::Transformed { node: 1 }, "{key}");
    }
    let still = changed(|it| it["nodes"][0]["scale"] = json!([1, 1, 1]));
    assert!(read(&still).is_ok());
}

#[test]
fn d9_nothing_outside_the_file_is_referred_to() {
    let data = format!(
        "data:application/octet-stream;base64,{}",
        "A".repeat(1 << 20)
    );
    for uri in [
        "../x.bin",
        "/etc/passwd",
        "file:///etc/passwd",
        "http://example.org/x",
        &data,
    ] {
        let error = refused(|it| it["buffers"][0]["uri"] = json!(uri));
        assert_eq!(
            error,
            GlbError::ExternalReference {
                what: "buffer",
                index: 0
            }
        );
        assert_eq!(error.reason(), "EXTERNAL_REFERENCE");
        let error = refused(|it| it["images"] = json!([{ "uri": uri }]));
        assert_eq!(
            error,
            GlbError::ExternalReference {
                what: "image",
                index: 0
            }
        );
    }
}

#[test]
fn d10_required_extensions_are_refused_by_name() {
    for name in [
        "KHR_draco_mesh_compression",
        "EXT_meshopt_compression",
        "KHR_mesh_quantization",
        "ACME_x",
    ] {
        let error = refused(|it| {
            it["extensionsUsed"] = json!([name]);
            it["extensionsRequired"] = json!([name]);
        });
        assert_eq!(error.reason(), "GLTF_EXTENSION");
        assert!(error.to_string().ends_with(name), "{error}");
    }
}

#[test]
fn d10_wrong_lengths_and_chunks_are_refused() {
    let good = write(&small(), Map::new());
    let with_word = |at: usize, word: u32| {
        let mut bytes = good.clone();
        bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
        bytes
    };
    let length = u32::try_from(good.len()).unwrap();
    let bad = [
        with_word(4, 1),
        with_word(8, 0),
        with_word(8, 11),
        with_word(8, length - 4),
        with_word(8, u32::MAX),
        with_word(12, length),
        with_word(12, u32::MAX),
        with_word(12, 4),
        with_word(16, u32::from_le_bytes(*b"BIN\0")),
        [&good[..], b"\0\0\0\0"].concat(),
        good[..19].to_vec(),
    ];
    for (index, bytes) in bad.iter().enumerate() {
        let error = read(bytes).unwrap_err();
        assert!(
            matches!(error.reason(), "GLTF" | "BASIS_SIZE"),
            "{index}: {error}"
        );
    }
    let (document, binary) = chunks(&good);
    let without_binary = read(&glb_of(&document.to_string(), &binary[..4])).unwrap_err();
    assert_eq!(without_binary.reason(), "GLTF");
}

#[test]
fn d12_json_that_is_no_gltf_is_refused() {
    for text in [
        "",
        "{}",
        "[]",
        "{\"asset\":{\"version\":\"2.0\"}}",
        &"[".repeat(100_000),
    ] {
        let error = read(&glb_of(text, &[0; 4])).unwrap_err();
        assert_eq!(error.reason(), "GLTF", "{error}");
    }
    let long = format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"extras\":\"{}\"}}",
        "x".repeat(MAX_JSON_BYTES)
    );
    assert_eq!(
        read(&glb_of(&long, &[0; 4])).unwrap_err().reason(),
        "BASIS_SIZE"
    );
}

#[test]
fn what_is_not_one_indexed_triangle_mesh_is_refused() {
    let primitive = |it: &Value| it["meshes"][0]["primitives"][0].clone();
    let two = refused(|it| it["meshes"][0]["primitives"] = json!([primitive(it), primitive(it)]));
    assert_eq!(two, GlbError::Primitives { found: 2 });
    let two = refused(|it| it["meshes"] = json!([it["meshes"][0], it["meshes"][0]]));
    assert_eq!(two, GlbError::Meshes { found: 2 });
    let strip = refused(|it| it["meshes"][0]["primitives"][0]["mode"] = json!(5));
    assert_eq!(strip, GlbError::NotTriangles);
    let unknown = refused(|it| it["meshes"][0]["primitives"][0]["mode"] = json!(9));
    assert_eq!(unknown.reason(), "GLTF");
    let names = refused(|it| it["meshes"][0]["extras"]["targetNames"] = json!(["one"]));
    assert_eq!(
        names,
        GlbError::TargetNameCount {
            names: 1,
            targets: 3
        }
    );
    let names = refused(|it| it["meshes"][0]["extras"]["targetNames"] = json!([1, 2, 3]));
    assert_eq!(names, GlbError::TargetNames);
    let pair = refused(|it| it["accessors"][INDICES]["count"] = json!(8));
    assert_eq!(pair, GlbError::IndexCount { found: 8 });
}
