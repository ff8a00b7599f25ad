//! What comes in on a connection, before a library sees it: it must begin within a deadline, and flood nobody.
//!
//! The libraries' timers start with the first request or after the HTTP/2 preface; a peer that sends neither, or half a
//! preface, would stay for ever (CONTRACTS S-9, BAD_INPUT F1). Of HTTP/2 the control frames are counted ([`frames`]);
//! above their budget nothing more is read (F8). Of HTTP/1 the ends of requests must be clear ([`http1_framing`], F13);
//! with the first that is not, the connection ends here.
//!
//! [`frames`]: super::frames
//! [`http1_framing`]: super::http1_framing

use std::{
    io,
    pin::Pin,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
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

/// Set by whoever answers that the connection speaks something else from now on; an upgrade is its last request.
#[derive(Clone, Debug, Default)]
pub(super) struct Upgraded(Arc<AtomicBool>);

impl Upgraded {
    pub(super) fn set(&self) {
        self.0.store(true, Ordering::Release);
    }

    fn is_set(&self) -> bool {
        self.0.load(Ordering::Acquire)
    }
}

/// Reads fail after the deadline, unless it is clear by then which protocol is spoken.
pub(super) struct Inbound<S> {
    stream: S,
    speech: Speech,
    upgraded: Upgraded,
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
    pub(super) fn new(
        stream: S,
        within: Duration,
        upgraded: Upgraded,
    ) -> (Self, oneshot::Receiver<ControlFrame>) {
        let (excess, exceeded) = oneshot::channel();
        let speech = Speech::Unclear {
            deadline: Box::pin(tokio::time::sleep(within)),
            n_matched: 0,
        };
        let inbound = Self {
            stream,
            speech,
            upgraded,
            excess: Some(excess),
        };
        (inbound, exceeded)
    }

    /// How many of these bytes may be read.
    fn observe(&mut self, bytes: &mut [u8]) -> usize {
        let n_there = bytes.len();
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
                    return n_there;
                }
            }
            Speech::Http1(_) | Speech::Http2(_) => bytes,
        };
        match &mut self.speech {
            Speech::Http1(framing) => {
                if self.upgraded.is_set() {
                    framing.upgraded();
                }
                return framing.follow(rest);
            }
            Speech::Http2(meter) => {
                if let Some(kind) = meter.observe(rest, Instant::now())
                    && let Some(excess) = self.excess.take()
                {
                    // Nobody listens when the connection is on its way out anyway.
                    let _told = excess.send(kind);
                }
            }
            Speech::Unclear { .. } => {}
        }
        n_there
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
        if let Speech::Http1(framing) = &mut this.speech
            && framing.is_broken()
        {
            buf.put_slice(framing.last_words(buf.remaining()));
            return Poll::Ready(Ok(()));
        }
        let before = buf.filled().len();
        let read = Pin::new(&mut this.stream).poll_read(cx, buf);
        if read.is_ready() {
            let n = this.observe(&mut buf.filled_mut()[before..]);
            buf.set_filled(before + n);
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
        let (mut inbound, _exceeded) = Inbound::new(stream, WITHIN, Upgraded::default());
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

    #[tokio::test]
    async fn after_a_request_whose_end_is_not_clear_a_reader_sees_the_end() {
        let (mut peer, stream) = duplex(1024);
        let (mut inbound, _exceeded) = Inbound::new(stream, WITHIN, Upgraded::default());
        let clear = b"GET / HTTP/1.1\r\nHost: x\r\n\r\n";
        peer.write_all(&[clear, &b"GET / HTTP/1.1\n"[..], clear].concat())
            .await
            .unwrap();
        let mut read = Vec::new();
        inbound.read_to_end(&mut read).await.unwrap();
        assert_eq!(read, [clear, &b"GET / HTTP/1.1\0\r\n\r\n"[..]].concat());
        peer.write_all(clear).await.unwrap();
        assert_eq!(inbound.read(&mut [0; 64]).await.unwrap(), 0);
    }

    #[tokio::test]
    async fn after_an_upgrade_lines_are_no_requests() {
        let (mut peer, stream) = duplex(1024);
        let upgraded = Upgraded::default();
        let (mut inbound, _exceeded) = Inbound::new(stream, WITHIN, upgraded.clone());
        peer.write_all(b"GET / HTTP/1.1\r\n\r\n").await.unwrap();
        let mut read = [0; 64];
        assert_eq!(inbound.read(&mut read).await.unwrap(), 18);
        upgraded.set();
        peer.write_all(b"\n\n").await.unwrap();
        assert_eq!(inbound.read(&mut read).await.unwrap(), 2);
        assert_eq!(read[..2], *b"\n\n");
    }

    #[tokio::test(start_paused = true)]
    async fn a_flood_is_reported_and_nothing_more_is_read() {
        let ping = [0, 0, 0, 6, 0, 0, 0, 0, 0];
        let flood = [&PREFACE[..], &ping.repeat(20_000)].concat();
        let (mut peer, stream) = duplex(flood.len() * 2);
        let (mut inbound, exceeded) = Inbound::new(stream, WITHIN, Upgraded::default());
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
