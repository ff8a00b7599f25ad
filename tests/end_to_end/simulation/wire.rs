//! Connections that can be cut from outside, as a box on the way may.

use std::{
    io,
    pin::Pin,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    task::{Context, Poll},
};

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};

/// Cuts every connection that is open.
#[derive(Clone, Debug, Default)]
pub struct Scissors(Arc<AtomicU64>);

impl Scissors {
    /// Resets all connections made so far.
    pub fn cut(&self) {
        self.0.fetch_add(1, Ordering::SeqCst);
    }

    fn n_cuts(&self) -> u64 {
        self.0.load(Ordering::SeqCst)
    }
}

/// A connection that is reset by the scissors.
pub struct Severable<S> {
    stream: S,
    scissors: Scissors,
    n_cuts: u64,
}

impl<S> Severable<S> {
    /// A connection that is made now.
    pub fn new(stream: S, scissors: Scissors) -> Self {
        Self {
            n_cuts: scissors.n_cuts(),
            stream,
            scissors,
        }
    }

    fn check(&self) -> io::Result<()> {
        if self.n_cuts == self.scissors.n_cuts() {
            Ok(())
        } else {
            Err(io::ErrorKind::ConnectionReset.into())
        }
    }
}

impl<S: AsyncRead + Unpin> AsyncRead for Severable<S> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        self.check()?;
        Pin::new(&mut self.stream).poll_read(cx, buf)
    }
}

impl<S: AsyncWrite + Unpin> AsyncWrite for Severable<S> {
    fn poll_write(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &[u8],
    ) -> Poll<io::Result<usize>> {
        self.check()?;
        Pin::new(&mut self.stream).poll_write(cx, buf)
    }

    fn poll_flush(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        self.check()?;
        Pin::new(&mut self.stream).poll_flush(cx)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(cx)
    }
}
