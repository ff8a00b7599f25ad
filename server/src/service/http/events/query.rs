//! What the client of an event stream asks for: the query, and where it left off.

use std::{fmt, str::FromStr};

use axum::http::{HeaderMap, StatusCode};
use frontalis_proto::v1;
use serde::Deserialize;
use utoipa::IntoParams;

use super::super::{openapi, problem::Problem, query::Word};

/// Header of a browser that comes back.
const LAST_EVENT_ID: &str = "last-event-id";

/// `SubscribeStart` as a query.
#[derive(Clone, Debug, Default, Deserialize, IntoParams)]
#[serde(default, rename_all = "camelCase")]
#[into_params(parameter_in = Query)]
pub(in super::super) struct EventsQuery {
    /// A name for status and logs; empty: the peer's address.
    #[param(required = false, schema_with = openapi::display_name)]
    subscriber: String,
    /// `latest`, which is the default, or `every_frame`.
    #[param(required = false, value_type = String, pattern = "^((DELIVERY_)?(LATEST|EVERY_FRAME)|latest|every_frame|)$", example = "every_frame")]
    delivery: Word,
    /// `every_frame`: the first sample wanted; 0: from now.
    #[param(required = false, maximum = 18_446_744_073_709_551_615_u64)]
    from_sequence: u64,
    /// `every_frame`: from the oldest sample that is kept.
    #[param(required = false)]
    from_oldest: bool,
    /// Of `fromSequence`; 0: the current run.
    #[param(required = false, maximum = 18_446_744_073_709_551_615_u64)]
    run: u64,
    /// `latest`: samples a second at most; 0: 30.
    #[param(required = false, minimum = 0, maximum = 1_000_000)]
    max_rate_hz: f32,
    /// `muscles`, which is the default; this version has no other.
    #[param(required = false, value_type = String, pattern = "^((CONTROL_SPACE_)?MUSCLES|muscles|)$", example = "muscles")]
    control_space: Word,
    /// Fill `standardErrors`.
    #[param(required = false)]
    with_uncertainty: bool,
    /// Fill `observedCm`, `reproducedCm` and `observedMarkers`.
    #[param(required = false)]
    with_markers: bool,
    /// The stream ends after so many samples; absent: with the session.
    #[param(required = false, value_type = u64, maximum = 18_446_744_073_709_551_615_u64)]
    pub(super) limit: Option<u64>,
}

/// What a client that comes back says.
#[derive(IntoParams)]
#[into_params(parameter_in = Header)]
#[expect(dead_code, reason = "only describes the header")]
pub(super) struct LastEventId {
    /// The id of the last event that the client has: `run:sequence`, or `run:sequence:end` of an ended session's last
    /// one; empty: none.
    #[param(
        rename = "last-event-id",
        required = false,
        pattern = "^([0-9]{1,19}:[0-9]{1,19}(:end)?)?$",
        example = "1:120"
    )]
    last_event_id: String,
}

impl EventsQuery {
    /// The start of the stream; a client that comes back goes on where it was.
    pub(super) fn start(
        &self,
        session: String,
        resumed: Option<Position>,
    ) -> Result<v1::SubscribeStart, Problem> {
        let delivery = self.delivery.number("delivery", "Delivery")?;
        let control_space = self.control_space.number("controlSpace", "ControlSpace")?;
        let mut start = v1::SubscribeStart {
            session,
            subscriber: self.subscriber.clone(),
            delivery,
            from_sequence: self.from_sequence,
            control_space,
            max_rate_hz: self.max_rate_hz,
            with_uncertainty: self.with_uncertainty,
            run: self.run,
            from_oldest: self.from_oldest,
            with_markers: self.with_markers,
            ..v1::SubscribeStart::default()
        };
        // The newest sample is the same wherever the client was; only every frame has a place to go on.
        if let Some(position) = resumed
            && start.delivery() == v1::Delivery::EveryFrame
        {
            start.run = position.run;
            start.from_sequence = position.sequence + 1;
            start.from_oldest = false;
        }
        Ok(start)
    }
}

/// A place in a session's stream: `run:sequence`, and `run:sequence:end` behind the last sample of an ended session.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Position {
    /// Of the session.
    pub run: u64,
    /// Of the last sample; 0: none yet.
    pub sequence: u64,
    /// Nothing more comes.
    pub has_ended: bool,
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let end = if self.has_ended { ":end" } else { "" };
        write!(f, "{}:{}{end}", self.run, self.sequence)
    }
}

impl FromStr for Position {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let (text, has_ended) = match text.strip_suffix(":end") {
            Some(text) => (text, true),
            None => (text, false),
        };
        let (run, sequence) = text.split_once(':').ok_or(())?;
        let number = |it: &str| it.parse().ok().filter(|it| *it < u64::MAX);
        Ok(Self {
            run: number(run).ok_or(())?,
            sequence: number(sequence).ok_or(())?,
            has_ended,
        })
    }
}

/// Where the client left off, if it says so.
pub(super) fn resumed(headers: &HeaderMap) -> Result<Option<Position>, Problem> {
    let Some(sent) = headers.get(LAST_EVENT_ID) else {
        return Ok(None);
    };
    if sent.is_empty() {
        return Ok(None);
    }
    // What is no text is no position either, and not none.
    let text = sent.to_str().unwrap_or(":");
    text.parse().map(Some).map_err(|()| {
        let detail = "Last-Event-ID must be run:sequence, the id of the last event";
        Problem::new(StatusCode::BAD_REQUEST, "EVENT_ID", detail)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_position_reads_back_as_it_was_written() {
        for (run, sequence, has_ended) in [(1, 0, false), (3, 120, false), (u64::MAX - 1, 7, true)]
        {
            let position = Position {
                run,
                sequence,
                has_ended,
            };
            assert_eq!(position.to_string().parse(), Ok(position));
        }
        for text in [
            "",
            "1",
            "1:",
            ":1",
            "a:b",
            "1:2:3",
            "-1:2",
            "1:18446744073709551615",
            "1:2:end:end",
        ] {
            assert_eq!(text.parse::<Position>(), Err(()), "{text}");
        }
    }

    #[test]
    fn who_comes_back_goes_on_behind_its_last_sample() {
        let query = EventsQuery {
            delivery: "every_frame".into(),
            from_oldest: true,
            ..EventsQuery::default()
        };
        let position = Position {
            run: 2,
            sequence: 41,
            has_ended: false,
        };
        let start = query.start("sessions/one".into(), Some(position)).unwrap();
        assert_eq!(
            (start.run, start.from_sequence, start.from_oldest),
            (2, 42, false)
        );
    }
}
