//! The session that a take is played into: the one that is there, or a new one of the take's actor.

use anyhow::{Context as _, bail};
use frontalis_client::{
    connection::Channel,
    error::ClientError,
    proto::{
        self, SessionSettings, SessionState, TakeHeader,
        session_service_client::SessionServiceClient,
    },
};
use tonic::Code;

use crate::commands::{session_name, short_id};

/// Longest id.
const MAX_ID_BYTES: usize = 63;

/// The id of the session: as it was asked for, or made of the take's.
pub(super) fn id(asked_for: Option<&str>, header: &TakeHeader) -> String {
    if let Some(id) = asked_for {
        return short_id(id).to_owned();
    }
    let mut id = format!("play-{}", short_id(&header.take));
    id.truncate(MAX_ID_BYTES);
    id
}

/// A session that takes the frames.
pub(super) struct PlaySession {
    name: String,
    /// It was not there before.
    is_made: bool,
}

impl PlaySession {
    /// Finds the session, or makes it of the take's actor, revision and settings.
    pub(super) async fn open(
        channel: &Channel,
        id: &str,
        header: &TakeHeader,
    ) -> anyhow::Result<Self> {
        let mut client = SessionServiceClient::new(channel.clone());
        let name = session_name(id);
        let request = proto::GetSessionRequest { name: name.clone() };
        let present = match client.get_session(request).await {
            Ok(answer) => answer.into_inner().session,
            Err(status) if status.code() == Code::NotFound => None,
            Err(status) => return Err(ClientError::from(status).into()),
        };
        let is_open = |it: &proto::Session| {
            let state = it.status.as_ref().map(proto::SessionStatus::state);
            state != Some(SessionState::Ended)
        };
        if let Some(present) = present.filter(is_open) {
            if present.actor != header.actor {
                bail!(
                    "session {id} is of {}, the take of {}",
                    present.actor,
                    header.actor
                );
            }
            return Ok(Self {
                name,
                is_made: false,
            });
        }
        make(&mut client, id, header).await?;
        Ok(Self {
            name,
            is_made: true,
        })
    }

    /// Ends a session that was made for the take.
    pub(super) async fn end_if_made(self, channel: &Channel) -> anyhow::Result<()> {
        if self.is_made {
            let request = proto::EndSessionRequest { name: self.name };
            let ended = SessionServiceClient::new(channel.clone())
                .end_session(request)
                .await;
            ended.map_err(ClientError::from)?;
        }
        Ok(())
    }
}

async fn make(
    client: &mut SessionServiceClient<Channel>,
    id: &str,
    header: &TakeHeader,
) -> anyhow::Result<()> {
    let TakeHeader {
        actor,
        actor_revision,
        ..
    } = header;
    let request = proto::CreateSessionRequest {
        session_id: id.to_owned(),
        actor: actor.clone(),
        kind: proto::CaptureKind::Markers.into(),
        settings: header.settings.clone().map(for_playing),
        display_name: String::new(),
    };
    let made = client.create_session(request).await;
    let made = made
        .map_err(ClientError::from)
        .with_context(|| format!("session {id} of {actor} cannot be made"))?
        .into_inner()
        .session
        .unwrap_or_default();
    let newest = made.status.unwrap_or_default().actor_revision;
    if newest != *actor_revision {
        let request = proto::UpdateSessionRequest {
            name: session_name(id),
            actor_revision: *actor_revision,
            ..proto::UpdateSessionRequest::default()
        };
        let moved = client.update_session(request).await;
        moved.map_err(ClientError::from).with_context(|| {
            format!("revision {actor_revision} of {actor} is not there any more")
        })?;
    }
    eprintln!("session {id} is made of {actor}, revision {actor_revision}");
    Ok(())
}

/// The take's settings, without what only its capture needed: nobody asks to align, and what is recorded already is not again.
fn for_playing(settings: SessionSettings) -> SessionSettings {
    SessionSettings {
        align_on_request: None,
        record: None,
        record_images: None,
        ..settings
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_session_is_named_after_its_take() {
        let header = |take: &str| TakeHeader {
            take: format!("takes/{take}"),
            ..TakeHeader::default()
        };
        assert_eq!(id(None, &header("stage-1-19f3")), "play-stage-1-19f3");
        assert_eq!(id(None, &header(&"x".repeat(63))).len(), 63);
        assert_eq!(id(Some("sessions/again"), &header("a")), "again");
    }
}
