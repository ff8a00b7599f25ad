//! What is thrown away, and when it is not.

use axum::{Router, http::StatusCode, middleware, routing::post};
use futures::{StreamExt as _, stream};
use tokio::time::{Instant, sleep};
use tower::ServiceExt as _;

use super::*;

const PIECE: usize = 1 << 20;

fn router() -> Router {
    let refuse = |_: Request| async { (StatusCode::FORBIDDEN, "no") };
    let read_one = |request: Request| async {
        let mut body = request.into_body();
        body.frame().await;
        "enough"
    };
    Router::new()
        .route("/refuse", post(refuse))
        .route("/read-one", post(read_one))
        .layer(middleware::from_fn_with_state(
            Draining::default(),
            heard_out,
        ))
}

/// How many pieces were taken of a request that sends one every `pause`, and what was answered after how long.
async fn ask(
    uri: &str,
    n_pieces: usize,
    pause: Duration,
    shape: impl FnOnce(&mut Request),
) -> (usize, String, Duration) {
    let (taken, n_taken) = std::sync::mpsc::sync_channel(4_096);
    let pieces = stream::iter(0..n_pieces).then(move |_| {
        let taken = taken.clone();
        async move {
            sleep(pause).await;
            taken.send(()).unwrap();
            Ok::<_, std::convert::Infallible>(Bytes::from(vec![0; PIECE]))
        }
    });
    let mut request = Request::post(uri).body(Body::from_stream(pieces)).unwrap();
    *request.version_mut() = Version::HTTP_2;
    shape(&mut request);
    let began = Instant::now();
    let response = router().oneshot(request).await.unwrap();
    let text = response.into_body().collect().await.unwrap().to_bytes();
    let text = String::from_utf8(text.to_vec()).unwrap();
    (n_taken.iter().count(), text, began.elapsed())
}

#[tokio::test(start_paused = true)]
async fn the_whole_of_a_refused_request_is_taken() {
    let (n_taken, text, _) = ask("/refuse", 70, Duration::ZERO, |_| ()).await;
    assert_eq!((n_taken, text.as_str()), (70, "no"));
}

#[tokio::test(start_paused = true)]
async fn an_answer_does_not_end_before_its_request() {
    let (n_taken, text, _) = ask("/read-one", 3, Duration::ZERO, |_| ()).await;
    assert_eq!((n_taken, text.as_str()), (3, "enough"));
}

#[tokio::test(start_paused = true)]
async fn a_request_without_end_is_taken_up_to_a_limit() {
    let (n_taken, text, _) = ask("/refuse", 1000, Duration::ZERO, |_| ()).await;
    assert_eq!(text, "no");
    assert_eq!(n_taken as u64, MAX_BYTES / PIECE as u64 + 1);
}

#[tokio::test(start_paused = true)]
async fn a_slow_request_is_answered_after_a_time() {
    let (_, text, time) = ask("/refuse", 1000, MAX_PAUSE / 2, |_| ()).await;
    assert_eq!((text.as_str(), time.as_secs()), ("no", MAX_TIME.as_secs()));
}

#[tokio::test(start_paused = true)]
async fn a_request_that_pauses_is_answered() {
    let (n_taken, text, time) = ask("/refuse", 9, MAX_PAUSE * 2, |_| ()).await;
    assert_eq!((n_taken, text.as_str()), (0, "no"));
    assert_eq!(time.as_secs(), MAX_PAUSE.as_secs());
}

#[tokio::test(start_paused = true)]
async fn who_asks_first_or_calls_grpc_or_speaks_http1_is_answered_at_once() {
    let shapes: [fn(&mut Request); 3] = [
        |it| *it.version_mut() = Version::HTTP_11,
        |it| {
            let ask = "100-continue".parse().unwrap();
            it.headers_mut().insert(header::EXPECT, ask);
        },
        |it| {
            let kind = "application/grpc+proto".parse().unwrap();
            it.headers_mut().insert(header::CONTENT_TYPE, kind);
        },
    ];
    for shape in shapes {
        let (n_taken, text, _) = ask("/refuse", 9, Duration::ZERO, shape).await;
        assert_eq!((n_taken, text.as_str()), (0, "no"));
    }
}
