//! Actor packages on their way to and from a server.

use std::path::Path;

use anyhow::{Context as _, bail};
use frontalis_analysis::{
    face::actor::{Actor, RankPolicy},
    format::actor_package,
};
use frontalis_client::{connection::Channel, error::ClientError, proto};
use proto::actor_service_client::ActorServiceClient;
use tokio::sync::mpsc;
use tokio_stream::wrappers::ReceiverStream;
use tonic::Code;

use crate::{commands::actor_name, terminal::progress};

/// The contract takes chunks of at most 1 MiB.
const CHUNK_BYTES: usize = 256 << 10;
/// Chunks waiting for the transport.
const CHUNKS_IN_FLIGHT: usize = 4;
/// Largest package the client takes from a server; the server's own limit for one is the same.
const MAX_PACKAGE_BYTES: usize = 64 << 20;

/// The two forms in which an actor travels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PackageForm {
    /// actor.json with OBJ files.
    Zip,
    /// Morph targets in one binary glTF.
    Glb,
}

impl PackageForm {
    /// The form that a file's extension asks for.
    pub fn of_file(path: &Path) -> anyhow::Result<Self> {
        let extension = path.extension().and_then(|it| it.to_str()).unwrap_or("");
        match extension.to_ascii_lowercase().as_str() {
            "zip" => Ok(Self::Zip),
            "glb" => Ok(Self::Glb),
            _ => bail!(
                "{}: the extension chooses the form; expected .zip or .glb",
                path.display()
            ),
        }
    }

    fn of_bytes(bytes: &[u8]) -> Self {
        if bytes.starts_with(b"glTF") {
            Self::Glb
        } else {
            Self::Zip
        }
    }

    /// The same package in this form; untouched when it already is.
    pub fn convert(self, bytes: Vec<u8>) -> anyhow::Result<Vec<u8>> {
        if Self::of_bytes(&bytes) == self {
            return Ok(bytes);
        }
        let actor = read(&bytes, RankPolicy::Regularize)?;
        Ok(self.write(&actor))
    }

    /// The actor in this form.
    pub fn write(self, actor: &Actor) -> Vec<u8> {
        match self {
            Self::Zip => actor_package::write_zip(actor),
            Self::Glb => actor_package::write_glb(actor),
        }
    }
}

/// An actor from the bytes of either form.
pub fn read(bytes: &[u8], rank: RankPolicy) -> anyhow::Result<Actor> {
    let read = actor_package::read(bytes, rank).context("not a usable actor package")?;
    Ok(read.actor)
}

/// Sends a package, with a progress bar.
pub async fn import(
    channel: Channel,
    start: proto::ImportActorStart,
    package: Vec<u8>,
) -> Result<proto::ImportActorResponse, ClientError> {
    let (requests, receiver) = mpsc::channel(CHUNKS_IN_FLIGHT);
    let bar = progress::bytes(package.len() as u64, "importing");
    let sending = async {
        let first = proto::ImportActorRequest {
            start: Some(start),
            chunk: Vec::new(),
        };
        if requests.send(first).await.is_err() {
            return;
        }
        for chunk in package.chunks(CHUNK_BYTES) {
            let request = proto::ImportActorRequest {
                start: None,
                chunk: chunk.to_vec(),
            };
            // The server hung up; its answer says why.
            if requests.send(request).await.is_err() {
                return;
            }
            bar.inc(chunk.len() as u64);
        }
        drop(requests);
        bar.set_message("checking");
    };
    let mut client = ActorServiceClient::new(channel);
    let calling = client.import_actor(ReceiverStream::new(receiver));
    let ((), answer) = tokio::join!(sending, calling);
    bar.finish_and_clear();
    Ok(answer?.into_inner())
}

/// Fetches a package; revision 0 is the newest.
pub async fn fetch(channel: Channel, id: &str, revision: u32) -> Result<Vec<u8>, ClientError> {
    let request = proto::ExportActorRequest {
        name: actor_name(id),
        revision,
    };
    let mut client = ActorServiceClient::new(channel);
    let mut chunks = client.export_actor(request).await?.into_inner();
    let spinner = progress::spinner("exporting");
    let mut package = Vec::new();
    while let Some(chunk) = chunks.message().await? {
        package.extend_from_slice(&chunk.chunk);
        if package.len() > MAX_PACKAGE_BYTES {
            return Err(ClientError::local(
                Code::ResourceExhausted,
                format!("the package of {id} is larger than {MAX_PACKAGE_BYTES} bytes"),
            ));
        }
    }
    spinner.finish_and_clear();
    Ok(package)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_chooses_the_form() {
        let form = |it: &str| PackageForm::of_file(Path::new(it)).ok();
        assert_eq!(form("a.zip"), Some(PackageForm::Zip));
        assert_eq!(form("a.GLB"), Some(PackageForm::Glb));
        assert_eq!(form("a"), None);
    }
}
