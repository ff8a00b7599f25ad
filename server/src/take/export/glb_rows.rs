//! The actor's face, moved: one key of the animation a sample.

use frontalis_analysis::format::{actor_package::morph_mesh, glb::AnimationWriter};
use frontalis_proto::v1::{TakeExport, TakeFormat};
use serde_json::{Map, json};

use super::{
    ExportError, ExportSource, Outlet, Rows,
    entries::Entry,
    muscle_rows::{check_activations, in_turn},
    survey::Survey,
    turns::Turns,
};

/// Most keys: nine hours at 120 Hz. Their times stand before them and are held in memory.
pub(super) const MAX_KEYS: usize = 4_000_000;

pub(super) struct GlbRows {
    writer: AnimationWriter<Outlet>,
    n_muscles: usize,
    turns: Turns,
    n_written: u64,
}

impl GlbRows {
    pub(super) fn new(
        out: Outlet,
        survey: &Survey,
        source: &ExportSource,
        told: &TakeExport,
    ) -> Result<Self, ExportError> {
        if survey.times_s.is_empty() {
            return Err(ExportError::Empty { what: "sample" });
        }
        let actor = source.actor.as_ref().ok_or(ExportError::NoActor)?;
        let mesh = morph_mesh(actor);
        let about = json!({
            "name": source.take.name,
            "slate": source.take.slate,
            "number": source.take.number,
            "firstFrame": told.first_frame,
            "lastFrame": told.last_frame,
            "gaps": told.n_gaps,
            "missingFrames": told.n_missing_frames,
            "droppedFrames": told.n_dropped_frames,
        });
        let extras = Map::from_iter([("take".to_owned(), about)]);
        let (times_s, timecode) = (&survey.times_s, survey.start_timecode.as_ref());
        Ok(Self {
            writer: AnimationWriter::new(out, &mesh, extras, times_s, timecode)?,
            n_muscles: mesh.targets.len(),
            turns: Turns::of(TakeFormat::Glb),
            n_written: 0,
        })
    }
}

impl Rows for GlbRows {
    fn add(&mut self, entry: Entry) -> Result<(), ExportError> {
        let Some(sample) = in_turn(&mut self.turns, entry) else {
            return Ok(());
        };
        check_activations(&sample, self.n_muscles)?;
        self.writer.write_frame(&sample.activations)?;
        self.n_written += 1;
        Ok(())
    }

    fn n_written(&self) -> u64 {
        self.n_written
    }

    fn finish(self: Box<Self>) -> Result<(), ExportError> {
        self.writer.finish()?;
        Ok(())
    }
}
