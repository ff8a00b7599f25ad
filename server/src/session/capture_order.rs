//! Whether capture times grow, as far as one clock made them.

/// The capture time of the last frame that was taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CaptureOrder {
    last_nanos: Option<i64>,
}

impl CaptureOrder {
    /// Goes on behind a frame of this capture time; `None`: with the first.
    pub fn after(last_nanos: Option<i64>) -> Self {
        Self { last_nanos }
    }

    /// The capture time of the last frame, if the next one's can be compared with it.
    pub fn last_nanos(self) -> Option<i64> {
        self.last_nanos
    }

    /// Takes in a frame; whether its time is not after the last one's.
    pub fn is_broken_by(&mut self, capture_time_nanos: i64) -> bool {
        let previous = self.last_nanos.replace(capture_time_nanos);
        previous.is_some_and(|it| capture_time_nanos <= it)
    }

    /// Another publisher's clock says nothing about the last one's.
    pub fn another_clock(&mut self) {
        self.last_nanos = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_compared_within_one_clock() {
        let mut order = CaptureOrder::default();
        assert!(!order.is_broken_by(7));
        assert!(order.is_broken_by(7));
        order.another_clock();
        assert!(!order.is_broken_by(3));
        assert!(CaptureOrder::after(order.last_nanos()).is_broken_by(2));
    }
}
