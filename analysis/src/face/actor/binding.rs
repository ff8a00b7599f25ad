//! Binding of hand-marked markers to the neutral surface (Choe & Ko 2001, section 4.1.1).

use super::{ActorError, ActorParts, ActorWarning, BarycentricProblem, MarkerPlace};
use crate::{
    face::{
        marker::VirtualMarker,
        mesh::{FaceMesh, SurfaceTree},
    },
    space::ModelPoint,
};

/// Weights are written with six decimals or more.
const SUM_TOLERANCE: f64 = 1e-6;

/// Hand marking is off by millimeters; a centimeter is another place or another unit.
const FAR_OFF_CM: f64 = 1.0;

/// One place a marker, in order; warns of positions far off the surface.
pub(super) fn bind(
    parts: &ActorParts,
    warnings: &mut Vec<ActorWarning>,
) -> Result<Vec<VirtualMarker>, ActorError> {
    let mesh = &parts.mesh;
    let mut tree = None;
    let mut bound = Vec::with_capacity(parts.markers.len());
    for (marker, place) in &parts.markers {
        let refused = |problem| ActorError::Barycentric {
            marker: marker.name.clone(),
            problem,
        };
        bound.push(match place {
            MarkerPlace::OnTriangle(place) => checked(*place, mesh).map_err(refused)?,
            MarkerPlace::Vertex(vertex) => on_vertex(*vertex, mesh).map_err(refused)?,
            MarkerPlace::Position(position) => {
                if !is_usable(*position) {
                    return Err(ActorError::NonFiniteMarker {
                        marker: marker.name.clone(),
                    });
                }
                let found = tree
                    .get_or_insert_with(|| SurfaceTree::of(mesh))
                    .closest_point(*position)
                    .ok_or_else(|| refused(BarycentricProblem::NoSurface))?;
                if found.distance_cm > FAR_OFF_CM {
                    warnings.push(ActorWarning::MarkerOffSurface {
                        marker: marker.name.clone(),
                        distance_cm: found.distance_cm,
                    });
                }
                found.place
            }
        });
    }
    Ok(bound)
}

fn is_usable(position: ModelPoint) -> bool {
    let coordinates = position.0.coords;
    coordinates.iter().all(|it| it.abs() <= f64::from(f32::MAX))
}

fn checked(place: VirtualMarker, mesh: &FaceMesh) -> Result<VirtualMarker, BarycentricProblem> {
    let n_triangles = mesh.triangles.len();
    if place.triangle >= n_triangles {
        return Err(BarycentricProblem::Triangle {
            triangle: place.triangle,
            n_triangles,
        });
    }
    let within = |weight: f64| (0.0..=1.0 + SUM_TOLERANCE).contains(&weight);
    if let Some(&weight) = place.barycentric.iter().find(|&&weight| !within(weight)) {
        return Err(BarycentricProblem::Weight(weight));
    }
    let sum: f64 = place.barycentric.iter().sum();
    if (sum - 1.0).abs() > SUM_TOLERANCE {
        return Err(BarycentricProblem::Sum(sum));
    }
    if mesh.is_degenerate(place.triangle) {
        return Err(BarycentricProblem::Degenerate(place.triangle));
    }
    Ok(place)
}

/// The first triangle with an area that has the vertex, all weight on it.
fn on_vertex(vertex: usize, mesh: &FaceMesh) -> Result<VirtualMarker, BarycentricProblem> {
    let n_vertices = mesh.vertices.len();
    if vertex >= n_vertices {
        return Err(BarycentricProblem::Vertex { vertex, n_vertices });
    }
    let is_it = |&corner: &u32| corner as usize == vertex;
    let triangle = (0..mesh.triangles.len())
        .find(|&it| mesh.triangles[it].iter().any(is_it) && !mesh.is_degenerate(it))
        .ok_or(BarycentricProblem::Isolated(vertex))?;
    let barycentric = mesh.triangles[triangle].map(|corner| f64::from(u8::from(is_it(&corner))));
    Ok(VirtualMarker {
        triangle,
        barycentric,
    })
}
