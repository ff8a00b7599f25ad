//! What is spoken on a WebSocket: the direction, and the form of the messages.

use axum::http::{HeaderMap, header};

/// Which contract.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    /// `CurveService.Subscribe`.
    Subscribe,
    /// `CaptureService.PublishMarkers`.
    Publish,
}

/// Which form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// Text messages, protobuf JSON.
    Json,
    /// Binary messages, protobuf.
    Protobuf,
}

/// One of the four that are spoken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Subprotocol {
    /// Which contract.
    pub direction: Direction,
    /// Which form.
    pub form: Form,
}

const ALL: [Subprotocol; 4] = [
    Subprotocol::new(Direction::Subscribe, Form::Json),
    Subprotocol::new(Direction::Subscribe, Form::Protobuf),
    Subprotocol::new(Direction::Publish, Form::Json),
    Subprotocol::new(Direction::Publish, Form::Protobuf),
];

impl Subprotocol {
    const fn new(direction: Direction, form: Form) -> Self {
        Self { direction, form }
    }

    /// As the handshake says it.
    pub(super) fn name(self) -> &'static str {
        match (self.direction, self.form) {
            (Direction::Subscribe, Form::Json) => "frontalis.v1.subscribe+json",
            (Direction::Subscribe, Form::Protobuf) => "frontalis.v1.subscribe+proto",
            (Direction::Publish, Form::Json) => "frontalis.v1.publish+json",
            (Direction::Publish, Form::Protobuf) => "frontalis.v1.publish+proto",
        }
    }

    /// The first of the client's that is spoken. Others, a token among them, are passed over.
    pub(super) fn offered(headers: &HeaderMap) -> Option<Self> {
        let offers = headers.get_all(header::SEC_WEBSOCKET_PROTOCOL).into_iter();
        let mut names = offers
            .filter_map(|it| it.to_str().ok())
            .flat_map(|it| it.split(','));
        names.find_map(|name| ALL.into_iter().find(|it| it.name() == name.trim()))
    }
}

#[cfg(test)]
mod tests {
    use axum::http::HeaderValue;

    use super::*;

    fn offered(lines: &[&'static str]) -> Option<&'static str> {
        let mut headers = HeaderMap::new();
        for line in lines {
            headers.append(
                header::SEC_WEBSOCKET_PROTOCOL,
                HeaderValue::from_static(line),
            );
        }
        Subprotocol::offered(&headers).map(Subprotocol::name)
    }

    #[test]
    fn the_clients_first_choice_that_is_spoken_is_taken() {
        assert_eq!(offered(&[]), None);
        assert_eq!(offered(&["chat, frontalis.v2.subscribe+json"]), None);
        let both = "frontalis.bearer.x, frontalis.v1.subscribe+proto,frontalis.v1.subscribe+json";
        assert_eq!(offered(&[both]), Some("frontalis.v1.subscribe+proto"));
        let lines = ["frontalis.bearer.x", "frontalis.v1.publish+json"];
        assert_eq!(offered(&lines), Some("frontalis.v1.publish+json"));
    }
}
