//! A WebSocket frame by frame, for frames that no library sends.

use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _, BufReader},
    net::TcpStream,
};

use crate::TestServer;

/// The client's end of a bare connection that was upgraded.
pub struct SocketFrames {
    stream: BufReader<TcpStream>,
}

/// One frame of the server.
#[derive(Clone, Debug, PartialEq)]
pub enum SocketFrame {
    /// A whole text message.
    Text(String),
    /// Code and reason.
    Close(u16, String),
    /// Anything else.
    Other,
}

impl SocketFrames {
    /// Opens the stream of session `id`.
    pub async fn open(server: &TestServer, id: &str, subprotocol: &str) -> Self {
        let stream = TcpStream::connect(server.address()).await.unwrap();
        let mut stream = BufReader::new(stream);
        let request = Self::handshake(server, id, subprotocol);
        stream.write_all(request.as_bytes()).await.unwrap();
        let mut head = Vec::new();
        while !head.ends_with(b"\r\n\r\n") {
            head.push(stream.read_u8().await.unwrap());
        }
        let head = String::from_utf8(head).unwrap();
        assert!(head.starts_with("HTTP/1.1 101"), "{head}");
        // The accept value of the key above (RFC 6455, section 1.3).
        assert!(head.contains("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), "{head}");
        Self { stream }
    }

    /// The request that asks for the upgrade.
    pub fn handshake(server: &TestServer, id: &str, subprotocol: &str) -> String {
        format!(
            "GET /api/v1/sessions/{id}/stream HTTP/1.1\r\nHost: {}\r\nConnection: Upgrade\r\n\
             Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n\
             Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\
             Sec-WebSocket-Protocol: {subprotocol}\r\n\r\n",
            server.address()
        )
    }

    /// A masked frame with this first byte; its mask is zero.
    pub fn frame(first: u8, payload: &[u8]) -> Vec<u8> {
        let mut frame = vec![first];
        match u16::try_from(payload.len()) {
            Ok(n @ 0..=125) => frame.push(0x80 | u8::try_from(n).unwrap()),
            Ok(n) => {
                frame.push(0xfe);
                frame.extend(n.to_be_bytes());
            }
            Err(_) => {
                frame.push(0xff);
                frame.extend((payload.len() as u64).to_be_bytes());
            }
        }
        frame.extend([0; 4]);
        frame.extend(payload);
        frame
    }

    /// Sends any bytes.
    ///
    /// # Errors
    ///
    /// When the connection is gone.
    pub async fn send(&mut self, bytes: &[u8]) -> std::io::Result<()> {
        self.stream.write_all(bytes).await
    }

    /// The next frame.
    pub async fn next(&mut self) -> SocketFrame {
        let first = self.stream.read_u8().await.unwrap();
        let n = match self.stream.read_u8().await.unwrap() {
            126 => u64::from(self.stream.read_u16().await.unwrap()),
            127 => self.stream.read_u64().await.unwrap(),
            n => u64::from(n),
        };
        let mut payload = vec![0; usize::try_from(n).unwrap()];
        self.stream.read_exact(&mut payload).await.unwrap();
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
        match first {
            0x81 => SocketFrame::Text(text(&payload)),
            0x88 => {
                let code = u16::from_be_bytes([payload[0], payload[1]]);
                SocketFrame::Close(code, text(&payload[2..]))
            }
            _ => SocketFrame::Other,
        }
    }
}
