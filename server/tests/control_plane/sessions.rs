//! The life of a session without frames: created, changed, ended, used again, and back after a restart.

use frontalis_proto::v1;
use tonic::Code;

use super::{Stage, create, refusal};

fn name(id: &str) -> String {
    format!("sessions/{id}")
}

async fn get(stage: &Stage, id: &str) -> Result<v1::Session, tonic::Status> {
    let request = v1::GetSessionRequest { name: name(id) };
    let answer = stage.sessions().get_session(request).await?;
    Ok(answer.into_inner().session.unwrap())
}

async fn end(stage: &Stage, id: &str) -> v1::Session {
    let request = v1::EndSessionRequest { name: name(id) };
    stage
        .sessions()
        .end_session(request)
        .await
        .unwrap()
        .into_inner()
        .session
        .unwrap()
}

#[tokio::test]
async fn a_session_shows_its_effective_settings() {
    let stage = Stage::in_memory().await;
    let created = stage.create("stage-1").await;
    assert_eq!(created.name, "sessions/stage-1");
    assert_eq!(created.actor, "actors/reference");
    let settings = created.settings.as_ref().unwrap();
    assert_eq!(settings.neutral_frames, Some(15));
    assert_eq!(settings.region_mode(), v1::RegionMode::Joint);
    assert_eq!(settings.publisher_timeout.unwrap().seconds, 10);
    let status = created.status.as_ref().unwrap();
    assert_eq!(status.state(), v1::SessionState::Waiting);
    assert_eq!((status.run, status.actor_revision), (1, 1));
    assert_eq!(get(&stage, "stage-1").await.unwrap(), created);
}

#[tokio::test]
async fn an_id_is_made_when_none_is_given() {
    let stage = Stage::in_memory().await;
    let one = stage.create("").await.name;
    let other = stage
        .sessions()
        .create_session(create(""))
        .await
        .unwrap()
        .into_inner();
    assert!(one.starts_with("sessions/s-"), "{one}");
    assert_ne!(one, other.session.unwrap().name);
}

#[tokio::test]
async fn the_id_of_an_ended_session_starts_a_new_run() {
    let stage = Stage::in_memory().await;
    stage.create("s").await;
    let taken = stage.sessions().create_session(create("s")).await;
    assert_eq!(
        refusal(taken),
        (Code::AlreadyExists, "SESSION_EXISTS".into())
    );
    let ended = end(&stage, "s").await;
    assert_eq!(ended.status.unwrap().state(), v1::SessionState::Ended);
    let ended = end(&stage, "s").await;
    assert_eq!(ended.status.unwrap().state(), v1::SessionState::Ended);
    let recenter = v1::RecenterSessionRequest {
        name: name("s"),
        ..Default::default()
    };
    let refused = stage.sessions().recenter_session(recenter).await;
    assert_eq!(
        refusal(refused),
        (Code::FailedPrecondition, "SESSION_ENDED".into())
    );
    let update = v1::UpdateSessionRequest {
        name: name("s"),
        ..Default::default()
    };
    let refused = stage.sessions().update_session(update).await;
    assert_eq!(
        refusal(refused),
        (Code::FailedPrecondition, "SESSION_ENDED".into())
    );
    let again = stage
        .sessions()
        .create_session(create("s"))
        .await
        .unwrap()
        .into_inner();
    let status = again.session.unwrap().status.unwrap();
    assert_eq!((status.state(), status.run), (v1::SessionState::Waiting, 2));
}

#[tokio::test]
async fn settings_change_by_presence_and_by_mask() {
    let stage = Stage::in_memory().await;
    stage.create("s").await;
    let update = |settings: v1::SessionSettings, paths: &[&str]| v1::UpdateSessionRequest {
        name: name("s"),
        settings: Some(settings),
        actor_revision: 0,
        update_mask: Some(frontalis_proto::FieldMask {
            paths: paths.iter().map(|it| (*it).to_owned()).collect(),
        }),
    };
    let exaggerate = v1::SessionSettings {
        allow_exaggeration: Some(true),
        neutral_frames: Some(30),
        ..Default::default()
    };
    let changed = stage
        .sessions()
        .update_session(update(exaggerate, &[]))
        .await
        .unwrap();
    let settings = changed.into_inner().session.unwrap().settings.unwrap();
    assert_eq!(
        (settings.neutral_frames, settings.allow_exaggeration),
        (Some(30), Some(true))
    );
    let masked = update(v1::SessionSettings::default(), &["neutral_frames"]);
    stage.sessions().update_session(masked).await.unwrap();
    let settings = get(&stage, "s").await.unwrap().settings.unwrap();
    assert_eq!(
        (settings.neutral_frames, settings.allow_exaggeration),
        (Some(15), Some(true))
    );
    let too_smooth = v1::SessionSettings {
        smoothing: Some(1.5),
        ..Default::default()
    };
    let refused = stage
        .sessions()
        .update_session(update(too_smooth, &[]))
        .await;
    assert_eq!(
        refusal(refused),
        (Code::InvalidArgument, "SOLVER_OPTIONS".into())
    );
    let unchanged = get(&stage, "s").await.unwrap().settings.unwrap();
    assert_eq!(unchanged, settings);
}

