//! Writing a take with tabs, as most programs expect it.

use std::fmt::{self, Write as _};

use super::{TrcFrame, TrcTake};

/// Writes a take; `name` goes into the first line. What is written reads back to the same bits.
#[expect(clippy::missing_panics_doc, reason = "writing to a String cannot fail")]
pub fn write(take: &TrcTake, name: &str) -> String {
    let mut text = String::new();
    header(&mut text, take, name).expect("invariant: a String accepts every write");
    for frame in &take.frames {
        row(&mut text, frame).expect("invariant: a String accepts every write");
    }
    text
}

fn header(text: &mut String, take: &TrcTake, name: &str) -> fmt::Result {
    let (rate, frames, markers) = (take.rate_hz, take.frames.len(), take.marker_names.len());
    let (unit, name) = (take.unit.symbol(), one_cell(name));
    let first = take.frames.first().map_or(1, |frame| frame.number);
    writeln!(text, "PathFileType\t4\t(X/Y/Z)\t{name}")?;
    writeln!(
        text,
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames"
    )?;
    writeln!(
        text,
        "{rate}\t{rate}\t{frames}\t{markers}\t{unit}\t{rate}\t{first}\t{frames}"
    )?;
    write!(text, "Frame#\tTime")?;
    for name in &take.marker_names {
        write!(text, "\t{}\t\t", one_cell(name))?;
    }
    write!(text, "\n\t")?;
    for marker in 1..=markers {
        write!(text, "\tX{marker}\tY{marker}\tZ{marker}")?;
    }
    writeln!(text, "\n")
}

fn row(text: &mut String, frame: &TrcFrame) -> fmt::Result {
    write!(text, "{}\t{}", frame.number, frame.time_s)?;
    for coordinate in frame.positions.iter().flatten() {
        if coordinate.is_nan() {
            write!(text, "\t")?;
        } else {
            write!(text, "\t{coordinate}")?;
        }
    }
    writeln!(text)
}

/// A name without what would end its cell or its line.
fn one_cell(name: &str) -> String {
    name.chars()
        .map(|c| if c.is_control() { '_' } else { c })
        .collect()
}
