//! What was acknowledged is in the take, whatever happens to the process (CONTRACTS U-1, U-3, U-5).

mod c3d_files;
mod copied;
mod crash;
mod diff;
mod downloads;
mod exports;
mod labels;
mod options;
mod play;
mod power_cut;
mod python;
mod recording;
mod replay;
mod resolve;
mod resumed;

use frontalis_proto::v1::{
    ExportTakeRequest, GetTakeRequest, MarkerFrame, StartTakeRequest, StopTakeRequest, Take,
    TakeExport, TakeFormat,
};
use harness::{Publisher, TestPerformance, TestServer};
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

/// A recording of the session that has begun, and who publishes into it.
pub async fn record(server: &TestServer, performance: &TestPerformance) -> (Take, Publisher) {
    let take = start(server, SESSION, "").await.unwrap();
    let publisher = Publisher::open(server, performance.start(SESSION, "stage"));
    (take, publisher.await.unwrap())
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

pub use harness::export_mcap as export;

/// The take in a format, and what was said of it last.
async fn export_as(
    server: &TestServer,
    name: &str,
    format: TakeFormat,
) -> Result<(Vec<u8>, TakeExport), Status> {
    let request = ExportTakeRequest {
        name: name.to_owned(),
        format: format.into(),
    };
    let mut client = server.takes().await;
    let mut pieces = client.export_take(request).await?.into_inner();
    let (mut file, mut told) = (Vec::new(), None);
    while let Some(piece) = pieces.message().await? {
        file.extend(piece.chunk);
        told = piece.export.or(told);
    }
    Ok((file, told.unwrap()))
}

/// A take of a performance's first frames, which is over, and what they were.
async fn recorded(server: &TestServer, slate: &str, frames: Vec<MarkerFrame>) -> Take {
    let performance = TestPerformance::reference();
    let take = start(server, SESSION, slate).await.unwrap();
    let start = performance.start(SESSION, "stage");
    let mut publisher = Publisher::open(server, start).await.unwrap();
    let last = frames.last().unwrap().number;
    publisher.send(frames).await;
    publisher.durable(last).await.unwrap();
    stop(server, &take.name).await.unwrap()
}
