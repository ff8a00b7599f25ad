//! Every way in but gRPC, with as little of a client as there can be: bytes out, messages back.

mod costs;
mod events;
mod grpc_web;
mod lines;
mod socket_frames;
mod stalled;
mod web_socket;

pub use costs::DoorCosts;
pub use events::{Event, EventStream};
pub use grpc_web::GrpcWeb;
pub use lines::LinePublisher;
pub use socket_frames::{SocketFrame, SocketFrames};
pub use stalled::StalledDoors;
pub use web_socket::{Closed, WebSocket};

use frontalis_access::Token;
use frontalis_proto::v1::{CurveEnd, CurveHeader, CurveSample, Gap, SubscribeResponse};
use http_body_util::BodyExt as _;
use hyper::{
    Request, Response,
    body::{Body, Bytes, Incoming},
    client::conn::http1,
};
use hyper_util::rt::TokioIo;
use tokio::net::TcpStream;

use crate::{HttpAnswer, TestServer};

/// One request over HTTP/1.1 on a connection of its own, which lives as long as the answer; with a token or none.
async fn exchange<B>(
    server: &TestServer,
    token: Option<&Token>,
    request: http::request::Builder,
    body: B,
) -> Response<Incoming>
where
    B: Body<Data = Bytes> + Send + 'static,
    B::Error: Into<Box<dyn std::error::Error + Send + Sync>>,
{
    let stream = TcpStream::connect(server.address()).await.unwrap();
    stream.set_nodelay(true).unwrap();
    let (mut sender, connection) = http1::handshake(TokioIo::new(stream)).await.unwrap();
    tokio::spawn(connection);
    let mut request = request.header("host", server.address().to_string());
    if let Some(token) = token {
        request = request.header("authorization", format!("Bearer {}", token.reveal()));
    }
    let request: Request<B> = request.body(body).unwrap();
    sender.send_request(request).await.unwrap()
}

/// An answer that is no stream.
async fn whole(answer: Response<Incoming>) -> HttpAnswer {
    let (parts, body) = answer.into_parts();
    let kind = parts.headers.get("content-type");
    HttpAnswer {
        status: parts.status,
        content_type: kind.map_or_else(String::new, |it| it.to_str().unwrap().to_owned()),
        body: body.collect().await.unwrap().to_bytes(),
        headers: parts.headers,
    }
}

/// A publisher's message as a client writes it: `NaN` as protobuf JSON spells it, which the server's own encoder, that
/// sends none, does not.
fn to_json(message: &impl serde::Serialize) -> String {
    let text = serde_json::to_string(message).unwrap();
    text.replace("null", "\"NaN\"")
}

/// A body that is read piece by piece.
struct Pieces {
    body: Incoming,
    held: Vec<u8>,
}

impl Pieces {
    fn new(body: Incoming) -> Self {
        Self {
            body,
            held: Vec::new(),
        }
    }

    /// Everything up to and with `end`, or none when the body ends before.
    async fn through(&mut self, end: &[u8]) -> Option<Vec<u8>> {
        loop {
            let found = self.held.windows(end.len()).position(|it| it == end);
            if let Some(n) = found {
                return Some(self.take(n + end.len()));
            }
            self.more().await?;
        }
    }

    /// So many bytes, or none when the body ends before.
    async fn exactly(&mut self, n: usize) -> Option<Vec<u8>> {
        while self.held.len() < n {
            self.more().await?;
        }
        Some(self.take(n))
    }

    fn take(&mut self, n: usize) -> Vec<u8> {
        let rest = self.held.split_off(n);
        std::mem::replace(&mut self.held, rest)
    }

    async fn more(&mut self) -> Option<()> {
        let frame = self.body.frame().await?.ok()?;
        if let Ok(data) = frame.into_data() {
            self.held.extend_from_slice(&data);
        }
        Some(())
    }
}

/// What a subscriber got of a session, whichever way.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Received {
    /// Of the first answer.
    pub header: Option<CurveHeader>,
    /// In order.
    pub samples: Vec<CurveSample>,
    /// In order.
    pub gaps: Vec<Gap>,
    /// Once the session has ended.
    pub end: Option<CurveEnd>,
}

impl Received {
    /// Takes an answer in.
    pub fn take(&mut self, answer: SubscribeResponse) {
        self.header = self.header.take().or(answer.header);
        self.samples.extend(answer.samples);
        self.gaps.extend(answer.gaps);
        self.end = answer.end;
    }
}
