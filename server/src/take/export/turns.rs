//! Which frames are rows: those that come in their turn. Both readings of a take ask the same.

use frontalis_proto::v1::TakeFormat;

/// The frames so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Turns {
    last_frame: Option<u64>,
    /// Of an animation, whose times must grow too.
    clock: Option<Clock>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Clock {
    start_nanos: Option<i64>,
    last_s: f32,
}

impl Turns {
    pub(super) fn of(format: TakeFormat) -> Self {
        Self {
            last_frame: None,
            clock: (format == TakeFormat::Glb).then(Clock::default),
        }
    }

    /// Whether the frame of this number and capture time is the next row.
    pub(super) fn take(&mut self, number: u64, capture_time_nanos: i64) -> bool {
        let is_next = self.last_frame.is_none_or(|last| number > last);
        let is_later = |it: &mut Clock| it.take(capture_time_nanos);
        let is_row = is_next && self.clock.as_mut().is_none_or(is_later);
        if is_row {
            self.last_frame = Some(number);
        }
        is_row
    }

    /// When the last row was, seconds after the first.
    pub(super) fn last_s(&self) -> f32 {
        self.clock.map_or(0.0, |it| it.last_s)
    }
}

impl Clock {
    fn take(&mut self, capture_time_nanos: i64) -> bool {
        let Some(start_nanos) = self.start_nanos else {
            self.start_nanos = Some(capture_time_nanos);
            return true;
        };
        #[expect(clippy::cast_possible_truncation, reason = "glTF holds times as f32")]
        let time_s = seconds(start_nanos, capture_time_nanos) as f32;
        let is_later = time_s > self.last_s;
        if is_later {
            self.last_s = time_s;
        }
        is_later
    }
}

/// From one capture time to another, seconds.
pub(super) fn seconds(from_nanos: i64, to_nanos: i64) -> f64 {
    (i128::from(to_nanos) - i128::from(from_nanos)) as f64 / 1e9
}
