//! A take that a crash left open is brought into its final form, or said why not (CONTRACTS U-5, U-6).

use std::{io, path::Path};

use frontalis_proto::v1::{self, take_event::Event};
use prost::Message as _;

use super::{
    channel::Channel,
    finished::finished,
    read::{TakeReader, TakeRecord},
    rewrite::{Rewritten, TakeFileError, rewrite},
    scan::ScanError,
};
use crate::fs::Fs;

/// Whose take a file shall be, as its header says it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Belonging {
    /// Name of the take.
    pub take: String,
    /// Name of its session.
    pub session: String,
    /// Name of its actor.
    pub actor: String,
}

impl From<&v1::TakeHeader> for Belonging {
    fn from(header: &v1::TakeHeader) -> Self {
        Self {
            take: header.take.clone(),
            session: header.session.clone(),
            actor: header.actor.clone(),
        }
    }
}

/// What became of a take that was left open.
#[derive(Debug)]
pub enum Recovered {
    /// It has its final form.
    Whole(Rewritten),
    /// There is no file, or less than its head: nothing of it was ever acknowledged.
    NeverBegun,
    /// The file is of another take; it is left as it is.
    Foreign(Belonging),
    /// The file is left as it is.
    Unreadable(TakeFileError),
}

/// Brings the file `name` in `dir` into its final form, in which an earlier crash may have left it already.
pub fn recover(fs: &dyn Fs, dir: &Path, name: &str, wanted: &Belonging) -> Recovered {
    match try_recover(fs, dir, name, wanted) {
        Ok(recovered) => recovered,
        Err(error) if has_not_begun(&error) => Recovered::NeverBegun,
        Err(error) => Recovered::Unreadable(error),
    }
}

fn try_recover(
    fs: &dyn Fs,
    dir: &Path,
    name: &str,
    wanted: &Belonging,
) -> Result<Recovered, TakeFileError> {
    // A file whose first chunk is damaged says nothing of itself, and is taken for what the catalogue says.
    let header = header(fs, &dir.join(name))?;
    let found = header.as_ref().map(Belonging::from);
    if let Some(other) = found.filter(|it| it != wanted) {
        return Ok(Recovered::Foreign(other));
    }
    final_form(fs, dir, name).map(Recovered::Whole)
}

fn has_not_begun(error: &TakeFileError) -> bool {
    match error {
        TakeFileError::Scan(ScanError::NotBegun) => true,
        TakeFileError::Io(error) | TakeFileError::Scan(ScanError::Io(error)) => {
            error.kind() == io::ErrorKind::NotFound
        }
        _ => false,
    }
}

/// The final form of a file, made unless it has it.
///
/// # Errors
///
/// [`TakeFileError`]; the file is then readable as before.
pub fn final_form(fs: &dyn Fs, dir: &Path, name: &str) -> Result<Rewritten, TakeFileError> {
    match rewrite(fs, dir, name) {
        Err(TakeFileError::Scan(ScanError::Final)) => finished(fs, &dir.join(name)),
        other => other,
    }
}

/// What a file says of its take; `None` when its beginning is damaged or was never committed.
///
/// # Errors
///
/// [`TakeFileError`] when it cannot be read at all.
pub fn header(fs: &dyn Fs, file: &Path) -> Result<Option<v1::TakeHeader>, TakeFileError> {
    let first = TakeReader::open(fs, file, u64::MAX)?.next_batch()?;
    Ok(first.iter().flatten().find_map(header_of))
}

fn header_of(record: &TakeRecord) -> Option<v1::TakeHeader> {
    if record.channel != Channel::Events {
        return None;
    }
    match v1::TakeEvent::decode(&*record.data).ok()?.event? {
        Event::Header(header) => Some(header),
        _ => None,
    }
}

/// What a file holds, read without changing it.
///
/// # Errors
///
/// [`TakeFileError`] when it cannot be read.
pub fn survey(fs: &dyn Fs, file: &Path) -> Result<Rewritten, TakeFileError> {
    let mut reader = TakeReader::open(fs, file, u64::MAX)?;
    let mut found = Rewritten {
        n_bytes: fs.open(file)?.size()?,
        ..Rewritten::default()
    };
    while let Some(batch) = reader.next_batch()? {
        for record in batch {
            found.figures.count(record.channel, &record.data);
            found.last_time_nanos = found.last_time_nanos.max(record.time_nanos);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests;
