//! A server that follows a script, in memory: for the clients' tests under a paused clock.

use std::{
    collections::VecDeque,
    io,
    sync::{Arc, Mutex, MutexGuard},
};

use hyper_util::rt::TokioIo;
use tokio::{io::DuplexStream, sync::mpsc};
use tokio_stream::{StreamExt as _, wrappers::ReceiverStream};
use tonic::{
    Request, Response, Status, Streaming,
    transport::{Endpoint, Server},
};

use crate::{
    connection::{Bearer, Channel},
    proto::{
        Ingest, PublishImagesRequest, PublishMarkersRequest, PublishResponse, PublishStarted,
        RejectedFrame, SubscribeRequest, SubscribeResponse, SubscribeStart,
        capture_service_server::{CaptureService, CaptureServiceServer},
        curve_service_server::{CurveService, CurveServiceServer},
    },
};

type Responses<T> = ReceiverStream<Result<T, Status>>;

/// What a publisher's connection does.
#[derive(Clone, Debug)]
pub(crate) enum Capture {
    /// Acknowledges every frame until the client closes.
    Serve,
    /// Refuses the start.
    Refuse(Status),
    /// Acknowledges `acked` frames, takes `taken`, then breaks with the status.
    Break {
        taken: usize,
        acked: usize,
        status: Status,
    },
    /// Loses its memory first: the session starts over in a new run.
    ServeNewRun,
    /// Rejects these frames, serves the others.
    Reject(Vec<u64>),
}

/// What a subscriber's connection does: responses in order, then the status or, without one, silence.
#[derive(Clone, Debug)]
pub(crate) struct Curves {
    pub responses: Vec<SubscribeResponse>,
    pub status: Option<Status>,
}

/// What happened so far.
#[derive(Debug, Default)]
pub(crate) struct Record {
    pub capture_script: VecDeque<Capture>,
    pub curve_script: VecDeque<Curves>,
    /// Frame numbers that arrived, one list a connection.
    pub arrived: Vec<Vec<u64>>,
    /// Frame numbers that took effect.
    pub effective: Vec<u64>,
    pub takeovers: Vec<bool>,
    pub ingests: Vec<Ingest>,
    pub subscriptions: Vec<SubscribeStart>,
    pub credits_returned: u32,
    run: u64,
    next_expected: u64,
}

#[derive(Clone, Default)]
pub(crate) struct FakeServer {
    record: Arc<Mutex<Record>>,
}

impl FakeServer {
    pub fn record(&self) -> MutexGuard<'_, Record> {
        self.record.lock().unwrap()
    }

    pub fn with_capture(script: impl IntoIterator<Item = Capture>) -> Self {
        let server = Self::default();
        server.record().capture_script = script.into_iter().collect();
        server.record().run = 1;
        server
    }

    pub fn with_curves(script: impl IntoIterator<Item = Curves>) -> Self {
        let server = Self::default();
        server.record().curve_script = script.into_iter().collect();
        server
    }

    /// A channel whose connections end in this server, without sockets.
    pub fn channel(&self) -> Channel {
        let (connections, accepted) = mpsc::channel::<io::Result<DuplexStream>>(8);
        let serving = Server::builder()
            .add_service(CaptureServiceServer::new(self.clone()))
            .add_service(CurveServiceServer::new(self.clone()))
            .serve_with_incoming(ReceiverStream::new(accepted));
        tokio::spawn(serving);
        let channel = Endpoint::from_static("http://fake").connect_with_connector_lazy(
            tower::service_fn(move |_| {
                let connections = connections.clone();
                async move {
                    let (ours, theirs) = tokio::io::duplex(1 << 16);
                    connections
                        .send(Ok(theirs))
                        .await
                        .map_err(io::Error::other)?;
                    Ok::<_, io::Error>(TokioIo::new(ours))
                }
            }),
        );
        Channel::new(channel, Bearer::new(None))
    }

    /// Takes one frame; false when the script breaks the stream now.
    fn take_frame(&self, capture: &Capture, number: u64, response: &mut PublishResponse) -> bool {
        let mut record = self.record();
        record.arrived.last_mut().unwrap().push(number);
        let n_arrived = record.arrived.last().unwrap().len();
        if let Capture::Reject(numbers) = capture
            && numbers.contains(&number)
        {
            response.rejected.push(RejectedFrame {
                number,
                reason: "NON_FINITE".to_owned(),
                detail: "marker 0 (chin): x is infinite".to_owned(),
            });
            return true;
        }
        if number >= record.next_expected {
            record.next_expected = number + 1;
            record.effective.push(number);
        }
        let (taken, acked) = match capture {
            Capture::Break { taken, acked, .. } => (*taken, *acked),
            _ => (usize::MAX, usize::MAX),
        };
        if n_arrived <= acked {
            response.accepted_through = number;
        }
        n_arrived < taken
    }
}

