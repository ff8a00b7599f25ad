//! The analysis of a take without a server: the same frames, the same function, the same bits.
//!
//! What the wire would do to a frame is done here too: unknown markers are left out, a marker with a NaN is occluded,
//! frames that a server rejects are skipped and counted.

use std::{collections::BTreeMap, sync::Arc};

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings, Progress},
    curve::{CurveSample, Quality},
    face::{
        actor::Actor,
        marker::{FrameIndex, MarkerFrame},
    },
    format::trc::{TrcFrame, TrcTake},
    marker_analysis::{
        alignment::AlignmentError, neutral_watch::NeutralDoubt, objective::ObjectiveError,
        range::MuscleRange,
    },
    space::PerformancePoint,
};

use crate::error::advice_on;

/// A coordinate beyond ±10 m is not a face in a capture volume (A11 of the bad-input table).
const VOLUME_CM: f64 = 1_000.0;

/// The curves of a take.
#[derive(Clone, Debug, Default)]
pub struct Solved {
    /// One sample a usable frame, in order.
    pub samples: Vec<CurveSample>,
    /// Frames that were not used, by the reason a server would give.
    pub rejected: BTreeMap<&'static str, u64>,
    /// Frames at the end of a take that was over before its neutral face was known.
    pub unaligned_frames: u64,
    /// Markers of the file that the actor does not have.
    pub unknown_markers: Vec<String>,
    /// Markers of the actor that the alignment bound to the mesh; `None` before it.
    pub bound_markers: Option<usize>,
    /// What each muscle went through, and what that says of its shape; empty before the alignment.
    pub ranges: Vec<MuscleRange>,
    /// Why the face that was taken as neutral probably was not.
    pub neutral_doubt: Option<NeutralDoubt>,
}

impl Solved {
    /// The mean marker error of a region over the frames that solved it, centimeters; `None` when none did.
    pub fn mean_marker_error_cm(&self, region: usize) -> Option<f64> {
        let reports = self.samples.iter().filter_map(|it| it.regions.get(region));
        let errors: Vec<_> = reports
            .filter(|it| it.quality != Quality::Held)
            .map(|it| it.marker_error_cm)
            .collect();
        let n = errors.len() as f64;
        (!errors.is_empty()).then(|| errors.iter().sum::<f64>() / n)
    }
}

/// Why a take cannot be solved.
#[derive(Debug, thiserror::Error)]
pub enum SolveError {
    /// The take is of another marker layout.
    #[error("none of the take's {n_markers} markers is one of the actor's")]
    UnknownMarkers {
        /// Markers in the take.
        n_markers: usize,
    },
    /// The settings ask for what cannot be, or name a muscle that the actor does not have.
    #[error("these settings cannot be used for the actor")]
    Objective(#[from] ObjectiveError),
    /// The neutral frames do not fit the actor.
    #[error("the neutral face could not be aligned, frame {frame}")]
    Alignment {
        /// The frame with which the neutral frames were complete.
        frame: u64,
        /// Why.
        #[source]
        source: AlignmentError,
    },
}

impl SolveError {
    /// What a person can do about it; the same as for a session that refuses the capture.
    pub fn advice(&self) -> Option<&'static str> {
        match self {
            Self::UnknownMarkers { .. } => advice_on("UNKNOWN_MARKERS"),
            Self::Objective(_) => None,
            Self::Alignment { source, .. } => match source {
                AlignmentError::UnitsSuspect { .. } => advice_on("UNITS_SUSPECT"),
                AlignmentError::Mirrored => advice_on("MIRRORED"),
                AlignmentError::Degenerate => advice_on("DEGENERATE_POSE"),
                AlignmentError::NeutralIncomplete { .. } => {
                    Some("begin the take with a neutral face that shows all markers")
                }
            },
        }
    }
}

