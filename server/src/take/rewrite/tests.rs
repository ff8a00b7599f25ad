//! The final form holds what the growing file held, and a crash on the way leaves one of the two (CONTRACTS U-5, U-6).

use frontalis_proto::v1::MarkerFrame;

use super::*;
use crate::{
    fs::MemFs,
    take::{chunk::ChunkBuffer, finished::finished, head::growing_head},
};

const DIR: &str = "/takes";
const NAME: &str = "one.mcap";

/// A growing file of one frame and one sample a commit, and where its commits end.
fn growing(fs: &MemFs, n_frames: u64) -> Vec<usize> {
    let mut file = fs.create(&Path::new(DIR).join(NAME)).unwrap();
    let head = growing_head().unwrap();
    file.append(head).unwrap();
    let mut ends = vec![head.len()];
    for number in 1..=n_frames {
        let frame = MarkerFrame {
            number,
            positions: vec![1.5; 81],
            ..MarkerFrame::default()
        };
        let mut buffer = ChunkBuffer::default();
        for (channel, data) in [
            (Channel::Markers, frame.encode_to_vec()),
            (Channel::Curves, vec![]),
        ] {
            buffer.add(&Message {
                channel,
                sequence: 0,
                time_nanos: number,
                data: &data,
            });
        }
        let chunk = buffer.take();
        file.append(&chunk).unwrap();
        ends.push(ends.last().unwrap() + chunk.len());
    }
    file.sync().unwrap();
    ends
}

fn content(fs: &MemFs) -> Vec<u8> {
    fs.read(&Path::new(DIR).join(NAME)).unwrap()
}

#[test]
fn the_final_form_holds_the_same_and_is_smaller() {
    let fs = MemFs::default();
    growing(&fs, 200);
    let before = content(&fs).len();
    let rewritten = rewrite(&fs, Path::new(DIR), NAME).unwrap();
    assert_eq!(rewritten.figures.n_frames, 200);
    assert_eq!(rewritten.figures.n_samples, 200);
    assert_eq!(
        (rewritten.figures.first_frame, rewritten.figures.last_frame),
        (1, 200)
    );
    assert_eq!(rewritten.n_bytes, content(&fs).len() as u64);
    assert!(content(&fs).len() < before);
    assert_eq!(
        finished(&fs, &Path::new(DIR).join(NAME)).unwrap(),
        rewritten
    );
    // It has an index: that is what the other tools look for.
    let summary = mcap::Summary::read(&content(&fs)).unwrap().unwrap();
    assert_eq!(summary.stats.unwrap().message_count, 400);
}

#[test]
fn damage_amid_the_file_is_said_and_both_sides_stay() {
    let fs = MemFs::default();
    let ends = growing(&fs, 3);
    let mut bytes = content(&fs);
    bytes[ends[1] + 40] ^= 1;
    fs.write_and_sync(&Path::new(DIR).join(NAME), &bytes)
        .unwrap();
    let rewritten = rewrite(&fs, Path::new(DIR), NAME).unwrap();
    assert_eq!(rewritten.figures.n_frames, 2);
    assert_eq!(rewritten.n_damaged_bytes, (ends[2] - ends[1]) as u64);
    let cuts = mcap::MessageStream::new(&content(&fs))
        .unwrap()
        .map(Result::unwrap)
        .filter(|it| it.channel.topic == "/events")
        .count();
    assert_eq!(cuts, 1);
}

#[test]
fn a_crash_at_any_call_leaves_a_take_that_is_whole() {
    for n_changes in 0.. {
        let fs = MemFs::default();
        growing(&fs, 20);
        fs.fail_after(Some(n_changes));
        let is_done = rewrite(&fs, Path::new(DIR), NAME).is_ok();
        fs.fail_after(None);
        let file = Path::new(DIR).join(NAME);
        let again = rewrite(&fs, Path::new(DIR), NAME).or_else(|_| finished(&fs, &file));
        assert_eq!(
            again.unwrap().figures.n_frames,
            20,
            "after {n_changes} calls"
        );
        if is_done {
            return;
        }
    }
}

#[test]
fn what_was_flushed_survives_whatever_the_power_cut_makes_of_the_rest() {
    let fs = MemFs::default();
    let ends = growing(&fs, 10);
    let rest = content(&fs)[ends[4]..ends[6]].to_vec();
    let mut file = fs.create(Path::new("/takes/two.mcap")).unwrap();
    file.append(&content(&fs)[..ends[4]]).unwrap();
    file.sync().unwrap();
    file.append(&rest).unwrap();
    for n_kept in 0..=rest.len() {
        for fill in [0, 0xff] {
            // What was not flushed may be there in part, or be something else.
            let cut = fs.after_power_cut(|_, bytes| {
                let mut left = bytes.to_vec();
                left.iter_mut().skip(n_kept).for_each(|it| *it = fill);
                left
            });
            let found = rewrite(&cut, Path::new(DIR), "two.mcap").unwrap();
            assert!((4..=6).contains(&found.figures.n_frames), "{found:?}");
            assert_eq!(found.n_damaged_bytes, 0);
        }
    }
}
