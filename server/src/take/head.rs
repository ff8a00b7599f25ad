//! What stands before a take's first chunk, and which version of the format it announces (CONTRACTS U-14).
//!
//! A file that grows begins with its channels, then says its version with a checksum of all before it, so that no flipped bit
//! goes unnoticed. In its final form the version comes first.

use std::{collections::BTreeMap, sync::OnceLock};

use mcap::{records::Metadata, write::NoSeek};

use super::{
    channel::{declare, options},
    scan::ScanError,
};
use crate::fs::ReadFile;

/// Version of the format that is written.
pub const FORMAT: u32 = 1;

/// Name of the record that says the version.
const RECORD_NAME: &str = "frontalis.take";

const VERSION: &str = "format";
/// Of the bytes before the record, in a file that grows.
const CHECKSUM: &str = "crc32";
/// In the final form.
const FINAL: (&str, &str) = ("form", "final");

/// Opcode of a metadata record.
const METADATA: u8 = 0x0C;
/// Opcode and length of a record.
const PREFIX_BYTES: usize = 9;
/// Heads are some tens of KiB; what claims to be larger is none.
const MAX_HEAD_BYTES: u64 = 4 << 20;

/// How a file goes on after its head.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// With the chunks of commits.
    Growing,
    /// With large compressed chunks, index and summary.
    Final,
}

/// The beginning of a file that was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Head {
    /// What follows.
    pub form: Form,
    /// Where it follows.
    pub n_bytes: u64,
}

/// The bytes before the first chunk of a file that grows; made once.
///
/// # Errors
///
/// When the writer refuses, which writing to memory gives no reason for.
pub fn growing_head() -> mcap::McapResult<&'static [u8]> {
    static MADE: OnceLock<Vec<u8>> = OnceLock::new();
    if let Some(made) = MADE.get() {
        return Ok(made);
    }
    let head = make_growing_head()?;
    Ok(MADE.get_or_init(|| head))
}

fn make_growing_head() -> mcap::McapResult<Vec<u8>> {
    let mut writer = options()
        .use_chunks(false)
        .create(NoSeek::new(Vec::new()))?;
    declare(&mut writer)?;
    let mut head = writer.into_inner().into_inner();
    let checksum = crc32fast::hash(&head);
    head.extend(record(&said(Some(checksum))));
    Ok(head)
}

/// What a file of the final form says of its version.
pub(super) fn final_version() -> Metadata {
    Metadata {
        name: RECORD_NAME.to_owned(),
        metadata: said(None),
    }
}

fn said(checksum: Option<u32>) -> BTreeMap<String, String> {
    let (key, value) = match checksum {
        Some(it) => (CHECKSUM, format!("{it:08x}")),
        None => (FINAL.0, FINAL.1.to_owned()),
    };
    let version = (VERSION.to_owned(), FORMAT.to_string());
    BTreeMap::from([version, (key.to_owned(), value)])
}

fn record(metadata: &BTreeMap<String, String>) -> Vec<u8> {
    let mut pairs = Vec::new();
    for (key, value) in metadata {
        put_text(&mut pairs, key);
        put_text(&mut pairs, value);
    }
    let mut body = Vec::new();
    put_text(&mut body, RECORD_NAME);
    put_size(&mut body, pairs.len());
    body.extend(pairs);
    let mut record = vec![METADATA];
    record.extend((body.len() as u64).to_le_bytes());
    record.extend(body);
    record
}

fn put_text(to: &mut Vec<u8>, text: &str) {
    put_size(to, text.len());
    to.extend(text.as_bytes());
}

fn put_size(to: &mut Vec<u8>, size: usize) {
    let size = u32::try_from(size).expect("invariant: a head's texts are short");
    to.extend(size.to_le_bytes());
}

/// Reads the head of `file`, of which `size` bytes are looked at.
///
/// # Errors
///
/// [`ScanError::NewerFormat`] when a newer server wrote it, [`ScanError::NotBegun`] when a crash left less than a head,
/// [`ScanError::Head`] when it is none of ours or damaged.
pub fn read(file: &mut dyn ReadFile, size: u64) -> Result<Head, ScanError> {
    let whole = growing_head()?;
    // What is usual is found by one look.
    let start = bytes_at(file, 0, whole.len(), size)?;
    if start == whole {
        let n_bytes = whole.len() as u64;
        let form = Form::Growing;
        return Ok(Head { form, n_bytes });
    }
    if size < whole.len() as u64 && whole.starts_with(&start) {
        return Err(ScanError::NotBegun);
    }
    read_other(file, size)
}

/// The head of a file in its final form, or of one that another version wrote.
fn read_other(file: &mut dyn ReadFile, size: u64) -> Result<Head, ScanError> {
    let mut offset = mcap::MAGIC.len() as u64;
    if bytes_at(file, 0, mcap::MAGIC.len(), size)? != mcap::MAGIC {
        return Err(ScanError::Head);
    }
    loop {
        let prefix = bytes_at(file, offset, PREFIX_BYTES, size)?;
        let (opcode, length) = prefix.split_first().ok_or(ScanError::Head)?;
        let length = length.try_into().map_err(|_| ScanError::Head)?;
        let (start, length) = (offset + PREFIX_BYTES as u64, u64::from_le_bytes(length));
        if length > MAX_HEAD_BYTES || start + length > size.min(MAX_HEAD_BYTES) {
            return Err(ScanError::Head);
        }
        if *opcode == METADATA {
            let n_bytes = usize::try_from(length).map_err(|_| ScanError::Head)?;
            let body = bytes_at(file, start, n_bytes, size)?;
            let form = form(file, offset, &body, size)?;
            let n_bytes = start + length;
            return Ok(Head { form, n_bytes });
        }
        offset = start + length;
    }
}

