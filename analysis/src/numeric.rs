//! Numerical methods that know no faces.

pub mod box_qp;
pub(crate) mod dot;
pub mod factor;
pub mod inverse;
pub mod lanes;
mod pivots;
pub mod posterior;
pub(crate) mod projection;
pub mod similarity_fit;
pub mod standing_qp;
pub mod tape;
