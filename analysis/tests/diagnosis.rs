//! What a performance says about the draft and about the neutral face.
#![expect(clippy::unwrap_used, reason = "the failure of a test is its report")]

use std::sync::{Arc, LazyLock};

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, Progress, QuietestError},
    curve::CurveSample,
    face::{
        actor::{Actor, ActorParts, MarkerPlace, RankPolicy},
        marker::MarkerFrame,
    },
    marker_analysis::{neutral_watch::DoubtCause, range::Verdict},
    space::LengthUnit,
    synthesis::reference_face,
};
use rand::SeedableRng as _;
use rand_pcg::Pcg64;

#[path = "support/performance.rs"]
mod performance;

use performance::{Performance, Stage};

const STAGE: Stage = Stage {
    n_frames: 900,
    moving_head: true,
    noise_cm: 0.03,
    seed: 11,
    ..Stage::STILL
};

/// The reference face, made once.
fn actor() -> Arc<Actor> {
    static ACTOR: LazyLock<Arc<Actor>> = LazyLock::new(|| Arc::new(reference_face::actor()));
    Arc::clone(&ACTOR)
}

fn muscle(name: &str) -> usize {
    actor().muscle_set().index_of(name).unwrap()
}

/// The actor whose draft of one muscle moves `gain` times as far.
fn drafted(name: &str, gain: f64) -> Arc<Actor> {
    let actor = actor();
    let mut basis = actor.basis().clone();
    for displacement in &mut basis.displacements_cm[muscle(name)] {
        *displacement *= gain;
    }
    let places = actor
        .virtual_markers()
        .iter()
        .map(|it| MarkerPlace::OnTriangle(*it));
    let parts = ActorParts {
        display_name: "a draft".to_owned(),
        muscle_set: actor.muscle_set().id().to_owned(),
        mesh: actor.mesh().clone(),
        muscles: actor.muscle_set().muscles().to_vec(),
        basis,
        markers: actor.markers().iter().cloned().zip(places).collect(),
    };
    Arc::new(Actor::new(parts, RankPolicy::Refuse).unwrap().0)
}

/// One muscle after the other, fully and alone.
fn isolated_attempts() -> Performance {
    let actor = actor();
    let m = actor.muscle_set().len();
    let mut truth = vec![vec![0.0; m]; STAGE.n_frames];
    let length = 50;
    for i in 0..m {
        for k in 0..length {
            let phase = k as f64 / length as f64;
            let value = 1.3 * (std::f64::consts::PI * phase).sin();
            truth[60 + i * length + k][i] = value.min(1.0);
        }
    }
    let mut rng = Pcg64::seed_from_u64(STAGE.seed);
    Performance::of_truth(&actor, STAGE, truth, &mut rng)
}

fn analyzed(actor: Arc<Actor>, frames: &[MarkerFrame]) -> (MarkerAnalyzer, Vec<CurveSample>) {
    let (unit, settings) = (LengthUnit::Centimeter, MarkerSettings::default());
    let mut analyzer = MarkerAnalyzer::new(actor, settings, unit, 60.0);
    let mut samples = Vec::new();
    for frame in frames {
        analyzer.push(frame.clone(), &mut samples).unwrap();
    }
    (analyzer, samples)
}

#[test]
fn a_good_draft_is_sound_and_each_way_of_being_wrong_has_its_verdict() {
    let performance = isolated_attempts();
    let cases = [
        ("zygomatic_major_left", 1.0, Verdict::Sound),
        ("zygomatic_major_left", 0.6, Verdict::TooWeak),
        ("zygomatic_major_left", 1.6, Verdict::TooStrong),
        ("frontalis_left", 0.6, Verdict::TooWeak),
        ("frontalis_left", 1.6, Verdict::TooStrong),
        ("frontalis_left", -1.0, Verdict::WrongDirection),
    ];
    for (name, gain, expected) in cases {
        let (analyzer, _) = analyzed(drafted(name, gain), &performance.frames);
        let range = analyzer.ranges()[muscle(name)];
        println!("{name} x {gain}: {range:?}");
        assert_eq!(range.verdict, expected, "{name} x {gain}: {range:?}");
        assert_eq!(range.muscle, muscle(name));
        assert!(range.bounded.p1 >= 0.0 && range.bounded.p99 <= 1.0);
    }
}

#[test]
fn a_muscle_that_was_never_used_is_not_judged() {
    let truth = vec![vec![0.0; 16]; 300];
    let mut rng = Pcg64::seed_from_u64(1);
    let still = Performance::of_truth(&actor(), STAGE, truth, &mut rng);
    let (analyzer, _) = analyzed(actor(), &still.frames);
    let verdicts: Vec<_> = analyzer.ranges().iter().map(|it| it.verdict).collect();
    assert!(
        verdicts.iter().all(|it| *it == Verdict::NotYetSeen),
        "{verdicts:?}"
    );
    assert_eq!(analyzer.neutral_doubt(), None);
}

