//! CONTRACTS S-4 as a reader writes it down, a line a method: operator, publisher, renderer, viewer; and what comes of a
//! call that may be made.

use frontalis_access::Role;

use super::{Object, Outcome};

/// What a role may do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum May {
    /// Wherever it wants.
    Everywhere,
    /// With the sessions of its scope, and the actors that they use.
    Own,
    /// Nowhere.
    Never,
}

/// What the object of a method is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// A session by its name.
    Session,
    /// A session by its name, which nothing looks up yet.
    SessionName,
    /// An actor by its name.
    Actor,
    /// The id of a session that shall be made.
    NewSession,
    /// A take, which is seen where its session is.
    Take,
    /// A list: what is not seen is not in it.
    List,
    /// Whatever is named is not looked at: the server itself, what is not built yet, what is new.
    Nothing,
}

/// What comes of a call that may be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Then {
    Succeeds,
    /// For a reason that has nothing to do with access.
    Fails(&'static str),
}

/// One line of the table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rule {
    /// Operator, publisher, renderer, viewer.
    pub(super) may: [May; 4],
    pub(super) target: Target,
    pub(super) then: Then,
    /// Answered without a proof.
    pub(super) is_open: bool,
}

/// What a cell must answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Expected {
    Passes(Then),
    /// The list holds the object, or does not.
    Listed(bool, Object),
    Unauthenticated,
    Role,
    Scope,
    NotFound,
}

use May::{Everywhere as E, Never as N, Own as O};
use Target::{Actor, List, NewSession, Nothing, Session, SessionName, Take};
use Then::{Fails, Succeeds};

const NOT_BUILT: Then = Fails("NOT_IMPLEMENTED");

/// S-4, the row in the comment behind each line.
#[rustfmt::skip]
const TABLE: &[(&str, [May; 4], Target, Then)] = &[
    ("frontalis.v1.CaptureService/PublishMarkers",  [N, O, N, N], Session,     Succeeds),  // publish frames
    ("frontalis.v1.CaptureService/PublishImages",   [N, E, N, N], Nothing,     NOT_BUILT), // publish frames
    ("frontalis.v1.CurveService/Subscribe",         [E, O, O, N], Session,     Succeeds),  // subscribe results
    ("frontalis.v1.CurveService/Follow",            [E, O, O, N], Session,     Succeeds),  // subscribe results
    ("frontalis.v1.CurveService/ReadCurves",        [E, O, O, N], Session,     Succeeds),  // subscribe results
    ("frontalis.v1.SessionService/CreateSession",   [E, O, N, N], NewSession,  Succeeds),  // create session: own prefix
    ("frontalis.v1.SessionService/GetSession",      [E, O, O, O], Session,     Succeeds),  // state
    ("frontalis.v1.SessionService/ListSessions",    [E, O, O, O], List,        Succeeds),  // state
    ("frontalis.v1.SessionService/UpdateSession",   [E, O, N, N], Session,     Succeeds),  // update session
    ("frontalis.v1.SessionService/RecenterSession", [E, O, N, N], Session,     Succeeds),  // recenter session
    ("frontalis.v1.SessionService/EndSession",      [E, O, N, N], Session,     Succeeds),  // end session
    ("frontalis.v1.ActorService/ImportActor",       [E, N, N, N], Nothing,     Succeeds),  // import actors
    ("frontalis.v1.ActorService/ExportActor",       [E, O, O, N], Actor,       Succeeds),  // read actors
    ("frontalis.v1.ActorService/GetActor",          [E, O, O, N], Actor,       Succeeds),  // read actors
    ("frontalis.v1.ActorService/ListActors",        [E, O, O, N], List,        Succeeds),  // read actors
    ("frontalis.v1.ActorService/DeleteActor",       [E, N, N, N], Actor,       Succeeds),  // delete
    ("frontalis.v1.ActorService/ImproveBasis",      [E, N, N, N], Nothing,     NOT_BUILT), // improve actors
    ("frontalis.v1.ActorService/TrainRegions",      [E, N, N, N], Nothing,     NOT_BUILT), // train actors
    ("frontalis.v1.TakeService/StartTake",          [E, O, N, N], Session,     Succeeds),  // start takes
    ("frontalis.v1.TakeService/StopTake",           [E, O, N, N], Take,        Succeeds),  // stop takes
    ("frontalis.v1.TakeService/GetTake",            [E, O, N, N], Take,        Succeeds),  // read takes
    ("frontalis.v1.TakeService/ListTakes",          [E, O, N, N], SessionName, Succeeds),  // read takes
    ("frontalis.v1.TakeService/UpdateTake",         [E, O, N, N], Take,        Succeeds),  // label takes
    ("frontalis.v1.TakeService/DeleteTake",         [E, N, N, N], Take,        Succeeds),  // delete
    ("frontalis.v1.TakeService/ExportTake",         [E, O, N, N], Take,        Succeeds),  // export
    ("frontalis.v1.TakeService/ResolveTake",        [E, N, N, N], Take,        Succeeds), // re-solve
    ("frontalis.v1.ServerService/GetServer",        [E, E, E, E], Nothing,     Succeeds),  // every role
    ("grpc.health.v1.Health/Watch",                 [E, E, E, E], Nothing,     Succeeds),  // every role
    ("grpc.reflection.v1.ServerReflection/ServerReflectionInfo",      [E, E, E, E], Nothing, Succeeds), // every role
    ("grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", [E, E, E, E], Nothing, Succeeds), // every role
    ("/metrics",                                    [E, E, E, E], Nothing,     Succeeds),  // every role
];

