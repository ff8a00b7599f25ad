//! When a recorded frame goes out again: as long after the one before as it was captured, at another speed.

use std::time::Duration;

/// A longer time between two frames is a clock that was set, not a pause: the declared rate counts then.
const LONGEST_PAUSE_SECS: f64 = 10.0;

/// Nobody waits longer.
const LONGEST_TAKE: Duration = Duration::from_hours(8760);

/// Places frames in time. Pure: times are handed out as time since the first frame.
#[derive(Debug)]
pub struct Pacing {
    period_secs: f64,
    speed: f64,
    last_capture_nanos: Option<i64>,
    due_secs: f64,
}

impl Pacing {
    /// Frames of a declared rate, so many times as fast. Both are finite and positive.
    pub fn new(rate_hz: f64, speed: f64) -> Self {
        Self {
            period_secs: rate_hz.recip(),
            speed,
            last_capture_nanos: None,
            due_secs: 0.0,
        }
    }

    /// Frames that follow have another rate.
    pub fn set_rate(&mut self, rate_hz: f64) {
        self.period_secs = rate_hz.recip();
    }

    /// The next frame, with its time of capture: when it is due.
    pub fn due(&mut self, capture_time_nanos: i64) -> Duration {
        if let Some(last) = self.last_capture_nanos.replace(capture_time_nanos) {
            let step_nanos = capture_time_nanos.saturating_sub(last);
            let step_secs = step_nanos as f64 / 1e9;
            let is_usable = step_nanos > 0 && step_secs <= LONGEST_PAUSE_SECS;
            let step_secs = if is_usable {
                step_secs
            } else {
                self.period_secs
            };
            self.due_secs += step_secs / self.speed;
        }
        Duration::try_from_secs_f64(self.due_secs).map_or(LONGEST_TAKE, |due| due.min(LONGEST_TAKE))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn due_millis(times_millis: &[i64], speed: f64) -> Vec<u128> {
        let mut pacing = Pacing::new(100.0, speed);
        let times = times_millis.iter();
        times
            .map(|it| pacing.due(it * 1_000_000).as_millis())
            .collect()
    }

    #[test]
    fn frames_go_out_as_they_were_captured_at_any_speed() {
        let captured = [5_000, 5_010, 5_025, 7_025];
        assert_eq!(due_millis(&captured, 1.0), [0, 10, 25, 2_025]);
        assert_eq!(due_millis(&captured, 0.5), [0, 20, 50, 4_050]);
        assert_eq!(due_millis(&captured, 5.0), [0, 2, 5, 405]);
    }

    #[test]
    fn a_clock_that_stands_still_or_was_set_gives_the_declared_rate() {
        let captured = [0, 0, 3_600_000, -5, i64::MAX / 1_000_000];
        assert_eq!(due_millis(&captured, 1.0), [0, 10, 20, 30, 40]);
    }
}
