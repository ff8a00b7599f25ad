//! The promises of the service, each kept by a real server, a real client and real gRPC; one module a promise.
#![expect(clippy::unwrap_used, reason = "a failing test is its own report")]

mod access;
mod access_matrix;
mod accuracy;
mod api_page;
mod audit;
mod bad_input;
mod citations;
mod clients;
mod command_line;
mod curl_refusals;
mod curves_http;
mod demo;
mod diagnosis;
mod drain;
mod erasure;
mod every_door;
mod http_api;
mod late_renderer;
mod layering;
mod load;
mod openapi;
mod person;
mod real_takes;
mod recentering;
mod restart;
mod simulation;
mod takes;
