//! `frontalis take play`: publishes the frames of a take again, through the doors that everybody uses.
//!
//! Numbers, timecodes, times of capture, marker names, unit and rate are those of the take. Where the session is further than
//! the take's first frame, and from the second round on, frames are numbered on and keep their own number as source frame.

mod pacing;
mod session;

use std::process::ExitCode;

use anyhow::{Context as _, bail};
use clap::Args;
use frontalis_client::{
    capture_client::{CaptureClient, CaptureSettings},
    connection::Channel,
    proto::{self, TakeSource, take_event::Event},
    recorded_take::{RecordedMessage, RecordedTake},
};
use indicatif::ProgressBar;
use proto::take_service_client::TakeServiceClient;
use tokio::time::{Instant, sleep_until};

use self::{pacing::Pacing, session::PlaySession};
use super::source;
use crate::{
    commands::{
        Context, interrupt::Interrupt, names::default_publisher, names::take_name, numbers,
        publish_summary, session_name,
    },
    terminal::progress,
};

#[derive(Debug, Args)]
#[command(
    after_help = "A session that is not there is made, of the take's actor, revision and settings, and ended when the take is over.
Its first frames are its neutral face, as in every new session: a take that begins in the midst of a performance is aligned
by whatever it begins with.

Examples:
  frontalis take play stage-1-19f3c2a1b00                        as session play-stage-1-19f3c2a1b00
  frontalis take play stage-1-19f3c2a1b00 --speed 0.25 --loop    slowly, until Ctrl-C
  frontalis take play one.mcap --session again --keep            a file; the session stays"
)]
pub struct PlayArgs {
    /// The take, or a take's MCAP file
    take: String,
    /// So many times as fast as it was captured
    #[arg(long, value_name = "X", default_value_t = 1.0, value_parser = numbers::positive)]
    speed: f64,
    /// The session [default: play- and the take's id]
    #[arg(long, value_name = "ID")]
    session: Option<String>,
    /// Begin again when it is over, until Ctrl-C
    #[arg(long = "loop")]
    repeat: bool,
    /// Leave a session that was made for it open
    #[arg(long)]
    keep: bool,
}

impl PlayArgs {
    /// What is played, as it was typed.
    pub fn take(&self) -> &str {
        &self.take
    }

    /// How many frames there are; none when nobody says.
    async fn n_frames(&self, channel: &Channel) -> Option<u64> {
        if source::is_file(&self.take) || self.repeat {
            return None;
        }
        let request = proto::GetTakeRequest {
            name: take_name(&self.take),
        };
        let answer = TakeServiceClient::new(channel.clone())
            .get_take(request)
            .await;
        answer.ok()?.into_inner().take.map(|it| it.n_frames)
    }
}

pub async fn run(context: &Context, args: PlayArgs) -> anyhow::Result<ExitCode> {
    let channel = context.connect().await?;
    let interrupt = Interrupt::listen()?;
    let mut take = source::open(&args.take, Some(&channel)).await?;
    let header = source::header(&mut take).await?;
    let id = session::id(args.session.as_deref(), &header);
    let session = PlaySession::open(&channel, &id, &header).await?;
    let bar = match args.n_frames(&channel).await {
        Some(n_frames) => progress::frames(n_frames, "playing"),
        None => progress::spinner(format!("playing into {id}")),
    };
    let mut player = Player {
        channel: channel.clone(),
        session: id.clone(),
        pacing: Pacing::new(1.0, args.speed),
        begun: Instant::now(),
        interrupt,
        bar,
        publication: None,
        round: Round::default(),
        n_late: 0,
    };
    let played = player.play_all(&args, take).await;
    player.bar.finish_and_clear();
    let told = player.finish(context, &args.take).await;
    if !args.keep {
        session.end_if_made(&channel).await?;
    }
    played?;
    told
}

/// Whether playing goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Flow {
    On,
    Stopped,
}

