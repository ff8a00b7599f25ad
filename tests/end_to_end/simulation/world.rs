//! One simulated stage: a publisher, an operator and a subscriber in front of a server, and everything that they see.

use std::{
    collections::hash_map::DefaultHasher,
    hash::{Hash as _, Hasher as _},
    io,
    net::{Ipv4Addr, SocketAddr},
    path::Path,
    sync::{Arc, LazyLock, Mutex, MutexGuard},
    time::Duration,
};

use frontalis_analysis::synthesis::reference_face;
use frontalis_client::{
    capture_client::{CaptureClient, CaptureSettings, report::PublishReport},
    connection::{self, Channel, Credentials},
    curve_client::{CurveClient, CurveEvent, CurveSettings, StartAt, Wanted},
};
use frontalis_proto::v1::{
    CaptureKind, CreateSessionRequest, CurveSample, EndSessionRequest, ImportActorStart, Ingest,
    LengthUnit, MarkerFrame, StartTakeRequest, session_service_client::SessionServiceClient,
    take_event::Event, take_service_client::TakeServiceClient,
};
use frontalis_server::{
    Ground,
    catalogue::{Catalogue, NewRevision},
    config::{Config, IN_MEMORY},
    fs::{Fs as _, MemFs},
    run_on,
    service::listener::Incoming,
    wire::actor::{ImportStart, layout},
};
use harness::{RecordedTake, TestPerformance, reference_package};
use hyper_util::rt::TokioIo;
use prost::Message as _;
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64Mcg;
use tokio::{
    sync::mpsc,
    time::{Instant, sleep, sleep_until, timeout},
};
use tokio_util::sync::CancellationToken;

use super::{
    history::{Acknowledged, Heard, History, SampleSeen, TakeSeen},
    wire::{Scissors, Severable},
};

/// Frames that the publisher sends.
pub const N_FRAMES: u64 = 240;

/// Frames a second.
const RATE_HZ: f64 = 40.0;

/// The one port of the simulated network.
const PORT: u16 = 7_400;

/// Where its server keeps takes.
const TAKES: &str = "/takes";

const SESSION: &str = "sessions/stage";

/// How long a call may take before its caller tries again.
const PATIENCE: Duration = Duration::from_secs(2);

/// Between two attempts of a caller that was refused.
const AGAIN: Duration = Duration::from_millis(100);

/// What the simulated computers share with the test, which no network can cut.
pub struct World {
    /// Keeps the database while no server runs.
    _catalogue: Catalogue,
    database: String,
    files: Mutex<MemFs>,
    random: Mutex<Pcg64Mcg>,
    performance: TestPerformance,
    /// Cuts connections of clients, as a box on the way may.
    pub scissors: Scissors,
    history: Mutex<History>,
    /// Told when there is a session.
    made: CancellationToken,
    /// Told when all frames are settled.
    pub published: CancellationToken,
    /// Told when nothing goes wrong any more, and everyone had time to notice.
    pub healed: CancellationToken,
}

impl World {
    /// A world in which the storage fails by `seed`, and whose server knows the reference face.
    pub fn new(seed: u64) -> Arc<Self> {
        let database = format!("simulation-{seed}");
        let files = MemFs::default();
        let catalogue = Catalogue::shared_memory(&database, files.clone()).unwrap();
        catalogue.add_revision(reference(), 0).unwrap();
        Arc::new(Self {
            _catalogue: catalogue,
            database,
            files: Mutex::new(files),
            random: Mutex::new(Pcg64Mcg::seed_from_u64(seed)),
            performance: TestPerformance::reference(),
            scissors: Scissors::default(),
            history: Mutex::default(),
            made: CancellationToken::new(),
            published: CancellationToken::new(),
            healed: CancellationToken::new(),
        })
    }

