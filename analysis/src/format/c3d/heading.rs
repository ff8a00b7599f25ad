//! What a C3D says before its frames, from its header and its parameters.

use std::collections::{BTreeMap, BTreeSet};

use super::{
    BLOCK_BYTES, C3dError, C3dHeading, C3dProblem, KEY, MAX_POSITIONS,
    layout::{Layout, Storage},
    number::Processor,
    parameters::{PREFIX_BYTES, Parameters},
};
use crate::{face::actor::MAX_MARKERS, format::quoted, space::LengthUnit, timecode::Timecode};

/// Where the header keeps its words, in bytes.
mod at {
    pub(super) const N_POINTS: usize = 2;
    pub(super) const N_ANALOG: usize = 4;
    pub(super) const FIRST_FRAME: usize = 6;
    pub(super) const LAST_FRAME: usize = 8;
    pub(super) const SCALE: usize = 12;
    pub(super) const DATA_BLOCK: usize = 16;
    pub(super) const ANALOG_A_FRAME: usize = 18;
    pub(super) const RATE: usize = 20;
}

/// The first block in the writer's own numbers.
struct Header<'a> {
    bytes: &'a [u8; BLOCK_BYTES],
    processor: Processor,
}

impl Header<'_> {
    fn word(&self, at: usize) -> u16 {
        let bytes = [self.bytes[at], self.bytes[at + 1]];
        self.processor.word(bytes)
    }

    fn real(&self, at: usize) -> f32 {
        let bytes = std::array::from_fn(|byte| self.bytes[at + byte]);
        self.processor.real(bytes)
    }
}

pub(super) fn read(bytes: &[u8]) -> Result<(C3dHeading, Layout), C3dError> {
    if bytes.get(1).is_some_and(|&it| it != KEY) {
        return Err(C3dProblem::NotC3d.at(1));
    }
    let header = bytes
        .first_chunk()
        .ok_or_else(|| C3dProblem::HeaderEnds.at(bytes.len()))?;
    let section = block_start(usize::from(header[0])).ok_or_else(|| {
        let found = usize::from(header[0]);
        C3dProblem::ParameterBlock { found }.at(0)
    })?;
    let code = *bytes
        .get(section + PREFIX_BYTES - 1)
        .ok_or_else(|| C3dProblem::HeaderEnds.at(bytes.len()))?;
    let processor = Processor::of(code)
        .ok_or_else(|| C3dProblem::Processor { found: code }.at(section + PREFIX_BYTES - 1))?;
    let header = Header {
        bytes: header,
        processor,
    };
    // The section's own number of blocks is one byte, too small for some files.
    let data = block_start(usize::from(header.word(at::DATA_BLOCK)));
    let end = data.filter(|&it| it > section).unwrap_or(bytes.len());
    let parameters = Parameters::read(bytes, section + PREFIX_BYTES, end, processor)?;
    let parts = Parts {
        header,
        parameters,
        bytes,
    };
    parts.read()
}

/// The first byte of a block; the first block is the header's.
fn block_start(block: usize) -> Option<usize> {
    (block >= 2).then(|| (block - 1) * BLOCK_BYTES)
}

/// All that stands before the frames.
struct Parts<'a> {
    header: Header<'a>,
    parameters: Parameters<'a>,
    bytes: &'a [u8],
}

