//! A capture stage for tests: one session of the reference face in memory, publishers and renderers without sockets.

use std::{
    path::PathBuf,
    sync::Arc,
    time::{Duration, SystemTime},
};

use frontalis_analysis::{
    analyzer::MarkerSettings,
    face::actor::Actor,
    synthesis::{blend, reference_face},
};
use frontalis_proto::v1;
use futures::{Stream, StreamExt as _};
use tokio::{
    sync::mpsc,
    time::{Instant, timeout},
};
use tokio_stream::wrappers::ReceiverStream;
use tonic::{Code, Request, Status};

use super::{capture::CaptureGrpc, curves::CurvesGrpc, status::reason_of};
use crate::{
    catalogue::{Catalogue, Layout, NewRevision, NewSession, Store, StoredSettings},
    clock::ServerClock,
    executor::{Threads, Workers},
    fs::{Fs, MemFs},
    name::{ActorId, SessionId},
    service::{access::Caller, audit::Audit, peer::Peer, sessions::Sessions, takes::Takes},
    session::{
        RestoredAlignment, SessionEvent, SessionHandle, SessionLimits, SessionRegistry,
        SessionSettings, SessionSpec,
    },
};

pub(super) const SESSION: &str = "sessions/one";
/// Neutral frames of the sessions here.
pub(super) const NEUTRAL_FRAMES: u64 = 4;

pub(in crate::service) struct Stage {
    pub(super) registry: SessionRegistry,
    pub(in crate::service) session: SessionHandle,
    pub(super) capture: CaptureGrpc,
    pub(in crate::service) curves: CurvesGrpc,
    pub(super) sessions: Sessions,
    pub(super) takes: Takes,
    pub(super) store: Store,
    pub(super) events: mpsc::Receiver<SessionEvent>,
    pub(super) actor: Arc<Actor>,
}

pub(super) fn settings() -> SessionSettings {
    SessionSettings {
        marker: MarkerSettings {
            neutral_frames: usize::try_from(NEUTRAL_FRAMES).unwrap(),
            // Faces jump from frame to frame here, and their curves are known.
            ..MarkerSettings::plain()
        },
        ..SessionSettings::default()
    }
}

impl Stage {
    pub(in crate::service) async fn new() -> Self {
        Self::with(SessionLimits::default(), settings(), None).await
    }

    pub(super) async fn with(
        limits: SessionLimits,
        settings: SessionSettings,
        restored: Option<RestoredAlignment>,
    ) -> Self {
        let clock = ServerClock::start(SystemTime::UNIX_EPOCH);
        let actor = Arc::new(reference_face::actor());
        let (sender, events) = mpsc::channel(64);
        let registry = SessionRegistry::new(limits, clock, sender);
        let store = store(&actor).await;
        let id = SessionId::from_resource(SESSION).unwrap();
        let session = registry
            .open(SessionSpec {
                id,
                display_name: "One".to_owned(),
                actor_id: ActorId::parse("reference").unwrap(),
                actor: Arc::clone(&actor),
                actor_revision: 1,
                settings,
                run: 1,
                create_time: SystemTime::UNIX_EPOCH,
                restored,
            })
            .unwrap();
        let fs: Arc<dyn Fs> = Arc::new(MemFs::default());
        let (dir, kept) = (PathBuf::from("/takes"), registry.clone());
        let takes = Takes::new(Threads::Inline, store.clone(), kept, clock, fs, dir).unwrap();
        Self {
            capture: CaptureGrpc::new(
                registry.clone(),
                store.clone(),
                clock,
                Audit::none(),
                takes.clone(),
            ),
            curves: CurvesGrpc::new(registry.clone(), store.clone(), clock, takes.replays()),
            takes,
            sessions: Sessions::new(store.clone(), registry.clone(), clock, 4),
            store,
            registry,
            session,
            events,
            actor,
        }
    }

    /// A frame of the face, in millimeters; neutral first, then one muscle after the other.
    pub(super) fn frame(&self, number: u64) -> v1::MarkerFrame {
        self.frame_in(number, 10.0)
    }

