//! HTTP/2 as frames written by hand (RFC 9113), so that a test can send what no library would.

use std::net::SocketAddr;

use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _},
    net::TcpStream,
    time::{Duration, Instant, timeout},
};

/// What every connection begins with.
pub const PREFACE: &[u8] = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";

/// No test waits longer for the end of a connection.
const PATIENCE: Duration = Duration::from_mins(1);

/// What is read at once.
const READ_BYTES: usize = 16 * 1024;

/// Types of frames.
#[expect(missing_docs, reason = "the names are those of the standard")]
pub mod kind {
    pub const DATA: u8 = 0x0;
    pub const HEADERS: u8 = 0x1;
    pub const PRIORITY: u8 = 0x2;
    pub const RST_STREAM: u8 = 0x3;
    pub const SETTINGS: u8 = 0x4;
    pub const PING: u8 = 0x6;
    pub const GOAWAY: u8 = 0x7;
    pub const WINDOW_UPDATE: u8 = 0x8;
    pub const CONTINUATION: u8 = 0x9;
}

/// Flags of frames.
#[expect(missing_docs, reason = "the names are those of the standard")]
pub mod flag {
    pub const END_STREAM: u8 = 0x1;
    pub const ACK: u8 = 0x1;
    pub const END_HEADERS: u8 = 0x4;
    pub const PADDED: u8 = 0x8;
}

/// A frame that the server sent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// One of [`kind`].
    pub kind: u8,
    /// Of [`flag`].
    pub flags: u8,
    /// 0: the connection.
    pub stream: u32,
    /// What follows the header.
    pub content: Vec<u8>,
}

/// A frame as it goes over the wire.
pub fn frame(kind: u8, flags: u8, stream: u32, content: &[u8]) -> Vec<u8> {
    let length = u32::try_from(content.len()).unwrap().to_be_bytes();
    let mut bytes = length[1..].to_vec();
    bytes.extend([kind, flags]);
    bytes.extend(stream.to_be_bytes());
    bytes.extend(content);
    bytes
}

/// The header block of a request without a dictionary's entries of its own (RFC 7541): `GET` or `POST` of a path.
pub fn request_block(method: &str, path: &str) -> Vec<u8> {
    let method = if method == "GET" { 0x82 } else { 0x83 };
    // 0x86: `:scheme http`; 0x01 and 0x04: literal values of `:authority` and `:path`.
    let mut block = vec![method, 0x86, 0x01, 9];
    block.extend(b"localhost");
    block.push(0x04);
    block.push(u8::try_from(path.len()).unwrap());
    block.extend(path.bytes());
    block
}

/// One more header of a block, as a literal that is not remembered.
pub fn literal(name: &str, value: &str) -> Vec<u8> {
    let mut bytes = vec![0x00];
    for text in [name, value] {
        bytes.push(u8::try_from(text.len()).unwrap());
        bytes.extend(text.bytes());
    }
    bytes
}

/// A whole request without a body.
pub fn get(stream: u32, path: &str) -> Vec<u8> {
    let flags = flag::END_STREAM | flag::END_HEADERS;
    frame(kind::HEADERS, flags, stream, &request_block("GET", path))
}

/// How a connection ended, and what came before.
#[derive(Debug)]
pub struct Ended {
    /// What the server sent.
    pub frames: Vec<Frame>,
    /// From the call to the end.
    pub after: Duration,
}

impl Ended {
    /// The error codes of the GOAWAY frames, in order.
    pub fn goaways(&self) -> Vec<u32> {
        let code = |it: &Frame| u32::from_be_bytes(it.content[4..8].try_into().unwrap());
        self.of(kind::GOAWAY).map(code).collect()
    }

    /// The error code of each stream that was reset.
    pub fn resets(&self) -> Vec<(u32, u32)> {
        let reset = |it: &Frame| {
            (
                it.stream,
                u32::from_be_bytes(it.content[..4].try_into().unwrap()),
            )
        };
        self.of(kind::RST_STREAM).map(reset).collect()
    }

