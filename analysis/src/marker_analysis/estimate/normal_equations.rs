//! Weighted least squares over the contractions and a small motion of the head, as Q and c of a quadratic problem.
//!
//! Unknown are x, ω, τ of Zⱼ + ω × aⱼ + τ = pⱼ + Σ xᵢdᵢⱼ with the arm aⱼ = Zⱼ − c about a center c that is kept for the frame.
//! Q is a sum over markers, `Σ wⱼ KⱼᵀKⱼ`. It is formed once a frame with every weight 1, from sums that stay the same for many
//! frames; each round then adds only what the weights have changed. The arms of the first round serve all rounds: the head turns by
//! little within a frame, and c, which decides where the solution is, is formed anew.

use nalgebra::{Matrix3, Vector3};

use super::super::{evidence::Evidence, head_motion::MOTION, marker_model::MarkerModel};
use crate::numeric::inverse::mirror;

/// Q and c before the terms of the objective are added.
#[derive(Clone, Debug)]
pub(super) struct NormalEquations {
    m: usize,
    /// Whether the motion is unknown too.
    has_motion: bool,
    /// Distance of the columns of Q.
    stride: usize,
    /// The lower triangle of Q.
    lower: Vec<f64>,
    pub linear: Vec<f64>,
    /// The weights that Q was formed with, one a marker.
    weights: Vec<f64>,
    center: Vector3<f64>,
    arms: Vec<Vector3<f64>>,
    /// Σ aⱼ × dᵢⱼ by axis, one a muscle, with every weight 1.
    moments: [Vec<f64>; 3],
    /// One marker's rows of K for ω.
    turned: [Vec<f64>; 3],
}

impl NormalEquations {
    pub fn new(model: &MarkerModel, has_motion: bool, stride: usize) -> Self {
        let (n, m) = (model.n_markers(), model.n_muscles());
        let size = if has_motion { m + MOTION } else { m };
        Self {
            m,
            has_motion,
            stride,
            lower: vec![0.0; size * stride],
            linear: vec![0.0; size],
            weights: vec![1.0; n],
            center: Vector3::zeros(),
            arms: vec![Vector3::zeros(); n],
            moments: std::array::from_fn(|_| vec![0.0; m]),
            turned: std::array::from_fn(|_| vec![0.0; m]),
        }
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.linear.len()
    }

    /// The point that ω turns about.
    pub fn center(&self) -> Vector3<f64> {
        self.center
    }

    /// An entry of Q's diagonal.
    pub fn diagonal(&self, i: usize) -> f64 {
        self.lower[i * self.stride + i]
    }

    /// Writes Q in full.
    pub fn write_hessian(&self, hessian: &mut [f64]) {
        hessian.copy_from_slice(&self.lower);
        mirror(hessian, self.size(), self.stride);
    }

    /// Begins a frame: forms Q with every weight 1 and the arms of the markers at `stabilized`.
    pub fn begin(&mut self, model: &MarkerModel, evidence: &Evidence, stabilized: &[Vector3<f64>]) {
        for &j in &evidence.used {
            self.weights[j] = 1.0;
        }
        let gram = evidence.gram.chunks_exact(self.m.max(1));
        for (i, (to, from)) in self
            .lower
            .chunks_exact_mut(self.stride)
            .zip(gram)
            .enumerate()
        {
            to[..=i].copy_from_slice(&from[..=i]);
        }
        if self.has_motion {
            self.begin_motion(model, evidence, stabilized);
        }
    }

    fn begin_motion(
        &mut self,
        model: &MarkerModel,
        evidence: &Evidence,
        stabilized: &[Vector3<f64>],
    ) {
        let n = evidence.used.len().max(1) as f64;
        let sum: Vector3<f64> = evidence.used.iter().map(|&j| stabilized[j]).sum();
        self.center = sum / n;
        for it in &mut self.moments {
            it.fill(0.0);
        }
        let (mut squares, mut scatter) = (0.0, Matrix3::zeros());
        for &j in &evidence.used {
            let arm = stabilized[j] - self.center;
            self.arms[j] = arm;
            squares += arm.norm_squared();
            scatter += arm * arm.transpose();
            self.add_moment(model, j, &arm);
        }
        self.write_motion_rows(evidence, &(Matrix3::identity() * squares - scatter), n);
    }

    fn add_moment(&mut self, model: &MarkerModel, j: usize, arm: &Vector3<f64>) {
        let support = model.marker_support[j].clone();
        let [dx, dy, dz] = [0, 1, 2].map(|axis| &model.row(j, axis)[support.clone()]);
        let [mx, my, mz] = self.moments.each_mut().map(|it| &mut it[support.clone()]);
        let (mx, my, mz) = (mx.iter_mut(), my.iter_mut(), mz.iter_mut());
        for (((mx, my), mz), ((x, y), z)) in mx.zip(my).zip(mz).zip(dx.iter().zip(dy).zip(dz)) {
            *mx += arm.y * z - arm.z * y;
            *my += arm.z * x - arm.x * z;
            *mz += arm.x * y - arm.y * x;
        }
    }

