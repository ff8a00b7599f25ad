//! The terms of a session's objective and its bounds as flags, shared by `session create`, `session update` and `solve`.
//!
//! Numbers are `f32` as on the wire, so that a file and a session are solved to the same bits.

use std::str::FromStr;

use anyhow::bail;
use clap::Args;
use frontalis_analysis::marker_analysis::objective::{LARGEST_BOUND, MuscleBounds, Objective};
use frontalis_client::proto::{ControlBounds, ControlPair, SessionSettings};

use super::numbers;

/// What stands beside the paper's least squares.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Objective")]
pub struct ObjectiveArgs {
    /// The paper's least squares alone: no robust weights, smoothing, sparsity or symmetry; bounds and pairs stay [default: false]
    #[arg(long, value_name = "BOOL", num_args = 0..=1, default_missing_value = "true", require_equals = true)]
    plain: Option<bool>,

    /// Weigh outlying markers down, mask those that jump, undo swapped labels; costs no lag [default: true]
    #[arg(long, value_name = "BOOL", num_args = 0..=1, default_missing_value = "true", require_equals = true)]
    robust: Option<bool>,

    /// Smooth the curves, 0 (off) to 1: holds get calmer, jumps pass, more lags more [default: 0.5]
    #[arg(long, value_name = "STRENGTH", value_parser = numbers::strength, allow_negative_numbers = true)]
    smoothing: Option<f32>,

    /// Keep relaxed muscles at 0, 0 (off) to 1: more keeps weak contractions there too [default: 0.5]
    #[arg(long, value_name = "STRENGTH", value_parser = numbers::strength, allow_negative_numbers = true)]
    sparsity: Option<f32>,

    /// Draw a muscle and its mirror image together, 0 (off) to 1: more hides what is one-sided [default: 0]
    #[arg(long, value_name = "STRENGTH", value_parser = numbers::strength, allow_negative_numbers = true)]
    symmetry: Option<f32>,

    /// Bounds of one muscle within 0 to 2, once for each muscle; `none`: no muscle has its own [default: 0..1, with --exaggeration 0..2]
    #[arg(long, value_name = "MUSCLE=LOW..HIGH")]
    bounds: Vec<Entry<ControlBounds>>,

    /// Two muscles of which at most one is active, once for each pair, 16 at most, each up to two more solves a frame; `none`: no pair [default: none]
    #[arg(long, value_name = "MUSCLE,MUSCLE")]
    exclusive: Vec<Entry<ControlPair>>,
}

/// One entry of a list, or the word that stands for an empty one.
#[derive(Clone, Debug)]
enum Entry<T> {
    None,
    Of(T),
}

impl<T: FromEntry> FromStr for Entry<T> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "none" => Ok(Self::None),
            text => T::from_entry(text)
                .map(Self::Of)
                .ok_or_else(|| T::EXPECTED.to_owned()),
        }
    }
}

trait FromEntry: Sized {
    const EXPECTED: &'static str;

    fn from_entry(text: &str) -> Option<Self>;
}

impl FromEntry for ControlBounds {
    const EXPECTED: &'static str = "expected MUSCLE=LOW..HIGH with 0 <= LOW <= HIGH <= 2, or none";

    fn from_entry(text: &str) -> Option<Self> {
        let (control, bounds) = text.rsplit_once('=')?;
        let (lower, upper) = bounds.split_once("..")?;
        let (lower, upper): (f32, f32) = (lower.parse().ok()?, upper.parse().ok()?);
        let is_within = 0.0 <= lower && lower <= upper && f64::from(upper) <= LARGEST_BOUND;
        is_within.then(|| Self {
            control: control.to_owned(),
            lower,
            upper,
        })
    }
}

impl FromEntry for ControlPair {
    const EXPECTED: &'static str = "expected MUSCLE,MUSCLE, or none";

    fn from_entry(text: &str) -> Option<Self> {
        let (first, second) = text.split_once(',')?;
        Some(Self {
            first: first.to_owned(),
            second: second.to_owned(),
        })
    }
}

impl ObjectiveArgs {
    /// What `solve` hands to the analysis; whether the actor has the muscles shows there.
    pub fn to_objective(&self) -> anyhow::Result<Objective> {
        let is_plain = self.plain.unwrap_or_default();
        let base = if is_plain {
            Objective::plain()
        } else {
            Objective::default()
        };
        let own_bounds = |it: &ControlBounds| MuscleBounds {
            muscle: it.control.clone(),
            lower: it.lower.into(),
            upper: it.upper.into(),
        };
        let own_pair = |it: &ControlPair| [it.first.clone(), it.second.clone()];
        let objective = Objective {
            robust: self.robust.unwrap_or(base.robust),
            smoothing: self.smoothing.map_or(base.smoothing, f64::from),
            sparsity: self.sparsity.map_or(base.sparsity, f64::from),
            symmetry: self.symmetry.map_or(base.symmetry, f64::from),
            bounds: entries(&self.bounds).map(own_bounds).collect(),
            exclusive_pairs: entries(&self.exclusive).map(own_pair).collect(),
        };
        if is_plain && !objective.is_plain() {
            bail!("--plain switches every term off, and a term is asked for beside it");
        }
        Ok(objective)
    }

