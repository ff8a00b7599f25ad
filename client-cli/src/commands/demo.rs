//! `frontalis demo`: a server, an actor, a simulated capture and its live curves, all on this machine.

mod scoreboard;
mod server_process;
mod view;

use std::{net::SocketAddr, path::PathBuf, process::ExitCode, sync::Arc, time::Duration};

use anyhow::{Context as _, bail};
use clap::Args;
use frontalis_analysis::{face::actor::Actor, synthesis::reference_face};
use frontalis_client::{
    capture_client::{CaptureClient, Published},
    connection::Channel,
    curve_client::{CurveClient, CurveSettings, StartAt, Wanted},
    error::ClientError,
    proto,
    simulated_stage::{MAX_SECONDS, SimulatedStage, StageSettings},
};
use proto::session_service_client::SessionServiceClient;
use tokio::time::{MissedTickBehavior, interval, timeout};
use tokio_util::{sync::CancellationToken, task::AbortOnDropHandle};
use tonic::Code;

use self::{
    scoreboard::{Scoreboard, Summary},
    server_process::ServerProcess,
    view::View,
};
use super::{
    Context, actor, actor_name,
    interrupt::Interrupt,
    numbers, session_name,
    stage_run::{self, StageClock, StageRun},
};

const ACTOR: &str = "reference";
const SESSION: &str = "demo";
/// Bars are drawn and keys looked at so often.
const TICK: Duration = Duration::from_millis(33);
/// How long the last samples may take after the last frame.
const LAST_SAMPLES: Duration = Duration::from_secs(5);

/// Start a server and a simulated capture, and show the curves
#[derive(Debug, Args)]
#[command(after_help = "Example:
  frontalis demo --seconds 10     ends by itself with a summary")]
pub struct DemoArgs {
    /// Address of the demo's server
    #[arg(long, value_name = "ADDR", default_value = "127.0.0.1:7400")]
    listen: SocketAddr,
    /// Where the demo's server keeps its data
    #[arg(long, value_name = "DIR", default_value = "./demo-data")]
    data_dir: PathBuf,
    /// The server's program [default: frontalis-server beside this one]
    #[arg(long, value_name = "FILE")]
    server_bin: Option<PathBuf>,
    /// End after so many seconds; 0: go on until Ctrl-C
    #[arg(long, value_name = "N", env = "DEMO_SECONDS", default_value_t = 0.0, value_parser = numbers::not_negative)]
    seconds: f64,
    /// Frames a second: 30, 60, 120 or 240
    #[arg(long, value_name = "HZ", default_value_t = 60.0, value_parser = numbers::rate_hz)]
    rate: f64,
    /// The same seed gives the same performance
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
}

pub async fn run(context: &Context, args: DemoArgs) -> anyhow::Result<ExitCode> {
    // From here on Ctrl-C ends the demo in order instead of cutting it.
    let mut interrupt = Interrupt::listen()?;
    let mut server =
        ServerProcess::start(&args.listen, &args.data_dir, args.server_bin.as_deref())?;
    let shown = show(context, &args, &mut server, &mut interrupt).await;
    let stopped = server.stop().await;
    if let Some(summary) = shown? {
        summary.print(context)?;
    }
    stopped?;
    Ok(ExitCode::SUCCESS)
}

/// The whole demo against a server that is starting; no summary when it was stopped before it began.
async fn show(
    context: &Context,
    args: &DemoArgs,
    server: &mut ServerProcess,
    interrupt: &mut Interrupt,
) -> anyhow::Result<Option<Summary>> {
    let begun = tokio::select! {
        begun = begin(args, server) => begun?,
        () = interrupt.wait() => return Ok(None),
    };
    let (channel, mut run) = begun;
    run.watch(context, server, interrupt).await?;
    // A second Ctrl-C does not wait for the last samples.
    tokio::select! {
        summary = run.end(channel) => summary.map(Some),
        () = interrupt.wait() => Ok(None),
    }
}

/// Waits for the server and sets everything going.
async fn begin(args: &DemoArgs, server: &mut ServerProcess) -> anyhow::Result<(Channel, Run)> {
    let channel = server.wait_until_ready().await?;
    let reference = Arc::new(reference_face::actor());
    prepare(channel.clone(), &reference).await?;
    let run = Run::begin(channel.clone(), reference, args).await?;
    Ok((channel, run))
}

