//! A unit of length as a person types it.

use clap::ValueEnum;
use frontalis_analysis::space::LengthUnit;

/// Of a file that does not state one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Unit {
    /// Millimeters
    Mm,
    /// Centimeters
    Cm,
    /// Meters
    M,
}

impl From<Unit> for LengthUnit {
    fn from(unit: Unit) -> Self {
        match unit {
            Unit::Mm => Self::Millimeter,
            Unit::Cm => Self::Centimeter,
            Unit::M => Self::Meter,
        }
    }
}
