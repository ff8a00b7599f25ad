//! Settings of a session: what was asked for becomes effective values, by default, by presence or by field mask.

use std::time::Duration;

use frontalis_analysis::analyzer::RegionMode;
use frontalis_proto::v1;

use crate::{
    session::SessionSettings,
    wire::invalid::{FieldError, FieldProblem},
};

/// Range of `neutral_frames`.
const NEUTRAL_FRAMES: std::ops::RangeInclusive<u32> = 1..=256;
/// Shortest and longest duration of a setting.
const DURATIONS: [Duration; 2] = [Duration::from_millis(10), Duration::from_secs(3_600)];

/// Every field of the message; a mask may name no other.
const FIELDS: [&str; 13] = [
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
];

/// `base` with what `asked` changes.
///
/// With an empty mask the fields that are present change; else the masked ones, and those of them that are absent go
/// back to their defaults. Paths are field names, with or without `settings.` before them.
///
/// # Errors
///
/// The first field or path that is refused, by its name in a request that holds them as `settings`.
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
    refuse_what_is_not_built(change, asked)?;
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
    Ok(next)
}

/// All settings as they take effect; what is not built is off.
pub fn effective(settings: &SessionSettings) -> v1::SessionSettings {
    let marker = &settings.marker;
    let region_mode = match marker.region_mode {
        RegionMode::Joint => v1::RegionMode::Joint,
        RegionMode::Split => v1::RegionMode::Split,
    };
    let proto = |it: Duration| Some(pbjson_types::Duration::from(it));
    v1::SessionSettings {
        neutral_frames: u32::try_from(marker.neutral_frames).ok(),
        allow_exaggeration: Some(marker.allow_exaggeration),
        smoothing: Some(0.0),
        sparsity: Some(0.0),
        robust: Some(false),
        stabilize_head: Some(marker.stabilize_head),
        stale_after: settings.stale_after.and_then(proto),
        publisher_timeout: proto(settings.publisher_timeout),
        record: Some(false),
        region_mode: region_mode.into(),
        plain: Some(false),
        align_on_request: Some(marker.align_on_request),
        record_images: Some(false),
    }
}

/// Which fields a request changes.
struct Change<'a> {
    mask: &'a [String],
}

