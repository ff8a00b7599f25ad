//! The protocol as its own descriptors say it, from the binary.

use frontalis_proto::FILE_DESCRIPTOR_SET;
use prost::Message as _;
use prost_types::{FileDescriptorProto, FileDescriptorSet};

/// The package whose messages these are.
const PACKAGE: &str = "frontalis.v1";

/// The files of the protocol, without those that they import.
pub(super) fn files() -> impl Iterator<Item = FileDescriptorProto> {
    let set = FileDescriptorSet::decode(FILE_DESCRIPTOR_SET)
        .expect("invariant: the descriptors in the binary are those that the build made");
    set.file.into_iter().filter(|it| it.package() == PACKAGE)
}

/// The name of a message or enum of ours, without its package.
pub(super) fn bare(type_name: &str) -> Option<&str> {
    type_name.strip_prefix(".frontalis.v1.")
}
