//! `ServerService`: what this server is, and who asks.

use frontalis_access::Role;
use frontalis_proto::Timestamp;
use frontalis_proto::v1::{self, server_service_server::ServerService};
use tonic::{Request, Response, Status};

use crate::{
    clock::ServerClock,
    service::access::{Action, Caller},
    shutdown::Phases,
    wire,
};

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

    /// Whether callers must prove who they are.
    pub fn asks_for_tokens(&self) -> bool {
        self.protection.tokens
    }
}

#[tonic::async_trait]
impl ServerService for ServerGrpc {
    async fn get_server(
        &self,
        request: Request<v1::GetServerRequest>,
    ) -> Result<Response<v1::GetServerResponse>, Status> {
        let caller = Caller::of(request.extensions());
        caller.may(Action::ReadServer)?;
        let server = v1::Server {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            start_time: Some(self.start_time),
            tls: self.protection.tls,
            tokens: self.protection.tokens,
            insecure: self.protection.insecure,
            draining: self.phases.is_draining(),
            caller: Some(principal(&caller)),
        };
        Ok(Response::new(v1::GetServerResponse {
            server: Some(server),
        }))
    }
}

/// Who asks. Where nobody is asked who they are, everybody has an operator's rights.
fn principal(caller: &Caller) -> v1::Principal {
    let mut principal = v1::Principal {
        name: caller.name().to_owned(),
        role: v1::Role::Operator.into(),
        sessions: vec!["*".to_owned()],
        expire_time: None,
    };
    if let Some(proven) = caller.principal() {
        principal.role = role(proven.role).into();
        principal.sessions = proven.scope.entries();
        principal.expire_time = proven.expire_time.map(|it| Timestamp {
            seconds: it.secs(),
            nanos: 0,
        });
    }
    principal
}

fn role(role: Role) -> v1::Role {
    match role {
        Role::Operator => v1::Role::Operator,
        Role::Publisher => v1::Role::Publisher,
        Role::Renderer => v1::Role::Renderer,
        Role::Viewer => v1::Role::Viewer,
    }
}
