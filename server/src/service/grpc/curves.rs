//! `CurveService`: curves out.

use std::pin::Pin;

use frontalis_proto::v1::{self, curve_service_server::CurveService};
use futures::Stream;
use tonic::{Request, Response, Status, Streaming};

use super::actors::not_built;
use crate::{clock::ServerClock, session::SessionRegistry};

/// The service; cheap to clone.
#[derive(Clone)]
pub struct CurvesGrpc;

impl CurvesGrpc {
    /// Serves the sessions of `registry`.
    pub fn new(_registry: SessionRegistry, _clock: ServerClock) -> Self {
        Self
    }
}

type Responses = Pin<Box<dyn Stream<Item = Result<v1::SubscribeResponse, Status>> + Send>>;

#[tonic::async_trait]
impl CurveService for CurvesGrpc {
    type SubscribeStream = Responses;

    async fn subscribe(
        &self,
        _request: Request<Streaming<v1::SubscribeRequest>>,
    ) -> Result<Response<Responses>, Status> {
        Err(not_built("Subscribe"))
    }

    type FollowStream = Responses;

    async fn follow(
        &self,
        _request: Request<v1::SubscribeStart>,
    ) -> Result<Response<Responses>, Status> {
        Err(not_built("Follow"))
    }
}
