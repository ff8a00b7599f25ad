//! The factor of a principal submatrix, A = L D Lᵀ, in buffers that are kept between calls.
//!
//! Sized for the box QP: a handful of free unknowns, up to some sixty, factored once and solved often.
//! No square roots, so that a row waits for one division only. What a pivot takes from the rows below it is taken at once, row by
//! row and in whole lanes: no sum waits for another, and short rows need no remainder. Sums have a fixed order: the result
//! does not depend on the processor's instruction set.

use super::{
    dot::dot,
    lanes::{LANES, padded, subtract_multiple, subtract_two},
};

/// U = L D by rows, unit lower triangular L times its diagonal, of at most `capacity` rows.
#[derive(Clone, Debug)]
pub struct Factor {
    n: usize,
    /// Distance of the rows.
    stride: usize,
    rows: Vec<f64>,
    inverse_diagonal: Vec<f64>,
    /// Two columns of U; entries above their diagonals are 0.
    columns: [Vec<f64>; 2],
    /// b by the diagonal, and what the rows below take of it.
    scaled: Vec<f64>,
    taken: Vec<f64>,
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
        let stride = padded(capacity);
        Self {
            n: 0,
            stride,
            rows: vec![0.0; capacity * stride],
            inverse_diagonal: vec![0.0; capacity],
            columns: [0, 1].map(|_| vec![0.0; stride]),
            scaled: vec![0.0; stride],
            taken: vec![0.0; stride],
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
            let from = &matrix[source * stride..(source + 1) * stride];
            let row = &mut self.rows[i * self.stride..][..=i];
            for (to, &index) in row.iter_mut().zip(indices) {
                *to = from[index];
            }
        }
        for k in (0..self.n).step_by(2) {
            self.eliminate_pair(k, kept)?;
        }
        Ok(())
    }

    /// Takes from the rows below `k`, except the first `kept`, what its pivot and the next one explain: two at a time, so that a
    /// row is read and written half as often.
    fn eliminate_pair(&mut self, k: usize, kept: usize) -> Result<(), NotPositiveDefinite> {
        self.take_pivot(k, kept)?;
        let next = k + 1;
        if next == self.n {
            return Ok(());
        }
        let first_lane = next / LANES * LANES;
        self.read_column(k, first_lane, 0);
        if next >= kept {
            let taken = self.columns[0][next] * self.inverse_diagonal[k] * self.columns[0][next];
            self.rows[next * self.stride + next] -= taken;
        }
        self.take_pivot(next, kept)?;
        for i in next + 1..self.n {
            // The entry below the second pivot, with what the first one takes of it.
            let entry = &mut self.rows[i * self.stride + next];
            if i >= kept {
                *entry -= self.columns[0][i] * self.inverse_diagonal[k] * self.columns[0][next];
            }
        }
        self.read_column(next, first_lane, 1);
        self.columns[0][next] = 0.0;
        let inverses = [self.inverse_diagonal[k], self.inverse_diagonal[next]];
        let [first, second] = &self.columns;
        for i in kept.max(next + 1)..self.n {
            let lanes = first_lane..padded(i + 1);
            let row = &mut self.rows[i * self.stride..][lanes.clone()];
            let factors = [first[i] * inverses[0], second[i] * inverses[1]];
            subtract_two(row, factors, [&first[lanes.clone()], &second[lanes]]);
        }
        Ok(())
    }

    fn take_pivot(&mut self, k: usize, kept: usize) -> Result<(), NotPositiveDefinite> {
        if k >= kept {
            let pivot = self.rows[k * self.stride + k];
            if pivot.is_nan() || pivot <= 0.0 {
                return Err(NotPositiveDefinite { pivot: k });
            }
            self.inverse_diagonal[k] = 1.0 / pivot;
        }
        Ok(())
    }

    /// Copies column `k` of U below its diagonal; what of the first lane is not below it is 0.
    fn read_column(&mut self, k: usize, first_lane: usize, buffer: usize) {
        let column = &mut self.columns[buffer];
        column[first_lane..=k.max(first_lane)].fill(0.0);
        let rows = self.rows.chunks_exact(self.stride.max(1)).take(self.n);
        for (to, row) in column.iter_mut().zip(rows).skip(k + 1) {
            *to = row[k];
        }
    }

    /// An entry of L below its diagonal.
    pub(super) fn lower(&self, i: usize, k: usize) -> f64 {
        self.rows[i * self.stride + k] * self.inverse_diagonal[k]
    }

    /// 1 / D by rows.
    pub(super) fn inverse_diagonal(&self) -> &[f64] {
        &self.inverse_diagonal[..self.n]
    }

    /// Solves L D Lᵀ x = b in place.
    pub fn solve(&mut self, b: &mut [f64]) {
        let n = self.n;
        // Forwards: z = D⁻¹ L⁻¹ b, from U's rows.
        let rows = self.rows.chunks_exact(self.stride.max(1));
        for (i, ((row, b), inverse)) in rows
            .zip(&*b)
            .zip(&self.inverse_diagonal)
            .enumerate()
            .take(n)
        {
            self.scaled[i] = (b - dot(&row[..i], &self.scaled[..i])) * inverse;
        }
        // Backwards: x = L⁻ᵀ z; row j of U holds what x_j takes from those before it.
        let lanes = ..padded(n);
        self.taken[lanes].fill(0.0);
        for j in (0..n).rev() {
            b[j] = self.scaled[j] - self.taken[j] * self.inverse_diagonal[j];
            let lanes = ..padded(j);
            let row = &self.rows[j * self.stride..][lanes];
            subtract_multiple(&mut self.taken[lanes], -b[j], row);
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
