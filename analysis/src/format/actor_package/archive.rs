//! The ZIP container, read from memory under limits and written the same way every time.
//!
//! Nothing is unpacked to disk, so a path is only a name; one that points outside is refused all the same.

use std::io::{Cursor, Read as _, Write as _};

use zip::{CompressionMethod, ZipArchive, ZipWriter, result::ZipError, write::SimpleFileOptions};

use super::PackageError;
use crate::format::quoted;

/// Most entries of an archive: every muscle's shape, and what else artists leave in a folder.
pub(super) const MAX_ENTRIES: usize = 2_048;
/// Most bytes that one file may unpack to.
pub(super) const MAX_FILE_BYTES: usize = 64 << 20;
/// Most bytes that all files together may unpack to.
pub(super) const MAX_UNPACKED_BYTES: usize = 512 << 20;

/// Whether bytes begin as an archive or a compressed stream does.
pub(super) fn is_compressed(bytes: &[u8]) -> bool {
    const MAGICS: [&[u8]; 7] = [
        b"PK\x03\x04",
        b"\x1f\x8b",
        b"\x28\xb5\x2f\xfd",
        b"BZh",
        b"\xfd7zXZ\0",
        b"7z\xbc\xaf\x27\x1c",
        b"Rar!",
    ];
    MAGICS.iter().any(|magic| bytes.starts_with(magic))
}

/// An archive and what it may still unpack.
pub(super) struct Archive<'a> {
    zip: ZipArchive<Cursor<&'a [u8]>>,
    left_bytes: usize,
}

impl<'a> Archive<'a> {
    pub(super) fn open(bytes: &'a [u8]) -> Result<Self, PackageError> {
        let found = directory_entries(bytes);
        if found > MAX_ENTRIES {
            return Err(PackageError::Entries { found });
        }
        let zip = ZipArchive::new(Cursor::new(bytes))
            .map_err(|_| PackageError::Zip("its directory is damaged or missing"))?;
        if zip.has_duplicate_names() {
            return Err(PackageError::Zip("two entries have one name"));
        }
        Ok(Self {
            zip,
            left_bytes: MAX_UNPACKED_BYTES,
        })
    }

    /// Unpacks one file of at most `limit_bytes`, and of what is left for all.
    pub(super) fn file(&mut self, path: &str, limit_bytes: usize) -> Result<Vec<u8>, PackageError> {
        check_path(path)?;
        let file = || quoted(path);
        let entry = self.zip.by_name(path).map_err(|error| match error {
            ZipError::FileNotFound => PackageError::MissingFile { file: file() },
            ZipError::UnsupportedArchive(_) | ZipError::CompressionMethodNotSupported(_) => {
                PackageError::Compressed
            }
            _ => PackageError::DamagedFile { file: file() },
        })?;
        if entry.encrypted() || !is_plain(entry.compression()) {
            return Err(PackageError::Compressed);
        }
        let limit_bytes = limit_bytes.min(self.left_bytes);
        let mut bytes = Vec::new();
        // One byte more than allowed tells too long from just right, whatever the directory claims.
        entry
            .take(limit_bytes as u64 + 1)
            .read_to_end(&mut bytes)
            .map_err(|_| PackageError::DamagedFile { file: file() })?;
        if bytes.len() > limit_bytes {
            return Err(PackageError::FileSize {
                file: file(),
                limit_bytes,
            });
        }
        if is_compressed(&bytes) {
            return Err(PackageError::Compressed);
        }
        self.left_bytes -= bytes.len();
        Ok(bytes)
    }
}

/// How many entries a directory in these bytes can have, counted before the reader keeps a name of each.
///
/// In compressed data the four bytes occur by chance once in 4 GiB; among files, only in archives in the archive.
fn directory_entries(bytes: &[u8]) -> usize {
    const ENTRY: [u8; 4] = *b"PK\x01\x02";
    bytes.windows(4).filter(|it| *it == ENTRY).count()
}

fn is_plain(method: CompressionMethod) -> bool {
    matches!(
        method,
        CompressionMethod::Stored | CompressionMethod::Deflated
    )
}

/// A relative path of plain components.
fn check_path(path: &str) -> Result<(), PackageError> {
    const MAX_PATH_BYTES: usize = 512;
    let plain = |component: &str| !matches!(component, "" | "." | "..");
    let odd = |c: char| c.is_control() || matches!(c, '\\' | ':');
    if path.len() <= MAX_PATH_BYTES && path.split('/').all(plain) && !path.contains(odd) {
        return Ok(());
    }
    Err(PackageError::OutsidePath { file: quoted(path) })
}

/// Packs files in order, deflated, all with the same date.
pub(super) fn pack(files: impl IntoIterator<Item = (String, String)>) -> Vec<u8> {
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(zip::DateTime::default());
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, text) in files {
        zip.start_file(path, options)
            .expect("invariant: our paths are valid and different");
        zip.write_all(text.as_bytes())
            .expect("invariant: a Vec accepts every write");
    }
    zip.finish()
        .expect("invariant: a Vec accepts every write")
        .into_inner()
}
