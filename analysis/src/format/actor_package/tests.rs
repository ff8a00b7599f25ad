//! Packages that are read, and the reasons and words with which others are refused.

use std::io::{Cursor, Write as _};

use proptest::prelude::*;
use serde_json::{Value, json};
use zip::{CompressionMethod, ZipWriter, write::SimpleFileOptions};

use super::*;
use crate::{
    face::actor::{ActorError, tests::sheet},
    format::shared_data,
    space::ModelPoint,
};

const ACTORS: [&str; 3] = ["ict_muscle16_27", "ict_facs30_27", "ict_facs30_60"];

fn zip_with(files: &[(&str, &[u8])], method: CompressionMethod) -> Vec<u8> {
    let options = SimpleFileOptions::default().compression_method(method);
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, bytes) in files {
        zip.start_file(*path, options).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

const NEUTRAL: &str = "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n";
const RAISED: &str = "v 0 0 0\nv 9 0 0\nv 9 9 2\nv 0 9 0\n";
const PULLED: &str = "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 1 9 0\nf 1 2 3 4\n";

fn manifest() -> Value {
    json!({
        "format": FORMAT, "display_name": "Actor A", "unit": "cm", "muscle_set": "two",
        "neutral": "neutral.obj",
        "muscles": [
            { "name": "raiser", "region": "upper", "shape": "shapes/raiser.obj" },
            { "name": "puller", "region": "lower", "shape": "shapes/puller.obj" },
        ],
        "markers": [
            { "name": "a", "region": "upper", "position": [8.0, 8.0, 0.1] },
            { "name": "b", "region": "lower", "position": { "vertex": 3 } },
            { "name": "c", "region": "lower", "position": { "triangle": 1, "barycentric": [0.25, 0.25, 0.5] } },
            { "name": "d", "region": "upper", "vertex": 2, "head_fixed": true },
        ],
    })
}

/// A small valid package after `change`, with other files in place of some.
fn package(change: impl FnOnce(&mut Value), other: &[(&str, &str)]) -> Vec<u8> {
    let mut manifest = manifest();
    change(&mut manifest);
    with_text(&manifest.to_string(), other)
}

fn with_text(manifest: &str, other: &[(&str, &str)]) -> Vec<u8> {
    let mut files = vec![
        ("actor.json", manifest),
        ("neutral.obj", NEUTRAL),
        ("shapes/raiser.obj", RAISED),
        ("shapes/puller.obj", PULLED),
    ];
    for &(path, text) in other {
        files.retain(|(it, _)| *it != path);
        files.push((path, text));
    }
    let files: Vec<_> = files
        .iter()
        .map(|(path, text)| (*path, text.as_bytes()))
        .collect();
    zip_with(&files, CompressionMethod::Deflated)
}

fn accepted(bytes: &[u8]) -> ReadActor {
    read(bytes, RankPolicy::Refuse).unwrap_or_else(|error| panic!("{error}"))
}

fn refused(bytes: &[u8]) -> (&'static str, String) {
    let error = read(bytes, RankPolicy::Refuse).unwrap_err();
    (error.reason(), error.to_string())
}

fn sheet_actor() -> Actor {
    Actor::new(sheet(), RankPolicy::Refuse).unwrap().0
}

#[test]
fn a_package_is_read_with_its_markers_bound() {
    let read = accepted(&package(|_| {}, &[]));
    assert_eq!(read.unit, LengthUnit::Centimeter);
    assert_eq!(read.warnings, []);
    let actor = read.actor;
    assert_eq!(actor.display_name(), "Actor A");
    assert_eq!(actor.muscle_set().id(), "two");
    assert_eq!(actor.mesh().triangles, [[0, 1, 2], [0, 2, 3]]);
    // Lengths are those of f32 meters, a relative 6e-8 at most from what the package states.
    let moved = actor.basis().displacements_cm[0][2];
    assert!((moved - nalgebra::Vector3::new(0.0, 0.0, 2.0)).norm() < 2e-7);
    let at = |marker: usize| actor.virtual_markers()[marker].position(actor.mesh());
    assert!((at(0).0 - ModelPoint::new(8.0, 8.0, 0.0).0).norm() < 1e-12);
    assert_eq!(at(1), actor.mesh().vertices[3]);
    assert!((at(2).0 - ModelPoint::new(2.25, 6.75, 0.0).0).norm() < 1e-6);
    assert_eq!(at(3), actor.mesh().vertices[2]);
    assert!(actor.markers()[3].head_fixed && !actor.markers()[0].head_fixed);
}

#[test]
fn a_package_in_millimeters_is_read_in_centimeters() {
    let centimeters = accepted(&package(|_| {}, &[])).actor;
    let tenfold = |text: &str| {
        text.replace('9', "90")
            .replace(" 2\n", " 20\n")
            .replace("v 1 ", "v 10 ")
    };
    let (neutral, raised, pulled) = (tenfold(NEUTRAL), tenfold(RAISED), tenfold(PULLED));
    let read = accepted(&package(
        |it| {
            it["unit"] = json!("mm");
            it["markers"][0]["position"] = json!([80.0, 80.0, 1.0]);
        },
        &[
            ("neutral.obj", &neutral),
            ("shapes/raiser.obj", &raised),
            ("shapes/puller.obj", &pulled),
        ],
    ));
    assert_eq!(read.unit, LengthUnit::Millimeter);
    assert_eq!(read.actor, centimeters);
}

#[test]
fn a_zip_that_was_written_reads_back_to_the_same_bits() {
    let computed = sheet_actor();
    let from_package = accepted(&write_zip(&computed)).actor;
    assert_same_layout(&from_package, &computed);
    // Reading rounds once, to f32 meters.
    assert!(difference_cm(&from_package, &computed) < 1e-6);
    let bytes = write_zip(&from_package);
    assert_eq!(accepted(&bytes).actor, from_package);
    assert_eq!(write_zip(&accepted(&bytes).actor), bytes);
}

/// Largest difference of two actors' coordinates and displacements, centimeters.
fn difference_cm(a: &Actor, b: &Actor) -> f64 {
    let vertices = a.mesh().vertices.iter().zip(&b.mesh().vertices);
    let vertices = vertices.map(|(a, b)| (a.0 - b.0).amax());
    let shapes = a.basis().displacements_cm.iter().flatten();
    let shapes = shapes.zip(b.basis().displacements_cm.iter().flatten());
    vertices
        .chain(shapes.map(|(a, b)| (a - b).amax()))
        .fold(0.0, f64::max)
}

fn assert_same_layout(a: &Actor, b: &Actor) {
    assert_eq!(a.mesh().triangles, b.mesh().triangles);
    assert_eq!(a.markers(), b.markers());
    assert_eq!(a.muscle_set(), b.muscle_set());
    assert_eq!(a.virtual_markers(), b.virtual_markers());
    assert_eq!(a.display_name(), b.display_name());
}

#[test]
fn a_glb_that_was_written_reads_back_within_f32_meters() {
    let actor = sheet_actor();
    let bytes = write_glb(&actor);
    let read = accepted(&bytes);
    assert_eq!(read.unit, LengthUnit::Meter);
    assert_same_layout(&read.actor, &actor);
    assert!(difference_cm(&read.actor, &actor) < 1e-6);
    assert_eq!(write_glb(&read.actor), bytes);
}

#[test]
fn real_packages_are_accepted_and_round_trip_through_both_containers() {
    for name in ACTORS {
        let path = format!("actors/{name}.zip");
        let Some(bytes) = shared_data::read(&path, "real_packages_are_accepted_and_round_trip")
        else {
            continue;
        };
        let first = accepted(&bytes);
        let actor = &first.actor;
        let zip = write_zip(actor);
        assert_eq!(&accepted(&zip).actor, actor, "{name}");
        let glb = write_glb(actor);
        let from_glb = accepted(&glb).actor;
        assert_same_layout(&from_glb, actor);
        let difference_cm = difference_cm(&from_glb, actor);
        assert!(difference_cm < 1e-6, "{name}: {difference_cm}");
        let report = actor.basis_report();
        println!(
            "{name}: {} vertices, ZIP {} bytes, GLB {} bytes, GLB differs by {difference_cm:.1e} cm, warnings {:?}, \
             condition of Q upper {:.1} lower {:.1}, ambiguous pairs {}",
            actor.mesh().vertices.len(),
            zip.len(),
            glb.len(),
            first.warnings,
            report.condition_upper,
            report.condition_lower,
            report.ambiguous.len(),
        );
        assert!(report.condition_upper < 1e6 && report.condition_lower < 1e6);
    }
}

#[test]
fn the_markers_of_real_packages_lie_where_they_were_marked() {
    let Some(bytes) = shared_data::read(
        "actors/ict_muscle16_27.zip",
        "the_markers_of_real_packages_lie_where_they_were_marked",
    ) else {
        return;
    };
    let actor = accepted(&bytes).actor;
    let chin = actor.marker_index("chin_8").unwrap();
    let at = actor.virtual_markers()[chin].position(actor.mesh());
    assert!(
        (at.0 - ModelPoint::new(0.0, -7.5671, 10.432).0).norm() < 1e-4,
        "{at:?}"
    );
}

#[test]
fn a_character_without_our_extras_is_no_actor() {
    let (reason, message) = match shared_data::read(
        "ict/face_morphs.glb",
        "a_character_without_our_extras_is_no_actor",
    ) {
        Some(bytes) => {
            let mesh = glb::read(&bytes).unwrap();
            assert_eq!((mesh.positions_m.len(), mesh.targets.len()), (9_409, 45));
            assert_eq!(mesh.targets[0].name.as_deref(), Some("browDown_L"));
            refused(&bytes)
        }
        None => refused(&without_extras()),
    };
    assert_eq!(reason, "GLTF");
    assert!(message.contains("no actor"), "{message}");
    assert_eq!(refused(&without_extras()).1, message);
}

fn without_extras() -> Vec<u8> {
    let mesh = glb::MorphMesh {
        positions_m: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2]],
        targets: Vec::new(),
        extras: None,
    };
    glb::write(&mesh, serde_json::Map::new())
}

