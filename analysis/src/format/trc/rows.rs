//! The table: one row a frame.

use super::{
    Line, Lines, MAX_POSITIONS, TrcError, TrcFrame, TrcProblem,
    header::{Header, LEADING_CELLS},
};
use crate::format::quoted;

const AXES: [char; 3] = ['x', 'y', 'z'];

pub(super) fn read(lines: &mut Lines<'_>, header: &Header) -> Result<Vec<TrcFrame>, TrcError> {
    let most_frames = MAX_POSITIONS / header.marker_names.len();
    let mut frames = Vec::new();
    while let Some(line) = lines.next()? {
        // A line of separators only stands between header and table, and at some files' ends.
        if line
            .text
            .split(header.separator)
            .all(|it| it.trim().is_empty())
        {
            continue;
        }
        if frames.len() == most_frames {
            return Err(line.error(TrcProblem::TooLong));
        }
        frames.push(frame(&line, header).map_err(|problem| line.error(problem))?);
    }
    Ok(frames)
}

fn frame(line: &Line<'_>, header: &Header) -> Result<TrcFrame, TrcProblem> {
    let n_markers = header.marker_names.len();
    let cells: Vec<&str> = line.text.split(header.separator).map(str::trim).collect();
    let (leading, coordinates) = cells.split_at(cells.len().min(LEADING_CELLS));
    let leading = |index: usize| leading.get(index).copied().unwrap_or_default();
    let number = leading(0).parse().map_err(|_| TrcProblem::FrameNumber)?;
    let time_s = seconds(leading(1))?;
    if coordinates.len() < 3 * n_markers && !line.is_whole {
        return Err(TrcProblem::CutRow);
    }
    if coordinates
        .iter()
        .skip(3 * n_markers)
        .any(|it| !it.is_empty())
    {
        let expected = n_markers;
        return Err(TrcProblem::TooManyCells { expected });
    }
    let mut positions = vec![[f32::NAN; 3]; n_markers];
    // Editors drop separators at a line's end: cells that are not there are empty.
    for (index, cell) in coordinates.iter().take(3 * n_markers).enumerate() {
        let (marker, axis) = (index / 3, index % 3);
        let problem = |kind: Malformed| {
            let marker = quoted(&header.marker_names[marker]);
            let axis = AXES[axis];
            match kind {
                Malformed::NotANumber => TrcProblem::NotANumber { marker, axis },
                Malformed::NonFinite => TrcProblem::NonFinite { marker, axis },
            }
        };
        positions[marker][axis] = coordinate(cell).map_err(problem)?;
    }
    Ok(TrcFrame {
        number,
        time_s,
        positions,
    })
}

fn seconds(cell: &str) -> Result<f64, TrcProblem> {
    match cell.parse() {
        Ok(time) if f64::is_finite(time) => Ok(time),
        _ => Err(TrcProblem::Time),
    }
}

enum Malformed {
    NotANumber,
    NonFinite,
}

/// Empty and `nan` mean not seen; infinity, also by overflow, means nothing.
fn coordinate(cell: &str) -> Result<f32, Malformed> {
    if cell.is_empty() {
        return Ok(f32::NAN);
    }
    match cell.parse::<f32>() {
        Ok(value) if value.is_infinite() => Err(Malformed::NonFinite),
        Ok(value) => Ok(value),
        Err(_) => Err(Malformed::NotANumber),
    }
}
