//! Refusals of the catalogue, of fields and of packages as statuses.

use std::time::Duration;

use frontalis_analysis::{analyzer::QuietestError, format::actor_package::PackageError};
use tonic::{Code, Status};

use super::status::Refusal;
use crate::{
    catalogue::{ActorLoadError, CatalogueError},
    hub::RangeError,
    session::{SessionError, alignment_problem},
    wire::invalid::{FieldError, FieldProblem},
};

/// When it makes sense to try again, where a limit was reached.
const RETRY_AFTER: Duration = Duration::from_secs(1);

impl From<FieldError> for Status {
    fn from(error: FieldError) -> Self {
        let code = match error.problem() {
            FieldProblem::NotImplemented => Code::Unimplemented,
            FieldProblem::Name(_)
            | FieldProblem::UnknownEnum(_)
            | FieldProblem::Missing
            | FieldProblem::Range { .. }
            | FieldProblem::Duration { .. }
            | FieldProblem::UnknownPath { .. }
            | FieldProblem::Unusable { .. }
            | FieldProblem::PageToken => Code::InvalidArgument,
        };
        Refusal::new(code, error.reason(), error.to_string())
            .with("field", &error.path())
            .into_status()
    }
}

impl From<CatalogueError> for Status {
    fn from(error: CatalogueError) -> Self {
        let message = error.to_string();
        match error {
            CatalogueError::NoSession => Refusal::new(Code::NotFound, "SESSION", message),
            CatalogueError::NoActor => Refusal::new(Code::NotFound, "ACTOR", message),
            CatalogueError::NoTake => Refusal::new(Code::NotFound, "TAKE", message),
            CatalogueError::TakeExists => Refusal::new(Code::AlreadyExists, "TAKE_EXISTS", message),
            CatalogueError::SessionExists => {
                Refusal::new(Code::AlreadyExists, "SESSION_EXISTS", message)
            }
            CatalogueError::ActorInUse { n_sessions } => {
                Refusal::new(Code::FailedPrecondition, "ACTOR_IN_USE", message)
                    .with("sessions", &n_sessions)
            }
            CatalogueError::BeingErased => {
                Refusal::new(Code::FailedPrecondition, "ACTOR_BEING_ERASED", message)
            }
            CatalogueError::LayoutChanged { what, .. } => {
                Refusal::new(Code::FailedPrecondition, "LAYOUT_CHANGED", message)
                    .with("what", &what)
            }
            CatalogueError::Database(_)
            | CatalogueError::Storage(_)
            | CatalogueError::Directory { .. }
            | CatalogueError::Damaged { .. }
            | CatalogueError::NewerVersion { .. }
            | CatalogueError::InUse { .. }
            | CatalogueError::Unreadable { .. } => {
                tracing::error!(
                    error = &error as &dyn std::error::Error,
                    "the catalogue failed"
                );
                Refusal::new(Code::Internal, "STORAGE", message)
            }
        }
        .into_status()
    }
}

impl From<ActorLoadError> for Status {
    fn from(error: ActorLoadError) -> Self {
        match error {
            ActorLoadError::Catalogue(error) => error.into(),
            ActorLoadError::Package { .. } => {
                tracing::error!(%error, "a stored actor cannot be used");
                Refusal::new(Code::Internal, "STORAGE", "the stored actor cannot be used")
                    .into_status()
            }
        }
    }
}

/// A package that was refused.
pub(super) fn package(error: &PackageError) -> Status {
    let reason = error.reason();
    let code = match reason {
        "BASIS_SIZE" => Code::ResourceExhausted,
        "BASIS_RANK" => Code::FailedPrecondition,
        "COMPRESSION" | "GLTF_EXTENSION" => Code::Unimplemented,
        _ => Code::InvalidArgument,
    };
    Refusal::new(code, reason, error.to_string()).into_status()
}

