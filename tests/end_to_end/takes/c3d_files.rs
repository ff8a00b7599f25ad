//! C3D files are taken where TRC files are.

use std::process::Command;

use frontalis_analysis::{format::actor_package, space::LengthUnit, synthesis::reference_face};
use frontalis_client::take_file;
use frontalis_proto::v1::TakeFormat;
use harness::{TestPerformance, TestServer, data_dir, program};
use serde_json::Value;

use super::{export_as, recorded};

async fn frontalis(arguments: Vec<String>) -> (bool, String, String) {
    let mut command = Command::new(program("frontalis"));
    command.args(arguments);
    let run = tokio::task::spawn_blocking(move || command.output());
    let output = run.await.unwrap().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        output.status.success(),
        text(&output.stdout),
        text(&output.stderr),
    )
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_take_is_solved_and_published_from_either_format_to_the_same_bits() {
    let server = TestServer::with_session("stage").await;
    let frames = TestPerformance::reference().frames(1..=60);
    let take = recorded(&server, "12A", frames).await;
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let actor = path("reference.zip");
    std::fs::write(&actor, actor_package::write_zip(&reference_face::actor())).unwrap();
    let mut tables = Vec::new();
    for (format, name) in [(TakeFormat::Trc, "take.trc"), (TakeFormat::C3d, "take.c3d")] {
        let (bytes, _) = export_as(&server, &take.name, format).await.unwrap();
        std::fs::write(path(name), bytes).unwrap();
        let arguments = ["solve", &path(name), "--actor", &actor, "--csv"];
        let (is_solved, table, complained) = frontalis(arguments.map(str::to_owned).to_vec()).await;
        assert!(is_solved, "{name}: {complained}");
        // A C3D has no times of its own, so the second column is left out.
        let untimed = |line: &str| {
            let cells = line.split(',').enumerate();
            let cells: Vec<_> = cells.filter(|it| it.0 != 1).map(|it| it.1).collect();
            cells.join(",")
        };
        tables.push(table.lines().map(untimed).collect::<Vec<_>>());
    }
    assert!(tables[0].len() > 40, "{:?}", tables[0]);
    assert_eq!(tables[0], tables[1]);

    let created = server.create_session("again", "actors/reference").await;
    created.unwrap();
    let (url, file) = (server.url(), path("take.c3d"));
    let arguments = [
        "--server",
        &url,
        "publish",
        &file,
        "--session",
        "again",
        "--fast",
    ];
    let (is_published, _, complained) = frontalis(arguments.map(str::to_owned).to_vec()).await;
    assert!(is_published, "{complained}");
    assert_eq!(
        server
            .session("sessions/again")
            .await
            .status
            .unwrap()
            .last_frame,
        60
    );
    server.stop().await;
}

#[test]
fn real_files_of_all_processors_are_read_as_other_programs_read_them() {
    let Some(folder) = data_dir("takes::c3d_files") else {
        return;
    };
    let folder = folder.join("c3d");
    let expected = std::fs::read(folder.join("expected_values.json")).unwrap();
    let expected: Value = serde_json::from_slice(&expected).unwrap();
    let (mut n_read, mut n_without_unit) = (0, 0);
    for (name, of_file) in expected.as_object().unwrap() {
        let Some(other) = of_file.get("ezc3d").filter(|it| it["frames"].is_u64()) else {
            continue;
        };
        let file = folder.join(name);
        let take = match take_file::read_renumbered(&file, None) {
            Ok(take) => take,
            Err(refused) => {
                let refused = format!("{:#}", anyhow::Error::from(refused));
                assert!(refused.contains("--unit"), "{refused}");
                n_without_unit += 1;
                take_file::read_renumbered(&file, Some(LengthUnit::Millimeter)).unwrap()
            }
        };
        assert_eq!(take.frames.len() as u64, other["frames"], "{name}");
        assert_eq!(take.marker_names.len() as u64, other["points"], "{name}");
        assert!(
            (take.rate_hz - other["rate"].as_f64().unwrap()).abs() < 1e-3,
            "{name}"
        );
        let labels = other["labels_first"].as_array().unwrap();
        for (found, label) in take.marker_names.iter().zip(labels) {
            let label = label.as_str().unwrap();
            // Labels that are the same are told apart by number.
            assert!(found.starts_with(label), "{name}: {found} {label}");
        }
        n_read += 1;
    }
    println!("c3d: {n_read} real files read, {n_without_unit} of them state no unit");
    assert!(n_read > 8, "{n_read}");
}
