//! The cameras as they really are: noisy, and now and then blind to a marker.

use frontalis_analysis::{
    space::PerformancePoint,
    stage::{camera::ImagePoint, rig::CameraRig},
};
use nalgebra::Vector3;
use rand::RngExt as _;
use rand_pcg::Pcg64;

/// What is wrong with the cameras.
#[derive(Clone, Copy, Debug)]
pub(super) struct Optics {
    /// Standard deviation of a place in an image, pixels an axis.
    pub(super) pixel_noise: f64,
    /// How likely a camera overlooks a marker.
    pub(super) misses: f64,
}

/// A rig that observes markers with error.
pub(super) struct ObservedRig {
    rig: CameraRig,
    optics: Optics,
    generator: Pcg64,
}

impl ObservedRig {
    pub(super) fn new(rig: CameraRig, optics: Optics, generator: Pcg64) -> Self {
        Self {
            rig,
            optics,
            generator,
        }
    }

    /// Where the cameras find a marker on a surface with the unit `normal`; `None` with fewer than two views.
    pub(super) fn observe(
        &mut self,
        marker: PerformancePoint,
        normal: &Vector3<f64>,
    ) -> Option<PerformancePoint> {
        let (optics, generator) = (self.optics, &mut self.generator);
        let views = self.rig.views(marker, normal);
        let seen = views.map(|view| view.and_then(|exact| imaged(exact, optics, generator)));
        self.rig.triangulate(seen).ok()
    }
}

fn imaged(exact: ImagePoint, optics: Optics, generator: &mut Pcg64) -> Option<ImagePoint> {
    let missed = generator.random_bool(optics.misses);
    let [right, down] = normal_pair(generator);
    (!missed).then_some(ImagePoint {
        u_px: exact.u_px + optics.pixel_noise * right,
        v_px: exact.v_px + optics.pixel_noise * down,
    })
}

/// Two independent numbers of the standard normal distribution (Box & Muller 1958).
fn normal_pair(generator: &mut Pcg64) -> [f64; 2] {
    let uniform: f64 = generator.random();
    let angle_radians = std::f64::consts::TAU * generator.random::<f64>();
    let radius = (-2.0 * (1.0 - uniform).ln()).sqrt();
    [radius * angle_radians.cos(), radius * angle_radians.sin()]
}
