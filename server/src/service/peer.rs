//! Where a request comes from: its address, the door it came through, and who sent it.
//!
//! Every door puts these into the request's extensions; the services read them here and nowhere else.

use std::net::{IpAddr, Ipv6Addr, SocketAddr};

use axum::extract::ConnectInfo;
use http::{Extensions, HeaderMap, HeaderValue, header};

use super::access::Caller;

/// The way in, as status and metrics name it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Door {
    /// gRPC over HTTP/2.
    #[default]
    Grpc,
    /// gRPC-web over either HTTP.
    GrpcWeb,
    /// A WebSocket.
    WebSocket,
    /// Server-sent events.
    Sse,
    /// Plain HTTP with JSON.
    Http,
    /// A TLS handshake, before anything was asked.
    Handshake,
}

impl Door {
    /// The door that a request is on its way to, as its headers say.
    pub fn of(headers: &HeaderMap) -> Self {
        let begins = |name, with: &[u8]| {
            let value: Option<&HeaderValue> = headers.get(name);
            value.is_some_and(|it| it.as_bytes().starts_with(with))
        };
        if begins(header::CONTENT_TYPE, b"application/grpc-web") {
            Self::GrpcWeb
        } else if begins(header::CONTENT_TYPE, b"application/grpc") {
            Self::Grpc
        } else if headers.contains_key(header::SEC_WEBSOCKET_KEY) {
            Self::WebSocket
        } else if begins(header::ACCEPT, b"text/event-stream") {
            Self::Sse
        } else {
            Self::Http
        }
    }

    /// As `SubscriberStatus.protocol` says it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grpc => "grpc",
            Self::GrpcWeb => "grpc-web",
            Self::WebSocket => "websocket",
            Self::Sse => "sse",
            Self::Http => "http",
            Self::Handshake => "tls",
        }
    }
}

/// Where a request comes from.
#[derive(Clone, Debug, Default)]
pub struct Peer {
    /// None in tests without a connection.
    pub address: Option<SocketAddr>,
    /// The way in.
    pub door: Door,
    /// Who sent it.
    pub caller: Caller,
}

impl Peer {
    /// As the request's extensions say.
    pub fn of(extensions: &Extensions) -> Self {
        let address = extensions.get::<ConnectInfo<SocketAddr>>();
        Self {
            address: address.map(|it| it.0),
            door: extensions.get::<Door>().copied().unwrap_or_default(),
            caller: Caller::of(extensions),
        }
    }

    /// What a subscriber is called that gives no name.
    pub fn address_name(&self) -> String {
        self.address
            .map_or_else(|| "unnamed".to_owned(), |it| it.to_string())
    }
}

/// What counts as one peer, wherever peers are limited: an address, or of the longer ones what is given to one customer,
/// who has 2⁶⁴ of them (CONTRACTS O-1, S-10).
pub fn network_of(address: IpAddr) -> IpAddr {
    match address {
        IpAddr::V4(_) => address,
        IpAddr::V6(address) => {
            let [a, b, c, d, ..] = address.segments();
            address
                .to_ipv4_mapped()
                .map_or_else(|| Ipv6Addr::new(a, b, c, d, 0, 0, 0, 0).into(), IpAddr::V4)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_say_which_door_a_request_is_on_its_way_to() {
        let door = |name, value| {
            let mut headers = HeaderMap::new();
            headers.insert(name, HeaderValue::from_static(value));
            Door::of(&headers)
        };
        let kind = header::CONTENT_TYPE;
        assert_eq!(door(kind.clone(), "application/grpc"), Door::Grpc);
        assert_eq!(
            door(kind.clone(), "application/grpc-web-text"),
            Door::GrpcWeb
        );
        assert_eq!(door(kind, "application/json"), Door::Http);
        assert_eq!(door(header::SEC_WEBSOCKET_KEY, "x"), Door::WebSocket);
        assert_eq!(door(header::ACCEPT, "text/event-stream"), Door::Sse);
        assert_eq!(Door::of(&HeaderMap::new()), Door::Http);
    }

    #[test]
    fn one_customer_is_one_peer_however_many_addresses_it_has() {
        let is_one = |one: &str, other: &str| {
            network_of(one.parse().unwrap()) == network_of(other.parse().unwrap())
        };
        assert!(is_one("2001:db8::1", "2001:db8::ffff:0:0:2"));
        assert!(!is_one("2001:db8::1", "2001:db8:0:1::1"));
        assert!(!is_one("10.0.0.1", "10.0.0.2"));
        assert!(is_one("::ffff:10.0.0.1", "10.0.0.1"));
    }
}
