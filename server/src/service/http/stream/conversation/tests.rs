//! Rows E13, F4 and F5: peers that say nothing, too much, or half of something, or do not read, on a paused clock.

use frontalis_proto::v1;
use futures::stream;
use tokio::{
    io::{DuplexStream, duplex},
    task::JoinHandle,
    time::{Instant, sleep},
};
use tokio_tungstenite::tungstenite::protocol::{Role, WebSocketConfig};

use super::*;
use crate::service::grpc::{
    curves::MAX_PAUSE,
    stage::{Stage, peer},
};

const LIMIT_BYTES: usize = 1_024;

type Answer = Result<v1::SubscribeResponse, Status>;

/// A conversation with a stream that never says anything, and the other end of its connection.
fn silent() -> (JoinHandle<()>, DuplexStream) {
    talk(Box::pin(stream::pending()), 64 * 1024)
}

fn talk(
    responses: Responses<v1::SubscribeResponse>,
    n_bytes: usize,
) -> (JoinHandle<()>, DuplexStream) {
    // As the contract's stream does: requests are read, and a broken one ends it.
    let (inbox, requests) = mpsc::channel::<Result<v1::SubscribeRequest, Status>>(0);
    let broken = requests.filter_map(async |it| it.err().map(Answer::Err));
    let responses = stream::select(broken.chain(stream::pending()), responses);
    talk_to(inbox, Box::pin(responses), n_bytes)
}

fn talk_to(
    inbox: mpsc::Sender<Result<v1::SubscribeRequest, Status>>,
    responses: Responses<v1::SubscribeResponse>,
    n_bytes: usize,
) -> (JoinHandle<()>, DuplexStream) {
    let (client, server) = duplex(n_bytes);
    let talking = tokio::spawn(async move {
        let config = WebSocketConfig::default()
            .read_buffer_size(256)
            .write_buffer_size(0)
            .max_message_size(Some(LIMIT_BYTES))
            .max_frame_size(Some(LIMIT_BYTES));
        let io = Metered::new(server);
        let socket = WebSocketStream::from_raw_socket(io, Role::Server, Some(config)).await;
        let topic = Topic {
            session: "sessions/one".into(),
            instance: "/here".into(),
            taken: Taken::none("message"),
            form: Form::Json,
            limit_bytes: LIMIT_BYTES,
            finishes: false,
        };
        let conversation = Conversation::new(topic, socket, inbox, responses);
        conversation.run().await;
    });
    (talking, client)
}

async fn client_of(io: DuplexStream) -> WebSocketStream<DuplexStream> {
    WebSocketStream::from_raw_socket(io, Role::Client, None).await
}

