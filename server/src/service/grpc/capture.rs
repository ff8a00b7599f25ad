//! `CaptureService`: frames in, watermarks out.
//!
//! A stream is a state machine that is polled by its connection: no task of its own, and gone when the connection is.
//! It reads a message only when the frames of the one before are taken, so that a full queue is back-pressure.

use std::{pin::Pin, time::Duration};

use frontalis_proto::v1::{self, capture_service_server::CaptureService};
use futures::{Stream, StreamExt as _, stream};
use tokio::time::{Instant, sleep_until};
use tonic::{Code, Request, Response, Status, Streaming};

use super::{
    opening::{first_message, protocol_order},
    status::refuse,
};
use crate::{
    catalogue::Store,
    clock::ServerClock,
    service::{
        access::{Action, Caller},
        audit::Audit,
        peer::Peer,
        sessions::in_process,
        takes::{RecordedRun, Takes},
    },
    session::{
        Claim, Grant, Granted, IncomingFrame, Offer, Publication, PublishEnd, SessionRegistry, Wait,
    },
    take::{FrameLookup, Recorder},
    wire::capture::{self as wire, MAX_FRAMES_PER_MESSAGE},
};

/// Frames after which a response is sent (CONTRACTS D-5).
const FRAMES_PER_RESPONSE: u32 = 32;
/// Time after which a response is sent; below the promised 50 ms, so that a timer that fires late keeps the promise.
const RESPONSE_DELAY: Duration = Duration::from_millis(40);
/// Rejections in one response; the rest follow in the next.
const REJECTIONS_PER_RESPONSE: usize = 256;

/// The service; cheap to clone.
#[derive(Clone)]
pub struct CaptureGrpc {
    registry: SessionRegistry,
    store: Store,
    clock: ServerClock,
    audit: Audit,
    takes: Takes,
}

impl CaptureGrpc {
    /// Publishes into the sessions of `registry`; epochs are made durable in `store` before they are granted.
    /// Sessions that are to be recorded from their first frame on become `takes`, which also know what a session no longer
    /// knows of its frames.
    pub fn new(
        registry: SessionRegistry,
        store: Store,
        clock: ServerClock,
        audit: Audit,
        takes: Takes,
    ) -> Self {
        Self {
            registry,
            store,
            clock,
            audit,
            takes,
        }
    }

    /// The responses to one publisher's requests.
    ///
    /// Every door comes through here.
    pub(in crate::service) fn publish<S>(&self, requests: S, peer: Peer) -> Responses
    where
        S: Stream<Item = Result<v1::PublishMarkersRequest, Status>> + Send + Unpin + 'static,
    {
        let caller = peer.caller.clone();
        let publishing = Publishing {
            service: self.clone(),
            requests,
            phase: Phase::Opening,
            peer,
        };
        let responses = stream::unfold(publishing, |mut publishing| async {
            let response = publishing.next().await?;
            Some((response, publishing))
        });
        caller.while_valid(responses)
    }

    /// Whether the caller may publish somewhere; to be asked before anything of the stream is read.
    pub(in crate::service) fn admit(caller: &Caller) -> Result<(), Status> {
        caller
            .may(Action::Publish)
            .or_else(|refused| caller.may(Action::TakeOver).map_err(|_| refused))
    }

    /// What a caller does that publishes, if it may: who may only take sessions over must do so.
    pub(in crate::service) fn action(caller: &Caller, takes_over: bool) -> Result<Action, Status> {
        match (caller.may(Action::Publish), caller.may(Action::TakeOver)) {
            (_, Ok(())) if takes_over => Ok(Action::TakeOver),
            (Ok(()), _) => Ok(Action::Publish),
            (Err(_), Ok(())) => {
                Err(caller.denied("the caller's role publishes only with takeover"))
            }
            (Err(refused), Err(_)) => Err(refused),
        }
    }