#[test]
fn d1_a_rank_deficient_package_is_refused_or_regularized() {
    let bytes = package(|_| {}, &[("shapes/puller.obj", RAISED)]);
    let (reason, message) = refused(&bytes);
    assert_eq!(reason, "BASIS_RANK");
    assert!(message.ends_with("raiser, puller"), "{message}");
    let read = read(&bytes, RankPolicy::Regularize).unwrap();
    assert!(matches!(
        read.warnings[..],
        [ActorWarning::BasisRank { .. }]
    ));
}

#[test]
fn d1_a_scaled_copy_of_a_real_shape_is_refused_and_named_however_it_was_rounded() {
    let test = "d1_a_scaled_copy_of_a_real_shape_is_refused_and_named_however_it_was_rounded";
    let Some(bytes) = shared_data::read("actors/ict_facs30_27.zip", test) else {
        return;
    };
    let actor = accepted(&bytes).actor;
    let five_decimals = |value: f64| (value * 1e5).round() / 1e5;
    for factor in [1.0, 0.5, -0.31, 0.07] {
        let mut parts = actor.to_parts();
        let copy = parts.basis.displacements_cm[20].iter();
        let copy = copy.map(|d| (d * factor).map(five_decimals)).collect();
        parts.basis.displacements_cm[11] = copy;
        let expected = [11, 20].map(|muscle| parts.muscles[muscle].name.clone());
        let (broken, _) = Actor::new(parts, RankPolicy::Regularize).unwrap();
        for bytes in [write_zip(&broken), write_glb(&broken)] {
            let error = read(&bytes, RankPolicy::Refuse).unwrap_err();
            let PackageError::Actor(ActorError::BasisRank { columns, condition }) = error else {
                panic!("{error}");
            };
            println!("{factor} times a shape: condition number {condition:.2e}, {columns:?}");
            assert_eq!(columns, expected);
        }
    }
}

