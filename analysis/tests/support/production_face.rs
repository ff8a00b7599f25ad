//! A face of any number of markers and muscles: the skin of the reference face under muscles of random place and pull.
#![allow(
    dead_code,
    clippy::allow_attributes,
    reason = "shared by tests and benches that each use a part"
)]

use frontalis_analysis::{
    face::{
        actor::{Actor, MarkerPlace, RankPolicy},
        basis::ActuationBasis,
        marker::Marker,
        muscle::Muscle,
        region::FaceRegion,
    },
    synthesis::{pseudo_muscle::LinearMuscle, reference_face},
};
use nalgebra::Vector3;
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64;

/// How far a muscle reaches, centimeters.
const REACH_CM: std::ops::Range<f64> = 1.5..3.0;

/// How far it pulls at full contraction, centimeters.
const PULL_CM: std::ops::Range<f64> = 0.4..1.2;

/// A face of `n_markers` on vertices that are spread over the skin, and `n_muscles` muscles around others.
pub fn actor(n_markers: usize, n_muscles: usize, seed: u64) -> Actor {
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut parts = reference_face::actor_parts();
    let vertices: Vec<Vector3<f64>> = parts.mesh.vertices.iter().map(|it| it.0.coords).collect();
    let spread = |i: usize, n: usize| i * vertices.len() / n;
    let region = |place: &Vector3<f64>| {
        if place.y > 0.0 {
            FaceRegion::Upper
        } else {
            FaceRegion::Lower
        }
    };
    parts.markers = (0..n_markers)
        .map(|i| {
            let vertex = spread(i, n_markers);
            let marker = Marker {
                name: format!("marker_{i}"),
                region: region(&vertices[vertex]),
                head_fixed: false,
            };
            (marker, MarkerPlace::Vertex(vertex))
        })
        .collect();
    (parts.muscles, parts.basis) = muscles(&vertices, n_muscles, &mut rng, region);
    "production".clone_into(&mut parts.muscle_set);
    let (actor, _) =
        Actor::new(parts, RankPolicy::Regularize).expect("the production face is an actor");
    actor
}

fn muscles(
    vertices: &[Vector3<f64>],
    n_muscles: usize,
    rng: &mut Pcg64,
    region: impl Fn(&Vector3<f64>) -> FaceRegion,
) -> (Vec<Muscle>, ActuationBasis) {
    let mut muscles = Vec::new();
    let mut displacements_cm = Vec::new();
    for i in 0..n_muscles {
        let origin_cm = vertices[i * vertices.len() / n_muscles];
        let direction = Vector3::from_fn(|_, _| rng.random_range(-1.0..1.0));
        let pull = rng.random_range(PULL_CM) * direction.normalize();
        let muscle = LinearMuscle {
            origin_cm,
            target_cm: origin_cm + pull,
            radius_cm: rng.random_range(REACH_CM),
            axis_weights: Vector3::repeat(1.0),
        };
        muscles.push(Muscle {
            name: format!("muscle_{i}"),
            region: region(&origin_cm),
        });
        displacements_cm.push(vertices.iter().map(|it| muscle.displacement(it)).collect());
    }
    (muscles, ActuationBasis { displacements_cm })
}
