//! One publish stream, driven message by message.

use frontalis_proto::v1::{
    MarkerFrame, PublishMarkersRequest, PublishResponse, PublishStart, PublishStarted,
    RejectedFrame, capture_service_client::CaptureServiceClient,
};
use tokio::sync::mpsc;
use tokio_stream::wrappers::ReceiverStream;
use tonic::{Status, Streaming};

use crate::{TestServer, server::TestChannel};

/// Messages that may wait for the connection.
const OUTGOING_MESSAGES: usize = 64;

/// The client's end of a publish stream.
pub struct Publisher {
    outgoing: mpsc::Sender<PublishMarkersRequest>,
    incoming: Streaming<PublishResponse>,
    /// The first answer.
    pub started: PublishStarted,
    report: PublishReport,
}

/// What the server said about the frames of one stream, in all its answers so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PublishReport {
    /// The highest watermark.
    pub accepted_through: u64,
    /// Every rejected frame, in the order of the answers.
    pub rejected: Vec<RejectedFrame>,
    /// Frames that were taken and not solved.
    pub shed_frames: u64,
    /// The highest watermark of stable storage.
    pub durable_through: u64,
}

impl PublishReport {
    /// Number and reason of every rejected frame.
    pub fn rejections(&self) -> Vec<(u64, &str)> {
        self.rejected
            .iter()
            .map(|it| (it.number, it.reason.as_str()))
            .collect()
    }
}

impl Publisher {
    /// Opens a stream and waits for its first answer.
    ///
    /// # Errors
    ///
    /// When the server refuses the start.
    pub async fn open(server: &TestServer, start: PublishStart) -> Result<Self, Status> {
        Self::open_on(server.channel().await, start).await
    }

    /// The same on a connection that is there.
    ///
    /// # Errors
    ///
    /// When the server refuses the start.
    pub async fn open_on(channel: TestChannel, start: PublishStart) -> Result<Self, Status> {
        let (outgoing, requests) = mpsc::channel(OUTGOING_MESSAGES);
        let first = PublishMarkersRequest {
            start: Some(start),
            ..PublishMarkersRequest::default()
        };
        outgoing.send(first).await.unwrap();
        let mut incoming = CaptureServiceClient::new(channel)
            .publish_markers(ReceiverStream::new(requests))
            .await?
            .into_inner();
        let first = incoming
            .message()
            .await?
            .ok_or_else(|| Status::internal("the stream ended before it started"))?;
        Ok(Self {
            outgoing,
            incoming,
            started: first.started.expect("the first answer carries `started`"),
            report: PublishReport::default(),
        })
    }

    /// Sends frames in one message. What the server thinks of them comes with the next answers.
    pub async fn send(&mut self, frames: Vec<MarkerFrame>) {
        self.send_message(PublishMarkersRequest {
            frames,
            ..PublishMarkersRequest::default()
        })
        .await;
    }

    /// Sends frames in one message and waits until all of them have been taken.
    pub async fn publish(&mut self, frames: Vec<MarkerFrame>) {
        let last = frames.last().map_or(0, |it| it.number);
        self.send(frames).await;
        self.accepted(last).await.unwrap();
    }

    /// Sends any message; a closed stream is found when its answers are read.
    pub async fn send_message(&mut self, message: PublishMarkersRequest) {
        drop(self.outgoing.send(message).await);
    }

    /// Waits for the next answer; `None` when the server closed the stream in peace.
    ///
    /// # Errors
    ///
    /// When the server broke the stream off.
    pub async fn next(&mut self) -> Result<Option<PublishResponse>, Status> {
        let answer = self.incoming.message().await?;
        if let Some(it) = &answer {
            assert!(
                it.accepted_through >= self.report.accepted_through,
                "a watermark never falls"
            );
            self.report.accepted_through = it.accepted_through;
            self.report.durable_through = self.report.durable_through.max(it.durable_through);
            self.report.rejected.extend(it.rejected.iter().cloned());
            self.report.shed_frames = it.shed_frames;
        }
        Ok(answer)
    }

    /// Reads answers until every frame up to `number` is on stable storage.
    ///
    /// # Errors
    ///
    /// When the stream ends before that.
    pub async fn durable(&mut self, number: u64) -> Result<(), Status> {
        while self.report.durable_through < number {
            if self.next().await?.is_none() {
                return Err(Status::internal("the stream ended early"));
            }
        }
        Ok(())
    }

    /// Reads answers until every frame up to `number` has been taken.
    ///
    /// # Errors
    ///
    /// When the stream ends before that.
    pub async fn accepted(&mut self, number: u64) -> Result<(), Status> {
        while self.report.accepted_through < number {
            if self.next().await?.is_none() {
                return Err(Status::internal("the stream ended early"));
            }
        }
        Ok(())
    }

    /// Reads answers until `count` frames have been rejected.
    ///
    /// # Errors
    ///
    /// When the stream ends before that.
    pub async fn rejected(&mut self, count: usize) -> Result<&[RejectedFrame], Status> {
        while self.report.rejected.len() < count {
            if self.next().await?.is_none() {
                return Err(Status::internal("the stream ended early"));
            }
        }
        Ok(&self.report.rejected)
    }

    /// What the server said so far.
    pub fn report(&self) -> &PublishReport {
        &self.report
    }

    /// Closes the request side and reads what is still said.
    ///
    /// # Errors
    ///
    /// When the server broke the stream off.
    pub async fn finish(mut self) -> Result<PublishReport, Status> {
        let (closed, _) = mpsc::channel(1);
        self.outgoing = closed;
        while self.next().await?.is_some() {}
        Ok(self.report)
    }

    /// Reads until the server breaks the stream off, and returns how.
    pub async fn broken_off(&mut self) -> Status {
        loop {
            match self.next().await {
                Ok(Some(_)) => {}
                Ok(None) => panic!("the stream ended in peace: {:?}", self.report),
                Err(status) => return status,
            }
        }
    }
}