/// What a record says that stands at `offset`.
fn form(file: &mut dyn ReadFile, offset: u64, body: &[u8], size: u64) -> Result<Form, ScanError> {
    let Ok(mcap::records::Record::Metadata(said)) = mcap::parse_record(METADATA, body) else {
        return Err(ScanError::Head);
    };
    if said.name != RECORD_NAME {
        return Err(ScanError::Head);
    }
    let version = said.metadata.get(VERSION).and_then(|it| it.parse().ok());
    let found: u32 = version.ok_or(ScanError::Head)?;
    if found > FORMAT {
        return Err(ScanError::NewerFormat { found });
    }
    // The reader of such records overlooks some lengths that are wrong; there is one way to write this one.
    if record(&said.metadata)[PREFIX_BYTES..] != *body {
        return Err(ScanError::Head);
    }
    let is_final = said.metadata.get(FINAL.0).is_some_and(|it| it == FINAL.1);
    if is_final {
        return Ok(Form::Final);
    }
    let n_before = usize::try_from(offset).map_err(|_| ScanError::Head)?;
    let before = bytes_at(file, 0, n_before, size)?;
    let checksum = format!("{:08x}", crc32fast::hash(&before));
    if found > 0 && said.metadata.get(CHECKSUM) == Some(&checksum) {
        Ok(Form::Growing)
    } else {
        Err(ScanError::Head)
    }
}

/// As many of the bytes as there are.
pub(super) fn bytes_at(
    file: &mut dyn ReadFile,
    offset: u64,
    n_bytes: usize,
    size: u64,
) -> std::io::Result<Vec<u8>> {
    let left = usize::try_from(size.saturating_sub(offset)).unwrap_or(usize::MAX);
    let mut bytes = vec![0; n_bytes.min(left)];
    let mut n_read = 0;
    while n_read < bytes.len() {
        match file.read_at(offset + n_read as u64, &mut bytes[n_read..])? {
            0 => break,
            n => n_read += n,
        }
    }
    bytes.truncate(n_read);
    Ok(bytes)
}

#[cfg(test)]
pub(super) mod tests {
    use std::path::Path;

    use super::*;
    use crate::fs::{Fs as _, MemFs};

    const FILE: &str = "/takes/one.mcap";

    fn read_bytes(bytes: &[u8]) -> Result<Head, ScanError> {
        let fs = MemFs::default();
        fs.write_and_sync(Path::new(FILE), bytes).unwrap();
        let mut file = fs.open(Path::new(FILE)).unwrap();
        read(&mut *file, bytes.len() as u64)
    }

    /// A head as a later version of the format may begin.
    pub fn newer_head() -> Vec<u8> {
        let mut head = mcap::MAGIC.to_vec();
        let newer = BTreeMap::from([(VERSION.to_owned(), (FORMAT + 1).to_string())]);
        head.extend(record(&newer));
        head
    }

    #[test]
    fn a_head_gives_back_its_form_and_its_length() {
        let head = growing_head().unwrap();
        let expected = Head {
            form: Form::Growing,
            n_bytes: head.len() as u64,
        };
        assert_eq!(read_bytes(head).unwrap(), expected);
        // One with other schemas, as another version of ours writes it, is read by its checksum.
        let mut other = head[..head.len() - record(&said(Some(0))).len()].to_vec();
        let place = other.len() - 1;
        other[place] ^= 1;
        let checksum = crc32fast::hash(&other);
        other.extend(record(&said(Some(checksum))));
        assert_eq!(read_bytes(&other).unwrap(), expected);
    }

    #[test]
    fn h2_every_flipped_bit_of_a_head_is_noticed() {
        let head = growing_head().unwrap();
        let record_bytes = record(&said(Some(0))).len();
        let first = head.len() - record_bytes;
        // Of the schemas a few bytes: they are long, and their bytes are all alike to a checksum.
        let places = (0..64)
            .chain((64..first).step_by(4_099))
            .chain(first..head.len());
        for place in places {
            for bit in 0..8 {
                let mut flipped = head.to_vec();
                flipped[place] ^= 1 << bit;
                assert!(read_bytes(&flipped).is_err(), "bit {bit} of byte {place}");
            }
        }
    }

    #[test]
    fn h5_a_newer_format_and_less_than_a_head_are_told_apart() {
        let newer = read_bytes(&newer_head()).unwrap_err();
        assert!(
            matches!(newer, ScanError::NewerFormat { found: 2 }),
            "{newer}"
        );
        let head = growing_head().unwrap();
        for n_bytes in [0, 1, 8, head.len() - 1] {
            let begun = read_bytes(&head[..n_bytes]).unwrap_err();
            assert!(matches!(begun, ScanError::NotBegun), "{n_bytes}: {begun}");
        }
        let other = read_bytes(b"no take of ours").unwrap_err();
        assert!(matches!(other, ScanError::Head), "{other}");
    }
}
