//! SMPTE ST 12-1 time of day (CONTRACTS D-34).

/// A valid time of day, as generated on the stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timecode {
    /// 0..=23.
    pub hours: u32,
    /// 0..=59.
    pub minutes: u32,
    /// 0..=59.
    pub seconds: u32,
    /// 0 to the nominal rate, exclusive.
    pub frames: u32,
    /// Frames per second as a fraction: 30000/1001, 60/1, ...
    pub rate_numerator: u32,
    /// Not 0.
    pub rate_denominator: u32,
    /// Two frame numbers are left out at most minutes.
    pub drop_frame: bool,
    /// 0 <= `sub_frame` < 1.
    pub sub_frame: f32,
    /// Opaque to the server.
    pub user_bits: u32,
}

impl Timecode {
    /// The timecode when it can occur, else nothing.
    pub fn checked(self) -> Option<Self> {
        let rate = (self.rate_numerator, self.rate_denominator);
        let nominal_rate = self.rate_numerator.div_ceil(self.rate_denominator.max(1));
        let in_range = self.rate_denominator != 0
            && self.hours < 24
            && self.minutes < 60
            && self.seconds < 60
            && self.frames < nominal_rate
            && (0.0..1.0).contains(&self.sub_frame);
        let may_drop = matches!(rate, (30_000 | 60_000, 1_001));
        let is_dropped = self.seconds == 0 && self.frames < 2 && !self.minutes.is_multiple_of(10);
        let drop_is_right = !self.drop_frame || (may_drop && !is_dropped);
        (in_range && drop_is_right).then_some(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(hours: u32, minutes: u32, seconds: u32, frames: u32) -> Timecode {
        Timecode {
            hours,
            minutes,
            seconds,
            frames,
            rate_numerator: 30_000,
            rate_denominator: 1_001,
            drop_frame: true,
            sub_frame: 0.0,
            user_bits: 0,
        }
    }

    #[test]
    fn a25_the_last_frame_of_a_day_occurs_and_the_next_does_not() {
        assert!(at(23, 59, 59, 29).checked().is_some());
        assert!(at(25, 0, 0, 0).checked().is_none());
        assert!(at(23, 59, 59, 30).checked().is_none());
    }

    #[test]
    fn a25_dropped_numbers_do_not_occur() {
        assert!(at(1, 1, 0, 0).checked().is_none());
        assert!(at(1, 1, 0, 1).checked().is_none());
        assert!(at(1, 1, 0, 2).checked().is_some());
        assert!(at(1, 10, 0, 0).checked().is_some());
    }

    #[test]
    fn frames_are_dropped_at_two_rates_only() {
        let pal = Timecode {
            rate_numerator: 25,
            rate_denominator: 1,
            ..at(0, 0, 0, 3)
        };
        assert!(pal.checked().is_none());
        assert!(
            Timecode {
                drop_frame: false,
                ..pal
            }
            .checked()
            .is_some()
        );
    }

    #[test]
    fn a25_a_rate_of_nothing_and_a_broken_sub_frame_are_invalid() {
        assert!(
            Timecode {
                rate_numerator: 0,
                rate_denominator: 0,
                ..at(0, 0, 0, 0)
            }
            .checked()
            .is_none()
        );
        for sub_frame in [f32::NAN, -0.1, 1.0, f32::INFINITY] {
            assert!(
                Timecode {
                    sub_frame,
                    ..at(0, 0, 1, 0)
                }
                .checked()
                .is_none()
            );
        }
    }
}
