//! Numerical methods that know no faces.

pub mod box_qp;
pub mod cholesky;
pub mod similarity_fit;
