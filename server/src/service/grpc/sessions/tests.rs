//! What happens to a session between memory and catalogue, where a client could not provoke it.

use frontalis_analysis::analyzer::NeutralSource;
use frontalis_proto::v1::curve_service_server::CurveService as _;
use futures::FutureExt as _;
use tonic::Code;

use super::super::stage::{SESSION, Stage, asked, assert_refused, every_frame, start};
use super::*;

fn wider() -> Change {
    Change {
        settings: Box::new(|base| {
            let mut settings = base.clone();
            settings.marker.neutral_frames = 99;
            Ok(settings)
        }),
        actor_revision: None,
    }
}

#[tokio::test(start_paused = true)]
async fn an_update_that_the_session_refuses_leaves_the_catalogue_as_it_was() {
    let stage = Stage::new().await;
    let id = SessionId::from_resource(SESSION).unwrap();
    let before = stage.store.session(&id).await.unwrap();
    // The session's task gets no turn between these, so they fill its queue.
    let next = NeutralSource::NextFrames;
    while stage.session.recenter(next).now_or_never().is_none() {}
    let refused = stage.sessions.update(&id, wider()).await.unwrap_err();
    assert_refused(&refused, Code::ResourceExhausted, "SESSION_BUSY");
    let after = stage.store.session(&id).await.unwrap();
    assert_eq!(after, before);
    assert_ne!(stage.session.settings().marker.neutral_frames, 99);
    tokio::task::yield_now().await;
    stage.sessions.update(&id, wider()).await.unwrap();
    assert_eq!(stage.session.settings().marker.neutral_frames, 99);
}

#[tokio::test(start_paused = true)]
async fn a_session_of_which_only_the_catalogue_knows_ended_for_everyone() {
    let stage = Stage::new().await;
    let id = SessionId::from_resource(SESSION).unwrap();
    stage.sessions.end(&id).await.unwrap();
    let refused = stage.sessions.update(&id, wider()).await.unwrap_err();
    assert_refused(&refused, Code::FailedPrecondition, "SESSION_ENDED");
    stage.registry.remove(&id);

    let ended = |status: &Status| {
        assert_refused(status, Code::FailedPrecondition, "SESSION_ENDED");
        assert_eq!(
            status.message(),
            "the session ended; its samples are no longer kept"
        );
    };
    ended(&stage.sessions.update(&id, wider()).await.unwrap_err());
    let next = NeutralSource::NextFrames;
    ended(&stage.sessions.recenter(&id, next).await.unwrap_err());
    ended(&stage.sessions.handle(&id).await.unwrap_err());
    ended(&stage.start(start("stage")).await.end().await);
    ended(&stage.subscribe(every_frame()).await.end().await.1);
    let follow = stage.curves.follow(asked(every_frame())).await;
    ended(&follow.err().unwrap());
}
