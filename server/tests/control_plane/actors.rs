//! Packages in, actors listed, packages out; each refusal by its reason.

use frontalis_analysis::{
    face::actor::{Actor, RankPolicy},
    format::actor_package,
    synthesis::reference_face,
};
use frontalis_proto::v1;
use tonic::Code;

use super::{Stage, create, import, reference_package, refusal, with_start};

async fn export(stage: &Stage, name: &str, revision: u32) -> Vec<u8> {
    let request = v1::ExportActorRequest {
        name: name.to_owned(),
        revision,
    };
    let mut chunks = stage
        .actors()
        .export_actor(request)
        .await
        .unwrap()
        .into_inner();
    let mut package = Vec::new();
    while let Some(part) = chunks.message().await.unwrap() {
        assert!(part.chunk.len() <= 1 << 20);
        package.extend(part.chunk);
    }
    package
}

#[tokio::test]
async fn an_imported_actor_is_listed_and_exported_byte_for_byte() {
    let stage = Stage::in_memory().await;
    let package = reference_package();
    let imported = stage
        .import("reference", &package)
        .await
        .unwrap()
        .actor
        .unwrap();
    assert_eq!(imported.name, "actors/reference");
    assert_eq!(imported.revision, 1);
    assert_eq!(imported.n_vertices, 1_536);
    assert_eq!(imported.n_triangles, 2_860);
    assert_eq!(imported.muscles.len(), 16);
    assert_eq!(
        imported.markers.iter().filter(|it| it.head_fixed).count(),
        5
    );
    assert!(imported.basis.as_ref().unwrap().condition_upper.is_finite());
    let listed = stage
        .actors()
        .list_actors(v1::ListActorsRequest::default())
        .await
        .unwrap();
    assert_eq!(listed.into_inner().actors, [imported]);
    assert_eq!(export(&stage, "actors/reference", 0).await, package);
    let (status, body) = stage.get("/api/v1/actors").await;
    assert_eq!(status, 200);
    let body: serde_json::Value = serde_json::from_str(&body).unwrap();
    assert_eq!(body["actors"][0]["muscles"][0]["name"], "frontalis_left");
}

#[tokio::test]
async fn importing_again_makes_a_revision_and_keeps_the_old_one() {
    let stage = Stage::in_memory().await;
    let zip = reference_package();
    let glb = actor_package::write_glb(&reference_face::actor());
    stage.import("reference", &zip).await.unwrap();
    let second = stage
        .import("reference", &glb)
        .await
        .unwrap()
        .actor
        .unwrap();
    assert_eq!(second.revision, 2);
    assert_eq!(export(&stage, "actors/reference", 1).await, zip);
    assert_eq!(export(&stage, "actors/reference", 0).await, glb);
}

#[tokio::test]
async fn other_markers_under_the_same_id_are_refused() {
    let stage = Stage::in_memory().await;
    stage
        .import("reference", &reference_package())
        .await
        .unwrap();
    let mut parts = reference_face::actor_parts();
    parts.markers.pop();
    let fewer = Actor::new(parts, RankPolicy::Regularize).unwrap().0;
    let refused = stage
        .import("reference", &actor_package::write_zip(&fewer))
        .await;
    assert_eq!(
        refusal(refused),
        (Code::FailedPrecondition, "LAYOUT_CHANGED".into())
    );
}

#[tokio::test]
async fn a_package_above_the_limit_is_refused_while_it_streams() {
    let stage = Stage::with(|config| config.limits.package_mib = 1).await;
    let endless = futures::stream::iter(import("big", &vec![b'x'; 100_000])).chain_forever();
    let refused = stage.actors().import_actor(endless).await;
    assert_eq!(
        refusal(refused),
        (Code::ResourceExhausted, "BASIS_SIZE".into())
    );
}

/// Repeats the last message for ever.
trait ChainForever {
    fn chain_forever(self) -> impl futures::Stream<Item = v1::ImportActorRequest> + Send + 'static;
}

