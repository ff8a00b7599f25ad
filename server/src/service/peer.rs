//! Where a request comes from: its address, the door it came through, and who sent it.
//!
//! Every door puts these into the request's extensions; the services read them here and nowhere else.

use std::net::SocketAddr;

use axum::extract::ConnectInfo;
use http::Extensions;

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
}

impl Door {
    /// As `SubscriberStatus.protocol` says it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grpc => "grpc",
            Self::GrpcWeb => "grpc-web",
            Self::WebSocket => "websocket",
            Self::Sse => "sse",
            Self::Http => "http",
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
