//! A chunk of a take's file, read only once all of it is known to be right.
//!
//! Who writes takes and who plays them read chunks by this one way: not a message is given of a chunk whose checksum is
//! wrong, and what a damaged length asks for is not reserved.

use std::io::Read as _;

use mcap::{
    McapError,
    records::{Record, op},
    sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions},
};

/// Longest record that is read, chunks included, compressed or not; those of takes are far shorter.
pub const MAX_TAKE_RECORD_BYTES: usize = 64 << 20;

/// The records in a chunk's record, `record` being what follows its opcode and length.
///
/// # Errors
///
/// [`McapError`] when it is no chunk, damaged, or longer than [`MAX_TAKE_RECORD_BYTES`].
pub fn chunk_records(record: &[u8]) -> Result<Vec<Record<'static>>, McapError> {
    if let Record::Chunk { header, .. } = mcap::parse_record(op::CHUNK, record)?
        && header.uncompressed_size > MAX_TAKE_RECORD_BYTES as u64
    {
        return Err(McapError::ChunkTooLarge(header.uncompressed_size));
    }
    // Read as a file of this chunk alone.
    let options = LinearReaderOptions::default()
        .with_skip_start_magic(true)
        .with_skip_end_magic(true)
        .with_prevalidate_chunk_crcs(true)
        .with_validate_chunk_crcs(true)
        .with_record_length_limit(MAX_TAKE_RECORD_BYTES);
    let mut reader = LinearReader::new_with_options(options);
    let prefix = [&[op::CHUNK][..], &(record.len() as u64).to_le_bytes()].concat();
    let mut bytes = prefix.as_slice().chain(record);
    let mut records = Vec::new();
    while let Some(event) = reader.next_event() {
        match event? {
            LinearReadEvent::ReadRequest(n_bytes) => {
                let n_read = bytes.read(reader.insert(n_bytes))?;
                reader.notify_read(n_read);
            }
            LinearReadEvent::Record { data, opcode } => {
                records.push(mcap::parse_record(opcode, data)?.into_owned());
            }
        }
    }
    Ok(records)
}
