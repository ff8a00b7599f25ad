//! The two spaces of a capture and the ways between them.
//!
//! Performance space {P} is the capture system's: its axes and origin, in centimeters after the unit conversion at the
//! boundary.
//! Model space {M} is the actor's: centimeters, +x the subject's left, +y up, +z forward.
//! A [`Similarity`] is the only way from {P} to {M}: ᴹp = s R ᴾp + t (Choe & Ko 2001, section 4.1.1).

use nalgebra::{Point3, UnitQuaternion, Vector3};

/// A point in the capture system's axes, in centimeters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerformancePoint(pub Point3<f64>);

impl PerformancePoint {
    /// A point from its coordinates in centimeters.
    pub fn new(x_cm: f64, y_cm: f64, z_cm: f64) -> Self {
        Self(Point3::new(x_cm, y_cm, z_cm))
    }
}

/// A point in the actor's model space, in centimeters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelPoint(pub Point3<f64>);

impl ModelPoint {
    /// A point from its coordinates in centimeters.
    pub fn new(x_cm: f64, y_cm: f64, z_cm: f64) -> Self {
        Self(Point3::new(x_cm, y_cm, z_cm))
    }
}

/// Unit of the coordinates that a capture system or a file states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// Thousandths of a meter.
    Millimeter,
    /// Hundredths of a meter, the unit of model space.
    Centimeter,
    /// Meters.
    Meter,
}

impl LengthUnit {
    /// How many centimeters one of this unit is.
    pub fn centimeters(self) -> f64 {
        match self {
            Self::Millimeter => 0.1,
            Self::Centimeter => 1.0,
            Self::Meter => 100.0,
        }
    }

    /// The performance point of coordinates that were sent as `f32` in this unit.
    ///
    /// Every way into the analysis uses this one conversion, so that a file and a stream give the same bits.
    pub fn performance_point(self, x: f32, y: f32, z: f32) -> PerformancePoint {
        let s = self.centimeters();
        PerformancePoint::new(f64::from(x) * s, f64::from(y) * s, f64::from(z) * s)
    }

    /// The customary abbreviation: `mm`, `cm`, `m`.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Millimeter => "mm",
            Self::Centimeter => "cm",
            Self::Meter => "m",
        }
    }
}

/// `model_from_performance`: scale, rotation, translation, in that order of application.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// Model centimeters per performance centimeter; positive.
    pub scale: f64,
    /// Proper rotation from {P} to {M}.
    pub rotation: UnitQuaternion<f64>,
    /// Translation in model space, centimeters.
    pub translation_cm: Vector3<f64>,
}

impl Similarity {
    /// ᴹp = s R ᴾp + t.
    pub fn to_model(&self, point: PerformancePoint) -> ModelPoint {
        let rotated = self.rotation * point.0.coords;
        ModelPoint(Point3::from(self.scale * rotated + self.translation_cm))
    }

    /// ᴾp = Rᵀ (ᴹp − t) / s.
    pub fn to_performance(&self, point: ModelPoint) -> PerformancePoint {
        let centered = (point.0.coords - self.translation_cm) / self.scale;
        PerformancePoint(Point3::from(self.rotation.inverse() * centered))
    }
}

/// The head's rigid motion since the neutral pose, in model space about its origin: `p_now` = R `p_neutral` + t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadPose {
    /// Rotation since the neutral pose.
    pub rotation: UnitQuaternion<f64>,
    /// Translation since the neutral pose, centimeters.
    pub translation_cm: Vector3<f64>,
}

impl HeadPose {
    /// No motion.
    pub fn identity() -> Self {
        Self {
            rotation: UnitQuaternion::identity(),
            translation_cm: Vector3::zeros(),
        }
    }

    /// Moves a point of the neutral head to where the head is now.
    pub fn apply(&self, point: ModelPoint) -> ModelPoint {
        ModelPoint(self.rotation * point.0 + self.translation_cm)
    }

    /// The motion that takes this one back.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.inverse();
        Self {
            rotation,
            translation_cm: -(rotation * self.translation_cm),
        }
    }
}
