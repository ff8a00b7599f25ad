//! Numerical methods that know no faces.

pub mod box_qp;
pub mod factor;
pub mod similarity_fit;
