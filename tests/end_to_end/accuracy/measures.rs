//! The measures measure what they say.

use harness::accuracy::{
    blink::largest_peak_error, condition::Condition, corruption::Corruption, curves::Curves,
    errors::Errors, lag::Lags, take::N_NEUTRAL,
};

/// One muscle's curve.
fn single(curve: impl Iterator<Item = f64>) -> Curves {
    Curves(curve.map(|it| vec![it]).collect())
}

#[test]
fn a_curve_that_comes_later_is_late_by_as_many_frames() {
    let wave = |k: i32| 0.5 + 0.3 * (f64::from(k) * 0.21).sin() + 0.1 * (f64::from(k) * 0.05).cos();
    let truth = single((0..300).map(wave));
    for delay in [-7, -2, 0, 1, 2, 5] {
        let lags = Lags::of(&single((0..300).map(|k| wave(k - delay))), &truth);
        assert_eq!(lags.largest, delay as isize);
        assert_eq!(
            (lags.n_curves, lags.n_late),
            (1, usize::from(delay.abs() > 1))
        );
    }
}

#[test]
fn a_curve_that_hardly_varies_has_no_lag() {
    let still = single((0..300).map(|k| 0.01 * f64::from(k % 2)));
    assert_eq!(Lags::of(&still, &still), Lags::default());
}

#[test]
fn a_blink_that_is_cut_is_told_and_a_closed_eye_is_no_blink() {
    // At 60 Hz: a blink of 10 frames, then two seconds of closure.
    let truth = |k: usize| f64::from(u8::from((30..40).contains(&k) || k >= 60));
    let curve = |height: f64| single((0..180).map(|k| height * truth(k)));
    let error = largest_peak_error(&curve(0.9), &curve(1.0), &[0], 60.0).unwrap();
    assert!((error + 0.1).abs() < 1e-12, "{error}");
    let closed = single((0..180).map(|k| f64::from(u8::from(k >= 60))));
    assert_eq!(largest_peak_error(&closed, &closed, &[0], 60.0), None);
}

#[test]
fn errors_of_active_and_small_contractions_are_told_apart() {
    let truth = Curves(vec![vec![0.0, 0.05, 0.5]]);
    let found = Curves(vec![vec![0.3, 0.03, 0.6]]);
    let errors = Errors::of(&found, &truth);
    assert!((errors.mean_absolute - 0.14).abs() < 1e-12, "{errors:?}");
    assert!((errors.active - 0.06).abs() < 1e-12, "{errors:?}");
    assert!((errors.small_bias + 0.02).abs() < 1e-12, "{errors:?}");
}

#[test]
fn as_much_goes_wrong_as_is_asked_for_and_the_neutral_frames_are_spared() {
    let actor = harness::accuracy::actors::reference();
    let clean = Condition::clean(0.0).take(&actor, 1);
    let spoilt = Corruption::USUAL.after_neutral(&clean, 1);
    assert_eq!(clean.frames[..N_NEUTRAL], spoilt.frames[..N_NEUTRAL]);
    let (mut hidden, mut jumped, mut all) = (0.0, 0.0, 0.0);
    let frames = clean.frames.iter().zip(&spoilt.frames).skip(N_NEUTRAL);
    for (before, after) in frames.flat_map(|(a, b)| a.positions.iter().zip(&b.positions)) {
        all += 1.0;
        match (before, after) {
            (_, None) => hidden += 1.0,
            (Some(before), Some(after)) if before != after => {
                let apart_cm = (before.0 - after.0).norm();
                assert!((0.499..2.001).contains(&apart_cm), "{apart_cm}");
                jumped += 1.0;
            }
            _ => {}
        }
    }
    let (hidden, jumped) = (hidden / all, jumped / (all - hidden));
    assert!((hidden - 0.1_f64).abs() < 0.015, "{hidden}");
    assert!((jumped - 0.02_f64).abs() < 0.003, "{jumped}");
}
