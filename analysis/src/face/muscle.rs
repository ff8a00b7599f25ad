//! Muscles and the ordered set of them that a stream's activations follow.

use super::region::FaceRegion;

/// One element of the actuation basis by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Muscle {
    /// Spelled in full: `zygomatic_major_left`.
    pub name: String,
    /// The region whose markers observe it.
    pub region: FaceRegion,
}

/// The muscles of an actor; their order is the order of every activation vector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MuscleSet {
    id: String,
    muscles: Vec<Muscle>,
}

impl MuscleSet {
    /// A set from its vocabulary's id (`choe-ko-16`) and its muscles; names are unique by [`super::actor::Actor`]'s check.
    pub(crate) fn new(id: String, muscles: Vec<Muscle>) -> Self {
        Self { id, muscles }
    }

    /// The vocabulary's id: `choe-ko-16`, `fidaleo-neumann-16`, or the package's own.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// The muscles in order.
    pub fn muscles(&self) -> &[Muscle] {
        &self.muscles
    }

    /// Number of muscles, m.
    pub fn len(&self) -> usize {
        self.muscles.len()
    }

    /// Whether there is no muscle.
    pub fn is_empty(&self) -> bool {
        self.muscles.is_empty()
    }

    /// The muscle's place in the order.
    pub fn index_of(&self, name: &str) -> Option<usize> {
        self.muscles.iter().position(|it| it.name == name)
    }
}
