//! A timecode as it is stored: its parts, so that it can be read whatever becomes of the way it is written for people.

use frontalis_analysis::timecode::{Counting, Label, Timecode, TimecodeRate};
use serde::{Deserialize, Serialize};

use super::CatalogueError;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    hours: u32,
    minutes: u32,
    seconds: u32,
    frames: u32,
    rate: [u32; 2],
    drop_frame: bool,
    sub_frame: f32,
    user_bits: u32,
}

const UNREADABLE: CatalogueError = CatalogueError::Unreadable {
    what: "start timecode",
};

pub(super) fn to_text(timecode: &Timecode) -> Result<String, CatalogueError> {
    let (label, rate) = (timecode.label(), timecode.rate());
    let record = Record {
        hours: label.hours,
        minutes: label.minutes,
        seconds: label.seconds,
        frames: label.frames,
        rate: [rate.numerator(), rate.denominator()],
        drop_frame: rate.counting() == Counting::Drop,
        sub_frame: timecode.sub_frame(),
        user_bits: timecode.user_bits(),
    };
    serde_json::to_string(&record).map_err(|_| UNREADABLE)
}

pub(super) fn from_text(text: &str) -> Result<Timecode, CatalogueError> {
    let record: Record = serde_json::from_str(text).map_err(|_| UNREADABLE)?;
    let counting = if record.drop_frame {
        Counting::Drop
    } else {
        Counting::NonDrop
    };
    let [numerator, denominator] = record.rate;
    let label = Label {
        hours: record.hours,
        minutes: record.minutes,
        seconds: record.seconds,
        frames: record.frames,
    };
    TimecodeRate::new(numerator, denominator, counting)
        .and_then(|rate| Timecode::new(label, rate))
        .and_then(|it| it.with_sub_frame(record.sub_frame))
        .map(|it| it.with_user_bits(record.user_bits))
        .map_err(|_| UNREADABLE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_timecode_comes_back_as_it_was() {
        let timecode = Timecode::parse("01:10:00;01", TimecodeRate::NTSC_DROP)
            .and_then(|it| it.with_sub_frame(0.25))
            .unwrap()
            .with_user_bits(7);
        assert_eq!(from_text(&to_text(&timecode).unwrap()).unwrap(), timecode);
        assert!(from_text("{}").is_err());
    }
}
