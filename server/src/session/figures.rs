//! What a session knows about itself: settings in use, alignment, ranges, doubt and times. Written by its task, read by
//! status.

use std::sync::Arc;

use frontalis_analysis::{
    curve::CurveSample,
    face::{actor::Actor, muscle::Muscle},
    marker_analysis::{alignment::Alignment, neutral_watch::NeutralDoubt, range::MuscleRange},
};

use super::{
    settings::{SessionSettings, SessionSpec},
    status::{AlignmentReport, ControlRange, SessionStatus, StageLatency},
};
use crate::hub::Times;

/// A session's knowledge about itself.
#[derive(Debug)]
pub(super) struct Figures {
    pub(super) settings: SessionSettings,
    pub(super) actor: Arc<Actor>,
    pub(super) actor_revision: u32,
    pub(super) nominal_rate_hz: f64,
    pub(super) alignment: Option<AlignmentReport>,
    pub(super) alignment_problem: Option<&'static str>,
    pub(super) unknown_markers: Vec<String>,
    pub(super) judgement: Judgement,
    ranges: Vec<(f64, f64)>,
    stages: [Times; 4],
}

/// What the performance so far says of the basis and of the neutral face.
#[derive(Debug, Default)]
pub(super) struct Judgement {
    /// One a muscle, in the actor's order; empty before the alignment.
    pub(super) ranges: Vec<MuscleRange>,
    pub(super) neutral_doubt: Option<NeutralDoubt>,
}

/// When a frame passed each station, server clock, nanoseconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage {
    pub(super) received: i64,
    pub(super) started: i64,
    pub(super) solved: i64,
    pub(super) published: i64,
}

const STAGES: [&str; 4] = ["queued", "solved", "published", "total"];

impl Figures {
    pub(super) fn new(spec: &SessionSpec) -> Self {
        let restored = spec.restored.as_ref();
        Self {
            settings: spec.settings.clone(),
            actor: Arc::clone(&spec.actor),
            actor_revision: spec.actor_revision,
            nominal_rate_hz: 0.0,
            alignment: restored.map(|it| report(&it.alignment)),
            alignment_problem: None,
            unknown_markers: Vec::new(),
            judgement: Judgement::default(),
            ranges: Vec::new(),
            stages: Default::default(),
        }
    }

    /// A publisher began.
    pub(super) fn granted(&mut self, rate_hz: f64, unknown_markers: Vec<String>) {
        self.nominal_rate_hz = rate_hz;
        self.unknown_markers = unknown_markers;
        self.alignment_problem = None;
    }

    pub(super) fn changed(
        &mut self,
        settings: SessionSettings,
        actor: Arc<Actor>,
        actor_revision: u32,
    ) {
        self.settings = settings;
        self.actor = actor;
        self.actor_revision = actor_revision;
    }

    pub(super) fn fill(&self, status: &mut SessionStatus) {
        status.alignment = self.alignment;
        status.alignment_problem = self.alignment_problem;
        status.latencies = self.latencies();
        status.actor_revision = self.actor_revision;
        status.ranges = self.ranges();
        status.neutral_doubt = self.judgement.neutral_doubt;
        status.unknown_markers.clone_from(&self.unknown_markers);
    }

    pub(super) fn aligned(&mut self, alignment: &Alignment) {
        self.alignment = Some(report(alignment));
        self.alignment_problem = None;
    }

    pub(super) fn sampled(&mut self, sample: &CurveSample) {
        self.ranges
            .resize(sample.activations.len(), (f64::INFINITY, f64::NEG_INFINITY));
        for ((min, max), x) in self.ranges.iter_mut().zip(&sample.activations) {
            *min = min.min(*x);
            *max = max.max(*x);
        }
    }

    pub(super) fn passed(&mut self, passage: Passage) {
        let [queued, solved, published, total] = &mut self.stages;
        queued.add(passage.started - passage.received);
        solved.add(passage.solved - passage.started);
        published.add(passage.published - passage.solved);
        total.add(passage.published - passage.received);
    }

    fn latencies(&self) -> Vec<StageLatency> {
        let latency = |(stage, times): (&'static str, &Times)| StageLatency {
            stage,
            latency: times.latency(),
        };
        STAGES.into_iter().zip(&self.stages).map(latency).collect()
    }

    fn ranges(&self) -> Vec<ControlRange> {
        let muscles = self.actor.muscle_set().muscles().iter();
        let range = |(muscle_idx, (muscle, (min, max))): (usize, (&Muscle, &(f64, f64)))| {
            let mut judged = self.judgement.ranges.iter();
            ControlRange {
                control: muscle.name.clone(),
                min: *min,
                max: *max,
                judged: judged.find(|it| it.muscle == muscle_idx).copied(),
            }
        };
        muscles.zip(&self.ranges).enumerate().map(range).collect()
    }
}

fn report(alignment: &Alignment) -> AlignmentReport {
    AlignmentReport {
        scale: alignment.model_from_performance.scale,
        rms_residual_cm: alignment.rms_residual_cm,
        iterations: alignment.iterations,
        n_markers: alignment.n_markers(),
    }
}
