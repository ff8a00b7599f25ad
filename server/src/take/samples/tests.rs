//! Samples are found from any of them on, in both forms of a file, in bounded pieces, none missing and none twice.

use std::path::PathBuf;

use super::*;
use crate::{
    fs::MemFs,
    take::{
        chunk::{ChunkBuffer, Message},
        growth::Written,
        head::growing_head,
        rewrite::rewrite,
    },
};

const DIR: &str = "/takes";
const NAME: &str = "one.mcap";

/// Sequence of the first sample of the take here.
const FIRST: u64 = 101;

/// Frames of the take: every tenth has no sample, and is a gap.
const N_FRAMES: u64 = 1_500;

fn file() -> PathBuf {
    Path::new(DIR).join(NAME)
}

struct Writer<'a> {
    fs: &'a MemFs,
    growth: Growth,
    written: Written,
    buffer: ChunkBuffer,
    next: [u32; 3],
}

impl Writer<'_> {
    fn add(&mut self, channel: Channel, data: &[u8]) {
        let next = &mut self.next[usize::from(channel.id() - 1)];
        self.buffer.add(&Message {
            channel,
            sequence: *next,
            time_nanos: 0,
            data,
        });
        *next += 1;
    }

    fn event(&mut self, event: Event) {
        let event = v1::TakeEvent { event: Some(event) };
        self.add(Channel::Events, &event.encode_to_vec());
    }
}

fn sample(sequence: u64, frame: u64) -> v1::CurveSample {
    v1::CurveSample {
        frame,
        sequence,
        activations: vec![0.5; 16],
        standard_errors: vec![0.1; 16],
        ..v1::CurveSample::default()
    }
}

/// A file of three frames a commit; returns what a reader from its beginning gets.
fn write(fs: &MemFs) -> (Growth, Vec<(u64, u64)>) {
    let head = growing_head().unwrap();
    let mut out = fs.create(&file()).unwrap();
    out.append(head).unwrap();
    let mut writer = Writer {
        fs,
        growth: Growth::new(3, head.len() as u64),
        written: Written::default(),
        buffer: ChunkBuffer::default(),
        next: [0; 3],
    };
    writer.event(Event::Header(v1::TakeHeader {
        run: 3,
        ..v1::TakeHeader::default()
    }));
    let (mut entries, mut sequence) = (Vec::new(), FIRST);
    let mut before = Written::default();
    for frame in 1..=N_FRAMES {
        let marker_frame = v1::MarkerFrame {
            number: frame,
            positions: vec![1.0; 81],
            ..v1::MarkerFrame::default()
        };
        writer.add(Channel::Markers, &marker_frame.encode_to_vec());
        writer.written.add_frame(frame);
        if frame.is_multiple_of(10) {
            let gap = v1::Gap {
                first: frame,
                last: frame,
                cause: 1,
            };
            writer.event(Event::Gap(gap));
            entries.push((0, frame));
        } else {
            let sample = sample(sequence, frame);
            writer.add(Channel::Curves, &sample.encode_to_vec());
            writer.written.add_sample(sequence, frame);
            entries.push((sequence, frame));
            sequence += 1;
        }
        if frame.is_multiple_of(3) {
            let chunk = writer.buffer.take();
            out.append(&chunk).unwrap();
            writer
                .growth
                .commit(chunk.len() as u64, before, writer.written);
            before = writer.written;
        }
    }
    assert!(writer.fs.open(&file()).unwrap().size().unwrap() > 6 * PIECE_BYTES as u64);
    (writer.growth, entries)
}

/// Sequence, 0 for a gap, and last frame of everything that a reader gets; no piece is larger than it may be.
fn read(fs: &MemFs, growth: Option<&Growth>, sequence: u64) -> Vec<(u64, u64)> {
    let mut reader = SampleReader::open(fs, &file(), growth, sequence, 0).unwrap();
    let mut entries = Vec::new();
    loop {
        let piece = reader.next_piece(None).unwrap();
        if piece.is_empty() {
            assert_eq!(reader.unsolved(), None);
            return entries;
        }
        let n_bytes = |it: &StoredEntry| match it {
            StoredEntry::Sample { data, .. } => data.len() + ENTRY_BYTES,
            StoredEntry::Gap(_) => ENTRY_BYTES,
        };
        assert!(piece.iter().map(n_bytes).sum::<usize>() < PIECE_BYTES + 2_048);
        entries.extend(piece.into_iter().map(|it| match it {
            StoredEntry::Sample {
                sequence, frame, ..
            } => (sequence, frame),
            StoredEntry::Gap(gap) => (0, gap.last),
        }));
    }
}

