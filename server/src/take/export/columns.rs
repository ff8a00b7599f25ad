//! The columns of markers: those of all publishers of a take, by name, in one unit.

use frontalis_analysis::{face::actor::MAX_MARKERS, space::LengthUnit};
use frontalis_proto::v1::{MarkerFrame, TakeHeader, TakeSource};

use super::ExportError;
use crate::wire::common;

/// Marker names in the order in which they were first declared; unit and rate are the first publisher's.
#[derive(Clone, Debug, Default)]
pub(super) struct Columns {
    names: Vec<String>,
    declared: Option<(LengthUnit, f64)>,
}

/// How the coordinates of one publisher come into the columns.
#[derive(Clone, Debug)]
pub(super) struct Places {
    /// Column of each of its markers.
    columns: Vec<usize>,
    n_columns: usize,
    units: (LengthUnit, LengthUnit),
}

impl Columns {
    pub(super) fn add(
        &mut self,
        source: &TakeSource,
        header: Option<&TakeHeader>,
    ) -> Result<(), ExportError> {
        for name in names(source, header) {
            if !self.names.contains(name) {
                self.names.push(name.clone());
            }
        }
        let found = self.names.len();
        if found > MAX_MARKERS {
            let limit = MAX_MARKERS;
            return Err(ExportError::Markers { found, limit });
        }
        self.declared.get_or_insert((unit(source), source.rate_hz));
        Ok(())
    }

    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// Centimeters without a publisher.
    pub(super) fn unit(&self) -> LengthUnit {
        self.declared.map_or(LengthUnit::Centimeter, |it| it.0)
    }

    /// Frames a second; `None` without a publisher.
    pub(super) fn rate_hz(&self) -> Option<f64> {
        self.declared.map(|it| it.1)
    }

    pub(super) fn places(&self, source: &TakeSource, header: Option<&TakeHeader>) -> Places {
        let column = |name| self.names.iter().position(|it| it == name);
        let columns = names(source, header).iter().filter_map(column);
        Places {
            columns: columns.collect(),
            n_columns: self.names.len(),
            units: (unit(source), self.unit()),
        }
    }
}

impl Places {
    /// One entry a column; NaN where a coordinate was not seen. In the same unit the bits stay as they came.
    pub(super) fn positions(&self, frame: &MarkerFrame) -> Vec<[f32; 3]> {
        let mut positions = vec![[f32::NAN; 3]; self.n_columns];
        let sent = frame.positions.chunks_exact(3);
        for (column, sent) in self.columns.iter().zip(sent) {
            positions[*column] = std::array::from_fn(|axis| self.converted(sent[axis]));
        }
        positions
    }

    fn converted(&self, coordinate: f32) -> f32 {
        let (from, to) = self.units;
        if from == to {
            return coordinate;
        }
        #[expect(clippy::cast_possible_truncation, reason = "formats hold f32")]
        let converted = (f64::from(coordinate) * from.centimeters() / to.centimeters()) as f32;
        converted
    }
}

/// A publisher that names none has the actor's.
fn names<'a>(source: &'a TakeSource, header: Option<&'a TakeHeader>) -> &'a [String] {
    match header {
        Some(header) if source.marker_names.is_empty() => &header.markers,
        _ => &source.marker_names,
    }
}

/// No frame is taken of a publisher without a unit.
fn unit(source: &TakeSource) -> LengthUnit {
    common::length_unit("unit", source.unit).unwrap_or(LengthUnit::Centimeter)
}
