//! Accepts connections and serves HTTP/1 and HTTP/2 on them, within limits (CONTRACTS O-1, D-20, D-25, S-9).
//!
//! The loop outlives whatever the system or a peer does: a failing `accept` backs off and goes on, a connection beyond
//! a limit is closed at once, one that does not begin to speak is closed after a deadline, one whose peer has vanished
//! after an unanswered ping.

mod admission;
mod open_connection;
mod opening;

use std::{future::Future, io, net::SocketAddr, pin::pin, time::Duration};

use axum::{Router, body::Body, extract::ConnectInfo};
use hyper::body::Incoming;
use hyper_util::{
    rt::{TokioExecutor, TokioIo, TokioTimer},
    server::conn::auto,
};
use tokio::net::{TcpListener, TcpSocket, TcpStream};
use tokio_util::task::TaskTracker;
use tonic::transport::server::TcpConnectInfo;
use tower::ServiceExt as _;

use crate::{
    config::{Config, Transport},
    shutdown::Phases,
    telemetry::Metrics,
};
use admission::{Admission, Permit};
use opening::Opening;

pub use open_connection::OpenConnection;

/// Connections that the system may hold before they are accepted.
const BACKLOG: u32 = 1_024;

/// Bytes of one HTTP/1 read buffer; headers beyond it are refused.
const HTTP1_BUFFER_BYTES: usize = 64 * 1024;

/// Streams that a peer may reset before they were accepted (S-9).
const PENDING_RESETS: usize = 20;

/// Streams that the server may reset because of a peer's errors (S-9).
const LOCAL_ERROR_RESETS: usize = 1_024;

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
    /// The bound port.
    pub listener: TcpListener,
    /// What answers every request.
    pub router: Router,
    /// Where connections are counted.
    pub metrics: Metrics,
    /// When to stop accepting, to finish, and to give up.
    pub phases: Phases,
    /// Owns the connections' tasks.
    pub tasks: TaskTracker,
}

impl Listener {
    /// Accepts until the server closes.
    pub async fn run(self, config: Config) {
        let admission = Admission::new(&config.limits, self.metrics.clone());
        let http = http(&config);
        let mut pause = BACK_OFF[0];
        loop {
            let accepted = tokio::select! {
                () = self.phases.closing.cancelled() => return,
                accepted = self.listener.accept() => accepted,
            };
            match accepted {
                Ok((stream, peer)) => {
                    pause = BACK_OFF[0];
                    if let Some(permit) = admission.admit(peer.ip()) {
                        self.spawn(stream, peer, permit, &http, &config.transport);
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

    fn spawn(
        &self,
        stream: TcpStream,
        peer: SocketAddr,
        permit: Permit,
        http: &auto::Builder<TokioExecutor>,
        transport: &Transport,
    ) {
        // Samples are small and late ones worthless: nothing may wait for more to send.
        if let Err(error) = stream.set_nodelay(true) {
            tracing::debug!(%error, "a connection was gone at once");
            return;
        }
        let local = stream.local_addr().ok();
        let deadline = Duration::from_secs(transport.header_deadline_secs);
        let io = TokioIo::new(Opening::new(stream, deadline));
        let open = OpenConnection::new(permit, self.tasks.token());
        let service = serve(self.router.clone(), local, peer, open.clone());
        let connection = http.serve_connection_with_upgrades(io, service);
        let connection = connection.into_owned();
        let phases = self.phases.clone();
        self.tasks.spawn(async move {
            let _open = open;
            drive(connection, &phases).await;
        });
    }
}

/// Polls a connection to its end; when the server closes it is asked to end, when the server gives up it is dropped.
async fn drive<S, B>(
    connection: auto::UpgradeableConnection<'static, TokioIo<Opening<TcpStream>>, S, TokioExecutor>,
    phases: &Phases,
) where
    S: hyper::service::Service<http::Request<Incoming>, Response = http::Response<B>>
        + Send
        + 'static,
    S::Error: Into<Box<dyn std::error::Error + Send + Sync>>,
    S::Future: Send + 'static,
    B: hyper::body::Body + Send + 'static,
    B::Data: Send,
    B::Error: Into<Box<dyn std::error::Error + Send + Sync>>,
{
    let mut connection = pin!(connection);
    let polite = async {
        tokio::select! {
            ended = connection.as_mut() => ended,
            () = phases.closing.cancelled() => {
                connection.as_mut().graceful_shutdown();
                connection.await
            }
        }
    };
    let ended = tokio::select! {
        ended = polite => ended,
        () = phases.cut.cancelled() => return,
    };
    if let Err(error) = ended {
        tracing::debug!(%error, "a connection ended early");
    }
}

/// Answers one connection's requests, each of which knows its peer.
fn serve(
    router: Router,
    local_addr: Option<SocketAddr>,
    peer: SocketAddr,
    open: OpenConnection,
) -> impl hyper::service::Service<
    http::Request<Incoming>,
    Response = http::Response<Body>,
    Error = std::convert::Infallible,
    Future = impl Future<Output = Result<http::Response<Body>, std::convert::Infallible>> + Send,
> + Clone {
    hyper::service::service_fn(move |mut request: http::Request<Incoming>| {
        let info = TcpConnectInfo {
            local_addr,
            remote_addr: Some(peer),
        };
        request.extensions_mut().insert(info);
        request.extensions_mut().insert(ConnectInfo(peer));
        request.extensions_mut().insert(open.clone());
        router.clone().oneshot(request.map(Body::new))
    })
}

fn http(config: &Config) -> auto::Builder<TokioExecutor> {
    let transport = &config.transport;
    let kib = |count: u64| u32::try_from(count.saturating_mul(1024)).unwrap_or(u32::MAX);
    let mut builder = auto::Builder::new(TokioExecutor::new());
    builder
        .http1()
        .timer(TokioTimer::new())
        .header_read_timeout(Duration::from_secs(transport.header_deadline_secs))
        .max_buf_size(HTTP1_BUFFER_BYTES);
    builder
        .http2()
        .timer(TokioTimer::new())
        .keep_alive_interval(Duration::from_secs(transport.keepalive_interval_secs))
        .keep_alive_timeout(Duration::from_secs(transport.keepalive_timeout_secs))
        .max_concurrent_streams(config.limits.streams_per_connection)
        .initial_stream_window_size(kib(transport.stream_window_kib))
        .initial_connection_window_size(kib(transport.connection_window_kib))
        .max_send_buf_size(kib(transport.send_buffer_kib) as usize)
        .max_header_list_size(kib(transport.header_list_kib))
        .max_pending_accept_reset_streams(PENDING_RESETS)
        .max_local_error_reset_streams(LOCAL_ERROR_RESETS);
    builder
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
