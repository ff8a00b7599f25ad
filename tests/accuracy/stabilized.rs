//! What is left of a take for a method that knows no head: displacements d = Z − p₀ under a pose that is given.

use frontalis_analysis::face::{
    actor::Actor, basis::MarkerBasis, marker::MarkerFrame, region::FaceRegion,
};
use frontalis_analysis::space::HeadPose;
use harness::accuracy::{
    curves::Curves,
    take::{Solution, Take},
};

/// The linear problems of a take, one a frame, in centimeters of the actor.
///
/// Alignment, binding of the markers and the head's pose are those of the plain joint solve.
pub struct Stabilized {
    /// The markers' displacements by row: three rows a marker, one column a muscle.
    pub basis: Vec<Vec<f64>>,
    /// The region of each row's marker.
    pub row_regions: Vec<FaceRegion>,
    /// The region of each muscle.
    pub muscle_regions: Vec<FaceRegion>,
    /// d of every frame, NaN where the marker was not seen; `None` where the plain solve knew no pose.
    pub displacements: Vec<Option<Vec<f64>>>,
}

impl Stabilized {
    /// The problems behind `plain`, the plain solution of `take`.
    pub fn of(take: &Take, actor: &Actor, plain: &Solution) -> Self {
        let bindings = &plain.alignment.bindings;
        let bound: Vec<usize> = (0..bindings.len())
            .filter(|&j| bindings[j].is_some())
            .collect();
        let hand_marked = actor.virtual_markers().iter();
        let places: Vec<_> = (bindings.iter().zip(hand_marked))
            .map(|(bound, hand_marked)| bound.unwrap_or(*hand_marked))
            .collect();
        let basis = MarkerBasis::at(actor, &places);
        let rows = bound
            .iter()
            .flat_map(|&j| (0..3).map(move |axis| (j, axis)));
        let frames = take.frames.iter().zip(&plain.samples);
        Self {
            basis: (rows.clone())
                .map(|(j, axis)| basis.of_marker_cm(j).iter().map(|it| it[axis]).collect())
                .collect(),
            row_regions: rows.map(|(j, _)| actor.markers()[j].region).collect(),
            muscle_regions: actor
                .muscle_set()
                .muscles()
                .iter()
                .map(|it| it.region)
                .collect(),
            displacements: frames
                .map(|(frame, sample)| {
                    let undo = sample.head?.inverse();
                    Some(displacements(frame, &bound, &undo, &basis, plain))
                })
                .collect(),
        }
    }

    /// Number of muscles.
    pub fn n_muscles(&self) -> usize {
        self.muscle_regions.len()
    }

    /// Solves frame after frame: `solve` is given d and the contractions of the frame before, which it replaces.
    /// Without a pose they stay.
    pub fn each_frame(&self, mut solve: impl FnMut(&[f64], &mut Vec<f64>)) -> Curves {
        let mut x = vec![0.0; self.n_muscles()];
        let rows = self.displacements.iter().map(|d| {
            if let Some(d) = d {
                solve(d, &mut x);
            }
            x.clone()
        });
        Curves(rows.collect())
    }
}

fn displacements(
    frame: &MarkerFrame,
    bound: &[usize],
    undo: &HeadPose,
    basis: &MarkerBasis,
    plain: &Solution,
) -> Vec<f64> {
    let similarity = &plain.alignment.model_from_performance;
    let of = |&j: &usize| {
        let seen = frame.positions[j].map(|it| undo.apply(similarity.to_model(it)));
        seen.map_or([f64::NAN; 3], |it| (it.0 - basis.neutral[j].0).into())
    };
    bound.iter().flat_map(of).collect()
}