impl<S> ChainForever for S
where
    S: futures::Stream<Item = v1::ImportActorRequest> + Send + 'static,
{
    fn chain_forever(self) -> impl futures::Stream<Item = v1::ImportActorRequest> + Send + 'static {
        let more = v1::ImportActorRequest {
            start: None,
            chunk: vec![b'x'; 100_000],
        };
        futures::StreamExt::chain(self, futures::stream::repeat(more))
    }
}

#[tokio::test]
async fn each_bad_import_has_its_reason() {
    let stage = Stage::in_memory().await;
    let package = reference_package();
    let gzip = [b"\x1f\x8b".as_slice(), &[0; 64]].concat();
    let cases = [
        (import("x", &gzip), Code::Unimplemented, "COMPRESSION"),
        (import("x", b"neither"), Code::InvalidArgument, "PARSE"),
        (import("../x", &package), Code::InvalidArgument, "NAME"),
        (
            import("x", &package)[1..].to_vec(),
            Code::FailedPrecondition,
            "PROTOCOL_ORDER",
        ),
        (Vec::new(), Code::FailedPrecondition, "PROTOCOL_ORDER"),
        (
            [import("x", &package), import("x", &[])].concat(),
            Code::FailedPrecondition,
            "PROTOCOL_ORDER",
        ),
        (
            with_start(
                v1::ImportActorStart {
                    actor_id: "x".into(),
                    unit: v1::LengthUnit::Millimeter.into(),
                    ..Default::default()
                },
                &package,
            ),
            Code::InvalidArgument,
            "UNIT_MISMATCH",
        ),
    ];
    for (messages, code, reason) in cases {
        let answer = stage
            .actors()
            .import_actor(futures::stream::iter(messages))
            .await;
        assert_eq!(refusal(answer), (code, reason.into()));
    }
    let missing = v1::GetActorRequest {
        name: "actors/x".into(),
    };
    let missing = stage.actors().get_actor(missing).await;
    assert_eq!(refusal(missing), (Code::NotFound, "ACTOR".into()));
}

#[tokio::test]
async fn a_rank_deficient_basis_needs_regularize() {
    let stage = Stage::in_memory().await;
    let mut parts = reference_face::actor_parts();
    parts.markers.truncate(6);
    let actor = Actor::new(parts, RankPolicy::Regularize).unwrap().0;
    let package = actor_package::write_zip(&actor);
    let refused = stage.import("few", &package).await;
    assert_eq!(
        refusal(refused),
        (Code::FailedPrecondition, "BASIS_RANK".into())
    );
    let start = v1::ImportActorStart {
        actor_id: "few".into(),
        regularize: true,
        ..Default::default()
    };
    let messages = futures::stream::iter(with_start(start, &package));
    let accepted = stage
        .actors()
        .import_actor(messages)
        .await
        .unwrap()
        .into_inner();
    assert!(
        accepted
            .warnings
            .iter()
            .any(|it| it.contains("rank-deficient"))
    );
    let mut request = create("s");
    request.actor = "actors/few".into();
    stage.sessions().create_session(request).await.unwrap();
}

#[tokio::test]
async fn an_actor_in_use_is_not_deleted() {
    let stage = Stage::in_memory().await;
    stage.create("s").await;
    let delete = || v1::DeleteActorRequest {
        name: "actors/reference".into(),
        with_takes: true,
    };
    let refused = stage.actors().delete_actor(delete()).await;
    assert_eq!(
        refusal(refused),
        (Code::FailedPrecondition, "ACTOR_IN_USE".into())
    );
    let end = v1::EndSessionRequest {
        name: "sessions/s".into(),
    };
    stage.sessions().end_session(end).await.unwrap();
    stage.actors().delete_actor(delete()).await.unwrap();
    let again = stage.actors().delete_actor(delete()).await;
    assert_eq!(refusal(again), (Code::NotFound, "ACTOR".into()));
}

#[tokio::test]
async fn what_later_versions_fill_says_so() {
    let stage = Stage::in_memory().await;
    let improve = stage
        .actors()
        .improve_basis(v1::ImproveBasisRequest::default())
        .await;
    assert_eq!(
        refusal(improve),
        (Code::Unimplemented, "NOT_IMPLEMENTED".into())
    );
}
