//! Settings by presence, by mask and by default, and each that is refused.

use frontalis_analysis::{marker_analysis::objective::Objective, synthesis::reference_face};

use super::*;

/// The field and the reason with which the reference face's session refuses.
#[expect(
    clippy::needless_pass_by_value,
    reason = "each case is written as a value"
)]
fn refused(asked: v1::SessionSettings) -> (&'static str, &'static str) {
    let error = refusal(&asked, &SessionSettings::default());
    (error.field(), error.reason())
}

fn refusal(asked: &v1::SessionSettings, base: &SessionSettings) -> FieldError {
    let actor = reference_face::actor();
    let asked = apply(asked, &[], base);
    let checked = asked.and_then(|it| check_objective(&it, actor.muscle_set()));
    checked.unwrap_err()
}

/// The objective after a request with this mask.
fn objective(asked: &v1::SessionSettings, mask: &[&str], base: &SessionSettings) -> Objective {
    let mask: Vec<_> = mask.iter().map(|it| (*it).to_owned()).collect();
    apply(asked, &mask, base).unwrap().marker.objective
}

fn with(objective: Objective) -> SessionSettings {
    let mut settings = SessionSettings::default();
    settings.marker.objective = objective;
    settings
}

fn plain(plain: bool) -> v1::SessionSettings {
    v1::SessionSettings {
        plain: Some(plain),
        ..off()
    }
}

fn own_bounds(control: &str, lower: f32, upper: f32) -> v1::ControlBounds {
    v1::ControlBounds {
        control: control.to_owned(),
        lower,
        upper,
    }
}

fn pair(first: &str, second: &str) -> v1::ControlPair {
    v1::ControlPair {
        first: first.to_owned(),
        second: second.to_owned(),
    }
}

fn off() -> v1::SessionSettings {
    v1::SessionSettings::default()
}

#[test]
fn effective_settings_sent_back_change_nothing() {
    let mut settings = SessionSettings::default();
    settings.marker.neutral_frames = 30;
    settings.marker.region_mode = RegionMode::Split;
    settings.marker.stabilize_head = false;
    settings.stale_after = Some(Duration::from_millis(250));
    let asked = v1::SessionSettings {
        smoothing: Some(0.3),
        bounds: vec![own_bounds("jaw_rotation", 0.1, 0.7)],
        exclusive_pairs: vec![pair("lips_pressor", "orbicularis_oris")],
        ..off()
    };
    let settings = apply(&asked, &[], &settings).unwrap();
    for base in [SessionSettings::default(), with(Objective::plain())] {
        let back = apply(&effective(&settings), &[], &base).unwrap();
        assert_eq!(back, settings);
        let plain = apply(&plain(true), &[], &settings).unwrap();
        assert_eq!(
            apply(&effective(&plain), &[], &base)
                .unwrap()
                .marker
                .objective,
            plain.marker.objective
        );
    }
}

#[test]
fn d13_each_number_out_of_range_is_named() {
    for count in [0, 257, u32::MAX] {
        let asked = v1::SessionSettings {
            neutral_frames: Some(count),
            ..off()
        };
        assert_eq!(refused(asked), ("neutral_frames", "SOLVER_OPTIONS"));
    }
    for amount in [-0.1, 1.1, f32::NAN, f32::INFINITY] {
        let smoothing = v1::SessionSettings {
            smoothing: Some(amount),
            ..off()
        };
        assert_eq!(refused(smoothing), ("smoothing", "SOLVER_OPTIONS"));
        let sparsity = v1::SessionSettings {
            sparsity: Some(amount),
            ..off()
        };
        assert_eq!(refused(sparsity), ("sparsity", "SOLVER_OPTIONS"));
        let symmetry = v1::SessionSettings {
            symmetry: Some(amount),
            ..off()
        };
        assert_eq!(refused(symmetry), ("symmetry", "SOLVER_OPTIONS"));
    }
    for (seconds, nanos) in [(0, 0), (-1, 0), (3_601, 0), (i64::MAX, i32::MIN)] {
        let long = Some(pbjson_types::Duration { seconds, nanos });
        let stale = v1::SessionSettings {
            stale_after: long,
            ..off()
        };
        assert_eq!(refused(stale), ("stale_after", "SOLVER_OPTIONS"));
        let timeout = v1::SessionSettings {
            publisher_timeout: long,
            ..off()
        };
        assert_eq!(refused(timeout), ("publisher_timeout", "SOLVER_OPTIONS"));
    }
    let asked = v1::SessionSettings {
        region_mode: 5,
        ..off()
    };
    assert_eq!(refused(asked), ("region_mode", "ENUM"));
}