    async fn open(
        &self,
        sent: v1::PublishStart,
        action: Action,
        peer: &Peer,
    ) -> Result<(Publication, Option<RecordedRun>), Status> {
        if sent.image.is_some() {
            return Err(not_implemented());
        }
        let start = wire::start(sent)?;
        let caller = &peer.caller;
        caller.may_in(action, &start.session)?;
        let session = in_process(&self.registry, &self.store, &start.session).await?;
        let claim = Claim {
            publisher: start.publisher.clone(),
            principal: caller.key().into(),
            takeover: start.takeover,
            outranks: caller.may(Action::TakeOver).is_ok(),
        };
        let claimed = session.check_claim(&claim).map_err(Status::from);
        if start.takeover {
            let object = start.session.resource();
            self.audit
                .outcome("session_takeover", peer, &object, claimed)?;
        } else {
            claimed?;
        }
        let recorded = self.takes.recorded_before(&session).await?;
        self.takes.start_with_first_frame(&session).await?;
        let epoch = self.store.next_epoch(&start.session).await?;
        let (publisher, takeover) = (start.publisher, start.takeover);
        let publication = session.grant(Grant {
            claim,
            epoch,
            unit: start.unit,
            marker_names: start.marker_names,
            ingest: start.ingest,
            rate_hz: start.rate_hz,
        })?;
        let n_markers = publication.granted().shape.marker_names.len();
        tracing::info!(session = %session.id(), %publisher, door = peer.door.name(), takeover, epoch, n_markers, "publisher granted");
        Ok((publication, recorded))
    }
}

/// The responses of one publisher's stream.
pub type Responses = Pin<Box<dyn Stream<Item = Result<v1::PublishResponse, Status>> + Send>>;

#[tonic::async_trait]
impl CaptureService for CaptureGrpc {
    type PublishMarkersStream = Responses;

    async fn publish_markers(
        &self,
        request: Request<Streaming<v1::PublishMarkersRequest>>,
    ) -> Result<Response<Responses>, Status> {
        let peer = Peer::of(request.extensions());
        Self::admit(&peer.caller)?;
        let responses = self.publish(request.into_inner(), peer);
        Ok(Response::new(responses))
    }

    type PublishImagesStream = Responses;

    async fn publish_images(
        &self,
        request: Request<Streaming<v1::PublishImagesRequest>>,
    ) -> Result<Response<Responses>, Status> {
        Caller::of(request.extensions()).may(Action::Publish)?;
        Err(not_implemented())
    }
}

fn not_implemented() -> Status {
    let message = "this server takes markers, no images";
    refuse(Code::Unimplemented, "NOT_IMPLEMENTED", message)
}

/// One publisher's stream.
struct Publishing<S> {
    service: CaptureGrpc,
    requests: S,
    phase: Phase,
    peer: Peer,
}

enum Phase {
    Opening,
    Flowing(Box<Flow>),
    Over,
}

impl<S> Publishing<S>
where
    S: Stream<Item = Result<v1::PublishMarkersRequest, Status>> + Unpin,
{
    async fn next(&mut self) -> Option<Result<v1::PublishResponse, Status>> {
        let response = match &mut self.phase {
            Phase::Opening => self.open().await.map(Some),
            Phase::Flowing(flow) => flow.next(&mut self.requests).await,
            Phase::Over => return None,
        };
        if !matches!(response, Ok(Some(_))) {
            self.phase = Phase::Over;
        }
        response.transpose()
    }

    async fn open(&mut self) -> Result<v1::PublishResponse, Status> {
        let caller = &self.peer.caller;
        CaptureGrpc::admit(caller)?;
        let first = first_message(&mut self.requests, &self.service.registry).await;
        // The role comes before what is wrong with the message.
        let action = CaptureGrpc::action(caller, takes_over(&first))?;
        let request = first?;
        let missing = || protocol_order("the first message must be start");
        let (publication, recorded) = self
            .service
            .open(request.start.ok_or_else(missing)?, action, &self.peer)
            .await?;
        let mut flow = Flow::new(publication, &self.service);
        flow.take_frames(request.frames)?;
        let granted = flow.publication.granted().clone();
        let mut response = flow.response();
        response.started = Some(started(&granted, response.durable_through, recorded));
        self.phase = Phase::Flowing(Box::new(flow));
        Ok(response)
    }
}

/// Whether a first message takes a session over; one that cannot be read does not say so.
///
/// That none came says nothing of the caller: it is heard by everyone.
fn takes_over(first: &Result<v1::PublishMarkersRequest, Status>) -> bool {
    match first {
        Ok(request) => request.start.as_ref().is_some_and(|it| it.takeover),
        Err(status) => matches!(status.code(), Code::Unavailable | Code::DeadlineExceeded),
    }
}

