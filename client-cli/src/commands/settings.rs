//! The settings of a session as flags, shared by `session create`, `session update` and `solve`.

use clap::{Args, ValueEnum};
use frontalis_analysis::analyzer::{MarkerSettings, RegionMode};
use frontalis_client::proto;
use frontalis_proto::FieldMask;

use super::objective::ObjectiveArgs;

/// How the regions of the face share one frame's problem.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Regions {
    /// All markers, all muscles and the head's pose in one problem
    Joint,
    /// Upper and lower region apart, as in the paper
    Split,
}

/// What the analysis itself depends on.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Analysis")]
pub struct AnalysisArgs {
    /// Neutral frames at the start that are averaged for the alignment, 1 to 256 [default: 15]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=256))]
    neutral_frames: Option<u32>,

    /// Let muscles contract up to 2 instead of 1 [default: false]
    #[arg(long, value_name = "BOOL", num_args = 0..=1, default_missing_value = "true", require_equals = true)]
    exaggeration: Option<bool>,

    /// Take the head as still instead of solving for its motion [default: false]
    #[arg(long, value_name = "BOOL", num_args = 0..=1, default_missing_value = "true", require_equals = true)]
    fixed_head: Option<bool>,

    /// One problem or two [default: joint]
    #[arg(long, value_enum)]
    regions: Option<Regions>,

    #[command(flatten)]
    objective: ObjectiveArgs,
}

impl AnalysisArgs {
    /// What `solve` hands to the analysis.
    pub fn to_marker_settings(&self) -> anyhow::Result<MarkerSettings> {
        let default = MarkerSettings::default();
        Ok(MarkerSettings {
            neutral_frames: self
                .neutral_frames
                .map_or(default.neutral_frames, |it| it as usize),
            allow_exaggeration: self.exaggeration.unwrap_or(default.allow_exaggeration),
            region_mode: match self.regions {
                Some(Regions::Split) => RegionMode::Split,
                Some(Regions::Joint) | None => RegionMode::Joint,
            },
            stabilize_head: self.fixed_head.map_or(default.stabilize_head, |it| !it),
            align_on_request: false,
            objective: self.objective.to_objective()?,
        })
    }
}

/// Everything a session may be told.
#[derive(Clone, Debug, Default, Args)]
pub struct SettingsArgs {
    #[command(flatten)]
    analysis: AnalysisArgs,

    /// Align when `session recenter` is called, not on the first frames [default: false]
    #[arg(long, value_name = "BOOL", num_args = 0..=1, default_missing_value = "true", require_equals = true)]
    align_on_request: Option<bool>,

    /// Milliseconds without a frame until the session is stale, 10 to 3600000 [default: three frames, at least 100]
    #[arg(long, value_name = "MILLIS", value_parser = clap::value_parser!(u32).range(10..=3_600_000))]
    stale_after_millis: Option<u32>,

    /// Seconds of silence until another publisher may have the session, 1 to 3600 [default: 10]
    #[arg(long, value_name = "SECS", value_parser = clap::value_parser!(u32).range(1..=3_600))]
    publisher_timeout_secs: Option<u32>,
}

impl SettingsArgs {
    /// The settings that were given; the others stay absent.
    pub fn to_proto(&self) -> proto::SessionSettings {
        let analysis = &self.analysis;
        let mut settings = proto::SessionSettings {
            neutral_frames: analysis.neutral_frames,
            allow_exaggeration: analysis.exaggeration,
            stabilize_head: analysis.fixed_head.map(|it| !it),
            align_on_request: self.align_on_request,
            stale_after: self.stale_after_millis.map(millis),
            publisher_timeout: self
                .publisher_timeout_secs
                .map(|secs| pbjson_types::Duration {
                    seconds: secs.into(),
                    nanos: 0,
                }),
            ..proto::SessionSettings::default()
        };
        match analysis.regions {
            Some(Regions::Joint) => settings.set_region_mode(proto::RegionMode::Joint),
            Some(Regions::Split) => settings.set_region_mode(proto::RegionMode::Split),
            None => {}
        }
        analysis.objective.fill(&mut settings);
        settings
    }

    /// Names what was given, where a list was given as `none`: without a mask an empty list counts as not given.
    pub fn update_mask(&self) -> anyhow::Result<Option<FieldMask>> {
        let emptied = self.analysis.objective.emptied_lists();
        if emptied.is_empty() {
            return Ok(None);
        }
        // In JSON absent fields are left out, and a mask is the names of fields joined by commas.
        let given = serde_json::to_value(self.to_proto())?;
        let given = given.as_object().into_iter().flatten();
        let given = given.map(|(name, _)| name.as_str());
        let paths = given.chain(emptied).collect::<Vec<_>>().join(",");
        Ok(Some(serde_json::from_value(paths.into())?))
    }
}

#[expect(
    clippy::cast_possible_wrap,
    reason = "a remainder below 1,000, times 1,000,000, fits i32"
)]
fn millis(millis: u32) -> pbjson_types::Duration {
    pbjson_types::Duration {
        seconds: i64::from(millis / 1_000),
        nanos: (millis % 1_000 * 1_000_000) as i32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setting_that_was_not_given_stays_absent() {
        assert_eq!(
            SettingsArgs::default().to_proto(),
            proto::SessionSettings::default()
        );
        assert_eq!(
            AnalysisArgs::default().to_marker_settings().unwrap(),
            MarkerSettings::default()
        );
        assert_eq!(SettingsArgs::default().update_mask().unwrap(), None);
    }

    #[test]
    fn the_same_flags_mean_the_same_for_a_session_and_for_a_file() {
        let analysis = AnalysisArgs {
            neutral_frames: Some(3),
            exaggeration: Some(true),
            fixed_head: Some(true),
            regions: Some(Regions::Split),
            objective: ObjectiveArgs::default(),
        };
        let local = analysis.to_marker_settings().unwrap();
        assert_eq!(local.neutral_frames, 3);
        assert!(local.allow_exaggeration && !local.stabilize_head);
        assert_eq!(local.region_mode, RegionMode::Split);
        let wire = SettingsArgs {
            analysis,
            stale_after_millis: Some(1_250),
            ..SettingsArgs::default()
        }
        .to_proto();
        assert_eq!(wire.neutral_frames, Some(3));
        assert_eq!(wire.allow_exaggeration, Some(true));
        assert_eq!(wire.stabilize_head, Some(false));
        assert_eq!(wire.region_mode(), proto::RegionMode::Split);
        let stale_after = wire.stale_after.unwrap();
        assert_eq!((stale_after.seconds, stale_after.nanos), (1, 250_000_000));
    }
}
