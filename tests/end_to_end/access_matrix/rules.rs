//! CONTRACTS S-4 as a reader writes it down, a line a method: operator, publisher, renderer, viewer.

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
    /// A list: what is not seen is not in it.
    List,
    /// Whatever is named is not looked at: the server itself, what is not built yet, what is new.
    Nothing,
}

/// One line of the table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rule {
    /// Operator, publisher, renderer, viewer.
    pub(super) may: [May; 4],
    pub(super) target: Target,
    /// Asked without a token.
    pub(super) is_open: bool,
}

/// What a cell must answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Expected {
    /// No refusal of access; the call itself may fail for what is in it.
    Passes,
    /// The list holds the object, or does not.
    Listed(bool, Object),
    Unauthenticated,
    Role,
    Scope,
    NotFound,
}

use May::{Everywhere as E, Never as N, Own as O};
use Target::{Actor, List, NewSession, Nothing, Session, SessionName};

/// S-4, the row in the comment behind each line.
#[rustfmt::skip]
const TABLE: &[(&str, [May; 4], Target)] = &[
    ("CaptureService/PublishMarkers",  [N, O, N, N], Session),    // publish frames
    ("CaptureService/PublishImages",   [N, E, N, N], Nothing),    // publish frames; not built
    ("CurveService/Subscribe",         [E, O, O, N], Session),    // subscribe results
    ("CurveService/Follow",            [E, O, O, N], Session),    // subscribe results
    ("CurveService/ReadCurves",        [E, O, O, N], Session),    // subscribe results
    ("SessionService/CreateSession",   [E, O, N, N], NewSession), // create / end session: own prefix
    ("SessionService/GetSession",      [E, O, O, O], Session),    // state
    ("SessionService/ListSessions",    [E, O, O, O], List),       // state
    ("SessionService/UpdateSession",   [E, O, N, N], Session),    // update, recenter session
    ("SessionService/RecenterSession", [E, O, N, N], Session),    // update, recenter session
    ("SessionService/EndSession",      [E, O, N, N], Session),    // create / end session
    ("ActorService/ImportActor",       [E, N, N, N], Nothing),    // import actors
    ("ActorService/ExportActor",       [E, O, O, N], Actor),      // read actors
    ("ActorService/GetActor",          [E, O, O, N], Actor),      // read actors
    ("ActorService/ListActors",        [E, O, O, N], List),       // read actors
    ("ActorService/DeleteActor",       [E, N, N, N], Actor),      // delete
    ("ActorService/ImproveBasis",      [E, N, N, N], Nothing),    // improve; not built
    ("ActorService/TrainRegions",      [E, N, N, N], Nothing),    // train; not built
    ("TakeService/StartTake",          [E, O, N, N], SessionName),// start takes; not built
    ("TakeService/StopTake",           [E, E, N, N], Nothing),    // stop takes; not built
    ("TakeService/GetTake",            [E, E, N, N], Nothing),    // read takes; not built
    ("TakeService/ListTakes",          [E, O, N, N], SessionName),// read takes; not built
    ("TakeService/UpdateTake",         [E, E, N, N], Nothing),    // label takes; not built
    ("TakeService/DeleteTake",         [E, N, N, N], Nothing),    // delete; not built
    ("TakeService/ExportTake",         [E, E, N, N], Nothing),    // export; not built
    ("TakeService/ResolveTake",        [E, N, N, N], Nothing),    // re-solve; not built
    ("ServerService/GetServer",        [E, E, E, E], Nothing),    // every token may ask
];

/// Operations over HTTP that are no method of a service.
#[rustfmt::skip]
const PLAIN: &[(&str, [May; 4], bool)] = &[
    ("/",             [E, E, E, E], true),
    ("/healthz",      [E, E, E, E], true),
    ("/readyz",       [E, E, E, E], true),
    ("/openapi.json", [E, E, E, E], true),
    ("/docs",         [E, E, E, E], true),
    ("/metrics",      [E, E, E, E], false),
];

/// The line of a method, by `frontalis.v1.Service/Method`.
pub(super) fn of(method: &str) -> Rule {
    let short = method.trim_start_matches("frontalis.v1.");
    let line = TABLE.iter().find(|it| it.0 == short);
    let (_, may, target) = line.unwrap_or_else(|| panic!("{method} has no rule"));
    Rule {
        may: *may,
        target: *target,
        is_open: false,
    }
}

/// The line of a plain operation, by its path.
pub(super) fn plain(path: &str) -> Rule {
    let line = PLAIN.iter().find(|it| it.0 == path);
    let (_, may, is_open) = line.unwrap_or_else(|| panic!("{path} has no rule"));
    Rule {
        may: *may,
        target: Nothing,
        is_open: *is_open,
    }
}

/// The paths of plain operations.
pub(super) fn plain_paths() -> impl Iterator<Item = &'static str> {
    PLAIN.iter().map(|it| it.0)
}

impl Rule {
    pub(super) fn expected(self, caller: Option<Role>, object: Object) -> Expected {
        let Some(role) = caller else {
            return if self.is_open {
                Expected::Passes
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
            Nothing => Expected::Passes,
            List => Expected::Listed(reaches && object != Object::Missing, object),
            NewSession | SessionName if reaches => Expected::Passes,
            NewSession => Expected::Scope,
            Session | Actor if reaches && object != Object::Missing => Expected::Passes,
            SessionName | Session | Actor => Expected::NotFound,
        }
    }
}

impl Expected {
    pub(super) fn is(self, outcome: &Outcome) -> bool {
        let answered = (outcome.code.as_str(), outcome.reason.as_str());
        match self {
            Self::Passes => !matches!(
                outcome.reason.as_str(),
                "UNAUTHENTICATED" | "ROLE" | "SCOPE" | "SESSION" | "ACTOR" | "RATE_LIMIT" | "ROUTE"
            ),
            Self::Listed(is_there, object) => {
                let is_listed = outcome.names.iter().any(|it| it.ends_with(object.id()));
                outcome.reason.is_empty() && is_listed == is_there
            }
            Self::Unauthenticated => {
                matches!(answered, ("UNAUTHENTICATED" | "401", "UNAUTHENTICATED"))
            }
            Self::Role => matches!(answered, ("PERMISSION_DENIED" | "403", "ROLE")),
            Self::Scope => matches!(answered, ("PERMISSION_DENIED" | "403", "SCOPE")),
            Self::NotFound => matches!(answered, ("NOT_FOUND" | "404", "SESSION" | "ACTOR")),
        }
    }
}
