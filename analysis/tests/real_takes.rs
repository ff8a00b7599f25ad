//! Real people's performances on a scan-derived face: how far the contractions are from those that made the takes.
#![expect(clippy::unwrap_used, reason = "the failure of a test is its report")]

use std::{path::PathBuf, sync::Arc};

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, RegionMode},
    curve::CurveSample,
    face::{
        actor::{Actor, RankPolicy},
        marker::{FrameIndex, MarkerFrame},
    },
    format::{actor_package, trc},
};

/// Mean absolute error that the plain joint solve and the default settings may have on the takes with head motion.
const LIMITS: [(&str, [f64; 2]); 3] = [
    ("ns164_muscle16_27", [0.0175, 0.0070]),
    ("facegood_speech_muscle16_27", [0.0135, 0.0053]),
    ("llv_muscle16_27", [0.0205, 0.0105]),
];

/// The same for thirty shapes, where there is one.
const LIMITS_OF_SHAPES: [(&str, f64); 2] = [("ns164_facs30_60", 0.0078), ("llv_facs30_60", 0.013)];

/// A file of the shared data, which lies beside the repository and may be absent.
fn shared(path: &str) -> Option<Vec<u8>> {
    let beside = || concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data").into();
    let root = std::env::var_os("FRONTALIS_DATA").map_or_else(beside, PathBuf::from);
    #[expect(clippy::disallowed_methods, reason = "a test reads its data")]
    let bytes = std::fs::read(root.join(path)).ok();
    if bytes.is_none() {
        println!(
            "LEFT OUT: real_takes: {path} is not in FRONTALIS_DATA ({})",
            root.display()
        );
    }
    bytes
}

fn actor(package: &str) -> Option<Arc<Actor>> {
    let bytes = shared(&format!("actors/ict_{package}.zip"))?;
    Some(Arc::new(
        actor_package::read(&bytes, RankPolicy::Refuse)
            .unwrap()
            .actor,
    ))
}

fn solve(actor: &Arc<Actor>, take: &trc::TrcTake, settings: MarkerSettings) -> Vec<CurveSample> {
    let mut analyzer = MarkerAnalyzer::new(Arc::clone(actor), settings, take.unit, take.rate_hz);
    let names: Vec<_> = actor.markers().iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, take.marker_names);
    let mut samples = Vec::new();
    for frame in &take.frames {
        let positions = frame.positions.iter().map(|[x, y, z]| {
            let seen = !(x.is_nan() || y.is_nan() || z.is_nan());
            seen.then(|| take.unit.performance_point(*x, *y, *z))
        });
        let frame = MarkerFrame {
            index: FrameIndex(frame.number),
            capture_time_nanos: frame.capture_time_nanos(),
            positions: positions.collect(),
        };
        analyzer.push(frame, &mut samples).unwrap();
    }
    assert!(samples.iter().all(|it| it.kkt_residual <= 1e-10));
    samples
}

fn mean_absolute_error(samples: &[CurveSample], truth: &[u8]) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    let rows = std::str::from_utf8(truth).unwrap().lines().skip(1);
    for (row, sample) in rows.zip(samples) {
        let mut values = row.split(',');
        assert_eq!(values.next().unwrap(), sample.frame.0.to_string());
        for (value, found) in values.zip(&sample.activations) {
            sum += (value.parse::<f64>().unwrap() - found).abs();
            count += 1.0;
        }
    }
    sum / count
}

/// Errors of one take: plain joint, plain split, and by default.
fn errors(actor: &Arc<Actor>, take: &str, motion: &str) -> Option<[f64; 3]> {
    let truth = shared(&format!("takes/{take}.truth.csv"))?;
    let take = trc::parse(&shared(&format!("takes/{take}_{motion}.trc"))?).unwrap();
    let split = MarkerSettings {
        region_mode: RegionMode::Split,
        ..MarkerSettings::plain()
    };
    let settings = [MarkerSettings::plain(), split, MarkerSettings::default()];
    Some(settings.map(|it| mean_absolute_error(&solve(actor, &take, it), &truth)))
}

fn print(take: &str, motion: &str, [joint, split, default]: [f64; 3]) {
    println!(
        "{take} {motion:<6}: mean absolute error {joint:.4} plain joint, {split:.4} plain split, {default:.4} by default"
    );
}

#[test]
fn the_contractions_of_real_performances_are_found() {
    let Some(actor) = actor("muscle16_27") else {
        return;
    };
    for (take, [plain_limit, limit]) in LIMITS {
        for motion in ["still", "moving"] {
            let Some(errors) = errors(&actor, take, motion) else {
                return;
            };
            print(take, motion, errors);
            let [joint, _, default] = errors;
            if motion == "moving" {
                assert!(joint <= plain_limit, "{take}, plain: {joint}");
                assert!(default <= limit, "{take}: {default}");
            }
        }
    }
}

#[test]
fn thirty_facs_shapes_are_solved_too() {
    for package in ["facs30_27", "facs30_60"] {
        let Some(actor) = actor(package) else { return };
        for person in ["ns164", "facegood_speech", "llv"] {
            let take = format!("{person}_{package}");
            if (person, package) == ("facegood_speech", "facs30_60") {
                continue; // There is no such take.
            }
            let Some(errors) = errors(&actor, &take, "moving") else {
                return;
            };
            print(&take, "moving", errors);
            let mut limits = LIMITS_OF_SHAPES.into_iter();
            let limit = limits.find(|it| it.0 == take).map_or(0.05, |it| it.1);
            assert!(errors[2] <= limit, "{take}: {}", errors[2]);
        }
    }
}

#[test]
fn a_glb_package_gives_the_curves_of_the_zip() {
    let Some(zip) = actor("muscle16_27") else {
        return;
    };
    let Some(take) = shared("takes/llv_muscle16_27_moving.trc") else {
        return;
    };
    let take = trc::parse(&take).unwrap();
    let bytes = actor_package::write_glb(&zip);
    let glb = Arc::new(
        actor_package::read(&bytes, RankPolicy::Refuse)
            .unwrap()
            .actor,
    );
    let [from_zip, from_glb] =
        [zip, glb].map(|actor| solve(&actor, &take, MarkerSettings::default()));
    let largest = from_zip
        .iter()
        .zip(&from_glb)
        .flat_map(|(a, b)| a.activations.iter().zip(&b.activations))
        .fold(0.0, |largest: f64, (a, b)| largest.max((a - b).abs()));
    println!("curves of the GLB route differ from those of the ZIP by at most {largest:.1e}");
    assert_eq!(largest.to_bits(), 0, "{largest:e}");
}
