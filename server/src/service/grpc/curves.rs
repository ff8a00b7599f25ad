//! `CurveService`: curves out.
//!
//! A stream pulls from its subscription when its connection has room, so that nothing is queued for a subscriber that
//! does not read (CONTRACTS D-14, D-19). It frees its place when it is dropped, and when its reader is blocked.

mod page;
mod reader;
mod replaying;

use std::pin::Pin;

use frontalis_proto::v1::{self, curve_service_server::CurveService};
use futures::{Stream, StreamExt as _, stream};
use tonic::{Request, Response, Status, Streaming};

pub(in crate::service) use self::reader::MAX_PAUSE;
use self::{
    reader::Reader,
    replaying::{Begun, Replaying},
};
use super::{
    ending,
    opening::{first_message, protocol_order},
};
use crate::{
    catalogue::Store,
    clock::ServerClock,
    hub::{Closing, Delivered, LostRange, Subscription},
    service::{
        access::{Action, Caller},
        peer::Peer,
        replay::Replays,
        sessions::in_process,
    },
    session::{SessionError, SessionHandle, SessionRegistry},
    wire::curve::{self as wire, SampleDetail},
};

/// The service; cheap to clone.
#[derive(Clone)]
pub struct CurvesGrpc {
    registry: SessionRegistry,
    store: Store,
    clock: ServerClock,
    replays: Replays,
}

impl CurvesGrpc {
    /// Serves the sessions of `registry`; `store` knows of those that ended, and `replays` has what they no longer keep.
    pub fn new(
        registry: SessionRegistry,
        store: Store,
        clock: ServerClock,
        replays: Replays,
    ) -> Self {
        Self {
            registry,
            store,
            clock,
            replays,
        }
    }

    /// The responses to one subscriber's requests.
    ///
    /// Every door comes through here or through `follow`.
    pub(in crate::service) fn subscription<S>(&self, requests: S, peer: Peer) -> Responses
    where
        S: Stream<Item = Result<v1::SubscribeRequest, Status>> + Send + Unpin + 'static,
    {
        self.responses(requests, Phase::Opening, peer)
    }

    fn responses<S>(&self, grants: S, phase: Phase, peer: Peer) -> Responses
    where
        S: Stream<Item = Result<v1::SubscribeRequest, Status>> + Send + Unpin + 'static,
    {
        let caller = peer.caller.clone();
        let following = Following {
            service: self.clone(),
            grants,
            phase,
            peer,
        };
        let responses = stream::unfold(following, |mut following| async {
            let response = following.next().await?;
            Some((response, following))
        });
        caller.while_valid(responses)
    }

    /// The subscription, and the header that comes first.
    async fn open(
        &self,
        sent: &v1::SubscribeStart,
        peer: &Peer,
        can_return_credits: bool,
    ) -> Result<(Flow, v1::SubscribeResponse), Status> {
        let request = wire::start(
            sent,
            peer.address_name(),
            peer.door.name(),
            can_return_credits,
        )
        // Who can return credits sends the start as a part of a message.
        .map_err(|error| {
            if can_return_credits {
                error.inside("start")
            } else {
                error
            }
        })?;
        peer.caller.may_in(Action::Subscribe, &request.session)?;
        let session = in_process(&self.registry, &self.store, &request.session).await?;
        let actor = session.actor();
        let max_samples = wire::samples_in_a_response(
            actor.muscle_set().muscles().len(),
            actor.markers().len(),
            request.detail,
        );
        let mut header = self.header(&session);
        let begun = replaying::begin(&self.replays, &session, request.spec, max_samples);
        let (mut subscription, replaying) = match begun.await? {
            Begun::Live(subscription) => (subscription, None),
            Begun::Replay(subscription, replaying) => (subscription, Some(replaying)),
        };
        let (run, next_sequence) = match &replaying {
            Some(replaying) => (replaying.run(), replaying.next_sequence()),
            None => (header.run, subscription.next_sequence()),
        };
        header.run = run;
        header.next_sequence = next_sequence;
        subscription.limit_entries(max_samples);
        let flow = Flow {
            reader: Reader::new(subscription),
            replays: self.replays.clone(),
            session,
            replaying,
            max_samples,
            detail: request.detail,
            may_grant: can_return_credits,
        };
        let response = v1::SubscribeResponse {
            header: Some(header),
            ..v1::SubscribeResponse::default()
        };
        Ok((flow, response))
    }

