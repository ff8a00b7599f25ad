//! Takes on the wire, and what people may say of them.

use std::time::Duration;

use frontalis_proto::v1;

use super::{
    actor::timestamp,
    common::timecode_to_wire,
    invalid::{FieldError, FieldProblem},
};
use crate::catalogue::{TakeLabels, TakeRow, TakeState};

/// Longest slate and gesture, code points.
pub const MAX_LABEL: usize = 128;
/// Longest notes, code points.
pub const MAX_NOTES: usize = 4_096;

/// A take on the wire.
pub fn take(row: &TakeRow) -> v1::Take {
    let TakeLabels {
        slate,
        number,
        gesture,
        circled,
        notes,
    } = row.labels.clone();
    v1::Take {
        name: row.id.resource(),
        session: row.session.resource(),
        actor: row.actor.resource(),
        actor_revision: row.actor_revision,
        slate,
        number,
        start_time: Some(timestamp(row.start_time_nanos)),
        stop_time: row.stop_time_nanos.map(timestamp),
        first_frame: row.content.first_frame,
        last_frame: row.content.last_frame,
        n_frames: row.content.n_frames,
        n_bytes: row.content.n_bytes,
        recovered: row.recovered,
        gesture,
        start_timecode: row.start_timecode.as_ref().map(timecode_to_wire),
        state: state(row.state).into(),
        circled,
        notes,
        with_images: row.with_images,
        resolved_from: row
            .resolved_from
            .as_ref()
            .map_or_else(String::new, super::super::name::TakeId::resource),
    }
}

fn state(state: TakeState) -> v1::TakeState {
    match state {
        TakeState::Recording => v1::TakeState::Recording,
        TakeState::Recovering => v1::TakeState::Recovering,
        TakeState::Closed => v1::TakeState::Closed,
        TakeState::Degraded => v1::TakeState::Degraded,
        TakeState::TruncatedDiskFull => v1::TakeState::TruncatedDiskFull,
        TakeState::Quarantined => v1::TakeState::Quarantined,
    }
}

/// A take that begins.
#[derive(Clone, Debug, Default)]
pub struct NewTake {
    /// What is said of it.
    pub labels: TakeLabels,
    /// Raw images are kept too.
    pub with_images: bool,
    /// So much of what came before.
    pub pre_roll: Duration,
}

/// Longest pre-roll: no session holds more.
const MAX_PRE_ROLL: Duration = Duration::from_secs(10);

/// Checks what is asked of a take that begins.
///
/// # Errors
///
/// [`FieldError`] names the first field that is wrong.
pub fn new_take(sent: &v1::StartTakeRequest) -> Result<NewTake, FieldError> {
    Ok(NewTake {
        labels: TakeLabels {
            slate: text("slate", &sent.slate, MAX_LABEL)?,
            number: sent.number,
            gesture: text("gesture", &sent.gesture, MAX_LABEL)?,
            circled: false,
            notes: String::new(),
        },
        with_images: sent.with_images,
        pre_roll: sent.pre_roll.map(pre_roll).transpose()?.unwrap_or_default(),
    })
}

fn pre_roll(sent: pbjson_types::Duration) -> Result<Duration, FieldError> {
    let given = Duration::try_from(sent).ok();
    given.filter(|it| *it <= MAX_PRE_ROLL).ok_or_else(|| {
        let expected = "0 to 10 s";
        FieldError::new("pre_roll", FieldProblem::Duration { expected })
    })
}

/// `labels` as an update wants them; a mask names what changes, without one all that is not empty does.
///
/// # Errors
///
/// [`FieldError`] names the first field that is wrong.
pub fn relabeled(
    labels: &TakeLabels,
    sent: &v1::Take,
    mask: &[String],
) -> Result<TakeLabels, FieldError> {
    const FIELDS: [&str; 5] = ["slate", "number", "gesture", "circled", "notes"];
    let bare = |path: &String| path.strip_prefix("take.").unwrap_or(path).to_owned();
    let mask: Vec<String> = mask.iter().map(bare).collect();
    if mask.iter().any(|it| !FIELDS.contains(&it.as_str())) {
        let detail = "slate, number, gesture, circled and notes may be changed";
        return Err(FieldError::unusable("update_mask", "FIELD_MASK", detail));
    }
    let wants = |field: &str, is_given: bool| {
        mask.iter().any(|it| it == field) || (mask.is_empty() && is_given)
    };
    let mut next = labels.clone();
    if wants("slate", !sent.slate.is_empty()) {
        next.slate = text("take.slate", &sent.slate, MAX_LABEL)?;
    }
    if wants("number", sent.number != 0) {
        next.number = sent.number;
    }
    if wants("gesture", !sent.gesture.is_empty()) {
        next.gesture = text("take.gesture", &sent.gesture, MAX_LABEL)?;
    }
    if wants("circled", sent.circled) {
        next.circled = sent.circled;
    }
    if wants("notes", !sent.notes.is_empty()) {
        next.notes = text("take.notes", &sent.notes, MAX_NOTES)?;
    }
    Ok(next)
}

fn text(field: &'static str, sent: &str, limit: usize) -> Result<String, FieldError> {
    // Notes may have several lines.
    let is_bad = |it: char| it.is_control() && (it != '\n' || limit == MAX_LABEL);
    if sent.chars().count() > limit || sent.chars().any(is_bad) {
        let detail = format!("at most {limit} code points, and no control characters");
        return Err(FieldError::unusable(field, "NAME", detail));
    }
    Ok(sent.to_owned())
}
