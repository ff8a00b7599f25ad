//! The server's configuration: one value, complete and checked before any port is bound.
//!
//! Defaults, then the file, then the environment, then flags ([`layers`]); unknown keys are refused by name.
//! `deploy/frontalis.toml` says what each key does, its unit and its default.

mod error;
mod http;
pub mod layers;
mod memory;
mod ranges;
mod tls;

use std::{net::SocketAddr, path::PathBuf, time::Duration};

use serde::{Deserialize, Serialize};

pub use error::ConfigError;
pub use http::{Http, Origin};
pub use memory::{
    LARGE_BODIES, LARGE_BODY_BYTES, MemoryItem, RESOLVES, SMALL_MESSAGE_BYTES, TAKE_EXPORTS,
    worst_case,
};
use ranges::ranges;
pub use tls::Tls;

const KIB: u64 = 1024;
const MIB: u64 = 1024 * KIB;

/// In place of a directory: everything is kept in memory and gone with the process.
pub const IN_MEMORY: &str = ":memory:";

/// Everything that can be chosen about a server.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Config {
    /// Address of the one port.
    pub listen: SocketAddr,
    /// Where actors and sessions are kept, or [`IN_MEMORY`].
    pub data_dir: String,
    /// Accept a bind other than loopback although TLS or tokens are missing.
    pub allow_insecure: bool,
    /// File of the tokens that callers must present; empty: callers are not asked who they are.
    pub token_file: String,
    /// Filter of the log, as `tracing_subscriber::EnvFilter` reads it.
    pub log: String,
    /// How long a drain may take before what is still open is cut, seconds.
    pub shutdown_grace_secs: u64,
    /// The worst case computed from the limits must stay below this, MiB.
    pub memory_budget_mib: u64,
    /// Threads for imports, exports and loading actors.
    pub workers: u64,
    /// How long ended and never used sessions are kept, hours.
    pub session_retention_hours: u64,
    /// How long recordings are kept.
    pub retention: Retention,
    /// What is refused beyond which number.
    pub limits: Limits,
    /// Buffers and deadlines of connections.
    pub transport: Transport,
    /// Certificates.
    pub tls: Tls,
    /// What browsers may do.
    pub http: Http,
}

/// How long personal data are kept, by class (CONTRACTS S-13).
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Retention {
    /// Days after its end that a take is erased; 0: never.
    pub takes_days: u64,
}

impl Retention {
    /// How long takes are kept; `None`: until somebody erases them.
    pub fn takes(&self) -> Option<Duration> {
        (self.takes_days > 0).then(|| Duration::from_hours(self.takes_days.saturating_mul(24)))
    }
}

/// Limits of what clients may make the server hold (CONTRACTS O-1, D-18).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Limits {
    /// Open connections.
    pub connections: u64,
    /// Open connections of one address.
    pub connections_per_peer: u64,
    /// Open streams of one connection.
    pub streams_per_connection: u32,
    /// Calls in progress, of all connections.
    pub calls: u64,
    /// Calls in progress that publish.
    pub publishers: u64,
    /// Sessions that have not ended.
    pub sessions: u64,
    /// Subscribers of one session.
    pub subscribers_per_session: u64,
    /// Subscribers of all sessions.
    pub subscribers: u64,
    /// Frames that wait for their solve, one session.
    pub waiting_frames: u64,
    /// Bytes of those frames, MiB.
    pub waiting_mib: u64,
    /// Samples kept for subscribers who come back, one session, MiB.
    pub window_mib: u64,
    /// Waiting frames and windows of all sessions, MiB.
    pub session_memory_mib: u64,
    /// Frames a second that a live publisher may send.
    pub frame_rate_hz: u64,
    /// Largest message of a publisher, KiB.
    pub message_kib: u64,
    /// Largest actor package, MiB.
    pub package_mib: u64,
    /// Imports at once.
    pub imports: u64,
    /// Exports at once.
    pub exports: u64,
    /// Actors that stay loaded besides those in use.
    pub cached_actors: u64,
    /// Proofs that prove nothing, of one address and of one token, in a minute.
    pub auth_failures_per_minute: u32,
    /// Sessions that one publisher's token may create in a minute.
    pub session_creations_per_minute: u32,
}

