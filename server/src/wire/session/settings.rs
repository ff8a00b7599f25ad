//! Settings of a session: what was asked for becomes effective values, by default, by presence or by field mask.

mod objective;

use std::time::Duration;

use frontalis_analysis::analyzer::RegionMode;
use frontalis_proto::v1;

use crate::{
    session::SessionSettings,
    wire::{
        common::narrow,
        invalid::{FieldError, FieldProblem},
    },
};

pub use objective::check_objective;

/// Range of `neutral_frames`.
const NEUTRAL_FRAMES: std::ops::RangeInclusive<u32> = 1..=256;
/// Shortest and longest duration of a setting.
const DURATIONS: [Duration; 2] = [Duration::from_millis(10), Duration::from_hours(1)];

/// Every field of the message; a mask may name no other.
const FIELDS: [&str; 16] = [
    "neutral_frames",
    "allow_exaggeration",
    "smoothing",
    "sparsity",
    "robust",
    "stabilize_head",
    "stale_after",
    "publisher_timeout",
    "record",
    "region_mode",
    "plain",
    "align_on_request",
    "record_images",
    "symmetry",
    "bounds",
    "exclusive_pairs",
];

/// `base` with what `asked` changes.
///
/// With an empty mask the fields that are present change; else the masked ones, and those of them that are absent go
/// back to their defaults. A list counts as present when it is not empty, and is replaced as a whole. Paths are field
/// names, with or without `settings.` before them.
///
/// # Errors
///
/// The first field or path that is refused, by its name in a request that holds them as `settings`. [`check_objective`] asks the
/// rest, which depends on the actor.
pub fn apply(
    asked: &v1::SessionSettings,
    mask: &[String],
    base: &SessionSettings,
) -> Result<SessionSettings, FieldError> {
    check_mask(mask)?;
    changed(asked, &Change { mask }, base).map_err(|error| error.inside("settings"))
}

fn changed(
    asked: &v1::SessionSettings,
    change: &Change<'_>,
    base: &SessionSettings,
) -> Result<SessionSettings, FieldError> {
    let default = SessionSettings::default();
    let mut next = base.clone();
    let (marker, default_marker) = (&mut next.marker, &default.marker);
    change.put(
        "neutral_frames",
        asked.neutral_frames.map(neutral_frames).transpose()?,
        &mut marker.neutral_frames,
        default_marker.neutral_frames,
    );
    change.put(
        "allow_exaggeration",
        asked.allow_exaggeration,
        &mut marker.allow_exaggeration,
        default_marker.allow_exaggeration,
    );
    change.put(
        "stabilize_head",
        asked.stabilize_head,
        &mut marker.stabilize_head,
        default_marker.stabilize_head,
    );
    change.put(
        "region_mode",
        region_mode(asked.region_mode)?,
        &mut marker.region_mode,
        default_marker.region_mode,
    );
    change.put(
        "align_on_request",
        asked.align_on_request,
        &mut marker.align_on_request,
        default_marker.align_on_request,
    );
    marker.objective = objective::apply(change, asked, &marker.objective)?;
    let stale_after = asked
        .stale_after
        .map(|it| duration("stale_after", it))
        .transpose()?;
    change.put(
        "stale_after",
        stale_after.map(Some),
        &mut next.stale_after,
        default.stale_after,
    );
    let timeout = asked
        .publisher_timeout
        .map(|it| duration("publisher_timeout", it))
        .transpose()?;
    change.put(
        "publisher_timeout",
        timeout,
        &mut next.publisher_timeout,
        default.publisher_timeout,
    );
    change.put("record", asked.record, &mut next.record, default.record);
    change.put(
        "record_images",
        asked.record_images,
        &mut next.record_images,
        default.record_images,
    );
    Ok(next)
}