/// What is added to the numbers and times of this round's frames, and what the last one had.
#[derive(Clone, Copy, Debug, Default)]
struct Round {
    /// None before the round's first frame.
    added: Option<Added>,
    last_number: u64,
    last_capture_nanos: i64,
    last_source_number: u64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Added {
    number: u64,
    nanos: i64,
}

struct Publication {
    client: CaptureClient,
    source: TakeSource,
}

struct Player {
    channel: Channel,
    session: String,
    pacing: Pacing,
    begun: Instant,
    interrupt: Interrupt,
    bar: ProgressBar,
    publication: Option<Publication>,
    round: Round,
    n_late: u64,
}

impl Player {
    async fn play_all(&mut self, args: &PlayArgs, first: RecordedTake) -> anyhow::Result<()> {
        let mut take = first;
        loop {
            let flow = self.play(&mut take).await?;
            if self.round.added.is_none() {
                bail!("it has no frames");
            }
            if flow == Flow::Stopped || !args.repeat {
                return Ok(());
            }
            take = source::open(&args.take, Some(&self.channel)).await?;
            self.round.added = None;
        }
    }

    /// One round.
    async fn play(&mut self, take: &mut RecordedTake) -> anyhow::Result<Flow> {
        let mut source = None;
        while let Some(message) = take.next().await? {
            let frame = match message {
                RecordedMessage::Event(event) => {
                    if let Event::Source(it) = *event {
                        source = Some(it);
                    }
                    continue;
                }
                RecordedMessage::Frame(frame) => frame,
                RecordedMessage::Sample(_) => continue,
            };
            let Some(source) = &source else {
                bail!(
                    "frame {} comes before what says how it is to be read",
                    frame.number
                );
            };
            self.open(source).await?;
            if self.send(frame).await? == Flow::Stopped {
                return Ok(Flow::Stopped);
            }
        }
        Ok(Flow::On)
    }

    /// Publishes as this source did; another one's publication is finished first.
    async fn open(&mut self, source: &TakeSource) -> anyhow::Result<()> {
        if let Some(present) = &self.publication {
            if is_alike(&present.source, source) {
                return Ok(());
            }
            self.close().await?;
        }
        let settings = CaptureSettings {
            session: session_name(&self.session),
            publisher: default_publisher(),
            marker_names: source.marker_names.clone(),
            unit: source.unit(),
            rate_hz: source.rate_hz,
            // Every frame of a recording counts, and its pace is given here.
            ingest: proto::Ingest::Lossless,
            takeover: false,
        };
        let client = CaptureClient::start(self.channel.clone(), settings);
        let client = client.await.with_context(|| {
            format!("the session {} was not opened for publishing", self.session)
        })?;
        self.pacing.set_rate(source.rate_hz);
        self.publication = Some(Publication {
            client,
            source: source.clone(),
        });
        Ok(())
    }

    async fn close(&mut self) -> anyhow::Result<()> {
        if let Some(publication) = self.publication.take() {
            let published = publication.client.finish().await;
            if let Some(failure) = published.failure {
                return Err(failure.into());
            }
        }
        Ok(())
    }