#[test]
fn d2_shapes_of_another_size_or_with_other_faces_are_refused() {
    let short = package(|_| {}, &[("shapes/raiser.obj", "v 0 0 0\n")]);
    assert_eq!(
        refused(&short),
        (
            "VERTEX_COUNT",
            "shape shapes/raiser.obj has 1 vertices, the neutral face has 4".to_owned()
        )
    );
    let turned = PULLED.replace("f 1 2 3 4", "f 2 3 4 1");
    let (reason, message) = refused(&package(|_| {}, &[("shapes/puller.obj", &turned)]));
    assert_eq!(reason, "VERTEX_COUNT");
    assert!(
        message.starts_with("shapes/puller.obj has other faces"),
        "{message}"
    );
}

#[test]
fn d3_non_finite_vertices_are_refused_with_file_and_line() {
    for word in ["nan", "inf", "1e39"] {
        let shape = RAISED.replace("9 9 2", &format!("9 9 {word}"));
        let bytes = package(|_| {}, &[("shapes/raiser.obj", &shape)]);
        let expected = "shapes/raiser.obj, line 3: a coordinate is not a finite number";
        assert_eq!(refused(&bytes), ("NON_FINITE", expected.to_owned()));
    }
}

#[test]
fn d4_faces_that_name_no_vertex_are_refused_with_file_and_line() {
    for face in ["f 0 1 2", "f 1 2 5", "f 1 2 -5", "f 1 2 2"] {
        let neutral = NEUTRAL.replace("f 1 2 3 4", face);
        let (reason, message) = refused(&package(|_| {}, &[("neutral.obj", &neutral)]));
        assert_eq!(reason, "FACE_INDEX");
        assert!(
            message.starts_with("neutral.obj, line 5: a face names vertex"),
            "{message}"
        );
    }
}

