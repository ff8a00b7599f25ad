//! Which markers of a capture and of its actor found each other.
//!
//! A marker that the actor does not have is recorded and not solved; one that the capture does not have, or that the
//! neutral frames never showed, gives no evidence. Neither stops a capture, so both are said.

use frontalis_client::{connection::Channel, error::ClientError, proto};
use proto::session_service_client::SessionServiceClient;

use super::{actor, short_id};

/// Markers without a partner.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MarkerCheck {
    /// In the capture, not of the actor.
    pub unknown: Vec<String>,
    /// Of the actor, not in the capture.
    pub missing: Vec<String>,
    /// Of the actor and in the capture, but not seen in the neutral frames; `None` before the alignment.
    pub unbound: Option<usize>,
}

impl MarkerCheck {
    /// `n_bound`: markers of the actor that the alignment bound to the mesh.
    pub fn new(streamed: &[String], of_actor: &[String], n_bound: Option<usize>) -> Self {
        let without = |these: &[String], others: &[String]| -> Vec<String> {
            let is_alone = |it: &&String| !others.contains(it);
            these.iter().filter(is_alone).cloned().collect()
        };
        let missing = without(of_actor, streamed);
        let n_shared = of_actor.len() - missing.len();
        Self {
            unknown: without(streamed, of_actor),
            missing,
            unbound: n_bound.map(|it| n_shared.saturating_sub(it)),
        }
    }

    /// Compares what was streamed with the session's actor and alignment.
    pub async fn of_session(
        channel: Channel,
        session: &str,
        streamed: &[String],
    ) -> Result<Self, ClientError> {
        let request = proto::GetSessionRequest {
            name: session.to_owned(),
        };
        let session = SessionServiceClient::new(channel.clone())
            .get_session(request)
            .await?
            .into_inner()
            .session
            .unwrap_or_default();
        let actor = actor::get(channel, short_id(&session.actor)).await?;
        let of_actor: Vec<_> = actor.markers.into_iter().map(|it| it.name).collect();
        let alignment = session.status.and_then(|it| it.alignment);
        let n_bound = alignment.map(|it| it.n_markers as usize);
        Ok(Self::new(streamed, &of_actor, n_bound))
    }

    /// One line a kind of markers, for a person.
    pub fn warnings(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if !self.unknown.is_empty() {
            lines.push(format!(
                "markers that the actor does not have, not solved ({}): {}",
                self.unknown.len(),
                self.unknown.join(", ")
            ));
        }
        if !self.missing.is_empty() {
            lines.push(format!(
                "markers of the actor that the capture does not have ({}): {}",
                self.missing.len(),
                self.missing.join(", ")
            ));
        }
        if let Some(unbound @ 1..) = self.unbound {
            lines.push(format!(
                "markers of the actor that the neutral frames did not show, not used: {unbound}"
            ));
        }
        lines
    }

    /// Says them beside the results.
    pub fn warn(&self) {
        for line in self.warnings() {
            eprintln!("warning: {line}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<String> {
        text.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn markers_without_a_partner_are_named_on_both_sides() {
        let check = MarkerCheck::new(
            &names("chin ear brow"),
            &names("brow chin lip nose"),
            Some(1),
        );
        assert_eq!(check.unknown, ["ear"]);
        assert_eq!(check.missing, ["lip", "nose"]);
        assert_eq!(check.unbound, Some(1));
        let warnings = check.warnings().join("\n");
        for part in ["(1): ear", "(2): lip, nose", "not used: 1"] {
            assert!(warnings.contains(part), "{warnings}");
        }
    }

    #[test]
    fn a_capture_of_the_actors_own_markers_gives_no_warning() {
        let markers = names("brow chin");
        for n_bound in [None, Some(2)] {
            assert!(
                MarkerCheck::new(&markers, &markers, n_bound)
                    .warnings()
                    .is_empty()
            );
        }
    }
}
