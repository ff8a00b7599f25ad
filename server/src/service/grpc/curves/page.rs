//! Part of a run out of its takes, for readers without a stream.

use frontalis_proto::v1;
use tonic::Status;

use super::replaying::oldest;
use crate::{
    service::replay::{Replays, Step},
    session::SessionHandle,
    wire::curve::{ReadRequest, state_to_wire},
};

/// What a reader asks for, where the session no longer keeps it and a take does.
///
/// # Errors
///
/// That the storage failed.
pub(super) async fn replayed(
    replays: &Replays,
    session: &SessionHandle,
    asked: &ReadRequest,
    header: &v1::CurveHeader,
) -> Result<Option<v1::ReadCurvesResponse>, Status> {
    let hub = session.hub();
    let run = asked.run.unwrap_or_else(|| hub.run());
    let wanted = match asked.after {
        Some(after) => Some(after.saturating_add(1)),
        None => oldest(replays, session, asked.run).await?,
    };
    let is_kept = |it: &u64| run == hub.run() && *it >= hub.oldest_sequence();
    let Some(wanted) = wanted.filter(|it| !is_kept(it)) else {
        return Ok(None);
    };
    let Some(mut replay) = replays.find(session.id(), run, wanted, 0).await? else {
        return Ok(None);
    };
    let (mut samples, mut gaps) = (Vec::new(), Vec::new());
    while samples.len() < asked.limit && gaps.len() < asked.limit {
        let n_left = asked.limit - samples.len();
        match replay.step(n_left, asked.detail).await? {
            Step::Entries {
                samples: more,
                gaps: between,
            } => {
                samples.extend(more);
                gaps.extend(between);
            }
            Step::Hole { .. } | Step::Caught | Step::Over { .. } => break,
        }
    }
    Ok(Some(v1::ReadCurvesResponse {
        header: Some(v1::CurveHeader {
            run,
            ..header.clone()
        }),
        samples,
        gaps,
        read_through: replay.next_sequence().saturating_sub(1),
        newest_sequence: hub.newest_sequence(),
        state: Some(state_to_wire(&hub.present_state())),
    }))
}
