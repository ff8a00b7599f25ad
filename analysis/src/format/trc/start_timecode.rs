//! The first row's timecode as a cell of the first line: `timecode=01:02:03;04@30000/1001`.

use crate::timecode::Timecode;

/// What such a cell begins with.
const KEY: &str = "timecode=";

pub(super) fn cell(timecode: &Timecode) -> String {
    format!("{KEY}{timecode}@{}", timecode.rate())
}

/// A cell of another program that begins alike means something else, and is no reason to refuse the file.
pub(super) fn read(cell: &str) -> Option<Timecode> {
    let (label, rate) = cell.trim().strip_prefix(KEY)?.split_once('@')?;
    Timecode::parse_at(label, rate).ok()
}
