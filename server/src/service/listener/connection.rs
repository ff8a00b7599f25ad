//! One connection from its first byte to its last: handshake, protocol, requests, end.

use std::{future::Future, net::SocketAddr, pin::pin, time::Duration};

use axum::{Router, body::Body, extract::ConnectInfo};
use hyper::body::Incoming;
use hyper_util::{
    rt::{TokioExecutor, TokioIo, TokioTimer},
    server::conn::auto,
};
use tokio::{
    io::{AsyncRead, AsyncWrite},
    time::timeout,
};
use tokio_util::task::TaskTracker;
use tonic::transport::server::TcpConnectInfo;
use tower::ServiceExt as _;

use super::{
    Listener, OpenConnection, PeerCertificate,
    admission::Permit,
    frames::ControlFrame,
    inbound::{Inbound, Upgraded},
    incoming::Accepted,
    lingering::Lingering,
    liveness::Liveness,
    tls::{Handshake, Tls},
};
use crate::{
    config::Config,
    service::{
        audit::{Audit, Entry},
        peer::{Door, Peer},
    },
    shutdown::Phases,
    telemetry::Metrics,
};

/// Bytes of one HTTP/1 read buffer; headers beyond it are refused.
/// A target of 64 KiB fits, so that it is told to be too long rather than that the headers are too large.
const HTTP1_BUFFER_BYTES: usize = 128 * 1024;

/// Streams that a peer may reset before they were accepted (S-9).
const PENDING_RESETS: usize = 20;

/// Streams that the server may reset because of a peer's errors (S-9).
const LOCAL_ERROR_RESETS: usize = 1_024;

/// From the GOAWAY to a peer that floods until its connection is dropped.
const FLOOD_GRACE: Duration = Duration::from_millis(500);

/// What every connection is served with; cheap to clone.
#[derive(Clone)]
pub(super) struct Connections {
    router: Router,
    tls: Option<Tls>,
    http: auto::Builder<TokioExecutor>,
    liveness: Liveness,
    handshake_deadline: Duration,
    header_deadline: Duration,
    metrics: Metrics,
    audit: Audit,
    phases: Phases,
    tasks: TaskTracker,
}

/// What its requests know of a connection.
#[derive(Clone)]
struct About {
    local: Option<SocketAddr>,
    peer: SocketAddr,
    certificate: Option<PeerCertificate>,
    open: OpenConnection,
}

impl Connections {
    pub(super) fn new(listener: &Listener, config: &Config) -> Self {
        let transport = &config.transport;
        Self {
            router: listener.router.clone(),
            tls: listener.tls.clone(),
            http: http(config),
            liveness: Liveness::new(transport),
            handshake_deadline: Duration::from_secs(transport.handshake_deadline_secs),
            header_deadline: Duration::from_secs(transport.header_deadline_secs),
            metrics: listener.metrics.clone(),
            audit: listener.audit.clone(),
            phases: listener.phases.clone(),
            tasks: listener.tasks.clone(),
        }
    }

    /// Serves a connection in a task of its own.
    pub(super) fn spawn(&self, accepted: Accepted, peer: SocketAddr, permit: Permit) {
        let about = About {
            local: None,
            peer,
            certificate: None,
            open: OpenConnection::new(permit, self.tasks.token()),
        };
        match accepted {
            Accepted::Stream(stream) => self.spawn_stream(stream, about),
            Accepted::Socket(socket) => match self.liveness.set(&socket) {
                Ok(()) => {
                    let local = socket.local_addr().ok();
                    self.spawn_stream(self.liveness.watch(socket), About { local, ..about });
                }
                Err(error) => tracing::debug!(%error, "a connection was gone at once"),
            },
        }
    }

    fn spawn_stream<S>(&self, stream: S, about: About)
    where
        S: AsyncRead + AsyncWrite + Unpin + Send + 'static,
    {
        let connections = self.clone();
        self.tasks.spawn(async move {
            match &connections.tls {
                None => connections.serve(stream, about).await,
                Some(tls) => connections.serve_tls(tls, stream, about).await,
            }
        });
    }

