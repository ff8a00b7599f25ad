//! A take as it is named on the command line: one of the server, or a file.

use std::path::Path;

use anyhow::{Context as _, bail};
use frontalis_client::{
    connection::Channel,
    error::ClientError,
    proto::{self, TakeHeader, take_event::Event, take_service_client::TakeServiceClient},
    recorded_take::{RecordedMessage, RecordedTake},
};

use crate::commands::names::take_name;

/// Whether this is a take's MCAP file, and no take of the server.
pub fn is_file(take: &str) -> bool {
    let path = Path::new(take);
    path.extension().is_some_and(|it| it == "mcap") || path.is_file()
}

/// The take out of the file, or as the server gives it.
pub async fn open(take: &str, channel: Option<&Channel>) -> anyhow::Result<RecordedTake> {
    if is_file(take) {
        let file = RecordedTake::open(Path::new(take));
        return file.with_context(|| format!("cannot open {take}"));
    }
    let Some(channel) = channel else {
        bail!("{take} is no file");
    };
    let request = proto::ExportTakeRequest {
        name: take_name(take),
        format: proto::TakeFormat::Mcap.into(),
    };
    let mut client = TakeServiceClient::new(channel.clone());
    let pieces = client.export_take(request).await;
    let pieces = pieces.map_err(ClientError::from)?.into_inner();
    Ok(RecordedTake::download(pieces))
}

/// The first message of every take.
pub async fn header(take: &mut RecordedTake) -> anyhow::Result<TakeHeader> {
    let Some(first) = take.next().await? else {
        bail!("it is empty");
    };
    if let RecordedMessage::Event(event) = first
        && let Event::Header(header) = *event
    {
        return Ok(header);
    }
    bail!("it does not begin as a take does: with a header");
}
