//! A body as lines, taken as they come: no line is longer than the limit, none takes longer than the deadline.
//!
//! BAD_INPUT E1, E2 and F5. Empty lines are passed over, and the last line needs no end.

use std::{
    pin::Pin,
    task::{Context, Poll},
    time::Duration,
};

use bytes::{Bytes, BytesMut};
use futures::{Stream, StreamExt as _};
use tokio::time::{Sleep, sleep};
use tonic::Status;

use super::super::message::{too_large, too_slow};

/// Time for a line that has begun to end.
const LINE_DEADLINE: Duration = Duration::from_secs(10);

/// A line, or why it is none.
pub(super) struct Line {
    /// From 1; empty lines count.
    pub number: u64,
    /// With its end.
    pub text: Result<Bytes, Status>,
}

/// The lines of `body`. After an error there are no more.
pub(super) struct Lines<B> {
    body: B,
    limit_bytes: usize,
    /// Lines that were taken from what came.
    n_taken: u64,
    /// What came and is no whole line yet.
    pending: BytesMut,
    /// How much of it holds no end of a line.
    n_searched: usize,
    /// None while there is nothing to wait for.
    deadline: Option<Pin<Box<Sleep>>>,
    state: State,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Reading,
    /// The body is at its end; the last line may be pending.
    Ended,
    Over,
}

impl<B> Lines<B> {
    pub(super) fn new(body: B, limit_bytes: usize) -> Self {
        Self {
            body,
            limit_bytes,
            n_taken: 0,
            pending: BytesMut::new(),
            n_searched: 0,
            deadline: None,
            state: State::Reading,
        }
    }

    /// The next whole line that is there.
    fn take(&mut self) -> Option<Bytes> {
        loop {
            let unsearched = &self.pending[self.n_searched..];
            let line = match unsearched.iter().position(|it| *it == b'\n') {
                Some(n) => self.pending.split_to(self.n_searched + n + 1),
                None if self.state == State::Reading || self.pending.is_empty() => {
                    self.n_searched = self.pending.len();
                    return None;
                }
                None => self.pending.split(),
            };
            self.n_searched = 0;
            self.n_taken += 1;
            self.deadline = None;
            if !line.trim_ascii().is_empty() {
                return Some(line.freeze());
            }
        }
    }

    /// Ends with what is wrong with line `number`.
    fn fail(&mut self, number: u64, status: Status) -> Poll<Option<Line>> {
        self.state = State::Over;
        self.pending = BytesMut::new();
        self.n_searched = 0;
        let text = Err(status);
        Poll::Ready(Some(Line { number, text }))
    }

    fn is_late(&mut self, cx: &mut Context<'_>) -> bool {
        if self.pending.is_empty() {
            return false;
        }
        // Begun only here: while the reader has no room, the writer is not the one who is late.
        let deadline = self
            .deadline
            .get_or_insert_with(|| Box::pin(sleep(LINE_DEADLINE)));
        deadline.as_mut().poll(cx).is_ready()
    }
}

impl<B, E> Stream for Lines<B>
where
    B: Stream<Item = Result<Bytes, E>> + Unpin,
    E: std::fmt::Display,
{
    type Item = Line;

    fn poll_next(self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<Option<Self::Item>> {
        let this = self.get_mut();
        loop {
            if let Some(line) = this.take() {
                let number = this.n_taken;
                if line.len() > this.limit_bytes {
                    return this.fail(number, too_large(this.limit_bytes));
                }
                let text = Ok(line);
                return Poll::Ready(Some(Line { number, text }));
            }
            let begun = this.n_taken + 1;
            if this.pending.len() > this.limit_bytes {
                return this.fail(begun, too_large(this.limit_bytes));
            }
            if this.state != State::Reading {
                return Poll::Ready(None);
            }
            match this.body.poll_next_unpin(cx) {
                Poll::Ready(Some(Ok(bytes))) => this.pending.extend_from_slice(&bytes),
                Poll::Ready(Some(Err(error))) => {
                    tracing::debug!(%error, "a body ended early");
                    return this.fail(begun, Status::cancelled("the body ended early"));
                }
                Poll::Ready(None) => this.state = State::Ended,
                Poll::Pending if this.is_late(cx) => return this.fail(begun, too_slow()),
                Poll::Pending => return Poll::Pending,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use futures::stream;
    use tokio::time::Instant;
    use tonic::Code;

    use super::*;

    type Chunk = Result<Bytes, std::io::Error>;

    fn chunks(text: &'static str, size: usize) -> Vec<Chunk> {
        let chunks = text.as_bytes().chunks(size);
        chunks.map(|it| Ok(Bytes::from_static(it))).collect()
    }

    async fn all(chunks: Vec<Chunk>, limit_bytes: usize) -> Result<Vec<(u64, String)>, Code> {
        let mut lines = Lines::new(stream::iter(chunks), limit_bytes);
        let mut read = Vec::new();
        while let Some(Line { number, text }) = lines.next().await {
            let text = text.map_err(|it| it.code())?;
            let text = String::from_utf8(text.trim_ascii().to_vec()).unwrap();
            read.push((number, text));
        }
        Ok(read)
    }

    #[tokio::test]
    async fn lines_are_the_same_however_the_body_is_cut() {
        let text = "{\"a\":1}\r\n\n  \n{}\n[1,2,3]";
        for size in 1..=text.len() {
            let read = all(chunks(text, size), 64).await.unwrap();
            let expected = [(1, "{\"a\":1}"), (4, "{}"), (5, "[1,2,3]")];
            assert_eq!(read, expected.map(|(n, it)| (n, it.to_owned())), "{size}");
        }
    }

    #[tokio::test]
    async fn a_line_beyond_the_limit_is_refused_before_its_end_comes() {
        let text = "0123456789";
        assert_eq!(all(chunks(text, 3), 9).await, Err(Code::OutOfRange));
        assert_eq!(all(chunks(text, 3), 10).await.unwrap().len(), 1);
        let mut endless = Lines::new(stream::repeat_with(|| Chunk::Ok("abc".into())), 1_024);
        let Line { number, text } = endless.next().await.unwrap();
        assert_eq!((number, text.unwrap_err().code()), (1, Code::OutOfRange));
        assert!(endless.next().await.is_none());
    }

    #[tokio::test(start_paused = true)]
    async fn f5_a_line_that_has_begun_must_end_within_ten_seconds() {
        let drip = stream::unfold((), |()| async {
            sleep(Duration::from_secs(1)).await;
            Some((Chunk::Ok("x".into()), ()))
        });
        let began = Instant::now();
        let mut lines = Lines::new(Box::pin(drip), 1_024);
        let late = lines.next().await.unwrap().text.unwrap_err();
        assert_eq!(late.code(), Code::DeadlineExceeded);
        assert!(
            began.elapsed() <= Duration::from_secs(12),
            "{:?}",
            began.elapsed()
        );
    }

    #[tokio::test(start_paused = true)]
    async fn between_lines_a_publisher_may_be_silent() {
        let slow = stream::unfold(0, |n| async move {
            sleep(Duration::from_mins(1)).await;
            (n < 3).then(|| (Chunk::Ok("{}\n".into()), n + 1))
        });
        let lines = Lines::new(Box::pin(slow), 1_024);
        assert_eq!(lines.count().await, 3);
    }
}
