//! Why parts do not make an actor, and what is odd about one that was made.

use std::fmt;

/// The first thing that keeps parts from being an actor.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ActorError {
    /// More of something than the named limit.
    #[error("{found} {what}, at most {limit} are accepted")]
    TooMany {
        /// `markers`, `muscles`, `vertices`, `triangles`, or `displacements (muscles × vertices)`.
        what: &'static str,
        /// The limit.
        limit: usize,
        /// How many there are.
        found: usize,
    },
    /// None of something that an actor cannot be without.
    #[error("an actor needs at least one of its {what}, there are none")]
    None {
        /// `markers`, `muscles`, `vertices`, `triangles`.
        what: &'static str,
    },
    /// A name that cannot be used.
    #[error("the name of {what} {index} {problem}")]
    Name {
        /// `muscle`, `marker`, `display name`, `muscle set`.
        what: &'static str,
        /// Its place in the order, from 0.
        index: usize,
        /// What is wrong with it.
        problem: NameProblem,
    },
    /// Two muscles or two markers of one name.
    #[error("{what} {first} and {what} {second} are both named {name}")]
    DuplicateName {
        /// `muscle` or `marker`.
        what: &'static str,
        /// The name; a valid one.
        name: String,
        /// The first place, from 0.
        first: usize,
        /// The second place.
        second: usize,
    },
    /// A coordinate that is NaN, infinite, or beyond the range of `f32`.
    #[error("{what}, vertex {vertex}: a coordinate is not a finite number")]
    NonFiniteVertex {
        /// `neutral face`, or `shape <name>`.
        what: String,
        /// The vertex, from 0.
        vertex: usize,
    },
    /// A hand-marked position that is not finite.
    #[error("the position of marker {marker} is not finite")]
    NonFiniteMarker {
        /// The marker's name.
        marker: String,
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {vertex}, the mesh has {n_vertices}")]
    FaceIndex {
        /// The triangle, from 0.
        triangle: usize,
        /// The vertex, from 0.
        vertex: u32,
        /// How many there are.
        n_vertices: usize,
    },
    /// Not one basis element a muscle.
    #[error("{muscles} muscles, but {shapes} shapes")]
    ShapeCount {
        /// Muscles.
        muscles: usize,
        /// Basis elements.
        shapes: usize,
    },
    /// A shape's vertices are not those of the neutral face.
    #[error("shape {shape} has {found} vertices, the neutral face has {expected}")]
    VertexCount {
        /// The muscle's name.
        shape: String,
        /// Vertices of the neutral face.
        expected: usize,
        /// Vertices of the shape.
        found: usize,
    },
    /// A marker's place on the mesh means nothing.
    #[error("marker {marker}: {problem}")]
    Barycentric {
        /// The marker's name.
        marker: String,
        /// What is wrong with it.
        problem: BarycentricProblem,
    },
    /// The markers cannot tell some muscles apart.
    #[error(
        "the basis is rank-deficient at the markers (condition number {condition:.3e}): {}",
        few(columns)
    )]
    BasisRank {
        /// Names of the muscles concerned.
        columns: Vec<String>,
        /// Ratio of the singular values of the markers' basis with columns of unit length.
        condition: f64,
    },
}

impl ActorError {
    /// The identifier on the wire.
    pub fn reason(&self) -> &'static str {
        match self {
            Self::TooMany { .. } => "BASIS_SIZE",
            Self::None { .. } => "PARSE",
            Self::Name { .. } | Self::DuplicateName { .. } => "NAME",
            Self::NonFiniteVertex { .. } | Self::NonFiniteMarker { .. } => "NON_FINITE",
            Self::FaceIndex { .. } => "FACE_INDEX",
            Self::ShapeCount { .. } | Self::VertexCount { .. } => "VERTEX_COUNT",
            Self::Barycentric { .. } => "BARYCENTRIC",
            Self::BasisRank { .. } => "BASIS_RANK",
        }
    }
}

