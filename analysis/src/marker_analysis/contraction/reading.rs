//! What the frame that was solved last gave: in the actor's order, by the actor's indices.

use nalgebra::Vector3;

use super::{super::evidence::Part, ContractionSolver, RegionOutcome};
use crate::{
    face::region::FaceRegion,
    marker_analysis::{neutral_watch::NeutralDoubt, range::MuscleRange},
    space::{HeadPose, PerformancePoint},
};

impl ContractionSolver {
    /// Contractions in the actor's order.
    pub fn activations(&self) -> Vec<f64> {
        self.in_actors_order(&self.x)
    }

    fn in_actors_order(&self, of_muscles: &[f64]) -> Vec<f64> {
        let mut ordered = vec![0.0; of_muscles.len()];
        for (&muscle, &value) in self.model.muscles.iter().zip(of_muscles) {
            ordered[muscle] = value;
        }
        ordered
    }

    /// Actor's indices of the muscles that the last frame could not tell, ascending.
    pub fn unobserved(&self) -> Vec<usize> {
        let parts: &[Part] = match (&self.estimated, &self.evidence) {
            (Some(estimated), _) if self.is_solved() => estimated.last().parts(),
            (_, Some(evidence)) => &evidence.parts,
            (_, None) => &[],
        };
        let mut unobserved: Vec<usize> = parts
            .iter()
            .zip(&self.model.muscles)
            .filter(|(part, _)| **part == Part::Unobserved)
            .map(|(_, &muscle)| muscle)
            .collect();
        unobserved.sort_unstable();
        unobserved
    }

    /// Whether the last frame was solved, at least a region of it.
    pub(super) fn is_solved(&self) -> bool {
        self.regions.iter().any(|it| it.held.is_none())
    }

    /// How many times the size of the face the last frame had, when it was not a face's: another unit. It was held.
    pub fn scale_jump(&self) -> Option<f64> {
        self.scale_jump
    }

    /// One sigma of each contraction, in the actor's order.
    pub fn standard_errors(&self) -> Vec<f64> {
        let own = self.estimated.as_ref().map_or_else(
            || self.plain_uncertainty.standard_errors(),
            |it| it.last().standard_errors(),
        );
        self.in_actors_order(own)
    }

    /// Noise of a coordinate of a marker, as the residuals show it, centimeters.
    fn sigma_cm(&self) -> f64 {
        self.estimated.as_ref().map_or_else(
            || self.plain_uncertainty.sigma_cm(),
            |it| it.last().sigma_cm(),
        )
    }

    /// Actor's indices of the markers that were seen and masked in the last frame.
    pub fn outliers(&self) -> Vec<usize> {
        let Some(estimated) = self.estimated.as_ref().filter(|_| self.is_solved()) else {
            return Vec::new();
        };
        let used = self.evidence.iter().flat_map(|it| &it.used);
        let masked = used.filter(|j| estimated.last().is_masked(**j));
        masked.map(|&j| self.model.markers[j]).collect()
    }

    /// Actor's indices of the markers whose labels were put right in the last frame.
    pub fn relabeled(&self) -> Vec<[usize; 2]> {
        let Some(estimated) = self.estimated.as_ref().filter(|_| self.is_solved()) else {
            return Vec::new();
        };
        let named = |pair: &[usize; 2]| pair.map(|j| self.model.markers[j]);
        estimated.swaps().iter().map(named).collect()
    }

    /// How far each muscle went, in the actor's order.
    pub fn ranges(&self) -> Vec<MuscleRange> {
        self.diagnosis.ranges(&self.model)
    }

    /// Whether later frames were quieter than the neutral ones, which left `aligned_cm`, centimeters root mean square.
    pub fn quieter_frames_seen(&self, aligned_cm: f64) -> Option<NeutralDoubt> {
        self.diagnosis.doubt(aligned_cm, self.sigma_cm())
    }

    /// The `n` quietest frames seen so far, fewer when there are not as many.
    pub fn quietest_frames(&self, n: usize) -> Vec<&[Option<PerformancePoint>]> {
        self.diagnosis.quietest(n)
    }

    /// What each region showed, in the order of [`FaceRegion::ALL`].
    pub fn regions(&self) -> [(FaceRegion, RegionOutcome); 2] {
        FaceRegion::ALL.map(|it| (it, self.regions[it.index()]))
    }

    /// The head's motion in the last frame; `None` when it is not tracked or not known.
    pub fn head(&self) -> Option<HeadPose> {
        self.head_known.then(|| self.motion.head_pose())
    }

    /// KKT residual of the last solution, relative to the largest diagonal entry of Q; 0 when all is held.
    pub fn kkt_residual(&self) -> f64 {
        self.kkt_residual
    }

    /// The visible markers of the last frame as actor's index, observed and reproduced position, centimeters, head motion
    /// taken out; empty when all is held.
    pub fn visible_markers(
        &self,
    ) -> impl Iterator<Item = (usize, Vector3<f64>, Vector3<f64>)> + '_ {
        let solved = self.regions.iter().any(|it| it.held.is_none());
        let count = if solved { self.model.n_markers() } else { 0 };
        (0..count).filter(|&j| self.visible[j]).map(|j| {
            (
                self.model.markers[j],
                self.stabilized[j],
                self.reproduction.at(j),
            )
        })
    }
}
