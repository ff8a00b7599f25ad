//! The connection's side of a subscription: streams, credits, reconnection.

use std::{collections::VecDeque, time::Duration};

use futures::{Stream, stream};
use tokio::{
    sync::mpsc,
    time::{sleep, timeout},
};
use tokio_stream::wrappers::ReceiverStream;
use tonic::{Code, Streaming};

use super::{CurveEvent, CurveSettings, StartAt, Wanted, position::Position};
use crate::{
    backoff::Backoff,
    connection::Channel,
    error::ClientError,
    proto::{
        Delivery, SubscribeRequest, SubscribeResponse, SubscribeStart,
        curve_service_client::CurveServiceClient,
    },
};

/// Credits on their way to the transport; a subscriber never holds more than 32.
const REQUESTS_IN_FLIGHT: usize = 64;
/// How long a server may take to answer the start of a stream.
const START_TIMEOUT: Duration = Duration::from_secs(10);

/// One subscription with everything that outlives a connection.
pub(super) struct Subscription {
    channel: Channel,
    settings: CurveSettings,
    position: Position,
    backoff: Backoff,
    /// Events of one response that were not handed out yet.
    pending: VecDeque<CurveEvent>,
    phase: Phase,
    /// Whether the server ever served this subscription.
    has_header: bool,
    owes_credit: bool,
    skipped_before: u64,
    skipped_here: u64,
}

enum Phase {
    Open(Box<OpenStream>),
    Waiting(Duration),
    Over,
}

struct OpenStream {
    requests: mpsc::Sender<SubscribeRequest>,
    responses: Streaming<SubscribeResponse>,
}

impl Subscription {
    /// The first connection is not tried twice: a wrong name or address, or a limit, should be told at once.
    pub async fn open(channel: Channel, settings: CurveSettings) -> Result<Self, ClientError> {
        let mut subscription = Self {
            channel,
            settings,
            position: Position::default(),
            backoff: Backoff::new(Backoff::process_seed()),
            pending: VecDeque::new(),
            phase: Phase::Over,
            has_header: false,
            owes_credit: false,
            skipped_before: 0,
            skipped_here: 0,
        };
        subscription.connect().await?;
        Ok(subscription)
    }

    /// The events until the end of the session or a refusal.
    pub fn into_events(self) -> impl Stream<Item = Result<CurveEvent, ClientError>> + Send {
        stream::unfold(self, |mut subscription| async move {
            let event = subscription.next().await?;
            Some((event, subscription))
        })
    }

    async fn next(&mut self) -> Option<Result<CurveEvent, ClientError>> {
        loop {
            if let Some(event) = self.pending.pop_front() {
                self.owes_credit |= matches!(event, CurveEvent::Sample(_)) && self.is_latest();
                return Some(Ok(event));
            }
            self.return_credit();
            let done = match &mut self.phase {
                Phase::Over => return None,
                Phase::Waiting(wait) => {
                    sleep(*wait).await;
                    self.connect().await
                }
                Phase::Open(stream) => match stream.responses.message().await {
                    Ok(Some(response)) => {
                        self.backoff.reset();
                        self.take(response);
                        Ok(())
                    }
                    Ok(None) => Err(ClientError::local(
                        Code::Unavailable,
                        "the server closed the stream before the end of the session",
                    )),
                    Err(status) => Err(status.into()),
                },
            };
            if let Err(error) = done
                && let Err(refusal) = self.cut(error)
            {
                self.phase = Phase::Over;
                return Some(Err(refusal));
            }
        }
    }

    fn is_latest(&self) -> bool {
        matches!(self.settings.wanted, Wanted::Latest { .. })
    }

    /// The sample before was shown: the server may send another (CONTRACTS D-14).
    fn return_credit(&mut self) {
        if let Phase::Open(stream) = &self.phase
            && std::mem::take(&mut self.owes_credit)
        {
            let credit = SubscribeRequest {
                start: None,
                credits: 1,
            };
            // A closed or full queue means that the stream is over; its status follows from the responses.
            drop(stream.requests.try_send(credit));
        }
    }

