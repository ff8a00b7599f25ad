//! One server from start to end: everything that runs is started here and joined here.

mod ending;
mod ground;

use std::{io, net::SocketAddr, path::Path, time::Duration};

use tokio::{net::TcpListener, sync::mpsc};
use tokio_util::{sync::CancellationToken, task::TaskTracker};

use self::ending::Ending;
pub use self::ground::Ground;

use crate::{
    catalogue::CatalogueError,
    clock::ServerClock,
    config::{Config, ConfigError, Limits, worst_case},
    reload::Reload,
    service::{
        access::{self, Access, TokenSourceError},
        audit::Audit,
        calls::Calls,
        door::{self, ReflectionError, Services},
        erasure::Erasure,
        grpc::{
            actors::{ActorLimits, ActorsGrpc},
            capture::CaptureGrpc,
            curves::CurvesGrpc,
            server::{Protection, ServerGrpc},
            sessions::SessionsGrpc,
            takes::TakesGrpc,
        },
        guard::Guard,
        http::{Doors, LargeBodies},
        keeper::{self, EVENT_CAPACITY, Keeper},
        listener::{
            Incoming, Listener,
            tls::{Tls, TlsError},
        },
        readiness::Readiness,
        retention::Retention,
        sessions::Sessions,
        take_exports::TakeExports,
        takes::Takes,
    },
    session::{SessionLimits, SessionRegistry},
    shutdown::Phases,
    telemetry::Metrics,
};