#[test]
fn d5_odd_places_of_a_mesh_are_warned_of() {
    let odd = "v 4 4 4\nv 5 5 5\nv 0 0 0\nf 1 3 5\nf 1 3 6\nf 1 2 7\n";
    let [neutral, raised, pulled] = [NEUTRAL, RAISED, PULLED].map(|it| {
        let vertices = it
            .split_inclusive('\n')
            .filter(|it| it.starts_with('v'))
            .collect::<String>();
        format!("{vertices}{odd}")
    });
    let neutral = neutral.replace("f 1 3 5", "f 1 2 3 4\nf 1 3 5");
    let raised = raised.replace("f 1 3 5", "f 1 2 3 4\nf 1 3 5");
    let pulled = pulled.replace("f 1 3 5", "f 1 2 3 4\nf 1 3 5");
    let read = accepted(&package(
        |_| {},
        &[
            ("neutral.obj", &neutral),
            ("shapes/raiser.obj", &raised),
            ("shapes/puller.obj", &pulled),
        ],
    ));
    assert!(
        matches!(
            read.warnings[..],
            [
                ActorWarning::DegenerateTriangles { count: 1, first: 4 },
                ActorWarning::NonManifoldEdges {
                    count: 1,
                    first: [0, 2]
                },
            ]
        ),
        "{:?}",
        read.warnings
    );
}

#[test]
fn d6_files_that_are_empty_or_no_text_are_refused_and_windows_files_are_read() {
    for (neutral, expected) in [
        ("", "neutral.obj, line 1: the file ends without a vertex"),
        (
            "# nothing\n",
            "neutral.obj, line 2: the file ends without a vertex",
        ),
        (
            "v 1,5 2 3\n",
            "neutral.obj, line 1: a coordinate is not a number (decimals are written with a point)",
        ),
        ("v 1 2 3\n\0", "neutral.obj, line 2: contains a NUL byte"),
        (
            "v 1 2 3\n",
            "neutral.obj has no faces; the neutral face needs them",
        ),
    ] {
        let bytes = package(|_| {}, &[("neutral.obj", neutral)]);
        assert_eq!(refused(&bytes), ("PARSE", expected.to_owned()));
    }
    let windows = format!(
        "\u{feff}{}",
        NEUTRAL.replace('\n', "\r\n").replace(' ', "\t")
    );
    assert_eq!(
        accepted(&package(|_| {}, &[("neutral.obj", &windows)])),
        accepted(&package(|_| {}, &[]))
    );
}