    fn of(&self, kind: u8) -> impl Iterator<Item = &Frame> {
        self.frames.iter().filter(move |it| it.kind == kind)
    }
}

/// A connection that says what it is told to.
pub struct RawHttp2 {
    stream: TcpStream,
    received: Vec<u8>,
}

impl RawHttp2 {
    /// Connects, and begins as a client does, with settings of its own.
    pub async fn open(address: SocketAddr, settings: &[u8]) -> Self {
        let stream = TcpStream::connect(address).await.unwrap();
        stream.set_nodelay(true).unwrap();
        let mut raw = Self {
            stream,
            received: Vec::new(),
        };
        let hello = [PREFACE, &frame(kind::SETTINGS, 0, 0, settings)].concat();
        assert!(raw.send(&hello).await);
        raw
    }

    /// Sends; false: the server has closed.
    pub async fn send(&mut self, bytes: &[u8]) -> bool {
        self.stream.write_all(bytes).await.is_ok()
    }

    /// Sends the same again and again, without reading, until the server closes or so many bytes are sent; how many were.
    pub async fn flood(&mut self, bytes: &[u8], most: usize) -> usize {
        let block = bytes.repeat((64 * 1024 / bytes.len()).max(1));
        let mut n_sent = 0;
        while n_sent < most {
            match timeout(PATIENCE, self.stream.write(&block)).await.unwrap() {
                Ok(n) if n == block.len() => n_sent += n,
                // A frame that was cut is finished, so that the next begins where one may.
                Ok(n) => {
                    n_sent += n;
                    let rest = timeout(PATIENCE, self.stream.write_all(&block[n..])).await;
                    if rest.unwrap().is_err() {
                        break;
                    }
                    n_sent += block.len() - n;
                }
                Err(_) => break,
            }
        }
        n_sent
    }

    /// Floods and reads at once, until the server closes.
    pub async fn flood_and_read(self, bytes: &[u8]) -> Ended {
        let (mut incoming, mut outgoing) = self.stream.into_split();
        let block = bytes.repeat(64 * 1024 / bytes.len());
        let flood = async { while outgoing.write_all(&block).await.is_ok() {} };
        let mut received = Vec::new();
        let read = timeout(PATIENCE, incoming.read_to_end(&mut received));
        // A reset is a close too.
        let ((), read) = tokio::join!(flood, read);
        drop(read.unwrap());
        Self::ended(received)
    }

    /// The next frame; none when the server has closed.
    pub async fn next(&mut self) -> Option<Frame> {
        loop {
            if let Some(frame) = self.take_frame() {
                return Some(frame);
            }
            self.received.reserve(READ_BYTES);
            let read = self.stream.read_buf(&mut self.received);
            match timeout(PATIENCE, read).await.unwrap() {
                Ok(n) if n > 0 => {}
                // A reset is a close too.
                _ => return None,
            }
        }
    }

    /// Reads until the server closes; pings and settings stay unanswered.
    pub async fn until_closed(mut self) -> Ended {
        let began = Instant::now();
        let mut frames = Vec::new();
        while let Some(frame) = self.next().await {
            frames.push(frame);
        }
        Ended {
            frames,
            after: began.elapsed(),
        }
    }

    fn take_frame(&mut self) -> Option<Frame> {
        take_frame(&mut self.received)
    }

    fn ended(mut received: Vec<u8>) -> Ended {
        Ended {
            frames: std::iter::from_fn(|| take_frame(&mut received)).collect(),
            after: Duration::ZERO,
        }
    }
}

/// Takes the first whole frame out of what was received.
pub fn take_frame(received: &mut Vec<u8>) -> Option<Frame> {
    let [a, b, c, kind, flags, s0, s1, s2, s3] = *received.first_chunk::<9>()?;
    let length = u32::from_be_bytes([0, a, b, c]) as usize;
    if received.len() < 9 + length {
        return None;
    }
    let content = received[9..9 + length].to_vec();
    received.drain(..9 + length);
    Some(Frame {
        kind,
        flags,
        stream: u32::from_be_bytes([s0, s1, s2, s3]),
        content,
    })
}
