//! How far an import is, as lines of JSON; the import runs while the lines are read, without a task of its own.

use std::{
    convert::Infallible,
    pin::Pin,
    sync::{Mutex, PoisonError},
    time::Duration,
};

use axum::{
    body::Body,
    http::{HeaderValue, header},
    response::{IntoResponse as _, Response},
};
use bytes::Bytes;
use frontalis_proto::v1;
use futures::{Stream, stream};
use serde_json::{Value, json};
use tokio::{sync::mpsc, time::Instant};
use tonic::Status;

use crate::service::{
    grpc::actors::{Import, ImportStage, Progress},
    http::problem::Problem,
};

/// A line says so much more than the one before, unless [`STEP_TIME`] has passed or the stage is another.
const STEP_BYTES: usize = 256 * 1024;

/// From one line to the next while bytes come.
const STEP_TIME: Duration = Duration::from_millis(250);

/// More lines than a package of the largest size has.
const MAX_LINES: usize = 320;

type Running = Pin<Box<dyn Future<Output = Result<v1::ImportActorResponse, Status>> + Send>>;

/// Runs `import` and answers with its lines.
pub(super) fn lines<S>(
    import: Import,
    chunks: S,
    total_bytes: Option<u64>,
    instance: String,
) -> Response
where
    S: Stream<Item = Result<Bytes, Status>> + Send + Unpin + 'static,
{
    let (said, heard) = mpsc::channel(MAX_LINES);
    let steps = Steps {
        last: Mutex::new((0, Instant::now())),
        said,
    };
    let running = import.run(chunks, move |now| steps.tell(now));
    let state = Lines {
        running: Some(Box::pin(running)),
        heard,
        last: None,
        total_bytes,
        instance,
    };
    let lines = stream::unfold(state, |mut state| async {
        let line = state.next().await?;
        Some((Ok::<_, Infallible>(format!("{line}\n")), state))
    });
    let kind = HeaderValue::from_static("application/x-ndjson");
    ([(header::CONTENT_TYPE, kind)], Body::from_stream(lines)).into_response()
}

/// Of all that an import says, what makes a line.
struct Steps {
    /// Bytes and time of the line before.
    last: Mutex<(usize, Instant)>,
    said: mpsc::Sender<Progress>,
}

impl Steps {
    fn tell(&self, now: Progress) {
        if self.is_line(now) && self.said.try_send(now).is_err() {
            tracing::debug!("a line of progress is left out");
        }
    }

    fn is_line(&self, now: Progress) -> bool {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let (bytes, at) = *last;
        let is_line = now.received_bytes >= bytes + STEP_BYTES
            || at.elapsed() >= STEP_TIME
            || now.stage != ImportStage::Receiving;
        if is_line {
            *last = (now.received_bytes, Instant::now());
        }
        is_line
    }
}

struct Lines {
    running: Option<Running>,
    heard: mpsc::Receiver<Progress>,
    /// What is said when nothing else is left to say.
    last: Option<Value>,
    total_bytes: Option<u64>,
    instance: String,
}

impl Lines {
    async fn next(&mut self) -> Option<Value> {
        if let Some(running) = self.running.as_mut() {
            tokio::select! {
                biased;
                Some(now) = self.heard.recv() => return Some(self.progress(now)),
                result = running => {
                    self.running = None;
                    self.last = Some(self.last(result));
                }
            }
        }
        match self.heard.try_recv() {
            Ok(now) => Some(self.progress(now)),
            Err(_) => self.last.take(),
        }
    }

    fn progress(&self, now: Progress) -> Value {
        let stage = match now.stage {
            ImportStage::Receiving => "RECEIVING",
            ImportStage::Reading => "READING",
            ImportStage::Storing => "STORING",
        };
        let mut progress = json!({
            "stage": stage,
            "receivedBytes": now.received_bytes.to_string(),
        });
        if let Some(total) = self.total_bytes {
            progress["totalBytes"] = json!(total.to_string());
        }
        json!({ "progress": progress })
    }

    fn last(&self, result: Result<v1::ImportActorResponse, Status>) -> Value {
        match result {
            Ok(imported) => json!({ "result": imported }),
            Err(status) => {
                json!({ "error": Problem::from(status).document(&self.instance) })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn received(received_bytes: usize) -> Progress {
        Progress {
            received_bytes,
            ..Progress::default()
        }
    }

    #[tokio::test(start_paused = true)]
    async fn a_line_comes_every_256_kib_and_when_the_line_before_is_old() {
        let (said, mut heard) = mpsc::channel(MAX_LINES);
        let steps = Steps {
            last: Mutex::new((0, Instant::now())),
            said,
        };
        steps.tell(received(STEP_BYTES - 1));
        assert!(heard.try_recv().is_err());
        steps.tell(received(STEP_BYTES));
        assert_eq!(heard.try_recv(), Ok(received(STEP_BYTES)));
        tokio::time::advance(STEP_TIME).await;
        steps.tell(received(STEP_BYTES + 16));
        assert_eq!(heard.try_recv(), Ok(received(STEP_BYTES + 16)));
    }
}
