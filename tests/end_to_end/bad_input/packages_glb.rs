//! Rows D8 to D10: GLB packages whose numbers, links or frame are broken.

use harness::{Problem, glb, toy_glb};
use serde_json::{Value, json};
use tonic::Code;

use super::{Stage, beside_a_control_session};

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d8_gltf_numbers_that_lead_outside_are_refused() {
    beside_a_control_session("D8", async |stage| {
        let accepted = import(stage, |_| {})
            .await
            .expect("the toy face is a valid GLB");
        assert_eq!(accepted, 3);
        for (what, at, key, value) in outside() {
            let break_it = |it: &mut Value| it.pointer_mut(at).unwrap()[key] = value;
            let problem = import(stage, break_it).await.expect_err(what);
            assert_eq!(
                (problem.code, problem.reason.as_str()),
                (Code::InvalidArgument, "GLTF"),
                "{what}: {problem:?}"
            );
        }
        let deep = |it: &mut Value| {
            let chain = (1..100_000).map(|child| json!({"children": [child]}));
            it["nodes"] = chain.chain([json!({"mesh": 0})]).collect();
        };
        // A long chain is either walked or refused; it never overflows the stack.
        if let Err(problem) = import(stage, deep).await {
            assert_eq!(
                (problem.code, problem.reason.as_str()),
                (Code::InvalidArgument, "GLTF"),
                "{problem:?}"
            );
        }
    })
    .await;
}

/// What is broken, where, in which key, and by which value.
fn outside() -> Vec<(&'static str, &'static str, &'static str, Value)> {
    let neutral = "/accessors/1";
    let view = "/bufferViews/1";
    let sparse = json!({
        "count": 4_000_000_000_u32,
        "indices": {"bufferView": 0, "componentType": 5125},
        "values": {"bufferView": 1},
    });
    let circle = json!([{"mesh": 0, "children": [1]}, {"children": [0]}]);
    vec![
        ("count", neutral, "count", json!(4_000_000_000_u32)),
        ("count overflow", neutral, "count", json!(u64::MAX)),
        (
            "accessor offset",
            neutral,
            "byteOffset",
            json!(u64::MAX - 3),
        ),
        ("view offset", view, "byteOffset", json!(u64::MAX - 3)),
        ("view outside", view, "byteLength", json!(1 << 30)),
        ("stride", view, "byteStride", json!(0)),
        ("no such view", neutral, "bufferView", json!(99)),
        (
            "no such accessor",
            "/meshes/0/primitives/0/attributes",
            "POSITION",
            json!(99),
        ),
        ("component type", neutral, "componentType", json!(5123)),
        ("element type", neutral, "type", json!("VEC2")),
        ("index type", "/accessors/0", "componentType", json!(5126)),
        ("sparse bomb", neutral, "sparse", sparse),
        ("circular nodes", "", "nodes", circle),
        ("no mesh", "", "meshes", json!([])),
    ]
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d9_a_gltf_that_points_outside_itself_is_refused() {
    beside_a_control_session("D9", async |stage| {
        for uri in [
            "../secret.bin",
            "/etc/passwd",
            "file:///etc/passwd",
            "http://example.com/x.bin",
            "data:application/octet-stream;base64,AAAA",
        ] {
            let problem = import(stage, |it| it["buffers"][0]["uri"] = json!(uri))
                .await
                .expect_err(uri);
            assert_eq!(
                (problem.code, problem.reason.as_str()),
                (Code::InvalidArgument, "EXTERNAL_REFERENCE"),
                "{uri}: {problem:?}"
            );
            let image = |it: &mut Value| it["images"] = json!([{"uri": uri}]);
            let problem = import(stage, image).await.expect_err(uri);
            assert_eq!(problem.reason, "EXTERNAL_REFERENCE", "{uri}: {problem:?}");
        }
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn d10_a_glb_whose_frame_is_broken_is_refused() {
    beside_a_control_session("D10", async |stage| {
        let (json, buffer) = toy_glb();
        let whole = glb(&json, &buffer);
        let json_length = u32::from_le_bytes(whole[12..16].try_into().unwrap()) as usize;
        let patched = |at: usize, word: u32| {
            let mut bytes = whole.clone();
            bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
            bytes
        };
        let mut swapped = whole[..12].to_vec();
        swapped.extend(&whole[20 + json_length..]);
        swapped.extend(&whole[12..20 + json_length]);
        let cases = [
            ("length too large", patched(8, u32::MAX)),
            ("length too small", patched(8, 16)),
            (
                "chunk too long",
                patched(12, u32::try_from(json_length).unwrap() + 400),
            ),
            ("chunk too short", patched(12, 8)),
            ("unknown version", patched(4, 7)),
            ("chunks swapped", swapped),
            ("cut", whole[..whole.len() / 2].to_vec()),
            ("only a header", whole[..12].to_vec()),
            ("only the magic", whole[..4].to_vec()),
        ];
        for (what, bytes) in cases {
            let refused = stage.server.import("broken", &bytes).await.expect_err(what);
            let problem = Problem::of(&refused);
            assert_eq!(
                (problem.code, problem.reason.as_str()),
                (Code::InvalidArgument, "GLTF"),
                "{what}: {problem:?}"
            );
        }
        for extension in [
            "KHR_draco_mesh_compression",
            "EXT_meshopt_compression",
            "ACME_unknown",
        ] {
            let require = |it: &mut Value| {
                it["extensionsUsed"] = json!([extension]);
                it["extensionsRequired"] = json!([extension]);
            };
            let problem = import(stage, require).await.expect_err(extension);
            assert_eq!(
                (problem.code, problem.reason.as_str()),
                (Code::Unimplemented, "GLTF_EXTENSION"),
                "{problem:?}"
            );
            assert!(problem.message.contains(extension), "{problem:?}");
        }
    })
    .await;
}

/// Imports the toy face with a change to its JSON; returns the number of muscles.
async fn import(stage: &Stage, change: impl FnOnce(&mut Value)) -> Result<usize, Problem> {
    let (mut json, buffer) = toy_glb();
    change(&mut json);
    match stage.server.import("toy", &glb(&json, &buffer)).await {
        Ok(accepted) => Ok(accepted.actor.unwrap().muscles.len()),
        Err(status) => Err(Problem::of(&status)),
    }
}
