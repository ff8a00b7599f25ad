//! A take that is over, in large compressed chunks with index and summary, in place of the file that grew (CONTRACTS U-3).

use std::{io, path::Path};

use frontalis_proto::v1::{TakeCut, TakeEvent, take_event::Event};
use prost::Message as _;

use super::{
    channel::Channel,
    chunk::Message,
    figures::TakeFigures,
    final_form::FinalForm,
    scan::{self, Piece, Scan, ScanError},
};
use crate::fs::{Fs, TEMPORARY_SUFFIX};

/// What a rewriting found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rewritten {
    /// Of what could be read.
    pub figures: TakeFigures,
    /// Length of the new file.
    pub n_bytes: u64,
    /// Bytes amid the file that could not be read.
    pub n_damaged_bytes: u64,
    /// Bytes at its end that were never acknowledged.
    pub n_tail_bytes: u64,
    /// When the last message was recorded, Unix nanoseconds; 0 without messages.
    pub last_time_nanos: u64,
}

/// Why a take's file cannot be read, or not be put into its final form; what is there stays.
#[derive(Debug, thiserror::Error)]
pub enum TakeFileError {
    /// It could not be read.
    #[error(transparent)]
    Scan(#[from] ScanError),
    /// The file system failed.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// The writer refused.
    #[error(transparent)]
    Format(#[from] mcap::McapError),
}

/// Puts the compressed form of `name` in `dir` in its place. A crash at any moment leaves one of the two, and a failure no
/// temporary file, unless that cannot even be removed.
///
/// # Errors
///
/// [`TakeFileError`]; the file then has one of its two forms.
pub fn rewrite(fs: &dyn Fs, dir: &Path, name: &str) -> Result<Rewritten, TakeFileError> {
    let file = dir.join(name);
    let temporary = dir.join(format!("{name}{TEMPORARY_SUFFIX}"));
    fs.remove(&temporary)?;
    let copied = copy(fs, &file, &temporary);
    let replaced = copied.and_then(|it| Ok(fs.rename(&temporary, &file).map(|()| it)?));
    if replaced.is_err() {
        // On a full disk it would be in the way; what cannot be removed now is at the next start.
        drop(fs.remove(&temporary));
    }
    let rewritten = replaced?;
    fs.sync_dir(dir)?;
    Ok(rewritten)
}

fn copy(fs: &dyn Fs, from: &Path, to: &Path) -> Result<Rewritten, TakeFileError> {
    let grown = fs.open(from)?;
    let size = grown.size()?;
    let mut scan = Scan::start(grown, size)?;
    let mut copy = Copy {
        file: FinalForm::create(fs, to)?,
        rewritten: Rewritten::default(),
        next_event: 0,
    };
    while let Some(piece) = scan.next()? {
        match piece {
            Piece::Chunk(chunk) => copy.add_all(&scan::messages(&chunk))?,
            Piece::Damage { n_bytes } => copy.add_cut(n_bytes)?,
            Piece::Tail { n_bytes } => copy.rewritten.n_tail_bytes += n_bytes,
        }
    }
    copy.finish()
}

/// A file that is being written.
struct Copy {
    file: FinalForm,
    rewritten: Rewritten,
    next_event: u32,
}

impl Copy {
    fn add_all(&mut self, messages: &[Message<'_>]) -> Result<(), TakeFileError> {
        for message in messages {
            self.rewritten.figures.count(message.channel, message.data);
            self.add(message)?;
        }
        Ok(())
    }

    fn add(&mut self, message: &Message<'_>) -> Result<(), TakeFileError> {
        self.rewritten.last_time_nanos = message.time_nanos;
        if message.channel == Channel::Events {
            self.next_event = message.sequence.saturating_add(1);
        }
        self.file.add(message)
    }

    /// Says where something is missing.
    fn add_cut(&mut self, n_bytes: u64) -> Result<(), TakeFileError> {
        self.rewritten.n_damaged_bytes += n_bytes;
        let event = TakeEvent {
            event: Some(Event::Cut(TakeCut { n_bytes })),
        };
        self.add(&Message {
            channel: Channel::Events,
            sequence: self.next_event,
            time_nanos: self.rewritten.last_time_nanos,
            data: &event.encode_to_vec(),
        })
    }

    fn finish(mut self) -> Result<Rewritten, TakeFileError> {
        self.rewritten.n_bytes = self.file.finish()?;
        Ok(self.rewritten)
    }
}

#[cfg(test)]
mod tests;
