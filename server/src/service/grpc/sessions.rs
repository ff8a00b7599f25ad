//! `SessionService`.

use frontalis_proto::v1::{self, session_service_server::SessionService};
use tonic::{Request, Response, Status};

use crate::{
    name::SessionId,
    service::{
        access::{Action, Caller},
        audit::Audit,
        peer::Peer,
        sessions::{Change, Sessions, made_id},
    },
    wire::{
        invalid::FieldError,
        page::Page,
        session::{CreateSession, apply, neutral_source},
    },
};

/// The service; cheap to clone.
#[derive(Clone)]
pub struct SessionsGrpc {
    sessions: Sessions,
    audit: Audit,
}

impl SessionsGrpc {
    /// Serves these sessions.
    pub fn new(sessions: Sessions, audit: Audit) -> Self {
        Self { sessions, audit }
    }

    /// The sessions behind it, for what is no call.
    pub fn sessions(&self) -> &Sessions {
        &self.sessions
    }
}

fn id(name: &str) -> Result<SessionId, Status> {
    Ok(SessionId::from_resource(name).map_err(FieldError::name("name"))?)
}

#[tonic::async_trait]
impl SessionService for SessionsGrpc {
    async fn create_session(
        &self,
        request: Request<v1::CreateSessionRequest>,
    ) -> Result<Response<v1::CreateSessionResponse>, Status> {
        let peer = Peer::of(request.extensions());
        peer.caller.may(Action::CreateSession)?;
        let mut request = CreateSession::try_from(request.into_inner())?;
        let prefix = peer.caller.may_create(request.id.as_ref())?;
        let id = match request.id.take() {
            Some(id) => id,
            None => made_id(prefix)?,
        };
        peer.caller.count_creation()?;
        let name = id.resource();
        request.id = Some(id);
        let created = self.sessions.create(request).await;
        let session = Some(
            self.audit
                .outcome("session_create", &peer, &name, created)?,
        );
        Ok(Response::new(v1::CreateSessionResponse { session }))
    }

    async fn get_session(
        &self,
        request: Request<v1::GetSessionRequest>,
    ) -> Result<Response<v1::GetSessionResponse>, Status> {
        let caller = Caller::of(request.extensions());
        caller.may(Action::ReadState)?;
        let id = id(&request.into_inner().name)?;
        caller.may_in(Action::ReadState, &id)?;
        let session = Some(self.sessions.get(&id).await?);
        Ok(Response::new(v1::GetSessionResponse { session }))
    }

    async fn list_sessions(
        &self,
        request: Request<v1::ListSessionsRequest>,
    ) -> Result<Response<v1::ListSessionsResponse>, Status> {
        let caller = Caller::of(request.extensions());
        caller.may(Action::ReadState)?;
        let request = request.into_inner();
        let page = Page::parse(request.page_size, &request.page_token)?;
        let is_seen = |id: &SessionId| caller.sees(id);
        let (sessions, next_page_token) = self.sessions.list(&page, is_seen).await?;
        Ok(Response::new(v1::ListSessionsResponse {
            sessions,
            next_page_token,
        }))
    }

    async fn update_session(
        &self,
        request: Request<v1::UpdateSessionRequest>,
    ) -> Result<Response<v1::UpdateSessionResponse>, Status> {
        let caller = Caller::of(request.extensions());
        caller.may(Action::ChangeSession)?;
        let request = request.into_inner();
        let id = id(&request.name)?;
        caller.may_in(Action::ChangeSession, &id)?;
        let asked = request.settings.unwrap_or_default();
        let mask = request.update_mask.unwrap_or_default().paths;
        let change = Change {
            settings: Box::new(move |base| Ok(apply(&asked, &mask, base)?)),
            actor_revision: (request.actor_revision != 0).then_some(request.actor_revision),
        };
        let session = Some(self.sessions.update(&id, change).await?);
        Ok(Response::new(v1::UpdateSessionResponse { session }))
    }

    async fn recenter_session(
        &self,
        request: Request<v1::RecenterSessionRequest>,
    ) -> Result<Response<v1::RecenterSessionResponse>, Status> {
        let caller = Caller::of(request.extensions());
        caller.may(Action::ChangeSession)?;
        let request = request.into_inner();
        let id = id(&request.name)?;
        caller.may_in(Action::ChangeSession, &id)?;
        let source = neutral_source(request.source)?;
        let session = Some(self.sessions.recenter(&id, source).await?);
        Ok(Response::new(v1::RecenterSessionResponse { session }))
    }

    async fn end_session(
        &self,
        request: Request<v1::EndSessionRequest>,
    ) -> Result<Response<v1::EndSessionResponse>, Status> {
        let peer = Peer::of(request.extensions());
        peer.caller.may(Action::EndSession)?;
        let id = id(&request.into_inner().name)?;
        peer.caller.may_in(Action::EndSession, &id)?;
        let ended = self.sessions.end(&id).await;
        let name = id.resource();
        let session = Some(self.audit.outcome("session_end", &peer, &name, ended)?);
        Ok(Response::new(v1::EndSessionResponse { session }))
    }
}

#[cfg(test)]
mod tests;