fn started(
    granted: &Granted,
    durable_through: u64,
    recorded: Option<RecordedRun>,
) -> v1::PublishStarted {
    v1::PublishStarted {
        epoch: granted.epoch,
        next_expected: granted.next_expected,
        durable_through,
        run: granted.run,
        recorded_run: recorded.map_or(0, |it| it.run),
        recorded_through: recorded.map_or(0, |it| it.through),
    }
}

/// A publication in force.
struct Flow {
    publication: Publication,
    clock: ServerClock,
    recorder: Recorder,
    /// Finds frames of the session's take.
    lookup: Option<FrameLookup>,
    /// Frames of the newest message that were not offered yet.
    waiting: std::vec::IntoIter<v1::MarkerFrame>,
    /// The frame that the session cannot take yet.
    held: Option<(IncomingFrame, Wait)>,
    rejected: Vec<v1::RejectedFrame>,
    n_unanswered: u32,
    /// What the client knows to be on stable storage.
    told_durable: u64,
    respond_at: Option<Instant>,
    /// The client closed its side.
    is_closing: bool,
    /// The last response is on its way; this follows.
    end: Option<Result<(), Status>>,
}

impl Flow {
    fn new(publication: Publication, service: &CaptureGrpc) -> Self {
        Self {
            publication,
            clock: service.clock,
            recorder: service.takes.recorder().clone(),
            lookup: None,
            waiting: Vec::new().into_iter(),
            held: None,
            rejected: Vec::new(),
            n_unanswered: 0,
            told_durable: 0,
            respond_at: None,
            is_closing: false,
            end: None,
        }
    }

    /// The next response; `None` when the stream ended well.
    async fn next<S>(&mut self, requests: &mut S) -> Result<Option<v1::PublishResponse>, Status>
    where
        S: Stream<Item = Result<v1::PublishMarkersRequest, Status>> + Unpin,
    {
        loop {
            if !self.rejected.is_empty() && self.end.is_some() {
                return Ok(Some(self.response()));
            }
            if let Some(end) = self.end.take() {
                return end.map(|()| None);
            }
            match self.offer_frames().await {
                Err(end) => return Ok(Some(self.last_response(Err(end.into())))),
                Ok(()) if self.must_respond() => return Ok(Some(self.response())),
                Ok(()) if self.is_closing && self.publication.is_finished() => {
                    return Ok(Some(self.last_response(Ok(()))));
                }
                Ok(()) => {}
            }
            if let Err(status) = self.wait(requests).await {
                return Ok(Some(self.last_response(Err(status))));
            }
        }
    }

    /// Offers what waits until a response is due, or the session has no room.
    async fn offer_frames(&mut self) -> Result<(), PublishEnd> {
        let offered = self.offer_until_held().await;
        let late = self.publication.take_rejections().into_iter();
        self.rejected.extend(late.map(wire::rejection_to_wire));
        // A released publication has no lease to check; it ends by its mailbox.
        offered.and_then(|()| self.publication.check())
    }

    async fn offer_until_held(&mut self) -> Result<(), PublishEnd> {
        if let Some((frame, _)) = self.held.take() {
            self.offer(frame).await?;
        }
        while self.held.is_none() && self.n_unanswered < FRAMES_PER_RESPONSE {
            let Some(sent) = self.waiting.next() else {
                break;
            };
            match wire::frame(&sent, &self.publication.granted().shape) {
                Ok(frame) => self.offer(frame).await?,
                Err(rejection) => {
                    let answer = self.publication.refuse(rejection)?;
                    self.note(answer);
                }
            }
        }
        Ok(())
    }

    async fn offer(&mut self, frame: IncomingFrame) -> Result<(), PublishEnd> {
        let mut answer = self.publication.offer(frame)?;
        if let Offer::Unsure(frame) = &answer {
            let in_take = self.in_take(frame.number).await;
            answer = self.publication.settle(frame, in_take)?;
        }
        self.note(answer);
        Ok(())
    }