#[test]
fn d13_bounds_and_pairs_that_cannot_be_are_named() {
    let jaw = "jaw_rotation";
    for bounds in [
        vec![own_bounds(jaw, 0.6, 0.5)],
        vec![own_bounds(jaw, -0.1, 1.0)],
        vec![own_bounds(jaw, 0.0, 2.1)],
        vec![own_bounds(jaw, f32::NAN, 1.0)],
        vec![own_bounds(jaw, 0.0, f32::INFINITY)],
        vec![own_bounds(jaw, 0.0, 1.0), own_bounds(jaw, 0.0, 0.5)],
        vec![own_bounds("jaw", 0.0, 1.0)],
    ] {
        let asked = v1::SessionSettings { bounds, ..off() };
        assert_eq!(refused(asked), ("bounds", "SOLVER_OPTIONS"));
    }
    for exclusive_pairs in [
        vec![pair(jaw, jaw)],
        vec![pair(jaw, "kiss")],
        vec![pair("", jaw)],
        vec![pair(jaw, "lips_pressor"); 17],
    ] {
        let asked = v1::SessionSettings {
            exclusive_pairs,
            ..off()
        };
        assert_eq!(refused(asked), ("exclusive_pairs", "SOLVER_OPTIONS"));
    }
    // One that never rests cannot be excluded.
    let asked = v1::SessionSettings {
        bounds: vec![own_bounds(jaw, 0.1, 1.0)],
        exclusive_pairs: vec![pair(jaw, "lips_pressor")],
        ..off()
    };
    assert_eq!(refused(asked), ("exclusive_pairs", "SOLVER_OPTIONS"));
}

#[test]
fn a_refusal_says_the_number_that_was_sent_and_not_the_name() {
    let strength = v1::SessionSettings {
        smoothing: Some(1.1),
        ..off()
    };
    let said =
        |asked: &v1::SessionSettings| refusal(asked, &SessionSettings::default()).to_string();
    assert_eq!(
        said(&strength),
        "settings.smoothing: 1.1 is not within 0..=1"
    );
    let bounds = v1::SessionSettings {
        bounds: vec![own_bounds("jaw_rotation", 0.6, 0.5)],
        ..off()
    };
    assert!(
        said(&bounds).contains("jaw_rotation are 0.6 to 0.5"),
        "{}",
        said(&bounds)
    );
    let names = v1::SessionSettings {
        exclusive_pairs: vec![
            pair("jaw_rotation", "lips_pressor"),
            pair("<b>", "jaw_rotation"),
        ],
        ..off()
    };
    assert_eq!(
        said(&names),
        "settings.exclusive_pairs: entry 2 names no muscle of choe-ko-16"
    );
}

#[test]
fn plain_switches_every_term_off_and_keeps_bounds_and_pairs() {
    let base = with(Objective {
        symmetry: 0.25,
        exclusive_pairs: vec![["jaw_rotation".into(), "lips_pressor".into()]],
        ..Objective::default()
    });
    let plainly = objective(&plain(true), &[], &base);
    assert!(plainly.is_plain());
    assert_eq!(plainly.exclusive_pairs.len(), 1);
    assert_eq!(effective(&with(plainly.clone())).plain, Some(true));

    // Back to the defaults, then what is asked for beside it.
    let back = objective(&plain(false), &[], &with(plainly.clone()));
    let expected = Objective {
        exclusive_pairs: base.marker.objective.exclusive_pairs.clone(),
        ..Objective::default()
    };
    assert_eq!(back, expected);
    let asked = v1::SessionSettings {
        smoothing: Some(0.1),
        ..plain(false)
    };
    let some = objective(&asked, &[], &with(plainly.clone()));
    assert!((some.smoothing - 0.1).abs() < 1e-6 && some.robust);

    // Where terms are on, false changes none; and one term alone leaves the others off.
    assert_eq!(objective(&plain(false), &[], &base), base.marker.objective);
    let robust = v1::SessionSettings {
        robust: Some(true),
        ..off()
    };
    let alone = objective(&robust, &[], &with(plainly));
    assert!(alone.robust && alone.smoothing <= 0.0 && alone.sparsity <= 0.0);
}

