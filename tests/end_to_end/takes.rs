//! What was acknowledged is in the take, whatever happens to the process (CONTRACTS U-1, U-3, U-5).

mod copied;
mod crash;
mod labels;
mod play;
mod power_cut;
mod recording;
mod replay;
mod resumed;

use frontalis_proto::v1::{
    ExportTakeRequest, GetTakeRequest, StartTakeRequest, StopTakeRequest, Take,
};
use harness::TestServer;
use tonic::Status;

pub const SESSION: &str = "sessions/stage";

pub async fn start(server: &TestServer, session: &str, slate: &str) -> Result<Take, Status> {
    let request = StartTakeRequest {
        session: session.to_owned(),
        slate: slate.to_owned(),
        ..StartTakeRequest::default()
    };
    let answer = server.takes().await.start_take(request).await?;
    Ok(answer.into_inner().take.unwrap())
}

pub async fn stop(server: &TestServer, name: &str) -> Result<Take, Status> {
    let request = StopTakeRequest {
        name: name.to_owned(),
    };
    let answer = server.takes().await.stop_take(request).await?;
    Ok(answer.into_inner().take.unwrap())
}

pub async fn get(server: &TestServer, name: &str) -> Result<Take, Status> {
    let request = GetTakeRequest {
        name: name.to_owned(),
    };
    let answer = server.takes().await.get_take(request).await?;
    Ok(answer.into_inner().take.unwrap())
}

/// The take's file.
pub async fn export(server: &TestServer, name: &str) -> Vec<u8> {
    let request = ExportTakeRequest {
        name: name.to_owned(),
        ..ExportTakeRequest::default()
    };
    let mut client = server.takes().await;
    let mut pieces = client.export_take(request).await.unwrap().into_inner();
    let mut file = Vec::new();
    while let Some(piece) = pieces.message().await.unwrap() {
        file.extend(piece.chunk);
    }
    file
}
