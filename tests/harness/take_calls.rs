//! What tests and measuring programs ask a server about its takes.

use std::time::Duration;

use frontalis_proto::v1::{ExportTakeRequest, GetTakeRequest, Take, TakeFormat, TakeState};

use crate::TestServer;

/// Between two questions.
const AGAIN: Duration = Duration::from_millis(5);

/// The take, once it is no longer being recovered.
///
/// # Panics
///
/// When there is none.
pub async fn take_in_order(server: &TestServer, name: &str) -> Take {
    let mut client = server.takes().await;
    loop {
        let name = name.to_owned();
        let answer = client.get_take(GetTakeRequest { name }).await.unwrap();
        let take = answer.into_inner().take.unwrap();
        if take.state() != TakeState::Recovering {
            return take;
        }
        tokio::time::sleep(AGAIN).await;
    }
}

/// The take's file.
///
/// # Panics
///
/// When there is none, or it cannot be had.
pub async fn export_mcap(server: &TestServer, name: &str) -> Vec<u8> {
    let request = ExportTakeRequest {
        name: name.to_owned(),
        format: TakeFormat::Mcap.into(),
    };
    let mut client = server.takes().await;
    let mut pieces = client.export_take(request).await.unwrap().into_inner();
    let mut file = Vec::new();
    while let Some(piece) = pieces.message().await.unwrap() {
        file.extend(piece.chunk);
    }
    file
}
