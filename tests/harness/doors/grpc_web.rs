//! gRPC-web over HTTP/1.1: length-prefixed messages, and the trailers as the last of them; as bytes, or as base64 text.

use base64::{Engine as _, engine::general_purpose::STANDARD};
use frontalis_access::Token;
use frontalis_proto::v1::{SubscribeResponse, SubscribeStart};
use http_body_util::Full;
use hyper::{Request, body::Bytes};
use prost::Message as _;

use super::{Pieces, exchange};
use crate::{TestServer, encoded};

/// The flag of the frame that holds the trailers.
const TRAILERS: u8 = 0x80;

/// The client's end of a call with one request and many answers.
pub struct GrpcWeb {
    pieces: Pieces,
    /// What was read of the text form and not yet taken.
    decoded: Option<Vec<u8>>,
    /// The trailers, once they are there; or those of an answer that has nothing else.
    pub trailers: String,
}

impl GrpcWeb {
    /// Calls `CurveService.Follow` with messages as bytes.
    pub async fn follow(server: &TestServer, start: &SubscribeStart) -> Self {
        Self::follow_as(server, None, start).await
    }

    /// The same with a token.
    pub async fn follow_as(
        server: &TestServer,
        token: Option<&Token>,
        start: &SubscribeStart,
    ) -> Self {
        let body = encoded(start);
        Self::call(server, token, "application/grpc-web+proto", body).await
    }

    /// The same with messages as text, which is what browsers without binary streams send.
    pub async fn follow_as_text(server: &TestServer, start: &SubscribeStart) -> Self {
        let body = STANDARD.encode(encoded(start)).into_bytes();
        let mut web = Self::call(server, None, "application/grpc-web-text+proto", body).await;
        web.decoded = Some(Vec::new());
        web
    }

    async fn call(server: &TestServer, token: Option<&Token>, kind: &str, body: Vec<u8>) -> Self {
        let request = Request::post("/frontalis.v1.CurveService/Follow")
            .header("content-type", kind)
            .header("accept", kind)
            .header("x-grpc-web", "1");
        let answer = exchange(server, token, request, Full::new(Bytes::from(body))).await;
        assert_eq!(answer.status(), 200);
        assert_eq!(answer.headers()["content-type"], kind);
        let headers = answer.headers().iter();
        let trailers = headers.filter(|(name, _)| name.as_str().starts_with("grpc-"));
        let line = |(name, value): (&http::HeaderName, &http::HeaderValue)| {
            format!("{name}:{}\r\n", value.to_str().unwrap())
        };
        Self {
            trailers: trailers.map(line).collect(),
            pieces: Pieces::new(answer.into_body()),
            decoded: None,
        }
    }

    /// The next answer; `None` when the trailers came.
    pub async fn next(&mut self) -> Option<SubscribeResponse> {
        let prefix = self.exactly(5).await?;
        let n_bytes = u32::from_be_bytes(prefix[1..5].try_into().unwrap());
        let message = self.exactly(n_bytes as usize).await?;
        if prefix[0] & TRAILERS != 0 {
            self.trailers = String::from_utf8(message).unwrap();
            return None;
        }
        Some(SubscribeResponse::decode(message.as_slice()).unwrap())
    }

    async fn exactly(&mut self, n: usize) -> Option<Vec<u8>> {
        let Some(decoded) = &mut self.decoded else {
            return self.pieces.exactly(n).await;
        };
        while decoded.len() < n {
            // Each piece of the answer is text of its own, padded to groups of four.
            let group = self.pieces.exactly(4).await?;
            decoded.extend(STANDARD.decode(group).unwrap());
        }
        let rest = decoded.split_off(n);
        Some(std::mem::replace(decoded, rest))
    }
}
