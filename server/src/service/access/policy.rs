//! What each role may do: the table of CONTRACTS S-4, deny by default.

use frontalis_access::Role;

/// What a call does, as the table tells them apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Ask what the server is, and what methods it has.
    ReadServer,
    /// Read the metrics.
    ReadMetrics,
    /// Read that sessions exist, and their state.
    ReadState,
    /// Send frames into a session.
    Publish,
    /// Push another principal's publisher out of a session.
    TakeOver,
    /// Read the curves of a session.
    Subscribe,
    /// Read and export recordings.
    ReadTakes,
    /// Create a session.
    CreateSession,
    /// End a session.
    EndSession,
    /// Change or recenter a session.
    ChangeSession,
    /// Start, stop and label recordings.
    Record,
    /// Read actors and their packages.
    ReadActors,
    /// Import, improve and train actors, and solve recordings again.
    MakeActors,
    /// Delete an actor and what was made of it.
    DeleteActor,
    /// Delete a recording.
    DeleteTake,
}

use Action as A;
use Role::{Operator, Publisher, Renderer, Viewer};

/// Who may: whoever is not listed may not.
const TABLE: [(Action, &[Role]); 15] = [
    (A::ReadServer, &[Operator, Publisher, Renderer, Viewer]),
    (A::ReadMetrics, &[Operator, Publisher, Renderer, Viewer]),
    (A::ReadState, &[Operator, Publisher, Renderer, Viewer]),
    (A::Publish, &[Publisher]),
    (A::TakeOver, &[Operator]),
    (A::Subscribe, &[Operator, Publisher, Renderer]),
    (A::ReadTakes, &[Operator, Publisher]),
    (A::CreateSession, &[Operator, Publisher]),
    (A::EndSession, &[Operator, Publisher]),
    (A::ChangeSession, &[Operator, Publisher]),
    (A::Record, &[Operator, Publisher]),
    (A::ReadActors, &[Operator, Publisher, Renderer]),
    (A::MakeActors, &[Operator]),
    (A::DeleteActor, &[Operator]),
    (A::DeleteTake, &[Operator]),
];

/// Whether a role may do this somewhere.
pub(super) fn allows(role: Role, action: Action) -> bool {
    TABLE
        .iter()
        .any(|(it, roles)| *it == action && roles.contains(&role))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_action_stands_in_the_table_once() {
        for (row, (action, roles)) in TABLE.iter().enumerate() {
            assert_eq!(*action as usize, row, "{action:?}");
            assert!(!roles.is_empty(), "{action:?}");
        }
    }

    #[test]
    fn a_viewer_reads_state_and_nothing_else() {
        let allowed = TABLE.iter().filter(|it| allows(Viewer, it.0));
        let allowed: Vec<Action> = allowed.map(|it| it.0).collect();
        assert_eq!(allowed, [A::ReadServer, A::ReadMetrics, A::ReadState]);
    }
}
