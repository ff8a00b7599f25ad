//! Laws of the frame order: every number has one effect.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;

use super::*;

const SECOND: i64 = 1_000_000_000;

fn gap(first: u64, last: u64, cause: GapCause) -> Gap {
    Gap { first, last, cause }
}

#[test]
fn a_run_begins_anywhere_without_a_gap() {
    let mut order = FrameOrder::new(10 * SECOND);
    assert_eq!(order.next_expected(), 0);
    assert!(order.accept(700, 1, 0).is_empty());
    assert_eq!(order.next_expected(), 701);
}

#[test]
fn skipped_and_rejected_numbers_are_told_apart() {
    let mut order = FrameOrder::new(10 * SECOND);
    order.accept(2, 0, 0);
    order.reject(5);
    order.reject(6);
    let gaps = order.accept(9, 0, 0);
    assert_eq!(
        gaps,
        [
            gap(3, 4, GapCause::CaptureSkip),
            gap(5, 6, GapCause::Rejected),
            gap(7, 8, GapCause::CaptureSkip),
        ]
    );
    assert!(order.finish().is_empty());
}

#[test]
fn a_rejected_frame_that_is_sent_right_leaves_no_gap() {
    let mut order = FrameOrder::new(10 * SECOND);
    order.accept(1, 0, 0);
    order.reject(2);
    assert!(order.accept(2, 0, 0).is_empty());
}

#[test]
fn another_publisher_explains_one_gap() {
    let mut order = FrameOrder::new(10 * SECOND);
    order.accept(1, 0, 0);
    order.publisher_changed();
    assert_eq!(
        order.accept(5, 0, 0),
        [gap(2, 4, GapCause::PublisherChange)]
    );
    assert_eq!(order.accept(7, 0, 0), [gap(6, 6, GapCause::CaptureSkip)]);
}

#[test]
fn a_jump_beyond_the_limit_is_no_gap() {
    let mut order = FrameOrder::new(10 * SECOND);
    order.accept(1, 0, 0);
    assert_eq!(order.judge(u64::MAX, 0), Verdict::Jump);
    assert_eq!(order.judge(2 + MAX_JUMP, 0), Verdict::Jump);
    assert_eq!(order.judge(1 + MAX_JUMP, 0), Verdict::New);
    order.reject(u64::MAX);
    assert!(order.finish().is_empty());
    let gaps = order.accept(1_000_000_001, 0, 0);
    assert_eq!(gaps, [gap(2, 1_000_000_000, GapCause::CaptureSkip)]);
}

#[test]
fn passed_numbers_are_resent_conflicting_or_late() {
    let mut order = FrameOrder::new(10 * SECOND);
    order.accept(3, 33, 0);
    order.accept(5, 55, SECOND);
    assert_eq!(order.judge(3, 33), Verdict::Duplicate);
    assert_eq!(order.judge(5, 33), Verdict::Conflict);
    assert_eq!(order.judge(4, 0), Verdict::Late);
    assert_eq!(order.judge(0, 0), Verdict::Late);
    order.accept(6, 66, 12 * SECOND);
    assert_eq!(order.judge(3, 33), Verdict::Late);
}

#[test]
fn the_last_number_of_all_is_no_overflow() {
    let mut order = FrameOrder::new(10 * SECOND);
    order.reject(u64::MAX - 1);
    let gaps = order.accept(u64::MAX, 0, 0);
    assert_eq!(gaps, [gap(u64::MAX - 1, u64::MAX - 1, GapCause::Rejected)]);
    assert_eq!(order.next_expected(), u64::MAX);
    assert_eq!(order.judge(u64::MAX, 0), Verdict::Duplicate);
}

#[derive(Clone, Debug)]
enum Sent {
    Frame(u64, u64),
    Broken(u64),
}

fn sent() -> impl Strategy<Value = Sent> {
    prop_oneof![
        4 => (1u64..60, 0u64..2).prop_map(|(number, hash)| Sent::Frame(number, hash)),
        1 => (1u64..60).prop_map(Sent::Broken),
    ]
}

proptest! {
    /// Whatever is sent again, skipped, broken or in conflict: every number takes effect once, the first content
    /// stands, and accepted frames and gaps together cover the run without overlap, in order.
    #[test]
    fn every_number_has_one_effect(steps in prop::collection::vec(sent(), 1..200)) {
        let mut order = FrameOrder::new(10 * SECOND);
        let mut accepted: BTreeMap<u64, u64> = BTreeMap::new();
        let mut rejected: BTreeSet<u64> = BTreeSet::new();
        let mut log: Vec<(u64, u64, Option<GapCause>)> = Vec::new();
        for step in steps {
            match step {
                Sent::Broken(number) => {
                    if number > order.accepted_through() { rejected.insert(number); }
                    order.reject(number);
                }
                Sent::Frame(number, hash) => {
                    let newest = accepted.last_key_value().map_or(0, |(it, _)| *it);
                    let expected = match accepted.get(&number) {
                        Some(first) if *first == hash => Verdict::Duplicate,
                        Some(_) => Verdict::Conflict,
                        None if number < newest => Verdict::Late,
                        None => Verdict::New,
                    };
                    prop_assert_eq!(order.judge(number, hash), expected);
                    if expected == Verdict::New {
                        for gap in order.accept(number, hash, 0) {
                            log.push((gap.first, gap.last, Some(gap.cause)));
                        }
                        log.push((number, number, None));
                        accepted.insert(number, hash);
                        rejected.remove(&number);
                    }
                }
            }
        }
        let first_accepted = accepted.first_key_value().map(|(it, _)| *it);
        for pair in log.windows(2) {
            prop_assert!(pair[0].0 <= pair[0].1);
            prop_assert!(pair[0].1 < pair[1].0);
            if first_accepted.is_some_and(|it| pair[0].0 >= it) {
                prop_assert_eq!(pair[0].1 + 1, pair[1].0);
            }
        }
        for (first, last, cause) in log {
            for number in first..=last {
                let expected = match (accepted.contains_key(&number), rejected.contains(&number)) {
                    (true, _) => None,
                    (false, true) => Some(GapCause::Rejected),
                    (false, false) => Some(GapCause::CaptureSkip),
                };
                prop_assert_eq!(cause, expected, "number {}", number);
            }
        }
    }
}