    /// Hands a frame over when it is due.
    async fn send(&mut self, mut frame: proto::MarkerFrame) -> anyhow::Result<Flow> {
        let Some(publication) = &self.publication else {
            return Ok(Flow::On);
        };
        let period_nanos = 1e9 / publication.source.rate_hz;
        let next_expected = publication.client.started().next_expected;
        let is_first = self.round.added.is_none();
        let added = self
            .round
            .added
            .unwrap_or_else(|| self.round.first(&frame, next_expected, period_nanos));
        if is_first && added.number > 0 && self.round.last_number == 0 {
            self.bar.suspend(|| {
                eprintln!(
                    "the session has frames through {}: frames are numbered on from there",
                    next_expected.saturating_sub(1)
                );
            });
        }
        if !is_first && frame.number <= self.round.last_source_number {
            // It came too late to take part in the curves then, and would again.
            self.n_late += 1;
            return Ok(Flow::On);
        }
        self.round.last_source_number = frame.number;
        added.to(&mut frame);
        self.round = Round {
            added: Some(added),
            last_number: frame.number,
            last_capture_nanos: frame.capture_time_nanos,
            ..self.round
        };
        let due = self.begun + self.pacing.due(frame.capture_time_nanos);
        let sending = async {
            sleep_until(due).await;
            publication.client.send(frame).await
        };
        tokio::select! {
            // `finish` repeats the reason of a failure, with the counts.
            sent = sending => if sent.is_err() {
                return Ok(Flow::Stopped);
            },
            () = self.interrupt.wait() => return Ok(Flow::Stopped),
        }
        self.bar.inc(1);
        Ok(Flow::On)
    }

    /// Sends what is left and says what became of the frames.
    async fn finish(self, context: &Context, take: &str) -> anyhow::Result<ExitCode> {
        if self.n_late > 0 {
            eprintln!("{} frames that had come late were left out", self.n_late);
        }
        let Some(publication) = self.publication else {
            return Ok(ExitCode::FAILURE);
        };
        let published = publication.client.finish().await;
        let elapsed = self.begun.elapsed();
        publish_summary::print(context, &self.session, &published, elapsed, take)
    }
}

/// Whether frames of both are read alike.
fn is_alike(one: &TakeSource, other: &TakeSource) -> bool {
    let shape = |it: &TakeSource| (it.unit, it.marker_names.clone(), it.rate_hz.to_bits());
    shape(one) == shape(other)
}

impl Round {
    /// What has to be added, given the round's first frame and what the session expects.
    fn first(&self, frame: &proto::MarkerFrame, next_expected: u64, period_nanos: f64) -> Added {
        let is_again = self.last_number > 0;
        let next = if is_again {
            self.last_number.saturating_add(1)
        } else {
            next_expected
        };
        #[expect(
            clippy::cast_possible_truncation,
            reason = "saturates, which is enough"
        )]
        let next_nanos = self.last_capture_nanos.saturating_add(period_nanos as i64);
        Added {
            number: next.saturating_sub(frame.number),
            nanos: if is_again {
                next_nanos.saturating_sub(frame.capture_time_nanos)
            } else {
                0
            },
        }
    }
}

impl Added {
    fn to(self, frame: &mut proto::MarkerFrame) {
        if self.number > 0 && frame.source_frame == 0 {
            frame.source_frame = frame.number;
        }
        frame.number = frame.number.saturating_add(self.number);
        frame.capture_time_nanos = frame.capture_time_nanos.saturating_add(self.nanos);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(number: u64, capture_time_nanos: i64) -> proto::MarkerFrame {
        proto::MarkerFrame {
            number,
            capture_time_nanos,
            ..proto::MarkerFrame::default()
        }
    }

    #[test]
    fn a_new_session_gets_the_frames_as_they_are() {
        let mut first = frame(40, -7);
        Round::default().first(&first, 0, 1e7).to(&mut first);
        assert_eq!(first, frame(40, -7));
    }

    #[test]
    fn frames_are_numbered_on_where_the_session_is_further_and_in_the_next_round() {
        let mut first = frame(1, 5);
        Round::default().first(&first, 101, 1e7).to(&mut first);
        assert_eq!((first.number, first.source_frame), (101, 1));
        assert_eq!(first.capture_time_nanos, 5);
        let round = Round {
            last_number: 200,
            last_capture_nanos: 1_000_000_000,
            ..Round::default()
        };
        let mut again = frame(1, 5);
        round.first(&again, 101, 1e7).to(&mut again);
        assert_eq!((again.number, again.source_frame), (201, 1));
        assert_eq!(again.capture_time_nanos, 1_010_000_000);
    }
}