    /// Fills in what was given.
    pub fn fill(&self, settings: &mut SessionSettings) {
        settings.plain = self.plain;
        settings.robust = self.robust;
        settings.smoothing = self.smoothing;
        settings.sparsity = self.sparsity;
        settings.symmetry = self.symmetry;
        settings.bounds = entries(&self.bounds).cloned().collect();
        settings.exclusive_pairs = entries(&self.exclusive).cloned().collect();
    }

    /// The lists that were given as `none` and nothing else, by their names on the wire in JSON.
    pub fn emptied_lists(&self) -> Vec<&'static str> {
        let lists = [
            ("bounds", is_emptied(&self.bounds)),
            ("exclusivePairs", is_emptied(&self.exclusive)),
        ];
        let emptied = lists.into_iter().filter(|(_, is_emptied)| *is_emptied);
        emptied.map(|(name, _)| name).collect()
    }
}

fn entries<T>(list: &[Entry<T>]) -> impl Iterator<Item = &T> {
    list.iter().filter_map(|it| match it {
        Entry::None => None,
        Entry::Of(entry) => Some(entry),
    })
}

fn is_emptied<T>(list: &[Entry<T>]) -> bool {
    !list.is_empty() && entries(list).next().is_none()
}

#[cfg(test)]
mod tests {
    use clap::FromArgMatches as _;

    use super::*;

    fn parse(line: &str) -> Result<ObjectiveArgs, clap::Error> {
        let command = ObjectiveArgs::augment_args(clap::Command::new("solve"));
        let words = std::iter::once("solve").chain(line.split_whitespace());
        ObjectiveArgs::from_arg_matches(&command.try_get_matches_from(words)?)
    }

    fn wire(args: &ObjectiveArgs) -> SessionSettings {
        let mut settings = SessionSettings::default();
        args.fill(&mut settings);
        settings
    }

    #[test]
    fn nothing_given_is_the_default_and_stays_absent() {
        let args = parse("").unwrap();
        assert_eq!(args.to_objective().unwrap(), Objective::default());
        assert_eq!(wire(&args), SessionSettings::default());
        assert!(args.emptied_lists().is_empty());
    }

    #[test]
    fn the_same_flags_mean_the_same_for_a_session_and_for_a_file() {
        let line = "--smoothing 0.3 --sparsity 0 --robust=false --symmetry 1 --bounds jaw=0..0.7 --bounds kiss=0.1..2 --exclusive smile_left,kiss";
        let args = parse(line).unwrap();
        let (objective, wire) = (args.to_objective().unwrap(), wire(&args));
        assert_eq!(objective.smoothing.to_bits(), f64::from(0.3_f32).to_bits());
        assert_eq!((wire.smoothing, wire.sparsity), (Some(0.3), Some(0.0)));
        assert_eq!((objective.robust, wire.robust), (false, Some(false)));
        assert_eq!(wire.symmetry, Some(1.0));
        assert_eq!(objective.bounds.len(), 2);
        for (own, sent) in objective.bounds.iter().zip(&wire.bounds) {
            assert_eq!(own.muscle, sent.control);
            assert_eq!(own.lower.to_bits(), f64::from(sent.lower).to_bits());
            assert_eq!(own.upper.to_bits(), f64::from(sent.upper).to_bits());
        }
        assert_eq!(objective.exclusive_pairs, [["smile_left", "kiss"]]);
        assert_eq!(wire.exclusive_pairs[0].second, "kiss");
    }

    #[test]
    fn plain_is_alone_and_keeps_bounds() {
        let plain = parse("--plain --robust=false --bounds jaw=0..0.5").unwrap();
        let objective = plain.to_objective().unwrap();
        assert!(objective.is_plain());
        assert_eq!(objective.bounds.len(), 1);
        for term in [
            "--robust",
            "--smoothing 0.1",
            "--sparsity 1",
            "--symmetry 0.5",
        ] {
            let both = parse(&format!("--plain {term}")).unwrap();
            assert!(both.to_objective().is_err(), "{term}");
        }
    }

    #[test]
    fn none_empties_a_list() {
        let args = parse("--bounds none --exclusive none").unwrap();
        assert_eq!(args.emptied_lists(), ["bounds", "exclusivePairs"]);
        assert!(wire(&args).bounds.is_empty());
    }

    #[test]
    fn what_is_no_strength_bound_or_pair_is_a_usage_error() {
        for line in [
            "--smoothing 1.1",
            "--smoothing=-0.1",
            "--sparsity nan",
            "--symmetry two",
            "--bounds jaw",
            "--bounds jaw=0.5",
            "--bounds jaw=0.6..0.5",
            "--bounds jaw=-0.1..1",
            "--bounds jaw=0..2.1",
            "--bounds jaw=nan..1",
            "--exclusive jaw",
        ] {
            let error = parse(line).expect_err(line);
            assert_eq!(error.exit_code(), 2, "{line}");
        }
    }
}
