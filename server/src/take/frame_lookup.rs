//! Frames of a take under way by their numbers: what was taken under a number, long after it came (CONTRACTS D-6a).
//!
//! A frame is read from the file, where marks say it stands. The frames around the last one that was asked for stay known,
//! so that a publisher that sends a take again costs one reading of it.

use std::{collections::BTreeMap, path::PathBuf, sync::Arc};

use frontalis_proto::v1;
use prost::Message as _;

use super::{channel::Channel, growth::Growth, places::Places, rewrite::TakeFileError};
use crate::{executor::Workers, fs::Fs, wire::capture::content_hash};

/// Most frames that stay known: 16 bytes of number and hash each, 512 KiB with the tree around them.
const MAX_KNOWN_FRAMES: usize = 16_384;

/// Finds frames of one take under way.
#[derive(Debug)]
pub struct FrameLookup {
    pub(super) fs: Arc<dyn Fs>,
    pub(super) file: PathBuf,
    pub(super) growth: Arc<Growth>,
    pub(super) workers: Workers,
    pub(super) known: Known,
}

/// Frames of one part of the file, by number, with the hash of their content.
#[derive(Debug, Default)]
pub(super) struct Known {
    /// Where the part starts and ends, bytes.
    part: (u64, u64),
    frames: BTreeMap<u64, u64>,
}

impl FrameLookup {
    /// Whether this is of the take that grows so.
    pub fn is_of(&self, growth: &Arc<Growth>) -> bool {
        Arc::ptr_eq(&self.growth, growth)
    }

    /// The hash of the content of frame `number`, if the take has it.
    ///
    /// # Errors
    ///
    /// [`TakeFileError`] when the file cannot be read.
    pub async fn content_hash(&mut self, number: u64) -> Result<Option<u64>, TakeFileError> {
        let part = self.growth.around_frame(number);
        if self.known.part == part
            && let Some(hash) = self.known.frames.get(&number)
        {
            return Ok(Some(*hash));
        }
        if self.known.part != part {
            let (fs, file) = (Arc::clone(&self.fs), self.file.clone());
            let read = move || frames_of(&*fs, &file, part);
            let frames = self.workers.run(read).await?;
            self.known = Known { part, frames };
        }
        let found = self.known.frames.get(&number).copied();
        if self.known.frames.len() > MAX_KNOWN_FRAMES {
            self.known = Known::default();
        }
        Ok(found)
    }
}

/// The frames of a part of a file; the first of a number counts.
fn frames_of(
    fs: &dyn Fs,
    file: &std::path::Path,
    (start, end): (u64, u64),
) -> Result<BTreeMap<u64, u64>, TakeFileError> {
    let mut places = Places::open(fs, file, end)?;
    let mut frames = BTreeMap::new();
    // A take that is over since has its final form, and its publisher another window of duplicates.
    if let Places::Finished(_) = places {
        return Ok(frames);
    }
    places.go_to(start);
    while places.offset() < end
        && let Some(records) = places.next()?
    {
        let markers = records.iter().filter(|it| it.channel == Channel::Markers);
        for frame in markers.filter_map(|it| v1::MarkerFrame::decode(it.data.as_slice()).ok()) {
            frames
                .entry(frame.number)
                .or_insert_with(|| content_hash(&frame));
        }
    }
    Ok(frames)
}
