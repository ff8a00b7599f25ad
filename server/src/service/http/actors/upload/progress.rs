//! How far an import is, as lines of JSON; the import runs while the lines are read, without a task of its own.

use std::{
    convert::Infallible,
    pin::Pin,
    sync::atomic::{AtomicUsize, Ordering},
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
use tokio::sync::mpsc;
use tonic::Status;

use crate::service::{
    grpc::actors::{Import, ImportStage, Progress},
    http::problem::Problem,
};

/// A line says so much more than the one before, unless the stage is another.
const STEP_BYTES: usize = 1 << 20;

/// More lines than a package of the largest size has.
const MAX_LINES: usize = 128;

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
        last: AtomicUsize::new(0),
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
    last: AtomicUsize,
    said: mpsc::Sender<Progress>,
}

impl Steps {
    fn tell(&self, now: Progress) {
        let step = now.received_bytes / STEP_BYTES;
        let is_news = self.last.swap(step, Ordering::Relaxed) != step;
        let is_line = is_news || now.stage != ImportStage::Receiving;
        if is_line && self.said.try_send(now).is_err() {
            tracing::debug!("a line of progress is left out");
        }
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