    fn header(&self, session: &SessionHandle) -> v1::CurveHeader {
        let now_nanos = self.clock.now_nanos();
        wire::header(session, now_nanos, self.clock.unix_offset_nanos())
    }
}

/// The responses of one subscriber's stream.
pub type Responses = Pin<Box<dyn Stream<Item = Result<v1::SubscribeResponse, Status>> + Send>>;

#[tonic::async_trait]
impl CurveService for CurvesGrpc {
    type SubscribeStream = Responses;

    async fn subscribe(
        &self,
        request: Request<Streaming<v1::SubscribeRequest>>,
    ) -> Result<Response<Responses>, Status> {
        let peer = Peer::of(request.extensions());
        peer.caller.may(Action::Subscribe)?;
        let responses = self.subscription(request.into_inner(), peer);
        Ok(Response::new(responses))
    }

    type FollowStream = Responses;

    async fn follow(
        &self,
        request: Request<v1::SubscribeStart>,
    ) -> Result<Response<Responses>, Status> {
        let peer = Peer::of(request.extensions());
        peer.caller.may(Action::Subscribe)?;
        let (flow, header) = self.open(request.get_ref(), &peer, false).await?;
        let phase = Phase::Opened(Box::new(flow), Box::new(header));
        let responses = self.responses(stream::pending(), phase, peer);
        Ok(Response::new(responses))
    }

    async fn read_curves(
        &self,
        request: Request<v1::ReadCurvesRequest>,
    ) -> Result<Response<v1::ReadCurvesResponse>, Status> {
        let caller = Caller::of(request.extensions());
        caller.may(Action::Subscribe)?;
        let asked = wire::read(request.get_ref())?;
        caller.may_in(Action::Subscribe, &asked.session)?;
        let session = in_process(&self.registry, &self.store, &asked.session).await?;
        let header = self.header(&session);
        if let Some(response) = page::replayed(&self.replays, &session, &asked, &header).await? {
            return Ok(Response::new(response));
        }
        let page = session.hub().page(asked.run, asked.after, asked.limit);
        let page = match page {
            Ok(page) => page,
            Err(range) => {
                return Err(replaying::not_kept(&self.replays, &session, range)
                    .await?
                    .into());
            }
        };
        let response = wire::page_to_wire(&page, header, asked.detail);
        Ok(Response::new(response))
    }
}

/// One subscriber's stream.
struct Following<S> {
    service: CurvesGrpc,
    grants: S,
    phase: Phase,
    peer: Peer,
}

enum Phase {
    Opening,
    /// The header is still to be sent.
    Opened(Box<Flow>, Box<v1::SubscribeResponse>),
    Flowing(Box<Flow>),
    Over,
}

struct Flow {
    reader: Reader,
    replays: Replays,
    session: SessionHandle,
    /// While it is served out of takes.
    replaying: Option<Box<Replaying>>,
    max_samples: usize,
    detail: SampleDetail,
    /// Whether the client's side is open.
    may_grant: bool,
}

impl<S> Following<S>
where
    S: Stream<Item = Result<v1::SubscribeRequest, Status>> + Unpin,
{
    async fn next(&mut self) -> Option<Result<v1::SubscribeResponse, Status>> {
        let response = match std::mem::replace(&mut self.phase, Phase::Over) {
            Phase::Opening => match self.start().await {
                Ok((flow, header)) => {
                    self.phase = Phase::Flowing(Box::new(flow));
                    Ok(header)
                }
                Err(status) => Err(status),
            },
            Phase::Opened(flow, header) => {
                self.phase = Phase::Flowing(flow);
                Ok(*header)
            }
            Phase::Flowing(mut flow) => {
                let response = flow.next(&mut self.grants).await;
                let is_last = response.as_ref().map_or(true, |it| it.end.is_some());
                if !is_last {
                    self.phase = Phase::Flowing(flow);
                }
                response
            }
            Phase::Over => return None,
        };
        Some(response)
    }

    async fn start(&mut self) -> Result<(Flow, v1::SubscribeResponse), Status> {
        self.peer.caller.may(Action::Subscribe)?;
        let request = first_message(&mut self.grants, &self.service.registry).await?;
        let missing = || protocol_order("the first message must be start");
        let start = request.start.ok_or_else(missing)?;
        self.service.open(&start, &self.peer, true).await
    }
}

