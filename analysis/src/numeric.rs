//! Numerical methods that know no faces.

pub mod box_qp;
pub(crate) mod dot;
pub mod factor;
pub mod inverse;
pub mod lanes;
pub mod posterior;
pub mod similarity_fit;
