//! One frame of the camera stage: project 32 markers (27 + 5 head-fixed) through five cameras, triangulate them again.
//!
//! Beside it, for scale, the bare product of an 81 × 16 matrix and a vector: what 27 markers × 16 muscles cost at least.

use divan::{Bencher, black_box};
use frontalis_analysis::{
    space::PerformancePoint,
    stage::{camera::ImagePoint, rig::CameraRig},
    synthesis::reference_face,
};
use nalgebra::{DMatrix, DVector, Unit, UnitQuaternion, Vector3};

fn main() {
    divan::main();
}

/// The markers of the reference face with the normals of the skin under them; model space serves as the stage.
fn markers() -> Vec<(PerformancePoint, Vector3<f64>)> {
    let actor = reference_face::actor();
    let of_place = |place: &frontalis_analysis::face::marker::VirtualMarker| {
        let [a, b, c] = actor.mesh().corners(place.triangle).map(|corner| corner.0);
        let normal = Unit::new_normalize((b - a).cross(&(c - a)));
        (
            PerformancePoint(place.position(actor.mesh()).0),
            normal.into_inner(),
        )
    };
    actor.virtual_markers().iter().map(of_place).collect()
}

fn rig() -> CameraRig {
    let target = PerformancePoint::new(0.0, -2.0, 8.0);
    CameraRig::arc(5, target, UnitQuaternion::identity()).expect("five cameras are a rig")
}

#[divan::bench]
fn project_five_cameras_and_triangulate_32_markers(bencher: Bencher) {
    let (rig, markers) = (rig(), markers());
    bencher.bench_local(|| {
        let mut sum = Vector3::zeros();
        for (marker, normal) in black_box(&markers) {
            if let Ok(place) = rig.triangulate(rig.views(*marker, normal)) {
                sum += place.0.coords;
            }
        }
        sum
    });
}

#[divan::bench]
fn triangulate_32_markers(bencher: Bencher) {
    let (rig, markers) = (rig(), markers());
    let views: Vec<Vec<Option<ImagePoint>>> = markers
        .iter()
        .map(|(marker, normal)| rig.views(*marker, normal).collect())
        .collect();
    bencher.bench_local(|| {
        let mut sum = Vector3::zeros();
        for seen in black_box(&views) {
            if let Ok(place) = rig.triangulate(seen.iter().copied()) {
                sum += place.0.coords;
            }
        }
        sum
    });
}

#[divan::bench]
fn bare_matrix_vector_product_81_by_16(bencher: Bencher) {
    let matrix = DMatrix::from_fn(81, 16, |row, column| ((row * 16 + column) as f64).sin());
    let vector = DVector::from_fn(16, |row, _| row as f64 / 16.0);
    let mut product = DVector::zeros(81);
    bencher.bench_local(move || {
        product.gemv(1.0, black_box(&matrix), black_box(&vector), 0.0);
        black_box(product.sum())
    });
}