#[test]
fn d7_a_package_over_the_limit_is_refused() {
    let (reason, message) = refused(&vec![b'P'; MAX_PACKAGE_BYTES + 1]);
    assert_eq!(reason, "BASIS_SIZE");
    assert_eq!(
        message,
        "the package has 67108865 bytes, at most 67108864 are accepted"
    );
}

#[test]
fn d7_what_a_package_would_unpack_to_is_limited_before_it_is_unpacked() {
    let many: Vec<_> = (0..300)
        .map(|it| json!({ "name": format!("m{it}"), "region": "upper", "shape": "shapes/raiser.obj" }))
        .collect();
    let (reason, message) = refused(&package(|it| it["muscles"] = json!(many), &[]));
    assert_eq!(
        (reason, message.as_str()),
        ("BASIS_SIZE", "300 muscles, at most 256 are accepted")
    );
}

#[test]
fn d11_a_file_that_unpacks_beyond_its_limit_is_refused_whatever_the_directory_says() {
    let bomb = vec![b'\n'; archive::MAX_FILE_BYTES + 1];
    let files = [
        ("actor.json", manifest().to_string().into_bytes()),
        ("neutral.obj", bomb),
    ];
    let files: Vec<_> = files
        .iter()
        .map(|(path, bytes)| (*path, &bytes[..]))
        .collect();
    let bytes = zip_with(&files, CompressionMethod::Deflated);
    assert!(bytes.len() < 1 << 20);
    let (reason, message) = refused(&bytes);
    assert_eq!(reason, "BASIS_SIZE");
    assert_eq!(message, "neutral.obj unpacks to more than 67108864 bytes");
    let spaces = format!("{}{}", " ".repeat(1 << 20), manifest());
    assert_eq!(refused(&with_text(&spaces, &[])).0, "BASIS_SIZE");
}

#[test]
fn d11_a_directory_of_very_many_files_is_refused_before_it_is_read() {
    let names: Vec<_> = (0..=archive::MAX_ENTRIES)
        .map(|it| format!("{it}"))
        .collect();
    let files: Vec<_> = names.iter().map(|it| (it.as_str(), &b""[..])).collect();
    let (reason, message) = refused(&zip_with(&files, CompressionMethod::Stored));
    assert_eq!(reason, "BASIS_SIZE");
    assert_eq!(
        message,
        "the ZIP has 2049 entries, at most 2048 are accepted"
    );
}

#[test]
fn d11_compressed_uploads_and_nested_archives_are_not_accepted() {
    let plain = package(|_| {}, &[]);
    for start in [
        &b"\x1f\x8b\x08\0"[..],
        b"\x28\xb5\x2f\xfd",
        b"BZh9",
        b"\xfd7zXZ\0",
        b"7z\xbc\xaf\x27\x1c",
    ] {
        assert_eq!(refused(&[start, &plain].concat()).0, "COMPRESSION");
        let text = manifest().to_string();
        let nested = zip_with(
            &[("actor.json", text.as_bytes()), ("neutral.obj", start)],
            CompressionMethod::Stored,
        );
        assert_eq!(refused(&nested).0, "COMPRESSION");
    }
    let inside = zip_with(&[("actor.json", &plain)], CompressionMethod::Stored);
    assert_eq!(refused(&inside).0, "COMPRESSION");
}

