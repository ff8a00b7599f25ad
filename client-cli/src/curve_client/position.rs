//! Where a subscriber stands in a session's samples, and where it goes on after a cut.
//!
//! Completeness is proved from `sequence` alone (CONTRACTS D-2): it grows by exactly one inside a run.
//! Pure: knows no network and no clock.

use super::{CurveEvent, StartAt};
use crate::{
    error::ClientError,
    proto::{CurveHeader, CurveSample, Gap},
};

/// The run and the last sample of a subscription to every frame.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Position {
    run: u64,
    last_sequence: u64,
    last_frame: u64,
    /// The first sample that is wanted of the run; 0: not known.
    first_sequence: u64,
    /// Where to go on when the sample after the last cannot be had.
    elsewhere: Option<StartAt>,
}

impl Position {
    /// A header arrived; tells of a run that began meanwhile. The run before it was followed to its end, so that all of a new
    /// one is wanted.
    pub fn begin(&mut self, header: &CurveHeader) -> Option<CurveEvent> {
        let run = header.run;
        let previous = std::mem::replace(&mut self.run, run);
        if previous == 0 {
            self.first_sequence = header.next_sequence;
        }
        if previous == 0 || previous == run {
            return None;
        }
        *self = Self {
            run,
            first_sequence: 1,
            ..Self::default()
        };
        Some(CurveEvent::NewRun {
            previous,
            present: run,
        })
    }

    /// Where to subscribe again.
    pub fn resume(&self, asked_for: StartAt) -> StartAt {
        if let Some(elsewhere) = self.elsewhere {
            return elsewhere;
        }
        match (self.run, self.last_sequence) {
            (0, _) => asked_for,
            (_, 0) if self.first_sequence == 0 => asked_for,
            (run, 0) => StartAt::Sequence {
                run,
                sequence: self.first_sequence,
            },
            (run, last) => StartAt::Sequence {
                run,
                sequence: last + 1,
            },
        }
    }

    /// Whether a header arrived, on any connection.
    pub fn has_begun(&self) -> bool {
        self.run != 0
    }

    /// The server does not have the next sample: the refusal says where there is more, in this run or the one that followed it;
    /// else the oldest that is kept follows. Its sequence tells what was lost.
    pub fn lose_place(&mut self, refusal: &ClientError) {
        let number = |key: &str| refusal.metadata.get(key)?.parse().ok();
        let in_this_run = |sequence| StartAt::Sequence {
            run: self.run,
            sequence,
        };
        let next = match refusal.reason.as_deref() {
            // The server may have it by now, or says where there is more.
            Some("SUBSCRIBER_LAGGED") if self.last_sequence != 0 => {
                self.elsewhere = None;
                return;
            }
            Some("SEQUENCE") => number("first_available").map(in_this_run),
            Some("NEW_RUN") => number("run").map(|run| StartAt::Sequence { run, sequence: 1 }),
            _ => None,
        };
        // Where there was nothing once, it is not looked for again.
        let next = next.filter(|it| self.elsewhere.as_ref() != Some(it));
        self.elsewhere = Some(next.unwrap_or(StartAt::Oldest));
    }

    /// The events of one sample: nothing for one already seen, a loss before one that leaves a hole.
    pub fn sample(&mut self, sample: CurveSample) -> Vec<CurveEvent> {
        let sequence = sample.sequence;
        if self.last_sequence != 0 && sequence <= self.last_sequence {
            return Vec::new();
        }
        let mut events = Vec::with_capacity(2);
        let expected = match self.last_sequence {
            0 => self.first_sequence,
            last => last + 1,
        };
        if expected != 0 && sequence > expected {
            events.push(CurveEvent::Lost {
                first_sequence: expected,
                last_sequence: sequence - 1,
            });
        }
        self.elsewhere = None;
        self.last_sequence = sequence;
        self.last_frame = self.last_frame.max(sample.frame);
        events.push(CurveEvent::Sample(sample));
        events
    }

