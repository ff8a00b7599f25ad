//! Box QPs whose Q stays while c changes, solved by exchanges from the minimum without bounds.
//!
//! Let z be −x of an unknown that is free, and the multiplier g = Qx − c of one that is bound.
//! With all of them free, z = Tc with T = −Q⁻¹.
//! To exchange unknown k is to move z along column k of T as far as z's entry k must go: to −(the bound) when k is bound, to
//! 0 when it is freed. The entry is then the other of the two, and T is swept: T' = T − eeᵀ/p − 2s·1ₖ1ₖᵀ, where p is entry k
//! of the column, s its sign, and e the column less s·1ₖ.
//! T is never swept as a whole: an exchange computes the one column that it needs from the e and p of those before.
//! Each exchange takes the unknown that is wrong by most; that is close to the fewest exchanges there can be, and noise
//! makes relaxed muscles flicker so much that the frame before is no better place to start.
//! Starting from the same place always, a solution depends on Q, c and the box only, not on the frames before.

use std::fmt::Debug;

use super::{
    box_qp::Report,
    lanes::{add_multiple, larger, largest, smaller, width, with_width},
};

/// How far an unknown may be beyond its bound, or a multiplier (of a Q whose largest diagonal entry is 1 to 2) have the wrong
/// sign, in a solution.
const TOLERANCE: f64 = 1e-12;

/// The inverse of a Q whose largest diagonal entry is 1 to 2 is of no use where a diagonal entry of it is larger: what it says of
/// the active set then drowns in rounding errors.
const LARGEST_INVERSE: f64 = 1e9;

/// A solution with a larger KKT residual, relative to the largest diagonal entry of Q, is none.
const ACCEPTED_RESIDUAL: f64 = 1e-11;

/// Exchanges allowed for m unknowns: `EXCHANGES_FIXED + m + m / 4`. Hardly more than m are ever needed.
const EXCHANGES_FIXED: usize = 8;

/// The method for one width of lanes, behind one type.
pub(super) trait Exchanges: Debug + Send + Sync {
    /// Takes over Q, columns `stride` apart, and inverts it; false when the inverse would be of no use.
    fn set_hessian(&mut self, stride: usize, hessian: &[f64]) -> bool;
    /// The interval of one unknown, from the next start on; `lower < upper`.
    fn set_bounds(&mut self, unknown: usize, lower: f64, upper: f64);
    /// Starts from the minimum without bounds. `c` has the length that [`padded`] gives.
    fn start(&mut self, c: &[f64]);
    /// Makes one exchange; says whether there was one to make.
    fn advance(&mut self) -> bool;
    /// Ends; `None` when what was found is not a solution to the tolerance.
    fn finish(&mut self) -> Option<Report>;
    /// Copies the solution.
    fn read(&self, x: &mut [f64]);
    fn boxed_clone(&self) -> Box<dyn Exchanges>;
}

impl Clone for Box<dyn Exchanges> {
    fn clone(&self) -> Self {
        self.boxed_clone()
    }
}

/// The length of c for `m` unknowns; what is beyond m is 0.
pub(super) fn padded(m: usize) -> usize {
    m.next_multiple_of(width(m))
}

/// The method for `m` unknowns, 0 ≤ x ≤ 1, without a Q yet. It keeps about 3.3 m² numbers.
pub(super) fn exchanges(m: usize) -> Box<dyn Exchanges> {
    with_width!(width(m), W => Box::new(Pivots::<W>::new(m)) as Box<dyn Exchanges>)
}

/// W unknowns side by side. Those beyond m are bound at 0 and violate nothing.
#[derive(Clone, Copy, Debug)]
struct Lanes<const W: usize> {
    lower: [f64; W],
    upper: [f64; W],
    c: [f64; W],
    x: [f64; W],
    z: [f64; W],
    /// Between `least` and `most`, z violates nothing.
    least: [f64; W],
    most: [f64; W],
    /// By how much it does.
    excess: [f64; W],
    /// 1 where free, else 0.
    free: [f64; W],
    /// The bound where bound, 0 where free.
    bound: [f64; W],
    /// The sum of 2s over the exchanges of an unknown.
    turns: [f64; W],
}

