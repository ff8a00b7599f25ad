//! `SessionService`.

use frontalis_proto::v1::{self, session_service_server::SessionService};
use tonic::{Request, Response, Status};

use crate::{
    name::SessionId,
    service::sessions::{Change, Sessions},
    wire::{
        invalid::FieldError,
        page::Page,
        session::{CreateSession, apply},
    },
};

/// The service; cheap to clone.
#[derive(Clone)]
pub struct SessionsGrpc(pub Sessions);

fn id(name: &str) -> Result<SessionId, Status> {
    Ok(SessionId::from_resource(name).map_err(FieldError::name("name"))?)
}

#[tonic::async_trait]
impl SessionService for SessionsGrpc {
    async fn create_session(
        &self,
        request: Request<v1::CreateSessionRequest>,
    ) -> Result<Response<v1::CreateSessionResponse>, Status> {
        let request = CreateSession::try_from(request.into_inner())?;
        let session = Some(self.0.create(request).await?);
        Ok(Response::new(v1::CreateSessionResponse { session }))
    }

    async fn get_session(
        &self,
        request: Request<v1::GetSessionRequest>,
    ) -> Result<Response<v1::GetSessionResponse>, Status> {
        let id = id(&request.into_inner().name)?;
        let session = Some(self.0.get(&id).await?);
        Ok(Response::new(v1::GetSessionResponse { session }))
    }

    async fn list_sessions(
        &self,
        request: Request<v1::ListSessionsRequest>,
    ) -> Result<Response<v1::ListSessionsResponse>, Status> {
        let request = request.into_inner();
        let page = Page::parse(request.page_size, &request.page_token)?;
        let (sessions, next_page_token) = self.0.list(&page).await?;
        Ok(Response::new(v1::ListSessionsResponse {
            sessions,
            next_page_token,
        }))
    }

    async fn update_session(
        &self,
        request: Request<v1::UpdateSessionRequest>,
    ) -> Result<Response<v1::UpdateSessionResponse>, Status> {
        let request = request.into_inner();
        let id = id(&request.name)?;
        let asked = request.settings.unwrap_or_default();
        let mask = request.update_mask.unwrap_or_default().paths;
        let change = Change {
            settings: Box::new(move |base| Ok(apply(&asked, &mask, base)?)),
            actor_revision: (request.actor_revision != 0).then_some(request.actor_revision),
        };
        let session = Some(self.0.update(&id, change).await?);
        Ok(Response::new(v1::UpdateSessionResponse { session }))
    }

    async fn recenter_session(
        &self,
        request: Request<v1::RecenterSessionRequest>,
    ) -> Result<Response<v1::RecenterSessionResponse>, Status> {
        let id = id(&request.into_inner().name)?;
        let session = Some(self.0.recenter(&id).await?);
        Ok(Response::new(v1::RecenterSessionResponse { session }))
    }

    async fn end_session(
        &self,
        request: Request<v1::EndSessionRequest>,
    ) -> Result<Response<v1::EndSessionResponse>, Status> {
        let id = id(&request.into_inner().name)?;
        let session = Some(self.0.end(&id).await?);
        Ok(Response::new(v1::EndSessionResponse { session }))
    }
}

#[cfg(test)]
mod tests;