/// A limit was reached; later there may be room.
pub(in crate::service) fn limit(reason: &'static str, name: &'static str, limit: usize) -> Status {
    Refusal::new(
        Code::ResourceExhausted,
        reason,
        format!("{name} is limited to {limit}"),
    )
    .with("limit", &name)
    .with("value", &limit)
    .retry_after(RETRY_AFTER)
    .into_status()
}

/// A size was exceeded; trying again will not help.
pub(super) fn too_large(reason: &'static str, name: &'static str, limit_bytes: usize) -> Status {
    let message = format!("{name} is limited to {limit_bytes} bytes");
    Refusal::new(Code::ResourceExhausted, reason, message)
        .with("limit", &name)
        .with("value", &limit_bytes)
        .into_status()
}

impl From<SessionError> for Status {
    fn from(error: SessionError) -> Self {
        let message = error.to_string();
        match error {
            SessionError::NotFound => Refusal::new(Code::NotFound, "SESSION", message),
            SessionError::Exists { .. } => {
                Refusal::new(Code::AlreadyExists, "SESSION_EXISTS", message)
            }
            SessionError::RegistryFull { limit: sessions } => {
                return limit("SESSIONS", "limits.sessions", sessions);
            }
            SessionError::Owned { free_after, .. } => {
                Refusal::new(Code::FailedPrecondition, "SESSION_OWNED", message)
                    .retry_after(free_after)
            }
            SessionError::OwnedByAnother => {
                Refusal::new(Code::PermissionDenied, "TAKEOVER", message)
            }
            SessionError::TakeoverRate { retry_after } => {
                Refusal::new(Code::ResourceExhausted, "RATE_LIMIT", message)
                    .retry_after(retry_after)
            }
            SessionError::Fenced { epoch, current } => {
                Refusal::new(Code::Aborted, "PUBLISHER_FENCED", message)
                    .with("epoch", &epoch)
                    .with("current", &current)
            }
            SessionError::UnknownMarkers { .. } => {
                Refusal::new(Code::FailedPrecondition, "UNKNOWN_MARKERS", message)
            }
            SessionError::Quietest(error) => return quietest(&error),
            SessionError::Busy { .. } => {
                Refusal::new(Code::ResourceExhausted, "SESSION_BUSY", message)
                    .retry_after(RETRY_AFTER)
            }
            SessionError::Ended | SessionError::Forgotten => {
                Refusal::new(Code::FailedPrecondition, "SESSION_ENDED", message)
            }
            SessionError::Failed { .. } => Refusal::new(Code::Internal, "SESSION_FAILED", message),
            SessionError::Draining => {
                Refusal::new(Code::Unavailable, "DRAINING", message).retry_after(RETRY_AFTER)
            }
        }
        .into_status()
    }
}

/// The quietest frames cannot be the neutral face.
fn quietest(error: &QuietestError) -> Status {
    let message = error.to_string();
    let refused =
        |reason, message| Refusal::new(Code::FailedPrecondition, reason, message).into_status();
    match error {
        QuietestError::NotAligned => refused("NOT_ALIGNED", message),
        QuietestError::TooFew { found, needed } => {
            Refusal::new(Code::FailedPrecondition, "QUIETEST_FRAMES", message)
                .with("found", found)
                .with("needed", needed)
                .into_status()
        }
        QuietestError::Alignment(cause) => {
            refused(alignment_problem(cause), format!("{message}: {cause}"))
        }
    }
}

impl From<RangeError> for Status {
    fn from(error: RangeError) -> Self {
        let message = error.to_string();
        match error {
            RangeError::NewRun { current, .. } => {
                Refusal::new(Code::OutOfRange, "NEW_RUN", message).with("run", &current)
            }
            RangeError::NotKept {
                first_available,
                last_available,
                ..
            } => Refusal::new(Code::OutOfRange, "SEQUENCE", message)
                .with("first_available", &first_available)
                .with("last_available", &last_available),
        }
        .into_status()
    }
}
