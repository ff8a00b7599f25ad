//! CPU time of one frame of the camera stage: 32 markers (27 + 5 head-fixed) projected through five cameras and triangulated.

use std::hint::black_box;

use frontalis_analysis::{
    space::PerformancePoint,
    stage::{camera::ImagePoint, rig::CameraRig},
    synthesis::reference_face,
};
use nalgebra::{Unit, UnitQuaternion, Vector3};

mod cpu_clock;

fn main() {
    let product = cpu_clock::matrix_vector_nanos();
    cpu_clock::print_row("bare matrix-vector product, 81 x 16", product, product);
    let whole = project_and_triangulate_nanos();
    cpu_clock::print_row(
        "32 markers: project, five cameras, triangulate",
        whole,
        product,
    );
    let back = triangulate_nanos();
    cpu_clock::print_row("32 markers: triangulate only", back, product);
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

fn project_and_triangulate_nanos() -> f64 {
    let (rig, markers) = (rig(), markers());
    cpu_clock::median_nanos(|| {
        let mut sum = Vector3::zeros();
        for (marker, normal) in black_box(&markers) {
            if let Ok(place) = rig.triangulate(rig.views(*marker, normal)) {
                sum += place.0.coords;
            }
        }
        black_box(sum);
    })
}

fn triangulate_nanos() -> f64 {
    let (rig, markers) = (rig(), markers());
    let views: Vec<Vec<Option<ImagePoint>>> = markers
        .iter()
        .map(|(marker, normal)| rig.views(*marker, normal).collect())
        .collect();
    cpu_clock::median_nanos(|| {
        let mut sum = Vector3::zeros();
        for seen in black_box(&views) {
            if let Ok(place) = rig.triangulate(seen.iter().copied()) {
                sum += place.0.coords;
            }
        }
        black_box(sum);
    })
}