#[test]
fn bytes_that_are_no_package_are_refused() {
    for bytes in [
        &b""[..],
        b"P",
        b"PK",
        b"PK\x05\x06",
        b"{}",
        b"glTF",
        b"v 0 0 0\n",
    ] {
        let (reason, _) = refused(bytes);
        assert!(matches!(reason, "PARSE" | "GLTF"), "{reason}");
    }
    let folder = zip_with(&[("actor/actor.json", b"{}")], CompressionMethod::Stored);
    assert_eq!(
        refused(&folder),
        ("PARSE", "the ZIP has no file actor.json".to_owned())
    );
    let missing = package(
        |it| it["muscles"][0]["shape"] = json!("shapes/other.obj"),
        &[],
    );
    assert_eq!(
        refused(&missing),
        ("PARSE", "the ZIP has no file shapes/other.obj".to_owned())
    );
}

#[test]
fn d9_paths_that_leave_the_package_are_refused() {
    for path in [
        "../x.obj",
        "/etc/passwd",
        "C:\\x.obj",
        "a/../../x",
        "file:///x",
        "",
        "a//b",
        "x\u{1b}[2J",
    ] {
        let bytes = package(|it| it["neutral"] = json!(path), &[]);
        let (reason, message) = refused(&bytes);
        assert_eq!(reason, "EXTERNAL_REFERENCE", "{path}");
        assert!(!message.contains('\u{1b}'));
    }
}

#[test]
fn d12_json_that_is_not_exactly_the_manifest_is_refused() {
    let good = manifest().to_string();
    let swap = |from: &str, to: &str| {
        assert!(good.contains(from), "{from}");
        good.replacen(from, to, 1)
    };
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    let keys = "\"k\":0,".repeat(50_000);
    let bad = [
        String::new(),
        "null".to_owned(),
        good[..good.len() / 2].to_owned(),
        format!("{good} x"),
        format!("{good}{good}"),
        deep.clone(),
        swap("[8.0,8.0,0.1]", &deep),
        swap("\"cm\"", &deep),
        swap("8.0", "1e400"),
        swap("8.0", "NaN"),
        swap("8.0", "8,0"),
        swap("8.0,8.0,0.1", "8.0,8.0"),
        swap("8.0,8.0,0.1", "8.0,8.0,8.0,8.0"),
        swap("\"Actor A\"", "\"\\ud800\""),
        swap("\"Actor A\"", "\"A\",\"display_name\":\"B\""),
        swap("\"vertex\":3", "\"vertex\":3,\"vertex\":3"),
        swap(
            "{\"vertex\":3}",
            "{\"vertex\":3,\"triangle\":1,\"barycentric\":[1,0,0]}",
        ),
        swap("{\"vertex\":3}", "{\"triangle\":1}"),
        swap("{\"vertex\":3}", "{\"vertex\":-3}"),
        swap("{\"vertex\":3}", "{\"vertex\":1.5}"),
        swap("{\"vertex\":3}", "null"),
        swap("\"vertex\":2", "\"vertex\":2,\"position\":[0,0,0]"),
        swap("\"vertex\":2", "\"triangle\":2"),
        swap("\"region\":\"upper\"", "\"region\":\"middle\""),
        swap("\"unit\":\"cm\"", "\"unit\":\"inch\""),
        swap("\"head_fixed\":true", "\"head_fixed\":1"),
        swap("\"head_fixed\":true", "\"headfixed\":true"),
        swap(",\"unit\":\"cm\"", ""),
        swap("{", "{\"comment\":\"x\","),
        swap("{", &format!("{{{keys}")),
        swap("frontalis-actor/1", "frontalis-actor/2"),
    ];
    for text in bad {
        let shown: String = text.chars().take(60).collect();
        let (reason, message) = refused(&with_text(&text, &[]));
        assert_eq!(reason, "JSON", "{shown}: {message}");
        assert!(message.len() < 300, "{message}");
    }
}

#[test]
fn d12_an_unknown_key_is_named_with_its_line_and_escaped() {
    let text = manifest()
        .to_string()
        .replacen('{', "{\n\"\\u001b[2J\u{202e}\":1,", 1);
    let (_, message) = refused(&with_text(&text, &[]));
    assert!(
        message.starts_with("actor.json, line 2, column "),
        "{message}"
    );
    assert!(
        message.contains("unknown field") && message.is_ascii(),
        "{message}"
    );
    assert!(!message.contains('\u{1b}'));
}

