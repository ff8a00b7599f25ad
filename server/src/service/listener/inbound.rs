//! What comes in on a connection, before a library sees it: it must begin within a deadline, and flood nobody.
//!
//! The libraries' timers start with the first request or after the HTTP/2 preface; a peer that sends neither, or half a
//! preface, would stay for ever (CONTRACTS S-9, BAD_INPUT F1). Of HTTP/2 the control frames are counted ([`frames`]);
//! above their budget nothing more is read (F8). Of HTTP/1 the ends of requests must be clear ([`http1_framing`], F13).
//!
//! [`frames`]: super::frames
//! [`http1_framing`]: super::http1_framing

use std::{
    io,
    pin::Pin,
    task::{Context, Poll},
    time::Duration,
};

use tokio::{
    io::{AsyncRead, AsyncWrite, ReadBuf},
    sync::oneshot,
    time::{Instant, Sleep},
};

use super::{
    frames::{ControlFrame, FrameMeter},
    http1_framing::Http1Framing,
};

const PREFACE: &[u8; 24] = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";

const SWITCHING: &[u8] = b"HTTP/1.1 101";

/// Reads fail after the deadline, unless it is clear by then which protocol is spoken.
pub(super) struct Inbound<S> {
    stream: S,
    speech: Speech,
    /// Tells which frames were too many; none once it has.
    excess: Option<oneshot::Sender<ControlFrame>>,
}

/// What is spoken.
enum Speech {
    Unclear {
        deadline: Pin<Box<Sleep>>,
        /// Bytes of the preface that came so far.
        n_matched: usize,
    },
    /// HTTP/1, which has a deadline of its own for headers, and what it is upgraded to.
    Http1(Http1Framing),
    Http2(FrameMeter),
}

impl<S> Inbound<S> {
    /// The stream, and what says that too many frames came.
    pub(super) fn new(stream: S, within: Duration) -> (Self, oneshot::Receiver<ControlFrame>) {
        let (excess, exceeded) = oneshot::channel();
        let speech = Speech::Unclear {
            deadline: Box::pin(tokio::time::sleep(within)),
            n_matched: 0,
        };
        let inbound = Self {
            stream,
            speech,
            excess: Some(excess),
        };
        (inbound, exceeded)
    }

    /// With this answer HTTP/1 ends and a WebSocket begins; an upgrade is the last request of its connection.
    fn observe_answer(&mut self, bytes: &[u8]) {
        if let Speech::Http1(framing) = &mut self.speech
            && bytes.starts_with(SWITCHING)
        {
            framing.upgraded();
        }
    }

    fn observe(&mut self, bytes: &mut [u8]) {
        let rest = match &mut self.speech {
            Speech::Unclear { n_matched, .. } => {
                // It is clear with the whole preface, or with the first byte that is none of it.
                let expected = &PREFACE[*n_matched..];
                let n = bytes.len().min(expected.len());
                *n_matched += n;
                if bytes[..n] != expected[..n] {
                    let mut framing = Http1Framing::new();
                    // What came before agrees with the preface.
                    framing.follow(&mut PREFACE[..*n_matched - n].to_vec());
                    self.speech = Speech::Http1(framing);
                    bytes
                } else if *n_matched == PREFACE.len() {
                    self.speech = Speech::Http2(FrameMeter::new(Instant::now()));
                    &mut bytes[n..]
                } else {
                    return;
                }
            }
            Speech::Http1(_) | Speech::Http2(_) => bytes,
        };
        let exceeded = match &mut self.speech {
            Speech::Http2(meter) => meter.observe(rest, Instant::now()),
            Speech::Http1(framing) => {
                framing.follow(rest);
                None
            }
            Speech::Unclear { .. } => None,
        };
        let Some(kind) = exceeded else {
            return;
        };
        if let Some(excess) = self.excess.take() {
            // Nobody listens when the connection is on its way out anyway.
            let _told = excess.send(kind);
        }
    }
}

impl<S: AsyncRead + Unpin> AsyncRead for Inbound<S> {
    fn poll_read(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let this = self.get_mut();
        if this.excess.is_none() {
            // Whoever was told ends the connection; until then nothing wakes this read.
            return Poll::Pending;
        }
        let before = buf.filled().len();
        let read = Pin::new(&mut this.stream).poll_read(cx, buf);
        if read.is_ready() {
            this.observe(&mut buf.filled_mut()[before..]);
            return read;
        }
        match &mut this.speech {
            Speech::Unclear { deadline, .. } => deadline
                .as_mut()
                .poll(cx)
                .map(|()| Err(io::ErrorKind::TimedOut.into())),
            Speech::Http1(_) | Speech::Http2(_) => Poll::Pending,
        }
    }
}

impl<S: AsyncWrite + Unpin> AsyncWrite for Inbound<S> {
    fn poll_write(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        buf: &[u8],
    ) -> Poll<io::Result<usize>> {
        let this = self.get_mut();
        this.observe_answer(buf);
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
        this.observe_answer(bufs.first().map_or(&[], |it| it));
        Pin::new(&mut this.stream).poll_write_vectored(cx, bufs)
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
        let (mut inbound, _exceeded) = Inbound::new(stream, WITHIN);
        peer.write_all(sent).await.unwrap();
        let mut buffer = [0; 64];
        let all = async {
            loop {
                if let Err(error) = inbound.read(&mut buffer).await {
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
    async fn a_flood_is_reported_and_nothing_more_is_read() {
        let ping = [0, 0, 0, 6, 0, 0, 0, 0, 0];
        let flood = [&PREFACE[..], &ping.repeat(20_000)].concat();
        let (mut peer, stream) = duplex(flood.len() * 2);
        let (mut inbound, exceeded) = Inbound::new(stream, WITHIN);
        peer.write_all(&flood).await.unwrap();
        let mut n_read = 0;
        let mut buffer = [0; 1024];
        while let Ok(n) = tokio::time::timeout(WITHIN, inbound.read(&mut buffer)).await {
            n_read += n.unwrap();
        }
        assert_eq!(exceeded.await.unwrap(), ControlFrame::Ping);
        assert!(n_read < flood.len());
    }

    #[tokio::test(start_paused = true)]
    async fn a_peer_that_has_begun_is_left_to_the_protocols_own_deadlines() {
        assert!(!times_out_after(PREFACE).await);
        assert!(!times_out_after(b"GET / ").await);
    }
}
