//! The actuation basis: how every vertex moves when one muscle contracts fully (Choe & Ko 2001, section 3).

use nalgebra::Vector3;

/// Displacements eᵢ = Eᵢ − E₀ of all vertices, one list a muscle.
#[derive(Clone, Debug, PartialEq)]
pub struct ActuationBasis {
    /// `displacements_cm[muscle][vertex]`, centimeters; finite.
    pub displacements_cm: Vec<Vec<Vector3<f64>>>,
}