    /// The hash of what the session's take has under this number (CONTRACTS D-6a).
    async fn in_take(&mut self, number: u64) -> Option<u64> {
        let session = self.publication.session();
        self.lookup = self.recorder.frames_of(session, self.lookup.take());
        match self.lookup.as_mut()?.content_hash(number).await {
            Ok(found) => found,
            Err(error) => {
                let error = &error as &dyn std::error::Error;
                tracing::error!(%session, number, error, "a frame sent again cannot be compared, it counts as late");
                None
            }
        }
    }

    fn note(&mut self, answer: Offer) {
        match answer {
            Offer::Wait(frame, wait) => self.held = Some((frame, wait)),
            Offer::Unsure(_) => unreachable!("invariant: what is unsure is settled"),
            Offer::Taken => self.n_unanswered += 1,
            Offer::Rejected(rejection) => {
                self.n_unanswered += 1;
                self.rejected.push(wire::rejection_to_wire(rejection));
            }
        }
    }

    fn must_respond(&self) -> bool {
        self.n_unanswered >= FRAMES_PER_RESPONSE
            || self.rejected.len() >= REJECTIONS_PER_RESPONSE
            || self.publication.watermarks().durable_through > self.told_durable
            || self.respond_at.is_some_and(|it| it <= Instant::now())
    }

    fn response(&mut self) -> v1::PublishResponse {
        self.n_unanswered = 0;
        // What was not offered yet is answered within the same promise.
        let unoffered = self.held.is_some() || self.waiting.len() > 0;
        self.respond_at = unoffered.then(|| Instant::now() + RESPONSE_DELAY);
        let watermarks = self.publication.watermarks();
        self.told_durable = watermarks.durable_through;
        let n_rejected = self.rejected.len().min(REJECTIONS_PER_RESPONSE);
        v1::PublishResponse {
            started: None,
            accepted_through: watermarks.accepted_through,
            durable_through: watermarks.durable_through,
            rejected: self.rejected.drain(..n_rejected).collect(),
            shed_frames: watermarks.shed_frames,
            server_send_nanos: self.clock.now_nanos(),
            recording: watermarks.is_recorded,
        }
    }

    fn last_response(&mut self, end: Result<(), Status>) -> v1::PublishResponse {
        self.end = Some(end);
        self.waiting = Vec::new().into_iter();
        self.held = None;
        self.response()
    }

    /// Waits for anything that `next` looks at.
    async fn wait<S>(&mut self, requests: &mut S) -> Result<(), Status>
    where
        S: Stream<Item = Result<v1::PublishMarkersRequest, Status>> + Unpin,
    {
        let may_read = self.held.is_none() && self.waiting.len() == 0 && !self.is_closing;
        let retry_at = match &self.held {
            Some((_, Wait::Until(at))) => Some(*at),
            _ => None,
        };
        let wake_at = [self.respond_at, retry_at].into_iter().flatten().min();
        tokio::select! {
            request = requests.next(), if may_read => {
                if let Some(request) = request {
                    self.receive(request?)?;
                } else {
                    self.publication.release();
                    self.is_closing = true;
                }
            }
            () = self.publication.woken() => {}
            () = sleep_until(wake_at.unwrap_or_else(Instant::now)), if wake_at.is_some() => {}
        }
        Ok(())
    }

    fn receive(&mut self, request: v1::PublishMarkersRequest) -> Result<(), Status> {
        if request.start.is_some() {
            self.publication.release();
            return Err(protocol_order("start was sent twice"));
        }
        if let Some(echo) = &request.clock {
            let exchange = wire::clock_exchange(echo, self.clock.now_nanos());
            self.publication.exchange(exchange)?;
        }
        self.take_frames(request.frames)
    }

    fn take_frames(&mut self, frames: Vec<v1::MarkerFrame>) -> Result<(), Status> {
        if frames.len() > MAX_FRAMES_PER_MESSAGE {
            self.publication.release();
            let message = format!(
                "{} frames in a message, at most {MAX_FRAMES_PER_MESSAGE} are taken",
                frames.len()
            );
            return Err(refuse(Code::InvalidArgument, "FRAME_COUNT", message));
        }
        self.publication.keep_alive()?;
        self.waiting = frames.into_iter();
        self.respond_at
            .get_or_insert_with(|| Instant::now() + RESPONSE_DELAY);
        Ok(())
    }
}

#[cfg(test)]
mod tests;
