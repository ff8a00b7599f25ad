//! A connection whose last words are heard: before it is closed, what the peer still sends is taken and thrown away.
//!
//! A connection that is closed while bytes of the peer wait unread is reset, and a reset drops what the peer has not read
//! yet: the refusal of an upload would be lost. So the answer is finished first, then its end is said, then the peer has
//! a second to hear it (RFC 9112, section 9.6).

use std::{
    io,
    pin::Pin,
    task::{Context, Poll, ready},
    time::Duration,
};

use tokio::{
    io::{AsyncRead, AsyncWrite, ReadBuf},
    time::{Sleep, sleep},
};

/// Time for the peer to hear the end.
const LINGER: Duration = Duration::from_secs(1);
/// What is thrown away in that time, bytes: an upload that was on its way, not a flood.
const LINGER_BYTES: usize = 4 << 20;
/// What is thrown away at once, bytes.
const PIECE_BYTES: usize = 4 * 1024;

/// A stream that is shut down slowly.
pub(super) struct Lingering<S> {
    stream: S,
    /// Runs once the end was said.
    until: Option<Pin<Box<Sleep>>>,
    n_thrown_away: usize,
}

impl<S> Lingering<S> {
    pub(super) fn new(stream: S) -> Self {
        Self {
            stream,
            until: None,
            n_thrown_away: 0,
        }
    }
}

impl<S: AsyncRead + Unpin> AsyncRead for Lingering<S> {
    fn poll_read(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.get_mut().stream).poll_read(cx, buf)
    }
}

impl<S: AsyncRead + AsyncWrite + Unpin> AsyncWrite for Lingering<S> {
    fn poll_write(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &[u8],
    ) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.get_mut().stream).poll_write(cx, buf)
    }

    fn poll_flush(self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.get_mut().stream).poll_flush(cx)
    }

    fn poll_shutdown(self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        let this = self.get_mut();
        if this.until.is_none() {
            ready!(Pin::new(&mut this.stream).poll_shutdown(cx))?;
        }
        let until = this.until.get_or_insert_with(|| Box::pin(sleep(LINGER)));
        if until.as_mut().poll(cx).is_ready() {
            return Poll::Ready(Ok(()));
        }
        let mut piece = [0; PIECE_BYTES];
        loop {
            let mut buf = ReadBuf::new(&mut piece);
            let read = ready!(Pin::new(&mut this.stream).poll_read(cx, &mut buf));
            this.n_thrown_away += buf.filled().len();
            let is_over = buf.filled().is_empty() || this.n_thrown_away >= LINGER_BYTES;
            if read.is_err() || is_over {
                return Poll::Ready(Ok(()));
            }
        }
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_write_vectored(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        bufs: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.get_mut().stream).poll_write_vectored(cx, bufs)
    }
}

#[cfg(test)]
mod tests {
    use tokio::{
        io::{AsyncReadExt as _, AsyncWriteExt as _, duplex},
        time::Instant,
    };

    use super::*;

    #[tokio::test(start_paused = true)]
    async fn a_peer_that_has_heard_the_end_is_not_waited_for() {
        let (mut peer, stream) = duplex(64);
        let mut lingering = Lingering::new(stream);
        let began = Instant::now();
        lingering.write_all(b"no").await.unwrap();
        let shut = tokio::spawn(async move { lingering.shutdown().await });
        let mut heard = String::new();
        peer.write_all(&[0; 40]).await.unwrap();
        peer.read_to_string(&mut heard).await.unwrap();
        assert_eq!(heard, "no");
        drop(peer);
        shut.await.unwrap().unwrap();
        assert_eq!(began.elapsed(), Duration::ZERO);
    }

    #[tokio::test(start_paused = true)]
    async fn one_that_goes_on_and_on_is_not_listened_to() {
        let (mut peer, stream) = duplex(PIECE_BYTES);
        let flood = tokio::spawn(async move {
            let mut n_sent = 0;
            while peer.write_all(&[0; 1024]).await.is_ok() {
                n_sent += 1024;
            }
            n_sent
        });
        let began = Instant::now();
        let mut lingering = Lingering::new(stream);
        lingering.shutdown().await.unwrap();
        assert_eq!(began.elapsed(), Duration::ZERO);
        drop(lingering);
        let n_sent: usize = flood.await.unwrap();
        assert!(n_sent <= LINGER_BYTES + 2 * PIECE_BYTES, "{n_sent}");
    }

    #[tokio::test(start_paused = true)]
    async fn one_that_says_nothing_is_waited_for_a_second() {
        let (_peer, stream) = duplex(64);
        let began = Instant::now();
        Lingering::new(stream).shutdown().await.unwrap();
        assert_eq!(began.elapsed().as_secs(), LINGER.as_secs());
    }
}
