//! A take whose contractions are known, and what an analysis makes of it.

use std::sync::Arc;

use frontalis_analysis::{
    analyzer::{MarkerAnalyzer, MarkerSettings},
    curve::CurveSample,
    face::{actor::Actor, marker::MarkerFrame},
    marker_analysis::alignment::Alignment,
    space::LengthUnit,
};

use super::curves::Curves;

/// Neutral frames at the start of every take, synthetic or real: twice what a session collects.
pub const N_NEUTRAL: usize = 30;

/// Marker frames, the neutral face first, and the contractions that made them.
#[derive(Clone)]
pub struct Take {
    /// Frames a second.
    pub rate_hz: f64,
    /// The unit that the capture declares.
    pub unit: LengthUnit,
    /// In order; every marker of the actor, in the actor's order.
    pub frames: Vec<MarkerFrame>,
    /// One row a frame.
    pub truth: Curves,
}

/// What an analysis made of a take.
pub struct Solution {
    /// One a frame.
    pub samples: Vec<CurveSample>,
    /// Where the performance lies on the actor.
    pub alignment: Alignment,
}

impl Take {
    /// Solves all frames in order.
    ///
    /// # Panics
    ///
    /// When the take cannot be aligned to the actor, or is shorter than the neutral frames that are wanted.
    pub fn solve(&self, actor: &Arc<Actor>, settings: &MarkerSettings) -> Solution {
        let mut analyzer =
            MarkerAnalyzer::new(Arc::clone(actor), settings.clone(), self.unit, self.rate_hz);
        let mut samples = Vec::new();
        for frame in &self.frames {
            analyzer.push(frame.clone(), &mut samples).unwrap();
        }
        assert_eq!(samples.len(), self.frames.len(), "one sample a frame");
        Solution {
            samples,
            alignment: analyzer.alignment().unwrap().clone(),
        }
    }

    /// The curves that these settings give.
    ///
    /// # Panics
    ///
    /// As [`Take::solve`].
    pub fn curves(&self, actor: &Arc<Actor>, settings: &MarkerSettings) -> Curves {
        Curves::of(&self.solve(actor, settings).samples)
    }
}
