//! Python's own packages read a take while it is recorded, after the server was killed, and when it is over.

use std::{
    path::{Path, PathBuf},
    process::Command,
};

use frontalis_proto::v1::{CurveSample, MarkerFrame};
use harness::{Publisher, RecordedTake, TestPerformance, TestServer};
use serde_json::Value;

use super::{SESSION, export, start, stop};

const N_FRAMES: u64 = 60;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn python_reads_a_take_under_way_after_a_kill_and_when_it_is_over() {
    let Some(python) = python() else { return };
    let mut server = TestServer::start_program(|_| {}).await;
    server.import_reference().await;
    let created = server.create_session("stage", "actors/reference").await;
    created.unwrap();
    let performance = TestPerformance::reference();
    let take = start(&server, SESSION, "12A").await.unwrap();
    let start_of = performance.start(SESSION, "stage");
    let mut publisher = Publisher::open(&server, start_of).await.unwrap();
    publisher.send(performance.frames(1..=N_FRAMES)).await;
    publisher.durable(N_FRAMES).await.unwrap();
    // The file itself, as a copy of the data directory would have it.
    let file = server
        .data_dir()
        .join("takes")
        .join(take.name.replace("takes/", ""))
        .with_extension("mcap");
    let under_way = read(&python, &file).await;
    let numbers: Vec<u64> = (1..=N_FRAMES).collect();
    assert_eq!(under_way["frames"], serde_json::json!(numbers));
    assert_eq!(under_way["take"], take.name.as_str());
    assert_eq!(under_way["indexed"], Value::Null);

    server = server.kill_and_restart().await;
    let killed = read(&python, &file).await;
    assert_eq!(killed["frames"], serde_json::json!(numbers));
    check(&killed, &export(&server, &take.name).await);

    let second = start(&server, SESSION, "12A").await.unwrap();
    let start_of = performance.start(SESSION, "stage");
    let mut publisher = Publisher::open(&server, start_of).await.unwrap();
    publisher.send(performance.frames(1..=N_FRAMES)).await;
    publisher.durable(N_FRAMES).await.unwrap();
    stop(&server, &second.name).await.unwrap();
    let over = export(&server, &second.name).await;
    let folder = tempfile::tempdir().unwrap();
    let saved = folder.path().join("over.mcap");
    std::fs::write(&saved, &over).unwrap();
    let read = read(&python, &saved).await;
    assert_eq!(read["frames"], serde_json::json!(numbers));
    assert_eq!(
        read["samples"].as_array().unwrap().len(),
        read["indexed"]["/curves"]
    );
    assert_eq!(read["events"].as_array().unwrap().last().unwrap(), "stop");
    check(&read, &over);
    println!(
        "python: {N_FRAMES} frames under way, {} after a kill, {} with an index when it is over",
        killed["frames"].as_array().unwrap().len(),
        read["indexed"]["/markers"]
    );
    server.stop().await;
}

/// What Python found of a file that has its final form is what is in it.
fn check(found: &Value, file: &[u8]) {
    let take = RecordedTake::read(file);
    assert_eq!(found["indexed"]["/markers"], take.frames.len());
    assert_eq!(found["indexed"]["/events"], take.events.len());
    let positions = |it: &MarkerFrame| sum(&it.positions);
    close(&found["positionSums"], take.frames.iter().map(positions));
    let activations = |it: &CurveSample| sum(&it.activations);
    close(
        &found["activationSums"],
        take.samples.iter().map(activations),
    );
}

fn sum(values: &[f32]) -> f64 {
    let seen = values.iter().filter(|it| !it.is_nan());
    seen.map(|it| f64::from(*it)).sum()
}

fn close(found: &Value, expected: impl Iterator<Item = f64>) {
    let found: Vec<f64> = serde_json::from_value(found.clone()).unwrap();
    let expected: Vec<f64> = expected.collect();
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(&expected) {
        assert!(
            (found - expected).abs() <= 1e-9 * expected.abs().max(1.0),
            "{found} {expected}"
        );
    }
}

async fn read(python: &Path, file: &Path) -> Value {
    let mut command = Command::new(python);
    command
        .arg(repository().join("tests/clients/python/read_take.py"))
        .arg(file)
        .env("PYTHONDONTWRITEBYTECODE", "1");
    let run = tokio::task::spawn_blocking(move || command.output());
    let output = run.await.unwrap().unwrap();
    let complained = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complained}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The environment that `make python` makes, when it is complete.
fn python() -> Option<PathBuf> {
    let venv = repository().join(".venv");
    if venv.join("ready").is_file() {
        return Some(venv.join("bin/python"));
    }
    println!("left out: takes::python: no .venv; `make python` makes it");
    None
}

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}
