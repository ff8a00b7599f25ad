//! Sessions on the wire.

mod settings;
mod status;

use std::time::SystemTime;

use frontalis_analysis::analyzer::NeutralSource;
use frontalis_proto::v1;

use super::{
    actor::timestamp,
    invalid::{FieldError, FieldProblem},
};
use crate::{
    catalogue::{SessionRow, StoredSettings},
    name::{ActorId, DisplayName, SessionId},
    session::{SessionHandle, SessionSettings},
};

pub use settings::{apply, check_objective, effective, of_effective};
pub use status::state_name;

/// A request to create a session, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct CreateSession {
    /// None: the server makes one.
    pub id: Option<SessionId>,
    /// May be empty.
    pub display_name: DisplayName,
    /// The actor.
    pub actor: ActorId,
    /// Effective settings.
    pub settings: SessionSettings,
}

impl TryFrom<v1::CreateSessionRequest> for CreateSession {
    type Error = FieldError;

    fn try_from(request: v1::CreateSessionRequest) -> Result<Self, FieldError> {
        let id = match request.session_id.as_str() {
            "" => None,
            text => Some(SessionId::parse(text).map_err(FieldError::name("session_id"))?),
        };
        check_kind(request.kind)?;
        let asked = request.settings.unwrap_or_default();
        Ok(Self {
            id,
            display_name: DisplayName::parse("display_name", &request.display_name)
                .map_err(FieldError::name("display_name"))?,
            actor: ActorId::from_resource(&request.actor).map_err(FieldError::name("actor"))?,
            settings: apply(&asked, &[], &SessionSettings::default())?,
        })
    }
}

fn check_kind(kind: i32) -> Result<(), FieldError> {
    let refuse = |problem| Err(FieldError::new("kind", problem));
    match v1::CaptureKind::try_from(kind) {
        Ok(v1::CaptureKind::Markers) => Ok(()),
        Ok(v1::CaptureKind::Images) => refuse(FieldProblem::NotImplemented),
        Ok(v1::CaptureKind::Unspecified) => refuse(FieldProblem::Missing),
        Err(_) => refuse(FieldProblem::UnknownEnum(kind)),
    }
}

/// Where a request to recenter wants the neutral face from.
///
/// # Errors
///
/// `ENUM` when the source is not known.
pub fn neutral_source(number: i32) -> Result<NeutralSource, FieldError> {
    match v1::NeutralSource::try_from(number) {
        Ok(v1::NeutralSource::Unspecified | v1::NeutralSource::NextFrames) => {
            Ok(NeutralSource::NextFrames)
        }
        Ok(v1::NeutralSource::QuietestFrames) => Ok(NeutralSource::QuietestFrames),
        Err(_unknown) => Err(FieldError::new("source", FieldProblem::UnknownEnum(number))),
    }
}

/// A session that is open in this process.
pub fn live(handle: &SessionHandle) -> v1::Session {
    v1::Session {
        name: handle.id().resource(),
        display_name: handle.display_name().to_owned(),
        actor: handle.actor_id().resource(),
        kind: v1::CaptureKind::Markers.into(),
        settings: Some(effective(&handle.settings())),
        create_time: Some(timestamp(unix_nanos(handle.create_time()))),
        status: Some(status::status(&handle.status())),
    }
}

/// A session of which only the catalogue's row is left: it ended.
pub fn ended(row: &SessionRow) -> v1::Session {
    v1::Session {
        name: row.session.id.resource(),
        display_name: row.session.display_name.clone(),
        actor: row.session.actor.resource(),
        kind: v1::CaptureKind::Markers.into(),
        settings: Some(effective(&from_stored(&row.session.settings))),
        create_time: Some(timestamp(row.create_time_nanos)),
        status: Some(v1::SessionStatus {
            state: v1::SessionState::Ended.into(),
            run: row.run,
            actor_revision: row.session.actor_revision,
            ..Default::default()
        }),
    }
}

/// Settings as the catalogue keeps them.
pub fn to_stored(settings: &SessionSettings) -> StoredSettings {
    StoredSettings {
        marker: settings.marker.clone(),
        stale_after: settings.stale_after,
        publisher_timeout: settings.publisher_timeout,
        record: settings.record,
        record_images: settings.record_images,
    }
}

/// Settings as a session takes them.
pub fn from_stored(stored: &StoredSettings) -> SessionSettings {
    SessionSettings {
        marker: stored.marker.clone(),
        stale_after: stored.stale_after,
        publisher_timeout: stored.publisher_timeout,
        record: stored.record,
        record_images: stored.record_images,
    }
}

fn unix_nanos(time: SystemTime) -> i64 {
    let since = time
        .duration_since(SystemTime::UNIX_EPOCH)
        .unwrap_or_default();
    crate::clock::nanos(since)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn good() -> v1::CreateSessionRequest {
        v1::CreateSessionRequest {
            session_id: "stage-1".into(),
            actor: "actors/a".into(),
            kind: v1::CaptureKind::Markers.into(),
            ..Default::default()
        }
    }

    fn check(request: v1::CreateSessionRequest, field: &str, reason: &str) {
        let error = CreateSession::try_from(request).unwrap_err();
        assert_eq!((error.field(), error.reason()), (field, reason));
    }

    #[test]
    fn absent_settings_are_the_defaults() {
        let created = CreateSession::try_from(good()).unwrap();
        assert_eq!(created.settings, SessionSettings::default());
        let nameless = v1::CreateSessionRequest {
            session_id: String::new(),
            ..good()
        };
        assert_eq!(CreateSession::try_from(nameless).unwrap().id, None);
    }

    #[test]
    fn each_refused_field_is_named() {
        let images = v1::CaptureKind::Images.into();
        check(
            v1::CreateSessionRequest {
                session_id: "A".into(),
                ..good()
            },
            "session_id",
            "NAME",
        );
        check(
            v1::CreateSessionRequest {
                actor: "a".into(),
                ..good()
            },
            "actor",
            "NAME",
        );
        check(
            v1::CreateSessionRequest {
                display_name: "\n".into(),
                ..good()
            },
            "display_name",
            "NAME",
        );
        check(
            v1::CreateSessionRequest { kind: 0, ..good() },
            "kind",
            "MISSING_FIELD",
        );
        check(
            v1::CreateSessionRequest { kind: 7, ..good() },
            "kind",
            "ENUM",
        );
        check(
            v1::CreateSessionRequest {
                kind: images,
                ..good()
            },
            "kind",
            "NOT_IMPLEMENTED",
        );
    }
}
