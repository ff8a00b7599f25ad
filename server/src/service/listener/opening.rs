//! A connection that must begin to speak within a deadline.
//!
//! The libraries' timers start with the first request or after the HTTP/2 preface; a peer that sends neither, or half a
//! preface, would stay for ever (CONTRACTS S-9, BAD_INPUT F1).

use std::{
    io,
    pin::Pin,
    task::{Context, Poll},
    time::Duration,
};

use tokio::{
    io::{AsyncRead, AsyncWrite, ReadBuf},
    time::Sleep,
};

const PREFACE: &[u8; 24] = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";

/// Reads fail after the deadline, unless it is clear by then which protocol is spoken.
pub(super) struct Opening<S> {
    stream: S,
    /// None once the protocol is clear.
    deadline: Option<Pin<Box<Sleep>>>,
    /// Bytes of the preface that came so far.
    n_matched: usize,
}

impl<S> Opening<S> {
    pub(super) fn new(stream: S, within: Duration) -> Self {
        Self {
            stream,
            deadline: Some(Box::pin(tokio::time::sleep(within))),
            n_matched: 0,
        }
    }

    /// The protocol is clear with the whole preface, or with the first byte that is none of it: then HTTP/1's own
    /// deadline for headers applies.
    fn observe(&mut self, bytes: &[u8]) {
        let expected = &PREFACE[self.n_matched..];
        let n = bytes.len().min(expected.len());
        self.n_matched += n;
        let other = bytes[..n] != expected[..n];
        if other || self.n_matched == PREFACE.len() {
            self.deadline = None;
        }
    }
}

impl<S: AsyncRead + Unpin> AsyncRead for Opening<S> {
    fn poll_read(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let this = self.get_mut();
        let before = buf.filled().len();
        let read = Pin::new(&mut this.stream).poll_read(cx, buf);
        let Some(deadline) = &mut this.deadline else {
            return read;
        };
        if read.is_pending() {
            return match deadline.as_mut().poll(cx) {
                Poll::Ready(()) => Poll::Ready(Err(io::ErrorKind::TimedOut.into())),
                Poll::Pending => Poll::Pending,
            };
        }
        this.observe(&buf.filled()[before..]);
        read
    }
}

impl<S: AsyncWrite + Unpin> AsyncWrite for Opening<S> {
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
        Pin::new(&mut self.get_mut().stream).poll_write_vectored(cx, bufs)
    }
}

#[cfg(test)]
mod tests {
    use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, duplex};

    use super::*;

    const WITHIN: Duration = Duration::from_secs(5);

    /// Writes `sent`, then nothing for ever: does a reader see the end of its patience?
    async fn times_out_after(sent: &[u8]) -> bool {
        let (mut peer, stream) = duplex(64);
        let mut opening = Opening::new(stream, WITHIN);
        peer.write_all(sent).await.unwrap();
        let mut buffer = [0; 64];
        let all = async {
            loop {
                if let Err(error) = opening.read(&mut buffer).await {
                    return error.kind() == io::ErrorKind::TimedOut;
                }
            }
        };
        tokio::time::timeout(WITHIN * 10, all)
            .await
            .unwrap_or(false)
    }

    #[tokio::test(start_paused = true)]
    async fn a_peer_that_says_nothing_or_half_a_preface_is_cut() {
        assert!(times_out_after(b"").await);
        assert!(times_out_after(&PREFACE[..23]).await);
    }

    #[tokio::test(start_paused = true)]
    async fn a_peer_that_has_begun_is_left_to_the_protocols_own_deadlines() {
        assert!(!times_out_after(PREFACE).await);
        assert!(!times_out_after(b"GET / ").await);
    }
}
