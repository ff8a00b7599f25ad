//! A stored package in the other container.

use frontalis_analysis::{
    face::actor::RankPolicy,
    format::{
        actor_package::{self, PackageError},
        glb,
    },
};
use tonic::{Code, Status};

use super::ActorsGrpc;
use crate::service::grpc::status::refuse;

impl ActorsGrpc {
    /// A stored package as a GLB; one that is a GLB stays as it is.
    pub(in crate::service) async fn to_glb(&self, package: Vec<u8>) -> Result<Vec<u8>, Status> {
        if package.starts_with(&glb::MAGIC) {
            return Ok(package);
        }
        let converted = self.workers.run(move || converted(&package)).await;
        converted.map_err(|error| {
            tracing::error!(%error, "a stored actor cannot be converted");
            let message = "the stored actor cannot be converted";
            refuse(Code::Internal, "STORAGE", message)
        })
    }
}

/// What is stored was accepted when it came, with whatever rank its basis has.
fn converted(package: &[u8]) -> Result<Vec<u8>, PackageError> {
    let read = actor_package::read(package, RankPolicy::Regularize)?;
    Ok(actor_package::write_glb(&read.actor))
}
