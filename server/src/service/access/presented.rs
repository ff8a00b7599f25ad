//! The token that a request carries: `Authorization: Bearer`, or from a browser that opens a WebSocket, which cannot set
//! headers, the subprotocol `frontalis.bearer.TOKEN`. The query is never read (BAD_INPUT I1).

use http::{HeaderMap, header};

/// Begins the subprotocol that is a token.
const SUBPROTOCOL: &str = "frontalis.bearer.";
const SCHEME: &[u8] = b"bearer ";

/// What was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Presented<'a> {
    /// No token.
    Nothing,
    /// Something that may be one.
    Token(&'a [u8]),
    /// Another scheme, or two of them.
    Malformed,
}

/// Looks at the headers.
pub(super) fn token(headers: &HeaderMap) -> Presented<'_> {
    let mut all = headers.get_all(header::AUTHORIZATION).iter();
    match (all.next(), all.next()) {
        (None, _) => subprotocol(headers),
        (Some(value), None) => bearer(value.as_bytes()),
        (Some(_), Some(_)) => Presented::Malformed,
    }
}

fn bearer(value: &[u8]) -> Presented<'_> {
    match value.split_at_checked(SCHEME.len()) {
        Some((scheme, token)) if scheme.eq_ignore_ascii_case(SCHEME) && !token.is_empty() => {
            Presented::Token(token)
        }
        _ => Presented::Malformed,
    }
}

fn subprotocol(headers: &HeaderMap) -> Presented<'_> {
    let lines = headers.get_all(header::SEC_WEBSOCKET_PROTOCOL).iter();
    let texts = lines.filter_map(|it| it.to_str().ok());
    let mut tokens = texts
        .flat_map(|it| it.split(','))
        .filter_map(|it| it.trim().strip_prefix(SUBPROTOCOL));
    match (tokens.next(), tokens.next()) {
        (None, _) => Presented::Nothing,
        (Some(token), None) => Presented::Token(token.as_bytes()),
        (Some(_), Some(_)) => Presented::Malformed,
    }
}

#[cfg(test)]
mod tests {
    use http::HeaderValue;

    use super::*;

    fn check(lines: &[(&'static str, &'static str)], expected: Presented<'_>) {
        let mut headers = HeaderMap::new();
        for (name, value) in lines {
            headers.append(*name, HeaderValue::from_static(value));
        }
        assert_eq!(token(&headers), expected, "{lines:?}");
    }

    #[test]
    fn a_token_comes_in_a_header_or_as_a_subprotocol() {
        check(&[], Presented::Nothing);
        check(&[("authorization", "Bearer t")], Presented::Token(b"t"));
        check(&[("authorization", "bearer t")], Presented::Token(b"t"));
        let browser = "frontalis.v1.subscribe+json, frontalis.bearer.t";
        check(
            &[("sec-websocket-protocol", browser)],
            Presented::Token(b"t"),
        );
        let other = "frontalis.v1.subscribe+json";
        check(&[("sec-websocket-protocol", other)], Presented::Nothing);
    }

    #[test]
    fn what_is_no_bearer_or_is_there_twice_is_none() {
        check(&[("authorization", "Basic YTpi")], Presented::Malformed);
        check(&[("authorization", "Bearer")], Presented::Malformed);
        check(&[("authorization", "Bearer ")], Presented::Malformed);
        let twice = [("authorization", "Bearer a"), ("authorization", "Bearer b")];
        check(&twice, Presented::Malformed);
        let two = "frontalis.bearer.a, frontalis.bearer.b";
        check(&[("sec-websocket-protocol", two)], Presented::Malformed);
    }

    #[test]
    fn the_header_goes_before_the_subprotocol() {
        let both = [
            ("authorization", "Bearer a"),
            ("sec-websocket-protocol", "frontalis.bearer.b"),
        ];
        check(&both, Presented::Token(b"a"));
    }
}