/// What everybody may ask, and whoever proves nothing too.
const OPEN: &[&str] = &[
    "grpc.health.v1.Health/Check",
    "/",
    "/healthz",
    "/readyz",
    "/openapi.json",
    "/docs",
    "/docs/",
    "/docs/swagger-ui.css",
];

/// The line of a method, by `package.Service/Method`, or of an operation over HTTP that is none, by its path.
pub(super) fn of(name: &str) -> Rule {
    if OPEN.contains(&name) {
        return Rule {
            may: [E; 4],
            target: Nothing,
            then: Succeeds,
            is_open: true,
        };
    }
    let line = TABLE.iter().find(|it| it.0 == name);
    let (_, may, target, then) = line.unwrap_or_else(|| panic!("{name} has no rule"));
    Rule {
        may: *may,
        target: *target,
        then: *then,
        is_open: false,
    }
}

/// The paths of operations over HTTP that are no method.
pub(super) fn plain_paths() -> impl Iterator<Item = &'static str> {
    let paths = TABLE.iter().map(|it| it.0).chain(OPEN.iter().copied());
    paths.filter(|it| it.starts_with('/'))
}

impl Rule {
    /// The same with `takeover`, which an operator may.
    pub(super) fn with_takeover(mut self) -> Self {
        self.may[0] = May::Everywhere;
        self
    }

    pub(super) fn expected(self, role: Option<Role>, object: Object) -> Expected {
        let Some(role) = role else {
            return if self.is_open {
                Expected::Passes(self.then)
            } else {
                Expected::Unauthenticated
            };
        };
        let may = match role {
            Role::Operator => self.may[0],
            Role::Publisher => self.may[1],
            Role::Renderer => self.may[2],
            Role::Viewer => self.may[3],
        };
        let reaches = may == May::Everywhere || object == Object::Own;
        match self.target {
            _ if may == May::Never => Expected::Role,
            Nothing => Expected::Passes(self.then),
            List => Expected::Listed(reaches && object != Object::Missing, object),
            NewSession if reaches && object == Object::Foreign => {
                Expected::Passes(Fails("SESSION_EXISTS"))
            }
            NewSession | SessionName if reaches => Expected::Passes(self.then),
            NewSession => Expected::Scope,
            Session | Actor | Take if reaches && object != Object::Missing => {
                Expected::Passes(self.then)
            }
            SessionName | Session | Actor | Take => Expected::NotFound,
        }
    }
}

impl Expected {
    pub(super) fn is(self, outcome: &Outcome) -> bool {
        let answered = (outcome.code.as_str(), outcome.reason.as_str());
        match self {
            Self::Passes(Then::Succeeds) => outcome.is_success(),
            Self::Passes(Then::Fails(reason)) => outcome.reason == reason,
            Self::Listed(is_there, object) => {
                let is_listed = outcome.names.iter().any(|it| it.ends_with(object.id()));
                outcome.is_success() && is_listed == is_there
            }
            Self::Unauthenticated => {
                matches!(answered, ("UNAUTHENTICATED" | "401", "UNAUTHENTICATED"))
            }
            Self::Role => matches!(answered, ("PERMISSION_DENIED" | "403", "ROLE")),
            Self::Scope => matches!(answered, ("PERMISSION_DENIED" | "403", "SCOPE")),
            Self::NotFound => matches!(
                answered,
                ("NOT_FOUND" | "404", "SESSION" | "ACTOR" | "TAKE")
            ),
        }
    }
}
