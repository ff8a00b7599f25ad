//! How long a WebSocket's peer may keep silent, take for a message, or not read; and how often it may ping.
//!
//! BAD_INPUT E13 (no pong, ping flood), F4 and F5. A subscriber of the newest sample may stop reading for as long as it
//! likes (CONTRACTS D-15): a peer that has vanished is found by its machine's silence, below this. Looked at once a
//! second, so that a message costs no timer.

use std::{
    io,
    pin::Pin,
    task::{Context, Poll},
    time::Duration,
};

use tokio::{
    io::{AsyncRead, AsyncWrite, ReadBuf},
    time::Instant,
};
use tokio_tungstenite::tungstenite::Message;
use tonic::{Code, Status};

use super::super::message::too_slow;
use crate::service::grpc::{curves::MAX_PAUSE, status::refuse};

/// How often to look.
pub(super) const TICK: Duration = Duration::from_secs(1);
/// Time between pings.
const PING_EVERY: Duration = Duration::from_secs(10);
/// A peer that says nothing for so long, not even pong, is gone.
const SILENCE: Duration = Duration::from_secs(30);
/// The part of that which it has for a pong.
const PONG_WITHIN: Duration = Duration::from_secs(20);
/// A peer that takes nothing for so long is gone. By then a stream of every frame has given it up, and says so.
const BLOCKED: Duration = MAX_PAUSE.saturating_add(TICK);
/// Time for a message that has begun to end.
const MESSAGE_DEADLINE: Duration = Duration::from_secs(10);
/// Pings and pongs of a peer in any [`CONTROL_SPAN`].
const MAX_CONTROLS: u32 = 100;
const CONTROL_SPAN: Duration = Duration::from_secs(10);
/// Header and mask of a client's control frame, bytes.
const CONTROL_FRAME_BYTES: u64 = 6;

/// What to do about a peer.
pub(super) enum Verdict {
    /// Nothing.
    Wait,
    /// Ask whether it is there.
    Ping,
    /// Tell it why, and close.
    End(Status),
    /// It takes nothing.
    Blocked,
}

/// What is known of a peer's pace.
pub(super) struct Patience {
    heard_at: Instant,
    pinged_at: Instant,
    /// When the first ping went out that nothing was heard since.
    asked_at: Option<Instant>,
    /// Bytes of whole messages, as far as they can be told apart.
    n_settled: u64,
    /// When the message that is under way was first seen.
    begun_at: Option<Instant>,
    blocked_since: Option<Instant>,
    may_pause: bool,
    controls_since: Instant,
    n_controls: u32,
}

impl Patience {
    pub(super) fn new() -> Self {
        let now = Instant::now();
        Self {
            heard_at: now,
            pinged_at: now,
            asked_at: None,
            n_settled: 0,
            begun_at: None,
            blocked_since: None,
            may_pause: false,
            controls_since: now,
            n_controls: 0,
        }
    }

    /// From now on the peer may read nothing, and so answer no ping, for any time.
    pub(super) fn allow_pauses(&mut self) {
        self.may_pause = true;
    }

    /// A message came when `n_read` bytes had been read.
    ///
    /// # Errors
    ///
    /// `PING_FLOOD`.
    pub(super) fn hear(&mut self, message: &Message, n_read: u64) -> Result<(), Status> {
        let now = Instant::now();
        self.heard(now);
        let (Message::Ping(data) | Message::Pong(data)) = message else {
            self.n_settled = n_read;
            self.begun_at = None;
            return Ok(());
        };
        // Control frames stand between the parts of a message, and do not end it.
        self.n_settled += CONTROL_FRAME_BYTES + data.len() as u64;
        if now.duration_since(self.controls_since) >= CONTROL_SPAN {
            self.controls_since = now;
            self.n_controls = 0;
        }
        self.n_controls += 1;
        if self.n_controls > MAX_CONTROLS {
            let message = format!("more than {MAX_CONTROLS} pings and pongs in 10 s");
            return Err(refuse(Code::ResourceExhausted, "PING_FLOOD", message));
        }
        Ok(())
    }

    fn heard(&mut self, now: Instant) {
        self.heard_at = now;
        self.asked_at = None;
    }

    /// The peer took the message that was on its way.
    pub(super) fn took(&mut self) {
        self.blocked_since = None;
    }

    /// Judges once a [`TICK`]. While the server itself does not read, or has nothing to write, nobody is late.
    pub(super) fn judge(&mut self, n_read: u64, is_reading: bool, is_writing: bool) -> Verdict {
        let now = Instant::now();
        let is_under_way = is_reading && n_read > self.n_settled;
        self.begun_at = is_under_way.then(|| self.begun_at.unwrap_or(now));
        self.blocked_since = is_writing.then(|| self.blocked_since.unwrap_or(now));
        if !is_reading || self.may_pause {
            self.heard(now);
        }
        if self.may_pause {
            self.blocked_since = None;
        }
        let longer = |since: Option<Instant>, limit| since.is_some_and(|it| now - it >= limit);
        if longer(self.blocked_since, BLOCKED) {
            return Verdict::Blocked;
        }
        if longer(self.begun_at, MESSAGE_DEADLINE) {
            return Verdict::End(too_slow());
        }
        // Behind what is not taken no ping comes through.
        let is_asked = !is_writing && longer(self.asked_at, PONG_WITHIN);
        if is_asked && now - self.heard_at >= SILENCE {
            let message = "no pong within 30 s";
            return Verdict::End(refuse(Code::DeadlineExceeded, "NO_PONG", message));
        }
        if !is_writing && now - self.pinged_at >= PING_EVERY {
            self.pinged_at = now;
            self.asked_at.get_or_insert(now);
            return Verdict::Ping;
        }
        Verdict::Wait
    }
}

/// A connection that counts what was read from it.
pub(super) struct Metered<S> {
    io: S,
    n_read: u64,
}

impl<S> Metered<S> {
    pub(super) fn new(io: S) -> Self {
        Self { io, n_read: 0 }
    }

    /// Bytes read so far.
    pub(super) fn n_read(&self) -> u64 {
        self.n_read
    }
}

impl<S: AsyncRead + Unpin> AsyncRead for Metered<S> {
    fn poll_read(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let this = self.get_mut();
        let before = buf.filled().len();
        let read = Pin::new(&mut this.io).poll_read(cx, buf);
        this.n_read += (buf.filled().len() - before) as u64;
        read
    }
}

impl<S: AsyncWrite + Unpin> AsyncWrite for Metered<S> {
    fn poll_write(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &[u8],
    ) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.get_mut().io).poll_write(cx, buf)
    }

    fn poll_flush(self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.get_mut().io).poll_flush(cx)
    }

    fn poll_shutdown(self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.get_mut().io).poll_shutdown(cx)
    }
}
