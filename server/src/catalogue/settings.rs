//! A session's settings as they are stored: the effective values, not what was asked for.

use std::time::Duration;

use frontalis_analysis::analyzer::{MarkerSettings, RegionMode};
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
            },
            stale_after: record.stale_after_nanos.map(Duration::from_nanos),
            publisher_timeout: Duration::from_nanos(record.publisher_timeout_nanos),
        }
    }
}

/// Settings are limited to hours; u64 nanoseconds hold centuries.
fn nanos(duration: Duration) -> u64 {
    u64::try_from(duration.as_nanos()).unwrap_or(u64::MAX)
}
