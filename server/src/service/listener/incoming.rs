//! Where connections come from: a port, or whoever hands over streams in its place.

use std::{io, net::SocketAddr};

use tokio::{
    io::{AsyncRead, AsyncWrite},
    net::{TcpListener, TcpStream},
    sync::mpsc,
};

/// A stream of bytes in both directions.
pub trait ByteStream: AsyncRead + AsyncWrite + Unpin + Send {}

impl<T: AsyncRead + AsyncWrite + Unpin + Send> ByteStream for T {}

/// Where a server's connections come from.
pub enum Incoming {
    /// A bound port.
    Port(TcpListener),
    /// A network that is simulated: streams and where they come from.
    Streams(mpsc::Receiver<(Box<dyn ByteStream>, SocketAddr)>),
}

/// A connection that has just come in.
pub(super) enum Accepted {
    Socket(TcpStream),
    Stream(Box<dyn ByteStream>),
}

impl Incoming {
    /// The next connection. May be dropped while it waits.
    pub(super) async fn accept(&mut self) -> io::Result<(Accepted, SocketAddr)> {
        match self {
            Self::Port(port) => {
                let (socket, peer) = port.accept().await?;
                Ok((Accepted::Socket(socket), peer))
            }
            Self::Streams(streams) => match streams.recv().await {
                Some((stream, peer)) => Ok((Accepted::Stream(stream), peer)),
                None => std::future::pending().await,
            },
        }
    }
}