    /// As [`Self::frame`], with so many units in a centimeter.
    pub(super) fn frame_in(&self, number: u64, units_per_cm: f64) -> v1::MarkerFrame {
        let actor = &self.actor;
        let mut contractions = vec![0.0; actor.muscle_set().len()];
        if number > NEUTRAL_FRAMES {
            let idx = usize::try_from(number).unwrap() % contractions.len();
            contractions[idx] = 0.5;
        }
        let mut mesh = actor.mesh().clone();
        let neutral = mesh.clone();
        blend::blend(&neutral, actor.basis(), &contractions, &mut mesh.vertices).unwrap();
        let places = actor.virtual_markers().iter().map(|it| it.position(&mesh));
        #[expect(clippy::cast_possible_truncation, reason = "the wire has f32")]
        let positions = places
            .flat_map(|it| [it.0.x, it.0.y, it.0.z])
            .map(|it| (it * units_per_cm) as f32)
            .collect();
        v1::MarkerFrame {
            number,
            capture_time_nanos: i64::try_from(number).unwrap() * 16_666_667,
            positions,
            source_frame: number + 1_000,
            ..v1::MarkerFrame::default()
        }
    }

    pub(in crate::service) fn frames(
        &self,
        numbers: impl IntoIterator<Item = u64>,
    ) -> Vec<v1::MarkerFrame> {
        numbers.into_iter().map(|it| self.frame(it)).collect()
    }

    /// A publisher whose stream has begun.
    pub(in crate::service) async fn publisher(&self, id: &str) -> Publisher {
        let mut publisher = self.start(start(id)).await;
        publisher.started = publisher.response().await.unwrap().started;
        publisher
    }

    /// A publisher that has sent its start.
    pub(super) async fn start(&self, start: v1::PublishStart) -> Publisher {
        let mut publisher = self.silent_publisher();
        let request = v1::PublishMarkersRequest {
            start: Some(start),
            ..v1::PublishMarkersRequest::default()
        };
        publisher.request(request).await;
        publisher
    }

    pub(super) fn silent_publisher(&self) -> Publisher {
        let (requests, received) = mpsc::channel(1_024);
        Publisher {
            requests: Some(requests),
            responses: self.capture.publish(ReceiverStream::new(received), peer()),
            started: None,
            rejected: Vec::new(),
            accepted_through: 0,
            shed_frames: 0,
        }
    }

    /// A renderer that has read its header.
    pub(super) async fn renderer(&self, start: v1::SubscribeStart) -> Renderer {
        let mut renderer = self.subscribe(start).await;
        let first = renderer.response().await.unwrap();
        renderer.header = first.header.clone();
        let only_header = v1::SubscribeResponse {
            header: first.header.clone(),
            ..v1::SubscribeResponse::default()
        };
        assert_eq!(first, only_header);
        renderer
    }

    pub(super) async fn subscribe(&self, start: v1::SubscribeStart) -> Renderer {
        let mut renderer = self.silent_renderer();
        renderer
            .request(v1::SubscribeRequest {
                start: Some(start),
                credits: 0,
            })
            .await;
        renderer
    }

    pub(super) fn silent_renderer(&self) -> Renderer {
        let (requests, received) = mpsc::channel(64);
        let received = ReceiverStream::new(received);
        Renderer {
            requests,
            responses: self.curves.subscription(received, peer()),
            header: None,
            states: Vec::new(),
        }
    }
}

async fn store(actor: &Actor) -> Store {
    let catalogue = Catalogue::in_memory(MemFs::default()).unwrap();
    let store = Store::new(catalogue, Workers::inline(), Workers::inline(), 4);
    let id = ActorId::parse("reference").unwrap();
    let layout = Layout {
        display_name: String::new(),
        muscle_set: actor.muscle_set().id().to_owned(),
        muscles: actor.muscle_set().muscles().to_vec(),
        markers: actor.markers().to_vec(),
        n_vertices: 0,
        n_triangles: 0,
        conditions: [1.0; 2],
        ambiguous: Vec::new(),
        regularized: false,
    };
    let revision = NewRevision {
        actor: id.clone(),
        layout,
        package: vec![0],
    };
    store.add_revision(revision, 0).await.unwrap();
    let session = NewSession {
        id: SessionId::from_resource(SESSION).unwrap(),
        display_name: String::new(),
        actor: id,
        actor_revision: 1,
        settings: StoredSettings {
            marker: settings().marker,
            stale_after: None,
            publisher_timeout: Duration::from_secs(10),
            record: false,
            record_images: false,
        },
    };
    store.create_session(session, 0).await.unwrap();
    store
}