/// Buffers and deadlines of connections (CONTRACTS D-20, D-25, S-9).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Transport {
    /// Time between HTTP/2 pings, seconds.
    pub keepalive_interval_secs: u64,
    /// A peer that does not answer a ping for so long is gone, seconds.
    pub keepalive_timeout_secs: u64,
    /// Time for a TLS handshake, seconds.
    pub handshake_deadline_secs: u64,
    /// Time for the HTTP/2 preface or the HTTP/1 headers to arrive, seconds.
    pub header_deadline_secs: u64,
    /// Time for a gRPC message that has begun to be complete, seconds.
    pub message_deadline_secs: u64,
    /// What a peer may send ahead on one stream, KiB.
    pub stream_window_kib: u64,
    /// What a peer may send ahead on one connection, KiB.
    pub connection_window_kib: u64,
    /// What is buffered for one stream before its writer waits, KiB.
    pub send_buffer_kib: u64,
    /// The system's send buffer of one connection, KiB.
    pub socket_send_buffer_kib: u64,
    /// Headers of one request, KiB.
    pub header_list_kib: u64,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            listen: SocketAddr::from(([127, 0, 0, 1], 7400)),
            data_dir: "frontalis-data".to_owned(),
            allow_insecure: false,
            token_file: String::new(),
            log: "info".to_owned(),
            shutdown_grace_secs: 5,
            memory_budget_mib: 12_288,
            workers: 2,
            session_retention_hours: 24,
            retention: Retention::default(),
            limits: Limits::default(),
            transport: Transport::default(),
            tls: Tls::default(),
            http: Http::default(),
        }
    }
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            connections: 2_048,
            connections_per_peer: 1_024,
            streams_per_connection: 256,
            calls: 8_192,
            publishers: 1_024,
            sessions: 512,
            subscribers_per_session: 1_024,
            subscribers: 4_096,
            waiting_frames: 512,
            waiting_mib: 16,
            window_mib: 16,
            session_memory_mib: 4_096,
            frame_rate_hz: 250,
            message_kib: 1_024,
            package_mib: 64,
            imports: 2,
            exports: 2,
            cached_actors: 16,
            auth_failures_per_minute: 10,
            session_creations_per_minute: 30,
        }
    }
}

impl Default for Transport {
    fn default() -> Self {
        Self {
            keepalive_interval_secs: 5,
            keepalive_timeout_secs: 10,
            handshake_deadline_secs: 5,
            header_deadline_secs: 5,
            message_deadline_secs: 10,
            stream_window_kib: 64,
            connection_window_kib: 256,
            send_buffer_kib: 32,
            socket_send_buffer_kib: 128,
            header_list_kib: 16,
        }
    }
}

impl Config {
    /// Checks every value and the worst-case memory.
    ///
    /// # Errors
    ///
    /// The first value that is refused, by its key.
    pub fn validate(&self) -> Result<(), ConfigError> {
        for (key, found, least, most) in ranges(self) {
            if found < least || found > most {
                return Err(ConfigError::Range {
                    key,
                    found,
                    least,
                    most,
                });
            }
        }
        self.tls.validate()?;
        self.http.validate()?;
        if self.is_exposed() && !self.is_protected() && !self.allow_insecure {
            return Err(ConfigError::Insecure {
                listen: self.listen,
                missing: self.missing_protection(),
            });
        }
        let needed = worst_case(self)
            .iter()
            .map(|it| it.bytes)
            .fold(0, u64::saturating_add);
        if needed > self.memory_budget_mib.saturating_mul(MIB) {
            return Err(ConfigError::Memory {
                needed_mib: needed / MIB,
                budget_mib: self.memory_budget_mib,
            });
        }
        Ok(())
    }

    /// Whether others than this machine can reach the port.
    pub fn is_exposed(&self) -> bool {
        !self.listen.ip().is_loopback()
    }

    /// Whether nobody reads along and everybody says who they are.
    pub fn is_protected(&self) -> bool {
        self.tls.is_on() && self.has_tokens()
    }

