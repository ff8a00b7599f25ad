//! The connection's side of a publication: streams, acknowledgements, reconnection.

use std::{sync::Arc, time::Duration};

use tokio::{
    sync::mpsc,
    time::{MissedTickBehavior, interval, sleep, timeout},
};
use tokio_stream::wrappers::ReceiverStream;
use tonic::{Code, Streaming};

use super::{CaptureSettings, clock_echo::Echoes, shared::Shared};
use crate::{
    backoff::Backoff,
    connection::Channel,
    error::ClientError,
    proto::{
        Ingest, PublishMarkersRequest, PublishResponse, PublishStart,
        capture_service_client::CaptureServiceClient,
    },
};

/// Messages between this task and the transport; beyond them the ring holds the frames.
const MESSAGES_IN_FLIGHT: usize = 4;
/// The contract's limits are 256 frames and 1 MiB a message; the second leaves room for the framing.
const MAX_BATCH_FRAMES: usize = 64;
const MAX_BATCH_BYTES: usize = 768 << 10;
/// An empty message keeps the lease, which is at least some seconds long, while nothing is captured.
const KEEP_ALIVE: Duration = Duration::from_secs(1);
/// A live publisher that comes back with more frames than this publishes losslessly until it has caught up: half of
/// what a session's limit of 250 live frames a second lets through at once.
const CATCH_UP_FRAMES: usize = 125;
/// How long a server may take to answer the start of a stream.
const START_TIMEOUT: Duration = Duration::from_secs(10);

/// One open stream.
pub(super) struct OpenStream {
    requests: mpsc::Sender<PublishMarkersRequest>,
    responses: Streaming<PublishResponse>,
}

/// Opens a stream and reads the first response, which holds `started`.
pub(super) async fn open(
    channel: &Channel,
    start: PublishStart,
) -> Result<(OpenStream, PublishResponse), ClientError> {
    let (requests, receiver) = mpsc::channel(MESSAGES_IN_FLIGHT);
    let first = PublishMarkersRequest {
        start: Some(start),
        ..PublishMarkersRequest::default()
    };
    requests
        .try_send(first)
        .map_err(|_| ClientError::local(Code::Internal, "a new request stream is full"))?;
    let opening = async {
        let mut responses = CaptureServiceClient::new(channel.clone())
            .publish_markers(ReceiverStream::new(receiver))
            .await?
            .into_inner();
        let first = responses.message().await?;
        Ok::<_, tonic::Status>((responses, first))
    };
    let (responses, first) = timeout(START_TIMEOUT, opening).await.map_err(|_| {
        ClientError::local(
            Code::DeadlineExceeded,
            format!(
                "the server did not answer the start of the publication within {} s",
                START_TIMEOUT.as_secs()
            ),
        )
    })??;
    match first {
        Some(first) if first.started.is_some() => Ok((
            OpenStream {
                requests,
                responses,
            },
            first,
        )),
        _ => Err(ClientError::local(
            Code::Internal,
            "the server did not answer `started` first",
        )),
    }
}

/// Keeps one publication going over any number of connections.
pub(super) struct Publication {
    shared: Arc<Shared>,
    channel: Channel,
    settings: CaptureSettings,
    backoff: Backoff,
    echoes: Echoes,
}

impl Publication {
    pub fn new(
        shared: Arc<Shared>,
        channel: Channel,
        settings: CaptureSettings,
        echoes: Echoes,
    ) -> Self {
        Self {
            shared,
            channel,
            settings,
            backoff: Backoff::new(Backoff::process_seed()),
            echoes,
        }
    }

    /// Runs until the caller is done and everything is settled, or until it fails for good.
    pub async fn run(mut self, first: OpenStream) {
        let mut stream = Some((first, Purpose::Follow));
        while let Some((open, purpose)) = stream {
            let next = match self.pump(open, purpose).await {
                Ok(Closed::Done) => return,
                Ok(Closed::CaughtUp) => self.reopen().await,
                Err(cut) => self.reconnect(cut).await,
            };
            stream = match next {
                Ok(next) => next,
                Err(failure) => return self.shared.fail(failure),
            };
        }
    }

    /// Follows on after catching up; a failure now is a cut like any other.
    async fn reopen(&mut self) -> Result<Option<(OpenStream, Purpose)>, ClientError> {
        let start = self.settings.start(false, self.settings.ingest);
        match open(&self.channel, start).await {
            Ok((stream, first)) => {
                self.shared.begin_connection(&first);
                Ok(Some((stream, Purpose::Follow)))
            }
            Err(cut) => self.reconnect(cut).await,
        }
    }

