//! gRPC as bytes on HTTP/2 streams, so that a test can send what no client library would.

use std::net::SocketAddr;

use bytes::Bytes;
use h2::{
    RecvStream, SendStream,
    client::{ResponseFuture, SendRequest},
};
use http::{HeaderMap, Method, Request, StatusCode, header};
use prost::Message;
use tokio::{net::TcpStream, task::JoinHandle};
use tonic::{Code, Status};

use crate::TestServer;

/// Flag of the frame in which gRPC-web sends its trailers.
const WEB_TRAILERS: u8 = 0x80;

/// A message as it goes over the wire: no flag, its length, its bytes.
pub fn framed(content: &[u8]) -> Vec<u8> {
    prefixed(0, u32::try_from(content.len()).unwrap(), content)
}

/// A protobuf message as it goes over the wire.
pub fn encoded(message: &impl Message) -> Vec<u8> {
    framed(&message.encode_to_vec())
}

/// Any flag and any length before any bytes.
pub fn prefixed(flag: u8, length: u32, content: &[u8]) -> Vec<u8> {
    [&[flag][..], &length.to_be_bytes(), content].concat()
}

/// An HTTP/2 connection on which calls are made byte by byte.
pub struct RawConnection {
    requests: SendRequest<Bytes>,
    address: SocketAddr,
    driver: JoinHandle<()>,
}

/// One call.
pub struct RawCall {
    outgoing: SendStream<Bytes>,
    response: ResponseFuture,
}

/// What a call was answered with.
#[derive(Debug)]
pub struct RawAnswer {
    /// The HTTP status.
    pub http: StatusCode,
    /// The response's headers.
    pub headers: HeaderMap,
    /// Everything in the body.
    pub body: Vec<u8>,
    trailers: HeaderMap,
}

impl Drop for RawConnection {
    fn drop(&mut self) {
        self.driver.abort();
    }
}

impl RawConnection {
    /// A connection of its own.
    pub async fn open(server: &TestServer) -> Self {
        let address = server.address();
        let stream = TcpStream::connect(address).await.unwrap();
        stream.set_nodelay(true).unwrap();
        let (requests, connection) = h2::client::handshake(stream).await.unwrap();
        // The server may end the connection; a test finds that in its calls.
        let driver = tokio::spawn(async move { drop(connection.await) });
        Self {
            requests,
            address,
            driver,
        }
    }

    /// Begins a call with a gRPC client's headers and others beside or in place of them.
    pub async fn call(&mut self, path: &str, headers: &[(&str, &str)]) -> RawCall {
        self.request(&Method::POST, path, headers).await
    }

    /// The same with any method.
    pub async fn request(
        &mut self,
        method: &Method,
        path: &str,
        headers: &[(&str, &str)],
    ) -> RawCall {
        let mut request = Request::builder()
            .method(method)
            .uri(format!("http://{}{path}", self.address))
            .header(header::CONTENT_TYPE, "application/grpc")
            .header(header::TE, "trailers")
            .body(())
            .unwrap();
        for (name, value) in headers {
            let name: header::HeaderName = name.parse().unwrap();
            request.headers_mut().insert(name, value.parse().unwrap());
        }
        let mut requests = self.requests.clone().ready().await.unwrap();
        let (response, outgoing) = requests.send_request(request, false).unwrap();
        RawCall { outgoing, response }
    }

    /// One call with these bytes as its whole request.
    pub async fn answer(&mut self, path: &str, bytes: &[u8]) -> RawAnswer {
        let mut call = self.call(path, &[]).await;
        call.send(bytes).await;
        call.finish();
        call.answer().await
    }
}

impl RawCall {
    /// Sends bytes as fast as the server takes them; what it no longer takes is dropped.
    pub async fn send(&mut self, bytes: &[u8]) {
        let mut rest = Bytes::copy_from_slice(bytes);
        while !rest.is_empty() {
            self.outgoing.reserve_capacity(rest.len());
            let room = std::future::poll_fn(|cx| self.outgoing.poll_capacity(cx)).await;
            let Some(Ok(n_bytes)) = room else { return };
            let part = rest.split_to(rest.len().min(n_bytes));
            if self.outgoing.send_data(part, false).is_err() {
                return;
            }
        }
    }

    /// Closes the request's side.
    pub fn finish(&mut self) {
        drop(self.outgoing.send_data(Bytes::new(), true));
    }

    /// Breaks the call off.
    pub fn cancel(mut self) {
        self.outgoing.send_reset(h2::Reason::CANCEL);
    }

    /// Waits for the answer's head; its body follows in pieces. The request's side stays open as long as it is held.
    pub async fn begin_answer(self) -> (SendStream<Bytes>, http::Response<RecvStream>) {
        (self.outgoing, self.response.await.unwrap())
    }

    /// Reads the answer to its end.
    pub async fn answer(self) -> RawAnswer {
        let (_outgoing, response) = self.begin_answer().await;
        let (head, mut incoming) = response.into_parts();
        let mut body = Vec::new();
        while let Some(bytes) = incoming.data().await {
            let bytes = bytes.unwrap();
            incoming
                .flow_control()
                .release_capacity(bytes.len())
                .unwrap();
            body.extend(bytes);
        }
        let trailers = incoming.trailers().await.unwrap().unwrap_or_default();
        RawAnswer {
            http: head.status,
            headers: head.headers,
            body,
            trailers,
        }
    }
}

impl RawAnswer {
    /// The call's status: in the headers, in the trailers, or in the last frame of gRPC-web.
    pub fn status(&self) -> Status {
        Status::from_header_map(&self.headers)
            .or_else(|| Status::from_header_map(&self.trailers))
            .or_else(|| Status::from_header_map(&web_trailers(&self.body)))
            .unwrap_or_else(|| Status::new(Code::Unknown, format!("no status: {self:?}")))
    }
}

/// The trailers in the last frame of a gRPC-web body.
fn web_trailers(body: &[u8]) -> HeaderMap {
    let mut rest = body;
    while let Some(([flag, length @ ..], behind)) = rest.split_first_chunk::<5>() {
        let length = u32::from_be_bytes(*length) as usize;
        let (content, behind) = behind.split_at(length.min(behind.len()));
        if *flag == WEB_TRAILERS {
            let text = std::str::from_utf8(content).unwrap();
            let lines = text.lines().filter_map(|it| it.split_once(':'));
            return lines
                .map(|(name, value)| (name.parse().unwrap(), value.trim().parse().unwrap()))
                .collect::<Vec<(header::HeaderName, header::HeaderValue)>>()
                .into_iter()
                .collect();
        }
        rest = behind;
    }
    HeaderMap::new()
}
