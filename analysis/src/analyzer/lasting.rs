//! What an analyzer knows between two frames, as plain numbers: from them another one goes on with the same bits.
//!
//! The alignment, the actor, the settings and the rate are the caller's to keep. What only judges a performance, ranges and
//! doubt, is not kept: no curve depends on it.

use std::sync::Arc;

use super::{MarkerAnalyzer, MarkerSettings, Solving, Stage, UNUSABLE_FRAMES_KEPT};
use crate::{
    face::{
        actor::Actor,
        marker::{FrameIndex, MarkerFrame},
    },
    marker_analysis::{alignment::Alignment, positions_on_tape},
    numeric::tape::{Entry, Tape, TapeError},
    space::LengthUnit,
};

const WAITING: u64 = 0;
const COLLECTING: u64 = 1;
const SOLVING: u64 = 2;

impl MarkerAnalyzer {
    /// All that the next frames depend on, beside [`Self::alignment`] and what the analyzer was made from.
    pub fn state(&mut self) -> Vec<Entry> {
        let mut tape = Tape::blank();
        // Only what is read can be wrong.
        let _written = self.lasts(&mut tape);
        tape.into_entries()
    }

    /// An analyzer that goes on from `state`, bit for bit as the one that was asked for it: of the same actor, settings, unit,
    /// rate and alignment.
    ///
    /// # Errors
    ///
    /// [`TapeError`] when the state is not one of such an analyzer.
    pub fn restore(
        actor: Arc<Actor>,
        settings: MarkerSettings,
        unit: LengthUnit,
        rate_hz: f64,
        alignment: Option<Alignment>,
        state: Vec<Entry>,
    ) -> Result<Self, TapeError> {
        let mut analyzer = match alignment {
            Some(it) => Self::resume(actor, settings, unit, rate_hz, it),
            None => Self::new(actor, settings, unit, rate_hz),
        };
        let mut tape = Tape::recorded(state);
        analyzer.lasts(&mut tape)?;
        tape.end()?;
        Ok(analyzer)
    }

    fn lasts(&mut self, tape: &mut Tape) -> Result<(), TapeError> {
        let n_markers = self.actor.markers().len();
        let limit = self.settings.neutral_frames.max(1) + UNUSABLE_FRAMES_KEPT;
        let mut stage = match &self.stage {
            Stage::Waiting => WAITING,
            Stage::Collecting(_) => COLLECTING,
            Stage::Solving(_) => SOLVING,
        };
        let is_aligned = stage == SOLVING;
        tape.integer("stage", &mut stage)?;
        if tape.is_read() && !is_aligned {
            self.stage = match stage {
                WAITING => Stage::Waiting,
                COLLECTING => Stage::Collecting(Vec::new()),
                _ => return Err(tape.wrong("stage")),
            };
        }
        match &mut self.stage {
            Stage::Waiting => Ok(()),
            Stage::Collecting(frames) => tape.within("neutral", |tape| {
                frames_last(frames, tape, n_markers, limit)
            }),
            Stage::Solving(_) if stage != SOLVING => Err(tape.wrong("stage")),
            Stage::Solving(solving) => solving.lasts(tape, n_markers, limit),
        }
    }
}

impl Solving {
    fn lasts(&mut self, tape: &mut Tape, n_markers: usize, limit: usize) -> Result<(), TapeError> {
        tape.small("held_frames", &mut self.held_frames)?;
        tape.maybe_integer("last_frame", &mut self.last_index)?;
        let mut is_recentering = self.recentering.is_some();
        tape.flag("is_recentering", &mut is_recentering)?;
        if is_recentering {
            let frames = self.recentering.get_or_insert_default();
            tape.within("neutral", |tape| {
                frames_last(frames, tape, n_markers, limit)
            })?;
        }
        tape.within("solver", |tape| self.solver.lasts(tape))
    }
}

/// Names frames that are kept.
fn frames_last(
    frames: &mut Vec<MarkerFrame>,
    tape: &mut Tape,
    n_markers: usize,
    limit: usize,
) -> Result<(), TapeError> {
    let mut n_frames = frames.len() as u64;
    tape.integer("n_frames", &mut n_frames)?;
    if tape.is_read() {
        if n_frames > limit as u64 {
            return Err(tape.wrong("n_frames"));
        }
        let nothing = MarkerFrame {
            index: FrameIndex(0),
            capture_time_nanos: 0,
            positions: vec![None; n_markers],
        };
        *frames = (0..n_frames).map(|_| nothing.clone()).collect();
    }
    for frame in frames {
        let mut times = [frame.index.0, frame.capture_time_nanos.cast_unsigned()];
        tape.integers("number_and_time", &mut times)?;
        frame.index = FrameIndex(times[0]);
        frame.capture_time_nanos = times[1].cast_signed();
        positions_on_tape::last(&mut frame.positions, tape)?;
    }
    Ok(())
}
