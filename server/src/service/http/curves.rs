//! `/api/v1/sessions/{id}/curves`: curves for clients that poll.

use axum::{Json, extract::State};
use frontalis_proto::v1::{self, curve_service_server::CurveService as _};
use serde::Deserialize;
use utoipa::IntoParams;

use super::{
    Doors,
    call::{Answer, Call},
    openapi::{ObjectRefusals, RangeRefusals, Refusals, StateRefusals},
    query::SessionPath,
};

/// Which samples.
#[derive(Deserialize, IntoParams)]
#[serde(rename_all = "camelCase")]
#[into_params(parameter_in = Query)]
pub(super) struct CurvesQuery {
    /// The run that `after` counts in; 0: the current one.
    #[serde(default)]
    #[param(required = false, maximum = 18_446_744_073_709_551_615_u64)]
    run: u64,
    /// The last sequence that the client has; absent: from the oldest that is kept.
    #[param(required = false, value_type = u64, maximum = 18_446_744_073_709_551_615_u64)]
    after: Option<u64>,
    /// Samples in the answer; 0: 100.
    #[serde(default)]
    #[param(required = false, maximum = 1000)]
    limit: u32,
    /// Fill `standardErrors`.
    #[serde(default)]
    #[param(required = false)]
    with_uncertainty: bool,
    /// Fill `observedCm`, `reproducedCm` and `observedMarkers`.
    #[serde(default)]
    #[param(required = false)]
    with_markers: bool,
}

/// A piece of what the session still holds; `readThrough` is `after` of the next request.
#[utoipa::path(
    get,
    path = "/api/v1/sessions/{id}/curves",
    operation_id = "readCurves",
    tag = "curves",
    params(SessionPath, CurvesQuery),
    responses(
        (status = 200, description = "Samples in order.", body = ref("#/components/schemas/ReadCurvesResponse")),
        Refusals,
        ObjectRefusals,
        StateRefusals,
        RangeRefusals,
    ),
    extensions(("x-grpc-method" = json!("frontalis.v1.CurveService/ReadCurves"))),
)]
pub(super) async fn read(
    State(doors): State<Doors>,
    call: Call<CurvesQuery>,
) -> Answer<v1::ReadCurvesResponse> {
    let query = &call.query;
    let request = call.request(v1::ReadCurvesRequest {
        session: call.name("sessions"),
        run: query.run,
        after: query.after,
        limit: query.limit,
        with_uncertainty: query.with_uncertainty,
        with_markers: query.with_markers,
    });
    let response = doors.services.curves.read_curves(request).await?;
    Ok(Json(response.into_inner()))
}
