//! Why a GLB cannot be read.

use super::{MAX_JSON_BYTES, MAX_NODES};

/// The first thing that is wrong with a GLB.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GlbError {
    /// The 12-byte header or the chunks do not add up.
    #[error("not a glTF 2.0 binary: {0}")]
    Container(&'static str),
    /// The JSON chunk is larger than any mesh of ours needs.
    #[error("the JSON chunk has {found} bytes, at most {MAX_JSON_BYTES} are accepted")]
    JsonSize {
        /// Its length.
        found: usize,
    },
    /// The JSON chunk is not glTF.
    #[error("the JSON chunk, line {line}, column {column}: {message}")]
    Json {
        /// From 1.
        line: usize,
        /// From 1.
        column: usize,
        /// The parser's words.
        message: String,
    },
    /// The JSON does not hold together.
    #[error("{path}: {message}")]
    Invalid {
        /// Where in the JSON.
        path: String,
        /// The validator's words.
        message: String,
    },
    /// A buffer or image lies outside the file.
    #[error("{what} {index} has a URI; everything must be inside the file, without data: URIs")]
    ExternalReference {
        /// `buffer` or `image`.
        what: &'static str,
        /// Its index.
        index: usize,
    },
    /// The file cannot be read without an extension that we do not have.
    #[error("the file requires extensions that are not supported: {}", names.join(", "))]
    RequiredExtension {
        /// Their names.
        names: Vec<String>,
    },
    /// More nodes than the limit.
    #[error("{found} nodes, at most {MAX_NODES} are accepted")]
    Nodes {
        /// How many.
        found: usize,
    },
    /// The nodes are not a tree.
    #[error("node {node} has two parents or is its own ancestor")]
    NodeTree {
        /// The node.
        node: usize,
    },
    /// A node moves, turns or scales the mesh.
    #[error("node {node} transforms the mesh; apply its transform before exporting")]
    Transformed {
        /// The node.
        node: usize,
    },
    /// Not exactly one mesh.
    #[error("one mesh is expected, found {found}")]
    Meshes {
        /// How many.
        found: usize,
    },
    /// Not exactly one primitive.
    #[error("the mesh must be one primitive (one material), found {found}")]
    Primitives {
        /// How many.
        found: usize,
    },
    /// Points, lines, strips or fans.
    #[error("the mesh must be of triangles; strips, fans, lines and points are not supported")]
    NotTriangles,
    /// The mesh has no `POSITION`.
    #[error("the mesh has no POSITION attribute")]
    NoPositions,
    /// The mesh has no indices.
    #[error("the mesh has no indices; export an indexed mesh")]
    NoIndices,
    /// A target moves no positions.
    #[error("morph target {target} has no POSITION attribute")]
    NoTargetPositions {
        /// The target.
        target: usize,
    },
    /// A target is not of this mesh.
    #[error("morph target {target} does not have {expected} vertices as the mesh has")]
    TargetCount {
        /// The target.
        target: usize,
        /// Vertices of the mesh.
        expected: usize,
    },
    /// The indices are not triples.
    #[error("{found} indices are not triples")]
    IndexCount {
        /// How many.
        found: usize,
    },
    /// `extras` of the mesh is not an object, or its `targetNames` not a list of names.
    #[error("mesh.extras.targetNames is not a list of names")]
    TargetNames,
    /// Not one name a target.
    #[error("mesh.extras.targetNames has {names} names for {targets} morph targets")]
    TargetNameCount {
        /// Names.
        names: usize,
        /// Targets.
        targets: usize,
    },
    /// An accessor that cannot be read.
    #[error("accessor {accessor}: {problem}")]
    Accessor {
        /// The accessor.
        accessor: usize,
        /// What is wrong with it.
        problem: AccessorProblem,
    },
    /// More of something than the named limit.
    #[error("{found} {what}, at most {limit} are accepted")]
    TooMany {
        /// Of what.
        what: &'static str,
        /// The limit.
        limit: usize,
        /// How many.
        found: usize,
    },
}

/// What is wrong with an accessor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AccessorProblem {
    /// There is no such accessor, view or buffer.
    #[error("it refers to something that does not exist")]
    Dangling,
    /// Not the component type or shape that its use demands.
    #[error("its type is not the one its use demands")]
    Type,
    /// Its bytes are not in the view, or the view's not in the buffer.
    #[error("its bytes lie outside its buffer")]
    Outside,
    /// Its stride is shorter than an element.
    #[error("its stride is shorter than an element")]
    Stride,
    /// More elements than any mesh that is accepted.
    #[error("it has more elements than any mesh that is accepted")]
    Count,
    /// Sparse indices that do not rise strictly or lie beyond the count.
    #[error("its sparse indices do not rise strictly below its count")]
    SparseIndices,
    /// No elements; glTF demands one.
    #[error("it has no elements")]
    Empty,
}

impl GlbError {
    /// The identifier on the wire.
    pub fn reason(&self) -> &'static str {
        match self {
            Self::ExternalReference { .. } => "EXTERNAL_REFERENCE",
            Self::RequiredExtension { .. } => "GLTF_EXTENSION",
            Self::TooMany { .. } | Self::JsonSize { .. } => "BASIS_SIZE",
            Self::TargetCount { .. } => "VERTEX_COUNT",
            Self::Container(_)
            | Self::Json { .. }
            | Self::Invalid { .. }
            | Self::Nodes { .. }
            | Self::NodeTree { .. }
            | Self::Transformed { .. }
            | Self::Meshes { .. }
            | Self::Primitives { .. }
            | Self::NotTriangles
            | Self::NoPositions
            | Self::NoIndices
            | Self::NoTargetPositions { .. }
            | Self::IndexCount { .. }
            | Self::TargetNames
            | Self::TargetNameCount { .. }
            | Self::Accessor { .. } => "GLTF",
        }
    }
}