#[derive(Clone, Debug)]
struct Pivots<const W: usize> {
    m: usize,
    /// A power of 2 that makes the largest diagonal entry of Q 1 to 2: scaling by it is exact.
    scale: f64,
    /// Relative to this the residual is told.
    largest_diagonal: f64,
    /// Columns of Q, one group of lanes after the other.
    hessian: Vec<[f64; W]>,
    /// T with all unknowns free: columns of −(scale · Q)⁻¹.
    tableau: Vec<[f64; W]>,
    groups: Vec<Lanes<W>>,
    /// The rows of the unit matrix: to subtract in one place is to subtract one of them, without leaving the vector registers.
    unit: [[f64; W]; W],
    /// e of each exchange, the first group of lanes of all of them, then the next.
    columns: Vec<[f64; W]>,
    /// 1/p of each.
    reciprocals: Vec<f64>,
    /// By how much of each e the next column differs from that of T with all unknowns free.
    shares: Vec<f64>,
    n_exchanges: usize,
}

impl<const W: usize> Pivots<W> {
    fn new(m: usize) -> Self {
        let n_groups = m.div_ceil(W);
        let limit = EXCHANGES_FIXED + m + m / 4;
        let mut pivots = Self {
            m,
            scale: 1.0,
            largest_diagonal: 1.0,
            hessian: vec![[0.0; W]; m * n_groups],
            tableau: vec![[0.0; W]; m * n_groups],
            groups: vec![Lanes::EMPTY; n_groups],
            unit: std::array::from_fn(|i| std::array::from_fn(|k| f64::from(u8::from(i == k)))),
            columns: vec![[0.0; W]; limit * n_groups],
            reciprocals: vec![0.0; limit],
            shares: vec![0.0; limit],
            n_exchanges: 0,
        };
        for unknown in 0..m {
            pivots.set_bounds(unknown, 0.0, 1.0);
        }
        pivots
    }

    /// Sweeps T = scale · Q by every unknown: T = −(scale · Q)⁻¹. False when Q is not positive definite.
    fn invert(&mut self) -> bool {
        let n_groups = self.groups.len();
        let stride = W * n_groups;
        self.tableau.clone_from(&self.hessian);
        let t = self.tableau.as_flattened_mut();
        for entry in t.iter_mut() {
            *entry *= self.scale;
        }
        for k in 0..self.m {
            let e = &mut self.columns[..n_groups];
            e.as_flattened_mut()
                .copy_from_slice(&t[k * stride..(k + 1) * stride]);
            let e = e.as_flattened_mut();
            let pivot = e[k];
            if pivot.is_nan() || pivot <= 0.0 {
                return false;
            }
            e[k] -= 1.0;
            for (column, &share) in t.chunks_exact_mut(stride).zip(e.iter()) {
                let share = share / pivot;
                for (entry, e) in column.iter_mut().zip(e.iter()) {
                    *entry -= share * e;
                }
            }
            t[k * stride + k] -= 2.0;
        }
        make_symmetric(self.m, stride, t);
        true
    }

    /// Exchanges the unknown that is wrong by most. Alone in its group (`ONE`), all loops over groups vanish.
    fn advance_in<const ONE: bool>(&mut self) -> bool {
        let n_groups = if ONE { 1 } else { self.groups.len() };
        let groups = &mut self.groups[..n_groups];
        let (excess, unknown) = worst(groups);
        let (done, limit) = (self.n_exchanges, self.shares.len());
        if excess <= TOLERANCE || unknown >= self.m || done >= limit {
            return false;
        }
        let (group, lane) = (unknown / W, unknown % W);
        let lanes = &mut groups[group];
        let z = lanes.z[lane];
        let (target, shift) = lanes.turn(lane);

        let from = &self.tableau[unknown * n_groups..][..n_groups];
        let mut pivot = from[group][lane];
        let before = &self.columns[group * limit..][..done];
        for ((share, e), inverse) in self.shares.iter_mut().zip(before).zip(&self.reciprocals) {
            *share = -e[lane] * inverse;
            pivot += *share * e[lane];
        }
        let turns = &mut lanes.turns[lane];
        pivot -= *turns;
        let sign = 1.0_f64.copysign(pivot);
        let correction = sign + *turns;
        *turns += 2.0 * sign;

        let length = (target - z) / pivot;
        for (index, (lanes, from)) in groups.iter_mut().zip(from).enumerate() {
            let columns = &mut self.columns[index * limit..][..=done];
            let mut e = *from;
            for (column, share) in columns.iter().zip(&self.shares[..done]) {
                add_multiple(&mut e, *share, column);
            }
            if index == group {
                add_multiple(&mut e, -correction, &self.unit[lane]);
            }
            add_multiple(&mut lanes.z, length, &e);
            columns[done] = e;
        }
        if shift != 0.0 {
            groups[group].z[lane] += shift;
        }
        self.reciprocals[done] = pivot.recip();
        self.n_exchanges += 1;
        true
    }