/// Imports the actor when it is missing, and begins a fresh session.
async fn prepare(channel: Channel, reference: &Actor) -> anyhow::Result<()> {
    match actor::get(channel.clone(), ACTOR).await {
        Ok(_) => {}
        Err(error) if error.code == Code::NotFound => {
            let start = proto::ImportActorStart {
                actor_id: ACTOR.to_owned(),
                ..proto::ImportActorStart::default()
            };
            let package = actor::PackageForm::Zip.write(reference);
            actor::import(channel.clone(), start, package)
                .await
                .context("the reference actor was not imported")?;
        }
        Err(error) => return Err(error.into()),
    }
    let mut sessions = SessionServiceClient::new(channel);
    let request = proto::CreateSessionRequest {
        session_id: SESSION.to_owned(),
        actor: actor_name(ACTOR),
        kind: proto::CaptureKind::Markers.into(),
        ..proto::CreateSessionRequest::default()
    };
    let created = sessions.create_session(request.clone()).await;
    if created.is_err_and(|it| it.code() == Code::AlreadyExists) {
        // Left by a demo that was killed.
        let name = session_name(SESSION);
        let end = proto::EndSessionRequest { name };
        sessions.end_session(end).await.map_err(ClientError::from)?;
        sessions
            .create_session(request)
            .await
            .map_err(ClientError::from)?;
    }
    Ok(())
}

/// The two ends of the demo: a stage that publishes, a subscriber that receives.
struct Run {
    stop: CancellationToken,
    stage: AbortOnDropHandle<(StageRun, Published)>,
    curves: CurveClient,
    scoreboard: Arc<Scoreboard>,
}

impl Run {
    async fn begin(channel: Channel, actor: Arc<Actor>, args: &DemoArgs) -> anyhow::Result<Self> {
        let scoreboard = Arc::new(Scoreboard::default());
        let wanted = Wanted::EveryFrame { from: StartAt::Now };
        let settings = CurveSettings {
            subscriber: "frontalis demo".to_owned(),
            ..CurveSettings::new(session_name(SESSION), wanted)
        };
        let curves = CurveClient::subscribe(channel.clone(), settings).await?;
        let settings = stage_run::capture_settings(
            session_name(SESSION),
            "frontalis-demo".to_owned(),
            &actor,
            args.rate,
        );
        let stage = SimulatedStage::new(actor, stage_settings(args))?;
        let publication = CaptureClient::start(channel, settings).await?;
        let stop = CancellationToken::new();
        let stage = tokio::spawn(publish(
            publication,
            stage,
            args.rate,
            stop.clone(),
            Arc::clone(&scoreboard),
        ));
        Ok(Self {
            stop,
            stage: AbortOnDropHandle::new(stage),
            curves,
            scoreboard,
        })
    }

    /// Shows the curves until the stage is done or somebody wants to stop.
    async fn watch(
        &mut self,
        context: &Context,
        server: &mut ServerProcess,
        interrupt: &mut Interrupt,
    ) -> anyhow::Result<()> {
        let mut view = View::choose(context, server.url(), SESSION)?;
        let mut tick = interval(TICK);
        tick.set_missed_tick_behavior(MissedTickBehavior::Skip);
        loop {
            tokio::select! {
                event = self.curves.next() => match event? {
                    Some(event) => {
                        self.scoreboard.take(&event);
                        view.take(event)?;
                    }
                    None => bail!("the session was ended by somebody else"),
                },
                _ = tick.tick() => {
                    server.check_running()?;
                    if view.tick()? || self.stage.is_finished() {
                        return Ok(());
                    }
                }
                () = interrupt.wait() => return Ok(()),
            }
        }
    }

    /// Stops the stage, waits for the last samples, ends the session.
    async fn end(mut self, channel: Channel) -> anyhow::Result<Summary> {
        self.stop.cancel();
        let (run, published) = (&mut self.stage)
            .await
            .context("the stage stopped by itself")?;
        if let Some(failure) = published.failure {
            return Err(anyhow::Error::new(failure).context("publishing was ended"));
        }
        let waiting = async {
            while self.scoreboard.received() < published.report.accepted_frames {
                match self.curves.next().await {
                    Ok(Some(event)) => self.scoreboard.take(&event),
                    Ok(None) | Err(_) => break,
                }
            }
        };
        // Frames that became gaps never arrive; the summary shows both counts.
        drop(timeout(LAST_SAMPLES, waiting).await);
        let request = proto::EndSessionRequest {
            name: session_name(SESSION),
        };
        SessionServiceClient::new(channel)
            .end_session(request)
            .await
            .map_err(ClientError::from)?;
        Ok(self.scoreboard.summary(&run, &published.report))
    }
}

/// The performance: of the length that was asked for, or of a day.
fn stage_settings(args: &DemoArgs) -> StageSettings {
    StageSettings {
        rate_hz: args.rate,
        seconds: if args.seconds > 0.0 {
            args.seconds
        } else {
            MAX_SECONDS
        },
        seed: args.seed,
        ..StageSettings::default()
    }
}

async fn publish(
    publication: CaptureClient,
    stage: SimulatedStage,
    rate_hz: f64,
    stop: CancellationToken,
    scoreboard: Arc<Scoreboard>,
) -> (StageRun, Published) {
    let clock = StageClock::default();
    let run = stage_run::run(
        &publication,
        &clock,
        stage,
        rate_hz,
        stop.cancelled(),
        |frame| {
            scoreboard.published(frame);
        },
    )
    .await;
    (run, publication.finish().await)
}
