//! `CaptureService`: frames in.

use std::pin::Pin;

use frontalis_proto::v1::{self, capture_service_server::CaptureService};
use futures::Stream;
use tonic::{Request, Response, Status, Streaming};

use super::actors::not_built;
use crate::{catalogue::Store, clock::ServerClock, session::SessionRegistry};

/// The service; cheap to clone.
#[derive(Clone)]
pub struct CaptureGrpc;

impl CaptureGrpc {
    /// Publishes into the sessions of `registry`.
    pub fn new(_registry: SessionRegistry, _store: Store, _clock: ServerClock) -> Self {
        Self
    }
}

type Responses = Pin<Box<dyn Stream<Item = Result<v1::PublishResponse, Status>> + Send>>;

#[tonic::async_trait]
impl CaptureService for CaptureGrpc {
    type PublishMarkersStream = Responses;

    async fn publish_markers(
        &self,
        _request: Request<Streaming<v1::PublishMarkersRequest>>,
    ) -> Result<Response<Responses>, Status> {
        Err(not_built("PublishMarkers"))
    }

    type PublishImagesStream = Responses;

    async fn publish_images(
        &self,
        _request: Request<Streaming<v1::PublishImagesRequest>>,
    ) -> Result<Response<Responses>, Status> {
        Err(not_built("PublishImages"))
    }
}