/// Solves a whole take. `on_frame` is told after each frame.
///
/// # Errors
///
/// When the settings or the marker names do not fit the actor, or the neutral frames cannot be aligned.
pub fn solve_take(
    take: &TrcTake,
    actor: &Arc<Actor>,
    settings: MarkerSettings,
    mut on_frame: impl FnMut(),
) -> Result<Solved, SolveError> {
    settings.objective.check(actor.muscle_set())?;
    let places = marker_places(take, actor)?;
    let mut analyzer = MarkerAnalyzer::new(Arc::clone(actor), settings, take.unit, take.rate_hz);
    let mut solved = Solved::default();
    for (name, place) in take.marker_names.iter().zip(&places) {
        if place.is_none() {
            solved.unknown_markers.push(name.clone());
        }
    }
    let mut newest = None;
    for frame in &take.frames {
        match usable_frame(take, frame, &places, actor, newest) {
            Ok(usable) => {
                newest = Some(frame.number);
                let progress = analyzer
                    .push(usable, &mut solved.samples)
                    .map_err(|source| SolveError::Alignment {
                        frame: frame.number,
                        source,
                    })?;
                if progress == Progress::ScaleJump {
                    *solved.rejected.entry("SCALE_JUMP").or_default() += 1;
                }
                solved.unaligned_frames = match progress {
                    Progress::Waiting | Progress::Collecting { .. } => solved.unaligned_frames + 1,
                    Progress::Aligned
                    | Progress::Solved
                    | Progress::ScaleJump
                    | Progress::RecenterFailed => 0,
                };
            }
            Err(reason) => *solved.rejected.entry(reason).or_default() += 1,
        }
        on_frame();
    }
    solved.bound_markers = analyzer
        .alignment()
        .map(|it| it.bindings.iter().flatten().count());
    solved.ranges = analyzer.ranges();
    solved.neutral_doubt = analyzer.neutral_doubt();
    Ok(solved)
}

/// For each marker of the take its index in the actor.
fn marker_places(take: &TrcTake, actor: &Actor) -> Result<Vec<Option<usize>>, SolveError> {
    let place = |name: &String| actor.markers().iter().position(|it| it.name == *name);
    let places: Vec<_> = take.marker_names.iter().map(place).collect();
    if places.iter().all(Option::is_none) {
        return Err(SolveError::UnknownMarkers {
            n_markers: places.len(),
        });
    }
    Ok(places)
}

/// The frame in the actor's order and centimeters, or the reason for which a server rejects it.
fn usable_frame(
    take: &TrcTake,
    frame: &TrcFrame,
    places: &[Option<usize>],
    actor: &Actor,
    newest: Option<u64>,
) -> Result<MarkerFrame, &'static str> {
    if frame.number == 0 {
        return Err("FRAME_NUMBER");
    }
    if newest.is_some_and(|it| frame.number <= it) {
        return Err("LATE");
    }
    if frame.positions.len() != places.len() {
        return Err("MARKER_COUNT");
    }
    let mut positions = vec![None; actor.markers().len()];
    for (xyz, place) in frame.positions.iter().zip(places) {
        let point = usable_point(take, *xyz)?;
        if let Some(place) = *place {
            positions[place] = point;
        }
    }
    Ok(MarkerFrame {
        index: FrameIndex(frame.number),
        capture_time_nanos: frame.capture_time_nanos(),
        positions,
    })
}

fn usable_point(
    take: &TrcTake,
    [x, y, z]: [f32; 3],
) -> Result<Option<PerformancePoint>, &'static str> {
    if [x, y, z].iter().any(|it| it.is_infinite()) {
        return Err("NON_FINITE");
    }
    if [x, y, z].iter().any(|it| it.is_nan()) {
        return Ok(None);
    }
    let point = take.unit.performance_point(x, y, z);
    if point.0.iter().any(|it| it.abs() > VOLUME_CM) {
        return Err("OUT_OF_VOLUME");
    }
    Ok(Some(point))
}

#[cfg(test)]
mod tests {
    use frontalis_analysis::{space::LengthUnit, synthesis::reference_face};

    use super::*;
    use crate::simulated_stage::{SimulatedStage, StageSettings};

    /// Two seconds of the reference actor seen without noise, and the true activations.
    fn take() -> (Arc<Actor>, TrcTake, Vec<Vec<f64>>) {
        let actor = Arc::new(reference_face::actor());
        let settings = StageSettings {
            seconds: 2.0,
            pixel_noise: 0.0,
            misses: 0.0,
            ..StageSettings::default()
        };
        let mut truth = Vec::new();
        let mut frames = Vec::new();
        for frame in SimulatedStage::new(Arc::clone(&actor), settings).unwrap() {
            #[expect(clippy::cast_possible_truncation, reason = "a take holds f32")]
            let coordinates = |it: &PerformancePoint| it.0.coords.map(|it| it as f32);
            frames.push(TrcFrame {
                number: frame.number,
                time_s: frame.capture_time_nanos as f64 * 1e-9,
                positions: frame
                    .true_positions
                    .iter()
                    .map(|it| coordinates(it).into())
                    .collect(),
            });
            truth.push(frame.truth);
        }
        let take = TrcTake {
            rate_hz: settings.rate_hz,
            unit: LengthUnit::Centimeter,
            marker_names: actor.markers().iter().map(|it| it.name.clone()).collect(),
            frames,
            start_timecode: None,
        };
        (actor, take, truth)
    }

