//! Follows one session's curves, over any number of connections.
//!
//! The contract is that of `curve.proto`: newest sample wins against credits (CONTRACTS D-14), or every frame in order
//! (D-17). After a cut the client subscribes again with its run and the sequence after the last; a sequence that was
//! not kept, and a session that started over, are reported and never hidden.

mod position;
mod subscription;

use std::time::Duration;

use futures::{Stream, StreamExt as _, stream::BoxStream};

use self::subscription::Subscription;
use crate::{
    connection::Channel,
    error::ClientError,
    proto::{ControlSpace, CurveEnd, CurveHeader, CurveSample, Gap, StreamState},
};

/// Which samples a subscriber wants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    /// The newest; what cannot be shown in time is skipped and counted.
    Latest {
        /// Samples in flight, 1..=32: 2 on a local network, ceil(rate × round trip) + 1 in general.
        credits: u32,
        /// At most so many samples a second; 0: as many as there are credits.
        max_rate_hz: f32,
    },
    /// All of them, in order.
    EveryFrame {
        /// Where to begin.
        from: StartAt,
    },
}

/// Where a subscription to every frame begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartAt {
    /// At the newest sample.
    Now,
    /// At the oldest sample that the server keeps.
    Oldest,
    /// At this sequence of this run.
    Sequence {
        /// The session's run; 0: the present one.
        run: u64,
        /// First sample wanted.
        sequence: u64,
    },
}

/// What to follow, and how.
#[derive(Clone, Debug)]
pub struct CurveSettings {
    /// `sessions/{id}`.
    pub session: String,
    /// A name for the dashboard and the logs; empty: the peer's address.
    pub subscriber: String,
    /// Newest or every frame.
    pub wanted: Wanted,
    /// Vocabulary of the controls.
    pub control_space: ControlSpace,
    /// Fill `observed_cm` and `reproduced_cm`.
    pub with_markers: bool,
    /// Fill `standard_errors`.
    pub with_uncertainty: bool,
}

impl CurveSettings {
    /// Muscles of `sessions/{id}`, without extras.
    pub fn new(session: impl Into<String>, wanted: Wanted) -> Self {
        Self {
            session: session.into(),
            subscriber: String::new(),
            wanted,
            control_space: ControlSpace::Muscles,
            with_markers: false,
            with_uncertainty: false,
        }
    }
}

/// What a subscription tells, in the order it happened.
#[expect(
    clippy::large_enum_variant,
    reason = "nearly every event is the large one, a sample; a box each would only cost"
)]
#[derive(Clone, Debug, PartialEq)]
pub enum CurveEvent {
    /// First of every connection: the controls and their order.
    Header(CurveHeader),
    /// One sample.
    Sample(CurveSample),
    /// Frames that gave no sample, and why.
    Gap(Gap),
    /// Newest-first only: samples not received so far, over all connections, as the server counts them.
    Skipped(u64),
    /// The session's state; also the heartbeat.
    State(StreamState),
    /// Every frame: these sequences were no longer kept when the client came back, both included.
    Lost {
        /// First sequence not received.
        first_sequence: u64,
        /// Last sequence not received.
        last_sequence: u64,
    },
    /// The session started over; sequences count from 1 again. Unrecorded samples of the old run that were not yet
    /// received are gone.
    NewRun {
        /// The run followed so far.
        previous: u64,
        /// The present run.
        present: u64,
    },
    /// The stream was cut; the client tries again.
    Reconnecting {
        /// Why it was cut.
        cause: ClientError,
        /// The wait before the next attempt.
        wait: Duration,
    },
    /// The session ended. Nothing follows.
    End(CurveEnd),
}

/// A running subscription. Dropping it ends it.
///
/// ```no_run
/// # async fn example() -> Result<(), frontalis_client::error::ClientError> {
/// use frontalis_client::{
///     connection,
///     curve_client::{CurveClient, CurveEvent, CurveSettings, StartAt, Wanted},
/// };
///
/// let channel = connection::connect("http://127.0.0.1:7400").await?;
/// let wanted = Wanted::EveryFrame { from: StartAt::Oldest };
/// let settings = CurveSettings::new("sessions/take-1", wanted);
/// let mut curves = CurveClient::subscribe(channel, settings).await?;
/// while let Some(event) = curves.next().await? {
///     if let CurveEvent::Sample(sample) = event {
///         println!("{}: {:?}", sample.frame, sample.activations);
///     }
/// }
/// # Ok(())
/// # }
/// ```
pub struct CurveClient {
    events: BoxStream<'static, Result<CurveEvent, ClientError>>,
}

impl std::fmt::Debug for CurveClient {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("CurveClient").finish_non_exhaustive()
    }
}

impl CurveClient {
    /// Subscribes; later cuts are mended by [`next`](Self::next).
    ///
    /// # Errors
    ///
    /// When the server cannot be reached or refuses the subscription.
    pub async fn subscribe(channel: Channel, settings: CurveSettings) -> Result<Self, ClientError> {
        let subscription = Subscription::open(channel, settings).await?;
        Ok(Self {
            events: subscription.into_events().boxed(),
        })
    }

    /// The next event; `None` after the end of the session, or after an error that no waiting heals.
    ///
    /// Asking again gives the credit of the sample before back: ask when it has been shown. Safe to cancel.
    ///
    /// # Errors
    ///
    /// When the server refuses for good.
    pub async fn next(&mut self) -> Result<Option<CurveEvent>, ClientError> {
        self.events.next().await.transpose()
    }

    /// The same events as a stream.
    pub fn into_stream(self) -> impl Stream<Item = Result<CurveEvent, ClientError>> {
        self.events
    }
}

#[cfg(test)]
mod tests;