#[tonic::async_trait]
impl CaptureService for FakeServer {
    type PublishMarkersStream = Responses<PublishResponse>;
    type PublishImagesStream = Responses<PublishResponse>;

    async fn publish_markers(
        &self,
        request: Request<Streaming<PublishMarkersRequest>>,
    ) -> Result<Response<Self::PublishMarkersStream>, Status> {
        let mut requests = request.into_inner();
        let start = requests.message().await?.and_then(|it| it.start).unwrap();
        let (capture, started) = {
            let mut record = self.record();
            record.takeovers.push(start.takeover);
            record.ingests.push(start.ingest());
            let capture = record.capture_script.pop_front().unwrap();
            if let Capture::ServeNewRun = capture {
                record.run += 1;
                record.next_expected = 0;
            }
            record.arrived.push(Vec::new());
            let started = PublishStarted {
                epoch: record.arrived.len() as u64,
                next_expected: record.next_expected,
                durable_through: 0,
                run: record.run,
                ..PublishStarted::default()
            };
            (capture, started)
        };
        if let Capture::Refuse(status) = capture {
            return Err(status);
        }
        let (responses, receiver) = mpsc::channel(64);
        let first = PublishResponse {
            started: Some(started),
            ..PublishResponse::default()
        };
        responses.send(Ok(first)).await.unwrap();
        let server = self.clone();
        tokio::spawn(async move {
            while let Ok(Some(message)) = requests.message().await {
                let mut response = PublishResponse::default();
                let mut goes_on = true;
                for frame in message.frames {
                    goes_on = goes_on && server.take_frame(&capture, frame.number, &mut response);
                }
                // A client that left is not the script's concern.
                drop(responses.send(Ok(response)).await);
                if !goes_on && let Capture::Break { status, .. } = capture {
                    drop(responses.send(Err(status)).await);
                    return;
                }
            }
        });
        Ok(Response::new(ReceiverStream::new(receiver)))
    }

    async fn publish_images(
        &self,
        _: Request<Streaming<PublishImagesRequest>>,
    ) -> Result<Response<Self::PublishImagesStream>, Status> {
        Err(Status::unimplemented("images"))
    }
}

#[tonic::async_trait]
impl CurveService for FakeServer {
    type SubscribeStream = Responses<SubscribeResponse>;
    type FollowStream = Responses<SubscribeResponse>;

    async fn subscribe(
        &self,
        request: Request<Streaming<SubscribeRequest>>,
    ) -> Result<Response<Self::SubscribeStream>, Status> {
        let mut requests = request.into_inner();
        let start = requests.message().await?.and_then(|it| it.start).unwrap();
        let script = {
            let mut record = self.record();
            record.subscriptions.push(start);
            record.curve_script.pop_front().unwrap()
        };
        if script.responses.is_empty()
            && let Some(status) = script.status
        {
            return Err(status);
        }
        let (responses, receiver) = mpsc::channel(64);
        let server = self.clone();
        tokio::spawn(async move {
            for response in script.responses {
                responses.send(Ok(response)).await.unwrap();
            }
            if let Some(status) = script.status {
                responses.send(Err(status)).await.unwrap();
                return;
            }
            while let Some(Ok(message)) = requests.next().await {
                server.record().credits_returned += message.credits;
            }
            drop(responses);
        });
        Ok(Response::new(ReceiverStream::new(receiver)))
    }

    async fn follow(
        &self,
        _: Request<SubscribeStart>,
    ) -> Result<Response<Self::FollowStream>, Status> {
        Err(Status::unimplemented("follow"))
    }

    async fn read_curves(
        &self,
        _request: Request<crate::proto::ReadCurvesRequest>,
    ) -> Result<Response<crate::proto::ReadCurvesResponse>, Status> {
        Err(Status::unimplemented("not part of the fake"))
    }
}
