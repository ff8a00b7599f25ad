//! The five header lines: rate, unit, marker names, and which separator the file uses.

use super::{Line, Lines, TrcError, TrcProblem, start_timecode};
use crate::{face::actor::MAX_MARKERS, format::quoted, space::LengthUnit, timecode::Timecode};

/// Cells before the first coordinate: frame number and time.
pub(super) const LEADING_CELLS: usize = 2;

pub(super) struct Header {
    pub(super) separator: char,
    pub(super) rate_hz: f64,
    pub(super) unit: LengthUnit,
    pub(super) marker_names: Vec<String>,
    pub(super) start_timecode: Option<Timecode>,
}

pub(super) fn read(lines: &mut Lines<'_>) -> Result<Header, TrcError> {
    let path = next(lines)?;
    if !path.text.starts_with("PathFileType") {
        return Err(path.error(TrcProblem::NotTrc));
    }
    let separator = if path.text.contains('\t') { '\t' } else { ',' };
    let start_timecode = path.text.split(separator).find_map(start_timecode::read);
    let keys = next(lines)?;
    let values = next(lines)?;
    let value = |key: &'static str| {
        let named = |it: &&str| it.trim().eq_ignore_ascii_case(key);
        let mut pairs = keys.text.split(separator).zip(values.text.split(separator));
        pairs
            .find(|(it, _)| named(it))
            .map(|(_, value)| value.trim())
            .ok_or_else(|| values.error(TrcProblem::MissingKey(key)))
    };
    let rate_hz = rate(value("DataRate")?).map_err(|it| values.error(it))?;
    let n_markers = count(value("NumMarkers")?).map_err(|it| values.error(it))?;
    let unit = unit(value("Units")?).map_err(|it| values.error(it))?;
    let names = next(lines)?;
    let marker_names =
        marker_names(&names.text, separator, n_markers).map_err(|it| names.error(it))?;
    // The axes' names (X1, Y1, Z1, ...) say nothing that the columns do not.
    next(lines)?;
    Ok(Header {
        separator,
        rate_hz,
        unit,
        marker_names,
        start_timecode,
    })
}

fn next<'a>(lines: &mut Lines<'a>) -> Result<Line<'a>, TrcError> {
    lines.next()?.ok_or(TrcError {
        line: lines.number + 1,
        problem: TrcProblem::HeaderEnds,
    })
}

fn rate(text: &str) -> Result<f64, TrcProblem> {
    match text.parse() {
        Ok(rate) if f64::is_finite(rate) && rate > 0.0 => Ok(rate),
        _ => Err(TrcProblem::Rate),
    }
}

fn count(text: &str) -> Result<usize, TrcProblem> {
    match text.parse() {
        Ok(count @ 1..=MAX_MARKERS) => Ok(count),
        _ => Err(TrcProblem::MarkerCount),
    }
}

fn unit(text: &str) -> Result<LengthUnit, TrcProblem> {
    let units = [
        LengthUnit::Millimeter,
        LengthUnit::Centimeter,
        LengthUnit::Meter,
    ];
    units
        .into_iter()
        .find(|unit| unit.symbol().eq_ignore_ascii_case(text))
        .ok_or_else(|| TrcProblem::Unit {
            found: quoted(text),
        })
}

/// One name above the first of each marker's three columns.
fn marker_names(line: &str, separator: char, expected: usize) -> Result<Vec<String>, TrcProblem> {
    let cells = line.split(separator).skip(LEADING_CELLS);
    let all: Vec<&str> = cells.step_by(3).map(str::trim).collect();
    let named = all
        .iter()
        .rposition(|it| !it.is_empty())
        .map_or(0, |it| it + 1);
    let names = &all[..named];
    let before_a_gap = names.iter().position(|it| it.is_empty()).unwrap_or(named);
    // As many as declared, and behind an empty cell more: those would be markers without columns.
    let found = if before_a_gap == expected {
        names.iter().filter(|it| !it.is_empty()).count()
    } else {
        before_a_gap
    };
    if found != expected {
        return Err(TrcProblem::NameCount { expected, found });
    }
    let mut seen = std::collections::BTreeSet::new();
    if let Some(name) = names.iter().find(|it| !seen.insert(**it)) {
        return Err(TrcProblem::DuplicateName { name: quoted(name) });
    }
    Ok(names.iter().map(|&it| it.to_owned()).collect())
}
