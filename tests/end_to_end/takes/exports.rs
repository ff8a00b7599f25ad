//! A take in every exchange format says what its frames and its samples said.

use std::process::Command;

use frontalis_analysis::format::{c3d::C3dTake, trc};
use frontalis_proto::v1::{ExportTakeRequest, MarkerFrame, TakeFormat, Timecode};
use harness::{Problem, RecordedTake, TestPerformance, TestServer, program};
use tonic::Code;

use super::{SESSION, export, export_as, recorded, start};

const N_FRAMES: u64 = 60;
const FRAMES_AN_HOUR: u64 = 3_600 * 60;

/// Frames with a gap, a hidden marker, and timecode.
fn frames() -> Vec<MarkerFrame> {
    let performance = TestPerformance::reference();
    let with_timecode = |number: u64| {
        let mut frame = performance.frame(number);
        if number == 40 {
            frame.positions[..3].fill(f32::NAN);
        }
        let place = FRAMES_AN_HOUR + number;
        frame.timecode = Some(Timecode {
            hours: u32::try_from(place / FRAMES_AN_HOUR).unwrap(),
            minutes: u32::try_from(place / 3_600 % 60).unwrap(),
            seconds: u32::try_from(place / 60 % 60).unwrap(),
            frames: u32::try_from(place % 60).unwrap(),
            rate_numerator: 60,
            rate_denominator: 1,
            ..Timecode::default()
        });
        frame
    };
    let numbers = (1..=N_FRAMES).filter(|it| !(50..53).contains(it));
    numbers.map(with_timecode).collect()
}

