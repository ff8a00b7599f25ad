//! Bodies cut anywhere, messages that stay incomplete, and what is held of them meanwhile (BAD_INPUT E1, E2, E5, E9, F5).

use futures::{FutureExt as _, StreamExt as _};
use http_body_util::{BodyExt as _, StreamBody};
use proptest::prelude::*;
use tokio::{sync::mpsc, time::Instant};
use tokio_stream::wrappers::ReceiverStream;

use super::*;
use crate::service::grpc::status::reason_of;

const LIMIT_BYTES: usize = 10_000;
/// Frames that a test may send before the body is polled.
const CAPACITY_FRAMES: usize = 64;
const DEADLINE: Duration = Duration::from_secs(10);

type Sender = mpsc::Sender<Result<Frame<Bytes>, Status>>;

/// A body that goes on as long as its sender lives.
fn open_body() -> (Sender, WholeMessages) {
    let (sender, frames) = mpsc::channel(CAPACITY_FRAMES);
    let body = Body::new(StreamBody::new(ReceiverStream::new(frames)));
    (sender, WholeMessages::new(body, LIMIT_BYTES, DEADLINE))
}

fn send(sender: &Sender, bytes: &[u8]) {
    let bytes = Bytes::copy_from_slice(bytes);
    sender.try_send(Ok(Frame::data(bytes))).unwrap();
}

fn message(content: &[u8]) -> Vec<u8> {
    let length = u32::try_from(content.len()).unwrap().to_be_bytes();
    [&[0][..], &length, content].concat()
}

/// A string of the greatest length that leaves room for its own head.
fn text(n_bytes: usize) -> Vec<u8> {
    let mut content = vec![0x0a];
    prost::encoding::encode_varint(n_bytes as u64, &mut content);
    content.resize(content.len() + n_bytes, b'x');
    content
}

async fn refusal(body: &mut WholeMessages) -> (Code, String) {
    let error = body.frame().await.unwrap().unwrap_err();
    let status = Status::from_error(error.into());
    let reason = reason_of(&status).unwrap();
    assert!(body.frame().await.is_none(), "something follows a refusal");
    (status.code(), reason)
}

fn refused(code: Code, reason: &str) -> (Code, String) {
    (code, reason.to_owned())
}

proptest! {
    #[test]
    fn every_byte_comes_out_in_order_however_the_body_is_cut(
        lengths in prop::collection::vec(0_usize..9_000, 1..6),
        cuts in prop::collection::vec(any::<prop::sample::Index>(), 0..12),
    ) {
        let sent: Vec<u8> = lengths.iter().flat_map(|it| message(&text(*it))).collect();
        let mut cuts: Vec<_> = cuts.iter().map(|it| it.index(sent.len())).collect();
        cuts.extend([0, sent.len()]);
        cuts.sort_unstable();
        let (sender, body) = open_body();
        for cut in cuts.windows(2) {
            send(&sender, &sent[cut[0]..cut[1]]);
        }
        drop(sender);
        let collected = body.collect().now_or_never().unwrap().unwrap();
        prop_assert_eq!(collected.to_bytes(), sent);
    }
}

#[tokio::test(start_paused = true)]
async fn a_message_that_stays_incomplete_ends_the_body_after_its_deadline() {
    let (sender, mut body) = open_body();
    let whole = message(&text(40));
    send(&sender, &whole);
    send(&sender, &whole[..20]);
    assert_eq!(
        body.frame().await.unwrap().unwrap().into_data().unwrap(),
        whole
    );
    let waited_since = Instant::now();
    assert_eq!(
        refusal(&mut body).await,
        refused(Code::DeadlineExceeded, "MESSAGE_DEADLINE")
    );
    assert_eq!(waited_since.elapsed().as_secs(), DEADLINE.as_secs());
}

#[tokio::test(start_paused = true)]
async fn a_byte_a_second_does_not_move_the_deadline() {
    let (sender, mut body) = open_body();
    let writing = tokio::spawn(async move {
        for byte in message(&text(40)) {
            tokio::time::sleep(Duration::from_secs(1)).await;
            if sender
                .try_send(Ok(Frame::data(Bytes::from(vec![byte]))))
                .is_err()
            {
                return;
            }
        }
    });
    let began = Instant::now();
    assert_eq!(refusal(&mut body).await.1, "MESSAGE_DEADLINE");
    assert_eq!(began.elapsed().as_secs(), 1 + DEADLINE.as_secs());
    drop(body);
    writing.await.unwrap();
}

#[tokio::test(start_paused = true)]
async fn silence_between_messages_and_a_server_that_is_slow_to_ask_cost_nothing() {
    let (sender, mut body) = open_body();
    let whole = message(&text(40));
    send(&sender, &whole);
    send(&sender, &whole[..20]);
    body.frame().await.unwrap().unwrap();
    tokio::time::sleep(10 * DEADLINE).await;
    send(&sender, &whole[20..]);
    let mut second = Vec::new();
    while second.len() < whole.len() {
        second.extend(body.frame().await.unwrap().unwrap().into_data().unwrap());
    }
    assert_eq!(second, whole);
    let silent = tokio::time::timeout(10 * DEADLINE, body.frame()).await;
    assert!(silent.is_err(), "silence between messages ended the body");
}

#[tokio::test]
async fn what_stands_before_a_bad_message_is_handed_on_first() {
    let good = message(&text(40));
    let bad: [(&[u8], Code, &str); 4] = [
        (&[0, 0, 0, 0x27, 0x11], Code::OutOfRange, "MESSAGE_SIZE"),
        (&[1, 0, 0, 0, 4], Code::Unimplemented, "COMPRESSION"),
        (&[7, 0, 0, 0, 4], Code::Unimplemented, "COMPRESSION"),
        (
            &message(&[0x12, 0].repeat(4_097)),
            Code::InvalidArgument,
            "MESSAGE_PARTS",
        ),
    ];
    for (bytes, code, reason) in bad {
        let (sender, mut body) = open_body();
        send(&sender, &[&good, bytes].concat());
        let first = body.frame().await.unwrap().unwrap();
        assert_eq!(first.into_data().unwrap(), good);
        assert_eq!(refusal(&mut body).await, refused(code, reason));
    }
}

#[tokio::test]
async fn a_body_that_ends_within_a_message_says_so() {
    let (sender, mut body) = open_body();
    send(&sender, &message(&text(40))[..7]);
    drop(sender);
    assert_eq!(
        refusal(&mut body).await,
        refused(Code::InvalidArgument, "MESSAGE_CUT")
    );
}

#[tokio::test]
async fn what_is_reserved_stays_near_what_came() {
    let (sender, mut body) = open_body();
    let whole = message(&text(9_000));
    for (n_sent, byte) in whole[..whole.len() - 1].iter().enumerate() {
        send(&sender, &[*byte]);
        // Else the runtime holds the channel back to let others run.
        tokio::task::yield_now().await;
        assert!(futures::poll!(body.frame()).is_pending());
        assert_eq!(body.begun.n_held(), n_sent + 1);
        let n_reserved = body.begun.n_reserved();
        assert!(
            n_reserved <= n_sent + 8 * 1024,
            "{n_reserved} bytes for {n_sent}"
        );
    }
    drop(sender);
    let left = body.into_data_stream().collect::<Vec<_>>().await;
    assert_eq!(left.len(), 1, "one refusal");
}
