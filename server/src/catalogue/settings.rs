//! A session's settings as they are stored: the effective values, not what was asked for.

use std::time::Duration;

use frontalis_analysis::{
    analyzer::{MarkerSettings, RegionMode},
    marker_analysis::objective::{MuscleBounds, Objective},
};
use serde::{Deserialize, Serialize};

use super::CatalogueError;

/// What a session was created with, after defaults.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredSettings {
    /// The analysis of its markers.
    pub marker: MarkerSettings,
    /// Without a frame for so long the session is stale; absent: by the frame rate.
    pub stale_after: Option<Duration>,
    /// How long a publisher keeps its lease without a frame.
    pub publisher_timeout: Duration,
    /// A run is recorded from its first frame on.
    pub record: bool,
    /// That recording keeps raw images.
    pub record_images: bool,
}

impl StoredSettings {
    pub(super) fn to_text(&self) -> Result<String, CatalogueError> {
        serde_json::to_string(&Record::from(self)).map_err(|_| UNREADABLE)
    }

    pub(super) fn from_text(text: &str) -> Result<Self, CatalogueError> {
        let record: Record = serde_json::from_str(text).map_err(|_| UNREADABLE)?;
        Ok(record.into())
    }
}

const UNREADABLE: CatalogueError = CatalogueError::Unreadable {
    what: "session settings",
};

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "one a setting, as in MarkerSettings"
)]
struct Record {
    neutral_frames: usize,
    allow_exaggeration: bool,
    split_regions: bool,
    stabilize_head: bool,
    align_on_request: bool,
    stale_after_nanos: Option<u64>,
    publisher_timeout_nanos: u64,
    /// Absent in records of before there were takes: off.
    #[serde(default, rename = "record")]
    is_recorded: bool,
    #[serde(default, rename = "record_images")]
    with_images: bool,
    /// Absent in records of before there were terms and bounds: the defaults.
    #[serde(default)]
    objective: ObjectiveRecord,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ObjectiveRecord {
    robust: bool,
    smoothing: f64,
    sparsity: f64,
    symmetry: f64,
    bounds: Vec<BoundsRecord>,
    exclusive_pairs: Vec<[String; 2]>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct BoundsRecord {
    muscle: String,
    lower: f64,
    upper: f64,
}

impl From<&StoredSettings> for Record {
    fn from(settings: &StoredSettings) -> Self {
        let marker = &settings.marker;
        Self {
            neutral_frames: marker.neutral_frames,
            allow_exaggeration: marker.allow_exaggeration,
            split_regions: marker.region_mode == RegionMode::Split,
            stabilize_head: marker.stabilize_head,
            align_on_request: marker.align_on_request,
            stale_after_nanos: settings.stale_after.map(nanos),
            publisher_timeout_nanos: nanos(settings.publisher_timeout),
            is_recorded: settings.record,
            with_images: settings.record_images,
            objective: (&marker.objective).into(),
        }
    }
}

impl From<Record> for StoredSettings {
    fn from(record: Record) -> Self {
        let region_mode = if record.split_regions {
            RegionMode::Split
        } else {
            RegionMode::Joint
        };
        Self {
            marker: MarkerSettings {
                neutral_frames: record.neutral_frames,
                allow_exaggeration: record.allow_exaggeration,
                region_mode,
                stabilize_head: record.stabilize_head,
                align_on_request: record.align_on_request,
                objective: record.objective.into(),
            },
            stale_after: record.stale_after_nanos.map(Duration::from_nanos),
            publisher_timeout: Duration::from_nanos(record.publisher_timeout_nanos),
            record: record.is_recorded,
            record_images: record.with_images,
        }
    }
}

impl Default for ObjectiveRecord {
    fn default() -> Self {
        (&Objective::default()).into()
    }
}

impl From<&Objective> for ObjectiveRecord {
    fn from(objective: &Objective) -> Self {
        let record = |it: &MuscleBounds| BoundsRecord {
            muscle: it.muscle.clone(),
            lower: it.lower,
            upper: it.upper,
        };
        Self {
            robust: objective.robust,
            smoothing: objective.smoothing,
            sparsity: objective.sparsity,
            symmetry: objective.symmetry,
            bounds: objective.bounds.iter().map(record).collect(),
            exclusive_pairs: objective.exclusive_pairs.clone(),
        }
    }
}

impl From<ObjectiveRecord> for Objective {
    fn from(record: ObjectiveRecord) -> Self {
        let bounds = |it: BoundsRecord| MuscleBounds {
            muscle: it.muscle,
            lower: it.lower,
            upper: it.upper,
        };
        Self {
            robust: record.robust,
            smoothing: record.smoothing,
            sparsity: record.sparsity,
            symmetry: record.symmetry,
            bounds: record.bounds.into_iter().map(bounds).collect(),
            exclusive_pairs: record.exclusive_pairs,
        }
    }
}

/// Settings are limited to hours; u64 nanoseconds hold centuries.
fn nanos(duration: Duration) -> u64 {
    u64::try_from(duration.as_nanos()).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_read_back_to_the_same_bits() {
        let third = 1.0 / 3.0;
        let settings = StoredSettings {
            marker: MarkerSettings {
                neutral_frames: 7,
                region_mode: RegionMode::Split,
                objective: Objective {
                    smoothing: third,
                    symmetry: f64::from(0.1_f32),
                    bounds: vec![MuscleBounds {
                        muscle: "jaw".into(),
                        lower: 0.0,
                        upper: third,
                    }],
                    exclusive_pairs: vec![["jaw".into(), "kiss".into()]],
                    ..Objective::plain()
                },
                ..MarkerSettings::default()
            },
            stale_after: None,
            publisher_timeout: Duration::from_secs(10),
            record: true,
            record_images: false,
        };
        let text = settings.to_text().unwrap();
        assert_eq!(StoredSettings::from_text(&text).unwrap(), settings);
    }

    #[test]
    fn a_record_of_before_there_were_terms_has_the_default_objective() {
        let text = r#"{"neutral_frames":15,"allow_exaggeration":false,"split_regions":false,"stabilize_head":true,
            "align_on_request":false,"stale_after_nanos":null,"publisher_timeout_nanos":10000000000}"#;
        let settings = StoredSettings::from_text(text).unwrap();
        assert_eq!(settings.marker, MarkerSettings::default());
    }
}
