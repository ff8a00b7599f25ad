//! A performance of the reference face with known curves, as a capture system would stream it.

use frontalis_analysis::face::{actor::Actor, basis::MarkerBasis};
use frontalis_client::capture_client::CaptureSettings;
use frontalis_proto::v1::{Ingest, LengthUnit, MarkerFrame, PublishStart};

/// Neutral frames at the start: more than a session collects by default.
const N_NEUTRAL: u64 = 20;

/// Marker frames of one actor, a pure function of the frame number.
///
/// The first frames are neutral; then every muscle moves smoothly at a pace of its own, and the head sways.
pub struct TestPerformance {
    basis: MarkerBasis,
    marker_names: Vec<String>,
    /// Nominal rate.
    pub rate_hz: f64,
}

impl TestPerformance {
    /// A performance of the reference face at 120 Hz.
    pub fn reference() -> Self {
        Self::of(&frontalis_analysis::synthesis::reference_face::actor())
    }

    /// A performance of an actor at 120 Hz.
    pub fn of(actor: &Actor) -> Self {
        Self {
            basis: actor.marker_basis(),
            marker_names: actor.markers().iter().map(|it| it.name.clone()).collect(),
            rate_hz: 120.0,
        }
    }

    /// Number of markers in a frame.
    pub fn n_markers(&self) -> usize {
        self.marker_names.len()
    }

    /// The markers' names in stream order.
    pub fn marker_names(&self) -> &[String] {
        &self.marker_names
    }

    /// The contractions behind a frame.
    pub fn activations(&self, number: u64) -> Vec<f64> {
        let seconds = number.saturating_sub(N_NEUTRAL) as f64 / self.rate_hz;
        (0..self.basis.n_muscles())
            .map(|muscle| {
                let pace_hz = 0.4 + 0.07 * muscle as f64;
                0.3 * (1.0 - (std::f64::consts::TAU * pace_hz * seconds).cos())
            })
            .collect()
    }

    /// One frame, in millimeters; the capture clock starts with the performance.
    pub fn frame(&self, number: u64) -> MarkerFrame {
        self.frame_of(number, &self.activations(number))
    }

    /// The frame of that number with other contractions, one a muscle of the actor.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a frame number times its period is far below 2^63 nanoseconds"
    )]
    pub fn frame_of(&self, number: u64, activations: &[f64]) -> MarkerFrame {
        MarkerFrame {
            number,
            capture_time_nanos: (number as f64 * 1e9 / self.rate_hz).round() as i64,
            positions: (0..self.n_markers())
                .flat_map(|marker| self.position_mm(marker, activations, number))
                .collect(),
            ..MarkerFrame::default()
        }
    }

    /// Frames from first to last, both included.
    pub fn frames(&self, numbers: std::ops::RangeInclusive<u64>) -> Vec<MarkerFrame> {
        numbers.map(|it| self.frame(it)).collect()
    }

    /// What a publisher of this performance declares.
    pub fn start(&self, session: &str, publisher: &str) -> PublishStart {
        PublishStart {
            session: session.to_owned(),
            publisher: publisher.to_owned(),
            unit: LengthUnit::Millimeter.into(),
            ingest: Ingest::Lossless.into(),
            rate_hz: self.rate_hz,
            ..PublishStart::default()
        }
    }

    /// The same for a publisher of the client library, which sends every frame.
    pub fn capture_settings(&self, session: &str, publisher: &str) -> CaptureSettings {
        CaptureSettings {
            session: session.to_owned(),
            publisher: publisher.to_owned(),
            marker_names: self.marker_names.clone(),
            unit: LengthUnit::Millimeter,
            rate_hz: self.rate_hz,
            ingest: Ingest::Lossless,
            takeover: false,
        }
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "the wire carries single precision"
    )]
    fn position_mm(&self, marker: usize, activations: &[f64], number: u64) -> [f32; 3] {
        let moved = self
            .basis
            .of_marker_cm(marker)
            .iter()
            .zip(activations)
            .fold(self.basis.neutral[marker].0, |place, (displacement, x)| {
                place + displacement * *x
            });
        in_the_room([moved.x, moved.y, moved.z], sway(number, self.rate_hz)).map(|it| it as f32)
    }
}

/// The head's turn about the vertical, radians: none while the neutral face is taken.
fn sway(number: u64, rate_hz: f64) -> f64 {
    let seconds = number.saturating_sub(N_NEUTRAL) as f64 / rate_hz;
    0.05 * (std::f64::consts::TAU * 0.3 * seconds).sin()
}

/// From model space, centimeters, to a capture volume whose axes stand elsewhere, millimeters.
fn in_the_room([x, y, z]: [f64; 3], turn: f64) -> [f64; 3] {
    let (sin, cos) = (0.4 + turn).sin_cos();
    [
        10.0 * (cos * x + sin * z + 35.0),
        10.0 * (y + 120.0),
        10.0 * (cos * z - sin * x - 20.0),
    ]
}
