//! Solving a take again, into a new one (CONTRACTS U-13).
//!
//! A take begins with what its session's analysis knew, and holds in their order the frames that came and the requests that
//! changed how they were solved. They are gone through again by [`Reenactment`], which is the session's own way: the same build
//! gives the same bits. What was shed stays so. Another revision or other settings are put in force before the first frame and
//! hold throughout.

mod incoming;
mod outgoing;

use std::{
    io,
    path::{Path, PathBuf},
    sync::Arc,
};

use frontalis_analysis::{face::actor::Actor, numeric::tape::TapeError};
use frontalis_proto::v1::{self, take_event::Event};

use self::{
    incoming::{Incoming, Item, RecordedFrame},
    outgoing::NewTake,
};
use super::{TakeFigures, TakeReader, file_name, rewrite::TakeFileError};
use crate::{
    fs::{Fs, TEMPORARY_SUFFIX},
    hub::{Gap, GapCause},
    name::TakeId,
    session::{Reenactment, SessionSettings, StartingPoint, StreamPoint, StreamShape},
    wire::{
        analysis_state::{self, alignment_to_wire, stream_shape},
        capture,
        invalid::FieldError,
        session::{apply, check_objective, effective, neutral_source, of_effective},
    },
};

/// Frames and events of one step: a few milliseconds of work.
const ITEMS_PER_STEP: usize = 512;