#[tokio::test]
async fn the_terms_of_the_objective_outlive_a_restart() {
    let dir = tempfile::tempdir().unwrap();
    let data_dir = dir.path().to_str().unwrap().to_owned();
    let first = Stage::with(|config| config.data_dir.clone_from(&data_dir)).await;
    let created = first.create("default").await.settings.unwrap();
    assert_eq!(
        (created.smoothing, created.sparsity, created.symmetry),
        (Some(0.5), Some(0.5), Some(0.0))
    );
    assert_eq!((created.robust, created.plain), (Some(true), Some(false)));
    let mut plain = create("plain");
    plain.settings = Some(v1::SessionSettings {
        plain: Some(true),
        ..Default::default()
    });
    first.sessions().create_session(plain).await.unwrap();
    let mut own = create("own");
    own.settings = Some(v1::SessionSettings {
        smoothing: Some(0.3),
        symmetry: Some(0.1),
        bounds: vec![v1::ControlBounds {
            control: "jaw_rotation".into(),
            lower: 0.1,
            upper: 0.7,
        }],
        exclusive_pairs: vec![v1::ControlPair {
            first: "lips_pressor".into(),
            second: "orbicularis_oris".into(),
        }],
        ..Default::default()
    });
    first.sessions().create_session(own).await.unwrap();
    let before = [
        get(&first, "default").await.unwrap().settings,
        get(&first, "plain").await.unwrap().settings,
        get(&first, "own").await.unwrap().settings,
    ];
    let plain = before[1].clone().unwrap();
    assert_eq!(
        (plain.plain, plain.robust, plain.smoothing),
        (Some(true), Some(false), Some(0.0))
    );
    assert!(first.stop().await);

    let again = Stage::with(|config| config.data_dir.clone_from(&data_dir)).await;
    for (id, before) in ["default", "plain", "own"].into_iter().zip(before) {
        assert_eq!(get(&again, id).await.unwrap().settings, before, "{id}");
    }
}

#[tokio::test]
async fn a_session_moves_to_another_revision_of_its_actor() {
    let stage = Stage::in_memory().await;
    stage.create("s").await;
    let update = |actor_revision| v1::UpdateSessionRequest {
        name: name("s"),
        actor_revision,
        ..Default::default()
    };
    let missing = stage.sessions().update_session(update(2)).await;
    assert_eq!(refusal(missing), (Code::NotFound, "ACTOR".into()));
    stage
        .import("reference", &super::reference_package())
        .await
        .unwrap();
    let moved = stage
        .sessions()
        .update_session(update(2))
        .await
        .unwrap()
        .into_inner();
    assert_eq!(moved.session.unwrap().status.unwrap().actor_revision, 2);
}

#[tokio::test]
async fn sessions_above_the_limit_are_refused_with_the_limits_name() {
    let stage = Stage::with(|config| config.limits.sessions = 1).await;
    stage.create("a").await;
    let refused = stage.sessions().create_session(create("b")).await;
    assert_eq!(
        refusal(refused),
        (Code::ResourceExhausted, "SESSIONS".into())
    );
    end(&stage, "a").await;
    stage.sessions().create_session(create("b")).await.unwrap();
}

#[tokio::test]
async fn pages_hold_every_session_once() {
    let stage = Stage::in_memory().await;
    stage.create("a").await;
    for id in ["b", "c", "d", "e"] {
        stage.sessions().create_session(create(id)).await.unwrap();
    }
    end(&stage, "c").await;
    let mut names = Vec::new();
    let mut page_token = String::new();
    loop {
        let request = v1::ListSessionsRequest {
            page_size: 2,
            page_token,
        };
        let page = stage
            .sessions()
            .list_sessions(request)
            .await
            .unwrap()
            .into_inner();
        names.extend(page.sessions.into_iter().map(|it| it.name));
        page_token = page.next_page_token;
        if page_token.is_empty() {
            break;
        }
    }
    assert_eq!(names, ["a", "b", "c", "d", "e"].map(name));
}

#[tokio::test]
async fn actors_and_sessions_are_back_after_a_restart_as_a_new_run() {
    let dir = tempfile::tempdir().unwrap();
    let data_dir = dir.path().to_str().unwrap().to_owned();
    let first = Stage::with(|config| config.data_dir.clone_from(&data_dir)).await;
    first.create("open").await;
    let mut other = create("over");
    other.settings = Some(v1::SessionSettings {
        neutral_frames: Some(7),
        ..Default::default()
    });
    first.sessions().create_session(other).await.unwrap();
    end(&first, "over").await;
    assert!(first.stop().await);

    let again = Stage::with(|config| config.data_dir.clone_from(&data_dir)).await;
    let status = get(&again, "open").await.unwrap().status.unwrap();
    assert_eq!((status.state(), status.run), (v1::SessionState::Waiting, 2));
    let over = get(&again, "over").await.unwrap();
    assert_eq!(over.settings.unwrap().neutral_frames, Some(7));
    let status = over.status.unwrap();
    assert_eq!((status.state(), status.run), (v1::SessionState::Ended, 1));
    let (status, body) = again.get("/api/v1/sessions/over/curves").await;
    assert_eq!(status, 409);
    assert!(
        body.contains("urn:frontalis:problem:SESSION_ENDED"),
        "{body}"
    );
    let reused = again
        .sessions()
        .create_session(create("over"))
        .await
        .unwrap()
        .into_inner();
    assert_eq!(reused.session.unwrap().status.unwrap().run, 2);
}

#[tokio::test]
async fn a_missing_session_is_not_found_at_both_doors() {
    let stage = Stage::in_memory().await;
    assert_eq!(
        refusal(get(&stage, "x").await),
        (Code::NotFound, "SESSION".into())
    );
    let (status, body) = stage.get("/api/v1/sessions/x").await;
    assert_eq!(status, 404);
    let body: serde_json::Value = serde_json::from_str(&body).unwrap();
    assert_eq!(body["type"], "urn:frontalis:problem:SESSION");
    assert_eq!(body["instance"], "/api/v1/sessions/x");
}
