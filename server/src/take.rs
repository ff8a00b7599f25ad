//! Takes: what was captured and what was solved, in one MCAP file each, on stable storage before it is acknowledged.
//!
//! A file grows by one checked chunk a commit, and is put into large compressed chunks with an index when its take is over.
//! Any MCAP tool reads it, while it grows and afterwards.

mod channel;
mod chunk;
mod disk_room;
mod events;
mod export;
mod figures;
mod final_form;
mod finished;
mod frame_lookup;
mod growth;
mod head;
mod open_take;
mod places;
mod read;
mod recorder;
mod recovery;
mod resolve;
mod rewrite;
mod samples;
mod scan;
mod scribe;
mod stored;

pub use channel::Channel;
pub use disk_room::DiskRoom;
pub use export::{Export, ExportError, ExportSource, Step};
pub use figures::TakeFigures;
pub use frame_lookup::FrameLookup;
pub use growth::Growth;
pub use open_take::{Condition, file_name};
pub use read::{TakeReader, TakeRecord};
pub use recorder::{EndedTake, Recorder, StartError, TakeUnderWay};
pub use recovery::{Belonging, Recovered, final_form, header, recover, survey};
pub use resolve::{Advance, Resolve, ResolveError, ResolveTarget, Resolved, TakeToResolve};
pub use rewrite::{Rewritten, TakeFileError};
pub use samples::{SampleReader, SampleSpan, StoredEntry};
pub use scan::ScanError;
pub use stored::{StoredFile, open_stored};
