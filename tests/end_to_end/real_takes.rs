//! Performances of real people through the whole service, compared with the weights that made them.
//!
//! The programs are driven as a person drives them: import, create, publish the file, watch every frame as CSV.
//! `solve` must give the same bytes without a server, and the GLB route the same curves.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use harness::{TestServer, data_dir, program};

/// A take of the actor `ict_muscle16_27` and its pass mark, mean absolute error of the paper's least squares, joint.
const TAKES: [(&str, f64); 3] = [
    ("ns164_muscle16_27_moving", 0.0175),
    ("facegood_speech_muscle16_27_moving", 0.0135),
    ("llv_muscle16_27_moving", 0.0205),
];

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn real_takes_are_recovered_within_their_marks() {
    let Some(data) = data_dir("real_takes::real_takes_are_recovered_within_their_marks") else {
        return;
    };
    let stage = Stage::start(&data).await;
    for (take, mark) in TAKES {
        let file = data.join("takes").join(format!("{take}.trc"));
        let truth = Curves::read_file(&truth_of(&file));
        let default = stage.error(&file, &truth, &[]).await;
        let joint = stage.error(&file, &truth, &["--plain"]).await;
        let split = ["--plain", "--regions", "split"];
        let split = stage.error(&file, &truth, &split).await;
        println!(
            "{take}: mean absolute error plain joint {joint:.4} (mark {mark}), split {split:.4}; default {default:.4}"
        );
        assert!(joint <= mark, "{take}: {joint:.4}");
    }
    stage.server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_glb_route_gives_the_same_curves() {
    let Some(data) = data_dir("real_takes::the_glb_route_gives_the_same_curves") else {
        return;
    };
    let stage = Stage::start(&data).await;
    let glb = stage.folder.path().join("ict.glb");
    let glb = glb.to_str().unwrap();
    stage.run(&["actor", "export", "ict", glb]);
    stage.run(&["actor", "import", glb, "--id", "ict-glb"]);
    let file = data.join("takes/llv_muscle16_27_moving.trc");
    let zip = Curves::parse(&stage.publish_and_watch(&file, "ict", &[]).await);
    let glb = Curves::parse(&stage.publish_and_watch(&file, "ict-glb", &[]).await);
    let apart = zip.max_difference(&glb);
    println!("ZIP and GLB of one actor: curves at most {apart:.1e} apart");
    assert_eq!(apart.to_bits(), 0, "{apart}");
    stage.server.stop().await;
}

/// A server with the scan-derived actor, and the program that talks to it.
struct Stage {
    server: TestServer,
    program: PathBuf,
    package: PathBuf,
    folder: tempfile::TempDir,
}

impl Stage {
    async fn start(data: &Path) -> Self {
        let stage = Self {
            server: TestServer::start().await,
            program: program("frontalis"),
            package: data.join("actors/ict_muscle16_27.zip"),
            folder: tempfile::tempdir().unwrap(),
        };
        stage.run(&[
            "actor",
            "import",
            stage.package.to_str().unwrap(),
            "--id",
            "ict",
        ]);
        stage
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(&self.program);
        command
            .arg("--server")
            .arg(self.server.url())
            .args(arguments)
            .stdin(Stdio::null())
            .stderr(Stdio::inherit());
        command
    }

    /// What the program prints; it must succeed.
    fn run(&self, arguments: &[&str]) -> String {
        let output = self.command(arguments).output().unwrap();
        assert!(output.status.success(), "frontalis {}", arguments.join(" "));
        String::from_utf8(output.stdout).unwrap()
    }

    /// The mean absolute error of a take's curves with these settings; the file alone gives the same bytes.
    async fn error(&self, take: &Path, truth: &Curves, settings: &[&str]) -> f64 {
        let watched = self.publish_and_watch(take, "ict", settings).await;
        let package = self.package.to_str().unwrap();
        let solve = ["solve", take.to_str().unwrap(), "--actor", package, "--csv"];
        let solved = self.run(&[&solve, settings].concat());
        assert!(
            solved == watched,
            "{settings:?}: solve and the server differ"
        );
        Curves::parse(&watched).mean_absolute_error(truth)
    }

    /// Every sample of a take in a session of its own, as CSV.
    async fn publish_and_watch(&self, take: &Path, actor: &str, settings: &[&str]) -> String {
        let id = format!("take-{}", settings.len());
        let create = ["session", "create", "--actor", actor, "--id", &id];
        self.run(&[&create, settings].concat());
        let watch = [
            "watch",
            &id,
            "--every-frame",
            "--from-start",
            "--until-end",
            "--csv",
        ];
        let watching = self.command(&watch).stdout(Stdio::piped()).spawn().unwrap();
        self.run(&[
            "publish",
            take.to_str().unwrap(),
            "--session",
            &id,
            "--fast",
        ]);
        self.run(&["session", "end", &id]);
        let watched = tokio::task::spawn_blocking(|| watching.wait_with_output()).await;
        let output = watched.unwrap().unwrap();
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    }
}

fn truth_of(take: &Path) -> PathBuf {
    let name = take.file_stem().unwrap().to_str().unwrap();
    let name = name.trim_end_matches("_moving").trim_end_matches("_still");
    take.with_file_name(format!("{name}.truth.csv"))
}

/// Activations by frame number, columns by control name.
struct Curves {
    controls: Vec<String>,
    frames: BTreeMap<u64, Vec<f64>>,
}

impl Curves {
    fn read_file(path: &Path) -> Self {
        Self::parse(&std::fs::read_to_string(path).unwrap())
    }

    /// Reads `frame`, then whatever else is not a control, then one column a control.
    fn parse(text: &str) -> Self {
        let mut lines = text.lines();
        let header: Vec<_> = lines.next().unwrap().split(',').collect();
        let first = header
            .iter()
            .position(|it| !["frame", "capture_time_nanos", "quality"].contains(it))
            .unwrap();
        let frames = lines
            .map(|line| {
                let fields: Vec<_> = line.split(',').collect();
                let values = fields[first..]
                    .iter()
                    .map(|it| it.parse().unwrap())
                    .collect();
                (fields[0].parse().unwrap(), values)
            })
            .collect();
        Self {
            controls: header[first..].iter().map(|&it| it.to_owned()).collect(),
            frames,
        }
    }

    /// Mean of |difference| over all frames and controls; every frame of the truth must be there.
    fn mean_absolute_error(&self, truth: &Self) -> f64 {
        let differences = self.differences(truth);
        differences.iter().sum::<f64>() / differences.len() as f64
    }

    fn max_difference(&self, other: &Self) -> f64 {
        self.differences(other).into_iter().fold(0.0, f64::max)
    }

    fn differences(&self, other: &Self) -> Vec<f64> {
        assert_eq!(self.controls, other.controls);
        assert!(self.frames.keys().eq(other.frames.keys()), "other frames");
        let pairs = self
            .frames
            .values()
            .flatten()
            .zip(other.frames.values().flatten());
        pairs.map(|(a, b)| (a - b).abs()).collect()
    }
}
