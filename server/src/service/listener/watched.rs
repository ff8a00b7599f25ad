//! A connection that finds out whether its peer is still there while something is on its way to it (CONTRACTS D-25).
//!
//! A peer that has vanished and one that does not read look alike to a writer. The system knows them apart: what it sends
//! again, or asks a closed window, the machine of a living peer answers, however long its program sleeps. So a connection
//! is given up only when the system's own questions stay unanswered; `TCP_USER_TIMEOUT` would end both (D-15, BAD_INPUT
//! F3, F4). Looked at once a second, more often for one of little patience. Where the system does not tell (other than
//! Linux), its retransmissions end it.

#[cfg(target_os = "linux")]
mod unanswered;

use std::{
    io,
    pin::Pin,
    task::{Context, Poll},
    time::Duration,
};

use tokio::{
    io::{AsyncRead, AsyncWrite, ReadBuf},
    net::TcpStream,
    time::{Instant, Interval, MissedTickBehavior, interval},
};

#[cfg(target_os = "linux")]
use unanswered::is_unanswered;

/// How often to look, unless that is too rare for the patience.
const TICK: Duration = Duration::from_secs(1);
/// A single look proves nothing: an answer may be on its way.
const MIN_LOOKS: u32 = 8;

/// A connection whose peer is looked after.
pub(super) struct Watched {
    stream: TcpStream,
    ticks: Interval,
    silence: Silence,
}

/// Since when questions stay unanswered, and for how long they may.
struct Silence {
    patience: Duration,
    tick: Duration,
    /// The last time that nothing was unanswered.
    answered_at: Instant,
}

impl Watched {
    /// Gives the peer `patience` to answer.
    pub(super) fn new(stream: TcpStream, patience: Duration) -> Self {
        let silence = Silence::new(patience);
        let mut ticks = interval(silence.tick);
        ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        Self {
            stream,
            ticks,
            silence,
        }
    }

    fn look(&mut self, cx: &mut Context<'_>) -> io::Result<()> {
        while self.ticks.poll_tick(cx).is_ready() {
            self.silence.hear(is_unanswered(&self.stream)?)?;
        }
        Ok(())
    }
}

impl Silence {
    fn new(patience: Duration) -> Self {
        Self {
            patience,
            tick: (patience / MIN_LOOKS).min(TICK),
            answered_at: Instant::now(),
        }
    }

    /// # Errors
    ///
    /// When the peer was silent for too long.
    fn hear(&mut self, is_unanswered: bool) -> io::Result<()> {
        let now = Instant::now();
        if !is_unanswered {
            self.answered_at = now;
        }
        // The next look would come too late.
        if now.duration_since(self.answered_at) + self.tick <= self.patience {
            return Ok(());
        }
        let message = "the peer's machine does not answer";
        Err(io::Error::new(io::ErrorKind::TimedOut, message))
    }
}

/// Where the system does not tell, nobody owes an answer.
#[cfg(not(target_os = "linux"))]
fn is_unanswered(_: &TcpStream) -> io::Result<bool> {
    Ok(false)
}

impl AsyncRead for Watched {
    fn poll_read(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let this = self.get_mut();
        this.look(cx)?;
        Pin::new(&mut this.stream).poll_read(cx, buf)
    }
}

impl AsyncWrite for Watched {
    fn poll_write(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &[u8],
    ) -> Poll<io::Result<usize>> {
        let this = self.get_mut();
        this.look(cx)?;
        Pin::new(&mut this.stream).poll_write(cx, buf)
    }

    fn poll_flush(self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.get_mut().stream).poll_flush(cx)
    }

    fn poll_shutdown(self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.get_mut().stream).poll_shutdown(cx)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_write_vectored(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        bufs: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let this = self.get_mut();
        this.look(cx)?;
        Pin::new(&mut this.stream).poll_write_vectored(cx, bufs)
    }
}

#[cfg(test)]
mod tests {
    use tokio::{io::AsyncWriteExt as _, net::TcpListener, time::timeout};

    use super::*;

    #[tokio::test(start_paused = true)]
    async fn a_peer_is_given_up_when_nothing_is_answered_for_its_patience_and_no_sooner() {
        let mut silence = Silence::new(Duration::from_secs(15));
        for _round in 0..3 {
            silence.hear(false).unwrap();
            for _second in 0..14 {
                tokio::time::advance(TICK).await;
                silence.hear(true).unwrap();
            }
        }
        tokio::time::advance(TICK).await;
        assert!(silence.hear(true).is_err());
    }

    #[tokio::test]
    async fn a_peer_that_lives_and_does_not_read_is_waited_for() {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        let peer = TcpStream::connect(address).await.unwrap();
        let (stream, _) = listener.accept().await.unwrap();
        let mut watched = Watched::new(stream, Duration::from_secs(3));
        // Longer than the patience, with a closed window from the first moment on.
        let writing = async { while watched.write_all(&[0; 4_096]).await.is_ok() {} };
        assert!(timeout(Duration::from_secs(8), writing).await.is_err());
        drop(peer);
    }
}
