//! Contractions and head motion in one problem.
//!
//! Unknown are x and a small motion (ω, τ) about the center of the visible markers:
//! Zⱼ + ω × (Zⱼ − c) + τ = pⱼ + Σ xᵢdᵢⱼ, with Z the markers under the last known motion.
//! Each round solves the box QP of the linearized problem exactly and turns the motion by its solution (Gauss-Newton);
//! it ends when the motion stands still.

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

use super::{evidence::Evidence, marker_model::MarkerModel};
use crate::{
    numeric::{
        box_qp::{BoxQp, BoxQpError, Report},
        similarity_fit::{Scale, fit},
    },
    space::HeadPose,
};

/// Limit of Gauss-Newton rounds; two or three are usual.
const ROUNDS: usize = 8;

/// The motion stands still when a round turns it by less (radians) and moves it by less (centimeters).
const STILL: f64 = 1e-7;

/// Unknowns of a rigid motion: ω, then τ.
pub(super) const MOTION: usize = 6;

/// Bound of a round's motion, radians and centimeters: finite so that the box QP needs no special case.
pub(super) const MOTION_BOUND: f64 = 1e3;

/// Added to the diagonal of Q, so that the problem is strictly convex whatever the markers show.
pub(super) const RIDGE: f64 = 1e-9;

/// Weights of the first fit: marker standard deviation and the share of a marker's mobility that counts as noise.
const FIT_SIGMA_CM: f64 = 0.03;
const FIT_MOBILITY_SHARE: f64 = 0.3;

/// The motion that takes the markers of a frame back to the neutral head: Z = R Y + t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stabilizer {
    pub rotation: Matrix3<f64>,
    pub translation: Vector3<f64>,
}

impl Stabilizer {
    pub fn identity() -> Self {
        Self {
            rotation: Matrix3::identity(),
            translation: Vector3::zeros(),
        }
    }

    pub fn apply(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * point + self.translation
    }

    /// The head's own motion, which this one takes back.
    pub fn head_pose(&self) -> HeadPose {
        let rotation = Rotation3::from_matrix_unchecked(self.rotation);
        HeadPose {
            rotation: UnitQuaternion::from_rotation_matrix(&rotation),
            translation_cm: self.translation,
        }
        .inverse()
    }

    /// The best rigid fit of the used markers to where they are `expected`, trusting those
    /// most that muscles move least.
    pub fn fitted(
        model: &MarkerModel,
        evidence: &Evidence,
        aligned: &[Vector3<f64>],
        expected: &[[f64; 3]],
    ) -> Option<Self> {
        let pairs = evidence.used.iter().map(|&j| {
            let noise = FIT_MOBILITY_SHARE * model.mobility(j);
            let weight = 1.0 / (FIT_SIGMA_CM * FIT_SIGMA_CM + noise * noise);
            (weight, Point3::from(aligned[j]), Point3::from(expected[j]))
        });
        let motion = fit(pairs, Scale::One)?;
        Some(Self {
            rotation: motion.rotation.to_rotation_matrix().into_inner(),
            translation: motion.translation,
        })
    }

    /// Adds exp(ω) about `center`, then τ. The product is brought back to a rotation, so that errors do not add up.
    pub fn advance(&mut self, omega: Vector3<f64>, tau: Vector3<f64>, center: Vector3<f64>) {
        let turn = Rotation3::from_scaled_axis(omega);
        let rotation = turn.matrix() * self.rotation;
        self.translation = turn * (self.translation - center) + center + tau;
        self.rotation = orthonormal(&rotation);
    }
}

/// One Newton step towards the closest orthonormal matrix: `R (3 I − RᵀR) / 2`, exact to second order.
fn orthonormal(near: &Matrix3<f64>) -> Matrix3<f64> {
    near * (Matrix3::identity() * 3.0 - near.transpose() * near) * 0.5
}

/// Buffers of the joint problem.
#[derive(Clone, Debug)]
pub(super) struct JointProblem {
    pub qp: BoxQp,
    linear: Vec<f64>,
    unknowns: Vec<f64>,
    /// Σ (Zⱼ − c) × dᵢⱼ by axis, one a muscle.
    moments: [Vec<f64>; 3],
}

impl JointProblem {
    pub fn new(n_muscles: usize) -> Self {
        let size = n_muscles + MOTION;
        let mut qp = BoxQp::new(size);
        for i in n_muscles..size {
            qp.set_bounds(i, -MOTION_BOUND, MOTION_BOUND);
        }
        Self {
            qp,
            linear: vec![0.0; size],
            unknowns: vec![0.0; size],
            moments: std::array::from_fn(|_| vec![0.0; n_muscles]),
        }
    }

