//! Cholesky factor of a principal submatrix, A = L Lᵀ, in buffers that are kept between calls.
//!
//! Sized for the box QP: up to some sixty unknowns, factored once and solved often.
//! Every inner loop runs over contiguous memory, so that the compiler vectorizes it without reordering sums:
//! the result does not depend on the processor's instruction set.

/// A lower triangular factor of at most `capacity` rows.
#[derive(Clone, Debug)]
pub struct Cholesky {
    capacity: usize,
    n: usize,
    /// Column-major L: column j starts at `j * capacity`.
    columns: Vec<f64>,
    /// Row-major L: row i starts at `i * capacity`.
    rows: Vec<f64>,
    inverse_diagonal: Vec<f64>,
}

/// The matrix is not positive definite in floating point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is not positive definite at pivot {pivot}")]
pub struct NotPositiveDefinite {
    /// Position of the failing pivot in the submatrix.
    pub pivot: usize,
}

impl Cholesky {
    /// Buffers for matrices of up to `capacity` rows.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            capacity,
            n: 0,
            columns: vec![0.0; capacity * capacity],
            rows: vec![0.0; capacity * capacity],
            inverse_diagonal: vec![0.0; capacity],
        }
    }

    /// Factors the rows and columns `indices` of the symmetric `matrix`, whose columns are `stride` apart.
    ///
    /// # Errors
    ///
    /// When a pivot is not positive; the factor is then unusable.
    pub fn factor(
        &mut self,
        matrix: &[f64],
        stride: usize,
        indices: &[usize],
    ) -> Result<(), NotPositiveDefinite> {
        self.gather(matrix, stride, indices);
        for j in 0..self.n {
            self.eliminate(j)?;
        }
        self.transpose();
        Ok(())
    }

    /// Copies the lower triangle of the submatrix into `columns`.
    fn gather(&mut self, matrix: &[f64], stride: usize, indices: &[usize]) {
        self.n = indices.len();
        for (j, &source) in indices.iter().enumerate() {
            let from = &matrix[source * stride..(source + 1) * stride];
            let column = &mut self.columns[j * self.capacity..j * self.capacity + self.n];
            for (entry, &i) in column.iter_mut().zip(indices).skip(j) {
                *entry = from[i];
            }
        }
    }

    /// Scales column j and takes its share out of every later one.
    fn eliminate(&mut self, j: usize) -> Result<(), NotPositiveDefinite> {
        let (n, capacity) = (self.n, self.capacity);
        let (done, rest) = self.columns.split_at_mut((j + 1) * capacity);
        let column = &mut done[j * capacity + j..j * capacity + n];
        let pivot = column[0];
        if pivot.is_nan() || pivot <= 0.0 {
            return Err(NotPositiveDefinite { pivot: j });
        }
        let inverse = 1.0 / pivot.sqrt();
        for entry in column.iter_mut() {
            *entry *= inverse;
        }
        self.inverse_diagonal[j] = inverse;
        for k in j + 1..n {
            let share = column[k - j];
            let start = (k - j - 1) * capacity;
            let target = &mut rest[start + k..start + n];
            for (t, l) in target.iter_mut().zip(&column[k - j..]) {
                *t -= share * l;
            }
        }
        Ok(())
    }

    fn transpose(&mut self) {
        for j in 0..self.n {
            for i in j..self.n {
                self.rows[i * self.capacity + j] = self.columns[j * self.capacity + i];
            }
        }
    }

    /// Solves L Lᵀ x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        let n = self.n;
        for j in 0..n {
            let y = b[j] * self.inverse_diagonal[j];
            b[j] = y;
            let column = &self.columns[j * self.capacity + j + 1..j * self.capacity + n];
            for (t, l) in b[j + 1..n].iter_mut().zip(column) {
                *t -= y * l;
            }
        }
        for j in (0..n).rev() {
            let x = b[j] * self.inverse_diagonal[j];
            b[j] = x;
            let row = &self.rows[j * self.capacity..j * self.capacity + j];
            for (t, l) in b[..j].iter_mut().zip(row) {
                *t -= x * l;
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
        let mut factor = Cholesky::with_capacity(3);
        factor.factor(&matrix, 3, &[0, 2]).unwrap();
        let mut b = [8.0, 7.0];
        factor.solve(&mut b);
        assert!((b[0] - 1.25).abs() < 1e-15 && (b[1] - 1.5).abs() < 1e-15);
    }

    #[test]
    fn an_indefinite_or_undefined_matrix_is_refused() {
        let mut factor = Cholesky::with_capacity(1);
        assert!(factor.factor(&[-1.0], 1, &[0]).is_err());
        assert!(factor.factor(&[f64::NAN], 1, &[0]).is_err());
    }
}
