//! The one port's router: gRPC and gRPC-web with health and reflection, plain HTTP, and one answer for everything else.

use std::time::Duration;

use axum::{Router, extract::Request, middleware, response::Response};
use frontalis_proto::{
    FILE_DESCRIPTOR_SET,
    v1::{
        actor_service_server::ActorServiceServer, capture_service_server::CaptureServiceServer,
        curve_service_server::CurveServiceServer, server_service_server::ServerServiceServer,
        session_service_server::SessionServiceServer, take_service_server::TakeServiceServer,
    },
};
use tonic::service::Routes;
use tonic_health::{ServingStatus, server::HealthReporter};
use tonic_web::GrpcWebLayer;
use tower_http::catch_panic::CatchPanicLayer;

use super::{
    access::{Access, authenticate, while_valid_grpc},
    calls::{self, Calls},
    deadline,
    grpc::{
        actors::{ActorsGrpc, MAX_CHUNK_BYTES},
        capture::CaptureGrpc,
        curves::CurvesGrpc,
        messages::{self, MessageRules},
        reasons,
        server::ServerGrpc,
        sessions::SessionsGrpc,
        takes::TakesGrpc,
    },
    guard::{self, Guard},
    http::{
        self, Doors, Draining, GrpcPanic, grpc_only, heard_out, http_only, unknown, with_instance,
    },
    panics,
    readiness::{RECORDING, Readiness},
    rescue,
};
use crate::{config::SMALL_MESSAGE_BYTES, take::DiskRoom, telemetry::Metrics};

/// A chunk and what is around it in its message, bytes.
const CHUNK_MESSAGE_BYTES: usize = MAX_CHUNK_BYTES + 4 * 1024;

/// How the paths of the services begin whose messages may be large.
const ACTORS: &str = "/frontalis.v1.ActorService/";
const CAPTURE: &str = "/frontalis.v1.CaptureService/";

/// Names that the health service knows.
const HEALTH: [&str; 3] = ["", "frontalis.v1.CaptureService", RECORDING];

/// The services behind the port; each door opens these and no others.
#[derive(Clone)]
pub struct Services {
    /// Packages.
    pub actors: ActorsGrpc,
    /// Sessions.
    pub sessions: SessionsGrpc,
    /// Frames in.
    pub capture: CaptureGrpc,
    /// Curves out.
    pub curves: CurvesGrpc,
    /// Recordings.
    pub takes: TakesGrpc,
    /// The server itself.
    pub server: ServerGrpc,
    /// Largest message of a publisher, bytes.
    pub max_message_bytes: usize,
    /// A message must be whole within this time of its beginning.
    pub message_deadline: Duration,
    /// How many calls may be in progress.
    pub calls: Calls,
}

