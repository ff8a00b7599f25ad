//! Messages of `frontalis.v1` as JSON schemas.

use utoipa::openapi::{ObjectBuilder, Schema, Type};

/// The names of an enum's values, for queries.
pub fn enum_names(_name: &str) -> Schema {
    ObjectBuilder::new().schema_type(Type::String).into()
}