    fn history(&self) -> MutexGuard<'_, History> {
        self.history.lock().unwrap()
    }

    /// The power of the server goes, and with it a quarter of what its storage had said was flushed of takes under way.
    pub fn cut_power_and_lose(&self) {
        self.cut_power();
        let files = self.files.lock().unwrap();
        for name in files.list(Path::new(TAKES)).unwrap() {
            let file = Path::new(TAKES).join(name);
            let content = files.read(&file).unwrap();
            let is_under_way = !content.ends_with(mcap::MAGIC);
            if is_under_way {
                let left = &content[..content.len() / 4 * 3];
                files.write_and_sync(&file, left).unwrap();
            }
        }
    }

    /// The power of the server goes: what was not flushed is there in part, or torn, or not at all.
    pub fn cut_power(&self) {
        let mut files = self.files.lock().unwrap();
        let mut random = self.random.lock().unwrap();
        *files = files.after_power_cut(|_, bytes| {
            let n_kept = random.random_range(0..=bytes.len());
            let mut left = bytes[..n_kept].to_vec();
            if random.random_bool(0.5) {
                let n_torn = random.random_range(0..=n_kept);
                left[n_kept - n_torn..].fill(0);
            }
            left
        });
    }

    /// The server's computer, from one start to the next power cut.
    pub async fn serve(self: Arc<Self>) -> turmoil::Result {
        let config = Config {
            data_dir: IN_MEMORY.to_owned(),
            ..Config::default()
        };
        let files = self.files.lock().unwrap().clone();
        let ground = Ground::simulated(&config, &self.database, files)?;
        let listener = turmoil::net::TcpListener::bind((Ipv4Addr::UNSPECIFIED, PORT)).await?;
        let (streams, incoming) = mpsc::channel(16);
        let address = SocketAddr::from((Ipv4Addr::LOCALHOST, PORT));
        let stopped = CancellationToken::new();
        let _server = run_on(
            ground,
            config,
            Incoming::Streams(incoming),
            address,
            stopped,
        )
        .await?;
        loop {
            let (stream, peer) = listener.accept().await?;
            drop(streams.try_send((Box::new(stream), peer)));
        }
    }

    /// Connections to it; `who` names the client whose connections the scissors cut.
    fn channel(&self) -> Channel {
        let scissors = self.scissors.clone();
        let connector = tower::service_fn(move |_| {
            let scissors = scissors.clone();
            async move {
                let stream = turmoil::net::TcpStream::connect(("server", PORT)).await?;
                Ok::<_, io::Error>(TokioIo::new(Severable::new(stream, scissors.clone())))
            }
        });
        let credentials = Credentials::default();
        let server = format!("http://127.0.0.1:{PORT}");
        let endpoint = connection::endpoint(&server, &credentials).unwrap();
        connection::with_token(
            endpoint.connect_with_connector_lazy(connector),
            &credentials,
        )
    }

    /// Publishes a performance, frame by frame in time.
    pub async fn publish(self: Arc<Self>) -> turmoil::Result {
        let settings = CaptureSettings {
            session: SESSION.to_owned(),
            publisher: "stage".to_owned(),
            marker_names: self.performance.marker_names().to_vec(),
            unit: LengthUnit::Millimeter,
            rate_hz: RATE_HZ,
            ingest: Ingest::Lossless,
            takeover: false,
        };
        self.made.cancelled().await;
        let client = loop {
            match timeout(
                PATIENCE,
                CaptureClient::start(self.channel(), settings.clone()),
            )
            .await
            {
                Ok(Ok(client)) => break client,
                _ => sleep(AGAIN).await,
            }
        };
        let begin = Instant::now();
        for number in 1..=N_FRAMES {
            sleep_until(begin + Duration::from_secs_f64(number as f64 / RATE_HZ)).await;
            let frame = self.performance.frame(number);
            self.history().sent.insert(number, hash_of(&frame));
            client.send(frame).await?;
            self.note(&client.report());
        }
        let published = client.finish().await;
        self.note(&published.report);
        let report = &published.report;
        self.history().unanswered = report.unacknowledged_frames + report.lost.n_frames();
        self.published.cancel();
        Ok(())
    }

    fn note(&self, report: &PublishReport) {
        let now = Acknowledged {
            run: report.run,
            accepted_through: report.accepted_through,
            recording: report.recording,
            durable_through: report.durable_through,
        };
        let mut history = self.history();
        if history.acknowledged.last() != Some(&now) {
            history.acknowledged.push(now);
        }
    }

    /// Makes the session, has it recorded whenever it is not, and ends it when all is done.
    pub async fn operate(self: Arc<Self>) -> turmoil::Result {
        let mut sessions = SessionServiceClient::new(self.channel());
        let create = CreateSessionRequest {
            session_id: "stage".to_owned(),
            actor: "actors/reference".to_owned(),
            kind: CaptureKind::Markers.into(),
            ..CreateSessionRequest::default()
        };
        loop {
            let created = timeout(PATIENCE, sessions.create_session(create.clone())).await;
            match created {
                Ok(Ok(_)) => break,
                Ok(Err(status)) if status.code() == tonic::Code::AlreadyExists => break,
                _ => sleep(AGAIN).await,
            }
        }
        self.made.cancel();
        let mut takes = TakeServiceClient::new(self.channel());
        while !self.published.is_cancelled() || !self.healed.is_cancelled() {
            let request = StartTakeRequest {
                session: SESSION.to_owned(),
                ..StartTakeRequest::default()
            };
            drop(timeout(PATIENCE, takes.start_take(request)).await);
            sleep(AGAIN).await;
        }
        loop {
            let request = EndSessionRequest {
                name: SESSION.to_owned(),
            };
            drop(timeout(PATIENCE, sessions.end_session(request)).await);
            sleep(AGAIN).await;
        }
    }

    /// Follows every frame until the session ends.
    pub async fn follow(self: Arc<Self>) -> turmoil::Result {
        let wanted = Wanted::EveryFrame {
            from: StartAt::Oldest,
        };
        let settings = CurveSettings::new(SESSION, wanted);
        self.made.cancelled().await;
        let mut client = loop {
            match timeout(
                PATIENCE,
                CurveClient::subscribe(self.channel(), settings.clone()),
            )
            .await
            {
                Ok(Ok(client)) => break client,
                _ => sleep(AGAIN).await,
            }
        };
        while let Some(event) = client.next().await? {
            let heard = heard(&event);
            self.history().heard.extend(heard);
        }
        Ok(())
    }

    /// What was seen, and what the storage holds now.
    pub fn to_history(&self) -> History {
        let mut history = self.history().clone();
        let files = self.files.lock().unwrap();
        let folder = Path::new(TAKES);
        for name in files.list(folder).unwrap() {
            let file = files.read(&folder.join(name)).unwrap();
            history.takes.push(take_seen(&RecordedTake::read(&file)));
        }
        history
    }
}

