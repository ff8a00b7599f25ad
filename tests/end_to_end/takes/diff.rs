//! `frontalis take diff`: the same bits are said to be the same, and others to differ where and by how much they do.

use frontalis_proto::v1::{SessionSettings, Take};
use harness::{RecordedTake, TestPerformance, TestServer};
use serde_json::Value;

use super::{export, record, resolve::resolved, stop};
use crate::person::Person;

const N_FRAMES: u64 = 80;

/// A take, and the same frames solved again: as they were, and plainly.
async fn takes(server: &TestServer) -> [Take; 3] {
    let performance = TestPerformance::reference();
    let (take, mut publisher) = record(server, &performance).await;
    publisher.send(performance.frames(1..=N_FRAMES)).await;
    publisher.durable(N_FRAMES).await.unwrap();
    publisher.finish().await.unwrap();
    let take = stop(server, &take.name).await.unwrap();
    let plain = SessionSettings {
        plain: Some(true),
        ..SessionSettings::default()
    };
    let same = resolved(server, &take, None).await;
    let other = resolved(server, &take, Some(plain)).await;
    [take, same, other]
}

/// Largest difference, RMS and the frame of the largest, computed from whole files.
fn oracle(one: &RecordedTake, other: &RecordedTake, muscle: usize) -> (f64, f64, u64) {
    let pairs = one.samples.iter().zip(&other.samples);
    let differences: Vec<_> = pairs
        .map(|(a, b)| {
            assert_eq!(a.frame, b.frame);
            let difference = f64::from(b.activations[muscle]) - f64::from(a.activations[muscle]);
            (difference.abs(), a.frame)
        })
        .collect();
    let squares: f64 = differences.iter().map(|it| it.0 * it.0).sum();
    let rms = (squares / differences.len() as f64).sqrt();
    let mut largest = differences[0];
    for it in differences {
        if it.0 > largest.0 {
            largest = it;
        }
    }
    (largest.0, rms, largest.1)
}

fn id(take: &Take) -> &str {
    take.name.trim_start_matches("takes/")
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_take_that_was_solved_again_is_the_same_or_differs_as_is_said() {
    let server = TestServer::with_session("stage").await;
    let [take, same, other] = takes(&server).await;
    let anna = Person::new();
    let diff = format!("--server {} take diff", server.url());
    let said = anna
        .does(&format!("{diff} {} {} --tolerance 0", id(&take), id(&same)))
        .await;
    let n_samples = RecordedTake::read(&export(&server, &take.name).await)
        .samples
        .len();
    assert!(
        said.contains(&format!("{n_samples} of them the same bit for bit")),
        "{said}"
    );
    assert!(said.contains("are the same throughout"), "{said}");

    let said = anna
        .does(&format!("--json {diff} {} {}", id(&take), id(&other)))
        .await;
    let said: Value = serde_json::from_str(&said).unwrap();
    let [one, two] = [
        RecordedTake::read(&export(&server, &take.name).await),
        RecordedTake::read(&export(&server, &other.name).await),
    ];
    let controls = said["controls"].as_array().unwrap();
    assert_eq!(controls.len(), one.samples[0].activations.len());
    for (muscle, control) in controls.iter().enumerate() {
        let (max, rms, frame) = oracle(&one, &two, muscle);
        let figure = |name: &str| control[name].as_f64().unwrap();
        assert!((figure("max") - max).abs() < 1e-12, "{control}");
        assert!((figure("rms") - rms).abs() < 1e-12, "{control}");
        if max > 0.0 {
            assert_eq!(control["largest"]["frame"], frame, "{control}");
        }
    }
    assert!(controls.iter().any(|it| it["max"].as_f64().unwrap() > 1e-4));
    anna.fails(&format!(
        "{diff} {} {} --tolerance 1e-6",
        id(&take),
        id(&other)
    ))
    .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn files_are_compared_without_a_server_and_drawn() {
    let server = TestServer::with_session("stage").await;
    let [take, _, other] = takes(&server).await;
    let anna = Person::new();
    let mut files = Vec::new();
    for (name, take) in [("a.mcap", &take), ("b.mcap", &other)] {
        let file = anna.home().join(name);
        std::fs::write(&file, export(&server, &take.name).await).unwrap();
        files.push(file.display().to_string());
    }
    server.stop().await;
    let svg = anna.home().join("diff.svg");
    let line = format!(
        "take diff {} {} --picture {}",
        files[0],
        files[1],
        svg.display()
    );
    let said = anna.does(&line).await;
    assert!(said.contains("where in the take"), "{said}");
    let drawn = std::fs::read_to_string(svg).unwrap();
    let n_muscles = RecordedTake::read(&std::fs::read(&files[0]).unwrap()).samples[0]
        .activations
        .len();
    let rows = drawn.matches("class=\"second\" points").count();
    assert_eq!(rows, n_muscles, "a curve of B for every muscle");

    let no_take = anna.home().join("none.mcap");
    std::fs::write(&no_take, b"not a take").unwrap();
    let said = anna
        .fails(&format!("take diff {} {}", files[0], no_take.display()))
        .await;
    assert!(said.contains("none.mcap"), "{said}");
}
