//! Figures of one server, as Prometheus reads them, and the set-up of its log.
//!
//! Each server has its own registry, so that two servers in one process do not add up.
//! No label holds a client's text: labels are words of this file (CONTRACTS S-14).

use std::{
    io::IsTerminal as _,
    sync::{
        Arc,
        atomic::{AtomicI64, AtomicU64, Ordering},
    },
};

use prometheus_client::{
    encoding::{EncodeLabelSet, text::encode},
    metrics::{counter::Counter, family::Family, gauge::Gauge, info::Info},
    registry::{Registry, Unit},
};

/// Counters and gauges; cheap to clone, clones share all of it.
#[derive(Clone, Debug)]
pub struct Metrics(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    registry: Registry,
    connections: Gauge,
    connections_accepted: Counter,
    connections_refused: Family<RefusedLabel, Counter>,
    accept_failures: Counter,
    floods: Family<FloodLabel, Counter>,
    handshake_failures: Family<HandshakeLabel, Counter>,
    certificate_reloads: Family<ReloadLabel, Counter>,
    authentication_failures: Counter,
    token_reloads: Family<ReloadLabel, Counter>,
    requests: Family<ProtocolLabel, Counter>,
    panics: Counter,
    calls: Gauge,
    sessions: Family<SessionLabel, Gauge>,
    frames: Family<FramesLabel, Gauge<i64, AtomicI64>>,
    subscribers: Gauge,
    subscriber_samples: Family<SamplesLabel, Gauge<i64, AtomicI64>>,
    latencies: Family<LatencyLabel, Gauge<f64, AtomicU64>>,
    ready: Gauge,
    ready_to_record: Gauge,
    insecure: Gauge,
    worst_case_bytes: Gauge<u64, AtomicU64>,
}

/// Which limit refused a connection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConnectionLimit {
    /// `limits.connections`.
    Connections,
    /// `limits.connections_per_peer`.
    ConnectionsPerPeer,
}

/// Why a TLS handshake came to nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HandshakeFailure {
    /// It took too long.
    Stalled,
    /// The client's certificate is not believed.
    Certificate,
    /// It was no TLS, or none that is spoken here.
    Protocol,
}

/// How a request was spoken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Protocol {
    /// gRPC.
    Grpc,
    /// gRPC-web.
    GrpcWeb,
    /// A WebSocket.
    WebSocket,
    /// Server-sent events.
    Sse,
    /// Plain HTTP.
    Http,
}

impl ConnectionLimit {
    fn name(self) -> &'static str {
        match self {
            Self::Connections => "connections",
            Self::ConnectionsPerPeer => "connections_per_peer",
        }
    }
}

impl HandshakeFailure {
    fn name(self) -> &'static str {
        match self {
            Self::Stalled => "stalled",
            Self::Certificate => "certificate",
            Self::Protocol => "protocol",
        }
    }
}

