//! `CurveService`: curves out.
