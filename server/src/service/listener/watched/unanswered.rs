//! Whether a peer's machine owes an answer, from what Linux counts for each connection (`TCP_INFO`).
//!
//! The only file of the workspace with unsafe code, and none of it is written here: nix's macro makes the option out of a
//! struct (`docs/decisions/0009`). It is sound because every bit pattern is a value of [`Unanswered`], and nix checks that
//! the system has filled all of it.

use std::io;

use tokio::net::TcpStream;

/// The first bytes of Linux's `struct tcp_info`, which has only ever grown at its end.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
struct Unanswered {
    _state: u8,
    _congestion_state: u8,
    /// Of what was sent, until it is taken.
    n_retransmits: u8,
    /// Of a closed window, or of a silent connection, since the last acknowledgement.
    n_probes: u8,
    _backoff_options_scales_flags: [u8; 4],
    _timeouts_sizes_counts: [u32; 9],
    /// Since data was sent, for the first time or again.
    last_data_sent_ms: u32,
    _last_ack_sent_ms: u32,
    _last_data_received_ms: u32,
    /// Since the last acknowledgement.
    last_ack_received_ms: u32,
}

#[derive(Clone, Copy, Debug)]
struct TcpInfo;

nix::getsockopt_impl!(
    TcpInfo,
    libc::IPPROTO_TCP,
    libc::TCP_INFO,
    Unanswered,
    nix::sys::socket::sockopt::GetStruct<Unanswered>
);

/// Whether the system has sent something again, or asked a closed window, and heard nothing since.
pub(super) fn is_unanswered(stream: &TcpStream) -> io::Result<bool> {
    let info = nix::sys::socket::getsockopt(stream, TcpInfo)?;
    // A machine whose window is closed acknowledges what is sent again, but does not take it: the count goes on.
    let is_later_ack = info.last_ack_received_ms <= info.last_data_sent_ms;
    Ok(info.n_probes > 0 || info.n_retransmits > 0 && !is_later_ack)
}