/// All settings as they are in force.
pub fn effective(settings: &SessionSettings) -> v1::SessionSettings {
    let marker = &settings.marker;
    let region_mode = match marker.region_mode {
        RegionMode::Joint => v1::RegionMode::Joint,
        RegionMode::Split => v1::RegionMode::Split,
    };
    let proto = |it: Duration| Some(pbjson_types::Duration::from(it));
    let objective = &marker.objective;
    v1::SessionSettings {
        neutral_frames: u32::try_from(marker.neutral_frames).ok(),
        allow_exaggeration: Some(marker.allow_exaggeration),
        smoothing: Some(narrow(objective.smoothing)),
        sparsity: Some(narrow(objective.sparsity)),
        robust: Some(objective.robust),
        stabilize_head: Some(marker.stabilize_head),
        stale_after: settings.stale_after.and_then(proto),
        publisher_timeout: proto(settings.publisher_timeout),
        record: Some(settings.record),
        region_mode: region_mode.into(),
        plain: Some(objective.is_plain()),
        align_on_request: Some(marker.align_on_request),
        record_images: Some(settings.record_images),
        symmetry: Some(narrow(objective.symmetry)),
        bounds: objective::bounds_to_wire(objective),
        exclusive_pairs: objective::pairs_to_wire(objective),
    }
}

/// The settings that [`effective`] wrote down.
///
/// # Errors
///
/// The first field that none of ours has.
pub fn of_effective(written: &v1::SessionSettings) -> Result<SessionSettings, FieldError> {
    apply(written, &[], &SessionSettings::default())
}

/// Which fields a request changes.
struct Change<'a> {
    mask: &'a [String],
}

impl Change<'_> {
    fn names(&self, field: &str) -> bool {
        self.mask.iter().any(|path| bare(path) == field)
    }

    /// What the request wants of a field; `None`: it stays.
    fn wanted<T>(&self, field: &str, asked: Option<T>, default: T) -> Option<T> {
        let masked = self.names(field);
        if !self.mask.is_empty() && !masked {
            return None;
        }
        asked.or(masked.then_some(default))
    }

    fn put<T>(&self, field: &str, asked: Option<T>, place: &mut T, default: T) {
        if let Some(value) = self.wanted(field, asked, default) {
            *place = value;
        }
    }
}

fn bare(path: &str) -> &str {
    path.strip_prefix("settings.").unwrap_or(path)
}

fn check_mask(mask: &[String]) -> Result<(), FieldError> {
    match mask.iter().position(|path| !FIELDS.contains(&bare(path))) {
        Some(index) => {
            let problem = FieldProblem::UnknownPath { index };
            Err(FieldError::new("update_mask", problem))
        }
        None => Ok(()),
    }
}

fn neutral_frames(count: u32) -> Result<usize, FieldError> {
    if !NEUTRAL_FRAMES.contains(&count) {
        let problem = FieldProblem::Range {
            found: count.into(),
            expected: "1..=256",
        };
        return Err(FieldError::new("neutral_frames", problem));
    }
    Ok(count as usize)
}

fn region_mode(mode: i32) -> Result<Option<RegionMode>, FieldError> {
    match v1::RegionMode::try_from(mode) {
        Ok(v1::RegionMode::Unspecified) => Ok(None),
        Ok(v1::RegionMode::Joint) => Ok(Some(RegionMode::Joint)),
        Ok(v1::RegionMode::Split) => Ok(Some(RegionMode::Split)),
        Err(_) => Err(FieldError::new(
            "region_mode",
            FieldProblem::UnknownEnum(mode),
        )),
    }
}

fn duration(field: &'static str, asked: pbjson_types::Duration) -> Result<Duration, FieldError> {
    let [least, most] = DURATIONS;
    Duration::try_from(asked)
        .ok()
        .filter(|it| (least..=most).contains(it))
        .ok_or_else(|| {
            let expected = "10 ms to 1 h";
            FieldError::new(field, FieldProblem::Duration { expected })
        })
}

#[cfg(test)]
mod tests;