    fn solve(actor: &Arc<Actor>, take: &TrcTake) -> Solved {
        // These tests are about frames, not about terms that add to what a frame says.
        solve_take(take, actor, MarkerSettings::plain(), || ()).unwrap()
    }

    #[test]
    fn a_performance_without_noise_gives_its_activations_back() {
        let (actor, take, truth) = take();
        let solved = solve(&actor, &take);
        assert_eq!(solved.samples.len(), take.frames.len());
        for (sample, truth) in solved.samples.iter().zip(&truth) {
            for (found, truth) in sample.activations.iter().zip(truth) {
                assert!((found - truth).abs() < 0.01, "frame {}", sample.frame.0);
            }
        }
    }

    #[test]
    fn the_order_of_the_markers_in_the_file_does_not_matter() {
        let (actor, take, _) = take();
        let mut reversed = take.clone();
        reversed.marker_names.reverse();
        for frame in &mut reversed.frames {
            frame.positions.reverse();
        }
        assert_eq!(
            solve(&actor, &take).samples,
            solve(&actor, &reversed).samples
        );
    }

    #[test]
    fn frames_that_a_server_rejects_are_left_out_and_counted() {
        let (actor, mut take, _) = take();
        take.frames[30].positions[1][1] = f32::INFINITY;
        take.frames[31].positions[1][1] = 1_000.5;
        take.frames[32].number = 7;
        take.frames[33].positions.pop();
        // One coordinate unknown: only that marker is occluded.
        take.frames[34].positions[1][1] = f32::NAN;
        let solved = solve(&actor, &take);
        assert_eq!(solved.samples.len(), take.frames.len() - 4);
        let reasons: Vec<_> = solved.rejected.keys().copied().collect();
        assert_eq!(
            reasons,
            ["LATE", "MARKER_COUNT", "NON_FINITE", "OUT_OF_VOLUME"]
        );
    }

    #[test]
    fn markers_that_the_actor_does_not_have_are_left_out_by_name() {
        let (actor, mut take, _) = take();
        take.marker_names[0] = "ear_left".to_owned();
        assert_eq!(solve(&actor, &take).unknown_markers, ["ear_left"]);
        for (index, name) in take.marker_names.iter_mut().enumerate() {
            *name = format!("unknown_{index}");
        }
        let error = solve_take(&take, &actor, MarkerSettings::default(), || ()).unwrap_err();
        assert!(matches!(error, SolveError::UnknownMarkers { n_markers } if n_markers > 0));
    }

    #[test]
    fn a_region_that_was_never_solved_has_no_marker_error() {
        let (actor, mut take, _) = take();
        let whole = solve(&actor, &take);
        assert_eq!(whole.bound_markers, Some(actor.markers().len()));
        assert!(whole.mean_marker_error_cm(0).is_some() && whole.mean_marker_error_cm(1).is_some());
        assert_eq!(whole.mean_marker_error_cm(7), None);
        // After its neutral face only the first marker is seen.
        let neutral = MarkerSettings::default().neutral_frames;
        for frame in take.frames.iter_mut().skip(neutral) {
            frame.positions[1..].fill([f32::NAN; 3]);
        }
        let mut blind = solve(&actor, &take);
        blind.samples.drain(..neutral);
        assert_eq!(blind.mean_marker_error_cm(0), None);
    }

    #[test]
    fn a_wrong_unit_and_a_mirrored_axis_come_with_a_sessions_advice() {
        let (actor, take, _) = take();
        let advice = |scale: [f32; 3]| {
            let mut take = take.clone();
            for position in take.frames.iter_mut().flat_map(|it| &mut it.positions) {
                *position = std::array::from_fn(|axis| position[axis] * scale[axis]);
            }
            let solved = solve_take(&take, &actor, MarkerSettings::default(), || ());
            solved.unwrap_err().advice()
        };
        assert_eq!(advice([0.1; 3]), advice_on("UNITS_SUSPECT"));
        assert_eq!(advice([-1.0, 1.0, 1.0]), advice_on("MIRRORED"));
        assert!(advice_on("MIRRORED").is_some() && advice_on("UNITS_SUSPECT").is_some());
    }

    #[test]
    fn a_take_that_is_over_before_its_neutral_face_is_known_says_so() {
        let (actor, mut take, _) = take();
        take.frames.truncate(5);
        let solved = solve(&actor, &take);
        assert!(solved.samples.is_empty());
        assert_eq!(solved.unaligned_frames, 5);
    }
}