    /// The rows of ω and τ with every weight 1: the arms are about their mean, so that ω and τ do not share.
    fn write_motion_rows(&mut self, evidence: &Evidence, inertia: &Matrix3<f64>, n: f64) {
        for axis in 0..3 {
            let row = &mut self.lower[(self.m + axis) * self.stride..];
            for (to, moment) in row.iter_mut().zip(&self.moments[axis]) {
                *to = -moment;
            }
            for other in 0..=axis {
                row[self.m + other] = inertia[(axis, other)];
            }
            let row = &mut self.lower[(self.m + 3 + axis) * self.stride..];
            for (to, sum) in row.iter_mut().zip(&evidence.displacement_sums) {
                *to = -sum[axis];
            }
            row[self.m..self.m + 3 + axis].fill(0.0);
            row[self.m + 3 + axis] = n;
        }
    }

    /// Takes over the weights of this round.
    pub fn reweigh(&mut self, model: &MarkerModel, evidence: &Evidence, weights: &[f64]) {
        for &j in &evidence.used {
            let change = weights[j] - self.weights[j];
            if change != 0.0 {
                self.weights[j] = weights[j];
                self.change_muscles(model, j, change);
                if self.has_motion {
                    self.change_motion(model, j, change);
                }
            }
        }
    }

    /// Adds `change` times one marker's part to the muscles' block.
    fn change_muscles(&mut self, model: &MarkerModel, j: usize, change: f64) {
        let support = model.marker_support[j].clone();
        let [dx, dy, dz] = [0, 1, 2].map(|axis| &model.row(j, axis)[support.clone()]);
        for (k, i) in support.clone().enumerate() {
            let (x, y, z) = (change * dx[k], change * dy[k], change * dz[k]);
            let row = &mut self.lower[i * self.stride + support.start..][..=k];
            let others = dx.iter().zip(dy).zip(dz);
            for (q, ((ox, oy), oz)) in row.iter_mut().zip(others) {
                *q += x * ox + y * oy + z * oz;
            }
        }
    }

    /// Adds `change` times one marker's part to the rows of ω and τ.
    fn change_motion(&mut self, model: &MarkerModel, j: usize, change: f64) {
        let (m, stride, arm) = (self.m, self.stride, self.arms[j]);
        let support = model.marker_support[j].clone();
        let d = [0, 1, 2].map(|axis| &model.row(j, axis)[support.clone()]);
        let [tx, ty, tz] = self.turned.each_mut().map(|it| &mut it[support.clone()]);
        for k in 0..support.len() {
            let (x, y, z) = (d[0][k], d[1][k], d[2][k]);
            tx[k] = arm.y * z - arm.z * y;
            ty[k] = arm.z * x - arm.x * z;
            tz[k] = arm.x * y - arm.y * x;
        }
        let squares = arm.norm_squared();
        for axis in 0..3 {
            let row = &mut self.lower[(m + axis) * stride..];
            for (q, t) in row[support.clone()]
                .iter_mut()
                .zip(&self.turned[axis][support.clone()])
            {
                *q -= change * t;
            }
            for other in 0..=axis {
                row[m + other] -= change * arm[axis] * arm[other];
            }
            row[m + axis] += change * squares;
            let row = &mut self.lower[(m + 3 + axis) * stride..];
            for (q, d) in row[support.clone()].iter_mut().zip(d[axis]) {
                *q -= change * d;
            }
            row[m + 3 + axis] += change;
        }
        // Row of τ, column of ω: Σ w (ω × a)·τ.
        let mut share = |tau: usize, omega: usize, value: f64| {
            self.lower[(m + 3 + tau) * stride + m + omega] += change * value;
        };
        share(0, 1, arm.z);
        share(0, 2, -arm.y);
        share(1, 0, -arm.z);
        share(1, 2, arm.x);
        share(2, 0, arm.y);
        share(2, 1, -arm.x);
    }

    /// Forms c from the markers where they are now.
    pub fn form_linear(
        &mut self,
        model: &MarkerModel,
        evidence: &Evidence,
        stabilized: &[Vector3<f64>],
    ) {
        self.linear.fill(0.0);
        let (mut torque, mut force) = (Vector3::zeros(), Vector3::zeros());
        for &j in &evidence.used {
            let weight = self.weights[j];
            if weight <= 0.0 {
                continue;
            }
            let error = weight * (stabilized[j] - model.rest[j]);
            torque += self.arms[j].cross(&error);
            force += error;
            let support = model.marker_support[j].clone();
            let [dx, dy, dz] = [0, 1, 2].map(|axis| &model.row(j, axis)[support.clone()]);
            let d = dx.iter().zip(dy).zip(dz);
            for (c, ((x, y), z)) in self.linear[support].iter_mut().zip(d) {
                *c += x * error.x + y * error.y + z * error.z;
            }
        }
        if self.has_motion {
            for axis in 0..3 {
                self.linear[self.m + axis] = -torque[axis];
                self.linear[self.m + 3 + axis] = -force[axis];
            }
        }
    }
}
