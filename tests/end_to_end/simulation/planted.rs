//! The checker of histories is told apart a sound history from one in which a single thing is wrong.

use super::history::{Acknowledged, Heard, History, SampleSeen, TakeSeen, Violation};

const N_FRAMES: u64 = 12;

/// Frames before the neutral face was known.
const N_NEUTRAL: u64 = 3;

fn sample(frame: u64) -> SampleSeen {
    SampleSeen {
        sequence: frame - N_NEUTRAL,
        frame,
        hash: 7 * frame,
    }
}

/// Frames 1 to 12 in a run that was recorded from the fifth on; the subscriber was cut once.
fn sound() -> History {
    let mut heard = vec![
        Heard::Header { run: 4 },
        Heard::Gap {
            first: 1,
            last: N_NEUTRAL,
        },
    ];
    heard.extend((N_NEUTRAL + 1..=8).map(|it| Heard::Sample(sample(it))));
    heard.push(Heard::Header { run: 4 });
    heard.extend((9..=N_FRAMES).map(|it| Heard::Sample(sample(it))));
    heard.push(Heard::End);
    History {
        sent: (1..=N_FRAMES).map(|it| (it, 100 + it)).collect(),
        acknowledged: (1..=N_FRAMES)
            .map(|it| Acknowledged {
                run: 4,
                accepted_through: it,
                recording: it > 4,
                durable_through: it.saturating_sub(1),
            })
            .collect(),
        unanswered: 0,
        heard,
        takes: vec![TakeSeen {
            run: 4,
            next_frame: 5,
            frames: (5..=N_FRAMES).map(|it| (it, 100 + it)).collect(),
            samples: (5..=N_FRAMES).map(sample).collect(),
        }],
    }
}

fn place_of(history: &History, frame: u64) -> usize {
    let is_it = |it: &Heard| matches!(it, Heard::Sample(sample) if sample.frame == frame);
    history.heard.iter().position(is_it).unwrap()
}

/// What the checker says of a history in which something was changed.
fn with(change: impl FnOnce(&mut History)) -> Vec<Violation> {
    let mut history = sound();
    change(&mut history);
    history.violations()
}

#[test]
fn a_sound_history_is_found_sound() {
    assert_eq!(sound().violations(), []);
}

#[test]
fn a_lost_durable_frame_is_found() {
    let found = with(|it| {
        it.takes[0].frames.remove(2);
    });
    assert_eq!(found, [Violation::DurableFrameLost { run: 4, frame: 7 }]);
    let found = with(|it| it.takes.clear());
    assert_eq!(found.len(), 7, "5 to 11: {found:?}");
}

#[test]
fn the_last_frame_that_was_not_yet_durable_may_be_lost() {
    let found = with(|it| {
        it.takes[0].frames.pop();
    });
    assert_eq!(found, []);
}

#[test]
fn a_doubled_a_moved_and_a_changed_frame_are_found() {
    let found = with(|it| it.takes[0].frames.insert(3, (7, 107)));
    assert_eq!(found, [Violation::FrameDisorder { frame: 7 }]);
    let found = with(|it| it.takes[0].frames.swap(1, 2));
    assert_eq!(found, [Violation::FrameDisorder { frame: 6 }]);
    let found = with(|it| it.takes[0].frames[1].1 = 0);
    assert_eq!(found, [Violation::FrameChanged { frame: 6 }]);
    let found = with(|it| it.takes[0].frames.push((13, 113)));
    let untold = Violation::RecordedFrameUntold { run: 4, frame: 13 };
    assert_eq!(found, [Violation::FrameChanged { frame: 13 }, untold]);
}

#[test]
fn a_watermark_that_goes_back_or_too_far_is_found() {
    let found = with(|it| it.acknowledged[6].accepted_through = 5);
    assert!(
        found.contains(&Violation::Watermark { run: 4 }),
        "{found:?}"
    );
    let found = with(|it| it.acknowledged[11].durable_through = 13);
    assert_eq!(found, [Violation::Watermark { run: 4 }]);
}

#[test]
fn a_hole_a_double_and_a_swap_of_samples_are_found() {
    let found = with(|it| {
        it.heard.remove(place_of(it, 9));
    });
    let hole = Violation::SequenceBroken {
        expected: 6,
        found: 7,
    };
    let missed = Violation::RecordedSampleMissed {
        run: 4,
        sequence: 6,
    };
    assert_eq!(found, [hole, Violation::SilentAbsence { frame: 9 }, missed]);
    let found = with(|it| it.heard.insert(place_of(it, 9), Heard::Sample(sample(8))));
    let double = Violation::SequenceBroken {
        expected: 6,
        found: 5,
    };
    assert_eq!(found, [double, Violation::SampleDisorder { frame: 8 }]);
    let found = with(|it| {
        let place = place_of(it, 10);
        it.heard.swap(place, place + 1);
    });
    assert!(
        found.contains(&Violation::SampleDisorder { frame: 10 }),
        "{found:?}"
    );
}

#[test]
fn a_hole_that_the_client_says_is_none_unless_it_was_recorded() {
    let said = |it: &mut History| {
        let place = place_of(it, 9);
        it.heard[place] = Heard::Lost { first: 6, last: 6 };
    };
    let missed = Violation::RecordedSampleMissed {
        run: 4,
        sequence: 6,
    };
    assert_eq!(with(said), [missed]);
    let found = with(|it| {
        said(it);
        it.takes[0].samples.clear();
    });
    assert_eq!(found, []);
}

#[test]
fn frames_that_vanish_without_a_word_are_found() {
    // The sequences go on, so the server never counted the sample, and there is no gap.
    let found = with(|it| {
        let place = place_of(it, 9);
        it.heard.remove(place);
        for heard in &mut it.heard[place..] {
            if let Heard::Sample(sample) = heard {
                sample.sequence -= 1;
            }
        }
        it.takes[0].samples.clear();
    });
    assert_eq!(found, [Violation::SilentAbsence { frame: 9 }]);
    let found = with(|it| {
        let place = place_of(it, 9);
        it.heard[place] = Heard::Gap { first: 9, last: 9 };
        for heard in &mut it.heard[place..] {
            if let Heard::Sample(sample) = heard {
                sample.sequence -= 1;
            }
        }
        it.takes[0].samples.clear();
    });
    assert_eq!(found, []);
}

#[test]
fn a_sample_that_is_not_the_recorded_one_is_found() {
    let found = with(|it| it.takes[0].samples[2].hash = 0);
    assert_eq!(found, [Violation::SampleDiffers { sequence: 4 }]);
}

#[test]
fn what_never_comes_is_found() {
    assert_eq!(
        with(|it| it.unanswered = 2),
        [Violation::Unanswered { n_frames: 2 }]
    );
    let end = Violation::EndMissing { frame: N_FRAMES };
    assert_eq!(
        with(|it| {
            it.heard.pop();
        }),
        [end]
    );
    let found = with(|it| {
        let end = it.heard.len() - 1;
        it.heard.remove(end - 1);
    });
    let missed = Violation::RecordedSampleMissed {
        run: 4,
        sequence: 9,
    };
    let untold = Violation::RecordedFrameUntold {
        run: 4,
        frame: N_FRAMES,
    };
    assert_eq!(found, [missed, untold, end]);
}
