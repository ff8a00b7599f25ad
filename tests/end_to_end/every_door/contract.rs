//! What holds at each door: where a client goes on, how a stream ends, what is refused, and what is left behind.

use frontalis_proto::v1::{
    PublishMarkersRequest, PublishResponse, SubscribeRequest, SubscribeResponse, SubscribeStart,
};
use harness::{
    EventStream, GrpcWeb, LinePublisher, Publisher, TestPerformance, TestServer, WebSocket,
    assert_eventually, every_frame, latest,
};
use tokio_tungstenite::tungstenite;

const SESSION: &str = "sessions/stage";
const EVENTS: &str = "/api/v1/sessions/stage/events";
const FRAMES: u64 = 60;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_browser_that_comes_back_goes_on_behind_its_last_event() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let mut publisher = publisher(&server, &performance).await;
    publisher.publish(performance.frames(1..=FRAMES)).await;
    let path = format!("{EVENTS}?delivery=every_frame&fromOldest=true");
    let mut sequences = Vec::new();
    let mut last_event_id = String::new();
    // Every connection is cut after a few events.
    while sequences.len() < 40 {
        let limited = format!("{path}&limit=7");
        let mut events = EventStream::open(&server, &limited, &last_event_id)
            .await
            .unwrap();
        while let Some(answer) = events.answer().await {
            sequences.extend(answer.unwrap().samples.iter().map(|it| it.sequence));
        }
        last_event_id = events.last_event_id;
    }
    assert_eq!(last_event_id, "1:42");
    let mut events = EventStream::open(&server, &path, &last_event_id)
        .await
        .unwrap();
    publisher
        .publish(performance.frames(FRAMES + 1..=2 * FRAMES))
        .await;
    server.end_session(SESSION).await;
    while let Some(answer) = events.answer().await {
        sequences.extend(answer.unwrap().samples.iter().map(|it| it.sequence));
    }
    assert_eq!(sequences, (1..=2 * FRAMES).collect::<Vec<_>>());
    assert_eq!(events.last_event_id, "1:120:end");
    for everything in ["1:120:end", "1:120"] {
        let over = EventStream::open(&server, &path, everything).await;
        assert_eq!(over.err().unwrap().status, 204, "{everything}");
    }
    let mut rest = EventStream::open(&server, &path, "1:119").await.unwrap();
    while let Some(answer) = rest.answer().await {
        sequences.extend(answer.unwrap().samples.iter().map(|it| it.sequence));
    }
    assert_eq!(sequences.last(), Some(&(2 * FRAMES)));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_socket_that_stalls_gets_its_credits_of_stale_samples_and_then_the_newest() {
    const CREDITS: u32 = 3;
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let mut publisher = publisher(&server, &performance).await;
    let mut wall = subscriber(
        &server,
        "frontalis.v1.subscribe+json",
        latest(SESSION, CREDITS),
    )
    .await;
    for first in (1..=1_000).step_by(20) {
        publisher
            .publish(performance.frames(first..=first + 19))
            .await;
    }
    assert_eventually!(server.session(SESSION).await.status.unwrap().last_frame == 1_000);
    let (mut n_stale, mut n_received) = (0, 0);
    loop {
        let answer: SubscribeResponse = wall.next().await.unwrap();
        let Some(sample) = answer.samples.first() else {
            continue;
        };
        assert_eq!(answer.samples.len(), 1);
        n_received += 1;
        if sample.frame == 1_000 {
            assert_eq!(answer.skipped_samples, 1_000 - n_received);
            break;
        }
        n_stale += 1;
        wall.send(&SubscribeRequest {
            start: None,
            credits: 1,
        })
        .await;
    }
    assert!(n_stale <= CREDITS, "{n_stale}");
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_drain_ends_every_door_with_its_reason() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let first = first_line(&performance);
    let mut lines = LinePublisher::open(&server, "stage", first).await.unwrap();
    let mut events = EventStream::open(&server, EVENTS, "").await.unwrap();
    let mut web = GrpcWeb::follow(&server, &every_frame(SESSION)).await;
    let mut socket = subscriber(
        &server,
        "frontalis.v1.subscribe+proto",
        every_frame(SESSION),
    )
    .await;
    let mut silent = WebSocket::open(&server, "stage", "frontalis.v1.publish+json")
        .await
        .unwrap();
    server.begin_drain();

    let problem = loop {
        if let Err(problem) = lines.next().await.unwrap() {
            break problem;
        }
    };
    assert_eq!(problem["type"], "urn:frontalis:problem:DRAINING");
    assert_eq!(problem["instance"], "/api/v1/sessions/stage/frames");
    assert!(lines.next().await.is_none());
    let problem = loop {
        if let Err(problem) = events.answer().await.unwrap() {
            break problem;
        }
    };
    assert_eq!(
        (&problem["status"], &problem["title"]),
        (&503.into(), &"The server is shutting down".into())
    );
    assert!(events.answer().await.is_none());
    while web.next().await.is_some() {}
    assert!(web.trailers.contains("grpc-status:14"), "{}", web.trailers);
    for socket in [&mut socket, &mut silent] {
        let closed = loop {
            if let Err(closed) = socket.next::<SubscribeResponse>().await {
                break closed;
            }
        };
        assert_eq!((closed.code, closed.reason.as_str()), (1001, "DRAINING"));
        assert_eq!(closed.problem.unwrap()["status"], 503);
    }
    drop((socket, silent));
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_cannot_begin_is_refused_with_its_status() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    for (query, field) in [
        ("delivery=all", "delivery"),
        ("limit=many", "limit"),
        ("withMarkers=1", "withMarkers"),
        ("run=1&run=1", "run"),
        ("maxRateHz=-1", "maxRateHz"),
        ("maxRateHz=1000001", "maxRateHz"),
        ("controlSpace=arkit", "controlSpace"),
        ("subscriber=%0A", "subscriber"),
    ] {
        let path = format!("{EVENTS}?{query}");
        let refused = EventStream::open(&server, &path, "").await.err().unwrap();
        assert_eq!(refused.json()["field"], field, "{}", refused.text());
    }
    for (path, status, reason) in [
        ("/api/v1/sessions/nobody/events", 404, "SESSION"),
        ("/api/v1/sessions/NOBODY/events", 400, "NAME"),
        ("/api/v1/sessions/stage/events?delivery=all", 400, "ENUM"),
        ("/api/v1/sessions/stage/events?limit=many", 400, "QUERY"),
        ("/api/v1/sessions/stage/events?credits=2", 400, "QUERY"),
        (
            "/api/v1/sessions/stage/events?delivery=every_frame&run=9&fromSequence=1",
            416,
            "NEW_RUN",
        ),
        (
            "/api/v1/sessions/stage/events?controlSpace=arkit",
            501,
            "NOT_IMPLEMENTED",
        ),
        ("/api/v1/sessions/stage/stream", 426, "UPGRADE"),
    ] {
        let refused = EventStream::open(&server, path, "").await.err().unwrap();
        assert_eq!(refused.status, status, "{path}: {}", refused.text());
        assert_eq!(
            refused.json()["type"],
            format!("urn:frontalis:problem:{reason}"),
            "{path}"
        );
    }
    let refused = EventStream::open(&server, EVENTS, "yesterday")
        .await
        .err()
        .unwrap();
    assert_eq!(refused.json()["type"], "urn:frontalis:problem:EVENT_ID");

    let refused = async |line: String| {
        LinePublisher::open(&server, "stage", line)
            .await
            .err()
            .unwrap()
    };
    let early = refused(r#"{"frames":[]}"#.to_owned()).await;
    assert_eq!(
        (early.status.as_u16(), &early.json()["type"]),
        (409, &"urn:frontalis:problem:PROTOCOL_ORDER".into())
    );
    let broken = refused(r#"{"start":"#.to_owned()).await;
    assert_eq!(
        (broken.status.as_u16(), &broken.json()["type"]),
        (400, &"urn:frontalis:problem:JSON".into())
    );
    let other = first_line(&performance).replace("sessions/stage", "sessions/other");
    let other = refused(other).await.json();
    assert_eq!(
        (&other["type"], &other["field"], &other["line"]),
        (
            &"urn:frontalis:problem:SESSION_MISMATCH".into(),
            &"start.session".into(),
            &1.into()
        )
    );
    let long = format!("{{\"start\":\"{}", " ".repeat(2 << 20));
    assert_eq!(refused(long).await.status, 413);

    for (id, subprotocol, status) in [
        ("stage", "frontalis.v2.subscribe+json", 400),
        ("STAGE", "frontalis.v1.subscribe+json", 400),
    ] {
        let refused = WebSocket::open(&server, id, subprotocol).await;
        assert_eq!(refused.err(), Some(status), "{subprotocol}");
    }
    let mut nobody = WebSocket::open(&server, "nobody", "frontalis.v1.subscribe+proto")
        .await
        .unwrap();
    nobody
        .send(&SubscribeRequest {
            start: Some(latest("", 1)),
            credits: 0,
        })
        .await;
    let closed = nobody.next::<SubscribeResponse>().await.unwrap_err();
    assert_eq!((closed.code, closed.reason.as_str()), (1008, "SESSION"));
    assert_eq!(closed.problem.unwrap()["status"], 404);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_broken_line_ends_the_stream_and_what_was_taken_stays() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let mut lines = LinePublisher::open(&server, "stage", first_line(&performance))
        .await
        .unwrap();
    lines.send(&message(&performance, 1..=30)).await;
    lines
        .send_line(r#"{"frames":[{"number":"31","positions":[null]}]}"#.to_owned())
        .await;
    let mut accepted = PublishResponse::default();
    let problem = loop {
        match lines.next().await.unwrap() {
            Ok(answer) => accepted = answer,
            Err(problem) => break problem,
        }
    };
    assert_eq!(accepted.accepted_through, 30);
    assert_eq!(problem["type"], "urn:frontalis:problem:JSON");
    assert_eq!(
        (&problem["line"], &problem["field"]),
        (&3.into(), &"frames[0].positions[0]".into())
    );
    assert!(
        problem["detail"].as_str().unwrap().contains("\"NaN\""),
        "{problem}"
    );
    assert!(lines.next().await.is_none());
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_broken_message_is_told_by_its_number_however_many_follow_it() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let again: PublishMarkersRequest = serde_json::from_str(&first_line(&performance)).unwrap();
    for (subprotocol, field) in [
        ("frontalis.v1.publish+json", Some("frames[0].number")),
        ("frontalis.v1.publish+proto", None),
    ] {
        let mut socket = WebSocket::open(&server, "stage", subprotocol)
            .await
            .unwrap();
        socket.send(&again).await;
        socket.next::<PublishResponse>().await.unwrap();
        socket.send(&message(&performance, 1..=3)).await;
        let reason = if field.is_some() {
            let broken = r#"{"frames":[{"number":1.5}]}"#;
            socket.send_raw(tungstenite::Message::text(broken)).await;
            "JSON"
        } else {
            socket.send(&again).await;
            "PROTOCOL_ORDER"
        };
        for number in 4..9 {
            socket.send(&message(&performance, number..=number)).await;
        }
        let problem = loop {
            if let Err(closed) = socket.next::<PublishResponse>().await {
                break closed.problem.unwrap();
            }
        };
        assert_eq!(
            problem["type"],
            format!("urn:frontalis:problem:{reason}"),
            "{problem}"
        );
        assert_eq!(problem["message"], 3, "{problem}");
        assert_eq!(problem["field"].as_str(), field, "{problem}");
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_client_that_goes_leaves_nothing_behind() {
    let server = TestServer::with_session("stage").await;
    let performance = TestPerformance::reference();
    let events = EventStream::open(&server, EVENTS, "").await.unwrap();
    let web = GrpcWeb::follow(&server, &latest(SESSION, 0)).await;
    let json = subscriber(&server, "frontalis.v1.subscribe+json", latest(SESSION, 2)).await;
    let protobuf = subscriber(
        &server,
        "frontalis.v1.subscribe+proto",
        every_frame(SESSION),
    )
    .await;
    assert_eventually!(
        server
            .session(SESSION)
            .await
            .status
            .unwrap()
            .subscribers
            .len()
            == 4
    );
    drop((events, web, json));
    protobuf.close().await;
    assert_eventually!(
        server
            .session(SESSION)
            .await
            .status
            .unwrap()
            .subscribers
            .is_empty()
    );

    // A publisher's goodbye gives the session back at once, with everything it had sent.
    let mut socket = WebSocket::open(&server, "stage", "frontalis.v1.publish+proto")
        .await
        .unwrap();
    let first = PublishMarkersRequest {
        start: Some(performance.start(SESSION, "camera-1")),
        ..PublishMarkersRequest::default()
    };
    socket.send(&first).await;
    socket.next::<PublishResponse>().await.unwrap();
    socket.send(&message(&performance, 1..=100)).await;
    socket.close().await;
    assert_eventually!(server.session(SESSION).await.status.unwrap().last_frame == 100);
    let other = performance.start(SESSION, "camera-2");
    assert_eventually!(Publisher::open(&server, other.clone()).await.is_ok());
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn every_door_has_its_place_among_the_subscribers() {
    let server = TestServer::start_with(|config| config.limits.subscribers_per_session = 1).await;
    server.import_reference().await;
    server
        .create_session("stage", "actors/reference")
        .await
        .unwrap();
    let held = EventStream::open(&server, EVENTS, "").await.unwrap();
    let refused = EventStream::open(&server, EVENTS, "").await.err().unwrap();
    assert_eq!(
        (refused.status.as_u16(), &refused.json()["type"]),
        (429, &"urn:frontalis:problem:SUBSCRIBERS".into())
    );
    let web = GrpcWeb::follow(&server, &latest(SESSION, 0)).await;
    assert!(web.trailers.contains("grpc-status:8"), "{}", web.trailers);
    let mut socket = WebSocket::open(&server, "stage", "frontalis.v1.subscribe+json")
        .await
        .unwrap();
    socket
        .send(&SubscribeRequest {
            start: Some(latest("", 1)),
            credits: 0,
        })
        .await;
    let closed = socket.next::<SubscribeResponse>().await.unwrap_err();
    assert_eq!((closed.code, closed.reason.as_str()), (1013, "SUBSCRIBERS"));
    drop(held);
    assert_eventually!(EventStream::open(&server, EVENTS, "").await.is_ok());
    server.stop().await;
}

async fn publisher(server: &TestServer, performance: &TestPerformance) -> Publisher {
    let start = performance.start(SESSION, "camera-1");
    Publisher::open(server, start).await.unwrap()
}

/// A socket that has read its header.
async fn subscriber(server: &TestServer, subprotocol: &str, start: SubscribeStart) -> WebSocket {
    let mut socket = WebSocket::open(server, "stage", subprotocol).await.unwrap();
    socket
        .send(&SubscribeRequest {
            start: Some(start),
            credits: 0,
        })
        .await;
    let first: SubscribeResponse = socket.next().await.unwrap();
    assert!(first.header.is_some());
    socket
}

fn message(
    performance: &TestPerformance,
    numbers: std::ops::RangeInclusive<u64>,
) -> PublishMarkersRequest {
    PublishMarkersRequest {
        frames: performance.frames(numbers),
        ..PublishMarkersRequest::default()
    }
}

fn first_line(performance: &TestPerformance) -> String {
    let first = PublishMarkersRequest {
        start: Some(performance.start(SESSION, "camera-1")),
        ..PublishMarkersRequest::default()
    };
    serde_json::to_string(&first).unwrap()
}