pub(super) fn start(publisher: &str) -> v1::PublishStart {
    v1::PublishStart {
        session: SESSION.to_owned(),
        publisher: publisher.to_owned(),
        unit: v1::LengthUnit::Millimeter.into(),
        rate_hz: 60.0,
        ingest: v1::Ingest::Lossless.into(),
        ..v1::PublishStart::default()
    }
}

pub(in crate::service) fn every_frame() -> v1::SubscribeStart {
    v1::SubscribeStart {
        session: SESSION.to_owned(),
        delivery: v1::Delivery::EveryFrame.into(),
        from_oldest: true,
        ..v1::SubscribeStart::default()
    }
}

pub(super) fn latest(credits: u32) -> v1::SubscribeStart {
    v1::SubscribeStart {
        session: SESSION.to_owned(),
        credits,
        ..v1::SubscribeStart::default()
    }
}

/// Fails when the status has another code or reason.
#[track_caller]
pub(super) fn assert_refused(status: &Status, code: Code, reason: &str) {
    assert_eq!(status.code(), code, "{status:?}");
    assert_eq!(reason_of(status).as_deref(), Some(reason), "{status:?}");
}

pub(in crate::service) struct Publisher {
    requests: Option<mpsc::Sender<Result<v1::PublishMarkersRequest, Status>>>,
    responses: std::pin::Pin<Box<dyn Stream<Item = Result<v1::PublishResponse, Status>> + Send>>,
    pub(super) started: Option<v1::PublishStarted>,
    /// Number and reason of every rejected frame so far.
    pub(super) rejected: Vec<(u64, String)>,
    pub(super) accepted_through: u64,
    pub(super) shed_frames: u64,
}

impl Publisher {
    pub(super) async fn request(&mut self, request: v1::PublishMarkersRequest) {
        let requests = self.requests.as_ref().unwrap();
        requests.send(Ok(request)).await.unwrap();
    }

    pub(super) async fn send(&mut self, frames: Vec<v1::MarkerFrame>) {
        let request = v1::PublishMarkersRequest {
            frames,
            ..v1::PublishMarkersRequest::default()
        };
        self.request(request).await;
    }

    pub(super) async fn keep_alive(&mut self) {
        self.send(Vec::new()).await;
        self.response().await.unwrap();
    }

    /// The next response; an end without a status is `OK`.
    pub(super) async fn response(&mut self) -> Result<v1::PublishResponse, Status> {
        let soon = Duration::from_mins(1);
        let response = timeout(soon, self.responses.next())
            .await
            .expect("a response");
        let response = response.unwrap_or_else(|| Err(Status::ok("")))?;
        assert!(response.accepted_through >= self.accepted_through);
        self.accepted_through = response.accepted_through;
        self.shed_frames = response.shed_frames;
        let reasons = response.rejected.iter();
        self.rejected
            .extend(reasons.map(|it| (it.number, it.reason.clone())));
        Ok(response)
    }

    /// Sends frames, and reads responses until the last is taken.
    pub(in crate::service) async fn publish(&mut self, frames: Vec<v1::MarkerFrame>) {
        let last = frames.last().map_or(0, |it| it.number);
        for message in frames.chunks(200) {
            self.send(message.to_vec()).await;
        }
        while self.accepted_through < last {
            self.response().await.unwrap();
        }
    }

    /// Reads until the stream ends.
    pub(super) async fn end(&mut self) -> Status {
        loop {
            if let Err(status) = self.response().await {
                return status;
            }
        }
    }