/// The reference face, read once.
fn reference() -> &'static NewRevision {
    static REFERENCE: LazyLock<NewRevision> = LazyLock::new(|| {
        let start = ImportActorStart {
            actor_id: "reference".to_owned(),
            ..ImportActorStart::default()
        };
        let start = ImportStart::try_from(start).unwrap();
        NewRevision {
            layout: layout(&reference_face::actor(), &start),
            actor: start.actor,
            package: reference_package(),
        }
    });
    &REFERENCE
}

fn heard(event: &CurveEvent) -> Option<Heard> {
    Some(match event {
        CurveEvent::Header(header) => Heard::Header { run: header.run },
        CurveEvent::Sample(sample) => Heard::Sample(sample_seen(sample)),
        CurveEvent::Gap(gap) => Heard::Gap {
            first: gap.first,
            last: gap.last,
        },
        CurveEvent::Lost {
            first_sequence,
            last_sequence,
        } => Heard::Lost {
            first: *first_sequence,
            last: *last_sequence,
        },
        CurveEvent::End(_) => Heard::End,
        CurveEvent::Skipped(_)
        | CurveEvent::State(_)
        | CurveEvent::NewRun { .. }
        | CurveEvent::Reconnecting { .. } => return None,
    })
}

fn take_seen(take: &RecordedTake) -> TakeSeen {
    let header = take.events.iter().find_map(|it| match it {
        Event::Header(header) => Some(header),
        _ => None,
    });
    TakeSeen {
        run: header.map_or(0, |it| it.run),
        next_frame: header.map_or(0, |it| it.next_frame),
        frames: take
            .frames
            .iter()
            .map(|it| (it.number, hash_of(it)))
            .collect(),
        samples: take.samples.iter().map(sample_seen).collect(),
    }
}

fn sample_seen(sample: &CurveSample) -> SampleSeen {
    let mut hasher = DefaultHasher::new();
    for activation in &sample.activations {
        activation.to_bits().hash(&mut hasher);
    }
    SampleSeen {
        sequence: sample.sequence,
        frame: sample.frame,
        hash: hasher.finish(),
    }
}

fn hash_of(frame: &MarkerFrame) -> u64 {
    let mut hasher = DefaultHasher::new();
    frame.encode_to_vec().hash(&mut hasher);
    hasher.finish()
}
