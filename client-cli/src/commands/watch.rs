//! `frontalis watch SESSION`: live bars, CSV or JSON lines.

mod sink;

use std::{process::ExitCode, time::Duration};

use anyhow::{Context as _, bail};
use clap::Args;
use frontalis_client::{
    csv,
    curve_client::{CurveClient, CurveEvent, CurveSettings, StartAt, Wanted},
};
use tokio::time::{MissedTickBehavior, interval};

use self::sink::Sink;
use super::{Context, interrupt::Interrupt, session_name};

/// Bars are drawn, keys looked at and lines handed on so often.
const TICK: Duration = Duration::from_millis(33);

/// Follow a session's curves: live bars, CSV or JSON
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is one flag that a person types"
)]
#[derive(Debug, Args)]
#[command(
    after_help = "CSV columns are frame, capture_time_nanos, quality (solved, partial or held), then one a muscle,
and with --standard-errors one more a muscle, MUSCLE_standard_error.

Examples:
  frontalis watch take-1                                                  live bars, q quits
  frontalis watch take-1 --every-frame --from-start --until-end --csv > take-1.csv
  frontalis watch take-1 --every-frame --frames 100 --json"
)]
pub struct WatchArgs {
    /// The session
    session: String,
    /// Every sample in order, none skipped, instead of the newest
    #[arg(long)]
    every_frame: bool,
    /// Begin at the oldest sample that the server keeps, instead of now
    #[arg(long, requires = "every_frame")]
    from_start: bool,
    /// Stop when the session ends, and count anything else as failure
    #[arg(long, requires = "every_frame")]
    until_end: bool,
    /// Stop after so many samples
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    frames: Option<u64>,
    /// Print a table of comma-separated values
    #[arg(long, requires = "every_frame", conflicts_with = "json")]
    csv: bool,
    /// Ask for the standard error of each activation too: with --csv one more column a muscle, with --json `standardErrors`
    #[arg(long)]
    standard_errors: bool,
    /// Samples in flight, 1 to 32, when the newest wins: 2 on a local network, rate x round trip + 1 in general
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..=32), conflicts_with = "every_frame")]
    credits: u32,
    /// At most so many samples a second when the newest wins; 0: as many as the credits let through
    #[arg(long, value_name = "HZ", default_value_t = 0.0, value_parser = super::numbers::not_negative, conflicts_with = "every_frame")]
    max_rate: f64,
}

impl WatchArgs {
    fn settings(&self) -> CurveSettings {
        let wanted = if self.every_frame {
            Wanted::EveryFrame {
                from: if self.from_start {
                    StartAt::Oldest
                } else {
                    StartAt::Now
                },
            }
        } else {
            #[expect(
                clippy::cast_possible_truncation,
                reason = "a rate; the wire carries f32"
            )]
            Wanted::Latest {
                credits: self.credits,
                max_rate_hz: self.max_rate as f32,
            }
        };
        CurveSettings {
            subscriber: "frontalis watch".to_owned(),
            with_uncertainty: self.standard_errors,
            ..CurveSettings::new(session_name(&self.session), wanted)
        }
    }
}

pub async fn run(context: &Context, args: WatchArgs) -> anyhow::Result<ExitCode> {
    let columns = csv::columns(args.standard_errors);
    if args.standard_errors && !args.csv && !context.json {
        bail!("--standard-errors needs --csv or --json: live bars do not show them");
    }
    let mut interrupt = Interrupt::listen()?;
    let mut curves = CurveClient::subscribe(context.connect().await?, args.settings())
        .await
        .with_context(|| format!("cannot follow the session {}", args.session))?;
    let mut sink = Sink::choose(context, &args.session, args.csv.then_some(columns))?;
    let mut watched = Watched::default();
    let mut tick = interval(TICK);
    tick.set_missed_tick_behavior(MissedTickBehavior::Skip);
    let end = loop {
        tokio::select! {
            event = curves.next() => {
                let event = event.with_context(|| watched.what_failed(&args.session))?;
                let Some(event) = event else { break End::Cut };
                watched.take(&event);
                let is_end = matches!(event, CurveEvent::End(_));
                // Drawn before the next is asked for: that gives the credit back.
                sink.take(event)?;
                if is_end {
                    break End::OfSession;
                }
                if args.frames.is_some_and(|it| watched.samples >= it) {
                    break End::Enough;
                }
            }
            _ = tick.tick() => if sink.tick()? {
                break End::Stopped;
            },
            () = interrupt.wait() => break End::Stopped,
        }
    };
    sink.finish()?;
    watched.report();
    let is_whole = watched.lost == 0 && (end == End::OfSession || !args.until_end);
    Ok(if is_whole {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

/// Why watching is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    OfSession,
    Enough,
    Stopped,
    Cut,
}

/// What a table cannot show.
#[derive(Debug, Default)]
struct Watched {
    has_begun: bool,
    samples: u64,
    gap_frames: u64,
    lost: u64,
    new_runs: u64,
}

impl Watched {
    fn take(&mut self, event: &CurveEvent) {
        match event {
            CurveEvent::Header(_) => self.has_begun = true,
            CurveEvent::Sample(_) => self.samples += 1,
            CurveEvent::Gap(gap) => {
                let frames = gap.last.saturating_sub(gap.first).saturating_add(1);
                self.gap_frames = self.gap_frames.saturating_add(frames);
            }
            CurveEvent::Lost {
                first_sequence,
                last_sequence,
            } => self.lost += last_sequence - first_sequence + 1,
            CurveEvent::NewRun { .. } => self.new_runs += 1,
            _ => {}
        }
    }

    fn what_failed(&self, session: &str) -> String {
        if self.has_begun {
            format!("following {session} was ended")
        } else {
            format!("cannot follow the session {session}")
        }
    }

    /// Absence is never silent, even beside a table.
    fn report(&self) {
        if self.gap_frames > 0 {
            eprintln!(
                "{} samples; {} frame numbers gave none (gaps)",
                self.samples, self.gap_frames
            );
        }
        if self.lost > 0 {
            eprintln!(
                "{} samples were lost: the server no longer kept them",
                self.lost
            );
        }
        if self.new_runs > 0 {
            eprintln!("the session started over {} times", self.new_runs);
        }
    }
}
