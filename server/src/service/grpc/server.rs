//! `ServerService`: what this server is, and who asks.

use frontalis_proto::Timestamp;
use frontalis_proto::v1::{self, server_service_server::ServerService};
use tonic::{Request, Response, Status};

use crate::{clock::ServerClock, shutdown::Phases, wire};

/// What of the configuration the server tells.
#[derive(Clone, Copy, Debug, Default)]
pub struct Protection {
    /// The port speaks TLS.
    pub tls: bool,
    /// Callers prove who they are.
    pub tokens: bool,
    /// Other machines can reach the port, without TLS or without tokens.
    pub insecure: bool,
}

/// The service; cheap to clone.
#[derive(Clone)]
pub struct ServerGrpc {
    start_time: Timestamp,
    protection: Protection,
    phases: Phases,
}

impl ServerGrpc {
    /// A server that starts now.
    pub fn new(clock: ServerClock, protection: Protection, phases: Phases) -> Self {
        let unix_nanos = clock.now_nanos().saturating_add(clock.unix_offset_nanos());
        Self {
            start_time: wire::actor::timestamp(unix_nanos),
            protection,
            phases,
        }
    }
}

#[tonic::async_trait]
impl ServerService for ServerGrpc {
    async fn get_server(
        &self,
        _request: Request<v1::GetServerRequest>,
    ) -> Result<Response<v1::GetServerResponse>, Status> {
        let server = v1::Server {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            start_time: Some(self.start_time),
            tls: self.protection.tls,
            tokens: self.protection.tokens,
            insecure: self.protection.insecure,
            draining: self.phases.is_draining(),
            caller: None,
        };
        Ok(Response::new(v1::GetServerResponse {
            server: Some(server),
        }))
    }
}
