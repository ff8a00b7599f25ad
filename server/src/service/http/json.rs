//! JSON as a message, in the protobuf JSON mapping; what is wrong with it is told by its place.
//!
//! The text is read once, along the descriptors, into the message's wire form, so that every door's messages come from
//! one decoder. Read are both names of a field, numbers as text and as `1.3e1`, enums by name or number, and null for a
//! default; unknown and repeated fields are refused (BAD_INPUT D12, E6). What a client sent is not repeated.

mod fault;
mod number;
mod object;
mod schema;
mod value;

use prost::{Message, Name};

use self::{
    fault::Reading,
    object::{Object, Whole},
};

pub(super) use fault::Fault;
pub(super) use number::Number;
pub(super) use schema::enumeration;

/// What a text may hold beside its message's form.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rules {
    /// Fields that the path says, as JSON names them: the text must not.
    pub in_path: &'static [&'static str],
    /// Most JSON objects: a short text must not become a large list (BAD_INPUT E5).
    pub max_objects: usize,
}

/// Reads a message from the text that holds it and nothing else.
pub(super) fn read<M: Message + Name + Default>(text: &[u8], rules: Rules) -> Result<M, Fault> {
    let mut reading = Reading::new(rules.max_objects);
    let mut wire = Vec::new();
    let whole = Whole(Object {
        reading: &mut reading,
        message: schema::message(M::NAME),
        in_path: rules.in_path,
        wire: &mut wire,
    });
    let mut parser = serde_json::Deserializer::from_slice(text);
    whole
        .read(&mut parser)
        .and_then(|()| parser.end())
        .map_err(|error| reading.fault(&error))?;
    let read = M::decode(wire.as_slice());
    Ok(read.expect("invariant: what was written along the descriptors is the message"))
}

#[cfg(test)]
mod tests;
