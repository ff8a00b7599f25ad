//! Reading a take whose file has its final form.

use std::path::Path;

use mcap::{
    records::Record,
    sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions},
};

use super::{
    channel::Channel,
    rewrite::{RewriteError, Rewritten},
};
use crate::fs::Fs;

/// Longest record that is read; chunks of ours are far shorter.
const MAX_RECORD_BYTES: usize = 64 << 20;

/// What a file of the final form holds; every checksum is looked at.
///
/// # Errors
///
/// [`RewriteError`] when it has another form, or is damaged.
pub fn finished(fs: &dyn Fs, file: &Path) -> Result<Rewritten, RewriteError> {
    let options = LinearReaderOptions::default()
        .with_prevalidate_chunk_crcs(true)
        .with_validate_chunk_crcs(true)
        .with_record_length_limit(MAX_RECORD_BYTES);
    let mut reader = LinearReader::new_with_options(options);
    let mut found = Rewritten::default();
    while let Some(event) = reader.next_event() {
        match event? {
            LinearReadEvent::ReadRequest(n_bytes) => {
                let n_read = fs.read_at(file, found.n_bytes, reader.insert(n_bytes))?;
                found.n_bytes += n_read as u64;
                reader.notify_read(n_read);
            }
            LinearReadEvent::Record { data, opcode } => {
                if let Record::Message { header, data } = mcap::parse_record(opcode, data)?
                    && let Some(channel) = Channel::of(header.channel_id)
                {
                    found.figures.count(channel, &data);
                }
            }
        }
    }
    Ok(found)
}