/// What is wrong with a name. The name itself is not repeated: it may hold anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NameProblem {
    /// No character at all, or only spaces.
    Empty,
    /// Longer than the limit, in characters.
    TooLong {
        /// The limit.
        limit: usize,
    },
    /// A character that is not allowed there.
    Character {
        /// Its place, from 0.
        position: usize,
        /// Its code point.
        code_point: u32,
    },
}

impl fmt::Display for NameProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "is empty"),
            Self::TooLong { limit } => write!(f, "has more than {limit} characters"),
            Self::Character {
                position,
                code_point,
            } => write!(f, "may not hold U+{code_point:04X} at position {position}"),
        }
    }
}

/// What is wrong with a marker's place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BarycentricProblem {
    /// The weights do not sum to 1.
    Sum(f64),
    /// A weight is negative or not a number.
    Weight(f64),
    /// There is no such triangle.
    Triangle {
        /// The triangle that was named.
        triangle: usize,
        /// How many there are.
        n_triangles: usize,
    },
    /// The triangle has no area.
    Degenerate(usize),
    /// There is no such vertex.
    Vertex {
        /// The vertex that was named.
        vertex: usize,
        /// How many there are.
        n_vertices: usize,
    },
    /// The vertex belongs to no triangle with an area.
    Isolated(usize),
    /// The whole mesh has no triangle with an area.
    NoSurface,
}

impl fmt::Display for BarycentricProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sum(sum) => write!(f, "its weights sum to {sum}, not 1"),
            Self::Weight(weight) => write!(f, "its weight {weight} is not between 0 and 1"),
            Self::Triangle {
                triangle,
                n_triangles,
            } => write!(
                f,
                "there is no triangle {triangle}, the mesh has {n_triangles}"
            ),
            Self::Degenerate(triangle) => write!(f, "triangle {triangle} has no area"),
            Self::Vertex { vertex, n_vertices } => {
                write!(f, "there is no vertex {vertex}, the mesh has {n_vertices}")
            }
            Self::Isolated(vertex) => {
                write!(f, "vertex {vertex} belongs to no triangle with an area")
            }
            Self::NoSurface => write!(f, "no triangle of the mesh has an area"),
        }
    }
}

/// Something odd about an actor that was accepted all the same.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ActorWarning {
    /// Triangles without area.
    #[error(
        "{count} triangles have no area, the first is triangle {first}; no marker can lie on them"
    )]
    DegenerateTriangles {
        /// How many.
        count: usize,
        /// The first, from 0.
        first: usize,
    },
    /// Vertices that no triangle uses.
    #[error("{count} vertices belong to no triangle, the first is vertex {first}")]
    IsolatedVertices {
        /// How many.
        count: usize,
        /// The first, from 0.
        first: usize,
    },
    /// Edges of more than two triangles.
    #[error("{count} edges have more than two triangles, the first joins vertices {} and {}", first[0], first[1])]
    NonManifoldEdges {
        /// How many.
        count: usize,
        /// The vertices of the first, from 0.
        first: [u32; 2],
    },
    /// The face is not of a face's size: probably the wrong unit.
    #[error("the neutral face spans {extent_cm:.3} cm; is its unit right?")]
    UnlikelyExtent {
        /// The longest side of its box, centimeters.
        extent_cm: f64,
    },
    /// A hand-marked position far off the surface.
    #[error("marker {marker} was marked {distance_cm:.2} cm off the surface")]
    MarkerOffSurface {
        /// The marker's name.
        marker: String,
        /// How far off, centimeters.
        distance_cm: f64,
    },
    /// The markers cannot tell some muscles apart; accepted on request.
    #[error(
        "the basis is rank-deficient at the markers (condition number {condition:.3e}), the solver shares the motion among: {}",
        few(columns)
    )]
    BasisRank {
        /// Names of the muscles concerned.
        columns: Vec<String>,
        /// Ratio of the singular values of the markers' basis with columns of unit length.
        condition: f64,
    },
}

/// The first few names, and how many more.
fn few(names: &[String]) -> String {
    const SHOWN: usize = 8;
    let shown = names[..names.len().min(SHOWN)].join(", ");
    match names.len().saturating_sub(SHOWN) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}
