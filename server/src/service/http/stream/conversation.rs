//! One WebSocket: messages in go to the stream of the contract, its answers go out, one at a time.
//!
//! Nothing is queued: a message is read when the one before was taken, an answer is made when the one before has left.
//! So a slow peer slows only itself, and holds one message each way (CONTRACTS D-19, D-20).

use std::{
    future::poll_fn,
    pin::Pin,
    task::{Context, Poll},
    time::Duration,
};

use bytes::Bytes;
use futures::{FutureExt as _, SinkExt as _, Stream, StreamExt as _, channel::mpsc};
use serde::Serialize;
use tokio::{
    io::{AsyncRead, AsyncReadExt as _, AsyncWrite, AsyncWriteExt as _},
    time::{Interval, MissedTickBehavior, timeout},
};
use tokio_tungstenite::{
    WebSocketStream,
    tungstenite::{
        self, Message,
        protocol::{
            CloseFrame,
            frame::{
                Frame,
                coding::{Data, OpCode},
            },
        },
    },
};
use tonic::Status;

use super::{
    super::message::{Incoming, Taken, from_json, from_protobuf, write_json},
    closing,
    patience::{Metered, Patience, TICK, Verdict},
    subprotocol::Form,
};

/// Time for the last words, and for the peer to hear them.
const LAST_WORDS: Duration = Duration::from_secs(2);
/// Time for the frames of a publisher that said goodbye.
const LAST_FRAMES: Duration = Duration::from_secs(5);

/// What a conversation is about.
pub(super) struct Topic {
    /// The session of the path.
    pub session: String,
    /// The path, for problems.
    pub instance: String,
    /// How far the stream is with the peer's messages, for problems.
    pub taken: Taken,
    /// How messages are written.
    pub form: Form,
    /// Largest message of the client, bytes.
    pub limit_bytes: usize,
    /// Whether what was taken is worked off after the client's goodbye.
    pub finishes: bool,
}

/// The answers of a contract.
pub(super) type Responses<O> = Pin<Box<dyn Stream<Item = Result<O, Status>> + Send>>;

/// A WebSocket and the stream behind it.
pub(super) struct Conversation<S, I, O> {
    topic: Topic,
    socket: WebSocketStream<Metered<S>>,
    /// Holds one message at most.
    inbox: mpsc::Sender<Result<I, Status>>,
    responses: Responses<O>,
    patience: Patience,
    ticks: Interval,
    /// Nothing more is read after a broken message.
    may_read: bool,
    /// The stream has room for a message.
    is_reading: bool,
    /// A message is on its way out.
    is_writing: bool,
    /// Bytes of the answer before: the next is about as long.
    n_bytes: usize,
}

enum Event<O> {
    Heard(Result<Message, tungstenite::Error>),
    Gone,
    Answer(Option<Result<O, Status>>),
    Tick,
}

/// How a conversation ends.
enum End {
    /// The peer is gone.
    Gone,
    /// The peer said goodbye.
    Goodbye,
    /// The stream is at its end.
    Peace,
    /// The stream failed.
    Failed(Status),
}

