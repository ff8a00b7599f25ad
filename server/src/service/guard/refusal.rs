//! How the guard says no, to HTTP and to gRPC.

use axum::{
    body::Body,
    http::{HeaderValue, StatusCode, header},
    response::{IntoResponse as _, Response},
};
use tonic::Code;

use crate::service::{grpc::status::refuse, http::Problem};

/// Why a request goes no further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    /// It asks for a name that is not this server's.
    Host,
    /// It names no host, or several.
    NoHost,
    /// A page of another origin sent it.
    Origin,
    /// Its path and query are too long.
    Target,
    /// Its headers are too large, over so many bytes.
    Headers(usize),
}

impl Refusal {
    fn parts(self) -> (StatusCode, Code, &'static str, String) {
        let (status, code, reason, detail) = match self {
            Self::Host => (
                StatusCode::MISDIRECTED_REQUEST,
                Code::PermissionDenied,
                "HOST",
                "this server is not called by this name; http.hosts of its configuration lists its names",
            ),
            Self::NoHost => (
                StatusCode::BAD_REQUEST,
                Code::InvalidArgument,
                "HOST",
                "a request names exactly one host",
            ),
            Self::Origin => (
                StatusCode::FORBIDDEN,
                Code::PermissionDenied,
                "ORIGIN",
                "pages of this origin may not call this server; http.origins of its configuration lists those that may",
            ),
            Self::Target => (
                StatusCode::URI_TOO_LONG,
                Code::ResourceExhausted,
                "URI_SIZE",
                "the path and query are longer than 8192 bytes",
            ),
            Self::Headers(limit) => {
                return (
                    StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE,
                    Code::ResourceExhausted,
                    "HEADER_SIZE",
                    format!("the headers are larger than {limit} bytes"),
                );
            }
        };
        (status, code, reason, detail.to_owned())
    }

    /// Whoever sends so much is not listened to any longer, where a connection is one conversation (BAD_INPUT F13).
    pub(super) fn is_of_size(self) -> bool {
        matches!(self, Self::Target | Self::Headers(_))
    }

    pub(super) fn into_http(self) -> Response {
        let (status, _, reason, detail) = self.parts();
        Problem::new(status, reason, &detail).into_response()
    }

    /// In the form that the request's content type asks for: gRPC, or gRPC-web, which takes it from the headers too.
    pub(super) fn into_grpc(self, kind: Option<HeaderValue>) -> Response {
        let (_, code, reason, detail) = self.parts();
        let mut response = refuse(code, reason, &detail).into_http::<Body>();
        if let Some(kind) = kind {
            response.headers_mut().insert(header::CONTENT_TYPE, kind);
        }
        response
    }
}
