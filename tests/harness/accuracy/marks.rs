//! The marks that the default settings and the plain ones are held to.

use super::real_take::RealTake;

/// RMS error of synthetic performances at 0.2, 0.5 and 1 mm of noise, moving head: plain settings.
pub const PLAIN_RMS: [f64; 3] = [0.015, 0.035, 0.07];

/// The same, default settings.
pub const DEFAULT_RMS: [f64; 3] = [0.009, 0.018, 0.032];

/// The same at 0.5 mm with 10 % occlusion and 2 % outliers, default settings.
pub const CORRUPTED_RMS: f64 = 0.027;

/// Mean absolute error of real takes, default settings.
pub const TAKES: [(RealTake, f64); 5] = [
    (RealTake::new("ns164", "muscle16_27"), 0.0070),
    (RealTake::new("facegood_speech", "muscle16_27"), 0.0053),
    (RealTake::new("llv", "muscle16_27"), 0.0105),
    (RealTake::new("ns164", "facs30_60"), 0.0078),
    (RealTake::new("llv", "facs30_60"), 0.013),
];

/// What occlusion and outliers may make of the error of a real take, as a multiple of the clean one.
pub const CORRUPTED_RATIO: f64 = 1.15;

/// Largest mean error of a blink's peak.
pub const BLINK_PEAK: f64 = 0.03;

/// Largest bias of small contractions.
pub const SMALL_BIAS: f64 = 0.005;

/// Largest multiple of the error of plain settings with robust weights that the default may have under a wrong basis.
pub const WRONG_BASIS_RATIO: f64 = 1.03;

/// Shares of true contractions within the claimed 68 % and 95 % intervals.
pub const COVERAGE: [std::ops::RangeInclusive<f64>; 2] = [0.60..=0.76, 0.90..=0.98];
