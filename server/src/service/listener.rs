//! Accepts connections and serves HTTP/1 and HTTP/2 on them, within limits (CONTRACTS O-1, D-20, D-25, S-9).
//!
//! The loop outlives whatever the system or a peer does: a failing `accept` backs off and goes on, a connection beyond
//! a limit is closed at once, one that does not begin to speak is closed after a deadline, one whose peer has vanished
//! after an unanswered ping, one that floods as soon as it does.

mod admission;
mod connection;
mod frames;
mod http1_framing;
mod inbound;
mod incoming;
mod lingering;
mod liveness;
mod open_connection;
pub mod tls;
mod watched;

use std::{io, net::SocketAddr, time::Duration};

use axum::Router;
use tokio::net::{TcpListener, TcpSocket};
use tokio_util::task::TaskTracker;

use super::audit::Audit;
use crate::{
    config::{Config, Transport},
    shutdown::Phases,
    telemetry::Metrics,
};
use admission::Admission;
use connection::Connections;
use tls::Tls;

pub use frames::ControlFrame;
pub use incoming::{ByteStream, Incoming};
pub use open_connection::OpenConnection;
pub use tls::PeerCertificate;

/// Connections that the system may hold before they are accepted.
const BACKLOG: u32 = 1_024;

/// First and longest pause after the system could not hand over a connection.
const BACK_OFF: [Duration; 2] = [Duration::from_millis(10), Duration::from_secs(1)];

/// Binds the port. Connections inherit the socket's send buffer, so it is set here.
///
/// # Errors
///
/// As the system says; a busy port is [`io::ErrorKind::AddrInUse`].
pub fn bind(listen: SocketAddr, transport: &Transport) -> io::Result<TcpListener> {
    let socket = match listen {
        SocketAddr::V4(_) => TcpSocket::new_v4()?,
        SocketAddr::V6(_) => TcpSocket::new_v6()?,
    };
    socket.set_reuseaddr(true)?;
    let bytes = transport.socket_send_buffer_kib.saturating_mul(1024);
    socket.set_send_buffer_size(u32::try_from(bytes).unwrap_or(u32::MAX))?;
    socket.bind(listen)?;
    socket.listen(BACKLOG)
}

/// What the accept loop needs.
pub struct Listener {
    /// Where connections come from.
    pub incoming: Incoming,
    /// What answers every request.
    pub router: Router,
    /// What is shown and asked for first; none: plain text is spoken.
    pub tls: Option<Tls>,
    /// Where connections are counted.
    pub metrics: Metrics,
    /// Where certificates of clients that are refused are written down.
    pub audit: Audit,
    /// When to stop accepting, to finish, and to give up.
    pub phases: Phases,
    /// Owns the connections' tasks.
    pub tasks: TaskTracker,
}

impl Listener {
    /// Accepts until the server closes.
    pub async fn run(mut self, config: Config) {
        let admission = Admission::new(&config.limits, self.metrics.clone());
        let connections = Connections::new(&self, &config);
        let mut pause = BACK_OFF[0];
        loop {
            let accepted = tokio::select! {
                () = self.phases.closing.cancelled() => return,
                accepted = self.incoming.accept() => accepted,
            };
            match accepted {
                Ok((stream, peer)) => {
                    pause = BACK_OFF[0];
                    if let Some(permit) = admission.admit(peer.ip()) {
                        connections.spawn(stream, peer, permit);
                    }
                }
                Err(error) if is_the_peers(&error) => {}
                Err(error) => {
                    self.metrics.accept_failed();
                    tracing::warn!(%error, pause_millis = pause.as_millis(), "cannot accept a connection");
                    tokio::time::sleep(pause).await;
                    pause = (pause * 2).min(BACK_OFF[1]);
                }
            }
        }
    }
}

/// Whether `accept` failed because of one peer, and the next may well succeed.
fn is_the_peers(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::ConnectionAborted
            | io::ErrorKind::ConnectionReset
            | io::ErrorKind::ConnectionRefused
    )
}
