//! Two takes side by side: what is said to differ, and what is not.

use frontalis_proto::v1::Quality;

use super::*;
use crate::recorded_take::test_file;

fn sample(frame: u64, activations: &[f32]) -> CurveSample {
    CurveSample {
        frame,
        sequence: frame * 3,
        solved_time_nanos: 17,
        activations: activations.to_vec(),
        quality: Quality::Solved.into(),
        ..CurveSample::default()
    }
}

fn take(samples: &[CurveSample]) -> RecordedTake {
    test_file::take(
        samples
            .iter()
            .map(|it| ("/curves", it.encode_to_vec()))
            .collect::<Vec<_>>(),
    )
}

fn names(names: &[&str]) -> Vec<String> {
    names.iter().map(|&it| it.to_owned()).collect()
}

async fn difference(
    [first, second]: [&[CurveSample]; 2],
    [one, other]: [&[&str]; 2],
) -> TakeDifference {
    let [mut first, mut second] = [take(first), take(second)];
    let (one, other) = (names(one), names(other));
    let found = TakeDifference::of([&mut first, &mut second], [&one, &other], |_| {});
    found.await.unwrap()
}

#[tokio::test]
async fn takes_that_are_one_but_for_sequence_and_server_times_differ_in_nothing() {
    let first: Vec<_> = (1..=40).map(|it| sample(it, &[0.25, -0.0])).collect();
    let mut second = first.clone();
    for it in &mut second {
        it.sequence += 7;
        it.solved_time_nanos += 5;
        it.capture_time_server_nanos = 3;
    }
    let found = difference([&first, &second], [&["a", "b"]; 2]).await;
    assert!(found.is_nothing(), "{found:?}");
    assert_eq!((found.n_frames, found.n_same), (40, 40));
    assert!(found.controls.iter().all(|it| it.largest.is_none()));
}

#[tokio::test]
async fn a_difference_is_told_by_its_muscle_its_size_and_its_frame() {
    let first: Vec<_> = (1..=4).map(|it| sample(it, &[0.5, 0.5])).collect();
    let mut second = first.clone();
    second[1].activations[1] = 0.25;
    second[2].activations[1] = 1.0;
    let found = difference([&first, &second], [&["a", "b"]; 2]).await;
    assert!(!found.is_nothing());
    assert_eq!((found.n_same, found.max()), (2, 0.5));
    let [a, b] = &found.controls[..] else {
        panic!("{found:?}");
    };
    assert_eq!((a.n_differing, a.max(), a.rms()), (0, 0.0, 0.0));
    assert_eq!((b.n_differing, b.max(), b.mean()), (2, 0.5, 0.0625));
    assert!((b.rms() - (0.3125_f64 / 4.0).sqrt()).abs() < 1e-15);
    let largest = b.largest.as_ref().unwrap();
    assert_eq!(
        (largest.frame, largest.first, largest.second),
        (3, 0.5, 1.0)
    );
}

#[tokio::test]
async fn the_sign_of_a_zero_and_what_else_a_sample_says_are_differences_too() {
    let first = [sample(1, &[0.0]), sample(2, &[0.5])];
    let mut second = [sample(1, &[-0.0]), sample(2, &[0.5])];
    second[1].quality = Quality::Held.into();
    let found = difference([&first, &second], [&["a"]; 2]).await;
    assert_eq!((found.n_frames, found.n_same, found.max()), (2, 0, 0.0));
    assert_eq!(found.controls[0].n_differing, 1);
}

#[tokio::test]
async fn frames_and_muscles_of_one_take_only_are_named() {
    let first = [1, 2, 3, 5].map(|it| sample(it, &[0.1, 0.2]));
    let second = [2, 4, 5, 6, 7].map(|it| sample(it, &[0.3, 0.2]));
    let found = difference([&first, &second], [&["a", "b"], &["c", "b"]]).await;
    assert_eq!((found.n_only_first, found.n_only_second), (2, 3));
    assert_eq!(found.n_frames, 2);
    assert_eq!(found.only_first, ["a"]);
    assert_eq!(found.only_second, ["c"]);
    assert_eq!(found.controls.len(), 1);
    assert_eq!(
        found.controls[0].n_differing, 0,
        "b is b, wherever it stands"
    );
}

#[tokio::test]
async fn a_take_without_samples_has_nothing_in_common() {
    let found = difference([&[], &[sample(1, &[0.1])]], [&["a"]; 2]).await;
    assert_eq!((found.n_frames, found.n_only_second), (0, 1));
    assert!(!found.is_nothing());
}
