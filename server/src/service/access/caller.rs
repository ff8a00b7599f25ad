//! Who sent a request, and the check of what it may do.

use std::sync::Arc;

use frontalis_access::{Principal, Role};
use http::Extensions;
use tonic::{Code, Status};

use super::{Access, policy};
use crate::{
    catalogue::CatalogueError,
    name::SessionId,
    service::{
        grpc::status::{Refusal, refuse},
        listener::PeerCertificate,
    },
};

pub use super::policy::Action;

/// What a principal is called where nobody is asked who they are.
const ANYONE: &str = "anyone";

/// Who sent a request; cheap to clone. The default is nobody, who may do nothing: a door that forgets to ask stays shut.
#[derive(Clone, Debug, Default)]
pub struct Caller {
    who: Who,
    /// What the connection's client showed; whoever comes over the connection goes with it.
    certificate: Option<PeerCertificate>,
}

#[derive(Clone, Debug, Default)]
enum Who {
    #[default]
    Nobody,
    /// Whoever reaches the port, where there is no token file.
    Anyone,
    Known(Arc<Known>),
}

/// What may stop to hold while a stream goes on.
pub(super) struct Standing {
    pub(super) known: Option<Arc<Known>>,
    pub(super) certificate: Option<PeerCertificate>,
}

#[derive(Debug)]
pub(super) struct Known {
    pub(super) principal: Principal,
    pub(super) access: Access,
}

impl Caller {
    /// As the request's extensions say.
    pub fn of(extensions: &Extensions) -> Self {
        extensions.get::<Self>().cloned().unwrap_or_default()
    }

    /// Whoever reaches a port that asks nobody; may do everything.
    pub fn anyone() -> Self {
        Self {
            who: Who::Anyone,
            certificate: None,
        }
    }

    pub(super) fn known(principal: Principal, access: Access) -> Self {
        Self {
            who: Who::Known(Arc::new(Known { principal, access })),
            certificate: None,
        }
    }

    /// The same, over a connection whose client showed this.
    pub(super) fn behind(self, certificate: Option<PeerCertificate>) -> Self {
        Self {
            certificate,
            ..self
        }
    }

    /// What its rights rest on; none when nothing of it can end.
    pub(super) fn standing(&self) -> Option<Standing> {
        let standing = Standing {
            known: self.as_known().cloned(),
            certificate: self.certificate.clone(),
        };
        let can_end = standing.known.is_some() || standing.certificate.is_some();
        can_end.then_some(standing)
    }

    pub(super) fn as_known(&self) -> Option<&Arc<Known>> {
        match &self.who {
            Who::Known(known) => Some(known),
            Who::Anyone | Who::Nobody => None,
        }
    }

    /// The proven identity; none for anyone and nobody.
    pub fn principal(&self) -> Option<&Principal> {
        self.as_known().map(|it| &it.principal)
    }

    /// Tells callers apart: the same text is the same principal.
    pub fn key(&self) -> &str {
        match &self.who {
            Who::Nobody => "nobody",
            Who::Anyone => ANYONE,
            Who::Known(known) => &known.principal.key,
        }
    }

    /// What people call it.
    pub fn name(&self) -> &str {
        match &self.who {
            Who::Nobody => "nobody",
            Who::Anyone => ANYONE,
            Who::Known(known) => &known.principal.name,
        }
    }

    /// Whether it may do this anywhere.
    ///
    /// # Errors
    ///
    /// `PERMISSION_DENIED ROLE`; nobody: `UNAUTHENTICATED`.
    pub fn may(&self, action: Action) -> Result<(), Status> {
        match &self.who {
            Who::Nobody => Err(unauthenticated()),
            Who::Anyone => Ok(()),
            Who::Known(known) if policy::allows(known.principal.role, action) => Ok(()),
            Who::Known(_) => Err(self.denied("the caller's role may not do this")),
        }
    }

    /// The refusal of its role, in these words.
    pub fn denied(&self, message: &'static str) -> Status {
        let refusal = Refusal::new(Code::PermissionDenied, "ROLE", message);
        match self.principal() {
            Some(principal) => refusal.with("role", &principal.role),
            None => refusal,
        }
        .into_status()
    }

    /// Whether it may do this to this session: the role first, then the scope.
    ///
    /// # Errors
    ///
    /// As [`Self::may`]; out of scope: what a session that is not there is answered with (CONTRACTS S-5, BAD_INPUT I3).
    pub fn may_in(&self, action: Action, session: &SessionId) -> Result<(), Status> {
        self.may(action)?;
        if self.sees(session) {
            Ok(())
        } else {
            Err(CatalogueError::NoSession.into())
        }
    }

    /// Whether a session is in its scope.
    pub fn sees(&self, session: &SessionId) -> bool {
        match &self.who {
            Who::Nobody => false,
            Who::Anyone => true,
            Who::Known(known) => known.principal.scope.contains(session.as_str()),
        }
    }

    /// Whether every session is in its scope.
    pub fn sees_all(&self) -> bool {
        match &self.who {
            Who::Nobody => false,
            Who::Anyone => true,
            Who::Known(known) => known.principal.scope.is_all(),
        }
    }

    /// Whether it sees every actor, and not those of its sessions alone.
    pub fn sees_all_actors(&self) -> bool {
        match &self.who {
            Who::Nobody => false,
            Who::Anyone => true,
            Who::Known(known) => known.principal.role == Role::Operator,
        }
    }

    /// Whether it may make a session of this id, and how one without an id has to begin.
    ///
    /// # Errors
    ///
    /// As [`Self::may`]; `PERMISSION_DENIED SCOPE` out of scope, whether the session is there or not, and for no id when
    /// the scope does not say how it shall begin.
    pub fn may_create(&self, session: Option<&SessionId>) -> Result<&str, Status> {
        self.may(Action::CreateSession)?;
        let Who::Known(known) = &self.who else {
            return Ok("");
        };
        let scope = &known.principal.scope;
        match session {
            Some(session) if scope.contains(session.as_str()) => Ok(""),
            Some(_) => Err(out_of_scope(
                "the session id is outside of the caller's scope",
            )),
            None => scope.only_prefix().ok_or_else(|| {
                out_of_scope("the caller's scope has not exactly one prefix: name the session")
            }),
        }
    }
}

/// The one answer to every proof that proves nothing (BAD_INPUT I1).
pub fn unauthenticated() -> Status {
    let message = "a valid token is needed";
    refuse(Code::Unauthenticated, "UNAUTHENTICATED", message)
}

fn out_of_scope(message: &str) -> Status {
    refuse(Code::PermissionDenied, "SCOPE", message)
}
