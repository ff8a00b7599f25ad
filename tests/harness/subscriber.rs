//! One subscription, heard entry by entry.

use std::collections::VecDeque;

use frontalis_proto::v1::{
    CurveEnd, CurveHeader, CurveSample, Delivery, Gap, StreamState, SubscribeRequest,
    SubscribeResponse, SubscribeStart, curve_service_client::CurveServiceClient,
};
use tokio::sync::mpsc;
use tokio_stream::wrappers::ReceiverStream;
use tonic::{Status, Streaming};

use crate::{TestServer, server::TestChannel};

/// The client's end of a subscription.
pub struct Subscriber {
    requests: mpsc::Sender<SubscribeRequest>,
    incoming: Streaming<SubscribeResponse>,
    heard: VecDeque<Heard>,
    /// The first answer.
    pub header: CurveHeader,
    /// Samples that this subscriber did not get, as the newest answer says.
    pub skipped_samples: u64,
}

/// One entry of the stream.
#[derive(Clone, Debug, PartialEq)]
pub enum Heard {
    /// A sample of the curves.
    Sample(Box<CurveSample>),
    /// Frames without one.
    Gap(Gap),
    /// The session's state, or a heartbeat.
    State(StreamState),
    /// The session ended.
    End(CurveEnd),
}

/// Every frame from the oldest that is kept.
pub fn every_frame(session: &str) -> SubscribeStart {
    SubscribeStart {
        session: session.to_owned(),
        delivery: Delivery::EveryFrame.into(),
        from_oldest: true,
        ..SubscribeStart::default()
    }
}

/// The newest sample against credits.
pub fn latest(session: &str, credits: u32) -> SubscribeStart {
    SubscribeStart {
        session: session.to_owned(),
        delivery: Delivery::Latest.into(),
        credits,
        ..SubscribeStart::default()
    }
}

impl Subscriber {
    /// Opens a subscription and waits for its header.
    ///
    /// # Errors
    ///
    /// When the server refuses the start.
    pub async fn open(server: &TestServer, start: SubscribeStart) -> Result<Self, Status> {
        Self::open_on(server.channel().await, start).await
    }

    /// The same on a connection that is there.
    ///
    /// # Errors
    ///
    /// When the server refuses the start.
    pub async fn open_on(channel: TestChannel, start: SubscribeStart) -> Result<Self, Status> {
        let (requests, outgoing) = mpsc::channel(64);
        let first = SubscribeRequest {
            start: Some(start),
            credits: 0,
        };
        requests.send(first).await.unwrap();
        let mut incoming = CurveServiceClient::new(channel)
            .subscribe(ReceiverStream::new(outgoing))
            .await?
            .into_inner();
        let first = incoming
            .message()
            .await?
            .ok_or_else(|| Status::internal("the stream ended before its header"))?;
        Ok(Self {
            requests,
            incoming,
            heard: VecDeque::new(),
            header: first.header.expect("the first answer holds the header"),
            skipped_samples: 0,
        })
    }

    /// Grants more credits.
    pub async fn grant(&mut self, credits: u32) {
        let grant = SubscribeRequest {
            start: None,
            credits,
        };
        drop(self.requests.send(grant).await);
    }

    /// Sends any message, also one that breaks the contract.
    pub async fn send(&mut self, message: SubscribeRequest) {
        drop(self.requests.send(message).await);
    }

    /// The next entry, gaps in their place among the samples; `None` when the stream closed in peace.
    ///
    /// # Errors
    ///
    /// When the server broke the stream off.
    pub async fn next(&mut self) -> Result<Option<Heard>, Status> {
        while self.heard.is_empty() {
            let Some(answer) = self.incoming.message().await? else {
                return Ok(None);
            };
            self.take(answer);
        }
        Ok(self.heard.pop_front())
    }

    /// The next answer as it came; `None` when the stream closed in peace.
    ///
    /// # Errors
    ///
    /// When the server broke the stream off.
    pub async fn answer(&mut self) -> Result<Option<SubscribeResponse>, Status> {
        self.incoming.message().await
    }

    fn take(&mut self, answer: SubscribeResponse) {
        self.skipped_samples = answer.skipped_samples;
        let mut gaps = answer.gaps.into_iter().peekable();
        for sample in answer.samples {
            while let Some(gap) = gaps.next_if(|it| it.last < sample.frame) {
                self.heard.push_back(Heard::Gap(gap));
            }
            self.heard.push_back(Heard::Sample(Box::new(sample)));
        }
        self.heard.extend(gaps.map(Heard::Gap));
        self.heard.extend(answer.state.map(Heard::State));
        self.heard.extend(answer.end.map(Heard::End));
    }

    /// The next sample; other entries are passed over.
    ///
    /// # Errors
    ///
    /// When the stream ends before that.
    pub async fn sample(&mut self) -> Result<CurveSample, Status> {
        loop {
            match self.next().await? {
                Some(Heard::Sample(sample)) => return Ok(*sample),
                Some(_) => {}
                None => return Err(Status::internal("the stream ended early")),
            }
        }
    }

    /// The next gap; other entries are passed over.
    ///
    /// # Errors
    ///
    /// When the stream ends before that.
    pub async fn gap(&mut self) -> Result<Gap, Status> {
        loop {
            match self.next().await? {
                Some(Heard::Gap(gap)) => return Ok(gap),
                Some(_) => {}
                None => return Err(Status::internal("the stream ended early")),
            }
        }
    }

    /// Every sample up to that of frame `number`, included.
    ///
    /// # Errors
    ///
    /// When the stream ends before that.
    pub async fn samples_through(&mut self, number: u64) -> Result<Vec<CurveSample>, Status> {
        let mut samples = Vec::new();
        loop {
            let sample = self.sample().await?;
            let frame = sample.frame;
            samples.push(sample);
            if frame >= number {
                return Ok(samples);
            }
        }
    }

    /// Every entry up to the end of the session; heartbeats are left out.
    ///
    /// # Errors
    ///
    /// When the server broke the stream off.
    pub async fn until_end(&mut self) -> Result<Vec<Heard>, Status> {
        let mut heard = Vec::new();
        while let Some(entry) = self.next().await? {
            if !matches!(entry, Heard::State(_)) {
                heard.push(entry);
            }
        }
        Ok(heard)
    }
}
