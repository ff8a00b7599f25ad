//! What the clients of `tests/clients` are given: an actor's package, and a take of it as lines of JSON.

use std::{
    io,
    path::{Path, PathBuf},
};

use frontalis_proto::v1::PublishMarkersRequest;

use crate::{TestPerformance, reference_package};

/// Frames of the take.
const N_FRAMES: u64 = 90;
/// Frames in one message.
const BATCH: usize = 10;

/// Two files in one folder.
#[derive(Clone, Debug)]
pub struct ClientFiles {
    /// The reference face as GLB.
    pub package: PathBuf,
    /// One `PublishMarkersRequest` a line: the start without its session, then the frames.
    pub frames: PathBuf,
}

impl ClientFiles {
    /// Writes `reference.glb` and `take.ndjson`; the folder is made if it is not there.
    ///
    /// # Errors
    ///
    /// As the system says.
    pub fn write(folder: &Path) -> io::Result<Self> {
        std::fs::create_dir_all(folder)?;
        let files = Self {
            package: folder.join("reference.glb"),
            frames: folder.join("take.ndjson"),
        };
        std::fs::write(&files.package, reference_package())?;
        std::fs::write(&files.frames, take())?;
        Ok(files)
    }
}

fn take() -> String {
    let performance = TestPerformance::reference();
    let start = PublishMarkersRequest {
        start: Some(performance.start("", "client")),
        ..PublishMarkersRequest::default()
    };
    let frames = performance.frames(1..=N_FRAMES);
    let frames = frames.chunks(BATCH).map(|batch| PublishMarkersRequest {
        frames: batch.to_vec(),
        ..PublishMarkersRequest::default()
    });
    std::iter::once(start)
        .chain(frames)
        .map(|it| serde_json::to_string(&it).unwrap() + "\n")
        .collect()
}
