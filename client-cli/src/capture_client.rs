//! Publishes marker frames into a session, over any number of connections.
//!
//! CONTRACTS D-8, D-9: frames without an acknowledgement wait in a bounded ring; after a cut the client reconnects with
//! growing waits (O-14), asks where the server stands, and sends on from there, so that every frame takes effect once.
//! A live publisher that comes back with many frames sends those losslessly first: they are late already, and the limit
//! on live frames would refuse them.
//! A publisher that was fenced (D-29) stops for good.

mod clock_echo;
mod publication;
pub mod ranges;
pub mod report;
pub mod ring;
mod shared;

use std::{sync::Arc, time::Duration};

use tokio::time::timeout;
use tokio_util::task::AbortOnDropHandle;
use tonic::Code;

use self::{
    clock_echo::Echoes,
    publication::{Publication, open},
    report::PublishReport,
    ring::RingLimits,
    shared::Shared,
};
use crate::{
    connection::Channel,
    error::ClientError,
    proto::{Ingest, LengthUnit, MarkerFrame, PublishStart, PublishStarted},
};

pub use clock_echo::CaptureClock;

/// How long [`CaptureClient::finish`] waits while no further frame is settled.
const FINISH_PATIENCE: Duration = Duration::from_secs(30);

/// Who publishes what, and how.
#[derive(Clone, Debug)]
pub struct CaptureSettings {
    /// `sessions/{id}`.
    pub session: String,
    /// Stable id of this capture client; the same id reconnecting replaces its own older stream.
    pub publisher: String,
    /// Order of the markers in every frame.
    pub marker_names: Vec<String>,
    /// Unit of every coordinate.
    pub unit: LengthUnit,
    /// Nominal rate, frames per second.
    pub rate_hz: f64,
    /// Newest matters (`Live`), or every frame (`Lossless`).
    pub ingest: Ingest,
    /// Take the session from another publisher. Used for the first connection only.
    pub takeover: bool,
}

impl CaptureSettings {
    fn start(&self, takeover: bool, ingest: Ingest) -> PublishStart {
        PublishStart {
            session: self.session.clone(),
            publisher: self.publisher.clone(),
            marker_names: self.marker_names.clone(),
            unit: self.unit.into(),
            takeover,
            ingest: ingest.into(),
            image: None,
            rate_hz: self.rate_hz,
        }
    }
}

/// A running publication.
///
/// ```no_run
/// # async fn example() -> Result<(), frontalis_client::error::ClientError> {
/// use frontalis_client::{capture_client::{CaptureClient, CaptureSettings}, connection, proto};
///
/// let settings = CaptureSettings {
///     session: "sessions/take-1".to_owned(),
///     publisher: "rig-1".to_owned(),
///     marker_names: vec!["chin".to_owned()],
///     unit: proto::LengthUnit::Millimeter,
///     rate_hz: 120.0,
///     ingest: proto::Ingest::Live,
///     takeover: false,
/// };
/// let channel = connection::connect("http://127.0.0.1:7400").await?;
/// let client = CaptureClient::start(channel, settings).await?;
/// client.send(proto::MarkerFrame { number: 1, positions: vec![0.0; 3], ..Default::default() }).await?;
/// let published = client.finish().await;
/// println!("{} frames accepted", published.report.accepted_frames);
/// # Ok(())
/// # }
/// ```
///
/// Dropping it cuts the stream; [`finish`](Self::finish) ends it properly.
#[derive(Debug)]
pub struct CaptureClient {
    shared: Arc<Shared>,
    started: PublishStarted,
    ingest: Ingest,
    driver: AbortOnDropHandle<()>,
}

/// The end of a publication.
#[derive(Clone, Debug)]
pub struct Published {
    /// What became of the frames.
    pub report: PublishReport,
    /// Why it ended before it was finished.
    pub failure: Option<ClientError>,
}

impl CaptureClient {
    /// Opens the stream; later cuts are mended in the background.
    ///
    /// # Errors
    ///
    /// When the server cannot be reached or refuses the publication.
    pub async fn start(channel: Channel, settings: CaptureSettings) -> Result<Self, ClientError> {
        Self::start_on_clock(channel, settings, None).await
    }

    /// The same; with the capture clock, the server learns how it stands to its own.
    ///
    /// # Errors
    ///
    /// As of [`Self::start`].
    pub async fn start_on_clock(
        channel: Channel,
        settings: CaptureSettings,
        clock: Option<CaptureClock>,
    ) -> Result<Self, ClientError> {
        let start = settings.start(settings.takeover, settings.ingest);
        let (stream, first) = open(&channel, start).await?;
        let shared = Arc::new(Shared::new(RingLimits::for_rate(settings.rate_hz)));
        let started = shared.begin_connection(&first);
        let ingest = settings.ingest;
        let publication =
            Publication::new(Arc::clone(&shared), channel, settings, Echoes::of(clock));
        let driver = AbortOnDropHandle::new(tokio::spawn(publication.run(stream)));
        Ok(Self {
            shared,
            started,
            ingest,
            driver,
        })
    }

    /// What the server answered first: grant, run, and the frame number it expects.
    pub fn started(&self) -> PublishStarted {
        self.started
    }

    /// Hands one frame over.
    ///
    /// `Live` never waits: when the ring is full the oldest frame falls out and is reported as lost.
    /// `Lossless` waits for room.
    ///
    /// # Errors
    ///
    /// When the publication has failed for good; the reason repeats in [`finish`](Self::finish).
    pub async fn send(&self, frame: MarkerFrame) -> Result<(), ClientError> {
        loop {
            let room = self.shared.room.notified();
            {
                let mut state = self.shared.lock();
                if let Some(failure) = &state.failure {
                    return Err(failure.clone());
                }
                if self.ingest != Ingest::Lossless || state.ring.has_room_for(&frame) {
                    state.ring.push(frame);
                    break;
                }
            }
            room.await;
        }
        self.shared.work.notify_one();
        Ok(())
    }

    /// What became of the frames so far.
    pub fn report(&self) -> PublishReport {
        self.shared.report()
    }

    /// Sends what is left, closes the stream, and waits for the last watermarks.
    pub async fn finish(mut self) -> Published {
        self.shared.lock().is_closing = true;
        self.shared.work.notify_one();
        let mut unsettled = usize::MAX;
        let gave_up = loop {
            if timeout(FINISH_PATIENCE, &mut self.driver).await.is_ok() {
                break false;
            }
            let now = self.shared.lock().ring.len();
            if now >= unsettled {
                break true;
            }
            unsettled = now;
        };
        let report = self.shared.report();
        let mut failure = self.shared.lock().failure.clone();
        if gave_up && failure.is_none() {
            failure = Some(ClientError::local(
                Code::DeadlineExceeded,
                format!(
                    "{} frames were not acknowledged within {} s",
                    report.unacknowledged_frames,
                    FINISH_PATIENCE.as_secs()
                ),
            ));
        }
        Published { report, failure }
    }
}

#[cfg(test)]
mod tests;
