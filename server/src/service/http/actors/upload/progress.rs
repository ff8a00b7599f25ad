//! How far an import is, as lines of JSON; the import runs while the lines are read, without a task of its own.

use std::{convert::Infallible, pin::Pin};

use axum::{
    body::Body,
    http::{HeaderValue, header},
    response::{IntoResponse as _, Response},
};
use bytes::Bytes;
use frontalis_proto::v1;
use futures::{Stream, stream};
use serde_json::{Value, json};
use tokio::sync::watch;
use tonic::Status;

use crate::service::{
    grpc::actors::{Import, ImportStage, Progress},
    http::problem::Problem,
};

/// A line says so much more than the one before, unless the stage is another.
const STEP_BYTES: usize = 1 << 20;

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
    let (said, heard) = watch::channel(Progress::default());
    let running = import.run(chunks, move |now| tell(&said, now));
    let state = Lines {
        running: Some(Box::pin(running)),
        heard,
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

fn tell(said: &watch::Sender<Progress>, now: Progress) {
    said.send_if_modified(|last| {
        let step = |it: &Progress| (it.stage, it.received_bytes / STEP_BYTES);
        let news = step(last) != step(&now);
        *last = now;
        news
    });
}

struct Lines {
    /// None: the last line was said.
    running: Option<Running>,
    heard: watch::Receiver<Progress>,
    total_bytes: Option<u64>,
    instance: String,
}

impl Lines {
    async fn next(&mut self) -> Option<Value> {
        let running = self.running.as_mut()?;
        tokio::select! {
            // What was said before the end comes before it.
            biased;
            Ok(()) = self.heard.changed() => {
                let now = *self.heard.borrow_and_update();
                Some(self.progress(now))
            }
            result = running => {
                self.running = None;
                Some(self.last(result))
            }
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
