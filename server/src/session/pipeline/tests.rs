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
    let actor = Arc::new(reference_face::actor());
    let mut settings = SessionSettings::default();
    settings.marker.neutral_frames = 3;
    let names = actor.markers().iter().map(|it| it.name.clone());
    let shape = StreamShape {
        unit: LengthUnit::Centimeter,
        marker_names: names.collect(),
    };
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
