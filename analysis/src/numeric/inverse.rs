//! The inverse of a small symmetric positive definite matrix, in buffers that are kept between calls.
//!
//! A = L D Lᵀ, A⁻¹ = L⁻ᵀ D⁻¹ L⁻¹: half the work of a general inverse, no square roots, every inner loop over whole lanes.
//! Sums have a fixed order: the result does not depend on the processor's instruction set.

use super::{
    factor::{Factor, NotPositiveDefinite},
    lanes::{padded, subtract_multiple},
};

/// Inverts matrices of up to `capacity` rows.
#[derive(Clone, Debug)]
pub struct SymmetricInverse {
    factor: Factor,
    /// 0, 1, 2, ...: all rows of a matrix.
    all: Vec<usize>,
    /// Distance of the rows below.
    stride: usize,
    /// L⁻¹ by rows, 0 beyond its diagonal.
    lower: Vec<f64>,
    /// The lower triangle of the inverse.
    product: Vec<f64>,
}

impl SymmetricInverse {
    /// Buffers for matrices of up to `capacity` rows.
    pub fn with_capacity(capacity: usize) -> Self {
        let stride = padded(capacity);
        Self {
            factor: Factor::with_capacity(capacity),
            all: (0..capacity).collect(),
            stride,
            lower: vec![0.0; capacity * stride],
            product: vec![0.0; capacity * stride],
        }
    }

    /// Replaces the symmetric n × n `matrix`, rows `stride` apart, by its inverse. Only the lower triangle is read; both are
    /// written.
    ///
    /// # Errors
    ///
    /// When a pivot is not positive; `matrix` is then what it was.
    pub fn invert(
        &mut self,
        matrix: &mut [f64],
        n: usize,
        stride: usize,
    ) -> Result<(), NotPositiveDefinite> {
        self.factor.factor(matrix, stride, &self.all[..n], 0)?;
        self.invert_factor(n);
        self.multiply(n);
        for i in 0..n {
            for (j, value) in self.product[i * self.stride..][..=i].iter().enumerate() {
                matrix[i * stride + j] = *value;
                matrix[j * stride + i] = *value;
            }
        }
        Ok(())
    }

    /// Row i of L⁻¹ is eᵢ less the rows before it, as L says.
    fn invert_factor(&mut self, n: usize) {
        for i in 0..n {
            let row = &mut self.lower[i * self.stride..][..padded(i + 1)];
            row.fill(0.0);
            row[i] = 1.0;
        }
        for k in 0..n {
            let (done, below) = self.lower.split_at_mut((k + 1) * self.stride);
            let lanes = ..padded(k + 1);
            let row = &done[k * self.stride..][lanes];
            let below = below.chunks_exact_mut(self.stride).take(n - k - 1);
            for (i, other) in (k + 1..).zip(below) {
                subtract_multiple(&mut other[lanes], self.factor.lower(i, k), row);
            }
        }
    }

    /// The lower triangle of Σ rₖᵀ rₖ / dₖ over the rows of L⁻¹.
    fn multiply(&mut self, n: usize) {
        self.product[..n * self.stride].fill(0.0);
        let rows = self.lower.chunks_exact(self.stride.max(1));
        for (k, (row, inverse)) in rows.zip(self.factor.inverse_diagonal()).enumerate() {
            let products = self.product.chunks_exact_mut(self.stride).take(k + 1);
            for (i, product) in products.enumerate() {
                let lanes = ..padded(i + 1);
                subtract_multiple(&mut product[lanes], -inverse * row[i], &row[lanes]);
            }
        }
    }
}

/// Copies the lower triangle of an n × n matrix, rows `stride` apart, to the upper one.
pub fn mirror(matrix: &mut [f64], n: usize, stride: usize) {
    for i in 1..n {
        let (above, row) = matrix.split_at_mut(i * stride);
        for (j, value) in row[..i].iter().enumerate() {
            above[j * stride + i] = *value;
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt as _, SeedableRng as _};
    use rand_pcg::Pcg64;

    use super::*;

    #[test]
    fn a_matrix_times_its_inverse_is_the_identity() {
        let mut rng = Pcg64::seed_from_u64(8);
        let mut inverse = SymmetricInverse::with_capacity(58);
        for n in [58_usize, 1, 2, 5, 16, 22] {
            let stride = n.next_multiple_of(4);
            let a = nalgebra::DMatrix::from_fn(n, n, |_, _| rng.random_range(-1.0..1.0));
            let a = a.tr_mul(&a) + nalgebra::DMatrix::identity(n, n) * 0.01;
            let mut matrix = vec![0.0; n * stride];
            for (to, from) in matrix.chunks_exact_mut(stride).zip(a.column_iter()) {
                to[..n].copy_from_slice(from.as_slice());
            }
            inverse.invert(&mut matrix, n, stride).unwrap();
            let found = nalgebra::DMatrix::from_fn(n, n, |i, j| matrix[i * stride + j]);
            let error = (&a * &found - nalgebra::DMatrix::identity(n, n)).amax();
            assert!(error < 1e-10, "n {n}: {error:e}");
            assert!((&found - found.transpose()).amax() <= 0.0);
        }
    }

    #[test]
    fn an_indefinite_or_undefined_matrix_is_refused_and_left_alone() {
        let mut inverse = SymmetricInverse::with_capacity(2);
        let mut matrix = [1.0, 2.0, 2.0, 1.0];
        assert!(inverse.invert(&mut matrix, 2, 2).is_err());
        let before = [1.0, 2.0, 2.0, 1.0_f64];
        assert_eq!(matrix.map(f64::to_bits), before.map(f64::to_bits));
        assert!(
            inverse
                .invert(&mut [f64::NAN, 0.0, 0.0, 1.0], 2, 2)
                .is_err()
        );
    }
}
