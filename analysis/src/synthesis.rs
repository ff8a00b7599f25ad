//! From contractions to shape: the blend E = E₀ + Σ xᵢeᵢ, pseudo-muscles, expressions, and a face made of them.

pub mod blend;
pub mod expression;
pub mod pseudo_muscle;
pub mod reference_face;
