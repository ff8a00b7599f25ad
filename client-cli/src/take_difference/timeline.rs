//! Two takes' curves over time, as coarsely as a picture needs them.

/// Most spans that a timeline has; what is longer gets longer spans.
pub const MAX_SPANS: usize = 512;

/// Curves in spans of equally many frames, from the first frame on.
#[derive(Clone, Debug, Default)]
pub struct Timeline {
    first_frame: u64,
    /// 0 before the first frame.
    frames_per_span: u64,
    spans: Vec<Span>,
}

/// What one muscle does during one span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Least and most of the first take.
    pub first: [f32; 2],
    /// Least and most of the second take.
    pub second: [f32; 2],
    /// Largest difference.
    pub distance: f32,
}

/// One extent a muscle; nothing where no frame is common.
type Span = Option<Vec<Extent>>;

impl Extent {
    fn of([first, second]: [f32; 2]) -> Self {
        Self {
            first: [first; 2],
            second: [second; 2],
            distance: (second - first).abs(),
        }
    }

    fn with(self, other: Self) -> Self {
        let join = |a: [f32; 2], b: [f32; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        Self {
            first: join(self.first, other.first),
            second: join(self.second, other.second),
            distance: self.distance.max(other.distance),
        }
    }
}

impl Timeline {
    /// Frames come in their order.
    pub(super) fn add(&mut self, frame: u64, pairs: &[[f32; 2]]) {
        if self.spans.is_empty() {
            (self.first_frame, self.frames_per_span) = (frame, 1);
        }
        let from_first = frame.saturating_sub(self.first_frame);
        while from_first / self.frames_per_span >= MAX_SPANS as u64 {
            self.coarsen();
        }
        let span = usize::try_from(from_first / self.frames_per_span).unwrap_or(MAX_SPANS - 1);
        if self.spans.len() <= span {
            self.spans.resize(span + 1, None);
        }
        let extents = pairs.iter().copied().map(Extent::of).collect();
        self.spans[span] = joined(self.spans[span].take(), Some(extents));
    }

    /// Two spans become one.
    fn coarsen(&mut self) {
        self.frames_per_span = self.frames_per_span.saturating_mul(2);
        let mut spans = std::mem::take(&mut self.spans).into_iter();
        while let Some(one) = spans.next() {
            self.spans.push(joined(one, spans.next().flatten()));
        }
    }

    /// The first frame that both takes have.
    pub fn first_frame(&self) -> u64 {
        self.first_frame
    }

    /// The last frame that the last span can hold.
    pub fn last_frame(&self) -> u64 {
        let n_frames = self.frames_per_span.saturating_mul(self.spans.len() as u64);
        (self.first_frame.saturating_add(n_frames)).saturating_sub(1)
    }

    /// One muscle's spans; nothing where no frame is common.
    pub fn of_control(&self, control: usize) -> impl ExactSizeIterator<Item = Option<Extent>> {
        let extent = move |span: &Span| span.as_ref()?.get(control).copied();
        self.spans.iter().map(extent)
    }

    /// The largest differences of one muscle in at most `n_columns` equal parts.
    pub fn distances(&self, control: usize, n_columns: usize) -> Vec<f32> {
        let spans: Vec<_> = self.of_control(control).collect();
        let n_columns = n_columns.min(spans.len());
        let part = |column: usize| {
            let [start, end] = [column, column + 1].map(|it| it * spans.len() / n_columns);
            let distances = spans[start..end].iter().flatten().map(|it| it.distance);
            distances.fold(0.0, f32::max)
        };
        (0..n_columns).map(part).collect()
    }
}

fn joined(one: Span, other: Span) -> Span {
    match (one, other) {
        (Some(one), Some(other)) => {
            let pairs = one.into_iter().zip(other);
            Some(pairs.map(|(it, next)| it.with(next)).collect())
        }
        (one, other) => one.or(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_take_has_few_spans_and_its_largest_difference_stays_where_it_was() {
        let mut timeline = Timeline::default();
        for frame in 1_000..101_000 {
            let second = if frame == 51_000 { 0.75 } else { 0.25 };
            timeline.add(frame, &[[0.25, second]]);
        }
        let spans: Vec<_> = timeline.of_control(0).flatten().collect();
        assert!(spans.len() <= MAX_SPANS && spans.len() > MAX_SPANS / 4);
        assert!(timeline.first_frame() == 1_000 && timeline.last_frame() >= 100_999);
        let distances = timeline.distances(0, 10);
        let far: Vec<_> = (0..10).filter(|it| distances[*it] > 0.0).collect();
        assert_eq!(far, [5], "{distances:?}");
        let found = spans.iter().find(|it| it.distance > 0.0).unwrap();
        assert_eq!((found.first, found.second), ([0.25; 2], [0.25, 0.75]));
    }

    #[test]
    fn where_no_frame_is_common_there_is_nothing() {
        let mut timeline = Timeline::default();
        timeline.add(1, &[[0.0, 0.0]; 2]);
        timeline.add(4, &[[0.0, 0.5]; 2]);
        let spans: Vec<_> = timeline.of_control(1).collect();
        assert!(spans[1].is_none() && spans[2].is_none() && spans[3].is_some());
        assert_eq!(timeline.distances(1, 2), [0.0, 0.5]);
        assert!(Timeline::default().distances(0, 4).is_empty());
    }
}