    /// Whether callers are asked who they are.
    pub fn has_tokens(&self) -> bool {
        !self.token_file.is_empty()
    }

    /// What [`Config::is_protected`] misses, in words; empty: nothing.
    pub fn missing_protection(&self) -> &'static str {
        match (self.tls.is_on(), self.has_tokens()) {
            (false, false) => "neither TLS nor tokens",
            (false, true) => "no TLS",
            (true, false) => "no tokens",
            (true, true) => "",
        }
    }

    /// The data directory, or none to keep everything in memory.
    pub fn directory(&self) -> Option<PathBuf> {
        (self.data_dir != IN_MEMORY).then(|| PathBuf::from(&self.data_dir))
    }

    /// How long a drain may take.
    pub fn shutdown_grace(&self) -> Duration {
        Duration::from_secs(self.shutdown_grace_secs)
    }

    /// The configuration as a file would say it.
    ///
    /// # Panics
    ///
    /// Never: every field has a TOML form.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("invariant: every field has a TOML form")
    }
}

impl Limits {
    /// Largest message of a publisher, bytes.
    pub fn message_bytes(&self) -> usize {
        bytes(self.message_kib, KIB)
    }

    /// Largest actor package, bytes.
    pub fn package_bytes(&self) -> usize {
        bytes(self.package_mib, MIB)
    }
}

/// A number of units as bytes, saturating.
fn bytes(count: u64, unit: u64) -> usize {
    usize::try_from(count.saturating_mul(unit)).unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_of_connections_are_those_of_the_contract() {
        let (limits, transport) = (Limits::default(), Transport::default());
        // O-1.
        assert_eq!(
            (limits.connections, limits.connections_per_peer),
            (2_048, 1_024)
        );
        assert_eq!(limits.streams_per_connection, 256);
        // D-25: a vanished peer is found within 15 s.
        assert_eq!(transport.keepalive_interval_secs, 5);
        assert_eq!(transport.keepalive_timeout_secs, 10);
        // S-9.
        assert_eq!(transport.handshake_deadline_secs, 5);
        assert_eq!(transport.header_deadline_secs, 5);
        assert_eq!(transport.header_list_kib, 16);
    }

    #[test]
    fn the_defaults_are_accepted() {
        Config::default().validate().unwrap();
    }

    #[test]
    fn an_address_that_others_can_reach_needs_tls_and_tokens_or_allow_insecure() {
        let exposed = Config {
            listen: "0.0.0.0:7400".parse().unwrap(),
            ..Config::default()
        };
        let tls = Tls {
            cert: "cert.pem".to_owned(),
            key: "key.pem".to_owned(),
            ..Tls::default()
        };
        let (with_tls, with_tokens) = (
            Config {
                tls: tls.clone(),
                ..exposed.clone()
            },
            Config {
                token_file: "tokens.toml".to_owned(),
                ..exposed.clone()
            },
        );
        for (config, missing) in [
            (&exposed, "neither TLS nor tokens"),
            (&with_tls, "no tokens"),
            (&with_tokens, "no TLS"),
        ] {
            let message = config.validate().unwrap_err().to_string();
            assert!(message.contains(missing), "{message}");
            let mut accepted = config.clone();
            accepted.allow_insecure = true;
            accepted.validate().unwrap();
        }
        Config { tls, ..with_tokens }.validate().unwrap();
    }

    #[test]
    fn limits_above_the_budget_are_refused_with_both_figures() {
        let config = Config {
            memory_budget_mib: 1_024,
            ..Config::default()
        };
        let message = config.validate().unwrap_err().to_string();
        assert!(message.contains("memory_budget_mib is 1024"), "{message}");
    }

    #[test]
    fn a_value_out_of_range_is_named() {
        let mut config = Config::default();
        config.limits.sessions = 0;
        let message = config.validate().unwrap_err().to_string();
        assert_eq!(message, "limits.sessions is 0, it must be within 1..=65536");
    }

    #[test]
    fn the_printed_form_reads_back_as_the_same_configuration() {
        let config = Config::default();
        let back: Config = toml::from_str(&config.to_toml()).unwrap();
        assert_eq!(back, config);
    }
}
