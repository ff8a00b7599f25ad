//! Whatever a crash or a mistake left under a take's name is made whole, or said what it is and left alone.

use super::*;
use crate::{
    fs::MemFs,
    take::{
        chunk::{ChunkBuffer, Message},
        head::{growing_head, tests::newer_head},
    },
};

const DIR: &str = "/takes";
const NAME: &str = "one.mcap";

fn belonging() -> Belonging {
    Belonging {
        take: "takes/one".to_owned(),
        session: "sessions/stage".to_owned(),
        actor: "actors/anna".to_owned(),
    }
}

/// A growing file whose header says this, with so many frames, each a commit.
fn growing(of: &Belonging, n_frames: u64) -> Vec<u8> {
    let header = v1::TakeHeader {
        take: of.take.clone(),
        session: of.session.clone(),
        actor: of.actor.clone(),
        ..v1::TakeHeader::default()
    };
    let event = v1::TakeEvent {
        event: Some(Event::Header(header)),
    };
    let frames = (1..=n_frames).map(|number| {
        let frame = v1::MarkerFrame {
            number,
            ..v1::MarkerFrame::default()
        };
        (Channel::Markers, frame.encode_to_vec())
    });
    let mut bytes = growing_head().unwrap().to_vec();
    for (channel, data) in [(Channel::Events, event.encode_to_vec())]
        .into_iter()
        .chain(frames)
    {
        let mut buffer = ChunkBuffer::default();
        buffer.add(&Message {
            channel,
            sequence: 0,
            time_nanos: 7,
            data: &data,
        });
        bytes.extend(buffer.take());
    }
    bytes
}

fn with(bytes: &[u8]) -> MemFs {
    let fs = MemFs::default();
    fs.write_and_sync(&Path::new(DIR).join(NAME), bytes)
        .unwrap();
    fs
}

fn recover_one(fs: &MemFs) -> Recovered {
    recover(fs, Path::new(DIR), NAME, &belonging())
}

fn n_frames(recovered: &Recovered) -> u64 {
    match recovered {
        Recovered::Whole(it) => it.figures.n_frames,
        other => panic!("{other:?}"),
    }
}

#[test]
fn h1_a_file_cut_at_any_byte_is_opened_with_every_whole_commit_and_its_length() {
    let whole = growing(&belonging(), 3);
    let head = growing_head().unwrap().len();
    let mut last = 0;
    // The scan's own test cuts at every byte; here the file is written anew each time.
    for n_bytes in (head..whole.len()).step_by(7).chain([whole.len()]) {
        let fs = with(&whole[..n_bytes]);
        let recovered = recover_one(&fs);
        let found = n_frames(&recovered);
        assert!(found >= last && found <= last + 1, "{n_bytes} bytes");
        last = found;
        let Recovered::Whole(it) = recovered else {
            unreachable!("looked at above")
        };
        let file = fs.read(&Path::new(DIR).join(NAME)).unwrap();
        assert_eq!(it.n_bytes, file.len() as u64);
    }
    assert_eq!(last, 3);
}

#[test]
fn h3_a_tail_of_zeros_is_the_end() {
    let mut bytes = growing(&belonging(), 3);
    bytes.extend(std::iter::repeat_n(0, 70_000));
    let Recovered::Whole(it) = recover_one(&with(&bytes)) else {
        panic!("not whole");
    };
    assert_eq!((it.figures.n_frames, it.n_tail_bytes), (3, 70_000));
    assert_eq!(it.n_damaged_bytes, 0);
}