/// Why the router cannot be built.
#[derive(Debug, thiserror::Error)]
#[error("the descriptors of the protocol cannot be served")]
pub struct ReflectionError(#[from] tonic_reflection::server::Error);

/// Joins both doors behind the guard. The reporter tells the health service when serving ends.
///
/// # Errors
///
/// When the descriptors in the binary are broken.
pub async fn router(
    doors: Doors,
    guard: Guard,
    access: Access,
) -> Result<(Router, HealthReporter), ReflectionError> {
    let services = doors.services.clone();
    let metrics = doors.metrics.clone();
    let readiness = doors.readiness.clone();
    let (reporter, health) = tonic_health::server::health_reporter();
    report(&reporter, &doors.readiness).await;
    let reflection = || {
        tonic_reflection::server::Builder::configure()
            .register_encoded_file_descriptor_set(FILE_DESCRIPTOR_SET)
            .register_encoded_file_descriptor_set(tonic_health::pb::FILE_DESCRIPTOR_SET)
    };
    let rules = MessageRules {
        deadline: services.message_deadline,
        sizes: vec![
            (ACTORS, CHUNK_MESSAGE_BYTES),
            (CAPTURE, services.max_message_bytes),
        ],
        other_bytes: SMALL_MESSAGE_BYTES,
    };
    let actors =
        ActorServiceServer::new(services.actors).max_decoding_message_size(CHUNK_MESSAGE_BYTES);
    let sessions =
        SessionServiceServer::new(services.sessions).max_decoding_message_size(SMALL_MESSAGE_BYTES);
    let capture = CaptureServiceServer::new(services.capture)
        .max_decoding_message_size(services.max_message_bytes);
    let curves =
        CurveServiceServer::new(services.curves).max_decoding_message_size(SMALL_MESSAGE_BYTES);
    let takes =
        TakeServiceServer::new(services.takes).max_decoding_message_size(SMALL_MESSAGE_BYTES);
    let server =
        ServerServiceServer::new(services.server).max_decoding_message_size(SMALL_MESSAGE_BYTES);
    let grpc = Routes::new(actors)
        .add_service(sessions)
        .add_service(capture)
        .add_service(curves)
        .add_service(takes)
        .add_service(server)
        .add_service(health)
        .add_service(reflection().build_v1()?)
        .add_service(reflection().build_v1alpha()?)
        .prepare()
        .into_axum_router()
        .reset_fallback()
        .layer(middleware::from_fn(while_valid_grpc))
        .layer(middleware::from_fn_with_state(rules, messages::whole))
        .layer(CatchPanicLayer::custom(GrpcPanic(metrics.clone())))
        .layer(middleware::map_response_with_state(
            metrics.clone(),
            panics::guard_grpc,
        ))
        .layer(middleware::map_response(reasons::complete))
        .layer(middleware::from_fn(deadline::enforce))
        .layer(middleware::from_fn_with_state(
            services.calls.clone(),
            calls::admit_grpc,
        ))
        // Outside of what may refuse: a refusal too is written as the client reads it.
        .layer(GrpcWebLayer::new())
        .layer(middleware::from_fn_with_state(metrics.clone(), grpc_only));
    let http = http::router(doors)
        .layer(middleware::map_response_with_state(
            metrics.clone(),
            panics::guard_http,
        ))
        .layer(middleware::from_fn_with_state(
            services.calls,
            calls::admit_http,
        ))
        .layer(middleware::from_fn(http_only));
    let router = http
        .merge(grpc)
        .fallback(move |request| count_unknown(metrics.clone(), request))
        .layer(middleware::from_fn_with_state(readiness, rescue::read_only))
        .layer(middleware::from_fn_with_state(access, authenticate))
        .layer(middleware::from_fn_with_state(guard, guard::check))
        .layer(middleware::from_fn(with_instance))
        // Outermost: whoever refuses, the refusal is heard.
        .layer(middleware::from_fn_with_state(
            Draining::default(),
            heard_out,
        ));
    Ok((router, reporter))
}

async fn count_unknown(metrics: Metrics, request: Request) -> Response {
    metrics.request(crate::telemetry::Protocol::Http);
    unknown(request).await
}

/// Tells the health service what the server is ready for.
pub async fn report(reporter: &HealthReporter, readiness: &Readiness) {
    for name in HEALTH {
        let is_ready = match name {
            RECORDING => readiness.check_recording().is_ok(),
            _ => readiness.check().is_ok(),
        };
        let status = if is_ready {
            ServingStatus::Serving
        } else {
            ServingStatus::NotServing
        };
        reporter.set_service_status(name, status).await;
    }
}

/// Tells the health service when the disk is full, and when it is free again, until the server drains.
pub async fn report_disk(reporter: HealthReporter, mut readiness: Readiness) {
    let draining = readiness.phases.draining.clone();
    loop {
        tokio::select! {
            changed = readiness.disk.changed() => if changed.is_err() { return },
            () = draining.cancelled() => return,
        }
        let room = *readiness.disk.borrow();
        if !room.is_enough() {
            let DiskRoom {
                free_bytes,
                needed_bytes,
            } = room;
            tracing::warn!(
                free_bytes,
                needed_bytes,
                "the disk has no room for new takes"
            );
        }
        report(&reporter, &readiness).await;
    }
}

/// Ends the streams of those who watch the health, so that they do not hold up the end.
pub async fn forget_health(reporter: &mut HealthReporter) {
    for name in HEALTH {
        reporter.clear_service_status(name).await;
    }
}