impl Protocol {
    fn name(self) -> &'static str {
        match self {
            Self::Grpc => "grpc",
            Self::GrpcWeb => "grpc-web",
            Self::WebSocket => "websocket",
            Self::Sse => "sse",
            Self::Http => "http",
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct RefusedLabel {
    limit: &'static str,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct FloodLabel {
    frames: &'static str,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct HandshakeLabel {
    why: &'static str,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct ReloadLabel {
    taken: &'static str,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct ProtocolLabel {
    protocol: &'static str,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct SessionLabel {
    state: &'static str,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct FramesLabel {
    what: &'static str,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct SamplesLabel {
    what: &'static str,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct LatencyLabel {
    stage: &'static str,
    quantile: &'static str,
}

/// Figures of the sessions that are listed, taken when somebody asks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SessionFigures {
    /// How many are in each state.
    pub states: Vec<(&'static str, u64)>,
    /// Frames received, rejected, shed, missing.
    pub frames: Vec<(&'static str, u64)>,
    /// Subscribers of all of them.
    pub subscribers: u64,
    /// Samples sent and skipped.
    pub samples: Vec<(&'static str, u64)>,
    /// Stage, quantile, and the slowest session's time at it, microseconds.
    pub latencies: Vec<(&'static str, &'static str, f64)>,
}

impl Metrics {
    /// Registers every figure of one server.
    pub fn new(version: &'static str) -> Self {
        let mut registry = Registry::with_prefix("frontalis");
        let info = Info::new([("version", version)]);
        registry.register("build", "Which server this is", info);
        let mut inner = Inner {
            registry,
            connections: Gauge::default(),
            connections_accepted: Counter::default(),
            connections_refused: Family::default(),
            accept_failures: Counter::default(),
            floods: Family::default(),
            handshake_failures: Family::default(),
            certificate_reloads: Family::default(),
            authentication_failures: Counter::default(),
            token_reloads: Family::default(),
            requests: Family::default(),
            panics: Counter::default(),
            calls: Gauge::default(),
            sessions: Family::default(),
            frames: Family::default(),
            subscribers: Gauge::default(),
            subscriber_samples: Family::default(),
            latencies: Family::default(),
            ready: Gauge::default(),
            ready_to_record: Gauge::default(),
            insecure: Gauge::default(),
            worst_case_bytes: Gauge::default(),
        };
        inner.register();
        Self(Arc::new(inner))
    }

    /// A connection was accepted.
    pub fn connection_opened(&self) {
        self.0.connections_accepted.inc();
        self.0.connections.inc();
    }

    /// A connection is gone.
    pub fn connection_closed(&self) {
        self.0.connections.dec();
    }

    /// A connection was refused.
    pub fn connection_refused(&self, limit: ConnectionLimit) {
        self.0
            .connections_refused
            .get_or_create(&RefusedLabel {
                limit: limit.name(),
            })
            .inc();
    }

    /// The system could not hand over a connection.
    pub fn accept_failed(&self) {
        self.0.accept_failures.inc();
    }

    /// A connection was closed for too many frames of a kind.
    pub fn connection_flooded(&self, frames: &'static str) {
        self.0.floods.get_or_create(&FloodLabel { frames }).inc();
    }

    /// A TLS handshake came to nothing.
    pub fn handshake_failed(&self, why: HandshakeFailure) {
        let label = HandshakeLabel { why: why.name() };
        self.0.handshake_failures.get_or_create(&label).inc();
    }

    /// The certificates were read again, and taken or not.
    pub fn certificates_reloaded(&self, taken: bool) {
        let taken = if taken { "yes" } else { "no" };
        self.0
            .certificate_reloads
            .get_or_create(&ReloadLabel { taken })
            .inc();
    }

    /// A proof of identity proved nothing.
    pub fn authentication_failed(&self) {
        self.0.authentication_failures.inc();
    }

    /// The token file was read again, and taken or not.
    pub fn tokens_reloaded(&self, taken: bool) {
        let taken = if taken { "yes" } else { "no" };
        self.0
            .token_reloads
            .get_or_create(&ReloadLabel { taken })
            .inc();
    }

    /// A request came in.
    pub fn request(&self, protocol: Protocol) {
        self.0
            .requests
            .get_or_create(&ProtocolLabel {
                protocol: protocol.name(),
            })
            .inc();
    }

    /// A handler panicked.
    pub fn panicked(&self) {
        self.0.panics.inc();
    }

    /// Calls in progress.
    pub fn set_calls(&self, in_progress: usize) {
        self.0.calls.set(clamped(in_progress as u64));
    }

    /// Whether new sessions are accepted.
    pub fn set_ready(&self, ready: bool) {
        self.0.ready.set(ready.into());
    }

    /// Whether new takes may start.
    pub fn set_ready_to_record(&self, ready: bool) {
        self.0.ready_to_record.set(ready.into());
    }

    /// Whether others can reach the port without protection.
    pub fn set_insecure(&self, insecure: bool) {
        self.0.insecure.set(insecure.into());
    }

    /// As [`Metrics::set_insecure`] was told.
    pub fn is_insecure(&self) -> bool {
        self.0.insecure.get() != 0
    }

    /// The worst case computed from the limits.
    pub fn set_worst_case_bytes(&self, bytes: u64) {
        self.0.worst_case_bytes.set(bytes);
    }

    /// Takes over the figures of the sessions.
    pub fn set_sessions(&self, figures: &SessionFigures) {
        for &(state, count) in &figures.states {
            self.0
                .sessions
                .get_or_create(&SessionLabel { state })
                .set(clamped(count));
        }
        for &(what, count) in &figures.frames {
            self.0
                .frames
                .get_or_create(&FramesLabel { what })
                .set(clamped(count));
        }
        for &(what, count) in &figures.samples {
            self.0
                .subscriber_samples
                .get_or_create(&SamplesLabel { what })
                .set(clamped(count));
        }
        for &(stage, quantile, micros) in &figures.latencies {
            let label = LatencyLabel { stage, quantile };
            self.0.latencies.get_or_create(&label).set(micros);
        }
        self.0.subscribers.set(clamped(figures.subscribers));
    }

    /// Connections that are open.
    pub fn open_connections(&self) -> u64 {
        self.0.connections.get().unsigned_abs()
    }

    /// Handlers that panicked so far.
    pub fn panics(&self) -> u64 {
        self.0.panics.inner().load(Ordering::Relaxed)
    }

    /// Every figure in the `OpenMetrics` text format.
    ///
    /// # Panics
    ///
    /// Never: writing to a string does not fail.
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        encode(&mut text, &self.0.registry).expect("invariant: writing to a string does not fail");
        text
    }
}

impl Inner {
    fn register(&mut self) {
        let it = &mut self.registry;
        it.register("connections", "Open connections", self.connections.clone());
        it.register(
            "connections_accepted",
            "Connections accepted since the start",
            self.connections_accepted.clone(),
        );
        it.register(
            "connections_refused",
            "Connections closed at once, by the limit that refused them",
            self.connections_refused.clone(),
        );
        it.register(
            "accept_failures",
            "Connections that the system could not hand over",
            self.accept_failures.clone(),
        );
        it.register(
            "connections_flooded",
            "Connections closed for too many HTTP/2 control frames, by their kind",
            self.floods.clone(),
        );
        it.register(
            "tls_handshake_failures",
            "TLS handshakes that came to nothing, by why",
            self.handshake_failures.clone(),
        );
        it.register(
            "tls_certificate_reloads",
            "Certificates that were read again, by whether they were taken",
            self.certificate_reloads.clone(),
        );
        it.register(
            "authentication_failures",
            "Proofs of identity that proved nothing",
            self.authentication_failures.clone(),
        );
        it.register(
            "token_file_reloads",
            "Token files that were read again, by whether they were taken",
            self.token_reloads.clone(),
        );
        it.register(
            "requests",
            "Requests since the start",
            self.requests.clone(),
        );
        it.register(
            "calls",
            "Calls in progress, of every door",
            self.calls.clone(),
        );
        it.register("panics", "Handlers that panicked", self.panics.clone());
        it.register(
            "sessions",
            "Listed sessions by state",
            self.sessions.clone(),
        );
        it.register(
            "session_frames",
            "Frames of the listed sessions by what became of them",
            self.frames.clone(),
        );
        it.register(
            "subscribers",
            "Subscribers of all sessions",
            self.subscribers.clone(),
        );
        it.register(
            "subscriber_samples",
            "Samples of the present subscribers by what became of them",
            self.subscriber_samples.clone(),
        );
        it.register(
            "stage_latency_micros",
            "Time in each stage of the slowest session, over its last thousand samples",
            self.latencies.clone(),
        );
        it.register("ready", "1: new sessions are accepted", self.ready.clone());
        it.register(
            "ready_to_record",
            "1: new takes may start",
            self.ready_to_record.clone(),
        );
        it.register(
            "insecure",
            "1: others can reach the port, without TLS or without tokens",
            self.insecure.clone(),
        );
        it.register_with_unit(
            "memory_worst_case",
            "What the limits allow clients to make the server hold",
            Unit::Bytes,
            self.worst_case_bytes.clone(),
        );
    }
}

fn clamped(count: u64) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}

/// Sends the log to standard error, as `filter` says. Client text in it has its control characters escaped.
///
/// # Errors
///
/// When the filter cannot be read, or the process has a log already.
pub fn start_log(filter: &str) -> Result<(), LogError> {
    let filter = tracing_subscriber::EnvFilter::builder()
        .parse(filter)
        .map_err(|error| LogError::Filter(error.to_string()))?;
    tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(std::io::stderr)
        .with_ansi(std::io::stderr().is_terminal())
        .try_init()
        .map_err(|error| LogError::Set(error.to_string()))
}

/// Why there is no log.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The filter cannot be read.
    #[error("the log filter cannot be read: {0}")]
    Filter(String),
    /// The process has one already.
    #[error("the log cannot be set up: {0}")]
    Set(String),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_appear_in_the_text_and_servers_do_not_share_them() {
        let (one, other) = (Metrics::new("1"), Metrics::new("1"));
        one.connection_opened();
        one.request(Protocol::Grpc);
        one.set_sessions(&SessionFigures {
            states: vec![("live", 3)],
            ..SessionFigures::default()
        });
        let text = one.to_text();
        assert!(text.contains("frontalis_connections 1\n"), "{text}");
        assert!(
            text.contains("frontalis_requests_total{protocol=\"grpc\"} 1\n"),
            "{text}"
        );
        assert!(
            text.contains("frontalis_sessions{state=\"live\"} 3\n"),
            "{text}"
        );
        assert!(other.to_text().contains("frontalis_connections 0\n"));
    }
}
