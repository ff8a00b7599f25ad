//! `frontalis take export`: a take in an exchange format, saved whole or not at all.

use std::{
    fs::File,
    io::{BufWriter, Write as _},
    path::{Path, PathBuf},
};

use anyhow::{Context as _, bail};
use clap::{Args, ValueEnum};
use frontalis_client::{error::ClientError, proto};
use indicatif::ProgressBar;
use sha2::{Digest as _, Sha256};

use super::Client;
use crate::{
    commands::{Context, names::take_name},
    terminal::{progress, say},
};

#[derive(Debug, Args)]
#[command(
    after_help = "The file is whole or not there: it is written beside its name and renamed once its checksum is right.

Examples:
  frontalis take export stage-1-19f3                      the MCAP with everything, as 12A_3.mcap
  frontalis take export stage-1-19f3 --format live-link   for Unreal's Live Link Face importer"
)]
pub struct ExportArgs {
    /// The take
    pub id: String,
    /// What to make of it
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Where to [default: slate and take number, or the take's id, here]
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Replace a file that is there
    #[arg(long)]
    force: bool,
}

/// What a take becomes.
#[expect(clippy::doc_markdown, reason = "help for people, who see no Markdown")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Everything, as it is stored; Foxglove and PlotJuggler open it
    #[default]
    Mcap,
    /// One row a frame, one column a muscle
    Csv,
    /// The CSV of the app Live Link Face: 52 ARKit shapes and the head
    LiveLink,
    /// The actor's face with morph targets that move, binary glTF
    Glb,
    /// The markers, Track Row Column
    Trc,
    /// The markers, C3D
    C3d,
}

impl From<Format> for proto::TakeFormat {
    fn from(format: Format) -> Self {
        match format {
            Format::Mcap => Self::Mcap,
            Format::Csv => Self::Csv,
            Format::LiveLink => Self::LiveLinkCsv,
            Format::Glb => Self::Glb,
            Format::Trc => Self::Trc,
            Format::C3d => Self::C3d,
        }
    }
}

type Pieces = tonic::Streaming<proto::ExportTakeResponse>;

pub async fn run(context: &Context, client: &mut Client, args: &ExportArgs) -> anyhow::Result<()> {
    if let Some(file) = &args.out {
        check_free(file, args.force)?;
    }
    let request = proto::ExportTakeRequest {
        name: take_name(&args.id),
        format: proto::TakeFormat::from(args.format).into(),
    };
    let pieces = client.export_take(request).await;
    let mut pieces = pieces.map_err(ClientError::from)?.into_inner();
    let first = next(&mut pieces).await?.and_then(|it| it.export);
    let first = first.context("the server did not say what it sends")?;
    let file = (args.out.clone()).unwrap_or_else(|| PathBuf::from(&first.file_name));
    check_free(&file, args.force)?;
    let whole = save(pieces, &first, &file, args.force).await?;
    if context.json {
        say(serde_json::to_value(whole)?)?;
    } else {
        say(summary(&whole, &file))?;
    }
    Ok(())
}

fn check_free(file: &Path, force: bool) -> anyhow::Result<()> {
    if file.exists() && !file.is_file() {
        bail!("{} is no file that could be replaced", file.display());
    }
    if !force && file.exists() {
        bail!("{} is there already; --force replaces it", file.display());
    }
    Ok(())
}

async fn next(pieces: &mut Pieces) -> Result<Option<proto::ExportTakeResponse>, ClientError> {
    Ok(pieces.message().await?)
}

/// Writes into a file beside `file`, which gets its name when everything is there.
async fn save(
    mut pieces: Pieces,
    first: &proto::TakeExport,
    file: &Path,
    force: bool,
) -> anyhow::Result<proto::TakeExport> {
    let folder = match file.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let named = || format!("cannot write {}", file.display());
    let mut beside = tempfile::Builder::new()
        .prefix(".frontalis-export-")
        .tempfile_in(folder)
        .with_context(named)?;
    let bar = bar(first);
    let mut to = Sum::new(beside.as_file_mut());
    let last = loop {
        let Some(piece) = next(&mut pieces).await? else {
            bail!("the export ended before it was whole");
        };
        to.write(&piece.chunk).with_context(named)?;
        bar.set_position(piece.frames_done);
        if let Some(last) = piece.export {
            break last;
        }
    };
    let (n_bytes, sha256) = to.finish().with_context(named)?;
    bar.finish_and_clear();
    if (n_bytes, &sha256) != (last.n_bytes, &last.sha256) {
        bail!(
            "the export is damaged: {n_bytes} bytes with SHA-256 {sha256} came, {} bytes with {} were sent",
            last.n_bytes,
            last.sha256
        );
    }
    let placed = if force {
        beside.persist(file)
    } else {
        beside.persist_noclobber(file)
    };
    placed.map_err(|it| it.error).with_context(named)?;
    Ok(last)
}

fn bar(first: &proto::TakeExport) -> ProgressBar {
    match first.format() {
        proto::TakeFormat::Mcap => progress::bytes(first.n_bytes, "saving"),
        _ => progress::frames(first.n_frames, "exporting"),
    }
}

/// Bytes on their way into a file, counted and summed.
struct Sum<'f> {
    out: BufWriter<&'f mut File>,
    n_bytes: u64,
    sha256: Sha256,
}

impl<'f> Sum<'f> {
    fn new(file: &'f mut File) -> Self {
        Self {
            out: BufWriter::new(file),
            n_bytes: 0,
            sha256: Sha256::new(),
        }
    }

    fn write(&mut self, bytes: &[u8]) -> std::io::Result<()> {
        self.n_bytes += bytes.len() as u64;
        self.sha256.update(bytes);
        self.out.write_all(bytes)
    }

    /// How many bytes there are on the disk, and their sum.
    fn finish(mut self) -> std::io::Result<(u64, String)> {
        self.out.flush()?;
        self.out.get_ref().sync_all()?;
        Ok((self.n_bytes, format!("{:x}", self.sha256.finalize())))
    }
}

fn summary(whole: &proto::TakeExport, file: &Path) -> String {
    let mut lines = vec![format!(
        "{}: frames {} to {}, {} rows, {} bytes, SHA-256 {}",
        file.display(),
        whole.first_frame,
        whole.last_frame,
        whole.n_frames,
        whole.n_bytes,
        whole.sha256
    )];
    if whole.n_gaps > 0 {
        let (gaps, frames) = (whole.n_gaps, whole.n_missing_frames);
        lines.push(format!("{gaps} gaps: {frames} frame numbers have no row"));
    }
    if whole.n_dropped_frames > 0 {
        lines.push(format!(
            "{} recorded frames have no row: they were not solved, or came late",
            whole.n_dropped_frames
        ));
    }
    if !whole.undriven_shapes.is_empty() {
        let shapes = whole.undriven_shapes.join(", ");
        lines.push(format!(
            "no muscle drives these shapes, they are 0: {shapes}"
        ));
    }
    lines.join("\n")
}
