//! Curves as the app Live Link Face writes them, one row a sample.

use frontalis_analysis::{
    format::live_link::{LiveLinkWriter, ShapeMapping},
    space::HeadPose,
};
use frontalis_proto::v1::{self, TakeFormat};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{
    ExportError, Outlet, Rows,
    entries::Entry,
    muscle_rows::{check_activations, in_turn},
    row_clock::RowClock,
    survey::Survey,
    turns::Turns,
};
use crate::wire::common;

pub(super) struct LiveLinkRows {
    writer: LiveLinkWriter<Outlet>,
    mapping: ShapeMapping,
    n_muscles: usize,
    clock: RowClock,
    turns: Turns,
    n_written: u64,
}

impl LiveLinkRows {
    pub(super) fn new(out: Outlet, survey: &Survey) -> Result<Self, ExportError> {
        let controls = survey.controls()?;
        let rate_hz = survey.columns.rate_hz();
        Ok(Self {
            writer: LiveLinkWriter::new(out)?,
            mapping: ShapeMapping::of_names(controls.iter().map(String::as_str)),
            n_muscles: controls.len(),
            clock: RowClock::new(survey.start_timecode, survey.start_nanos, rate_hz),
            turns: Turns::of(TakeFormat::LiveLinkCsv),
            n_written: 0,
        })
    }

    /// Shapes that are 0 throughout.
    pub(super) fn undriven(&self) -> Vec<String> {
        self.mapping.undriven().map(str::to_owned).collect()
    }
}

impl Rows for LiveLinkRows {
    fn add(&mut self, entry: Entry) -> Result<(), ExportError> {
        let Some(sample) = in_turn(&mut self.turns, entry) else {
            return Ok(());
        };
        check_activations(&sample, self.n_muscles)?;
        let own = sample.timecode.as_ref().and_then(common::timecode);
        let timecode = self.clock.at(own, sample.capture_time_nanos);
        let shapes = self.mapping.shapes(&sample.activations);
        let head = sample.head.as_ref().map(head_pose);
        self.writer.write_row(&timecode, &shapes, head.as_ref())?;
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

fn head_pose(sent: &v1::HeadPose) -> HeadPose {
    let [x, y, z, w] = [sent.qx, sent.qy, sent.qz, sent.qw].map(f64::from);
    let translation_cm = [sent.tx_cm, sent.ty_cm, sent.tz_cm].map(f64::from);
    HeadPose {
        rotation: UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)),
        translation_cm: Vector3::from(translation_cm),
    }
}