impl Flow {
    async fn next<S>(&mut self, grants: &mut S) -> Result<v1::SubscribeResponse, Status>
    where
        S: Stream<Item = Result<v1::SubscribeRequest, Status>> + Unpin,
    {
        let blocked = |lost| ending::blocked(&lost);
        let mut subscription = self.reader.ask().map_err(blocked)?;
        let response = self.next_of(&mut subscription, grants).await;
        self.reader.put_back(subscription);
        response
    }

    async fn next_of<S>(
        &mut self,
        subscription: &mut Subscription,
        grants: &mut S,
    ) -> Result<v1::SubscribeResponse, Status>
    where
        S: Stream<Item = Result<v1::SubscribeRequest, Status>> + Unpin,
    {
        loop {
            if let Some(replaying) = &mut self.replaying {
                // Credits mean nothing here: they are read when it is live again.
                if let Some(response) = replaying.next(subscription, self.detail).await? {
                    return Ok(response);
                }
                self.replaying = None;
            }
            let delivered = self.delivered(subscription, grants).await?;
            if let Delivered::Lagged(lost) = &delivered {
                self.fall_back(lost, subscription).await?;
            } else {
                return self.respond(delivered, subscription);
            }
        }
    }

    async fn delivered<S>(
        &mut self,
        subscription: &mut Subscription,
        grants: &mut S,
    ) -> Result<Delivered, Status>
    where
        S: Stream<Item = Result<v1::SubscribeRequest, Status>> + Unpin,
    {
        loop {
            tokio::select! {
                // Returned credits first: they decide what may be sent.
                biased;
                grant = grants.next(), if self.may_grant => self.receive(grant, subscription)?,
                delivered = subscription.next() => return Ok(delivered),
            }
        }
    }

    /// Reads on in a take what the session no longer keeps.
    async fn fall_back(
        &mut self,
        lost: &LostRange,
        subscription: &Subscription,
    ) -> Result<(), Status> {
        let (replays, session) = (&self.replays, &self.session);
        let found = Replaying::after_lag(replays, session, subscription, self.max_samples);
        match found.await? {
            Some(replaying) => self.replaying = Some(replaying),
            None => return Err(ending::lagged(lost)),
        }
        Ok(())
    }

    fn receive(
        &mut self,
        grant: Option<Result<v1::SubscribeRequest, Status>>,
        subscription: &mut Subscription,
    ) -> Result<(), Status> {
        // A client that closed its side goes on to read what its credits allow.
        let Some(request) = grant else {
            self.may_grant = false;
            return Ok(());
        };
        let request = request?;
        if request.start.is_some() {
            return Err(protocol_order("start was sent twice"));
        }
        subscription.grant(request.credits);
        Ok(())
    }

    fn respond(
        &self,
        delivered: Delivered,
        subscription: &Subscription,
    ) -> Result<v1::SubscribeResponse, Status> {
        match delivered {
            Delivered::Update(update) => Ok(wire::update_to_wire(&update, self.detail)),
            Delivered::Lagged(lost) => Err(ending::lagged(&lost)),
            Delivered::Closed(Closing::Draining) => Err(SessionError::Draining.into()),
            Delivered::Closed(Closing::Ended { reason, last_frame }) => {
                let skipped_samples = subscription.skipped_samples();
                Ok(wire::end_to_wire(reason, last_frame, skipped_samples))
            }
        }
    }
}

#[cfg(test)]
mod tests;