/// From a sample on, with the gaps just before it.
fn from(entries: &[(u64, u64)], sequence: u64) -> &[(u64, u64)] {
    let wanted = entries.iter().position(|it| it.0 == sequence).unwrap();
    let before = entries[..wanted].iter().rposition(|it| it.0 != 0);
    &entries[before.map_or(0, |it| it + 1)..]
}

#[test]
fn samples_are_read_from_any_of_them_on_while_a_file_grows_and_afterwards() {
    let fs = MemFs::default();
    let (growth, entries) = write(&fs);
    let last = entries.iter().map(|it| it.0).max().unwrap();
    let wanted = [FIRST, FIRST + 1, FIRST + 9, 777, last];
    for sequence in wanted {
        assert_eq!(
            read(&fs, Some(&growth), sequence),
            from(&entries, sequence),
            "from {sequence}"
        );
    }
    assert_eq!(read(&fs, None, 1_234), from(&entries, 1_234), "unmarked");
    rewrite(&fs, Path::new(DIR), NAME).unwrap();
    for sequence in wanted {
        assert_eq!(read(&fs, None, sequence), from(&entries, sequence));
        // The file took its final form, and nobody said so yet.
        assert_eq!(read(&fs, Some(&growth), sequence), from(&entries, sequence));
    }
}

#[test]
fn a_file_says_what_it_holds_in_both_forms() {
    let fs = MemFs::default();
    let (_, entries) = write(&fs);
    let expected = SampleSpan {
        run: 3,
        first: FIRST,
        first_frame: 1,
        last: entries.iter().map(|it| it.0).max().unwrap(),
    };
    assert_eq!(SampleReader::span(&fs, &file()).unwrap(), Some(expected));
    rewrite(&fs, Path::new(DIR), NAME).unwrap();
    assert_eq!(SampleReader::span(&fs, &file()).unwrap(), Some(expected));
}

#[test]
fn no_more_is_read_than_was_said_to_be_on_stable_storage() {
    let fs = MemFs::default();
    let (growth, entries) = write(&fs);
    let n_committed = growth.around_frame(N_FRAMES / 2).1;
    let n_head = growing_head().unwrap().len() as u64;
    let half = Growth::new(3, n_head);
    half.commit(n_committed - n_head, Written::default(), Written::default());
    let mut reader = SampleReader::open(&fs, &file(), Some(&half), FIRST, 0).unwrap();
    let mut n_entries = 0;
    loop {
        let piece = reader.next_piece(Some(n_committed)).unwrap();
        if piece.is_empty() {
            break;
        }
        n_entries += piece.len();
    }
    assert!(n_entries > 0 && n_entries < entries.len());
}

#[test]
fn a_take_without_samples_says_where_they_would_begin_and_which_frames_it_has() {
    let fs = MemFs::default();
    let mut out = fs.create(&file()).unwrap();
    out.append(growing_head().unwrap()).unwrap();
    let mut writer = Writer {
        fs: &fs,
        growth: Growth::new(3, 0),
        written: Written::default(),
        buffer: ChunkBuffer::default(),
        next: [0; 3],
    };
    writer.event(Event::Header(v1::TakeHeader {
        run: 3,
        next_sequence: 40,
        next_frame: 7,
        ..v1::TakeHeader::default()
    }));
    for number in 7..=9 {
        let frame = v1::MarkerFrame {
            number,
            ..v1::MarkerFrame::default()
        };
        writer.add(Channel::Markers, &frame.encode_to_vec());
    }
    out.append(&writer.buffer.take()).unwrap();
    let expected = SampleSpan {
        run: 3,
        first: 40,
        first_frame: 7,
        last: 39,
    };
    assert_eq!(SampleReader::span(&fs, &file()).unwrap(), Some(expected));
    let mut reader = SampleReader::open(&fs, &file(), None, 40, 6).unwrap();
    assert_eq!(reader.next_piece(None).unwrap(), []);
    let unsolved = reader.unsolved().unwrap();
    assert_eq!((unsolved.first, unsolved.last), (7, 9));
}
