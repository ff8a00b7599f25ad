//! A timecode for every row of a format that wants one, with or without timecode on the stage.

use frontalis_analysis::timecode::{Counting, Timecode, TimecodeRate};

use super::turns::seconds;

/// Greatest fraction of a frame.
const MOST_OF_A_FRAME: f64 = 0.999;

/// Rates are those of television to so much.
const RATE_TOLERANCE: f64 = 5e-4;

/// Counts on from the first row where the stage has no timecode, and inside of a timecode that lasts several rows.
#[derive(Clone, Debug)]
pub(super) struct RowClock {
    start: Timecode,
    start_nanos: i64,
    /// The stage's timecode, and when it was first seen.
    shown: Option<(Timecode, i64)>,
}

impl RowClock {
    /// Starts at the first row, at midnight where it has no timecode.
    pub(super) fn new(start: Option<Timecode>, start_nanos: i64, rate_hz: Option<f64>) -> Self {
        let midnight = || Timecode::from_frame_count(0, nominal_rate(rate_hz));
        Self {
            start: start.unwrap_or_else(midnight),
            start_nanos,
            shown: None,
        }
    }

    pub(super) fn at(&mut self, own: Option<Timecode>, capture_time_nanos: i64) -> Timecode {
        match own {
            Some(own) if own.sub_frame() > 0.0 => own,
            Some(own) => {
                let (shown, since) = self.shown.unwrap_or((own, capture_time_nanos));
                let is_same = shown.label() == own.label();
                let since = if is_same { since } else { capture_time_nanos };
                self.shown = Some((own, since));
                let frames = seconds(since, capture_time_nanos) * own.rate().hz();
                with_fraction(own, frames)
            }
            None => {
                let hz = self.start.rate().hz();
                let frames = seconds(self.start_nanos, capture_time_nanos) * hz;
                let frames = frames + f64::from(self.start.sub_frame());
                #[expect(clippy::cast_possible_truncation, reason = "the cast saturates")]
                let whole = frames.floor() as i64;
                with_fraction(self.start.plus_frames(whole), frames - frames.floor())
            }
        }
    }
}

fn with_fraction(timecode: Timecode, fraction: f64) -> Timecode {
    #[expect(clippy::cast_possible_truncation, reason = "below 1")]
    let fraction = fraction.clamp(0.0, MOST_OF_A_FRAME) as f32;
    timecode.with_sub_frame(fraction).unwrap_or(timecode)
}

/// 60000/1001 for 59.94 frames a second, 60/1 for 60; 60/1 where nothing is known.
fn nominal_rate(rate_hz: Option<f64>) -> TimecodeRate {
    let rate_hz = rate_hz.unwrap_or(60.0).clamp(1.0, 1_000.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "1 to 1,000"
    )]
    let whole = rate_hz.round() as u32;
    let of_television = f64::from(whole) * 1_000.0 / 1_001.0;
    let is_of_television = (rate_hz / of_television - 1.0).abs() < RATE_TOLERANCE
        && (rate_hz / f64::from(whole) - 1.0).abs() > RATE_TOLERANCE;
    let (numerator, denominator) = if is_of_television {
        (whole * 1_000, 1_001)
    } else {
        (whole, 1)
    };
    TimecodeRate::new(numerator, denominator, Counting::NonDrop)
        .expect("invariant: neither is 0, and nothing is dropped")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn label(timecode: &Timecode) -> String {
        format!("{timecode}+{:.3}", timecode.sub_frame())
    }

    #[test]
    fn rows_without_timecode_count_on_from_the_first() {
        let start = Timecode::parse_at("00:00:59;29", "30000/1001").unwrap();
        let mut clock = RowClock::new(Some(start), 0, Some(60.0));
        let at = |clock: &mut RowClock, frames: f64| {
            #[expect(clippy::cast_possible_truncation, reason = "two frames at most")]
            let nanos = (frames * 1_001.0 / 30_000.0 * 1e9).round() as i64;
            label(&clock.at(None, nanos))
        };
        assert_eq!(at(&mut clock, 0.0), "00:00:59;29+0.000");
        assert_eq!(at(&mut clock, 0.5), "00:00:59;29+0.500");
        assert_eq!(at(&mut clock, 1.25), "00:01:00;02+0.250");
        assert_eq!(at(&mut clock, -1.0 + 1e-6), "00:00:59;28+0.000");
    }

    #[test]
    fn a_timecode_that_lasts_several_rows_is_divided() {
        let mut clock = RowClock::new(None, 0, None);
        let mut at = |text: &str, millis: i64| {
            let own = Timecode::parse_at(text, "25/1").unwrap();
            label(&clock.at(Some(own), millis * 1_000_000))
        };
        assert_eq!(at("10:00:00:00", 0), "10:00:00:00+0.000");
        assert_eq!(at("10:00:00:00", 10), "10:00:00:00+0.250");
        assert_eq!(at("10:00:00:00", 400), "10:00:00:00+0.999");
        assert_eq!(at("10:00:00:01", 40), "10:00:00:01+0.000");
    }

    #[test]
    fn a_take_without_timecode_starts_at_midnight_at_its_own_rate() {
        for (rate_hz, expected) in [
            (Some(59.94), "60000/1001"),
            (Some(23.976), "24000/1001"),
            (Some(60.0), "60/1"),
            (Some(59.998), "60/1"),
            (Some(120.0), "120/1"),
            (Some(f64::INFINITY), "1000/1"),
            (None, "60/1"),
        ] {
            let mut clock = RowClock::new(None, 5, rate_hz);
            let first = clock.at(None, 5);
            assert_eq!(first.rate().to_string(), expected, "{rate_hz:?}");
            assert_eq!(first.to_string(), "00:00:00:00");
        }
    }
}
