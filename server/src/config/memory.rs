//! The most memory that clients can make the server hold, added up from its limits (CONTRACTS O-2).
//!
//! The figures are upper bounds by purpose: each says what would be held if every limit were reached at once.

use super::{Config, KIB, MIB};
use crate::session::PRE_ROLL_BYTES;

/// A package of one import is held as uploaded, inflated, and as an actor.
const IMPORT_COPIES: u64 = 4;

/// An actor in memory: a face of 50,000 vertices with 60 muscles in f64 takes 72 MB.
const ACTOR_BYTES: u64 = 72 * MIB;

/// Beside its buffers, a subscriber of every frame may hold so much (CONTRACTS D-20).
const SUBSCRIBER_BYTES: u64 = 256 * KIB;

/// Buffers of one TLS connection: a record of 16 KiB each way, what is deciphered of one, and the keys.
const TLS_KIB: u64 = 56;

/// Largest message of a call that does not publish, bytes.
pub const SMALL_MESSAGE_BYTES: usize = 64 * 1024;

/// Largest body of an HTTP call with JSON, bytes (BAD_INPUT D12).
pub const LARGE_BODY_BYTES: usize = 1024 * 1024;

/// So many bodies may be larger than [`SMALL_MESSAGE_BYTES`] at once.
pub const LARGE_BODIES: usize = 64;

/// A large body is held as bytes and as the message that was read of it.
const BODY_COPIES: u64 = 2;

/// A package on its way out is held as stored, gathered, and converted.
const EXPORT_COPIES: u64 = 3;

/// Takes that are exported at once, of all callers together.
pub const TAKE_EXPORTS: usize = 8;

/// One of them: a batch of messages and their decompressed chunk, the keys of an animation, and the mesh that moves.
const TAKE_EXPORT_BYTES: u64 = 160 * MIB;

/// Program, database cache, runtime.
const FIXED_BYTES: u64 = 128 * MIB;

/// Takes that are solved again at once.
pub const RESOLVES: usize = 2;

/// Each holds three revisions of its actor, and of its file what was read and what is to be written.
const RESOLVE_BYTES: u64 = 3 * ACTOR_BYTES + 2 * 64 * MIB;

/// One line of the sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryItem {
    /// What holds it.
    pub what: &'static str,
    /// How much at most, bytes.
    pub bytes: u64,
}

/// The worst case, item by item.
pub fn worst_case(config: &Config) -> Vec<MemoryItem> {
    let (limits, transport) = (&config.limits, &config.transport);
    let product = |a: u64, b: u64| a.saturating_mul(b);
    let per_session = product(limits.waiting_mib.saturating_add(limits.window_mib), MIB)
        .saturating_add(PRE_ROLL_BYTES as u64);
    let sessions =
        product(limits.sessions, per_session).min(product(limits.session_memory_mib, MIB));
    let per_connection = transport
        .connection_window_kib
        .saturating_add(transport.header_list_kib)
        .saturating_add(transport.send_buffer_kib)
        .saturating_add(if config.tls.is_on() { TLS_KIB } else { 0 });
    // Every call is in the middle of its largest message.
    let messages = product(limits.publishers, product(limits.message_kib, KIB))
        .saturating_add(product(limits.calls, SMALL_MESSAGE_BYTES as u64));
    let imports = product(
        product(limits.imports, limits.package_mib),
        IMPORT_COPIES * MIB,
    );
    let per_export = product(limits.package_mib, EXPORT_COPIES * MIB).saturating_add(ACTOR_BYTES);
    let bodies = product(LARGE_BODIES as u64, BODY_COPIES * LARGE_BODY_BYTES as u64);
    let resolves = product(RESOLVES as u64, RESOLVE_BYTES);
    vec![
        item("waiting frames and windows of all sessions", sessions),
        item("messages on their way in", messages),
        item("subscribers", product(limits.subscribers, SUBSCRIBER_BYTES)),
        item(
            "connections",
            product(limits.connections, product(per_connection, KIB)),
        ),
        item("imports", imports),
        item("exports", product(limits.exports, per_export)),
        item("takes being solved again", resolves),
        item(
            "exports of takes",
            product(TAKE_EXPORTS as u64, TAKE_EXPORT_BYTES),
        ),
        item("large bodies of HTTP", bodies),
        item("loaded actors", product(limits.cached_actors, ACTOR_BYTES)),
        item("the program itself", FIXED_BYTES),
    ]
}

fn item(what: &'static str, bytes: u64) -> MemoryItem {
    MemoryItem { what, bytes }
}