    async fn serve_tls<S>(&self, tls: &Tls, stream: S, about: About)
    where
        S: AsyncRead + AsyncWrite + Unpin + Send + 'static,
    {
        let shaken = tokio::select! {
            shaken = tls.accept(stream, self.handshake_deadline) => shaken,
            () = self.phases.closing.cancelled() => return,
        };
        match shaken {
            Ok((stream, certificate)) => {
                let about = About {
                    certificate,
                    ..about
                };
                self.serve(stream, about).await;
            }
            Err(why) => self.report(about.peer, &why),
        }
    }

    fn report(&self, peer: SocketAddr, why: &Handshake) {
        self.metrics.handshake_failed(why.kind());
        match why {
            Handshake::Certificate(why) => {
                let peer = Peer {
                    address: Some(peer),
                    door: Door::Handshake,
                    ..Peer::default()
                };
                self.audit
                    .failure(Entry::new("auth_failure", &peer, "certificate", why));
            }
            why => tracing::debug!(%peer, ?why, "a handshake came to nothing"),
        }
    }

    async fn serve<S>(&self, stream: S, about: About)
    where
        S: AsyncRead + AsyncWrite + Unpin + Send + 'static,
    {
        let _open = about.open.clone();
        let upgraded = Upgraded::default();
        let stream = Lingering::new(stream);
        let (inbound, exceeded) = Inbound::new(stream, self.header_deadline, upgraded.clone());
        let peer = about.peer;
        let service = service(self.router.clone(), about, upgraded);
        let connection = self
            .http
            .serve_connection_with_upgrades(TokioIo::new(inbound), service);
        let flooded = async {
            match exceeded.await {
                Ok(kind) => self.report_flood(peer, kind),
                Err(_) => std::future::pending().await,
            }
        };
        drive(connection.into_owned(), &self.phases, flooded).await;
    }

    fn report_flood(&self, peer: SocketAddr, kind: ControlFrame) {
        self.metrics.connection_flooded(kind.name());
        tracing::info!(%peer, frames = kind.name(), "a connection sent too many control frames and is closed");
    }
}

/// Polls a connection to its end. It is asked to end when the server closes, and when it floods, and is dropped when it
/// takes too long.
async fn drive<I, S, B>(
    connection: auto::UpgradeableConnection<'static, I, S, TokioExecutor>,
    phases: &Phases,
    flooded: impl Future<Output = ()>,
) where
    I: hyper::rt::Read + hyper::rt::Write + Unpin + Send + 'static,
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
            () = flooded => {
                connection.as_mut().graceful_shutdown();
                timeout(FLOOD_GRACE, connection).await.unwrap_or(Ok(()))
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
fn service(
    router: Router,
    about: About,
    upgraded: Upgraded,
) -> impl hyper::service::Service<
    http::Request<Incoming>,
    Response = http::Response<Body>,
    Error = std::convert::Infallible,
    Future = impl Future<Output = Result<http::Response<Body>, std::convert::Infallible>> + Send,
> + Clone {
    hyper::service::service_fn(move |mut request: http::Request<Incoming>| {
        let About {
            local,
            peer,
            certificate,
            open,
        } = about.clone();
        let extensions = request.extensions_mut();
        extensions.insert(TcpConnectInfo {
            local_addr: local,
            remote_addr: Some(peer),
        });
        extensions.insert(ConnectInfo(peer));
        extensions.insert(open);
        if let Some(certificate) = certificate {
            extensions.insert(certificate);
        }
        let (router, upgraded) = (router.clone(), upgraded.clone());
        async move {
            let response = router.oneshot(request.map(Body::new)).await?;
            if response.status() == http::StatusCode::SWITCHING_PROTOCOLS {
                upgraded.set();
            }
            Ok(response)
        }
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

#[cfg(test)]
mod tests;
