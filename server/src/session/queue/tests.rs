//! Laws of the queue: nothing is lost or reordered.

use proptest::prelude::*;

use super::*;
use crate::hub::SampleTag;

fn queue(max_frames: usize) -> WorkQueue {
    WorkQueue::new(max_frames, 1 << 20, BufferBudget::new(1 << 30))
}

fn waiting(number: u64) -> WaitingFrame {
    WaitingFrame {
        frame: IncomingFrame {
            number,
            capture_time_nanos: 0,
            positions: Vec::new(),
            tag: SampleTag::default(),
            content_hash: 0,
            n_partial_markers: 0,
            sent: bytes::Bytes::new(),
        },
        gaps_before: Vec::new(),
        received_nanos: 0,
    }
}

fn drained(queue: &mut WorkQueue) -> Vec<(u64, u64, bool)> {
    let mut spans = Vec::new();
    while let Some(work) = queue.pop() {
        match work {
            Work::Frame(it) => {
                for gap in it.gaps_before {
                    spans.push((gap.first, gap.last, false));
                }
                spans.push((it.frame.number, it.frame.number, true));
            }
            Work::Gaps(gaps) => {
                spans.extend(gaps.iter().map(|it| (it.first, it.last, false)));
            }
            Work::Command(_) => {}
        }
    }
    spans
}

#[test]
fn the_oldest_is_shed_and_leaves_its_gap_in_its_place() {
    let mut queue = queue(3);
    for number in 1..=3 {
        queue.push_frame(waiting(number));
    }
    assert!(!queue.has_room(1));
    assert!(queue.shed_oldest());
    assert!(queue.shed_oldest());
    queue.push_frame(waiting(4));
    assert_eq!(
        drained(&mut queue),
        [(1, 2, false), (3, 3, true), (4, 4, true)]
    );
}

#[test]
fn bytes_count_too_and_are_given_back() {
    let budget = BufferBudget::new(1 << 30);
    let mut queue = WorkQueue::new(10, 1, budget.clone());
    assert!(queue.has_room(1_000));
    queue.push_frame(waiting(1));
    assert!(!queue.has_room(1));
    assert!(budget.used_bytes() > 0);
    drop(queue);
    assert_eq!(budget.used_bytes(), 0);
}

proptest! {
    /// However frames come, go and are shed, the numbers come out in order and each once.
    #[test]
    fn nothing_is_lost_or_reordered(steps in prop::collection::vec(0u8..8, 1..300)) {
        let mut queue = queue(16);
        let mut out = Vec::new();
        let mut next = 1;
        for step in steps {
            match step {
                0 => { out.extend(queue.pop().map(|it| { let mut one = WorkQueue::new(16, 1 << 20, BufferBudget::new(1)); match it {
                    Work::Frame(it) => one.push_frame(*it), Work::Gaps(it) => one.push_gaps(it), Work::Command(_) => {} } drained(&mut one) }).into_iter().flatten()); }
                1 => { queue.shed_oldest(); }
                _ => {
                    let mut frame = waiting(next);
                    if step == 3 {
                        frame.gaps_before = vec![Gap { first: next, last: next + 2, cause: GapCause::CaptureSkip }];
                        frame.frame.number += 3;
                    }
                    next = frame.frame.number + 1;
                    queue.push_frame(frame);
                }
            }
        }
        out.extend(drained(&mut queue));
        let mut expected = 1;
        for (first, last, _) in out {
            prop_assert_eq!(first, expected);
            expected = last + 1;
        }
        prop_assert_eq!(expected, next);
        prop_assert_eq!(queue.n_frames, 0);
        prop_assert_eq!(queue.bytes, 0);
    }
}
