//! Rows C6, D1 to D7 and D12: ZIP packages that are broken in one place.

use frontalis_proto::v1::ImportActorStart;
use frontalis_server::config::Config;
use harness::{PackageFiles, assert_refused, toy_files, toy_json, zip};
use serde_json::{Value, json};
use tonic::{Code, Status};

use super::{Stage, beside_a_control_session, beside_a_control_session_with};

const NEUTRAL: &str = "neutral.obj";
const SHAPE: &str = "shapes/jaw.obj";

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn c6_a_marker_that_is_not_on_a_triangle_is_refused() {
    beside_a_control_session("C6", async |stage| {
        let on = |triangle: i64, barycentric: [f64; 3]| {
            json!({"name": "odd", "region": "lower", "triangle": triangle, "barycentric": barycentric})
        };
        for marker in [
            on(0, [0.5, 0.5, 0.5]),
            on(0, [1.5, -0.5, 0.0]),
            on(100_000, [0.2, 0.5, 0.3]),
            on(0, [0.0, 0.0, 0.0]),
        ] {
            let refused = import_json(stage, |json| json["markers"][0] = marker).await;
            assert_refused(&refused, Code::InvalidArgument, "BARYCENTRIC");
            assert!(refused.message().contains("odd"), "{}", refused.message());
        }
        // A triangle without an area carries no marker.
        let mut files = with_zero_area_triangle();
        set_json(&mut files, |json| json["markers"][0] = on(72, [0.2, 0.5, 0.3]));
        let refused = refused(stage, &files).await;
        assert_refused(&refused, Code::InvalidArgument, "BARYCENTRIC");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d1_a_basis_whose_columns_cannot_be_told_apart_is_refused_or_regularized() {
    beside_a_control_session("D1", async |stage| {
        let mut duplicate = toy_files();
        let copy = duplicate["shapes/zygomatic_left.obj"].clone();
        duplicate.insert(SHAPE.to_owned(), copy);
        let mut zero = toy_files();
        let neutral = zero[NEUTRAL].clone();
        zero.insert(SHAPE.to_owned(), neutral);
        for files in [duplicate, zero] {
            let refused = refused(stage, &files).await;
            assert_refused(&refused, Code::FailedPrecondition, "BASIS_RANK");
            assert!(refused.message().contains("jaw"), "{}", refused.message());
            assert!(
                refused.message().contains("condition"),
                "{}",
                refused.message()
            );
            let start = ImportActorStart {
                actor_id: "toy".to_owned(),
                regularize: true,
                ..ImportActorStart::default()
            };
            let accepted = stage.server.import_as(start, &zip(&files)).await.unwrap();
            assert!(
                accepted.warnings.iter().any(|it| it.contains("jaw")),
                "{:?}",
                accepted.warnings
            );
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d2_a_shape_with_another_number_of_vertices_is_refused() {
    beside_a_control_session("D2", async |stage| {
        let mut files = toy_files();
        append(&mut files, SHAPE, "v 1 2 3\n");
        let refused = refused(stage, &files).await;
        assert_refused(&refused, Code::InvalidArgument, "VERTEX_COUNT");
        for part in ["jaw", "49", "50"] {
            assert!(refused.message().contains(part), "{}", refused.message());
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d3_a_coordinate_that_is_not_finite_is_refused_by_its_line() {
    beside_a_control_session("D3", async |stage| {
        for bad in ["nan", "inf", "-infinity", "1e39", "1e400"] {
            let mut files = toy_files();
            replace_line(&mut files, SHAPE, 4, &format!("v 0.0 {bad} 0.0"));
            let refused = refused(stage, &files).await;
            assert_refused(&refused, Code::InvalidArgument, "NON_FINITE");
            assert!(
                refused.message().contains("line 5"),
                "{bad}: {}",
                refused.message()
            );
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d4_a_face_that_names_no_vertex_is_refused_by_its_line() {
    beside_a_control_session("D4", async |stage| {
        let gon = format!("f{}", " 1 2 3".repeat(8_000));
        for bad in [
            "f 0 1 2",
            "f 1 2 50",
            "f -50 1 2",
            "f 1 2 9999999999",
            "f 1 2",
            gon.as_str(),
        ] {
            let mut files = toy_files();
            let line = String::from_utf8_lossy(&files[NEUTRAL]).lines().count() + 1;
            append(&mut files, NEUTRAL, &format!("{bad}\n"));
            let refused = refused(stage, &files).await;
            assert_refused(&refused, Code::InvalidArgument, "FACE_INDEX");
            let named = format!("line {line}");
            assert!(refused.message().contains(&named), "{}", refused.message());
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d5_odd_but_usable_surfaces_are_accepted_with_warnings() {
    beside_a_control_session("D5", async |stage| {
        let degenerate = with_zero_area_triangle();
        let mut non_manifold = toy_files();
        append(&mut non_manifold, NEUTRAL, "f 1 2 30\nf 1 2 31\n");
        let mut isolated = toy_files();
        add_vertex(&mut isolated, "v 0.0 0.0 9.0");
        for (id, files) in [
            ("degenerate", degenerate),
            ("non-manifold", non_manifold),
            ("isolated", isolated),
        ] {
            let accepted = stage.server.import(id, &zip(&files)).await.unwrap();
            assert!(!accepted.warnings.is_empty(), "{id} came without a warning");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d6_text_that_is_no_obj_is_refused() {
    beside_a_control_session("D6 refused", async |stage| {
        let endless = format!("# {}", "x".repeat(70_000));
        let cases: [(&str, Vec<u8>); 7] = [
            ("empty", Vec::new()),
            ("only comments", b"# nothing\n# here\n".to_vec()),
            ("decimal commas", line_for_vertex("v 0,5 1,5 2,5")),
            ("NUL", line_for_vertex("v 0.0 \0 0.0")),
            ("endless line", line_for_vertex(&endless)),
            (
                "invalid UTF-8",
                [b"v \xff\xfe 0 0\n".to_vec(), toy_files()[NEUTRAL].clone()].concat(),
            ),
            ("words", line_for_vertex("v one two three")),
        ];
        for (what, text) in cases {
            let mut files = toy_files();
            files.insert(NEUTRAL.to_owned(), text);
            let refused = refused(stage, &files).await;
            let problem = harness::Problem::of(&refused);
            assert_eq!(
                (problem.code, problem.reason.as_str()),
                (Code::InvalidArgument, "PARSE"),
                "{what}: {problem:?}"
            );
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d6_every_usual_way_to_write_an_obj_is_read() {
    beside_a_control_session("D6 accepted", async |stage| {
        let plain = String::from_utf8(toy_files()[NEUTRAL].clone()).unwrap();
        let cases = [
            ("crlf", plain.replace('\n', "\r\n")),
            ("bom", format!("\u{feff}{plain}")),
            ("no-final-newline", plain.trim_end().to_owned()),
            ("tabs", plain.replace(' ', "\t")),
            (
                "groups",
                format!("mtllib x.mtl\no face\ng all\ns 1\n{plain}vn 0 0 1\nvt 0 0\n"),
            ),
        ];
        for (id, text) in cases {
            let mut files = toy_files();
            files.insert(NEUTRAL.to_owned(), text.into_bytes());
            let accepted = stage.server.import(id, &zip(&files)).await;
            assert_eq!(
                accepted
                    .unwrap_or_else(|it| panic!("{id}: {it}"))
                    .actor
                    .unwrap()
                    .n_vertices,
                49
            );
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d7_a_package_above_the_limit_is_refused_while_it_streams() {
    let little = |config: &mut Config| config.limits.package_mib = 1;
    beside_a_control_session_with("D7", little, async |stage| {
        let refused = stage
            .server
            .import("big", &vec![0; 3 << 20])
            .await
            .unwrap_err();
        assert_refused(&refused, Code::ResourceExhausted, "BASIS_SIZE");
        // A little archive that becomes large is stopped as well.
        let mut files = toy_files();
        append(
            &mut files,
            NEUTRAL,
            &"# padding that compresses very well\n".repeat(2_200_000),
        );
        let refused = stage.server.import("bomb", &zip(&files)).await.unwrap_err();
        assert_refused(&refused, Code::ResourceExhausted, "BASIS_SIZE");
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d12_json_that_is_not_strict_is_refused() {
    beside_a_control_session("D12", async |stage| {
        let plain = toy_json().to_string();
        let inside = |field: &str| format!("{{{field},{}", &plain[1..]);
        let many: Vec<_> = (0..50_000).map(|it| format!("\"k{it}\":0,")).collect();
        let many = many.concat();
        let cases = [
            ("nested", "[".repeat(100_000)),
            (
                "nested in a field",
                inside(&format!("\"x\":{}{}", "[".repeat(1_000), "]".repeat(1_000))),
            ),
            (
                "1e400",
                plain.replacen("\"vertex\":8", "\"position\":[1e400,0,0]", 1),
            ),
            (
                "NaN",
                plain.replacen("\"vertex\":8", "\"position\":[NaN,0,0]", 1),
            ),
            ("duplicate key", inside("\"unit\":\"cm\"")),
            ("unknown key", inside("\"units\":\"cm\"")),
            (
                "lone surrogate",
                plain.replacen("\"Toy\"", "\"\\ud800\"", 1),
            ),
            ("trailing data", format!("{plain} {{}}")),
            ("many keys", format!("{{{many}{}", &plain[1..])),
            ("truncated", plain[..plain.len() - 1].to_owned()),
            ("not an object", "7".to_owned()),
        ];
        for (what, text) in cases {
            let mut files = toy_files();
            files.insert("actor.json".to_owned(), text.into_bytes());
            let refused = refused(stage, &files).await;
            let problem = harness::Problem::of(&refused);
            assert_eq!(
                (problem.code, problem.reason.as_str()),
                (Code::InvalidArgument, "JSON"),
                "{what}: {problem:?}"
            );
        }
    })
    .await;
}

async fn refused(stage: &Stage, files: &PackageFiles) -> Status {
    stage
        .server
        .import("broken", &zip(files))
        .await
        .unwrap_err()
}

async fn import_json(stage: &Stage, change: impl FnOnce(&mut Value)) -> Status {
    let mut files = toy_files();
    set_json(&mut files, change);
    refused(stage, &files).await
}

fn set_json(files: &mut PackageFiles, change: impl FnOnce(&mut Value)) {
    let mut json = toy_json();
    change(&mut json);
    files.insert("actor.json".to_owned(), json.to_string().into_bytes());
}

fn append(files: &mut PackageFiles, path: &str, text: &str) {
    files.get_mut(path).unwrap().extend(text.as_bytes());
}

/// One more vertex in every file.
fn add_vertex(files: &mut PackageFiles, line: &str) {
    for path in files.keys().cloned().collect::<Vec<_>>() {
        if path != "actor.json" {
            append(files, &path, &format!("{line}\n"));
        }
    }
}

/// The toy face with a triangle, its 73rd, whose corners are two places.
fn with_zero_area_triangle() -> PackageFiles {
    let mut files = toy_files();
    add_vertex(&mut files, "v 0.0 0.0 9.0");
    add_vertex(&mut files, "v 0.0 0.0 9.0");
    append(&mut files, NEUTRAL, "f 1 50 51\n");
    files
}

/// Replaces the line with this index, from 0; the first is a comment.
fn replace_line(files: &mut PackageFiles, path: &str, line: usize, text: &str) {
    let whole = String::from_utf8(files[path].clone()).unwrap();
    let mut lines: Vec<_> = whole.lines().collect();
    lines[line] = text;
    files.insert(path.to_owned(), lines.join("\n").into_bytes());
}

fn line_for_vertex(line: &str) -> Vec<u8> {
    let mut files = toy_files();
    replace_line(&mut files, NEUTRAL, 3, line);
    files[NEUTRAL].clone()
}
