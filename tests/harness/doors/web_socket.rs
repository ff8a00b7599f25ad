//! A WebSocket of either direction and either form.

use frontalis_access::Token;
use futures::{SinkExt as _, StreamExt as _};
use prost::Message as Protobuf;
use serde::{Serialize, de::DeserializeOwned};
use tokio::net::TcpStream;
use tokio_tungstenite::{
    WebSocketStream, client_async,
    tungstenite::{self, Message, client::IntoClientRequest as _},
};

use super::to_json;
use crate::TestServer;

/// The client's end.
pub struct WebSocket {
    socket: WebSocketStream<TcpStream>,
    is_json: bool,
}

/// How the server closed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Closed {
    /// 0: without a close frame.
    pub code: u16,
    /// Of the close frame.
    pub reason: String,
    /// The last text's `error`.
    pub problem: Option<serde_json::Value>,
}

impl WebSocket {
    /// Opens the stream of session `id` with one subprotocol.
    ///
    /// # Errors
    ///
    /// The status of a refused handshake.
    pub async fn open(server: &TestServer, id: &str, subprotocol: &str) -> Result<Self, u16> {
        Self::open_as(server, None, id, subprotocol).await
    }

    /// The same with a token, beside the subprotocol as a browser does it.
    ///
    /// # Errors
    ///
    /// The status of a refused handshake.
    pub async fn open_as(
        server: &TestServer,
        token: Option<&Token>,
        id: &str,
        subprotocol: &str,
    ) -> Result<Self, u16> {
        let url = format!("ws://{}/api/v1/sessions/{id}/stream", server.address());
        let mut request = url.into_client_request().unwrap();
        let headers = request.headers_mut();
        let offered = match token {
            Some(token) => format!("{subprotocol}, frontalis.bearer.{}", token.reveal()),
            None => subprotocol.to_owned(),
        };
        headers.insert("sec-websocket-protocol", offered.parse().unwrap());
        let stream = TcpStream::connect(server.address()).await.unwrap();
        stream.set_nodelay(true).unwrap();
        match client_async(request, stream).await {
            Ok((socket, answer)) => {
                assert_eq!(answer.headers()["sec-websocket-protocol"], subprotocol);
                let is_json = subprotocol.ends_with("+json");
                Ok(Self { socket, is_json })
            }
            Err(tungstenite::Error::Http(answer)) => Err(answer.status().as_u16()),
            Err(error) => panic!("{error}"),
        }
    }

    /// Sends a message in the form of the subprotocol.
    pub async fn send<M: Protobuf + Serialize>(&mut self, message: &M) {
        let message = if self.is_json {
            Message::text(to_json(message))
        } else {
            Message::binary(message.encode_to_vec())
        };
        self.send_raw(message).await;
    }

    /// Sends anything.
    pub async fn send_raw(&mut self, message: Message) {
        drop(self.socket.send(message).await);
    }

    /// The next message; pings are answered on the way.
    ///
    /// # Errors
    ///
    /// How the server closed.
    pub async fn next<M: Protobuf + Default + DeserializeOwned>(&mut self) -> Result<M, Closed> {
        let mut problem = None;
        loop {
            match self.socket.next().await {
                Some(Ok(Message::Text(text))) => {
                    let mut value: serde_json::Value = serde_json::from_str(&text).unwrap();
                    if let Some(error) = value.get_mut("error") {
                        problem = Some(error.take());
                    } else {
                        assert!(self.is_json, "text where binary is due");
                        return Ok(serde_json::from_str(&text).unwrap());
                    }
                }
                Some(Ok(Message::Binary(bytes))) => {
                    assert!(!self.is_json, "binary where text is due");
                    return Ok(M::decode(bytes).unwrap());
                }
                Some(Ok(Message::Close(Some(frame)))) => {
                    return Err(Closed {
                        code: frame.code.into(),
                        reason: frame.reason.to_string(),
                        problem,
                    });
                }
                Some(Ok(_)) => {}
                Some(Err(_)) | None => {
                    return Err(Closed {
                        problem,
                        ..Closed::default()
                    });
                }
            }
        }
    }

    /// Says goodbye and waits until the server has closed.
    pub async fn close(mut self) {
        drop(self.socket.close(None).await);
        while let Some(Ok(_)) = self.socket.next().await {}
    }
}