impl Parts<'_> {
    fn read(&self) -> Result<(C3dHeading, Layout), C3dError> {
        let n_points = self.n_points()?;
        let layout = Layout {
            processor: self.header.processor,
            storage: self.storage()?,
            start: self.data_start()?,
            n_points,
            n_analog: self.n_analog()?,
        };
        let (first_frame, n_frames) = self.frame_numbers()?;
        let heading = C3dHeading {
            rate_hz: self.rate_hz()?,
            unit: self.unit()?,
            first_frame,
            n_frames,
            marker_names: self.marker_names(n_points)?,
            start_timecode: self.start_timecode()?,
        };
        self.check_size(&layout, n_frames)?;
        Ok((heading, layout))
    }

    /// Where to look for a parameter's value: at the parameter, or in the header where there is none.
    fn place(&self, parameter: &str, header: usize) -> usize {
        self.parameters.offset(parameter).unwrap_or(header)
    }

    fn n_points(&self) -> Result<usize, C3dError> {
        let header = usize::from(self.header.word(at::N_POINTS));
        let place = self.place("POINT:USED", at::N_POINTS);
        let used = self.parameters.count("POINT:USED")?;
        let found = used.map_or(header, |it| it as usize);
        if found != header {
            return Err(contradiction("points", header, found).at(place));
        }
        if !(1..=MAX_MARKERS).contains(&found) {
            return Err(C3dProblem::PointCount { found }.at(place));
        }
        Ok(found)
    }

    /// Channels × samples of each in a frame, of which the header's word holds the low 16 bits.
    fn n_analog(&self) -> Result<usize, C3dError> {
        let header = usize::from(self.header.word(at::N_ANALOG));
        let Some(n_channels) = self.parameters.count("ANALOG:USED")? else {
            return Ok(header);
        };
        let samples = usize::from(self.header.word(at::ANALOG_A_FRAME));
        let found = (n_channels as usize).saturating_mul(samples);
        if found & 0xffff != header {
            let place = self.place("ANALOG:USED", at::N_ANALOG);
            return Err(contradiction("analog values a frame", header, found).at(place));
        }
        Ok(found)
    }

    fn storage(&self) -> Result<Storage, C3dError> {
        let header = self.header.real(at::SCALE);
        let place = self.place("POINT:SCALE", at::SCALE);
        #[expect(
            clippy::cast_possible_truncation,
            reason = "it was an f32, or an integer of 16 bits"
        )]
        let scale = (self.parameters.number("POINT:SCALE")?).map_or(header, |it| it as f32);
        if !scale.is_finite() || scale.abs() <= 0.0 {
            return Err(C3dProblem::Scale.at(place));
        }
        if header.abs() > 0.0 && header.is_sign_negative() != scale.is_sign_negative() {
            return Err(C3dProblem::Storage.at(place));
        }
        Ok(if scale < 0.0 {
            let residual_scale = -scale;
            Storage::Real { residual_scale }
        } else {
            Storage::Integer { scale }
        })
    }

    fn rate_hz(&self) -> Result<f64, C3dError> {
        let header = f64::from(self.header.real(at::RATE));
        let rate_hz = self.parameters.number("POINT:RATE")?.unwrap_or(header);
        if !rate_hz.is_finite() || rate_hz <= 0.0 {
            return Err(C3dProblem::Rate.at(self.place("POINT:RATE", at::RATE)));
        }
        Ok(rate_hz)
    }

    fn unit(&self) -> Result<Option<LengthUnit>, C3dError> {
        let texts = self.parameters.texts("POINT:UNITS")?;
        let Some(text) = texts.first().filter(|it| !it.is_empty()) else {
            return Ok(None);
        };
        let units = [
            LengthUnit::Millimeter,
            LengthUnit::Centimeter,
            LengthUnit::Meter,
        ];
        let mut known = units.into_iter();
        let unit = known.find(|it| it.symbol().eq_ignore_ascii_case(text));
        unit.map(Some).ok_or_else(|| {
            let found = quoted(text);
            C3dProblem::Unit { found }.at(self.place("POINT:UNITS", 0))
        })
    }

    fn data_start(&self) -> Result<usize, C3dError> {
        let header = usize::from(self.header.word(at::DATA_BLOCK));
        let found = match header {
            0 => (self.parameters.count("POINT:DATA_START")?).map_or(0, |it| it as usize),
            header => header,
        };
        let refused = || C3dProblem::DataBlock { found }.at(at::DATA_BLOCK);
        block_start(found).ok_or_else(refused)
    }

    /// The first frame's number and how many there are.
    ///
    /// The header's words and `POINT:FRAMES` end at 65,535; what goes beyond is told by `TRIAL` or `POINT:LONG_FRAMES`,
    /// which are believed of long takes only, because programs that cut a take forget them.
    fn frame_numbers(&self) -> Result<(u32, u32), C3dError> {
        const MOST_OF_A_WORD: u32 = 0xffff;
        let first = u32::from(self.header.word(at::FIRST_FRAME));
        let last = u32::from(self.header.word(at::LAST_FRAME));
        let long_first = self.parameters.count("TRIAL:ACTUAL_START_FIELD")?;
        let long_last = self.parameters.count("TRIAL:ACTUAL_END_FIELD")?;
        let of_trial = long_first.zip(long_last);
        let of_trial = of_trial.and_then(|(first, last)| last.checked_sub(first)?.checked_add(1));
        let long = match of_trial {
            Some(n_frames) => Some(n_frames),
            None => self.parameters.count("POINT:LONG_FRAMES")?,
        };
        let is_same = |it: &u32| it & MOST_OF_A_WORD == first || first == MOST_OF_A_WORD;
        let first_frame = long_first.filter(is_same).unwrap_or(first);
        let short = self.parameters.count("POINT:FRAMES")?.filter(|&it| it > 0);
        let n_frames = match (long, short) {
            (Some(long), _) if long > MOST_OF_A_WORD => long,
            (_, Some(short)) => short,
            (_, None) => (last + 1)
                .checked_sub(first)
                .ok_or_else(|| C3dProblem::FrameNumbers { first, last }.at(at::FIRST_FRAME))?,
        };
        Ok((first_frame, n_frames))
    }

    fn marker_names(&self, n_points: usize) -> Result<Vec<String>, C3dError> {
        // A dimension is one byte, so that the labels behind the 255th stand in parameters of their own.
        const LABELS: [&str; MAX_MARKERS.div_ceil(255)] = [
            "POINT:LABELS",
            "POINT:LABELS2",
            "POINT:LABELS3",
            "POINT:LABELS4",
            "POINT:LABELS5",
        ];
        let mut labels = Vec::new();
        for name in LABELS {
            labels.extend(self.parameters.texts(name)?);
        }
        labels.resize(n_points, String::new());
        distinct_names(labels).map_err(|problem| problem.at(self.place("POINT:LABELS", 0)))
    }

    /// A group of the same name by another program means something else, and is no reason to refuse the file.
    fn start_timecode(&self) -> Result<Option<Timecode>, C3dError> {
        let start = self.parameters.texts("TIMECODE:START")?;
        let rate = self.parameters.texts("TIMECODE:RATE")?;
        let (Some(start), Some(rate)) = (start.first(), rate.first()) else {
            return Ok(None);
        };
        Ok(Timecode::parse_at(start, rate).ok())
    }

    fn check_size(&self, layout: &Layout, n_frames: u32) -> Result<(), C3dError> {
        let n_frames = n_frames as usize;
        let too_long = || C3dProblem::TooLong.at(layout.start);
        let n_positions = n_frames.checked_mul(layout.n_points);
        n_positions
            .filter(|&it| it <= MAX_POSITIONS)
            .ok_or_else(too_long)?;
        let expected = n_frames
            .checked_mul(layout.frame_bytes())
            .ok_or_else(too_long)?;
        let found = self.bytes.len().saturating_sub(layout.start);
        if found < expected {
            return Err(C3dProblem::CutFrames { expected, found }.at(layout.start));
        }
        Ok(())
    }
}

/// Labels that are cut to a few letters are often the same: then none of them says which point is meant.
fn distinct_names(labels: Vec<String>) -> Result<Vec<String>, C3dProblem> {
    let mut uses = BTreeMap::<String, usize>::new();
    for label in &labels {
        *uses.entry(label.clone()).or_default() += 1;
    }
    let numbered = (1..).zip(labels).map(|(number, label)| match label {
        label if label.is_empty() => format!("unlabeled_{number}"),
        label if uses[&label] > 1 => format!("{label}_{number}"),
        label => label,
    });
    let names: Vec<String> = numbered.collect();
    let mut seen = BTreeSet::new();
    match names.iter().find(|it| !seen.insert(*it)) {
        Some(name) => Err(C3dProblem::DuplicateName { name: quoted(name) }),
        None => Ok(names),
    }
}

fn contradiction(what: &'static str, header: usize, parameters: usize) -> C3dProblem {
    C3dProblem::Contradiction {
        what,
        header,
        parameters,
    }
}
