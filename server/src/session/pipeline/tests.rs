//! Order and recovery of the pipeline, where a stream cannot provoke them.

use std::time::SystemTime;

use frontalis_analysis::{space::LengthUnit, synthesis::reference_face};

use super::*;
use crate::{
    name::{ActorId, SessionId},
    session::SessionSettings,
};

const NEUTRAL_FRAMES: u64 = 3;

fn pipeline() -> Pipeline {
    pipeline_with(false)
}

fn pipeline_with(align_on_request: bool) -> Pipeline {
    let actor = Arc::new(reference_face::actor());
    let mut settings = SessionSettings::default();
    settings.marker.neutral_frames = 3;
    settings.marker.align_on_request = align_on_request;
    let shape = shape(&actor, LengthUnit::Centimeter);
    let mut pipeline = Pipeline::new(&SessionSpec {
        id: SessionId::parse("one").unwrap(),
        display_name: String::new(),
        actor_id: ActorId::parse("reference").unwrap(),
        actor,
        actor_revision: 1,
        settings,
        run: 1,
        create_time: SystemTime::UNIX_EPOCH,
        restored: None,
    });
    assert!(!pipeline.read_from(shape, 60.0, &mut Vec::new()));
    pipeline
}

fn shape(actor: &Actor, unit: LengthUnit) -> StreamShape {
    let names = actor.markers().iter().map(|it| it.name.clone());
    StreamShape {
        unit,
        marker_names: names.collect(),
    }
}

fn waiting(pipeline: &Pipeline, number: u64) -> WaitingFrame {
    let actor = &pipeline.actor;
    let places = actor.virtual_markers().iter();
    let point = places.map(|it| it.position(actor.mesh()).0);
    WaitingFrame {
        frame: IncomingFrame {
            number,
            capture_time_nanos: 0,
            positions: point.map(|it| Some(PerformancePoint(it))).collect(),
            tag: SampleTag::default(),
            content_hash: 0,
            n_partial_markers: 0,
            sent: bytes::Bytes::new(),
        },
        gaps_before: Vec::new(),
        received_nanos: 0,
    }
}

fn push(pipeline: &mut Pipeline, number: u64, outcomes: &mut Vec<Outcome>) -> Step {
    let waiting = waiting(pipeline, number);
    pipeline.push(waiting, 0, outcomes)
}

/// First and last number of each outcome, and whether it is a sample.
fn spans(outcomes: &[Outcome]) -> Vec<(u64, u64, bool)> {
    let span = |it: &Outcome| match it {
        Outcome::Sample(_, note) => (note.number, note.number, true),
        Outcome::Gap(gap) => (gap.first, gap.last, false),
    };
    outcomes.iter().map(span).collect()
}

#[test]
fn gaps_keep_their_place_among_samples_that_are_still_to_come() {
    let mut pipeline = pipeline();
    let mut outcomes = Vec::new();
    push(&mut pipeline, 1, &mut outcomes);
    let skipped = Gap {
        first: 2,
        last: 5,
        cause: GapCause::CaptureSkip,
    };
    pipeline.pass_gaps(vec![skipped], &mut outcomes);
    push(&mut pipeline, 6, &mut outcomes);
    assert!(outcomes.is_empty());
    let step = push(&mut pipeline, 7, &mut outcomes);
    assert_eq!(step, Step::Progress(Progress::Aligned));
    let expected = [(1, 1, true), (2, 5, false), (6, 6, true), (7, 7, true)];
    assert_eq!(spans(&outcomes), expected);
}

