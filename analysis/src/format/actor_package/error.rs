//! Why bytes are not an actor package.

use super::{FORMAT, MAX_PACKAGE_BYTES, archive::MAX_ENTRIES};
use crate::{
    face::actor::ActorError,
    format::{glb::GlbError, obj::ObjError},
};

/// The first thing that is wrong with a package.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PackageError {
    /// Larger than [`MAX_PACKAGE_BYTES`].
    #[error("the package has {found} bytes, at most {MAX_PACKAGE_BYTES} are accepted")]
    PackageSize {
        /// Its length.
        found: usize,
    },
    /// Neither ZIP nor GLB.
    #[error("not an actor package: neither a ZIP nor a GLB")]
    UnknownContainer,
    /// Compressed as a whole, or in a way other than deflate, or encrypted, or an archive in the archive.
    #[error("compressed, encrypted or nested archives are not accepted; send a plain ZIP or GLB")]
    Compressed,
    /// The ZIP itself is broken.
    #[error("the ZIP cannot be read: {0}")]
    Zip(&'static str),
    /// More files than a package can use.
    #[error("the ZIP has {found} entries, at most {MAX_ENTRIES} are accepted")]
    Entries {
        /// How many.
        found: usize,
    },
    /// A file unpacks to more than the limit.
    #[error("{file} unpacks to more than {limit_bytes} bytes")]
    FileSize {
        /// The file, escaped.
        file: String,
        /// What was left of the limit, bytes.
        limit_bytes: usize,
    },
    /// A file that `actor.json` names is not there.
    #[error("the ZIP has no file {file}")]
    MissingFile {
        /// The file, escaped.
        file: String,
    },
    /// A file's bytes do not unpack, or not to what their checksum says.
    #[error("{file} does not unpack: its data is damaged")]
    DamagedFile {
        /// The file, escaped.
        file: String,
    },
    /// A path that leaves the archive.
    #[error("{file} is not a path inside the package")]
    OutsidePath {
        /// The path, escaped.
        file: String,
    },
    /// `actor.json` or `extras.frontalis` does not say what it must.
    #[error("{place}, line {line}, column {column}: {message}")]
    Json {
        /// `actor.json` or `mesh.extras.frontalis`.
        place: &'static str,
        /// From 1.
        line: usize,
        /// From 1.
        column: usize,
        /// What is wrong, escaped.
        message: String,
    },
    /// Another format, or a later version.
    #[error("the package's format is {found}, this server reads {FORMAT}")]
    Format {
        /// What it says, escaped.
        found: String,
    },
    /// An OBJ cannot be used.
    #[error("{file}, {error}")]
    Obj {
        /// The file, escaped.
        file: String,
        /// The line and what is wrong with it.
        error: ObjError,
    },
    /// The neutral face has no surface.
    #[error("{file} has no faces; the neutral face needs them")]
    NoFaces {
        /// The file, escaped.
        file: String,
    },
    /// A shape brings faces of its own.
    #[error(
        "{file} has other faces than the neutral face: its vertices are in another order or number"
    )]
    Topology {
        /// The file, escaped.
        file: String,
    },
    /// The GLB cannot be read.
    #[error(transparent)]
    Glb(#[from] GlbError),
    /// A GLB that is no actor.
    #[error(
        "the mesh has no extras.frontalis: this glTF can be a character to retarget to, but is no actor"
    )]
    NotAnActor,
    /// A muscle without its morph target.
    #[error(
        "muscle {muscle} is the name of {found} morph targets in mesh.extras.targetNames, not of one"
    )]
    MorphTarget {
        /// The muscle, escaped.
        muscle: String,
        /// Targets of that name.
        found: usize,
    },
    /// The content does not make an actor.
    #[error(transparent)]
    Actor(#[from] ActorError),
}

impl PackageError {
    /// The identifier on the wire.
    pub fn reason(&self) -> &'static str {
        match self {
            Self::PackageSize { .. } | Self::Entries { .. } | Self::FileSize { .. } => "BASIS_SIZE",
            Self::UnknownContainer
            | Self::Zip(_)
            | Self::MissingFile { .. }
            | Self::DamagedFile { .. }
            | Self::NoFaces { .. } => "PARSE",
            Self::Compressed => "COMPRESSION",
            Self::OutsidePath { .. } => "EXTERNAL_REFERENCE",
            Self::Json { .. } | Self::Format { .. } => "JSON",
            Self::Obj { error, .. } => error.reason(),
            Self::Topology { .. } => "VERTEX_COUNT",
            Self::Glb(error) => error.reason(),
            Self::NotAnActor | Self::MorphTarget { .. } => "GLTF",
            Self::Actor(error) => error.reason(),
        }
    }
}