    /// Tries again with growing waits; `None` when nothing is left to send.
    async fn reconnect(
        &mut self,
        mut cut: ClientError,
    ) -> Result<Option<(OpenStream, Purpose)>, ClientError> {
        loop {
            if !cut.is_transient() {
                return Err(cut);
            }
            if self.shared.is_over() {
                return Ok(None);
            }
            tracing::info!(error = %cut, "publication was cut, reconnecting");
            sleep(self.backoff.next_wait(cut.retry_after)).await;
            let (ingest, purpose) = self.resumption();
            match open(&self.channel, self.settings.start(false, ingest)).await {
                Ok((stream, first)) => {
                    self.shared.begin_connection(&first);
                    self.shared.lock().report.reconnections += 1;
                    return Ok(Some((stream, purpose)));
                }
                Err(error) => cut = error,
            }
        }
    }

    /// How to come back: losslessly at first, when much has to be sent.
    fn resumption(&self) -> (Ingest, Purpose) {
        let n_waiting = self.shared.lock().ring.len();
        if self.settings.ingest != Ingest::Lossless && n_waiting > CATCH_UP_FRAMES {
            (Ingest::Lossless, Purpose::CatchUp)
        } else {
            (self.settings.ingest, Purpose::Follow)
        }
    }

    fn closed(&self) -> Closed {
        let state = self.shared.lock();
        if state.is_closing && !state.ring.has_unsent() {
            Closed::Done
        } else {
            Closed::CaughtUp
        }
    }

    /// Sends and listens on one connection. `Ok` when the server closed it after we did.
    async fn pump(&mut self, stream: OpenStream, purpose: Purpose) -> Result<Closed, ClientError> {
        let OpenStream {
            requests,
            mut responses,
        } = stream;
        let mut requests = Some(requests);
        let mut is_half_closed = false;
        let mut keep_alive = interval(KEEP_ALIVE);
        keep_alive.set_missed_tick_behavior(MissedTickBehavior::Delay);
        keep_alive.reset();
        loop {
            let has_unsent = {
                let state = self.shared.lock();
                let has_purpose = purpose == Purpose::Follow && !state.is_closing;
                if !has_purpose && !state.ring.has_unsent() {
                    is_half_closed |= requests.take().is_some();
                }
                state.ring.has_unsent()
            };
            tokio::select! {
                response = responses.message() => match response? {
                    Some(response) => {
                        self.backoff.reset();
                        self.echoes.received(&response);
                        self.shared.take_response(response);
                    }
                    None if is_half_closed => return Ok(self.closed()),
                    None => return Err(closed_early()),
                },
                sent = send_batch(&self.shared, &mut self.echoes, requests.as_ref()), if has_unsent && requests.is_some() => {
                    keep_alive.reset();
                    if sent.is_err() {
                        // The transport is gone; the responses say why.
                        requests = None;
                    }
                },
                () = self.shared.work.notified() => {}
                _ = keep_alive.tick() => {
                    if let Some(requests) = &requests {
                        // A full queue is traffic enough.
                        drop(requests.try_send(PublishMarkersRequest {
                            clock: self.echoes.take(),
                            ..PublishMarkersRequest::default()
                        }));
                    }
                }
            }
        }
    }
}

/// What a connection is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Purpose {
    /// Frames as they come, until the caller is done.
    Follow,
    /// Only what waited while there was no connection.
    CatchUp,
}

/// Why a connection was closed in order.
enum Closed {
    /// The caller is done and everything went out.
    Done,
    /// What had waited went out; new frames follow on another connection.
    CaughtUp,
}

fn closed_early() -> ClientError {
    ClientError::local(Code::Unavailable, "the server closed the publication")
}

/// The transport no longer takes messages.
struct TransportGone;

/// Waits for the transport, then hands it the frames that are there by then.
async fn send_batch(
    shared: &Shared,
    echoes: &mut Echoes,
    requests: Option<&mpsc::Sender<PublishMarkersRequest>>,
) -> Result<(), TransportGone> {
    let permit = match requests {
        Some(requests) => requests.reserve().await.map_err(|_| TransportGone)?,
        None => return Err(TransportGone),
    };
    let frames = {
        let mut state = shared.lock();
        let to_resend = state.ring.to_resend();
        let frames = state.ring.next_batch(MAX_BATCH_FRAMES, MAX_BATCH_BYTES);
        let resent = to_resend.min(frames.len()) as u64;
        state.report.resent_frames += resent;
        state.report.sent_frames += frames.len() as u64 - resent;
        frames
    };
    permit.send(PublishMarkersRequest {
        frames,
        clock: echoes.take(),
        ..PublishMarkersRequest::default()
    });
    Ok(())
}
