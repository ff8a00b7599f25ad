//! One take through every door: whoever publishes it and whoever follows it, the samples are the same to the last bit.

mod contract;

use frontalis_proto::v1::{
    CurveSample, MarkerFrame, PublishMarkersRequest, PublishResponse, ReadCurvesResponse,
    SubscribeRequest, SubscribeResponse, SubscribeStart, Timecode,
};
use harness::{
    EventStream, GrpcWeb, LinePublisher, Publisher, Received, Subscriber, TestPerformance,
    TestServer, WebSocket, assert_eventually, every_frame, http_get,
};
use tokio::task::JoinHandle;

const FRAMES: u64 = 320;
/// Frames that the capture system skipped.
const SKIPPED: std::ops::RangeInclusive<u64> = 101..=103;
/// Frames of one message.
const BATCH: usize = 7;

/// A way in.
#[derive(Clone, Copy, Debug, PartialEq)]
enum In {
    Grpc,
    Lines,
    WebSocketJson,
    WebSocketProtobuf,
}

const WAYS_IN: [In; 4] = [
    In::Grpc,
    In::Lines,
    In::WebSocketJson,
    In::WebSocketProtobuf,
];

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_take_gives_the_same_bits_through_every_door() {
    let server = TestServer::start().await;
    server.import_reference().await;
    let mut takes = Vec::new();
    for way_in in WAYS_IN {
        takes.push(take(&server, way_in).await);
    }
    for (way_in, take) in WAYS_IN.into_iter().zip(&takes) {
        assert_eq!(take, &takes[0], "published over {way_in:?}");
    }
    server.stop().await;
}

/// Publishes a take into a session of its own, and follows it through every door; the samples, without their times.
async fn take(server: &TestServer, way_in: In) -> Vec<Vec<u8>> {
    let id = format!("take-{way_in:?}").to_lowercase();
    let session = format!("sessions/{id}");
    server
        .create_session(&id, "actors/reference")
        .await
        .unwrap();
    let performance = TestPerformance::reference();
    let followers = follow(server, &id).await;
    assert_eventually!(
        server
            .session(&session)
            .await
            .status
            .unwrap()
            .subscribers
            .len()
            == 6
    );
    let status = server.session(&session).await.status.unwrap();
    let mut protocols: Vec<_> = status
        .subscribers
        .into_iter()
        .map(|it| it.protocol)
        .collect();
    protocols.sort_unstable();
    assert_eq!(
        protocols,
        [
            "grpc",
            "grpc-web",
            "grpc-web",
            "sse",
            "websocket",
            "websocket"
        ]
    );
    publish(server, way_in, &id, &performance).await;
    assert_eventually!(server.session(&session).await.status.unwrap().last_frame == FRAMES);
    let polled = poll(server, &id).await;
    server.end_session(&session).await;

    let mut first: Option<Received> = None;
    for (name, following) in followers {
        let received = following.await.unwrap();
        assert_eq!(received.samples.len() as u64, FRAMES - 3, "{name}");
        assert_eq!(received.gaps.len(), 1, "{name}");
        assert_eq!(received.end.as_ref().unwrap().last_frame, FRAMES, "{name}");
        let first = first.get_or_insert_with(|| received.clone());
        assert_eq!(bits(&received.samples), bits(&first.samples), "{name}");
        assert_eq!(
            (&received.gaps, &received.end),
            (&first.gaps, &first.end),
            "{name}"
        );
        let header = |it: &Received| {
            it.header
                .clone()
                .map(|it| (it.session, it.controls, it.run))
        };
        assert_eq!(header(&received), header(first), "{name}");
    }
    let first = first.unwrap();
    assert_eq!(bits(&polled.samples), bits(&first.samples), "polling");
    assert_eq!(polled.gaps, first.gaps, "polling");
    for sample in &first.samples {
        let errors = &sample.standard_errors;
        assert_eq!(errors.len(), sample.activations.len());
        assert!(
            errors.iter().all(|it| it.is_finite() && *it >= 0.0),
            "{errors:?}"
        );
    }
    let timeless = |mut it: CurveSample| {
        it.solved_time_nanos = 0;
        it
    };
    let samples: Vec<_> = first.samples.into_iter().map(timeless).collect();
    bits(&samples)
}

/// Every field of every sample: equal bytes are equal bits.
fn bits(samples: &[CurveSample]) -> Vec<Vec<u8>> {
    samples.iter().map(prost::Message::encode_to_vec).collect()
}