    /// Largest violation of the Karush-Kuhn-Tucker conditions by x, from the gradient itself; and whether it is a number.
    fn violation_in<const ONE: bool>(&self) -> (f64, bool) {
        let n_groups = if ONE { 1 } else { self.groups.len() };
        let groups = &self.groups[..n_groups];
        let limit = ACCEPTED_RESIDUAL * self.largest_diagonal;
        let (mut most, mut accepted) = ([0.0; W], true);
        for (index, lanes) in groups.iter().enumerate() {
            let mut gradient = lanes.c.map(|c| -c);
            for (columns, of) in self.hessian.chunks(W * n_groups).zip(groups) {
                for (column, x) in columns.chunks_exact(n_groups).zip(&of.x) {
                    add_multiple(&mut gradient, *x, &column[index]);
                }
            }
            let violation = lanes.violation(&gradient);
            for k in 0..W {
                most[k] = larger(violation[k], most[k]);
                // Not so where it is not a number.
                accepted &= violation[k] <= limit;
            }
        }
        (largest(most), accepted)
    }
}

impl<const W: usize> Exchanges for Pivots<W> {
    fn set_hessian(&mut self, stride: usize, hessian: &[f64]) -> bool {
        let columns = hessian.chunks_exact(stride.max(1));
        let groups = self.hessian.chunks_exact_mut(self.groups.len().max(1));
        for (to, from) in groups.zip(columns) {
            for (to, from) in to.as_flattened_mut().iter_mut().zip(&from[..self.m]) {
                *to = *from;
            }
        }
        let largest = largest_diagonal(self.m, stride, hessian);
        self.largest_diagonal = larger(largest, f64::MIN_POSITIVE);
        self.scale = power_of_two_below(self.largest_diagonal).recip();
        let inverse_stride = W * self.groups.len();
        // T is the negative of the inverse.
        self.invert()
            && self
                .tableau
                .as_flattened()
                .iter()
                .step_by(inverse_stride + 1)
                .take(self.m)
                .all(|it| -it <= LARGEST_INVERSE)
    }

    fn set_bounds(&mut self, unknown: usize, lower: f64, upper: f64) {
        let lanes = &mut self.groups[unknown / W];
        (lanes.lower[unknown % W], lanes.upper[unknown % W]) = (lower, upper);
    }

    fn start(&mut self, c: &[f64]) {
        let (c, _) = c.as_chunks::<W>();
        for (index, (lanes, c)) in self.groups.iter_mut().zip(c).enumerate() {
            lanes.free_all(c, self.m - index * W);
        }
        if let [lanes] = &mut self.groups[..] {
            let mut z = [0.0; W];
            for (column, c) in self.tableau.iter().zip(&lanes.c) {
                add_multiple(&mut z, self.scale * c, column);
            }
            lanes.z = z;
        } else {
            let columns = self.tableau.chunks_exact(self.groups.len());
            for (columns, c) in columns.zip(c.as_flattened()) {
                for (lanes, column) in self.groups.iter_mut().zip(columns) {
                    add_multiple(&mut lanes.z, self.scale * c, column);
                }
            }
        }
        self.n_exchanges = 0;
    }

    fn advance(&mut self) -> bool {
        match self.groups.len() {
            1 => self.advance_in::<true>(),
            _ => self.advance_in::<false>(),
        }
    }

    fn finish(&mut self) -> Option<Report> {
        for lanes in &mut self.groups {
            lanes.settle();
        }
        let (violation, accepted) = match self.groups.len() {
            1 => self.violation_in::<true>(),
            _ => self.violation_in::<false>(),
        };
        accepted.then(|| Report {
            steps: 1 + self.n_exchanges,
            kkt_residual: violation / self.largest_diagonal,
        })
    }

    fn read(&self, x: &mut [f64]) {
        for (x, lanes) in x.chunks_mut(W).zip(&self.groups) {
            for (x, from) in x.iter_mut().zip(&lanes.x) {
                *x = *from;
            }
        }
    }

