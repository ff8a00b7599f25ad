//! Cuts and flipped bits in a file that grew (CONTRACTS G3).

use std::path::Path;

use super::*;
use crate::{
    fs::{Fs as _, MemFs},
    take::{channel::Channel, chunk::ChunkBuffer, head::growing_head},
};

const FILE: &str = "/takes/one.mcap";

fn chunk(sequence: u32) -> Vec<u8> {
    let mut buffer = ChunkBuffer::default();
    for channel in [Channel::Markers, Channel::Curves] {
        buffer.add(&Message {
            channel,
            sequence,
            time_nanos: 1_000 + u64::from(sequence),
            data: &sequence.to_le_bytes(),
        });
    }
    buffer.take()
}

/// Head and chunks, and where each of them starts.
fn file(n_chunks: u32) -> (Vec<u8>, Vec<usize>) {
    let mut bytes = growing_head().unwrap().to_vec();
    let mut starts = Vec::new();
    for sequence in 0..n_chunks {
        starts.push(bytes.len());
        bytes.extend(chunk(sequence));
    }
    (bytes, starts)
}

fn start(fs: &MemFs) -> Result<Scan, ScanError> {
    let file = fs.open(Path::new(FILE))?;
    let size = file.size()?;
    Scan::start(file, size)
}

fn scan(bytes: &[u8]) -> Vec<Piece> {
    let fs = MemFs::default();
    fs.write_and_sync(Path::new(FILE), bytes).unwrap();
    let mut scan = start(&fs).unwrap();
    let mut pieces = Vec::new();
    while let Some(piece) = scan.next().unwrap() {
        pieces.push(piece);
    }
    pieces
}

fn sequences(pieces: &[Piece]) -> Vec<u32> {
    let chunks = pieces.iter().filter_map(|it| match it {
        Piece::Chunk(chunk) => Some(messages(chunk)[0].sequence),
        Piece::Damage { .. } | Piece::Tail { .. } => None,
    });
    chunks.collect()
}

#[test]
fn a_file_that_is_cut_anywhere_keeps_every_whole_chunk() {
    let (bytes, starts) = file(4);
    for n_bytes in starts[1]..=bytes.len() {
        let pieces = scan(&bytes[..n_bytes]);
        let n_whole = starts
            .iter()
            .skip(1)
            .chain([&bytes.len()])
            .filter(|it| **it <= n_bytes)
            .count();
        let expected: Vec<u32> = (0..u32::try_from(n_whole).unwrap()).collect();
        assert_eq!(sequences(&pieces), expected, "{n_bytes} bytes");
        assert!(!pieces.iter().any(|it| matches!(it, Piece::Damage { .. })));
    }
}

#[test]
fn every_flipped_bit_of_eight_chunks_is_damage_with_both_sides_kept_or_a_tail() {
    let (bytes, mut starts) = file(9);
    starts.push(bytes.len());
    for bit in 8 * starts[1]..8 * bytes.len() {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        let pieces = scan(&flipped);
        let hit = starts.iter().rposition(|it| *it <= bit / 8).unwrap();
        let n_damaged = (starts[hit + 1] - starts[hit]) as u64;
        let others: Vec<u32> = (0..9).filter(|it| *it as usize != hit).collect();
        assert_eq!(sequences(&pieces), others, "bit {bit}");
        let n_bytes = n_damaged;
        let expected = if hit < 8 {
            Piece::Damage { n_bytes }
        } else {
            Piece::Tail { n_bytes }
        };
        assert_eq!(pieces[hit], expected, "bit {bit}");
    }
}

#[test]
fn zeros_at_the_end_are_a_tail() {
    let (mut bytes, _) = file(2);
    bytes.extend([0; 4_096]);
    let pieces = scan(&bytes);
    assert_eq!(sequences(&pieces), [0, 1]);
    assert_eq!(pieces[2], Piece::Tail { n_bytes: 4_096 });
}

#[test]
fn a_file_without_a_take_s_head_is_not_read() {
    let fs = MemFs::default();
    let (mut bytes, _) = file(1);
    bytes[20] ^= 1;
    fs.write_and_sync(Path::new(FILE), &bytes).unwrap();
    let refused = start(&fs).unwrap_err();
    assert!(matches!(refused, ScanError::Head), "{refused}");
}
