//! Plain HTTP against the server's one port.

use http_body_util::{BodyExt as _, Full};
use hyper::{HeaderMap, Method, Request, StatusCode, body::Bytes, client::conn::http1};
use hyper_util::rt::TokioIo;
use serde_json::Value;
use tokio::net::TcpStream;

use crate::TestServer;

/// An answer over HTTP/1.1.
#[derive(Clone, Debug)]
pub struct HttpAnswer {
    /// The status.
    pub status: StatusCode,
    /// The headers.
    pub headers: HeaderMap,
    /// The content type; empty when there is none.
    pub content_type: String,
    /// The body.
    pub body: Bytes,
}

impl HttpAnswer {
    /// The body as JSON.
    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap()
    }

    /// The body as text.
    pub fn text(&self) -> &str {
        std::str::from_utf8(&self.body).unwrap()
    }
}

/// `GET path` on a connection of its own.
pub async fn http_get(server: &TestServer, path: &str) -> HttpAnswer {
    http_send(server, &Method::GET, path, &[], b"").await
}

/// Any request on a connection of its own, over HTTP/1.1; the host is the address unless the headers name another.
pub async fn http_send(
    server: &TestServer,
    method: &Method,
    path: &str,
    headers: &[(&str, &str)],
    body: &[u8],
) -> HttpAnswer {
    let stream = TcpStream::connect(server.address()).await.unwrap();
    let (mut sender, connection) = http1::handshake(TokioIo::new(stream)).await.unwrap();
    // The server may close first, when it refuses a body that it did not read.
    let connection = tokio::spawn(async move { drop(connection.await) });
    let mut request = Request::builder().method(method).uri(path);
    if headers.iter().all(|(name, _)| *name != "host") {
        request = request.header("host", server.address().to_string());
    }
    for (name, value) in headers {
        request = request.header(*name, *value);
    }
    let body = Full::new(Bytes::copy_from_slice(body));
    let answer = sender
        .send_request(request.body(body).unwrap())
        .await
        .unwrap();
    let status = answer.status();
    let headers = answer.headers().clone();
    let content_type = headers
        .get("content-type")
        .map_or_else(String::new, |it| it.to_str().unwrap().to_owned());
    let body = answer.into_body().collect().await.unwrap().to_bytes();
    drop(sender);
    connection.await.unwrap();
    HttpAnswer {
        status,
        headers,
        content_type,
        body,
    }
}