impl Change<'_> {
    fn names(&self, field: &str) -> bool {
        self.mask.iter().any(|path| bare(path) == field)
    }

    fn put<T>(&self, field: &str, asked: Option<T>, place: &mut T, default: T) {
        let masked = self.names(field);
        if !self.mask.is_empty() && !masked {
            return;
        }
        match asked {
            Some(value) => *place = value,
            None if masked => *place = default,
            None => {}
        }
    }

    /// Whether the field's value counts.
    fn takes(&self, field: &str) -> bool {
        self.mask.is_empty() || self.names(field)
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

/// What later work fills may be asked to stay off, and nothing else.
fn refuse_what_is_not_built(
    change: &Change<'_>,
    asked: &v1::SessionSettings,
) -> Result<(), FieldError> {
    for (field, amount) in [("smoothing", asked.smoothing), ("sparsity", asked.sparsity)] {
        let Some(amount) = amount.filter(|_| change.takes(field)) else {
            continue;
        };
        if !(0.0..=1.0).contains(&amount) {
            let problem = FieldProblem::Range {
                found: amount.into(),
                expected: "0..=1",
            };
            return Err(FieldError::new(field, problem));
        }
        if amount > 0.0 {
            return Err(FieldError::new(field, FieldProblem::NotImplemented));
        }
    }
    let switches = [
        ("robust", asked.robust),
        ("record", asked.record),
        ("plain", asked.plain),
        ("record_images", asked.record_images),
    ];
    for (field, on) in switches {
        if on == Some(true) && change.takes(field) {
            return Err(FieldError::new(field, FieldProblem::NotImplemented));
        }
    }
    Ok(())
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
mod tests {
    use super::*;

    fn refused(asked: v1::SessionSettings) -> (&'static str, &'static str) {
        let error = apply(&asked, &[], &SessionSettings::default()).unwrap_err();
        (error.field(), error.reason())
    }

    fn off() -> v1::SessionSettings {
        v1::SessionSettings::default()
    }

    #[test]
    fn effective_settings_sent_back_change_nothing() {
        let mut settings = SessionSettings::default();
        settings.marker.neutral_frames = 30;
        settings.marker.region_mode = RegionMode::Split;
        settings.marker.stabilize_head = false;
        settings.stale_after = Some(Duration::from_millis(250));
        let back = apply(&effective(&settings), &[], &SessionSettings::default()).unwrap();
        assert_eq!(back, settings);
    }

    #[test]
    fn d13_each_number_out_of_range_is_named() {
        for count in [0, 257, u32::MAX] {
            let asked = v1::SessionSettings {
                neutral_frames: Some(count),
                ..off()
            };
            assert_eq!(refused(asked), ("neutral_frames", "SOLVER_OPTIONS"));
        }
        for amount in [-0.1, 1.1, f32::NAN, f32::INFINITY] {
            let smoothing = v1::SessionSettings {
                smoothing: Some(amount),
                ..off()
            };
            assert_eq!(refused(smoothing), ("smoothing", "SOLVER_OPTIONS"));
            let sparsity = v1::SessionSettings {
                sparsity: Some(amount),
                ..off()
            };
            assert_eq!(refused(sparsity), ("sparsity", "SOLVER_OPTIONS"));
        }
        for (seconds, nanos) in [(0, 0), (-1, 0), (3_601, 0), (i64::MAX, i32::MIN)] {
            let long = Some(pbjson_types::Duration { seconds, nanos });
            let stale = v1::SessionSettings {
                stale_after: long,
                ..off()
            };
            assert_eq!(refused(stale), ("stale_after", "SOLVER_OPTIONS"));
            let timeout = v1::SessionSettings {
                publisher_timeout: long,
                ..off()
            };
            assert_eq!(refused(timeout), ("publisher_timeout", "SOLVER_OPTIONS"));
        }
        let asked = v1::SessionSettings {
            region_mode: 5,
            ..off()
        };
        assert_eq!(refused(asked), ("region_mode", "ENUM"));
    }

    #[test]
    fn what_is_not_built_is_refused_when_asked_for_and_accepted_as_off() {
        let on = |change: fn(&mut v1::SessionSettings)| {
            let mut asked = off();
            change(&mut asked);
            refused(asked)
        };
        assert_eq!(
            on(|it| it.smoothing = Some(0.5)),
            ("smoothing", "NOT_IMPLEMENTED")
        );
        assert_eq!(
            on(|it| it.sparsity = Some(1.0)),
            ("sparsity", "NOT_IMPLEMENTED")
        );
        assert_eq!(
            on(|it| it.robust = Some(true)),
            ("robust", "NOT_IMPLEMENTED")
        );
        assert_eq!(
            on(|it| it.record = Some(true)),
            ("record", "NOT_IMPLEMENTED")
        );
        assert_eq!(on(|it| it.plain = Some(true)), ("plain", "NOT_IMPLEMENTED"));
        assert_eq!(
            on(|it| it.record_images = Some(true)),
            ("record_images", "NOT_IMPLEMENTED")
        );
        let base = SessionSettings::default();
        assert_eq!(apply(&effective(&base), &[], &base).unwrap(), base);
    }

    #[test]
    fn a_mask_changes_what_it_names_and_resets_what_is_absent() {
        let mut base = SessionSettings::default();
        base.marker.neutral_frames = 40;
        base.marker.stabilize_head = false;
        let asked = v1::SessionSettings {
            allow_exaggeration: Some(true),
            stabilize_head: Some(true),
            record: Some(true),
            ..off()
        };
        let mask = [
            "neutral_frames".to_owned(),
            "settings.allow_exaggeration".to_owned(),
        ];
        let next = apply(&asked, &mask, &base).unwrap();
        assert_eq!(next.marker.neutral_frames, 15);
        assert!(next.marker.allow_exaggeration);
        assert!(!next.marker.stabilize_head);
    }

    #[test]
    fn a_mask_with_an_unknown_path_is_refused() {
        let mask = ["neutral_frames".to_owned(), "colour".to_owned()];
        let error = apply(&off(), &mask, &SessionSettings::default()).unwrap_err();
        assert_eq!(
            (error.field(), error.reason()),
            ("update_mask", "FIELD_MASK")
        );
        assert!(error.to_string().contains("path 1"));
    }
}
