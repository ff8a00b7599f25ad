//! Writes what the clients are given: `client-files FOLDER`, where `reference.glb` and `take.ndjson` are then.

use std::path::PathBuf;

use anyhow::Context as _;
use harness::ClientFiles;

fn main() -> anyhow::Result<()> {
    let folder = std::env::args_os().nth(1).map(PathBuf::from);
    let folder = folder.context("name a folder: client-files FOLDER")?;
    let files = ClientFiles::write(&folder)
        .with_context(|| format!("the files cannot be written to {}", folder.display()))?;
    println!("{}\n{}", files.package.display(), files.frames.display());
    Ok(())
}