/// Equal bits, where NaN is NaN.
fn bits(coordinates: &[f32]) -> Vec<u32> {
    let canonical = |it: &f32| if it.is_nan() { f32::NAN } else { *it };
    coordinates
        .iter()
        .map(|it| canonical(it).to_bits())
        .collect()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn every_format_holds_the_take() {
    let server = TestServer::with_session("stage").await;
    let frames = frames();
    let take = recorded(&server, "12A", frames.clone()).await;
    let stored = RecordedTake::read(&export(&server, &take.name).await);

    let (text, told) = export_as(&server, &take.name, TakeFormat::Trc)
        .await
        .unwrap();
    let as_trc = trc::parse(&text).unwrap();
    assert_eq!((told.first_frame, told.last_frame), (1, N_FRAMES));
    assert_eq!(
        (told.n_frames, told.n_gaps, told.n_missing_frames),
        (57, 1, 3)
    );
    assert_eq!((told.gaps[0].first, told.gaps[0].last), (50, 52));
    assert_eq!(as_trc.frames.len(), frames.len());
    for (row, frame) in as_trc.frames.iter().zip(&frames) {
        assert_eq!(row.number, frame.number);
        assert_eq!(bits(row.positions.as_flattened()), bits(&frame.positions));
    }
    assert_eq!(as_trc.start_timecode.unwrap().to_string(), "01:00:00:01");

    let (bytes, _) = export_as(&server, &take.name, TakeFormat::C3d)
        .await
        .unwrap();
    let as_c3d = C3dTake::open(&bytes).unwrap();
    assert_eq!(u64::from(as_c3d.heading().n_frames), N_FRAMES);
    assert_eq!(as_c3d.heading().marker_names, as_trc.marker_names);
    let row_40 = as_c3d.frames().nth(39).unwrap().unwrap();
    assert!(row_40[0].is_none() && row_40[1].is_some());
    assert!(
        as_c3d
            .frames()
            .nth(50)
            .unwrap()
            .unwrap()
            .iter()
            .all(Option::is_none)
    );

    let (text, told) = export_as(&server, &take.name, TakeFormat::Csv)
        .await
        .unwrap();
    let text = String::from_utf8(text).unwrap();
    assert_eq!(text.lines().count(), 1 + stored.samples.len());
    for (line, sample) in text.lines().skip(1).zip(&stored.samples) {
        let cells: Vec<_> = line.split(',').collect();
        assert_eq!(cells[0], sample.frame.to_string());
        assert_eq!(
            cells[3],
            format!("01:00:0{}:{:02}", sample.frame / 60, sample.frame % 60)
        );
        let values: Vec<f32> = cells[4..].iter().map(|it| it.parse().unwrap()).collect();
        assert_eq!(bits(&values), bits(&sample.activations));
    }
    assert_eq!(told.n_dropped_frames, frames.len() as u64 - told.n_frames);

    let (text, told) = export_as(&server, &take.name, TakeFormat::LiveLinkCsv)
        .await
        .unwrap();
    assert_eq!(told.file_name, "12A_1_Frontalis.csv");
    assert_eq!(
        String::from_utf8(text).unwrap().lines().count(),
        1 + stored.samples.len()
    );

    let (bytes, told) = export_as(&server, &take.name, TakeFormat::Glb)
        .await
        .unwrap();
    assert!(bytes.starts_with(b"glTF"));
    let last = stored.samples.last().unwrap().activations.clone();
    let n_bytes = 4 * last.len();
    let weights = bytes[bytes.len() - n_bytes..].chunks(4);
    let weights: Vec<f32> = weights
        .map(|it| f32::from_le_bytes(it.try_into().unwrap()))
        .collect();
    assert_eq!(bits(&weights), bits(&last));
    assert_eq!(told.n_frames, stored.samples.len() as u64);
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_caller_has_two_exports_at_once() {
    let server = TestServer::with_session("stage").await;
    // A C3D has a place for every number: this one is far longer than what a connection holds.
    let mut frames = frames();
    frames.push(TestPerformance::reference().frame(200_000));
    let take = recorded(&server, "", frames).await;
    let mut client = server.takes().await;
    let request = ExportTakeRequest {
        name: take.name.clone(),
        format: TakeFormat::C3d.into(),
    };
    let mut held = Vec::new();
    for _ in 0..2 {
        held.push(client.export_take(request.clone()).await.unwrap());
    }
    let refused = Problem::of(&client.export_take(request.clone()).await.unwrap_err());
    assert_eq!(
        (refused.code, refused.reason.as_str()),
        (Code::ResourceExhausted, "EXPORTS")
    );
    drop(held);
    harness::assert_eventually!(client.export_take(request.clone()).await.is_ok());
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_a_format_cannot_hold_is_refused_before_anything_is_sent() {
    let server = TestServer::with_session("stage").await;
    let take = start(&server, SESSION, "").await.unwrap();
    for format in [TakeFormat::Glb, TakeFormat::C3d] {
        let refused = export_as(&server, &take.name, format).await.unwrap_err();
        let refused = Problem::of(&refused);
        assert_eq!(
            (refused.code, refused.reason.as_str()),
            (Code::FailedPrecondition, "EXPORT_FORMAT")
        );
    }
    server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_command_line_saves_a_take_whole_and_overwrites_nothing() {
    let server = TestServer::with_session("stage").await;
    let take = recorded(&server, "12A", frames()).await;
    let folder = tempfile::tempdir().unwrap();
    let url = server.url();
    let id = take.name.replace("takes/", "");
    let frontalis = async |arguments: &[&str]| {
        let mut command = Command::new(program("frontalis"));
        command.args(["--server", &url, "take", "export", &id]);
        command.args(arguments).current_dir(folder.path());
        let run = tokio::task::spawn_blocking(move || command.output());
        let output = run.await.unwrap().unwrap();
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        let complained = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.success(), said, complained)
    };
    for (format, name) in [
        ("mcap", "12A_1.mcap"),
        ("csv", "12A_1.csv"),
        ("live-link", "12A_1_Frontalis.csv"),
        ("glb", "12A_1.glb"),
        ("trc", "12A_1.trc"),
        ("c3d", "12A_1.c3d"),
    ] {
        let (is_saved, said, complained) = frontalis(&["--format", format]).await;
        assert!(is_saved, "{format}: {complained}");
        assert!(said.contains(name), "{said}");
        let saved = std::fs::read(folder.path().join(name)).unwrap();
        assert!(!saved.is_empty(), "{format}");
    }
    let (is_saved, _, complained) = frontalis(&["--format", "csv"]).await;
    assert!(!is_saved && complained.contains("--force"), "{complained}");
    let csv = folder.path().join("12A_1.csv");
    let before = std::fs::read(&csv).unwrap();
    std::fs::write(&csv, "mine").unwrap();
    let (is_saved, said, _) = frontalis(&["--format", "csv", "--force"]).await;
    assert!(
        is_saved && said.contains("1 gaps: 3 frame numbers"),
        "{said}"
    );
    assert_eq!(std::fs::read(&csv).unwrap(), before);
    let (_, as_trc, _) = frontalis(&["--format", "trc", "--out", "other.trc"]).await;
    assert!(as_trc.contains("other.trc"), "{as_trc}");
    let names = std::fs::read_dir(folder.path()).unwrap();
    assert_eq!(names.count(), 7, "no temporary file is left");
    server.stop().await;
}