#[test]
fn a_panic_costs_its_frame_and_the_alignment_stays() {
    let mut pipeline = pipeline();
    let mut outcomes = Vec::new();
    for number in 1..=NEUTRAL_FRAMES {
        push(&mut pipeline, number, &mut outcomes);
    }
    outcomes.clear();
    // A frame of the wrong length cannot come from a stream; here it stands for any mistake in the analysis.
    let right = pipeline
        .source
        .as_ref()
        .unwrap()
        .stream_idx_of_marker
        .clone();
    pipeline
        .source
        .as_mut()
        .unwrap()
        .stream_idx_of_marker
        .clear();
    assert_eq!(push(&mut pipeline, 4, &mut outcomes), Step::Panicked);
    pipeline.source.as_mut().unwrap().stream_idx_of_marker = right;
    let step = push(&mut pipeline, 5, &mut outcomes);
    assert_eq!(step, Step::Progress(Progress::Solved));
    assert_eq!(spans(&outcomes), [(4, 4, false), (5, 5, true)]);
    let Outcome::Gap(gap) = &outcomes[0] else {
        panic!("a gap");
    };
    assert_eq!(gap.cause, GapCause::Rejected);
}

#[test]
fn what_is_collected_when_nothing_follows_is_a_gap() {
    let mut pipeline = pipeline();
    let mut outcomes = Vec::new();
    push(&mut pipeline, 1, &mut outcomes);
    push(&mut pipeline, 2, &mut outcomes);
    pipeline.give_up_awaiting(&mut outcomes);
    assert_eq!(spans(&outcomes), [(1, 2, false)]);
}

#[test]
fn a_frame_that_waited_for_the_alignment_is_told_from_one_that_did_not() {
    let mut pipeline = pipeline();
    let mut outcomes = Vec::new();
    for number in 1..=NEUTRAL_FRAMES + 2 {
        push(&mut pipeline, number, &mut outcomes);
    }
    let was_collected = |it: &Outcome| match it {
        Outcome::Sample(_, note) => note.was_collected,
        Outcome::Gap(_) => panic!("no gap"),
    };
    let collected: Vec<_> = outcomes.iter().map(was_collected).collect();
    assert_eq!(collected, [true, true, true, false, false]);
}

#[test]
fn a_request_for_a_neutral_face_outlives_another_stream_until_it_is_met() {
    let mut pipeline = pipeline_with(true);
    let mut outcomes = Vec::new();
    let step = push(&mut pipeline, 1, &mut outcomes);
    assert_eq!(step, Step::Progress(Progress::Waiting));
    pipeline.recenter(&mut outcomes);
    push(&mut pipeline, 2, &mut outcomes);

    let reversed = {
        let mut shape = shape(&pipeline.actor, LengthUnit::Centimeter);
        shape.marker_names.reverse();
        shape
    };
    assert!(!pipeline.read_from(reversed, 60.0, &mut outcomes));
    let straight = shape(&pipeline.actor, LengthUnit::Centimeter);
    assert!(!pipeline.read_from(straight, 60.0, &mut outcomes));
    let collecting = |collected| {
        Step::Progress(Progress::Collecting {
            collected,
            wanted: 3,
        })
    };
    assert_eq!(push(&mut pipeline, 3, &mut outcomes), collecting(1));
    assert_eq!(push(&mut pipeline, 4, &mut outcomes), collecting(2));
    let step = push(&mut pipeline, 5, &mut outcomes);
    assert_eq!(step, Step::Progress(Progress::Aligned));
    let seen = spans(&outcomes);
    assert_eq!(
        &seen[seen.len() - 3..],
        [(3, 3, true), (4, 4, true), (5, 5, true)]
    );

    // It was met: another stream waits for the next request.
    let millimeters = shape(&pipeline.actor, LengthUnit::Millimeter);
    assert!(pipeline.read_from(millimeters, 60.0, &mut outcomes));
    let step = push(&mut pipeline, 6, &mut outcomes);
    assert_eq!(step, Step::Progress(Progress::Waiting));
}

#[test]
fn a_panic_while_the_neutral_face_is_collected_keeps_the_request() {
    let mut pipeline = pipeline_with(true);
    let mut outcomes = Vec::new();
    pipeline.recenter(&mut outcomes);
    push(&mut pipeline, 1, &mut outcomes);
    pipeline.recover(&mut outcomes);
    let step = push(&mut pipeline, 2, &mut outcomes);
    let expected = Progress::Collecting {
        collected: 1,
        wanted: 3,
    };
    assert_eq!(step, Step::Progress(expected));
}