#[test]
fn a_term_beside_plain_contradicts_it() {
    let terms: [fn(&mut v1::SessionSettings); 4] = [
        |it| it.robust = Some(true),
        |it| it.smoothing = Some(0.1),
        |it| it.sparsity = Some(1.0),
        |it| it.symmetry = Some(0.5),
    ];
    for term in terms {
        let mut asked = plain(true);
        term(&mut asked);
        assert_eq!(refused(asked.clone()), ("plain", "SOLVER_OPTIONS"));
        // What the mask leaves out was not asked for.
        assert!(objective(&asked, &["plain"], &SessionSettings::default()).is_plain());
    }
    let off_beside_it = v1::SessionSettings {
        robust: Some(false),
        smoothing: Some(0.0),
        ..plain(true)
    };
    assert!(objective(&off_beside_it, &[], &SessionSettings::default()).is_plain());
}

#[test]
fn a_list_is_replaced_when_it_is_there_and_emptied_by_the_mask() {
    let jaw = v1::SessionSettings {
        bounds: vec![own_bounds("jaw_rotation", 0.0, 0.5)],
        ..off()
    };
    let base = with(objective(&jaw, &[], &SessionSettings::default()));
    assert_eq!(base.marker.objective.bounds.len(), 1);
    assert_eq!(objective(&off(), &[], &base), base.marker.objective);
    let other = v1::SessionSettings {
        bounds: vec![own_bounds("lips_pressor", 0.0, 0.5)],
        ..off()
    };
    let replaced = objective(&other, &[], &base);
    assert_eq!(replaced.bounds.len(), 1);
    assert_eq!(replaced.bounds[0].muscle, "lips_pressor");
    assert!(objective(&off(), &["bounds"], &base).bounds.is_empty());
    assert_eq!(
        objective(&other, &["smoothing"], &base).bounds,
        base.marker.objective.bounds
    );
}

#[test]
fn a_masked_term_that_is_absent_goes_back_to_its_default() {
    let base = with(Objective::plain());
    let smoothing = objective(&off(), &["smoothing"], &base);
    assert!((smoothing.smoothing - 0.5).abs() < 1e-9 && !smoothing.robust);
    let plainly = objective(
        &plain(true),
        &["plain", "smoothing"],
        &SessionSettings::default(),
    );
    assert!(plainly.is_plain());
    let absent = objective(&off(), &["plain"], &base);
    assert_eq!(absent, Objective::default());
}

#[test]
fn recording_is_switched_on_and_off_and_comes_back_as_it_is() {
    let base = SessionSettings::default();
    let asked = v1::SessionSettings {
        record: Some(true),
        record_images: Some(true),
        ..v1::SessionSettings::default()
    };
    let on = apply(&asked, &[], &base).unwrap();
    assert!(on.record && on.record_images);
    assert_eq!(of_effective(&effective(&on)).unwrap(), on);
    let off = apply(&effective(&base), &[], &on).unwrap();
    assert_eq!(off, base);
}

#[test]
fn a_mask_changes_what_it_names_and_resets_what_is_absent() {
    let mut base = SessionSettings::default();
    base.marker.neutral_frames = 40;
    base.marker.stabilize_head = false;
    let asked = v1::SessionSettings {
        allow_exaggeration: Some(true),
        stabilize_head: Some(true),
        record: Some(true),
        ..off()
    };
    let mask = [
        "neutral_frames".to_owned(),
        "settings.allow_exaggeration".to_owned(),
    ];
    let next = apply(&asked, &mask, &base).unwrap();
    assert_eq!(next.marker.neutral_frames, 15);
    assert!(next.marker.allow_exaggeration);
    assert!(!next.marker.stabilize_head);
}

#[test]
fn a_mask_with_an_unknown_path_is_refused() {
    let mask = ["neutral_frames".to_owned(), "colour".to_owned()];
    let error = apply(&off(), &mask, &SessionSettings::default()).unwrap_err();
    assert_eq!(
        (error.field(), error.reason()),
        ("update_mask", "FIELD_MASK")
    );
    assert!(error.to_string().contains("path 1"));
}
