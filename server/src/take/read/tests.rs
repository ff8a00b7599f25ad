//! Both forms of a file give the same messages, and never more than was asked for.

use super::*;
use crate::{
    fs::MemFs,
    take::{chunk::ChunkBuffer, head::growing_head, rewrite::rewrite},
};

const DIR: &str = "/takes";
const NAME: &str = "one.mcap";

fn file() -> std::path::PathBuf {
    Path::new(DIR).join(NAME)
}

/// A growing file of one frame and one sample a commit, and where its commits end.
fn growing(fs: &MemFs, n_commits: u32) -> Vec<u64> {
    let mut file = fs.create(&file()).unwrap();
    let mut ends = Vec::new();
    file.append(growing_head().unwrap()).unwrap();
    for sequence in 0..n_commits {
        let mut buffer = ChunkBuffer::default();
        for channel in [Channel::Markers, Channel::Curves] {
            buffer.add(&Message {
                channel,
                sequence,
                time_nanos: u64::from(sequence),
                data: &sequence.to_le_bytes(),
            });
        }
        file.append(&buffer.take()).unwrap();
        ends.push(fs.open(&self::file()).unwrap().size().unwrap());
    }
    file.sync().unwrap();
    ends
}

fn all(reader: &mut TakeReader) -> Vec<TakeRecord> {
    let mut records = Vec::new();
    while let Some(batch) = reader.next_batch().unwrap() {
        assert!(!batch.is_empty());
        records.extend(batch);
    }
    records
}

#[test]
fn both_forms_give_the_same_messages() {
    let fs = MemFs::default();
    growing(&fs, 300);
    let before = all(&mut TakeReader::open(&fs, &file(), u64::MAX).unwrap());
    assert_eq!(before.len(), 600);
    rewrite(&fs, Path::new(DIR), NAME).unwrap();
    let after = all(&mut TakeReader::open(&fs, &file(), 0).unwrap());
    assert_eq!(after, before);
}

#[test]
fn a_growing_file_is_read_as_far_as_was_said_and_to_its_end_when_it_is_replaced() {
    let fs = MemFs::default();
    let ends = growing(&fs, 5);
    let mut reader = TakeReader::open(&fs, &file(), ends[2]).unwrap();
    assert_eq!(all(&mut reader).len(), 6);
    rewrite(&fs, Path::new(DIR), NAME).unwrap();
    reader.grow(ends[4]);
    let rest = all(&mut reader);
    assert_eq!(rest.len(), 4);
    assert_eq!(rest[0].sequence, 3);
}

#[test]
fn damage_stands_where_it_is() {
    let fs = MemFs::default();
    let ends = growing(&fs, 3);
    let mut bytes = fs.read(&file()).unwrap();
    bytes[usize::try_from(ends[0]).unwrap() + 40] ^= 1;
    fs.write_and_sync(&file(), &bytes).unwrap();
    let records = all(&mut TakeReader::open(&fs, &file(), u64::MAX).unwrap());
    let channels: Vec<_> = records.iter().map(|it| it.channel).collect();
    let commit = [Channel::Markers, Channel::Curves];
    assert_eq!(
        channels,
        [&commit[..], &[Channel::Events], &commit[..]].concat()
    );
}

/// Whatever bit a disk loses: the messages are as they were, or it is said that the file is damaged.
#[test]
fn no_flipped_bit_of_the_final_form_gives_other_messages_or_fewer_without_a_word() {
    let fs = MemFs::default();
    growing(&fs, 8);
    rewrite(&fs, Path::new(DIR), NAME).unwrap();
    let whole = all(&mut TakeReader::open(&fs, &file(), u64::MAX).unwrap());
    let bytes = fs.read(&file()).unwrap();
    let places = places_of_interest(&bytes);
    let mut n_noticed = 0;
    for bit in places.iter().flat_map(|it| 8 * it..8 * it + 8) {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        fs.write_and_sync(&file(), &flipped).unwrap();
        match read_whole(&fs) {
            Ok(records) => assert_eq!(records, whole, "bit {bit}"),
            Err(_) => n_noticed += 1,
        }
    }
    let n_bits = 8 * places.len();
    println!("{n_noticed} of {n_bits} bits were noticed, in the others nothing is lost");
    assert!(n_noticed > n_bits / 2, "{n_noticed} of {n_bits}");
}

/// Every byte of every record, but of the schemas, which are long, only the beginning.
fn places_of_interest(bytes: &[u8]) -> Vec<usize> {
    const PREFIX_BYTES: usize = 9;
    let mut places = Vec::new();
    let mut place = mcap::MAGIC.len();
    while place + PREFIX_BYTES <= bytes.len() {
        let length = bytes[place + 1..place + PREFIX_BYTES].try_into().unwrap();
        let end = place + PREFIX_BYTES + usize::try_from(u64::from_le_bytes(length)).unwrap();
        let is_schema = bytes[place] == mcap::records::op::SCHEMA;
        places.extend(place..if is_schema { place + 40 } else { end });
        place = end;
    }
    places
}

fn read_whole(fs: &MemFs) -> Result<Vec<TakeRecord>, TakeFileError> {
    let mut reader = TakeReader::open(fs, &file(), u64::MAX)?;
    let mut records = Vec::new();
    while let Some(batch) = reader.next_batch()? {
        records.extend(batch);
    }
    Ok(records)
}
