//! What every number of the configuration may be.

use super::{Config, Limits, Transport};

/// Key, value, least and most.
type Range = (&'static str, u64, u64, u64);

/// Every number.
pub(super) fn ranges(config: &Config) -> Vec<Range> {
    let mut all = general(config);
    all.extend(limits(&config.limits));
    all.extend(transport(&config.transport));
    all
}

fn general(config: &Config) -> Vec<Range> {
    vec![
        ("shutdown_grace_secs", config.shutdown_grace_secs, 1, 300),
        ("memory_budget_mib", config.memory_budget_mib, 64, 1 << 24),
        ("workers", config.workers, 1, 256),
        (
            "session_retention_hours",
            config.session_retention_hours,
            1,
            8_760,
        ),
        (
            "retention.takes_days",
            config.retention.takes_days,
            0,
            36_500,
        ),
    ]
}

fn limits(l: &Limits) -> Vec<Range> {
    vec![
        ("limits.connections", l.connections, 1, 65_536),
        (
            "limits.connections_per_peer",
            l.connections_per_peer,
            1,
            65_536,
        ),
        (
            "limits.streams_per_connection",
            l.streams_per_connection.into(),
            1,
            65_536,
        ),
        ("limits.sessions", l.sessions, 1, 65_536),
        (
            "limits.subscribers_per_session",
            l.subscribers_per_session,
            1,
            65_536,
        ),
        ("limits.subscribers", l.subscribers, 1, 1 << 20),
        ("limits.waiting_frames", l.waiting_frames, 1, 65_536),
        ("limits.waiting_mib", l.waiting_mib, 1, 1_024),
        ("limits.window_mib", l.window_mib, 1, 1_024),
        (
            "limits.session_memory_mib",
            l.session_memory_mib,
            1,
            1 << 20,
        ),
        ("limits.frame_rate_hz", l.frame_rate_hz, 1, 10_000),
        // A frame of 1,024 markers is 12 KiB; the largest message must take a whole package chunk.
        ("limits.message_kib", l.message_kib, 64, 16_384),
        ("limits.package_mib", l.package_mib, 1, 1_024),
        ("limits.imports", l.imports, 1, 64),
        ("limits.exports", l.exports, 1, 64),
        ("limits.calls", l.calls, 1, 1 << 20),
        ("limits.publishers", l.publishers, 1, 65_536),
        ("limits.cached_actors", l.cached_actors, 1, 4_096),
        (
            "limits.auth_failures_per_minute",
            l.auth_failures_per_minute.into(),
            1,
            60_000,
        ),
        (
            "limits.session_creations_per_minute",
            l.session_creations_per_minute.into(),
            1,
            60_000,
        ),
    ]
}

fn transport(t: &Transport) -> Vec<Range> {
    vec![
        (
            "transport.keepalive_interval_secs",
            t.keepalive_interval_secs,
            1,
            3_600,
        ),
        (
            "transport.keepalive_timeout_secs",
            t.keepalive_timeout_secs,
            1,
            3_600,
        ),
        (
            "transport.handshake_deadline_secs",
            t.handshake_deadline_secs,
            1,
            60,
        ),
        (
            "transport.header_deadline_secs",
            t.header_deadline_secs,
            1,
            60,
        ),
        (
            "transport.message_deadline_secs",
            t.message_deadline_secs,
            1,
            600,
        ),
        (
            "transport.stream_window_kib",
            t.stream_window_kib,
            16,
            16_384,
        ),
        (
            "transport.connection_window_kib",
            t.connection_window_kib,
            64,
            65_536,
        ),
        ("transport.send_buffer_kib", t.send_buffer_kib, 4, 16_384),
        (
            "transport.socket_send_buffer_kib",
            t.socket_send_buffer_kib,
            4,
            16_384,
        ),
        ("transport.header_list_kib", t.header_list_kib, 4, 1_024),
    ]
}
