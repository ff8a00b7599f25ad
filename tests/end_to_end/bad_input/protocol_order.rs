//! Row E8: streams whose messages come in another order than the contract says.

use frontalis_proto::v1::{
    ImportActorRequest, ImportActorStart, PublishMarkersRequest, SubscribeRequest,
    capture_service_client::CaptureServiceClient, curve_service_client::CurveServiceClient,
};
use harness::{Subscriber, assert_refused, every_frame};
use tonic::Code;

use super::{SUBJECT, beside_a_control_session};

const REASON: &str = "PROTOCOL_ORDER";

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e8_frames_before_start_are_refused() {
    beside_a_control_session("E8 publish", async |stage| {
        let message = PublishMarkersRequest {
            frames: stage.performance.frames(1..=1),
            ..PublishMarkersRequest::default()
        };
        let mut client = CaptureServiceClient::new(stage.server.channel().await);
        let refused = match client.publish_markers(tokio_stream::once(message)).await {
            Err(status) => status,
            Ok(answer) => answer.into_inner().message().await.unwrap_err(),
        };
        assert_refused(&refused, Code::FailedPrecondition, REASON);

        let mut publisher = stage.publisher().await;
        let again = PublishMarkersRequest {
            start: Some(stage.performance.start(SUBJECT, "camera-1")),
            ..PublishMarkersRequest::default()
        };
        publisher.send_message(again).await;
        assert_refused(
            &publisher.broken_off().await,
            Code::FailedPrecondition,
            REASON,
        );
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e8_credits_before_start_are_refused() {
    beside_a_control_session("E8 subscribe", async |stage| {
        let credits = SubscribeRequest {
            start: None,
            credits: 2,
        };
        let mut client = CurveServiceClient::new(stage.server.channel().await);
        let refused = match client.subscribe(tokio_stream::once(credits)).await {
            Err(status) => status,
            Ok(answer) => answer.into_inner().message().await.unwrap_err(),
        };
        assert_refused(&refused, Code::FailedPrecondition, REASON);

        let mut subscriber = Subscriber::open(&stage.server, every_frame(SUBJECT))
            .await
            .unwrap();
        let again = SubscribeRequest {
            start: Some(every_frame(SUBJECT)),
            credits: 0,
        };
        subscriber.send(again).await;
        let refused = loop {
            match subscriber.next().await {
                Ok(heard) => assert!(heard.is_some(), "the stream ended in peace"),
                Err(status) => break status,
            }
        };
        assert_refused(&refused, Code::FailedPrecondition, REASON);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn e8_a_package_before_start_is_refused() {
    beside_a_control_session("E8 import", async |stage| {
        let chunk = ImportActorRequest {
            start: None,
            chunk: vec![0; 16],
        };
        let start = ImportActorRequest {
            start: Some(ImportActorStart {
                actor_id: "other".to_owned(),
                ..ImportActorStart::default()
            }),
            chunk: Vec::new(),
        };
        let mut client = stage.server.actors().await;
        for messages in [vec![chunk.clone()], vec![start.clone(), chunk, start]] {
            let refused = client
                .import_actor(tokio_stream::iter(messages))
                .await
                .unwrap_err();
            assert_refused(&refused, Code::FailedPrecondition, REASON);
        }
    })
    .await;
}
