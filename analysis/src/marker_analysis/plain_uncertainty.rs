//! How far the curves of the paper's own objective can be trusted: the noise by what they leave, the covariance by which
//! muscles are at a bound.

use nalgebra::Vector3;

use super::{
    estimate::UNKNOWN,
    evidence::Evidence,
    head_motion::RIDGE,
    marker_model::MarkerModel,
    noise::{Left, Noise},
    reproduction::Reproduction,
    settings::RegionMode,
};
use crate::numeric::{
    box_qp::BoxQp,
    posterior::Posterior,
    tape::{Tape, TapeError},
};

/// Standard errors of one session's plain solutions.
#[derive(Clone, Debug)]
pub(super) struct PlainUncertainty {
    noise: Noise,
    posterior: Posterior,
    /// Q of a head that does not move, m × m.
    hessian: Vec<f64>,
    region_gram: Vec<f64>,
    /// The visibility that `hessian` belongs to.
    visible: Vec<bool>,
    free: Vec<usize>,
    /// The free set that `variances` belong to.
    known_free: Vec<usize>,
    /// Variances in units of the noise's.
    variances: Vec<f64>,
    ones: Vec<f64>,
    residuals: Vec<Vector3<f64>>,
    standard_errors: Vec<f64>,
}

/// A frame that was solved.
pub(super) struct PlainFrame<'a> {
    pub model: &'a MarkerModel,
    pub evidence: &'a Evidence,
    pub stabilized: &'a [Vector3<f64>],
    pub reproduction: &'a Reproduction,
    pub x: &'a [f64],
    pub boxes: &'a [[f64; 2]],
    pub mode: RegionMode,
    /// The problem in which the head's motion is unknown too.
    pub joint: Option<&'a BoxQp>,
    pub rate_hz: f64,
}

impl PlainUncertainty {
    pub fn new(model: &MarkerModel, n_unknowns: usize) -> Self {
        let (n, m) = (model.n_markers(), model.n_muscles());
        Self {
            noise: Noise::new(n),
            posterior: Posterior::with_capacity(n_unknowns),
            hessian: vec![0.0; m * m],
            region_gram: vec![0.0; m * m],
            visible: vec![false; n],
            free: Vec::with_capacity(n_unknowns),
            known_free: Vec::with_capacity(n_unknowns),
            variances: vec![0.0; m],
            ones: vec![1.0; n],
            residuals: vec![Vector3::zeros(); n],
            standard_errors: vec![UNKNOWN; m],
        }
    }

    /// One sigma of each contraction.
    pub fn standard_errors(&self) -> &[f64] {
        &self.standard_errors
    }

    /// Noise of a coordinate of a marker, centimeters.
    pub fn sigma_cm(&self) -> f64 {
        self.noise.sigma_cm()
    }

    /// Names what a frame finds of those before it. What was found of a visibility is found anew, with the same bits.
    pub fn lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        tape.within("noise", |tape| self.noise.lasts(tape))?;
        tape.reals("variances", &mut self.variances)?;
        tape.reals("standard_errors", &mut self.standard_errors)
    }

    /// Takes in one frame.
    pub fn observe(&mut self, frame: &PlainFrame<'_>) {
        for &j in &frame.evidence.used {
            self.residuals[j] = frame.stabilized[j] - frame.reproduction.at(j);
        }
        let is_free =
            |i: &usize| frame.boxes[*i][0] < frame.x[*i] && frame.x[*i] < frame.boxes[*i][1];
        self.free.clear();
        self.free.extend((0..frame.x.len()).filter(is_free));
        let n_motion = frame.joint.map_or(0, |it| it.len() - frame.x.len());
        let left = Left {
            used: &frame.evidence.used,
            residuals: &self.residuals,
            weights: &self.ones,
            n_fitted: (self.free.len() + n_motion) as f64,
        };
        self.noise.observe(&left, frame.rate_hz);
        match frame.joint {
            Some(qp) => {
                self.free.extend(frame.x.len()..qp.len());
                self.find_variances(qp.hessian(), qp.stride());
            }
            None => self.find_still_variances(frame),
        }
        let noise = self.noise.variance();
        for (error, variance) in self.standard_errors.iter_mut().zip(&self.variances) {
            *error = (noise * variance).sqrt().min(UNKNOWN);
        }
    }

    /// Where the head is still, Q is the same as long as the markers seen are, and the variances as long as the free set is.
    fn find_still_variances(&mut self, frame: &PlainFrame<'_>) {
        let is_known = self.visible == frame.evidence.visible;
        if is_known && self.known_free == self.free {
            return;
        }
        if !is_known {
            self.visible.copy_from_slice(&frame.evidence.visible);
            self.find_still_hessian(frame);
        }
        let hessian = std::mem::take(&mut self.hessian);
        self.find_variances(&hessian, frame.x.len());
        self.hessian = hessian;
        self.known_free.clone_from(&self.free);
    }

    fn find_still_hessian(&mut self, frame: &PlainFrame<'_>) {
        let (model, m) = (frame.model, frame.x.len());
        match frame.mode {
            RegionMode::Joint => self.hessian.copy_from_slice(&frame.evidence.gram),
            RegionMode::Split => {
                self.hessian.fill(0.0);
                for (index, own) in frame.evidence.own_used.iter().enumerate() {
                    self.region_gram.fill(0.0);
                    for &j in own {
                        model.change_gram(&mut self.region_gram, m, j, 1.0);
                    }
                    let muscles = model.own_muscles[index].clone();
                    for i in muscles.clone() {
                        let block = i * m + muscles.start..i * m + muscles.end;
                        self.hessian[block.clone()].copy_from_slice(&self.region_gram[block]);
                    }
                }
            }
        }
        for i in 0..m {
            self.hessian[i * m + i] += RIDGE;
        }
    }

    /// Variances under `hessian`; where it is not definite, what was known stands.
    fn find_variances(&mut self, hessian: &[f64], stride: usize) {
        if self.posterior.find(hessian, stride, &self.free).is_err() {
            return;
        }
        let mut free = self.free.iter().enumerate().peekable();
        for (i, it) in self.variances.iter_mut().enumerate() {
            *it = match free.next_if(|(_, unknown)| **unknown == i) {
                Some((place, _)) => self.posterior.variance(place),
                None => self
                    .posterior
                    .variance_of_bound(hessian, stride, &self.free, i),
            };
        }
    }
}