/// Reads to the end, without an answer: the code and the reason of the close frame, which the last text explains.
async fn last_words(mut io: DuplexStream) -> (u16, String) {
    let mut bytes = Vec::new();
    io.read_to_end(&mut bytes).await.unwrap();
    let (mut rest, mut problem) = (bytes.as_slice(), String::new());
    loop {
        let (n, payload) = match rest[1] {
            126 => (u16::from_be_bytes([rest[2], rest[3]]).into(), &rest[4..]),
            n => (usize::from(n), &rest[2..]),
        };
        let text = |from: usize| String::from_utf8(payload[from..n].to_vec()).unwrap();
        match rest[0] {
            0x81 => problem = text(0),
            0x88 => {
                let reason = text(2);
                let named = format!("urn:frontalis:problem:{reason}");
                assert!(problem.contains(&named), "{problem}");
                assert!(problem.contains(r#""instance":"/here""#), "{problem}");
                return (u16::from_be_bytes([payload[0], payload[1]]), reason);
            }
            _ => {}
        }
        rest = &payload[n..];
    }
}

#[tokio::test(start_paused = true)]
async fn e13_a_peer_that_sends_no_pong_is_closed_after_thirty_seconds() {
    let (talking, io) = silent();
    let began = Instant::now();
    talking.await.unwrap();
    let silence = began.elapsed();
    assert!((30..=34).contains(&silence.as_secs()), "{silence:?}");
    assert_eq!(last_words(io).await, (1008, "NO_PONG".to_owned()));
}

#[tokio::test(start_paused = true)]
async fn a_peer_that_answers_pings_may_say_nothing_else() {
    let (talking, io) = silent();
    let mut client = client_of(io).await;
    let mut n_pings = 0;
    let reading = async {
        while let Some(Ok(message)) = client.next().await {
            assert!(matches!(message, Message::Ping(_)), "{message}");
            n_pings += 1;
        }
    };
    drop(timeout(Duration::from_mins(10), reading).await);
    assert!((50..=60).contains(&n_pings), "{n_pings}");
    assert!(!talking.is_finished());
}

#[tokio::test(start_paused = true)]
async fn e13_a_ping_flood_is_closed() {
    let (_talking, mut io) = silent();
    let ping = [&[0x89, 0x84, 0, 0, 0, 0][..], b"beat"].concat();
    io.write_all(&ping.repeat(200)).await.unwrap();
    assert_eq!(last_words(io).await, (1008, "PING_FLOOD".to_owned()));
}

#[tokio::test(start_paused = true)]
async fn f5_a_message_that_drips_in_is_closed_after_ten_seconds() {
    let (talking, mut io) = silent();
    let began = Instant::now();
    // A masked text frame of 100 bytes, one byte a second, and a pong between fragments changes nothing.
    let mut bytes = vec![0x81, 0xe4, 0, 0, 0, 0];
    bytes.extend([b' '; 100]);
    for byte in bytes {
        if talking.is_finished() || io.write_all(&[byte]).await.is_err() {
            break;
        }
        sleep(Duration::from_secs(1)).await;
    }
    let elapsed = began.elapsed();
    assert!((10..=15).contains(&elapsed.as_secs()), "{elapsed:?}");
    assert_eq!(last_words(io).await, (1008, "MESSAGE_DEADLINE".to_owned()));
}

#[tokio::test(start_paused = true)]
async fn e13_endless_empty_fragments_are_closed_after_ten_seconds() {
    let (talking, mut io) = silent();
    let began = Instant::now();
    io.write_all(&[0x01, 0x80, 0, 0, 0, 0]).await.unwrap();
    while !talking.is_finished() {
        // Continuations of nothing, with pongs between them.
        let parts = [[0x00, 0x80, 0, 0, 0, 0], [0x8a, 0x80, 0, 0, 0, 0]].concat();
        if io.write_all(&parts).await.is_err() {
            break;
        }
        sleep(Duration::from_secs(1)).await;
    }
    let elapsed = began.elapsed();
    assert!((10..=15).contains(&elapsed.as_secs()), "{elapsed:?}");
    assert_eq!(last_words(io).await, (1008, "MESSAGE_DEADLINE".to_owned()));
}

#[tokio::test(start_paused = true)]
async fn f4_a_peer_that_talks_and_does_not_read_is_cut_after_thirty_seconds() {
    let endless = stream::repeat_with(|| Ok(v1::SubscribeResponse::default()));
    let (talking, mut io) = talk(Box::pin(endless), 512);
    let began = Instant::now();
    let grant = [&[0x81, 0x82, 0, 0, 0, 0][..], b"{}"].concat();
    while !talking.is_finished() {
        drop(io.write_all(&grant).await);
        sleep(Duration::from_secs(1)).await;
    }
    let elapsed = began.elapsed();
    assert!((30..=34).contains(&elapsed.as_secs()), "{elapsed:?}");
}

/// A text message that is not masked, and a start of every frame.
fn start_of_every_frame() -> Vec<u8> {
    let start = br#"{"start":{"delivery":"DELIVERY_EVERY_FRAME","fromOldest":true}}"#;
    let length = 0x80 | u8::try_from(start.len()).unwrap();
    [&[0x81, length, 0, 0, 0, 0][..], start].concat()
}

#[tokio::test(start_paused = true)]
async fn f4_a_subscriber_of_every_frame_that_takes_nothing_for_thirty_seconds_loses_its_place() {
    let stage = Stage::new().await;
    let (inbox, requests) = mpsc::channel(0);
    let responses = stage.curves.subscription(requests, peer());
    let (talking, mut io) = talk_to(inbox, responses, 512);
    io.write_all(&start_of_every_frame()).await.unwrap();
    let mut publisher = stage.publisher("stage").await;
    publisher.publish(stage.frames(1..=100)).await;
    let n_subscribers = || stage.session.status().subscribers.len();
    sleep(MAX_PAUSE.saturating_sub(TICK)).await;
    assert_eq!(n_subscribers(), 1);
    sleep(TICK).await;
    assert_eq!(n_subscribers(), 0, "its place is not free");
    // It reads again while the last words are said.
    sleep(TICK * 2).await;
    assert!(!talking.is_finished());
    let lagged = (1013, "SUBSCRIBER_LAGGED".to_owned());
    assert_eq!(last_words(io).await, lagged);
    talking.await.unwrap();
}

#[tokio::test(start_paused = true)]
async fn a_peer_that_reads_slowly_is_not_cut() {
    let endless = stream::repeat_with(|| Ok(v1::SubscribeResponse::default()));
    let (talking, mut io) = talk(Box::pin(endless), 16);
    io.write_all(&start_of_every_frame()).await.unwrap();
    for _ in 0..60 {
        // Two messages.
        io.read_exact(&mut [0; 8]).await.unwrap();
        sleep(Duration::from_secs(5)).await;
    }
    assert!(!talking.is_finished());
}

/// CONTRACTS D-15.
#[tokio::test(start_paused = true)]
async fn a_subscriber_of_the_newest_sample_may_stop_reading_for_any_time() {
    for (delivery, may_pause) in [("DELIVERY_LATEST", true), ("DELIVERY_EVERY_FRAME", false)] {
        for responses in [
            stream::pending().boxed(),
            stream::repeat_with(|| Ok(v1::SubscribeResponse::default())).boxed(),
        ] {
            let (talking, mut io) = talk(responses, 512);
            let start = format!(r#"{{"start":{{"delivery":"{delivery}"}}}}"#);
            let head = [0x81, 0x80 | u8::try_from(start.len()).unwrap(), 0, 0, 0, 0];
            io.write_all(&[&head[..], start.as_bytes()].concat())
                .await
                .unwrap();
            sleep(Duration::from_mins(10)).await;
            assert_eq!(talking.is_finished(), !may_pause, "{delivery}");
            drop(io);
            talking.await.unwrap();
        }
    }
}

#[tokio::test(start_paused = true)]
async fn e13_what_breaks_the_protocol_has_the_close_code_of_its_kind() {
    let text = |opcode: u8, payload: &[u8]| {
        let n = u8::try_from(payload.len()).unwrap();
        [&[opcode, 0x80 | n, 0, 0, 0, 0][..], payload].concat()
    };
    let large = [&[0x81, 0xff, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0][..]].concat();
    let fragments: Vec<u8> = std::iter::once(text(0x01, &[b' '; 100]))
        .chain(std::iter::repeat_n(text(0x00, &[b' '; 100]), 20))
        .flatten()
        .collect();
    for (sent, code, reason) in [
        (text(0x82, b"\x10\x02"), 1003, "MESSAGE_FORM"),
        (large, 1009, "MESSAGE_SIZE"),
        (fragments, 1009, "MESSAGE_SIZE"),
        (text(0xf1, b"{}"), 1002, "WEBSOCKET"),
        (text(0x83, b"{}"), 1002, "WEBSOCKET"),
        (text(0x00, b"{}"), 1002, "WEBSOCKET"),
        (vec![0x81, 0x02, b'{', b'}'], 1002, "WEBSOCKET"),
        (text(0x81, b"\xff\xfe"), 1007, "UTF8"),
        (text(0x81, b"{"), 1007, "JSON"),
        (text(0x81, b"{\"nothing\":1}"), 1007, "JSON"),
    ] {
        let (_talking, mut io) = silent();
        io.write_all(&sent).await.unwrap();
        assert_eq!(last_words(io).await, (code, reason.to_owned()), "{sent:x?}");
    }
}