/// Why a take is not solved again.
#[derive(Debug, thiserror::Error)]
pub enum ResolveError {
    /// Its file cannot be read, or the new one not written.
    #[error(transparent)]
    File(#[from] TakeFileError),
    /// Its file does not begin with a header.
    #[error("the file of the take has no header")]
    NoHeader,
    /// What it begins with is not for this actor and these settings.
    #[error("what the take begins with cannot be gone on from")]
    State(#[from] TapeError),
    /// A field of its file, or of the request, cannot be used.
    #[error(transparent)]
    Field(#[from] FieldError),
}

impl From<io::Error> for ResolveError {
    fn from(error: io::Error) -> Self {
        Self::File(error.into())
    }
}

/// A take whose beginning has been read.
pub struct TakeToResolve {
    incoming: Incoming,
    header: v1::TakeHeader,
    point: StartingPoint,
}

/// What a take is solved into.
pub struct ResolveTarget {
    /// The new take.
    pub take: TakeId,
    /// The take that it is solved from.
    pub from: TakeId,
    /// The actor, in the revision that the take begins with.
    pub recorded_actor: Arc<Actor>,
    /// Another revision to be used throughout.
    pub other_revision: Option<(Arc<Actor>, u32)>,
    /// Of the package of the revision that is used at the start, in hexadecimal digits.
    pub package_sha256: String,
    /// Settings that differ from the recorded ones; absent fields are as recorded.
    pub asked: v1::SessionSettings,
}

/// How a step ended.
#[derive(Debug)]
pub enum Advance {
    /// There is more.
    More {
        /// Frames that were gone through so far.
        frames_done: u64,
    },
    /// The frames that follow need another revision of the actor: [`Resolve::give_actor`].
    NeedsActor {
        /// Which one.
        revision: u32,
    },
    /// The new take is complete.
    Over(Resolved),
}

/// A take that was solved again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolved {
    /// What it holds.
    pub figures: TakeFigures,
    /// Length of its file.
    pub n_bytes: u64,
}

impl TakeToResolve {
    /// Opens the take `id` in `dir`, of which `n_bytes` are on stable storage, and reads what it begins with.
    ///
    /// # Errors
    ///
    /// [`ResolveError`] when it is damaged, or a newer server wrote it.
    pub fn open(fs: &dyn Fs, dir: &Path, id: &TakeId, n_bytes: u64) -> Result<Self, ResolveError> {
        let reader = TakeReader::open(fs, &dir.join(file_name(id)), n_bytes)?;
        let mut incoming = Incoming::start(reader)?;
        let header = incoming.header.take().ok_or(ResolveError::NoHeader)?;
        let point = match incoming.state.take() {
            Some(state) => analysis_state::starting_point(state)?,
            None => at_rest(&header)?,
        };
        Ok(Self {
            incoming,
            header,
            point,
        })
    }

    /// The revision that its first frame was solved with.
    pub fn actor_revision(&self) -> u32 {
        self.point.actor_revision
    }

    /// Starts the new take in a temporary file in `dir`.
    ///
    /// # Errors
    ///
    /// [`ResolveError`] when the settings do not suit the actor, or the file cannot be made.
    pub fn begin(
        self,
        fs: Arc<dyn Fs>,
        dir: PathBuf,
        target: ResolveTarget,
    ) -> Result<Resolve, ResolveError> {
        let file = dir.join(file_name(&target.take));
        let temporary = dir.join(format!("{}{TEMPORARY_SUFFIX}", file_name(&target.take)));
        let pre_roll = pre_roll(&self.header, &self.point, &target.recorded_actor)?;
        let shape = self.point.stream.as_ref().map(|it| it.shape.clone());
        let last_capture_nanos = self.header.last_capture_time_nanos;
        let actor = Arc::clone(&target.recorded_actor);
        let reenactment = Reenactment::start(actor, self.point, last_capture_nanos)?;
        let mut resolve = Resolve {
            incoming: self.incoming,
            new: NewTake::create(&*fs, &temporary)?,
            fs,
            dir,
            file,
            temporary,
            reenactment,
            pre_roll,
            next_frame: self.header.next_frame,
            last_taken: first_number(&self.header).saturating_sub(1),
            shape,
            asked: target.asked,
            other_revision: target.other_revision,
            given_actor: None,
            halted: None,
            frames_done: 0,
            stop_time: None,
        };
        resolve.put_in_force()?;
        let actor = Arc::clone(resolve.reenactment.actor());
        let point = resolve.reenactment.starting_point();
        let muscles = actor.muscle_set().muscles().iter();
        let header = v1::TakeHeader {
            take: target.take.resource(),
            resolved_from: target.from.resource(),
            actor_revision: point.actor_revision,
            package_sha256: target.package_sha256,
            settings: Some(effective(&point.settings)),
            controls: muscles.map(|it| it.name.clone()).collect(),
            markers: actor.markers().iter().map(|it| it.name.clone()).collect(),
            next_sequence: 1,
            server_version: env!("CARGO_PKG_VERSION").to_owned(),
            ..self.header
        };
        resolve.new.at(unix_nanos(header.start_time.as_ref()));
        resolve.new.add_event(Event::Header(header))?;
        let state = analysis_state::to_wire(&point);
        resolve.new.add_event(Event::AnalysisState(state))?;
        Ok(resolve)
    }
}

/// Of a take that says nothing of its beginning: as a new session.
fn at_rest(header: &v1::TakeHeader) -> Result<StartingPoint, FieldError> {
    Ok(StartingPoint {
        settings: of_effective(&header.settings.clone().unwrap_or_default())?,
        actor_revision: header.actor_revision,
        alignment: None,
        stream: None,
        is_recentering: false,
        giving_up: None,
        n_scale_jumps: 0,
    })
}

fn first_number(header: &v1::TakeHeader) -> u64 {
    match header.pre_roll_from {
        0 => header.next_frame,
        first => first.min(header.next_frame),
    }
}

/// What frames before the beginning are solved by: the alignment, and nothing of what came before them.
fn pre_roll(
    header: &v1::TakeHeader,
    point: &StartingPoint,
    actor: &Arc<Actor>,
) -> Result<Option<Reenactment>, TapeError> {
    let Some(StreamPoint { shape, rate_hz, .. }) = &point.stream else {
        return Ok(None);
    };
    if header.pre_roll_from == 0 {
        return Ok(None);
    }
    let bare = StartingPoint {
        stream: None,
        is_recentering: false,
        giving_up: None,
        n_scale_jumps: 0,
        ..point.clone()
    };
    let mut reenactment = Reenactment::start(Arc::clone(actor), bare, None)?;
    reenactment.source(shape.clone(), *rate_hz, false);
    Ok(Some(reenactment))
}

fn unix_nanos(time: Option<&frontalis_proto::Timestamp>) -> u64 {
    let nanos = time.map_or(0, |it| {
        (it.seconds.saturating_mul(1_000_000_000)).saturating_add(it.nanos.into())
    });
    u64::try_from(nanos).unwrap_or(0)
}

/// A take that is being solved again. Dropped before its end, it leaves its temporary file to be removed.
pub struct Resolve {
    incoming: Incoming,
    new: NewTake,
    fs: Arc<dyn Fs>,
    dir: PathBuf,
    file: PathBuf,
    temporary: PathBuf,
    reenactment: Reenactment,
    /// Until the first frame that is no pre-roll.
    pre_roll: Option<Reenactment>,
    next_frame: u64,
    last_taken: u64,
    /// How frames are read.
    shape: Option<StreamShape>,
    asked: v1::SessionSettings,
    other_revision: Option<(Arc<Actor>, u32)>,
    given_actor: Option<(Arc<Actor>, u32)>,
    /// A change that waits for its actor.
    halted: Option<(u64, v1::TakeChange)>,
    frames_done: u64,
    stop_time: Option<frontalis_proto::Timestamp>,
}

impl Resolve {
    /// Whether everything is solved as it was.
    fn is_as_recorded(&self) -> bool {
        self.other_revision.is_none() && self.asked == v1::SessionSettings::default()
    }

    /// Puts what is asked for in force before the first frame.
    fn put_in_force(&mut self) -> Result<(), ResolveError> {
        if self.is_as_recorded() {
            return Ok(());
        }
        for reenactment in [Some(&mut self.reenactment), self.pre_roll.as_mut()] {
            let Some(reenactment) = reenactment else {
                continue;
            };
            let (actor, revision) = self.other_revision.clone().unwrap_or_else(|| {
                let revision = reenactment.actor_revision();
                (Arc::clone(reenactment.actor()), revision)
            });
            let settings = wanted(&self.asked, reenactment.settings(), &actor)?;
            reenactment.change(settings, actor, revision);
        }
        Ok(())
    }

    /// The revision that was asked for by [`Advance::NeedsActor`].
    pub fn give_actor(&mut self, actor: Arc<Actor>, revision: u32) {
        self.given_actor = Some((actor, revision));
    }

    /// Goes a step on. The samples say that they were solved at `now_nanos`, server clock.
    ///
    /// # Errors
    ///
    /// [`ResolveError`]; the new take is then of no use.
    pub fn advance(mut self, now_nanos: i64) -> Result<(Option<Self>, Advance), ResolveError> {
        if let Some((time_nanos, change)) = self.halted.take() {
            if let Some(revision) = self.change(time_nanos, change)? {
                return Ok((Some(self), Advance::NeedsActor { revision }));
            }
            self.write_outgoing(now_nanos)?;
        }
        for _ in 0..ITEMS_PER_STEP {
            let Some(item) = self.incoming.next()? else {
                return Ok((None, Advance::Over(self.finish(now_nanos)?)));
            };
            match item {
                Item::Frame(frame) => self.frame(&frame)?,
                Item::Event { time_nanos, event } => {
                    if let Some(revision) = self.event(time_nanos, *event)? {
                        return Ok((Some(self), Advance::NeedsActor { revision }));
                    }
                }
            }
            self.write_outgoing(now_nanos)?;
        }
        let frames_done = self.frames_done;
        Ok((Some(self), Advance::More { frames_done }))
    }

    fn frame(&mut self, recorded: &RecordedFrame) -> Result<(), ResolveError> {
        let number = recorded.frame.number;
        self.frames_done += 1;
        self.new.at(recorded.time_nanos);
        self.new.add_frame(&recorded.frame, &recorded.data)?;
        if number <= self.last_taken {
            // Late: it took no part then, and takes none now.
            return Ok(());
        }
        self.last_taken = number;
        let gaps_before = self.incoming.gaps_before(number);
        let is_shed = self.incoming.is_shed(number);
        if number >= self.next_frame {
            self.end_pre_roll()?;
        }
        let reenactment = self.pre_roll.as_mut().unwrap_or(&mut self.reenactment);
        let frame = self
            .shape
            .as_ref()
            .and_then(|it| capture::recorded_frame(&recorded.frame, it).ok());
        let Some(mut frame) = frame else {
            // It was taken, so it is one; if it were not, it must not be silent.
            reenactment.gaps(gaps_before);
            reenactment.gaps(vec![Gap::of_frame(number, GapCause::Rejected)]);
            return Ok(());
        };
        reenactment.pass_time(&mut frame);
        if is_shed {
            reenactment.gaps(gaps_before);
            reenactment.gaps(vec![Gap::of_frame(number, GapCause::Shed)]);
        } else {
            reenactment.frame(frame, gaps_before);
        }
        Ok(())
    }

    fn end_pre_roll(&mut self) -> Result<(), ResolveError> {
        if let Some(mut pre_roll) = self.pre_roll.take() {
            pre_roll.finish();
            for outgoing in pre_roll.outgoing(0) {
                self.new.add_outgoing(outgoing)?;
            }
        }
        Ok(())
    }

    /// Returns the revision that has to be given first.
    fn event(&mut self, time_nanos: u64, event: Event) -> Result<Option<u32>, ResolveError> {
        self.new.at(time_nanos);
        match event {
            Event::Source(source) => self.source(source)?,
            Event::Change(change) => return self.change(time_nanos, change),
            Event::Recenter(recenter) => {
                self.reenactment.recenter(neutral_source(recenter.source)?);
                self.new.add_event(Event::Recenter(recenter))?;
            }
            Event::Clock(clock) => {
                if let Some(report) = capture::recorded_clock(&clock) {
                    self.reenactment.clock(report);
                }
                self.new.add_event(Event::Clock(clock))?;
            }
            Event::Stop(stop) => self.stop_time = stop.stop_time,
            other => self.new.add_event(other)?,
        }
        Ok(None)
    }

    fn source(&mut self, source: v1::TakeSource) -> Result<(), ResolveError> {
        let shape = stream_shape(source.clone())?;
        // One that went on is part of what the take begins with.
        if !source.continued || self.shape.is_none() {
            let (rate_hz, is_other) = (source.rate_hz, source.is_other);
            self.reenactment.source(shape.clone(), rate_hz, is_other);
        }
        self.shape = Some(shape);
        Ok(self.new.add_event(Event::Source(source))?)
    }

    fn change(
        &mut self,
        time_nanos: u64,
        change: v1::TakeChange,
    ) -> Result<Option<u32>, ResolveError> {
        let recorded = (change.actor_revision == self.reenactment.actor_revision())
            .then(|| (Arc::clone(self.reenactment.actor()), change.actor_revision));
        let given = (self.given_actor.take()).filter(|(_, it)| *it == change.actor_revision);
        let used = self.other_revision.clone().or(recorded).or(given);
        let Some((actor, revision)) = used else {
            let revision = change.actor_revision;
            self.halted = Some((time_nanos, change));
            return Ok(Some(revision));
        };
        let recorded = of_effective(&change.settings.unwrap_or_default())?;
        let settings = wanted(&self.asked, &recorded, &actor)?;
        self.new.add_event(Event::Change(v1::TakeChange {
            actor_revision: revision,
            settings: Some(effective(&settings)),
        }))?;
        self.reenactment.change(settings, actor, revision);
        Ok(None)
    }

    fn write_outgoing(&mut self, now_nanos: i64) -> Result<(), ResolveError> {
        let reenactment = self.pre_roll.as_mut().unwrap_or(&mut self.reenactment);
        for outgoing in reenactment.outgoing(now_nanos) {
            self.new.add_outgoing(outgoing)?;
        }
        if let Some((aligned, revision)) = reenactment.new_alignment() {
            let event = alignment_to_wire(&aligned.alignment, &aligned.shape, revision);
            self.new.add_event(Event::Alignment(event))?;
        }
        Ok(())
    }

    /// Puts the new take in its place: it survives a power cut when this returns.
    fn finish(mut self, now_nanos: i64) -> Result<Resolved, ResolveError> {
        self.end_pre_roll()?;
        let trailing = self.incoming.gaps_before(u64::MAX);
        self.reenactment.gaps(trailing);
        self.reenactment.finish();
        self.write_outgoing(now_nanos)?;
        let figures = self.new.figures;
        self.new.add_event(Event::Stop(v1::TakeStop {
            stop_time: self.stop_time,
            n_frames: figures.n_frames,
            n_samples: figures.n_samples,
        }))?;
        let n_bytes = self.new.finish()?;
        self.fs.rename(&self.temporary, &self.file)?;
        self.fs.sync_dir(&self.dir)?;
        Ok(Resolved { figures, n_bytes })
    }
}

/// The recorded settings with what is asked for.
fn wanted(
    asked: &v1::SessionSettings,
    recorded: &SessionSettings,
    actor: &Actor,
) -> Result<SessionSettings, FieldError> {
    let settings = apply(asked, &[], recorded)?;
    check_objective(&settings, actor.muscle_set())?;
    Ok(settings)
}