    async fn connect(&mut self) -> Result<(), ClientError> {
        let start = self.start();
        let (requests, receiver) = mpsc::channel(REQUESTS_IN_FLIGHT);
        let first = SubscribeRequest {
            start: Some(start),
            credits: 0,
        };
        requests
            .try_send(first)
            .map_err(|_| ClientError::local(Code::Internal, "a new request stream is full"))?;
        let mut client = CurveServiceClient::new(self.channel.clone());
        let opening = client.subscribe(ReceiverStream::new(receiver));
        let responses = timeout(START_TIMEOUT, opening).await.map_err(|_| {
            ClientError::local(
                Code::DeadlineExceeded,
                format!(
                    "the server did not answer the subscription within {} s",
                    START_TIMEOUT.as_secs()
                ),
            )
        })??;
        self.phase = Phase::Open(Box::new(OpenStream {
            requests,
            responses: responses.into_inner(),
        }));
        self.owes_credit = false;
        self.skipped_before += std::mem::take(&mut self.skipped_here);
        Ok(())
    }

    fn start(&self) -> SubscribeStart {
        let settings = &self.settings;
        let mut start = SubscribeStart {
            session: settings.session.clone(),
            subscriber: settings.subscriber.clone(),
            control_space: settings.control_space.into(),
            with_markers: settings.with_markers,
            with_uncertainty: settings.with_uncertainty,
            ..SubscribeStart::default()
        };
        match settings.wanted {
            Wanted::Latest {
                credits,
                max_rate_hz,
            } => {
                start.set_delivery(Delivery::Latest);
                start.credits = credits;
                start.max_rate_hz = max_rate_hz;
            }
            Wanted::EveryFrame { from } => {
                start.set_delivery(Delivery::EveryFrame);
                match self.position.resume(from) {
                    StartAt::Now => {}
                    StartAt::Oldest => start.from_oldest = true,
                    StartAt::Sequence { run, sequence } => {
                        start.run = run;
                        start.from_sequence = sequence;
                    }
                }
            }
        }
        start
    }

    /// Decides what a cut means: try again (`Ok`), or stop.
    fn cut(&mut self, error: ClientError) -> Result<(), ClientError> {
        let place_is_gone = !self.is_latest()
            && self.position.has_begun()
            && matches!(error.code, Code::DataLoss | Code::OutOfRange);
        if place_is_gone {
            // The exact loss shows in the next sample's sequence, a new run in the next header.
            self.position.lose_place(&error);
        } else if !self.has_header || !error.is_transient() {
            return Err(error);
        }
        let wait = self.backoff.next_wait(error.retry_after);
        self.phase = Phase::Waiting(wait);
        self.pending
            .push_back(CurveEvent::Reconnecting { cause: error, wait });
        Ok(())
    }

    fn take(&mut self, response: SubscribeResponse) {
        if let Some(header) = response.header {
            self.has_header = true;
            self.pending.extend(self.position.begin(&header));
            self.pending.push_back(CurveEvent::Header(header));
        }
        if response.skipped_samples > self.skipped_here {
            self.skipped_here = response.skipped_samples;
            let skipped = self.skipped_before + self.skipped_here;
            self.pending.push_back(CurveEvent::Skipped(skipped));
        }
        let mut gaps = response.gaps.into_iter().peekable();
        for sample in response.samples {
            while let Some(gap) = gaps.next_if(|it| it.first < sample.frame) {
                self.pending.extend(self.position.gap(gap));
            }
            if self.is_latest() {
                self.pending.push_back(CurveEvent::Sample(sample));
            } else {
                self.pending.extend(self.position.sample(sample));
            }
        }
        for gap in gaps {
            self.pending.extend(self.position.gap(gap));
        }
        self.pending.extend(response.state.map(CurveEvent::State));
        if let Some(end) = response.end {
            self.pending.push_back(CurveEvent::End(end));
            self.phase = Phase::Over;
        }
    }
}