    /// What of a gap was not told before: gaps just before a sample are repeated on resumption, and of the end of a run that
    /// crashed some samples may have been heard that its take lacks.
    pub fn gap(&mut self, gap: Gap) -> Option<CurveEvent> {
        if gap.last <= self.last_frame {
            return None;
        }
        let first = gap.first.max(self.last_frame + 1);
        self.last_frame = gap.last;
        Some(CurveEvent::Gap(Gap { first, ..gap }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(run: u64, next_sequence: u64) -> CurveHeader {
        CurveHeader {
            run,
            next_sequence,
            ..CurveHeader::default()
        }
    }

    fn sample(sequence: u64) -> CurveSample {
        CurveSample {
            frame: sequence + 100,
            sequence,
            ..CurveSample::default()
        }
    }

    #[test]
    fn goes_on_after_the_last_sample_of_its_run() {
        let mut position = Position::default();
        assert_eq!(position.resume(StartAt::Now), StartAt::Now);
        assert_eq!(position.begin(&header(3, 0)), None);
        assert_eq!(
            position.resume(StartAt::Now),
            StartAt::Now,
            "no more is known"
        );
        position.sample(sample(41));
        let expected = StartAt::Sequence {
            run: 3,
            sequence: 42,
        };
        assert_eq!(position.resume(StartAt::Now), expected);
    }

    #[test]
    fn a_hole_is_reported_exactly_and_a_repetition_not_at_all() {
        let mut position = Position::default();
        position.begin(&header(1, 0));
        assert_eq!(position.sample(sample(5)).len(), 1);
        assert_eq!(position.sample(sample(5)), []);
        let events = position.sample(sample(9));
        let lost = CurveEvent::Lost {
            first_sequence: 6,
            last_sequence: 8,
        };
        assert_eq!(events, [lost, CurveEvent::Sample(sample(9))]);
    }

    #[test]
    fn of_a_gap_only_what_lies_behind_the_last_frame_is_told() {
        let mut position = Position::default();
        position.begin(&header(1, 0));
        position.sample(sample(5));
        let gap = |first, last| Gap {
            first,
            last,
            ..Gap::default()
        };
        assert_eq!(position.gap(gap(90, 105)), None);
        assert_eq!(
            position.gap(gap(103, 110)),
            Some(CurveEvent::Gap(gap(106, 110)))
        );
        assert_eq!(position.gap(gap(103, 110)), None);
    }

    #[test]
    fn a_place_that_is_gone_goes_on_at_the_oldest_and_tells_what_was_lost() {
        let mut position = Position::default();
        position.begin(&header(1, 0));
        position.sample(sample(5));
        let refusal = ClientError::local(tonic::Code::DataLoss, "lost");
        position.lose_place(&refusal);
        assert_eq!(position.resume(StartAt::Now), StartAt::Oldest);
        assert_eq!(position.sample(sample(4)), []);
        assert_eq!(position.sample(sample(20)).len(), 2);
        let expected = StartAt::Sequence {
            run: 1,
            sequence: 21,
        };
        assert_eq!(position.resume(StartAt::Now), expected);
    }

    fn refusal(reason: &str, key: &str, value: &str) -> ClientError {
        ClientError {
            reason: Some(reason.to_owned()),
            metadata: [(key.to_owned(), value.to_owned())].into(),
            ..ClientError::local(tonic::Code::OutOfRange, reason)
        }
    }

    #[test]
    fn a_refusal_says_where_there_is_more() {
        let mut position = Position::default();
        position.begin(&header(1, 0));
        position.sample(sample(5));
        let at = |run, sequence| StartAt::Sequence { run, sequence };
        position.lose_place(&refusal("SUBSCRIBER_LAGGED", "last_lost", "8"));
        assert_eq!(position.resume(StartAt::Now), at(1, 6));
        position.lose_place(&refusal("SEQUENCE", "first_available", "12"));
        assert_eq!(position.resume(StartAt::Now), at(1, 12));
        // It is gone too by now.
        position.lose_place(&refusal("SEQUENCE", "first_available", "12"));
        assert_eq!(position.resume(StartAt::Now), StartAt::Oldest);
        position.lose_place(&refusal("NEW_RUN", "run", "2"));
        assert_eq!(position.resume(StartAt::Now), at(2, 1));
        position.begin(&header(2, 0));
        let lost = CurveEvent::Lost {
            first_sequence: 1,
            last_sequence: 3,
        };
        assert_eq!(
            position.sample(sample(4)),
            [lost, CurveEvent::Sample(sample(4))]
        );
    }

    #[test]
    fn before_its_first_sample_it_goes_on_where_it_began() {
        let mut position = Position::default();
        position.begin(&header(3, 41));
        let expected = StartAt::Sequence {
            run: 3,
            sequence: 41,
        };
        assert_eq!(position.resume(StartAt::Now), expected);
        position.begin(&header(3, 50));
        let lost = CurveEvent::Lost {
            first_sequence: 41,
            last_sequence: 49,
        };
        let events = position.sample(sample(50));
        assert_eq!(events, [lost, CurveEvent::Sample(sample(50))]);
    }

    #[test]
    fn a_gap_is_told_once() {
        let mut position = Position::default();
        let gap = Gap {
            first: 3,
            last: 7,
            cause: 1,
        };
        assert_eq!(position.gap(gap), Some(CurveEvent::Gap(gap)));
        assert_eq!(position.gap(gap), None);
    }

    #[test]
    fn a_new_run_is_reported_and_counts_anew() {
        let mut position = Position::default();
        position.begin(&header(1, 0));
        position.sample(sample(500));
        let new_run = CurveEvent::NewRun {
            previous: 1,
            present: 2,
        };
        assert_eq!(position.begin(&header(2, 0)), Some(new_run));
        assert_eq!(position.sample(sample(1)).len(), 1);
    }
}