/// Why a server does not start.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The configuration is refused.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The certificates cannot be used.
    #[error("TLS cannot be set up")]
    Tls(#[from] TlsError),
    /// The data directory cannot be used.
    #[error("the catalogue cannot be opened")]
    Catalogue(#[from] CatalogueError),
    /// The token file cannot be used.
    #[error(transparent)]
    Tokens(#[from] TokenSourceError),
    /// The audit log cannot be opened.
    #[error("the audit log cannot be opened")]
    Audit(#[source] io::Error),
    /// The port cannot be used.
    #[error("the port cannot be used")]
    Port(#[from] io::Error),
    /// The protocol's descriptors are broken.
    #[error(transparent)]
    Reflection(#[from] ReflectionError),
}

/// A running server. Dropping it leaves it running; [`Server::stopped`] waits for its end.
pub struct Server {
    address: SocketAddr,
    metrics: Metrics,
    registry: SessionRegistry,
    is_tls: bool,
    rescue: Option<String>,
    reload: Reload,
    end: tokio::task::JoinHandle<bool>,
}

impl Server {
    /// Where it listens.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Where it listens, as a client writes it.
    pub fn url(&self) -> String {
        let scheme = if self.is_tls { "https" } else { "http" };
        format!("{scheme}://{}", self.address)
    }

    /// Looks at the files again that may change without a restart. What does not fit is logged and changes nothing.
    pub fn reload(&self) {
        self.reload.ask();
    }

    /// Its figures.
    pub fn metrics(&self) -> &Metrics {
        &self.metrics
    }

    /// Its sessions.
    pub fn registry(&self) -> &SessionRegistry {
        &self.registry
    }

    /// Why it only shows the takes that it found: its catalogue is damaged.
    pub fn rescue(&self) -> Option<&str> {
        self.rescue.as_deref()
    }

    /// Waits until everything is joined. True: all of it ended by itself; false: the grace was over and the rest was
    /// cut.
    pub async fn stopped(self) -> bool {
        self.end.await.unwrap_or(false)
    }
}

/// Starts a server on a bound port; it drains and stops when `shutdown` is cancelled.
///
/// The data directory is `config.data_dir`, or memory; see [`crate::config::IN_MEMORY`]. When its catalogue is damaged, the
/// server starts all the same, changes nothing, and shows the takes that it finds ([`Server::rescue`]).
///
/// # Errors
///
/// [`RunError`]; then nothing runs.
pub async fn run(
    config: Config,
    listener: TcpListener,
    shutdown: CancellationToken,
) -> Result<Server, RunError> {
    config.validate()?;
    let address = listener.local_addr()?;
    let ground = Ground::of(&config).await?;
    run_on(ground, config, Incoming::Port(listener), address, shutdown).await
}

/// The same on a given ground, with connections from anywhere; `address` is where it says that it listens.
///
/// # Errors
///
/// [`RunError`]; then nothing runs.
#[expect(
    clippy::too_many_lines,
    reason = "everything that runs is started here, once and in order"
)]
pub async fn run_on(
    ground: Ground,
    config: Config,
    incoming: Incoming,
    address: SocketAddr,
    shutdown: CancellationToken,
) -> Result<Server, RunError> {
    let tls = load_tls(&config).await?;
    let protection = protection(&config, address);
    let clock = ServerClock::start_now();
    let metrics = first_figures(&config, protection);

    let (store, heavy) = (ground.store.clone(), ground.heavy.clone());
    let rescue = ground.rescue;
    let (audit, audited) = Audit::new();
    let (events, kept) = mpsc::channel(EVENT_CAPACITY);
    let limits = session_limits(&config.limits);
    let registry = SessionRegistry::new(limits.clone(), clock, events);
    let sessions = Sessions::new(store.clone(), registry.clone(), clock, limits.sessions);
    let takes = Takes::new(
        ground.threads,
        store.clone(),
        registry.clone(),
        clock,
        ground.files,
        ground.takes,
    )?;
    takes.recorder().look_at_disk().await;
    let phases = Phases::default();
    let readiness = Readiness {
        phases: phases.clone(),
        rescue: rescue.clone(),
        disk: takes.recorder().room(),
    };
    let erasure = Erasure {
        store: store.clone(),
        registry: registry.clone(),
        takes: takes.clone(),
        clock,
        audit: audit.clone(),
    };
    let services = Services {
        actors: ActorsGrpc::new(
            store.clone(),
            registry.clone(),
            clock,
            heavy,
            actor_limits(&config.limits),
            erasure.clone(),
        ),
        sessions: SessionsGrpc::new(sessions.clone(), audit.clone()),
        capture: CaptureGrpc::new(
            registry.clone(),
            store.clone(),
            clock,
            audit.clone(),
            takes.clone(),
        ),
        curves: CurvesGrpc::new(registry.clone(), store.clone(), clock, takes.replays()),
        takes: TakesGrpc::new(
            takes.clone(),
            TakeExports::new(
                ground.threads,
                takes.clone(),
                store.clone(),
                count(config.limits.exports),
            ),
            audit.clone(),
        ),
        server: ServerGrpc::new(clock, protection, phases.clone()),
        max_message_bytes: config.limits.message_bytes(),
        message_deadline: Duration::from_secs(config.transport.message_deadline_secs),
        calls: Calls::new(&config.limits),
    };
    let doors = Doors {
        services,
        metrics: metrics.clone(),
        readiness: readiness.clone(),
        large_bodies: LargeBodies::default(),
    };
    let access = access(&config, audit.clone(), metrics.clone())?;
    let guard = Guard::new(&config, tls.clone());
    let (router, health) = door::router(doors, guard, access.clone()).await?;

    let drained = CancellationToken::new();
    let upkeep = TaskTracker::new();
    upkeep.spawn(ground.audit_log.run(audited, drained.clone()));
    let keeper = Keeper {
        store,
        registry: registry.clone(),
        clock,
    };
    upkeep.spawn(keeper.run(kept, drained.clone()));
    let recorder = takes.recorder().clone();
    if let Some(why) = &rescue {
        let n_takes = takes.list_by_files().await?;
        tracing::error!(
            why,
            n_takes,
            "RESCUE: nothing is changed, the takes that were found are shown"
        );
    } else {
        let retention = Retention {
            erasure,
            takes: config.retention.takes(),
        };
        start_recorder(&takes, retention, &upkeep, &drained).await?;
        restore(&sessions).await?;
        let kept = Duration::from_hours(config.session_retention_hours);
        upkeep.spawn(keeper::collect(sessions, kept, drained.clone()));
    }
    upkeep.spawn(door::report_disk(health.clone(), readiness.clone()));

    let reload = Reload::default();
    if let Some(tls) = &tls {
        let (reloads, end) = (reload.listen(), phases.closing.clone());
        let follow = (tls.clone()).follow(reloads, metrics.clone(), audit.clone(), end);
        upkeep.spawn(follow);
    }
    let (reloads, end) = (reload.listen(), phases.closing.clone());
    upkeep.spawn(access::follow(access, reloads, end));
    let connections = TaskTracker::new();
    let accepting = Listener {
        incoming,
        router,
        tls: tls.clone(),
        metrics: metrics.clone(),
        audit: audit.clone(),
        phases: phases.clone(),
        tasks: connections.clone(),
    };
    connections.spawn(accepting.run(config.clone()));
    let ending = Ending {
        grace: config.shutdown_grace(),
        phases,
        readiness,
        health,
        registry: registry.clone(),
        connections,
        recorder,
        upkeep,
        drained,
        metrics: metrics.clone(),
    };
    let end = tokio::spawn(async move {
        shutdown.cancelled().await;
        ending.run().await
    });
    Ok(Server {
        address,
        metrics,
        registry,
        is_tls: tls.is_some(),
        rescue,
        reload,
        end,
    })
}

async fn restore(sessions: &Sessions) -> Result<(), RunError> {
    let n_restored = sessions.restore().await?;
    if n_restored > 0 {
        tracing::info!(n_restored, "sessions go on as new runs");
    }
    Ok(())
}

/// Lets takes be recorded, and brings the last process's into order meanwhile; what was being erased is gone before.
async fn start_recorder(
    takes: &Takes,
    retention: Retention,
    upkeep: &TaskTracker,
    drained: &CancellationToken,
) -> Result<(), RunError> {
    retention.erasure.finish().await?;
    let left_over = takes.look_at_left_over().await?;
    let (recovering, stopped) = (takes.clone(), drained.clone());
    upkeep.spawn(async move {
        tokio::select! {
            () = recovering.recover(left_over) => {}
            () = stopped.cancelled() => {}
        }
    });
    upkeep.spawn(retention.run(drained.clone()));
    let recorder = takes.recorder();
    upkeep.spawn(recorder.clone().commit(drained.clone()));
    upkeep.spawn(recorder.clone().watch_disk(drained.clone()));
    Ok(())
}

fn actor_limits(limits: &Limits) -> ActorLimits {
    ActorLimits {
        package_bytes: limits.package_bytes(),
        imports: count(limits.imports),
        exports: count(limits.exports),
    }
}

fn first_figures(config: &Config, protection: Protection) -> Metrics {
    let metrics = Metrics::new(env!("CARGO_PKG_VERSION"));
    metrics.set_insecure(protection.insecure);
    metrics.set_worst_case_bytes(worst_case(config).iter().map(|it| it.bytes).sum());
    metrics.set_ready(true);
    metrics
}

fn access(config: &Config, audit: Audit, metrics: Metrics) -> Result<Access, TokenSourceError> {
    if !config.has_tokens() {
        return Ok(Access::open(&config.limits, audit, metrics));
    }
    let path = Path::new(&config.token_file);
    Access::with_tokens(path, &config.limits, audit, metrics)
}

async fn load_tls(config: &Config) -> Result<Option<Tls>, RunError> {
    if !config.tls.is_on() {
        return Ok(None);
    }
    let paths = config.tls.clone();
    let loaded = tokio::task::spawn_blocking(move || Tls::load(&paths)).await;
    Ok(Some(loaded.map_err(io::Error::other)??))
}

fn protection(config: &Config, address: SocketAddr) -> Protection {
    Protection {
        tls: config.tls.is_on(),
        tokens: config.has_tokens(),
        insecure: !address.ip().is_loopback() && !config.is_protected(),
    }
}

fn session_limits(limits: &Limits) -> SessionLimits {
    const MIB: u64 = 1024 * 1024;
    SessionLimits {
        sessions: count(limits.sessions),
        subscribers_per_session: count(limits.subscribers_per_session),
        subscribers: count(limits.subscribers),
        waiting_frames: count(limits.waiting_frames),
        waiting_bytes: count(limits.waiting_mib.saturating_mul(MIB)),
        live_rate_hz: limits.frame_rate_hz as f64,
        window_bytes: count(limits.window_mib.saturating_mul(MIB)),
        buffer_bytes: count(limits.session_memory_mib.saturating_mul(MIB)),
        ..SessionLimits::default()
    }
}

fn count(n: u64) -> usize {
    usize::try_from(n).unwrap_or(usize::MAX)
}
