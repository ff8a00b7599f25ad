//! Schemas of parameters that a Rust type does not say.

use utoipa::openapi::{ObjectBuilder, Schema, Type};

use super::{limits, messages};

/// A unit by name.
pub fn length_unit() -> Schema {
    ObjectBuilder::new()
        .schema_type(Type::String)
        .enum_values(Some(messages::names_of("LengthUnit")))
        .into()
}

/// A name for people.
pub fn display_name() -> Schema {
    ObjectBuilder::new()
        .schema_type(Type::String)
        .max_length(Some(limits::DISPLAY_NAME_LENGTH))
        .pattern(Some(limits::DISPLAY_NAME))
        .into()
}
