//! One HTTP/2 connection to a server.
//!
//! CONTRACTS D-25: a half-open peer is found by a ping every 5 s that must be answered within 10 s.

use std::time::Duration;

use tonic::{
    Code,
    transport::{Channel, Endpoint},
};

use crate::error::ClientError;

const PING_INTERVAL: Duration = Duration::from_secs(5);
const PING_TIMEOUT: Duration = Duration::from_secs(10);
const CONNECT_TIMEOUT: Duration = Duration::from_secs(5);

/// The address of a server that nobody changed.
pub const DEFAULT_SERVER: &str = "http://127.0.0.1:7400";

/// A channel that connects with the first call and again after every cut.
///
/// # Errors
///
/// When `server` is not an address of the form `http://HOST:PORT`.
pub fn lazy_channel(server: &str) -> Result<Channel, ClientError> {
    Ok(endpoint(server)?.connect_lazy())
}

/// A channel whose server answered.
///
/// # Errors
///
/// When `server` is not an address, or nobody answers there within 5 s.
pub async fn connect(server: &str) -> Result<Channel, ClientError> {
    endpoint(server)?.connect().await.map_err(|error| {
        let error = ClientError::from(error);
        ClientError::local(
            error.code,
            format!("cannot reach the server at {server}: {}", error.message),
        )
    })
}

fn endpoint(server: &str) -> Result<Endpoint, ClientError> {
    let with_scheme = if server.contains("://") {
        server.to_owned()
    } else {
        format!("http://{server}")
    };
    let endpoint = Endpoint::from_shared(with_scheme).map_err(|_| {
        ClientError::local(
            Code::InvalidArgument,
            format!("{server:?} is not a server address; expected http://HOST:PORT"),
        )
    })?;
    Ok(endpoint
        .connect_timeout(CONNECT_TIMEOUT)
        .tcp_nodelay(true)
        .http2_keep_alive_interval(PING_INTERVAL)
        .keep_alive_timeout(PING_TIMEOUT)
        .keep_alive_while_idle(true))
}
