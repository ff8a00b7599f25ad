//! An actor whose artist was wrong: muscles too strong or too weak, of another direction, at another place.
//!
//! Each muscle's displacements are scaled, turned, and weighed by exp(s · (v − c) / r), which moves a bump of width r about
//! its center c by s r; all are smooth over the face. One factor on all three brings the basis to the wanted error.

use std::sync::Arc;

use frontalis_analysis::face::{
    actor::{Actor, RankPolicy},
    basis::MarkerBasis,
};
use nalgebra::{Rotation3, Vector3};
use rand::SeedableRng as _;
use rand_pcg::Pcg64;

use super::random::{normal, normal_vector};

/// Relative error of the basis at the markers: |D′ − D| / |D|, Frobenius.
pub const RELATIVE_ERROR: f64 = 0.28;

/// Seeds of the wrong bases that the report and the tests use; nothing was tuned on them.
pub const WRONG_SEEDS: [u64; 5] = [201, 202, 203, 204, 205];

/// Standard deviations before the common factor: the logarithm of the gain, the turn about each axis (radians), the shift
/// along each axis (widths of the muscle).
const GAIN: f64 = 0.2;
const TURN: f64 = 0.12;
const SHIFT: f64 = 0.25;

/// The exponent of the weight goes no further than this, either way.
const LARGEST_EXPONENT: f64 = 1.0;

/// Halvings of the interval in which the common factor lies.
const HALVINGS: usize = 20;
const LARGEST_FACTOR: f64 = 16.0;

/// The actor with a basis that is [`RELATIVE_ERROR`] wrong, by chance.
///
/// # Panics
///
/// When the actor has a muscle that moves nothing, or the wrong basis is no longer sound.
pub fn wrong_actor(actor: &Actor, seed: u64) -> Arc<Actor> {
    let mut rng = Pcg64::seed_from_u64(seed);
    let n_muscles = actor.muscle_set().len();
    let mistakes: Vec<_> = (0..n_muscles)
        .map(|muscle| Mistake::random(actor, muscle, &mut rng))
        .collect();
    let (mut low, mut high) = (0.0, LARGEST_FACTOR);
    for _ in 0..HALVINGS {
        let factor = 0.5 * (low + high);
        if relative_error(actor, &mistakes, factor) < RELATIVE_ERROR {
            low = factor;
        } else {
            high = factor;
        }
    }
    let mut parts = actor.to_parts();
    let vertices = &actor.mesh().vertices;
    for (mistake, displacements) in mistakes.iter().zip(&mut parts.basis.displacements_cm) {
        let mistake = mistake.scaled(low);
        for (displacement, vertex) in displacements.iter_mut().zip(vertices) {
            *displacement = mistake.of(displacement, &vertex.0.coords);
        }
    }
    Arc::new(Actor::new(parts, RankPolicy::Regularize).unwrap().0)
}

/// |D′ − D| / |D| of two actors' bases at their markers, Frobenius.
pub fn error_at_markers(wrong: &Actor, right: &Actor) -> f64 {
    let [wrong, right] = [wrong, right].map(Actor::marker_basis);
    let all = |basis: &MarkerBasis| -> Vec<Vector3<f64>> {
        (0..basis.n_markers())
            .flat_map(|j| basis.of_marker_cm(j).to_vec())
            .collect()
    };
    relative(all(&wrong).into_iter().zip(all(&right)))
}

fn relative(pairs: impl Iterator<Item = (Vector3<f64>, Vector3<f64>)>) -> f64 {
    let (apart, size) = pairs.fold((0.0, 0.0), |(apart, size), (wrong, right)| {
        (
            apart + (wrong - right).norm_squared(),
            size + right.norm_squared(),
        )
    });
    (apart / size).sqrt()
}

/// The error at the markers without the rest of the face: their corners alone are moved.
fn relative_error(actor: &Actor, mistakes: &[Mistake], factor: f64) -> f64 {
    let mesh = actor.mesh();
    let pairs = mistakes.iter().enumerate().flat_map(|(muscle, mistake)| {
        let mistake = mistake.scaled(factor);
        let right = &actor.basis().displacements_cm[muscle];
        actor.virtual_markers().iter().map(move |place| {
            let corners = mesh.triangles[place.triangle].map(|it| it as usize);
            let mix = |of: &dyn Fn(usize) -> Vector3<f64>| -> Vector3<f64> {
                (corners.iter().zip(place.barycentric))
                    .map(|(&it, weight)| of(it) * weight)
                    .sum()
            };
            let wrong = |it: usize| mistake.of(&right[it], &mesh.vertices[it].0.coords);
            (mix(&wrong), mix(&|it| right[it]))
        })
    });
    relative(pairs)
}

/// What is wrong with one muscle.
#[derive(Clone, Copy)]
struct Mistake {
    log_gain: f64,
    turn: Vector3<f64>,
    /// In widths.
    shift: Vector3<f64>,
    center: Vector3<f64>,
    width: f64,
    rotation: Rotation3<f64>,
}

impl Mistake {
    fn random(actor: &Actor, muscle: usize, rng: &mut Pcg64) -> Self {
        let displacements = &actor.basis().displacements_cm[muscle];
        let vertices = actor.mesh().vertices.iter().map(|it| it.0.coords);
        let weighed = || {
            displacements
                .iter()
                .map(Vector3::norm_squared)
                .zip(vertices.clone())
        };
        let total: f64 = weighed().map(|(weight, _)| weight).sum();
        assert!(total > 0.0, "a muscle that moves nothing");
        let center = weighed()
            .map(|(weight, vertex)| weight * vertex)
            .sum::<Vector3<f64>>()
            / total;
        let spread = weighed().map(|(weight, vertex)| weight * (vertex - center).norm_squared());
        // Of a bump on a surface two axes spread.
        let width = (spread.sum::<f64>() / (2.0 * total)).sqrt();
        Self {
            log_gain: GAIN * normal(rng),
            turn: TURN * normal_vector(rng),
            shift: SHIFT * normal_vector(rng),
            center,
            width,
            rotation: Rotation3::identity(),
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self {
            log_gain: factor * self.log_gain,
            shift: factor * self.shift,
            rotation: Rotation3::from_scaled_axis(factor * self.turn),
            ..*self
        }
    }

    fn of(&self, displacement: &Vector3<f64>, vertex: &Vector3<f64>) -> Vector3<f64> {
        let along = self.shift.dot(&(vertex - self.center)) / self.width;
        let weight = along.clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT);
        (self.log_gain + weight).exp() * (self.rotation * displacement)
    }
}
