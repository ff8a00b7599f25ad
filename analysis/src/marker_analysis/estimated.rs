//! The estimator as a session uses it: one problem for the whole face, or the regions apart with the pose of the whole.

use nalgebra::Vector3;

use super::{
    estimate::{Estimator, Frame},
    evidence::Evidence,
    head_motion::Stabilizer,
    marker_model::MarkerModel,
    settings::{MarkerSettings, RegionMode},
};
use crate::{
    face::muscle::MuscleSet,
    numeric::{
        box_qp::{BoxQpError, Report},
        tape::{Tape, TapeError},
    },
};

/// The estimators of one session.
#[derive(Clone, Debug)]
pub(super) struct Estimated {
    /// Contractions and, unless the head is still, its motion.
    whole: Estimator,
    apart: Option<Apart>,
}

/// Each region by its own markers, once the head's motion has been taken out.
#[derive(Clone, Debug)]
struct Apart {
    model: MarkerModel,
    evidence: Evidence,
    estimator: Estimator,
    /// Contractions of the whole face, which only serve its pose.
    whole_x: Vec<f64>,
    /// The markers without head motion, which the regions take as they are.
    positions: Vec<Vector3<f64>>,
}

impl Estimated {
    /// The estimators that `settings` ask for; `boxes` has the bounds of each muscle in the solver's order.
    pub fn new(
        model: &MarkerModel,
        muscles: &MuscleSet,
        settings: &MarkerSettings,
        boxes: &[[f64; 2]],
        rate_hz: f64,
    ) -> Self {
        let objective = &settings.objective;
        let estimator = |model: &MarkerModel, has_motion| {
            Estimator::new(model, muscles, objective, boxes, has_motion, rate_hz)
        };
        let apart = (settings.region_mode == RegionMode::Split).then(|| {
            let apart = model.with_regions_apart();
            Apart {
                evidence: Evidence::new(&apart, RegionMode::Split),
                estimator: estimator(&apart, false),
                whole_x: vec![0.0; model.n_muscles()],
                positions: vec![Vector3::zeros(); model.n_markers()],
                model: apart,
            }
        });
        Self {
            whole: estimator(model, settings.stabilize_head),
            apart,
        }
    }

    /// Takes over what the estimators that these replace knew.
    pub fn continue_from(&mut self, before: &Self) {
        self.whole.continue_from(&before.whole);
        if let (Some(apart), Some(before)) = (&mut self.apart, &before.apart) {
            apart.estimator.continue_from(&before.estimator);
            if apart.whole_x.len() == before.whole_x.len() {
                apart.whole_x.clone_from(&before.whole_x);
            }
        }
    }

    /// Names what a frame finds of those before it.
    pub fn lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        tape.within("whole", |tape| self.whole.lasts(tape))?;
        if let Some(apart) = &mut self.apart {
            tape.within("apart", |tape| apart.estimator.lasts(tape))?;
            tape.reals("whole_x", &mut apart.whole_x)?;
        }
        Ok(())
    }

    /// The declared rate of the capture.
    pub fn set_rate_hz(&mut self, rate_hz: f64) {
        self.whole.set_rate_hz(rate_hz);
        if let Some(apart) = &mut self.apart {
            apart.estimator.set_rate_hz(rate_hz);
        }
    }

    /// What was known before a gap is not known any more.
    pub fn forget(&mut self) {
        self.whole.forget();
        if let Some(apart) = &mut self.apart {
            apart.estimator.forget();
        }
    }

    /// The estimator whose contractions go out.
    pub fn last(&self) -> &Estimator {
        self.apart.as_ref().map_or(&self.whole, |it| &it.estimator)
    }

    /// Pairs of markers whose labels were put right in the last frame.
    pub fn swaps(&self) -> &[[usize; 2]] {
        self.whole.swaps()
    }

    /// Solves one frame for `x` and, unless the head is still, for `motion`.
    ///
    /// # Errors
    ///
    /// When a round has no solution.
    pub fn solve(
        &mut self,
        frame: &mut Frame<'_>,
        motion: &mut Stabilizer,
        x: &mut [f64],
    ) -> Result<Report, BoxQpError> {
        let Some(apart) = &mut self.apart else {
            return self.whole.solve(frame, motion, x);
        };
        self.whole.solve(frame, motion, &mut apart.whole_x)?;
        apart.evidence.show(&apart.model, &frame.evidence.visible);
        apart.positions.copy_from_slice(frame.stabilized);
        let mut frame = Frame {
            model: &apart.model,
            evidence: &apart.evidence,
            aligned: &mut apart.positions,
            stabilized: frame.stabilized,
            ..*frame
        };
        apart.estimator.solve(&mut frame, motion, x)
    }
}
