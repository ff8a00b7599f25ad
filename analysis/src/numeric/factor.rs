//! The factor of a principal submatrix, A = L D Lᵀ, in buffers that are kept between calls.
//!
//! Sized for the box QP: a handful of free unknowns, up to some sixty, factored once and solved often.
//! No square roots, so that a row waits for one division only. Rows are contiguous, and sums have a fixed order: the result
//! does not depend on the processor's instruction set.

use super::dot::dot;

/// A unit lower triangular factor and its diagonal, of at most `capacity` rows.
#[derive(Clone, Debug)]
pub struct Factor {
    n: usize,
    capacity: usize,
    /// Row-major L, its unit diagonal left out: row i starts at `i * capacity`.
    rows: Vec<f64>,
    inverse_diagonal: Vec<f64>,
    /// One row of L D.
    scaled: Vec<f64>,
}

/// The matrix is not positive definite in floating point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is not positive definite at pivot {pivot}")]
pub struct NotPositiveDefinite {
    /// Position of the failing pivot in the submatrix.
    pub pivot: usize,
}

impl Factor {
    /// Buffers for matrices of up to `capacity` rows.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            n: 0,
            capacity,
            rows: vec![0.0; capacity * capacity],
            inverse_diagonal: vec![0.0; capacity],
            scaled: vec![0.0; capacity],
        }
    }

    /// Factors the rows and columns `indices` of the symmetric `matrix`, whose columns are `stride` apart.
    ///
    /// The first `kept` rows are known to be what they were in the last call: a row depends on those before it only.
    ///
    /// # Errors
    ///
    /// When a pivot is not positive; the factor is then unusable.
    pub fn factor(
        &mut self,
        matrix: &[f64],
        stride: usize,
        indices: &[usize],
        kept: usize,
    ) -> Result<(), NotPositiveDefinite> {
        self.n = indices.len();
        for (i, &source) in indices.iter().enumerate().skip(kept) {
            let column = &matrix[source * stride..(source + 1) * stride];
            let (done, row) = self.rows.split_at_mut(i * self.capacity);
            let (row, scaled) = (&mut row[..i], &mut self.scaled[..i]);
            let above = done.chunks_exact(self.capacity).zip(&self.inverse_diagonal);
            for (j, ((above, inverse), &index)) in above.zip(indices).enumerate() {
                let entry = column[index] - dot(&scaled[..j], &above[..j]);
                scaled[j] = entry;
                row[j] = entry * inverse;
            }
            let pivot = column[source] - dot(scaled, row);
            if pivot.is_nan() || pivot <= 0.0 {
                return Err(NotPositiveDefinite { pivot: i });
            }
            self.inverse_diagonal[i] = 1.0 / pivot;
        }
        Ok(())
    }

    /// Solves L D Lᵀ x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        let b = &mut b[..self.n];
        let rows = || {
            self.rows
                .chunks_exact(self.capacity.max(1))
                .take(self.n)
                .enumerate()
        };
        for (i, row) in rows() {
            b[i] -= dot(&row[..i], &b[..i]);
        }
        for (it, inverse) in b.iter_mut().zip(&self.inverse_diagonal) {
            *it *= inverse;
        }
        for (i, row) in rows().rev() {
            let (before, x) = b.split_at_mut(i);
            for (t, l) in before.iter_mut().zip(row) {
                *t -= x[0] * l;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_principal_submatrix() {
        // Rows 0 and 2 form [[4, 2], [2, 3]].
        let matrix = [4.0, 9.0, 2.0, 9.0, 7.0, 9.0, 2.0, 9.0, 3.0];
        let mut factor = Factor::with_capacity(3);
        factor.factor(&matrix, 3, &[0, 2], 0).unwrap();
        let mut b = [8.0, 7.0];
        factor.solve(&mut b);
        assert!((b[0] - 1.25).abs() < 1e-15 && (b[1] - 1.5).abs() < 1e-15);
    }

    #[test]
    fn rows_that_are_kept_give_the_same_bits() {
        let matrix = [4.0, 1.0, 2.0, 1.0, 7.0, 3.0, 2.0, 3.0, 5.0];
        let mut grown = Factor::with_capacity(3);
        grown.factor(&matrix, 3, &[0, 1], 0).unwrap();
        grown.factor(&matrix, 3, &[0, 2], 1).unwrap();
        let mut fresh = Factor::with_capacity(3);
        fresh.factor(&matrix, 3, &[0, 2], 0).unwrap();
        let [mut a, mut b] = [[1.0, 2.0]; 2];
        grown.solve(&mut a);
        fresh.solve(&mut b);
        assert_eq!(a.map(f64::to_bits), b.map(f64::to_bits));
    }

    #[test]
    fn an_indefinite_or_undefined_matrix_is_refused() {
        let mut factor = Factor::with_capacity(1);
        assert!(factor.factor(&[-1.0], 1, &[0], 0).is_err());
        assert!(factor.factor(&[f64::NAN], 1, &[0], 0).is_err());
    }
}