#[test]
fn h4_lengths_that_no_file_has_and_records_of_unknown_kind_are_damage_with_both_sides_kept() {
    let (two, three) = (growing(&belonging(), 2), growing(&belonging(), 3));
    let rest = &three[two.len()..];
    let announced = |opcode: u8, n_bytes: u64| {
        let mut record = vec![opcode];
        record.extend(n_bytes.to_le_bytes());
        record
    };
    // A message of none of our channels in a chunk whose checksum is right.
    let garbage = [&[5][..], &30_u64.to_le_bytes(), &[0xff; 30]].concat();
    let mut valid = announced(6, 40 + garbage.len() as u64);
    for field in [0, 0, garbage.len() as u64] {
        valid.extend(field.to_le_bytes());
    }
    valid.extend(crc32fast::hash(&garbage).to_le_bytes());
    valid.extend(0_u32.to_le_bytes());
    valid.extend((garbage.len() as u64).to_le_bytes());
    valid.extend(&garbage);
    for strange in [
        announced(6, 4 << 30),
        announced(6, u64::MAX),
        announced(0x7f, 12),
        [announced(0x7f, 12), vec![0; 12]].concat(),
        valid,
    ] {
        let fs = with(&[&two[..], &strange, rest].concat());
        let Recovered::Whole(it) = recover_one(&fs) else {
            panic!("not whole");
        };
        assert_eq!(it.figures.n_frames, 3, "{strange:?}");
        assert_eq!(it.n_damaged_bytes, strange.len() as u64);
    }
}

#[test]
fn h5_a_file_of_another_take_or_actor_or_of_a_newer_format_is_named_and_left_as_it_is() {
    let of_other_take = Belonging {
        take: "takes/two".to_owned(),
        ..belonging()
    };
    let of_other_actor = Belonging {
        actor: "actors/berta".to_owned(),
        ..belonging()
    };
    for other in [of_other_take, of_other_actor] {
        let bytes = growing(&other, 2);
        let fs = with(&bytes);
        let recovered = recover_one(&fs);
        assert!(matches!(recovered, Recovered::Foreign(it) if it == other));
        assert_eq!(fs.read(&Path::new(DIR).join(NAME)).unwrap(), bytes);
    }
    let fs = with(&newer_head());
    let Recovered::Unreadable(error) = recover_one(&fs) else {
        panic!("read although newer");
    };
    assert!(error.to_string().contains("format 2"), "{error}");
    assert_eq!(fs.read(&Path::new(DIR).join(NAME)).unwrap(), newer_head());
}

#[test]
fn h6_an_empty_file_and_none_are_takes_that_never_began() {
    assert!(matches!(
        recover_one(&MemFs::default()),
        Recovered::NeverBegun
    ));
    for n_bytes in [0, 1, 100] {
        let fs = with(&growing_head().unwrap()[..n_bytes]);
        assert!(matches!(recover_one(&fs), Recovered::NeverBegun));
    }
    // A head is what an acknowledged start leaves at least.
    let fs = with(growing_head().unwrap());
    assert_eq!(n_frames(&recover_one(&fs)), 0);
}

#[test]
fn h6_a_crash_at_any_call_of_a_recovery_leaves_what_the_next_one_makes_whole() {
    let whole = growing(&belonging(), 20);
    for n_changes in 0.. {
        let fs = with(&whole);
        fs.fail_after(Some(n_changes));
        let is_done = matches!(recover_one(&fs), Recovered::Whole(_));
        fs.fail_after(None);
        let again = recover_one(&fs);
        assert_eq!(n_frames(&again), 20, "after {n_changes} calls");
        let names = fs.list(Path::new(DIR)).unwrap();
        assert_eq!(names, [NAME], "after {n_changes} calls");
        if is_done {
            return;
        }
    }
}

#[test]
fn a_survey_finds_the_same_and_changes_nothing() {
    let bytes = growing(&belonging(), 5);
    let fs = with(&bytes);
    let file = Path::new(DIR).join(NAME);
    let found = survey(&fs, &file).unwrap();
    assert_eq!(
        (found.figures.n_frames, found.n_bytes),
        (5, bytes.len() as u64)
    );
    assert_eq!(fs.read(&file).unwrap(), bytes);
    assert_eq!(header(&fs, &file).unwrap().unwrap().take, "takes/one");
}
