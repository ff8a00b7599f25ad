//! Subscriptions of every kind, good and bad.

use super::*;

fn a_start() -> v1::SubscribeStart {
    v1::SubscribeStart {
        session: "sessions/one".to_owned(),
        ..v1::SubscribeStart::default()
    }
}

fn delivery_of(sent: &v1::SubscribeStart) -> Delivery {
    start(sent, "peer".to_owned(), "grpc", true)
        .unwrap()
        .spec
        .delivery
}

#[test]
fn latest_is_the_default_and_zero_credits_are_none() {
    let uncontrolled = Delivery::Latest {
        credits: None,
        max_rate_hz: None,
    };
    assert_eq!(delivery_of(&a_start()), uncontrolled);
    let sent = v1::SubscribeStart {
        credits: 3,
        max_rate_hz: 60.0,
        ..a_start()
    };
    let controlled = Delivery::Latest {
        credits: Some(3),
        max_rate_hz: Some(60.0),
    };
    assert_eq!(delivery_of(&sent), controlled);
    let followed = start(&sent, String::new(), "grpc", false)
        .unwrap()
        .spec
        .delivery;
    assert_eq!(
        followed,
        Delivery::Latest {
            credits: None,
            max_rate_hz: Some(60.0)
        }
    );
}

#[test]
fn every_frame_starts_where_it_is_told() {
    let every = |from_sequence, from_oldest| {
        let delivery = v1::Delivery::EveryFrame.into();
        delivery_of(&v1::SubscribeStart {
            delivery,
            from_sequence,
            from_oldest,
            ..a_start()
        })
    };
    assert_eq!(every(0, false), Delivery::EveryFrame(StartAt::Now));
    assert_eq!(every(5, false), Delivery::EveryFrame(StartAt::Sequence(5)));
    assert_eq!(every(0, true), Delivery::EveryFrame(StartAt::Oldest));
}

#[test]
fn what_this_version_does_not_do_is_said() {
    let check = |sent| {
        let refusal = start(&sent, String::new(), "grpc", true).unwrap_err();
        assert_eq!(refusal.problem(), &FieldProblem::NotImplemented);
    };
    check(v1::SubscribeStart {
        control_space: 2,
        ..a_start()
    });
    check(v1::SubscribeStart {
        control_space: 3,
        ..a_start()
    });
}

#[test]
fn a_subscriber_without_a_name_goes_by_its_peer() {
    assert_eq!(
        start(&a_start(), "[::1]:9".to_owned(), "grpc", true)
            .unwrap()
            .spec
            .name,
        "[::1]:9"
    );
    let named = v1::SubscribeStart {
        subscriber: "wall".to_owned(),
        ..a_start()
    };
    assert_eq!(
        start(&named, String::new(), "grpc", true)
            .unwrap()
            .spec
            .name,
        "wall"
    );
}

#[test]
fn a_wrong_field_is_named() {
    let check = |sent, reason: &str| match start(&sent, String::new(), "grpc", true) {
        Err(it) => assert_eq!(it.reason(), reason),
        Ok(other) => panic!("{other:?}"),
    };
    check(
        v1::SubscribeStart {
            session: "x".to_owned(),
            ..a_start()
        },
        "NAME",
    );
    check(
        v1::SubscribeStart {
            subscriber: "a\nb".to_owned(),
            ..a_start()
        },
        "NAME",
    );
    check(
        v1::SubscribeStart {
            delivery: 9,
            ..a_start()
        },
        "ENUM",
    );
    check(
        v1::SubscribeStart {
            max_rate_hz: f32::NAN,
            ..a_start()
        },
        "RATE",
    );
    check(
        v1::SubscribeStart {
            max_rate_hz: -1.0,
            ..a_start()
        },
        "RATE",
    );
}

#[test]
fn bounds_of_a_control_are_its_own_or_those_of_all() {
    let muscle = Muscle {
        name: "jaw_rotation".to_owned(),
        region: frontalis_analysis::face::region::FaceRegion::Lower,
    };
    let bounds = |settings: &MarkerSettings| {
        let it = control(&muscle, settings);
        (it.lower, it.upper)
    };
    let mut settings = MarkerSettings::default();
    assert_eq!(bounds(&settings), (0.0, 1.0));
    settings.allow_exaggeration = true;
    assert_eq!(bounds(&settings), (0.0, 2.0));
    settings.objective.bounds = vec![MuscleBounds {
        muscle: muscle.name.clone(),
        lower: 0.25,
        upper: 0.75,
    }];
    assert_eq!(bounds(&settings), (0.25, 0.75));
}