    pub(super) fn half_close(&mut self) {
        self.requests = None;
    }
}

pub(super) struct Renderer {
    requests: mpsc::Sender<Result<v1::SubscribeRequest, Status>>,
    responses: std::pin::Pin<Box<dyn Stream<Item = Result<v1::SubscribeResponse, Status>> + Send>>,
    pub(super) header: Option<v1::CurveHeader>,
    /// Every state heard, with when.
    pub(super) states: Vec<(v1::SessionState, Instant)>,
}

/// What an `EVERY_FRAME` renderer saw, in order of frames: sequence, or the gap's cause.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Seen {
    Sample {
        frame: u64,
        sequence: u64,
    },
    Gap {
        first: u64,
        last: u64,
        cause: v1::GapCause,
    },
}

impl Seen {
    fn first(&self) -> u64 {
        match self {
            Self::Sample { frame, .. } => *frame,
            Self::Gap { first, .. } => *first,
        }
    }

    fn last(&self) -> u64 {
        match self {
            Self::Sample { frame, .. } => *frame,
            Self::Gap { last, .. } => *last,
        }
    }
}

impl Renderer {
    pub(super) async fn request(&mut self, request: v1::SubscribeRequest) {
        self.requests.send(Ok(request)).await.unwrap();
    }

    pub(super) async fn grant(&mut self, credits: u32) {
        let request = v1::SubscribeRequest {
            start: None,
            credits,
        };
        self.request(request).await;
    }

    pub(super) async fn response(&mut self) -> Result<v1::SubscribeResponse, Status> {
        let soon = Duration::from_mins(1);
        let response = timeout(soon, self.responses.next())
            .await
            .expect("a response");
        let response = response.unwrap_or_else(|| Err(Status::ok("")))?;
        if let Some(state) = &response.state {
            self.states.push((state.session_state(), Instant::now()));
        }
        Ok(response)
    }

    /// Reads until frame `last` was seen as a sample or in a gap.
    pub(super) async fn see_through(&mut self, last: u64) -> Vec<Seen> {
        let mut seen = Vec::new();
        while seen.last().is_none_or(|it: &Seen| it.last() < last) {
            seen.extend(in_order(&self.response().await.unwrap()));
        }
        seen
    }

    /// Reads samples until frame `last`.
    pub(super) async fn samples_through(&mut self, last: u64) -> Vec<v1::CurveSample> {
        let mut samples: Vec<v1::CurveSample> = Vec::new();
        while samples.last().is_none_or(|it| it.frame < last) {
            samples.extend(self.response().await.unwrap().samples);
        }
        samples
    }

    /// Reads until the session is in this state.
    pub(super) async fn hear(&mut self, state: v1::SessionState) {
        while self.states.last().is_none_or(|it| it.0 != state) {
            self.response().await.unwrap();
        }
    }

    /// Reads until the stream ends; the last response and the status.
    pub(super) async fn end(&mut self) -> (Option<v1::SubscribeResponse>, Status) {
        let mut last = None;
        loop {
            match self.response().await {
                Ok(response) => last = Some(response),
                Err(status) => return (last, status),
            }
        }
    }
}

pub(super) fn in_order(response: &v1::SubscribeResponse) -> Vec<Seen> {
    let samples = response.samples.iter().map(|it| Seen::Sample {
        frame: it.frame,
        sequence: it.sequence,
    });
    let gaps = response.gaps.iter().map(|it| Seen::Gap {
        first: it.first,
        last: it.last,
        cause: it.cause(),
    });
    let mut seen: Vec<Seen> = samples.chain(gaps).collect();
    seen.sort_by_key(Seen::first);
    seen
}

/// A call by whoever reaches the port.
pub(in crate::service) fn asked<T>(message: T) -> Request<T> {
    let mut request = Request::new(message);
    request.extensions_mut().insert(Caller::anyone());
    request
}

/// A renderer on this machine.
pub(in crate::service) fn peer() -> Peer {
    Peer {
        address: Some(([127, 0, 0, 1], 9).into()),
        caller: Caller::anyone(),
        ..Peer::default()
    }
}