    /// Takes over the sums that do not depend on the motion: the muscles' block and the translation's. Every muscle gets
    /// its box.
    pub fn set_evidence(&mut self, evidence: &Evidence, boxes: &[[f64; 2]]) {
        let m = evidence.parts.len();
        for (i, [lower, upper]) in boxes.iter().enumerate() {
            self.qp.set_bounds(i, *lower, *upper);
        }
        let (size, stride) = (m + MOTION, self.qp.stride());
        let n = evidence.used.len() as f64;
        self.qp.set_hessian(|q| {
            q.fill(0.0);
            for (i, column) in evidence.gram.chunks_exact(m.max(1)).enumerate() {
                q[i * stride..i * stride + m].copy_from_slice(column);
                q[i * stride + i] += RIDGE;
                for axis in 0..3 {
                    let value = -evidence.displacement_sums[i][axis];
                    let k = m + 3 + axis;
                    q[i * stride + k] = value;
                    q[k * stride + i] = value;
                }
            }
            for k in m + 3..size {
                q[k * stride + k] = n + RIDGE;
            }
        });
    }

    /// Solves for `x` and `motion`, both warm. `positions` are the aligned markers, overwritten by the stabilized ones.
    pub fn solve(
        &mut self,
        model: &MarkerModel,
        evidence: &Evidence,
        aligned: &[Vector3<f64>],
        stabilized: &mut [Vector3<f64>],
        motion: &mut Stabilizer,
        x: &mut [f64],
    ) -> Result<Report, BoxQpError> {
        let m = x.len();
        self.unknowns[..m].copy_from_slice(x);
        let mut report = None;
        for _ in 0..ROUNDS {
            for &j in &evidence.used {
                stabilized[j] = motion.apply(&aligned[j]);
            }
            let center = self.linearize(model, evidence, stabilized);
            self.unknowns[m..].fill(0.0);
            report = Some(self.qp.solve(&self.linear, &mut self.unknowns)?);
            let omega = Vector3::from_column_slice(&self.unknowns[m..m + 3]);
            let tau = Vector3::from_column_slice(&self.unknowns[m + 3..]);
            motion.advance(omega, tau, center);
            if omega.amax() < STILL && tau.amax() < STILL {
                break;
            }
        }
        x.copy_from_slice(&self.unknowns[..m]);
        report.ok_or(BoxQpError::Budget(ROUNDS))
    }

    /// Forms what depends on the motion: the right-hand side and the rotation's blocks. Returns the center c.
    fn linearize(
        &mut self,
        model: &MarkerModel,
        evidence: &Evidence,
        stabilized: &[Vector3<f64>],
    ) -> Vector3<f64> {
        let m = model.n_muscles();
        let n = evidence.used.len() as f64;
        let center = evidence
            .used
            .iter()
            .map(|&j| stabilized[j])
            .sum::<Vector3<f64>>()
            / n;
        self.linear.fill(0.0);
        for moment in &mut self.moments {
            moment.fill(0.0);
        }
        let (mut torque, mut force) = (Vector3::zeros(), Vector3::zeros());
        let (mut squares, mut scatter) = (0.0, Matrix3::zeros());
        for &j in &evidence.used {
            let arm = stabilized[j] - center;
            let error = stabilized[j] - model.rest[j];
            torque += arm.cross(&error);
            force += error;
            squares += arm.norm_squared();
            scatter += arm * arm.transpose();
            self.add_marker(model, j, &arm, &error);
        }
        let inertia = Matrix3::identity() * squares - scatter;
        for axis in 0..3 {
            self.linear[m + axis] = -torque[axis];
            self.linear[m + 3 + axis] = -force[axis];
        }
        self.set_rotation_blocks(&inertia);
        center
    }

    /// Writes what the rotation shares with the muscles and with itself.
    fn set_rotation_blocks(&mut self, inertia: &Matrix3<f64>) {
        let (stride, moments) = (self.qp.stride(), &self.moments);
        let m = moments[0].len();
        self.qp.set_hessian(|q| {
            for axis in 0..3 {
                let k = m + axis;
                for (i, value) in moments[axis].iter().enumerate() {
                    q[k * stride + i] = -value;
                    q[i * stride + k] = -value;
                }
                for other in 0..3 {
                    q[k * stride + m + other] = inertia[(axis, other)];
                }
                q[k * stride + k] += RIDGE;
            }
        });
    }

    /// Adds one marker's Dᵀe to the right-hand side and its arm × d to the moments.
    fn add_marker(
        &mut self,
        model: &MarkerModel,
        j: usize,
        arm: &Vector3<f64>,
        error: &Vector3<f64>,
    ) {
        let m = model.n_muscles();
        let (dx, dy, dz) = (model.row(j, 0), model.row(j, 1), model.row(j, 2));
        let [mx, my, mz] = &mut self.moments;
        let linear = &mut self.linear[..m];
        let (mx, my, mz) = (&mut mx[..m], &mut my[..m], &mut mz[..m]);
        for i in 0..m {
            linear[i] += dx[i] * error.x + dy[i] * error.y + dz[i] * error.z;
            mx[i] += arm.y * dz[i] - arm.z * dy[i];
            my[i] += arm.z * dx[i] - arm.x * dz[i];
            mz[i] += arm.x * dy[i] - arm.y * dx[i];
        }
    }
}
