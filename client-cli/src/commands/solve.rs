//! `frontalis solve TAKE --actor PACKAGE`: the same analysis without a server.

use std::{
    fs,
    io::{self, BufWriter, Write as _},
    path::PathBuf,
    process::ExitCode,
    sync::Arc,
};

use anyhow::{Context as _, bail};
use clap::Args;
use frontalis_analysis::{
    curve::Quality,
    face::actor::{Actor, RankPolicy},
    format::curve_csv::CurveCsvWriter,
    space::LengthUnit,
};
use frontalis_client::{
    csv::{self, CsvRow},
    curve_client::CurveEvent,
    error::advice_on,
    proto,
    solve::{Solved, solve_take},
    take_file,
};

use super::{
    Context, actor, marker_check::MarkerCheck, settings::AnalysisArgs, solve_report, unit::Unit,
};
use crate::{
    json,
    terminal::{progress, say},
};

/// Solve a TRC or C3D file without a server, as a session would
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is one flag that a person types"
)]
#[derive(Debug, Args)]
#[command(
    after_help = "The table has the columns and the bits of `frontalis watch --csv` for the same frames and settings.

Examples:
  frontalis solve take.trc --actor anna.zip                            counts, and what the take says of the shapes
  frontalis solve take.trc --actor anna.zip --csv > take.csv
  frontalis solve take.trc --actor anna.zip --plain --csv > plain.csv  the paper's least squares alone"
)]
pub struct SolveArgs {
    /// The file, TRC or C3D
    take: PathBuf,
    /// The actor's package, .zip or .glb
    #[arg(long, value_name = "PACKAGE")]
    actor: PathBuf,
    /// Print a table of comma-separated values instead of a summary
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Print the standard error of each activation too: with --csv one more column a muscle, with --json `standardErrors`
    #[arg(long)]
    standard_errors: bool,
    /// Accept a basis whose muscles the markers cannot tell apart
    #[arg(long)]
    regularize: bool,
    /// Number the frames from 1, as `publish --renumber` does in a new session
    #[arg(long)]
    renumber: bool,
    /// Unit of a C3D that states none
    #[arg(long, value_enum, value_name = "UNIT")]
    unit: Option<Unit>,
    #[command(flatten)]
    settings: AnalysisArgs,
}

pub fn run(context: &Context, args: &SolveArgs) -> anyhow::Result<ExitCode> {
    if args.standard_errors && !args.csv && !context.json {
        bail!("--standard-errors needs --csv or --json");
    }
    let unit = args.unit.map(LengthUnit::from);
    let take = if args.renumber {
        take_file::read_renumbered(&args.take, unit)?
    } else {
        take_file::read(&args.take, unit)?
    };
    let package = fs::read(&args.actor)
        .with_context(|| format!("cannot read the package {}", args.actor.display()))?;
    let rank = if args.regularize {
        RankPolicy::Regularize
    } else {
        RankPolicy::Refuse
    };
    let actor = actor::read_package(&package, rank)
        .with_context(|| format!("cannot use the package {}", args.actor.display()))?;
    let actor = Arc::new(actor);
    let bar = progress::frames(take.frames.len() as u64, "solving");
    let settings = args.settings.to_marker_settings()?;
    let solved = solve_take(&take, &actor, settings, || bar.inc(1))
        .with_context(|| format!("cannot solve {}", args.take.display()))?;
    bar.finish_and_clear();
    report_left_out(&solved);
    let of_actor: Vec<_> = actor.markers().iter().map(|it| it.name.clone()).collect();
    MarkerCheck::new(&take.marker_names, &of_actor, solved.bound_markers).warn();
    if solved.samples.is_empty() {
        bail!("{} gave no sample", args.take.display());
    }
    if args.csv {
        write_csv(&actor, &solved, args.standard_errors)?;
    } else if context.json {
        write_json(&actor, &solved, args.standard_errors)?;
    } else {
        say(solve_report::summary(&solved, take.frames.len()))?;
    }
    let is_table = args.csv || context.json;
    for line in solve_report::findings(&actor, &solved) {
        // What a table cannot show is said beside it.
        if is_table {
            eprintln!("{line}");
        } else {
            say(line)?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn report_left_out(solved: &Solved) {
    if solved.unaligned_frames > 0 {
        eprintln!(
            "the take ended before its neutral face was known: {} frames gave no sample (--neutral-frames asks for fewer)",
            solved.unaligned_frames
        );
    }
    for (reason, frames) in &solved.rejected {
        eprintln!("{frames} frames were not used: {reason}");
        if let Some(advice) = advice_on(reason) {
            eprintln!("  what to do: {advice}");
        }
    }
}

fn muscle_names(actor: &Actor) -> impl Iterator<Item = &str> + Clone {
    actor
        .muscle_set()
        .muscles()
        .iter()
        .map(|it| it.name.as_str())
}

fn write_csv(actor: &Actor, solved: &Solved, standard_errors: bool) -> io::Result<()> {
    let out = BufWriter::new(io::stdout().lock());
    let columns = csv::columns(standard_errors);
    let mut writer = CurveCsvWriter::new(out, muscle_names(actor), columns)?;
    for sample in &solved.samples {
        writer.write_row(&CsvRow::from(sample).as_row())?;
    }
    writer.flush()
}

/// One JSON object a sample, after one that names the controls: the messages of a subscription.
fn write_json(actor: &Actor, solved: &Solved, standard_errors: bool) -> io::Result<()> {
    let mut out = BufWriter::new(io::stdout().lock());
    let controls = muscle_names(actor).map(|it| proto::Control {
        name: it.to_owned(),
        ..proto::Control::default()
    });
    let header = proto::CurveHeader {
        controls: controls.collect(),
        ..proto::CurveHeader::default()
    };
    writeln!(out, "{}", json::event(CurveEvent::Header(header))?)?;
    for (index, sample) in solved.samples.iter().enumerate() {
        let row = CsvRow::from(sample);
        let mut message = proto::CurveSample {
            frame: row.frame,
            sequence: index as u64 + 1,
            capture_time_nanos: row.capture_time_nanos,
            activations: row.activations,
            ..proto::CurveSample::default()
        };
        if standard_errors {
            message.standard_errors = row.standard_errors;
        }
        message.set_quality(wire_quality(sample.quality));
        writeln!(out, "{}", json::event(CurveEvent::Sample(message))?)?;
    }
    out.flush()
}

fn wire_quality(quality: Quality) -> proto::Quality {
    match quality {
        Quality::Solved => proto::Quality::Solved,
        Quality::Partial => proto::Quality::Partial,
        Quality::Held => proto::Quality::Held,
    }
}
