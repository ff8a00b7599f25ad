//! What a solved box QP says about the unknowns' uncertainty, given which of them are at a bound.
//!
//! With the objective a negative log-likelihood in units of the noise's variance, the free unknowns have covariance `Q_FF⁻¹`.
//! An unknown at its bound has the variance that it would have if it alone were let go with them: the inverse of its Schur
//! complement `Qᵢᵢ − Qᵢ_F Q_FF⁻¹ Q_Fᵢ`.

use super::{dot::dot, factor::NotPositiveDefinite, inverse::SymmetricInverse};

/// Covariance on the free set, in buffers that are kept between calls.
#[derive(Clone, Debug)]
pub struct Posterior {
    capacity: usize,
    /// `Q_FF⁻¹` in the order of the free set, rows `capacity` apart.
    covariance: Vec<f64>,
    inverse: SymmetricInverse,
    /// `Q_Fᵢ` of one bound unknown.
    shared: Vec<f64>,
}

impl Posterior {
    /// For up to `capacity` unknowns.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            capacity,
            covariance: vec![0.0; capacity * capacity],
            inverse: SymmetricInverse::with_capacity(capacity),
            shared: vec![0.0; capacity],
        }
    }

    /// Finds the covariance of the unknowns `free` under `hessian`, symmetric, columns `stride` apart.
    ///
    /// # Errors
    ///
    /// When Q is not positive definite on them.
    pub fn find(
        &mut self,
        hessian: &[f64],
        stride: usize,
        free: &[usize],
    ) -> Result<(), NotPositiveDefinite> {
        for (row, &i) in self
            .covariance
            .chunks_exact_mut(self.capacity.max(1))
            .zip(free)
        {
            let source = &hessian[i * stride..];
            for (to, &j) in row.iter_mut().zip(free) {
                *to = source[j];
            }
        }
        self.inverse
            .invert(&mut self.covariance, free.len(), self.capacity)
    }

    /// Row `place` of the covariance, in the order of the free set that was given.
    pub fn row(&self, place: usize) -> &[f64] {
        &self.covariance[place * self.capacity..][..self.capacity]
    }

    /// Variance of the unknown at `place` of the free set.
    pub fn variance(&self, place: usize) -> f64 {
        self.covariance[place * self.capacity + place]
    }

    /// Variance of `unknown`, which is not in the free set that was given.
    pub fn variance_of_bound(
        &mut self,
        hessian: &[f64],
        stride: usize,
        free: &[usize],
        unknown: usize,
    ) -> f64 {
        let column = &hessian[unknown * stride..];
        for (to, &j) in self.shared.iter_mut().zip(free) {
            *to = column[j];
        }
        let shared = &self.shared[..free.len()];
        let rows = self.covariance.chunks_exact(self.capacity.max(1));
        let taken: f64 = rows
            .zip(shared)
            .map(|(row, h)| h * dot(&row[..shared.len()], shared))
            .sum();
        1.0 / (column[unknown] - taken).max(f64::MIN_POSITIVE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bound_unknown_has_the_variance_of_the_whole_when_all_others_are_free() {
        let q = nalgebra::Matrix3::new(4.0, 1.0, 0.5, 1.0, 3.0, -0.7, 0.5, -0.7, 2.0);
        let whole = q.try_inverse().unwrap();
        let mut posterior = Posterior::with_capacity(3);
        posterior.find(q.as_slice(), 3, &[0, 2]).unwrap();
        let variance = posterior.variance_of_bound(q.as_slice(), 3, &[0, 2], 1);
        assert!((variance - whole[(1, 1)]).abs() < 1e-14);
        posterior.find(q.as_slice(), 3, &[0, 1, 2]).unwrap();
        for i in 0..3 {
            assert!((posterior.variance(i) - whole[(i, i)]).abs() < 1e-14);
            assert!((posterior.row(i)[0] - whole[(i, 0)]).abs() < 1e-14);
        }
    }

    #[test]
    fn with_nothing_free_an_unknown_has_the_variance_that_the_others_leave_it() {
        let mut posterior = Posterior::with_capacity(2);
        posterior.find(&[4.0, 1.0, 1.0, 2.0], 2, &[]).unwrap();
        let variance = posterior.variance_of_bound(&[4.0, 1.0, 1.0, 2.0], 2, &[], 0);
        assert!((variance - 0.25).abs() < 1e-15);
    }
}