    fn boxed_clone(&self) -> Box<dyn Exchanges> {
        Box::new(self.clone())
    }
}

impl<const W: usize> Lanes<W> {
    const EMPTY: Self = Self {
        lower: [0.0; W],
        upper: [0.0; W],
        c: [0.0; W],
        x: [0.0; W],
        z: [0.0; W],
        least: [0.0; W],
        most: [0.0; W],
        excess: [0.0; W],
        free: [0.0; W],
        bound: [0.0; W],
        turns: [0.0; W],
    };

    /// Frees the first `n` unknowns, or as many as there are.
    fn free_all(&mut self, c: &[f64; W], n: usize) {
        self.c = *c;
        for k in 0..W {
            (self.least[k], self.most[k]) = (-self.upper[k], -self.lower[k]);
            self.free[k] = f64::from(u8::from(k < n));
        }
        (self.z, self.bound, self.turns) = ([0.0; W], [0.0; W], [0.0; W]);
    }

    /// Binds a free unknown at the bound that it is beyond, or frees a bound one. Returns where z must go, and what is then
    /// to be added to become the other z.
    fn turn(&mut self, lane: usize) -> (f64, f64) {
        let (lower, upper) = (self.lower[lane], self.upper[lane]);
        if self.free[lane] > 0.0 {
            let (bound, least, most) = if self.z[lane] < self.least[lane] {
                (upper, f64::NEG_INFINITY, 0.0)
            } else {
                (lower, 0.0, f64::INFINITY)
            };
            (self.free[lane], self.bound[lane]) = (0.0, bound);
            (self.least[lane], self.most[lane]) = (least, most);
            (-bound, bound)
        } else {
            let bound = self.bound[lane];
            (self.free[lane], self.bound[lane]) = (1.0, 0.0);
            (self.least[lane], self.most[lane]) = (-upper, -lower);
            (0.0, -bound)
        }
    }

    /// Reads x off z.
    fn settle(&mut self) {
        for k in 0..W {
            let x = self.bound[k] - self.free[k] * self.z[k];
            self.x[k] = larger(self.lower[k], smaller(self.upper[k], x));
        }
    }

    /// How far each multiplier has the wrong sign, or is not 0 where the unknown is free.
    fn violation(&self, gradient: &[f64; W]) -> [f64; W] {
        std::array::from_fn(|k| {
            let (g, free) = (gradient[k], self.free[k]);
            let bound = larger(self.least[k] - g, g - self.most[k]);
            larger((1.0 - free) * bound, free * g.abs())
        })
    }
}

/// By how much the most wrong unknown is so, and which one it is.
#[expect(
    clippy::inline_always,
    reason = "the number of groups is a constant where it is called"
)]
#[inline(always)]
fn worst<const W: usize>(groups: &mut [Lanes<W>]) -> (f64, usize) {
    let mut most = [0.0; W];
    for lanes in groups.iter_mut() {
        for (k, most) in most.iter_mut().enumerate() {
            let z = lanes.z[k];
            lanes.excess[k] = larger(lanes.least[k] - z, z - lanes.most[k]);
            *most = larger(lanes.excess[k], *most);
        }
    }
    let worst = largest(most);
    let mut unknown = 0;
    for (index, lanes) in groups.iter().enumerate() {
        for (k, &excess) in lanes.excess.iter().enumerate() {
            if excess >= worst {
                unknown = index * W + k;
            }
        }
    }
    (worst, unknown)
}

/// Puts the mean of the two in the place of every entry and the one across the diagonal.
fn make_symmetric(m: usize, stride: usize, matrix: &mut [f64]) {
    for i in 0..m {
        for j in 0..i {
            let mean = f64::midpoint(matrix[i * stride + j], matrix[j * stride + i]);
            matrix[i * stride + j] = mean;
            matrix[j * stride + i] = mean;
        }
    }
}

fn largest_diagonal(m: usize, stride: usize, matrix: &[f64]) -> f64 {
    let diagonal = matrix.iter().step_by(stride + 1).take(m);
    diagonal.fold(0.0, |most, &it| larger(it, most))
}

/// The largest power of 2 that is not above a positive normal number; 1 for others.
fn power_of_two_below(number: f64) -> f64 {
    const FRACTION: u64 = (1 << 52) - 1;
    if number.is_normal() && number > 0.0 {
        f64::from_bits(number.to_bits() & !FRACTION)
    } else {
        1.0
    }
}
