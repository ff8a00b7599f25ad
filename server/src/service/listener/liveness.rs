//! How a connection whose peer has vanished is found, whatever it speaks (CONTRACTS D-25, BAD_INPUT F3).
//!
//! HTTP/2 has pings of its own. HTTP/1 that streams, and what it is upgraded to, rely on the system: a connection on
//! which nothing is on its way is probed by it, any other is [`Watched`]. A peer that lives and does not read is no such
//! peer, and is kept (D-15).

use std::{io, time::Duration};

use socket2::{SockRef, TcpKeepalive};
use tokio::net::TcpStream;

use super::watched::Watched;
use crate::config::Transport;

/// Probes of a silent connection within the time for an answer.
const N_PROBES: u32 = 5;

/// What is set on every connection.
#[derive(Clone, Debug)]
pub(super) struct Liveness {
    probes: TcpKeepalive,
    patience: Duration,
}

impl Liveness {
    pub(super) fn new(transport: &Transport) -> Self {
        let interval = Duration::from_secs(transport.keepalive_interval_secs);
        let timeout = Duration::from_secs(transport.keepalive_timeout_secs);
        // The system counts in whole seconds.
        let between = (timeout / N_PROBES).max(Duration::from_secs(1));
        Self {
            probes: TcpKeepalive::new()
                .with_time(interval)
                .with_interval(between)
                .with_retries(N_PROBES),
            patience: interval + timeout,
        }
    }

    /// # Errors
    ///
    /// When the connection is gone already.
    pub(super) fn set(&self, stream: &TcpStream) -> io::Result<()> {
        // Samples are small and late ones worthless: nothing may wait for more to send.
        stream.set_nodelay(true)?;
        let socket = SockRef::from(stream);
        socket.set_tcp_keepalive(&self.probes)
    }

    /// From here on a vanished peer is found while something is on its way to it, too.
    pub(super) fn watch(&self, stream: TcpStream) -> Watched {
        Watched::new(stream, self.patience)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn a_connection_is_given_up_after_fifteen_seconds_unless_configured_otherwise() {
        let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
        let stream = TcpStream::connect(listener.local_addr().unwrap())
            .await
            .unwrap();
        Liveness::new(&Transport::default()).set(&stream).unwrap();
        let socket = SockRef::from(&stream);
        assert!(stream.nodelay().unwrap());
        assert!(socket.keepalive().unwrap());
        assert_eq!(socket.tcp_keepalive_time().unwrap(), Duration::from_secs(5));
        let probing =
            socket.tcp_keepalive_interval().unwrap() * socket.tcp_keepalive_retries().unwrap();
        assert_eq!(probing, Duration::from_secs(10));
        // It would end a connection whose peer lives and does not read.
        #[cfg(target_os = "linux")]
        assert_eq!(socket.tcp_user_timeout().unwrap(), None);
    }
}