/// A performance that begins with a smile instead of a neutral face, and comes back to it after a second.
fn begins_smiling() -> Performance {
    let actor = actor();
    let smile = ["zygomatic_major_left", "zygomatic_major_right"].map(muscle);
    let mut truth = vec![vec![0.0; 16]; 600];
    for (k, x) in truth.iter_mut().enumerate() {
        let fading = (1.0 - (k as f64 - 60.0) / 30.0).clamp(0.0, 1.0);
        let again = if k > 400 { 0.8 } else { 0.0 };
        for it in smile {
            x[it] = f64::max(0.6 * fading, again);
        }
    }
    let mut rng = Pcg64::seed_from_u64(STAGE.seed);
    Performance::of_truth(&actor, STAGE, truth, &mut rng)
}

#[test]
fn a_first_frame_that_is_not_neutral_is_doubted_and_the_quietest_frames_mend_it() {
    let performance = begins_smiling();
    let (early, late) = performance.frames.split_at(30);
    let (mut analyzer, mut samples) = analyzed(actor(), early);
    let doubt = analyzer.neutral_doubt().unwrap();
    println!("at once: {doubt:?}");
    assert_eq!(doubt.cause, DoubtCause::LooksContracted);
    assert!(doubt.residual_cm > doubt.expected_cm);
    for frame in &late[..300] {
        analyzer.push(frame.clone(), &mut samples).unwrap();
    }
    assert!(analyzer.neutral_doubt().is_some());
    analyzer.recenter_on_quietest().unwrap();
    assert_eq!(analyzer.neutral_doubt(), None);
    for frame in &late[300..] {
        analyzer.push(frame.clone(), &mut samples).unwrap();
    }
    let smile = muscle("zygomatic_major_left");
    let error = (samples.last().unwrap().activations[smile] - 0.8).abs();
    assert!(error < 0.05, "{error}");
}

#[test]
fn a_neutral_face_is_not_doubted() {
    let (analyzer, _) = analyzed(actor(), &Performance::of(&actor(), STAGE).frames);
    assert_eq!(analyzer.neutral_doubt(), None);
}

#[test]
fn the_quietest_frames_need_an_alignment_and_enough_frames() {
    let performance = Performance::of(&actor(), STAGE);
    let (mut analyzer, _) = analyzed(actor(), &performance.frames[..3]);
    assert_eq!(
        analyzer.recenter_on_quietest(),
        Err(QuietestError::NotAligned)
    );
    let (mut analyzer, _) = analyzed(actor(), &performance.frames[..16]);
    let error = analyzer.recenter_on_quietest().unwrap_err();
    assert!(
        matches!(error, QuietestError::TooFew { needed: 15, .. }),
        "{error}"
    );
}

#[test]
fn recentering_while_live_loses_no_sample_and_jumps_by_no_more_than_it_changes() {
    // The face is as neutral as before, so the new neutral face changes next to nothing.
    let mut truth = vec![vec![0.0; 16]; 400];
    let smile = muscle("zygomatic_major_left");
    for x in &mut truth[300..] {
        x[smile] = 0.5;
    }
    let mut rng = Pcg64::seed_from_u64(STAGE.seed);
    let performance = Performance::of_truth(&actor(), STAGE, truth, &mut rng);
    let (mut analyzer, mut samples) = analyzed(actor(), &performance.frames[..100]);
    analyzer.recenter();
    let mut progress = Vec::new();
    for frame in &performance.frames[100..] {
        progress.push(analyzer.push(frame.clone(), &mut samples).unwrap());
    }
    assert_eq!(samples.len(), performance.frames.len());
    assert!(progress[..14].iter().all(|it| *it == Progress::Solved));
    assert_eq!(progress[14], Progress::Aligned);
    let jump = |k: usize| {
        let pairs = samples[k - 1]
            .activations
            .iter()
            .zip(&samples[k].activations);
        pairs.fold(0.0, |largest: f64, (a, b)| largest.max((a - b).abs()))
    };
    let usual = (101..295)
        .filter(|k| *k != 115)
        .map(jump)
        .fold(0.0, f64::max);
    println!(
        "the new neutral face moves the values by {:.4}, noise by up to {usual:.4}",
        jump(115)
    );
    assert!(jump(115) <= usual);
    let error = (samples.last().unwrap().activations[smile] - 0.5).abs();
    assert!(error < 0.05, "{error}");
}

#[test]
fn a_new_neutral_face_that_cannot_be_aligned_leaves_the_old_one() {
    let performance = Performance::of(&actor(), STAGE);
    let (mut analyzer, mut samples) = analyzed(actor(), &performance.frames[..100]);
    let before = analyzer.alignment().cloned();
    analyzer.recenter();
    let mut progress = Progress::Solved;
    for frame in &performance.frames[100..115] {
        let mut mirrored = frame.clone();
        for position in mirrored.positions.iter_mut().flatten() {
            position.0.x = -position.0.x;
        }
        progress = analyzer.push(mirrored, &mut samples).unwrap();
    }
    assert_eq!(progress, Progress::RecenterFailed);
    assert!(analyzer.recenter_error().is_some());
    assert_eq!(analyzer.alignment().cloned(), before);
    assert_eq!(samples.len(), 115);
}
