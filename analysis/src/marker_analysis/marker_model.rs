//! The actor at the bound markers, laid out for the solver.
//!
//! Inside the solver, markers and muscles stand by region: upper, then lower, then (markers only) head-fixed, so that a
//! region is a contiguous range and every inner loop runs over contiguous memory.

use std::ops::Range;

use nalgebra::Vector3;

use crate::{
    face::{actor::Actor, basis::MarkerBasis, region::FaceRegion},
    marker_analysis::alignment::Alignment,
    numeric::projection::support,
};

#[derive(Clone, Debug)]
pub(super) struct MarkerModel {
    /// Actor's index of every bound marker, in the solver's order.
    pub markers: Vec<usize>,
    /// Actor's index of every muscle, in the solver's order.
    pub muscles: Vec<usize>,
    /// Own (not head-fixed) bound markers of each region.
    pub own_markers: [Range<usize>; 2],
    /// Muscles of each region.
    pub own_muscles: [Range<usize>; 2],
    /// Own markers that the actor has in each region, bound or not.
    pub expected: [usize; 2],
    /// Virtual markers of the neutral face, centimeters.
    pub rest: Vec<Vector3<f64>>,
    /// D by rows: entry `(3 * marker + axis) * n_muscles + muscle`, centimeters.
    pub rows: Vec<f64>,
    /// D by columns: entry `muscle * 3 * n_markers + 3 * marker + axis`, centimeters.
    pub columns: Vec<f64>,
    /// The muscles that move each marker: all others of its rows are 0.
    pub marker_support: Vec<Range<usize>>,
}

impl MarkerModel {
    pub fn new(actor: &Actor, alignment: &Alignment) -> Self {
        // A marker that was never seen in the neutral frames has no place of its own, and takes no part.
        let hand_marked = actor.virtual_markers();
        let places: Vec<_> = alignment
            .bindings
            .iter()
            .zip(hand_marked)
            .map(|(bound, hand_marked)| bound.unwrap_or(*hand_marked))
            .collect();
        let basis = MarkerBasis::at(actor, &places);
        let bound = |it: &usize| alignment.bindings[*it].is_some();
        let (markers, own_markers) = by_region(
            actor.markers().len(),
            |it| {
                let marker = &actor.markers()[it];
                (!marker.head_fixed).then_some(marker.region)
            },
            bound,
        );
        let set = actor.muscle_set().muscles();
        let (muscles, own_muscles) = by_region(set.len(), |it| Some(set[it].region), |_| true);
        let expected = FaceRegion::ALL.map(|region| {
            let own = |it: &&crate::face::marker::Marker| it.region == region && !it.head_fixed;
            actor.markers().iter().filter(own).count()
        });
        let rest: Vec<Vector3<f64>> = markers
            .iter()
            .map(|&it| basis.neutral[it].0.coords)
            .collect();
        let mut model = Self {
            rest,
            rows: vec![0.0; 3 * markers.len() * muscles.len()],
            columns: vec![0.0; 3 * markers.len() * muscles.len()],
            marker_support: Vec::new(),
            markers,
            muscles,
            own_markers,
            own_muscles,
            expected,
        };
        model.lay_out(&basis);
        model.find_marker_support();
        model
    }

    fn find_marker_support(&mut self) {
        self.marker_support = (0..self.n_markers())
            .map(|marker| self.muscles_that_move(marker))
            .collect();
    }

    fn muscles_that_move(&self, marker: usize) -> Range<usize> {
        let rows = [0, 1, 2].map(|axis| support(self.row(marker, axis)));
        let moved = || rows.iter().filter(|it| !it.is_empty());
        let start = moved().map(|it| it.start).min().unwrap_or(0);
        start..moved().map(|it| it.end).max().unwrap_or(start)
    }

    fn lay_out(&mut self, basis: &MarkerBasis) {
        let (n, m) = (self.markers.len(), self.muscles.len());
        for (j, &marker) in self.markers.iter().enumerate() {
            let displacements = basis.of_marker_cm(marker);
            for (i, &muscle) in self.muscles.iter().enumerate() {
                for (axis, &value) in displacements[muscle].iter().enumerate() {
                    self.rows[(3 * j + axis) * m + i] = value;
                    self.columns[i * 3 * n + 3 * j + axis] = value;
                }
            }
        }
    }

    pub fn n_markers(&self) -> usize {
        self.markers.len()
    }

    pub fn n_muscles(&self) -> usize {
        self.muscles.len()
    }

    /// Row of D for one coordinate of one marker, over all muscles.
    pub fn row(&self, marker: usize, axis: usize) -> &[f64] {
        let m = self.n_muscles();
        &self.rows[(3 * marker + axis) * m..][..m]
    }

    /// Column of D for one muscle, over all coordinates of all markers.
    pub fn column(&self, muscle: usize) -> &[f64] {
        let rows = 3 * self.n_markers();
        &self.columns[muscle * rows..][..rows]
    }

    /// dᵢⱼ, centimeters.
    pub fn displacement(&self, muscle: usize, marker: usize) -> Vector3<f64> {
        let column = self.column(muscle);
        Vector3::new(
            column[3 * marker],
            column[3 * marker + 1],
            column[3 * marker + 2],
        )
    }

    /// The same face with every marker moved by the muscles of its own region only.
    pub fn with_regions_apart(&self) -> Self {
        let mut apart = self.clone();
        let (n, m) = (self.n_markers(), self.n_muscles());
        let own =
            |it: &[Range<usize>; 2], index: usize| it.iter().position(|it| it.contains(&index));
        for j in 0..n {
            for i in 0..m {
                if own(&self.own_markers, j) != own(&self.own_muscles, i) {
                    for axis in 0..3 {
                        apart.rows[(3 * j + axis) * m + i] = 0.0;
                        apart.columns[i * 3 * n + 3 * j + axis] = 0.0;
                    }
                }
            }
        }
        apart.find_marker_support();
        apart
    }

    /// Adds `change` times one marker's `DⱼᵀDⱼ` to `gram`, whose columns are `stride` apart.
    pub fn change_gram(&self, gram: &mut [f64], stride: usize, j: usize, change: f64) {
        let support = self.marker_support[j].clone();
        for axis in 0..3 {
            let row = &self.row(j, axis)[support.clone()];
            for (i, d) in support.clone().zip(row) {
                let column = &mut gram[i * stride..][support.clone()];
                let factor = change * d;
                for (q, other) in column.iter_mut().zip(row) {
                    *q += factor * other;
                }
            }
        }
    }

    /// Mobility of a marker: √Σᵢ |dᵢⱼ|², centimeters.
    pub fn mobility(&self, marker: usize) -> f64 {
        let squared: f64 = (0..3)
            .flat_map(|axis| self.row(marker, axis))
            .map(|it| it * it)
            .sum();
        squared.sqrt()
    }
}

/// The kept items sorted by region (`None` last), with the range of each region.
fn by_region(
    n: usize,
    region: impl Fn(usize) -> Option<FaceRegion>,
    keep: impl Fn(&usize) -> bool,
) -> (Vec<usize>, [Range<usize>; 2]) {
    let of = |wanted| {
        (0..n)
            .filter(|it| region(*it) == wanted && keep(it))
            .collect::<Vec<_>>()
    };
    let [upper, lower, rest] = [Some(FaceRegion::Upper), Some(FaceRegion::Lower), None].map(of);
    let split = upper.len();
    let end = split + lower.len();
    let order = [upper, lower, rest].concat();
    (order, [0..split, split..end])
}
