//! `c = Dᵀd` for a D that stays, laid out so that the sums of neighboring columns run side by side.

use std::ops::Range;

use super::lanes::{add_multiple, width, with_width};

/// The columns of D in groups, each group by rows.
#[derive(Clone, Debug)]
pub(crate) struct Projection {
    /// Columns of a group.
    width: usize,
    groups: Vec<Group>,
    /// The rows of group after group, `width` entries each.
    entries: Vec<f64>,
}

#[derive(Clone, Debug)]
struct Group {
    /// The rows of D outside of which the group's columns are 0.
    rows: Range<usize>,
    /// Where its first row stands among all rows of `entries`.
    start: usize,
}

impl Projection {
    /// Lays out the `columns` of D, all of them equally long.
    pub fn new<'a>(columns: impl ExactSizeIterator<Item = &'a [f64]>) -> Self {
        let width = width(columns.len());
        let columns: Vec<&[f64]> = columns.collect();
        let mut projection = Self {
            width,
            groups: Vec::new(),
            entries: Vec::new(),
        };
        for group in columns.chunks(width) {
            projection.add(group);
        }
        projection
    }

    fn add(&mut self, columns: &[&[f64]]) {
        let supports = columns.iter().map(|it| support(it));
        let filled = supports.filter(|it| !it.is_empty());
        let rows = filled
            .reduce(|a, b| a.start.min(b.start)..a.end.max(b.end))
            .unwrap_or(0..0);
        let start = self.entries.len() / self.width;
        for row in rows.clone() {
            let entries = columns.iter().map(|it| it[row]);
            self.entries.extend(entries);
            self.entries
                .resize(self.entries.len().next_multiple_of(self.width), 0.0);
        }
        self.groups.push(Group { rows, start });
    }

    /// Writes `c = Dᵀd`. `c` is as long as D has columns, made a multiple of [`width`]; what is beyond the last is set to 0.
    pub fn apply(&self, d: &[f64], c: &mut [f64]) {
        with_width!(self.width, W => self.apply_by::<W>(d, c));
    }

    fn apply_by<const W: usize>(&self, d: &[f64], c: &mut [f64]) {
        let (entries, _) = self.entries.as_chunks::<W>();
        let (c, _) = c.as_chunks_mut::<W>();
        for (group, c) in self.groups.iter().zip(c) {
            let d = &d[group.rows.clone()];
            let mut sums = [0.0; W];
            for (entries, &d) in entries[group.start..].iter().zip(d) {
                add_multiple(&mut sums, d, entries);
            }
            *c = sums;
        }
    }
}

/// From the first to the last entry that is not 0.
pub(crate) fn support(column: &[f64]) -> Range<usize> {
    let moves = |it: &f64| *it != 0.0;
    let start = column.iter().position(moves).unwrap_or(0);
    let end = column.iter().rposition(moves).map_or(0, |it| it + 1);
    start..end
}

#[cfg(test)]
mod tests {
    use rand::{RngExt as _, SeedableRng as _};
    use rand_pcg::Pcg64;

    use super::*;

    #[test]
    fn every_entry_is_the_product_with_its_column() {
        let mut rng = Pcg64::seed_from_u64(1);
        for (n_rows, n_columns) in [(1, 1), (9, 6), (33, 10), (48, 16), (50, 17), (90, 52)] {
            // Some entries are 0, whole columns too.
            let mut entry =
                |_| f64::from(u8::from(rng.random_bool(0.3))) * rng.random_range(-1.0..1.0);
            let mut columns: Vec<Vec<f64>> = (0..n_columns)
                .map(|_| (0..n_rows).map(&mut entry).collect())
                .collect();
            columns[n_columns / 2].fill(0.0);
            let d: Vec<f64> = (0..n_rows).map(&mut entry).collect();
            let projection = Projection::new(columns.iter().map(Vec::as_slice));
            let n_padded = n_columns.next_multiple_of(projection.width);
            let mut c = vec![f64::NAN; n_padded];
            projection.apply(&d, &mut c);
            columns.resize(n_padded, vec![0.0; n_rows]);
            for (c, column) in c.iter().zip(&columns) {
                let product: f64 = column.iter().zip(&d).map(|(a, b)| a * b).sum();
                assert!((c - product).abs() < 1e-13, "{n_columns}: {c} {product}");
            }
        }
    }
}