#[test]
fn c6_weights_in_a_package_are_checked() {
    for place in [
        json!({ "triangle": 1, "barycentric": [0.2, 0.2, 0.2] }),
        json!({ "triangle": 1, "barycentric": [-0.5, 1.0, 0.5] }),
        json!({ "triangle": 2, "barycentric": [0.2, 0.3, 0.5] }),
        json!({ "vertex": 4 }),
    ] {
        let (reason, message) = refused(&package(|it| it["markers"][1]["position"] = place, &[]));
        assert_eq!(reason, "BARYCENTRIC");
        assert!(message.starts_with("marker b: "), "{message}");
    }
}

#[test]
fn i5_names_in_a_package_are_checked() {
    let (reason, message) = refused(&package(|it| it["muscles"][1]["name"] = json!("../x"), &[]));
    assert_eq!(
        (reason, message.as_str()),
        (
            "NAME",
            "the name of muscle 1 may not hold U+002E at position 0"
        )
    );
}

#[test]
fn a_glb_names_muscles_by_their_targets() {
    let actor = sheet_actor();
    let mesh = glb::read(&write_glb(&actor)).unwrap();
    let extras: serde_json::Map<String, Value> =
        serde_json::from_str(mesh.extras.as_deref().unwrap()).unwrap();
    assert_eq!(
        extras["targetNames"],
        json!(["raiser_left", "raiser_right", "puller"])
    );
    let mut shuffled = mesh.clone();
    shuffled.targets.rotate_left(1);
    assert_eq!(
        accepted(&glb::write(&shuffled, extras.clone())).actor,
        accepted(&write_glb(&actor)).actor
    );
    let mut lost = mesh.clone();
    lost.targets[1].name = Some("other".to_owned());
    assert_eq!(
        refused(&glb::write(&lost, extras.clone())),
        ("GLTF", "muscle raiser_right is the name of 0 morph targets in mesh.extras.targetNames, not of one".to_owned())
    );
    let mut with_unit = extras;
    with_unit["frontalis"]["unit"] = json!("cm");
    let (reason, message) = refused(&glb::write(&mesh, with_unit));
    assert_eq!(reason, "JSON");
    assert!(
        message.starts_with("mesh.extras.frontalis, line "),
        "{message}"
    );
}

#[test]
fn d3_non_finite_vertices_of_a_glb_are_refused_with_their_vertex() {
    let actor = sheet_actor();
    let mut mesh = glb::read(&write_glb(&actor)).unwrap();
    let extras: serde_json::Map<String, Value> =
        serde_json::from_str(mesh.extras.as_deref().unwrap()).unwrap();
    mesh.targets[2].displacements_m[7][1] = f32::NAN;
    let (reason, message) = refused(&glb::write(&mesh, extras));
    assert_eq!(reason, "NON_FINITE");
    assert_eq!(
        message,
        "shape puller, vertex 7: a coordinate is not a finite number"
    );
}

#[test]
fn a_package_cut_anywhere_is_refused() {
    let zip = package(|_| {}, &[]);
    for end in 0..zip.len() {
        let (reason, _) = refused(&zip[..end]);
        assert!(matches!(reason, "PARSE"), "{end}: {reason}");
    }
    let glb = write_glb(&sheet_actor());
    for end in 0..glb.len() {
        let (reason, _) = refused(&glb[..end]);
        assert!(matches!(reason, "PARSE" | "GLTF"), "{end}: {reason}");
    }
}

proptest! {
    #[test]
    fn no_change_of_a_few_bytes_makes_a_reader_panic(
        glb in any::<bool>(), changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut bytes = if glb { write_glb(&sheet_actor()) } else { package(|_| {}, &[]) };
        for (place, byte) in changes {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        if let Err(error) = read(&bytes, RankPolicy::Regularize) {
            prop_assert!(!error.reason().is_empty() && error.to_string().len() < 1_000);
        }
    }
}
