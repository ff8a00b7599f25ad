//! The factor of a principal submatrix, A = L D Lᵀ, in buffers that are kept between calls.
//!
//! Sized for the box QP: up to some sixty unknowns, factored once and solved often.
//! No square roots, so that a column waits for one division only; inner loops run over contiguous blocks of [`LANES`], and
//! sums have a fixed order: the result does not depend on the processor's instruction set.

/// Columns are padded to a multiple of this, so that short loops have no remainder.
pub const LANES: usize = 4;

/// `y -= a * x` for lengths that are multiples of [`LANES`].
pub(super) fn subtract_multiple(y: &mut [f64], a: f64, x: &[f64]) {
    let (y, _) = y.as_chunks_mut::<LANES>();
    let (x, _) = x.as_chunks::<LANES>();
    for (y, x) in y.iter_mut().zip(x) {
        for (y, x) in y.iter_mut().zip(x) {
            *y -= a * x;
        }
    }
}

/// A unit lower triangular factor and its diagonal, of at most `capacity` rows.
#[derive(Clone, Debug)]
pub struct Factor {
    /// Distance of the columns: the capacity, padded.
    stride: usize,
    n: usize,
    /// Column-major L below its unit diagonal: column j starts at `j * stride`. Above the diagonal, anything.
    columns: Vec<f64>,
    inverse_diagonal: Vec<f64>,
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
        let stride = capacity.next_multiple_of(LANES);
        Self {
            stride,
            n: 0,
            columns: vec![0.0; capacity * stride],
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
        self.n = indices.len();
        for (j, &source) in indices.iter().enumerate() {
            let from = &matrix[source * stride..(source + 1) * stride];
            let column = &mut self.columns[j * self.stride + j..j * self.stride + self.n];
            for (entry, &i) in column.iter_mut().zip(&indices[j..]) {
                *entry = from[i];
            }
        }
        for j in 0..self.n {
            self.eliminate(j)?;
        }
        Ok(())
    }

    /// Takes column j's share out of every later one, and scales it by its pivot.
    fn eliminate(&mut self, j: usize) -> Result<(), NotPositiveDefinite> {
        let end = self.n.next_multiple_of(LANES);
        let (done, rest) = self.columns.split_at_mut((j + 1) * self.stride);
        let column = &mut done[j * self.stride..j * self.stride + end];
        let pivot = column[j];
        if pivot.is_nan() || pivot <= 0.0 {
            return Err(NotPositiveDefinite { pivot: j });
        }
        let inverse = 1.0 / pivot;
        self.inverse_diagonal[j] = inverse;
        let later = rest.chunks_exact_mut(self.stride).take(self.n - j - 1);
        for (k, later) in (j + 1..).zip(later) {
            let block = k - k % LANES;
            subtract_multiple(
                &mut later[block..end],
                column[k] * inverse,
                &column[block..],
            );
        }
        for entry in &mut column[j + 1..] {
            *entry *= inverse;
        }
        Ok(())
    }

    /// Solves L D Lᵀ x = b in place; `b` has room for the padding.
    pub fn solve(&self, b: &mut [f64]) {
        let n = self.n;
        let end = n.next_multiple_of(LANES);
        b[n..end].fill(0.0);
        for j in 0..n {
            let column = &self.columns[j * self.stride..j * self.stride + end];
            let y = b[j];
            // The block that holds the diagonal also holds entries above it: only those below count.
            let block = (j + 1).next_multiple_of(LANES).min(end);
            for i in j + 1..block {
                b[i] -= y * column[i];
            }
            subtract_multiple(&mut b[block..end], y, &column[block..]);
        }
        for (it, inverse) in b.iter_mut().zip(&self.inverse_diagonal).take(n) {
            *it *= inverse;
        }
        for j in (0..n).rev() {
            let column = &self.columns[j * self.stride..j * self.stride + n];
            b[j] -= dot(&column[j + 1..], &b[j + 1..n]);
        }
    }
}

/// Two sums side by side, so that an addition does not wait for the one before.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (mut even, mut odd) = (0.0, 0.0);
    let (pairs_a, pairs_b) = (a.chunks_exact(2), b.chunks_exact(2));
    let last = match (pairs_a.remainder(), pairs_b.remainder()) {
        ([a], [b]) => a * b,
        _ => 0.0,
    };
    for (a, b) in pairs_a.zip(pairs_b) {
        even += a[0] * b[0];
        odd += a[1] * b[1];
    }
    even + odd + last
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_principal_submatrix() {
        // Rows 0 and 2 form [[4, 2], [2, 3]].
        let matrix = [4.0, 9.0, 2.0, 9.0, 7.0, 9.0, 2.0, 9.0, 3.0];
        let mut factor = Factor::with_capacity(3);
        factor.factor(&matrix, 3, &[0, 2]).unwrap();
        let mut b = [8.0, 7.0, 0.0, 0.0];
        factor.solve(&mut b);
        assert!((b[0] - 1.25).abs() < 1e-15 && (b[1] - 1.5).abs() < 1e-15);
    }

    #[test]
    fn an_indefinite_or_undefined_matrix_is_refused() {
        let mut factor = Factor::with_capacity(1);
        assert!(factor.factor(&[-1.0], 1, &[0]).is_err());
        assert!(factor.factor(&[f64::NAN], 1, &[0]).is_err());
    }
}
