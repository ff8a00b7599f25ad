//! The inverse of a small symmetric positive definite matrix, in buffers that are kept between calls.
//!
//! A = L D Lᵀ, A⁻¹ = L⁻ᵀ D⁻¹ L⁻¹: half the work of a general inverse, no square roots, every inner loop over contiguous rows.
//! Sums have a fixed order: the result does not depend on the processor's instruction set.

use super::{dot::dot, factor::NotPositiveDefinite};

/// Inverts matrices of up to `capacity` rows.
#[derive(Clone, Debug)]
pub struct SymmetricInverse {
    capacity: usize,
    /// Rows of L, `capacity` apart; the unit diagonal is left out.
    rows: Vec<f64>,
    inverse_rows: Vec<f64>,
    inverse_diagonal: Vec<f64>,
    /// One row of L D.
    scaled: Vec<f64>,
}

impl SymmetricInverse {
    /// Buffers for matrices of up to `capacity` rows.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            capacity,
            rows: vec![0.0; capacity * capacity],
            inverse_rows: vec![0.0; capacity * capacity],
            inverse_diagonal: vec![0.0; capacity],
            scaled: vec![0.0; capacity],
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
        self.factor(matrix, n, stride)?;
        self.invert_factor(n);
        self.multiply(matrix, n, stride);
        mirror(matrix, n, stride);
        Ok(())
    }

    fn factor(
        &mut self,
        matrix: &[f64],
        n: usize,
        stride: usize,
    ) -> Result<(), NotPositiveDefinite> {
        for i in 0..n {
            let source = &matrix[i * stride..][..=i];
            let (done, row) = self.rows.split_at_mut(i * self.capacity);
            let (row, scaled) = (&mut row[..i], &mut self.scaled[..i]);
            let above = done.chunks_exact(self.capacity).zip(&self.inverse_diagonal);
            for (j, (above, inverse)) in above.enumerate() {
                let entry = source[j] - dot(&scaled[..j], &above[..j]);
                scaled[j] = entry;
                row[j] = entry * inverse;
            }
            let pivot = source[i] - dot(scaled, row);
            if pivot.is_nan() || pivot <= 0.0 {
                return Err(NotPositiveDefinite { pivot: i });
            }
            self.inverse_diagonal[i] = 1.0 / pivot;
        }
        Ok(())
    }

    /// Row i of L⁻¹ is eᵢ less the rows before it, as L says.
    fn invert_factor(&mut self, n: usize) {
        for i in 0..n {
            let (done, row) = self.inverse_rows.split_at_mut(i * self.capacity);
            let row = &mut row[..=i];
            row.fill(0.0);
            row[i] = 1.0;
            for (k, above) in done.chunks_exact(self.capacity).enumerate() {
                subtract_multiple(row, self.rows[i * self.capacity + k], &above[..=k]);
            }
        }
    }

    /// The lower triangle of Σ rₖᵀ rₖ / dₖ over the rows of L⁻¹.
    fn multiply(&self, matrix: &mut [f64], n: usize, stride: usize) {
        for (i, row) in matrix.chunks_mut(stride).take(n).enumerate() {
            row[..=i].fill(0.0);
        }
        let rows = self.inverse_rows.chunks_exact(self.capacity.max(1));
        for (k, (row, inverse)) in rows.zip(&self.inverse_diagonal).take(n).enumerate() {
            for i in 0..=k {
                let factor = -inverse * row[i];
                subtract_multiple(&mut matrix[i * stride..], factor, &row[..=i]);
            }
        }
    }
}

fn subtract_multiple(y: &mut [f64], a: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y -= a * x;
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