impl<S, I, O> Conversation<S, I, O>
where
    S: AsyncRead + AsyncWrite + Unpin,
    I: Incoming,
    O: prost::Message + Serialize,
{
    pub(super) fn new(
        topic: Topic,
        socket: WebSocketStream<Metered<S>>,
        inbox: mpsc::Sender<Result<I, Status>>,
        responses: Responses<O>,
    ) -> Self {
        let mut ticks = tokio::time::interval(TICK);
        ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        Self {
            topic,
            socket,
            inbox,
            responses,
            patience: Patience::new(),
            ticks,
            may_read: true,
            is_reading: true,
            is_writing: false,
            n_bytes: 256,
        }
    }

    /// Talks to the end.
    pub(super) async fn run(mut self) {
        match self.talk().await {
            End::Gone => {}
            End::Goodbye => self.see_off().await,
            End::Peace => self.close(None, closing::in_peace()).await,
            End::Failed(status) => {
                let frame = closing::of(&status);
                let text = self
                    .topic
                    .taken
                    .problem(status)
                    .in_stream(&self.topic.instance);
                self.close(Some(text), frame).await;
            }
        }
    }

    async fn talk(&mut self) -> End {
        loop {
            let event = poll_fn(|cx| self.poll(cx)).await;
            let end = match event {
                Event::Heard(Ok(message)) => self.hear(message),
                Event::Heard(Err(error)) => self.fail(&error),
                Event::Gone => Some(End::Gone),
                Event::Answer(None) => Some(End::Peace),
                Event::Answer(Some(Err(status))) => Some(End::Failed(status)),
                Event::Answer(Some(Ok(answer))) => self.answer(&answer),
                Event::Tick => self.judge(),
            };
            if let Some(end) = end {
                return end;
            }
        }
    }

    fn poll(&mut self, cx: &mut Context<'_>) -> Poll<Event<O>> {
        // A stream that takes no more messages is at its end; the peer is still heard until that comes.
        self.is_reading = self.may_read && self.inbox.poll_ready(cx).is_ready();
        if self.is_reading {
            match self.socket.poll_next_unpin(cx) {
                Poll::Ready(Some(heard)) => return Poll::Ready(Event::Heard(heard)),
                Poll::Ready(None) => return Poll::Ready(Event::Gone),
                Poll::Pending => {}
            }
        }
        if self.is_writing {
            match self.socket.poll_flush_unpin(cx) {
                Poll::Ready(Ok(())) => {
                    self.is_writing = false;
                    self.patience.took();
                }
                Poll::Ready(Err(_gone)) => return Poll::Ready(Event::Gone),
                Poll::Pending => {}
            }
        }
        if !self.is_writing
            && let Poll::Ready(answer) = self.responses.poll_next_unpin(cx)
        {
            return Poll::Ready(Event::Answer(answer));
        }
        self.ticks.poll_tick(cx).map(|_| Event::Tick)
    }

    fn hear(&mut self, message: Message) -> Option<End> {
        let n_read = self.socket.get_ref().n_read();
        if let Err(flood) = self.patience.hear(&message, n_read) {
            return Some(End::Failed(flood));
        }
        let read = match (message, self.topic.form) {
            (Message::Text(text), Form::Json) => from_json(text.as_bytes(), 1),
            (Message::Binary(bytes), Form::Protobuf) => from_protobuf(bytes),
            (Message::Text(_) | Message::Binary(_), _) => Err(closing::other_form()),
            (Message::Close(_), _) => return Some(End::Goodbye),
            (Message::Ping(_) | Message::Pong(_) | Message::Frame(_), _) => return None,
        };
        let placed = read.and_then(|mut it: I| it.place(&self.topic.session).map(|()| it));
        if placed.as_ref().is_ok_and(I::may_pause) {
            self.patience.allow_pauses();
        }
        self.pass(placed);
        None
    }

    /// The stream is told what the client broke: it ends as it ends for every door.
    fn fail(&mut self, error: &tungstenite::Error) -> Option<End> {
        let Some(status) = closing::broken(error, self.topic.limit_bytes) else {
            tracing::debug!(%error, "a WebSocket is gone");
            return Some(End::Gone);
        };
        self.pass(Err(status));
        None
    }

    fn pass(&mut self, message: Result<I, Status>) {
        self.may_read &= message.is_ok();
        // There was room; a stream that is over has its own last word.
        drop(self.inbox.start_send(message));
    }

    fn answer(&mut self, answer: &O) -> Option<End> {
        match self.written(answer) {
            Ok(message) => self.send(message),
            Err(status) => Some(End::Failed(status)),
        }
    }

    fn written(&mut self, answer: &O) -> Result<Message, Status> {
        match self.topic.form {
            Form::Protobuf => Ok(Message::Binary(answer.encode_to_vec().into())),
            Form::Json => {
                let mut text = Vec::with_capacity(self.n_bytes);
                write_json(answer, &mut text)?;
                self.n_bytes = text.len() + 64;
                // What the encoder wrote is UTF-8, so it need not be looked through again.
                let opcode = OpCode::Data(Data::Text);
                let frame = Frame::message(Bytes::from(text), opcode, true);
                Ok(Message::Frame(frame))
            }
        }
    }

    fn send(&mut self, message: Message) -> Option<End> {
        self.is_writing = true;
        let sent = self.socket.start_send_unpin(message);
        sent.err().map(|error| {
            tracing::debug!(%error, "a WebSocket is gone");
            End::Gone
        })
    }

    fn judge(&mut self) -> Option<End> {
        let n_read = self.socket.get_ref().n_read();
        match self
            .patience
            .judge(n_read, self.is_reading, self.is_writing)
        {
            Verdict::Wait => None,
            Verdict::Ping => self.send(Message::Ping(Bytes::new())),
            Verdict::End(status) => Some(End::Failed(status)),
            Verdict::Blocked => Some(self.give_up()),
        }
    }

    /// The stream may have last words, for a peer that reads again just now.
    fn give_up(&mut self) -> End {
        match self.responses.next().now_or_never() {
            Some(Some(Err(status))) => End::Failed(status),
            _ => End::Gone,
        }
    }

    /// Answers a goodbye, and works off what was taken before it.
    async fn see_off(mut self) {
        self.inbox.close_channel();
        drop(timeout(LAST_WORDS, self.socket.flush()).await);
        if self.topic.finishes {
            let responses = &mut self.responses;
            let rest = async { while responses.next().await.is_some() {} };
            drop(timeout(LAST_FRAMES, rest).await);
        }
    }

    /// Says the last words, and waits until the peer has hung up: what it still sends must not push them out.
    async fn close(mut self, text: Option<String>, frame: CloseFrame) {
        drop(self.responses);
        let last_words = async {
            if let Some(text) = text {
                self.socket.send(Message::text(text)).await?;
            }
            self.socket.send(Message::Close(Some(frame))).await?;
            let io = self.socket.get_mut();
            io.shutdown().await?;
            let mut rest = [0; 1024];
            while io.read(&mut rest).await? > 0 {}
            Ok::<_, tungstenite::Error>(())
        };
        if let Ok(Err(error)) = timeout(LAST_WORDS, last_words).await {
            tracing::debug!(%error, "a WebSocket was gone before its last words");
        }
    }
}

#[cfg(test)]
mod tests;