type Following = (&'static str, JoinHandle<Received>);

/// Follows the session to its end through every door that streams.
async fn follow(server: &TestServer, id: &str) -> Vec<Following> {
    let session = format!("sessions/{id}");
    let start = SubscribeStart {
        with_markers: true,
        with_uncertainty: true,
        ..every_frame(&session)
    };

    let mut grpc = Subscriber::open(server, start.clone()).await.unwrap();
    let over_grpc = tokio::spawn(async move {
        let mut received = Received::default();
        while let Some(answer) = grpc.answer().await.unwrap() {
            received.take(answer);
        }
        received.header = Some(grpc.header);
        received
    });

    let over_web = follow_web(GrpcWeb::follow(server, &start).await);
    let over_web_text = follow_web(GrpcWeb::follow_as_text(server, &start).await);

    let path = format!(
        "/api/v1/sessions/{id}/events?delivery=every_frame&fromOldest=true&withMarkers=true&withUncertainty=true"
    );
    let mut events = EventStream::open(server, &path, "").await.unwrap();
    let over_events = tokio::spawn(async move {
        let mut received = Received::default();
        while let Some(answer) = events.answer().await {
            received.take(answer.unwrap());
        }
        received
    });

    let json = follow_socket(server, id, "frontalis.v1.subscribe+json", start.clone()).await;
    let protobuf = follow_socket(server, id, "frontalis.v1.subscribe+proto", start).await;
    vec![
        ("gRPC", over_grpc),
        ("gRPC-web", over_web),
        ("gRPC-web as text", over_web_text),
        ("SSE", over_events),
        ("WebSocket, JSON", json),
        ("WebSocket, protobuf", protobuf),
    ]
}

fn follow_web(mut web: GrpcWeb) -> JoinHandle<Received> {
    tokio::spawn(async move {
        let mut received = Received::default();
        while let Some(answer) = web.next().await {
            received.take(answer);
        }
        assert!(web.trailers.contains("grpc-status:0"), "{}", web.trailers);
        received
    })
}

async fn follow_socket(
    server: &TestServer,
    id: &str,
    subprotocol: &str,
    start: SubscribeStart,
) -> JoinHandle<Received> {
    let mut socket = WebSocket::open(server, id, subprotocol).await.unwrap();
    // The path says it.
    let start = SubscribeStart {
        session: String::new(),
        ..start
    };
    socket
        .send(&SubscribeRequest {
            start: Some(start),
            credits: 0,
        })
        .await;
    tokio::spawn(async move {
        let mut received = Received::default();
        loop {
            match socket.next::<SubscribeResponse>().await {
                Ok(answer) => received.take(answer),
                Err(closed) => {
                    assert_eq!((closed.code, closed.reason.as_str()), (1000, "END"));
                    return received;
                }
            }
        }
    })
}

/// Everything that the session holds, page by page.
async fn poll(server: &TestServer, id: &str) -> Received {
    let mut received = Received::default();
    let mut after = 0;
    loop {
        let path = format!(
            "/api/v1/sessions/{id}/curves?after={after}&limit=100&withMarkers=true&withUncertainty=true"
        );
        let answer = http_get(server, &path).await;
        assert!(!answer.text().contains("NaN") && !answer.text().contains("null"));
        let page: ReadCurvesResponse = serde_json::from_value(answer.json()).unwrap();
        received.samples.extend(page.samples);
        received.gaps.extend(page.gaps);
        if page.read_through == page.newest_sequence {
            return received;
        }
        after = page.read_through;
    }
}

/// The frames of the take: some markers hidden, some numbers skipped, timecode on.
fn frames(performance: &TestPerformance) -> Vec<MarkerFrame> {
    let numbers = (1..=FRAMES).filter(|it| !SKIPPED.contains(it));
    let frame = |number| {
        let mut frame = performance.frame(number);
        if number % 5 == 0 {
            let hidden = usize::try_from(number).unwrap() % performance.n_markers();
            frame.positions[3 * hidden..3 * hidden + 3].fill(f32::NAN);
        }
        frame.source_frame = (1 << 60) + number;
        frame.timecode = Some(Timecode {
            hours: 23,
            seconds: u32::try_from(number / 60).unwrap(),
            frames: u32::try_from(number % 60).unwrap(),
            rate_numerator: 60,
            rate_denominator: 1,
            ..Timecode::default()
        });
        frame
    };
    numbers.map(frame).collect()
}

async fn publish(server: &TestServer, way_in: In, id: &str, performance: &TestPerformance) {
    let start = performance.start(&format!("sessions/{id}"), "camera-1");
    let messages: Vec<_> = frames(performance)
        .chunks(BATCH)
        .map(|frames| PublishMarkersRequest {
            frames: frames.to_vec(),
            ..PublishMarkersRequest::default()
        })
        .collect();
    let first = PublishMarkersRequest {
        start: Some(start.clone()),
        ..PublishMarkersRequest::default()
    };
    match way_in {
        In::Grpc => {
            let mut publisher = Publisher::open(server, start).await.unwrap();
            for message in messages {
                publisher.send_message(message).await;
            }
            let report = publisher.finish().await.unwrap();
            assert_eq!(
                (report.accepted_through, report.rejected.len()),
                (FRAMES, 0)
            );
        }
        In::Lines => {
            let first = serde_json::to_string(&first).unwrap();
            let mut publisher = LinePublisher::open(server, id, first).await.unwrap();
            let sending = async {
                for message in &messages {
                    publisher.send(message).await;
                }
            };
            sending.await;
            publisher.close();
            let mut last = PublishResponse::default();
            while let Some(answer) = publisher.next().await {
                last = answer.unwrap();
                assert_eq!(last.rejected, []);
            }
            assert_eq!(last.accepted_through, FRAMES);
        }
        In::WebSocketJson => {
            publish_socket(server, id, "frontalis.v1.publish+json", first, messages).await;
        }
        In::WebSocketProtobuf => {
            publish_socket(server, id, "frontalis.v1.publish+proto", first, messages).await;
        }
    }
}

async fn publish_socket(
    server: &TestServer,
    id: &str,
    subprotocol: &str,
    first: PublishMarkersRequest,
    messages: Vec<PublishMarkersRequest>,
) {
    let mut socket = WebSocket::open(server, id, subprotocol).await.unwrap();
    socket.send(&first).await;
    let answer: PublishResponse = socket.next().await.unwrap();
    assert!(answer.started.is_some());
    for message in messages {
        socket.send(&message).await;
    }
    loop {
        let answer: PublishResponse = socket.next().await.unwrap();
        assert_eq!(answer.rejected, []);
        if answer.accepted_through == FRAMES {
            break;
        }
    }
    socket.close().await;
}
