//! Wire types of `frontalis.v1`, with the words in which people read some of them, and the one way to read a chunk of the
//! files that hold them.
//!
//! Every message is also `serde`, in the protobuf JSON mapping: camel case, enums by name, 64-bit numbers as strings.
//!
//! The contracts of the streams are written in the `.proto` files under `frontalis/v1/`.
//! The code under `src/generated/` is made from them and committed, so that building needs no protobuf compiler;
//! `tests/generated_is_current.rs` fails when it is stale and says how to make it anew.

mod export_name;
mod field_mask;
mod take_chunk;
mod timestamp;
mod words;

pub use export_name::export_file_name;
pub use field_mask::{FieldMask, json_name};
pub use take_chunk::{MAX_TAKE_RECORD_BYTES, chunk_records};
pub use timestamp::Timestamp;

/// Version 1 of the protocol.
#[expect(
    missing_docs,
    clippy::all,
    clippy::pedantic,
    clippy::allow_attributes,
    clippy::allow_attributes_without_reason,
    reason = "generated code; its documentation is that of the .proto files"
)]
pub mod v1 {
    include!("generated/frontalis.v1.rs");
    include!("generated/frontalis.v1.serde.rs");
}

/// The compiled `.proto` files as a `google.protobuf.FileDescriptorSet`, for server reflection.
pub const FILE_DESCRIPTOR_SET: &[u8] = include_bytes!("generated/frontalis.v1.bin");
