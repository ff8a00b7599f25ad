//! gRPC-web over HTTP/1.1: length-prefixed messages, and the trailers as the last of them.

use frontalis_access::Token;
use frontalis_proto::v1::{SubscribeResponse, SubscribeStart};
use http_body_util::Full;
use hyper::{Request, body::Bytes};
use prost::Message as _;

use super::{Pieces, exchange};
use crate::TestServer;

/// The flag of the frame that holds the trailers.
const TRAILERS: u8 = 0x80;

/// The client's end of a call with one request and many answers.
pub struct GrpcWeb {
    pieces: Pieces,
    /// The trailers, once they are there; or those of an answer that has nothing else.
    pub trailers: String,
}

impl GrpcWeb {
    /// Calls `CurveService.Follow`.
    pub async fn follow(server: &TestServer, start: &SubscribeStart) -> Self {
        Self::follow_as(server, None, start).await
    }

    /// The same with a token.
    pub async fn follow_as(
        server: &TestServer,
        token: Option<&Token>,
        start: &SubscribeStart,
    ) -> Self {
        let message = start.encode_to_vec();
        let n_bytes = u32::try_from(message.len()).unwrap();
        let body = [&[0], &n_bytes.to_be_bytes()[..], &message].concat();
        let request = Request::post("/frontalis.v1.CurveService/Follow")
            .header("content-type", "application/grpc-web+proto")
            .header("x-grpc-web", "1");
        let answer = exchange(server, token, request, Full::new(Bytes::from(body))).await;
        assert_eq!(answer.status(), 200);
        assert_eq!(
            answer.headers()["content-type"],
            "application/grpc-web+proto"
        );
        let headers = answer.headers().iter();
        let trailers = headers.filter(|(name, _)| name.as_str().starts_with("grpc-"));
        let line = |(name, value): (&http::HeaderName, &http::HeaderValue)| {
            format!("{name}:{}\r\n", value.to_str().unwrap())
        };
        Self {
            trailers: trailers.map(line).collect(),
            pieces: Pieces::new(answer.into_body()),
        }
    }

    /// The next answer; `None` when the trailers came.
    pub async fn next(&mut self) -> Option<SubscribeResponse> {
        let prefix = self.pieces.exactly(5).await?;
        let n_bytes = u32::from_be_bytes(prefix[1..5].try_into().unwrap());
        let message = self.pieces.exactly(n_bytes as usize).await?;
        if prefix[0] & TRAILERS != 0 {
            self.trailers = String::from_utf8(message).unwrap();
            return None;
        }
        Some(SubscribeResponse::decode(message.as_slice()).unwrap())
    }
}
