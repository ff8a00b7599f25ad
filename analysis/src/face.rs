//! The vocabulary of a face: markers, muscles, regions, the mesh, the actuation basis and the actor who has them all.

pub mod actor;
pub mod basis;
pub mod marker;
pub mod mesh;
pub mod muscle;
pub mod region;
