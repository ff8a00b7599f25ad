//! One value as a field's content, in the wire form.

use prost::encoding as wire;
use serde::{
    Deserialize, Deserializer,
    de::{
        self, DeserializeSeed, MapAccess, SeqAccess, Visitor,
        value::{Error as TextError, StrDeserializer},
    },
};

use super::{
    fault::{Found, Reading, Step},
    number::{self, Number},
    object::Object,
    schema::{self, Field, Kind},
};

/// A value on its way to its field.
pub(super) struct Value<'r> {
    pub(super) reading: &'r mut Reading,
    pub(super) field: &'static Field,
    /// Whether it is one of a list.
    pub(super) is_element: bool,
    pub(super) wire: &'r mut Vec<u8>,
}

impl Value<'_> {
    /// Refuses what is not due here.
    fn refuse<E: de::Error>(self) -> E {
        let reason = match self.field.kind {
            Kind::Enum(_) => "ENUM",
            _ => "JSON",
        };
        let what = format!("must be {}", self.expected());
        self.reading.refuse(Found::field(reason, what))
    }

    /// Whether a list is due, and not one value.
    fn is_list(&self) -> bool {
        self.field.is_list && !self.is_element
    }

    fn expected(&self) -> String {
        if self.is_list() {
            return "a list".to_owned();
        }
        match &self.field.kind {
            Kind::Bool => "true or false".to_owned(),
            Kind::Text => "text".to_owned(),
            Kind::Number(number_type) => number::expected(*number_type).to_owned(),
            Kind::Enum(name) => format!("one of {}", schema::enumeration(name).names()),
            Kind::Message(_) => "an object".to_owned(),
            Kind::Duration => "a duration in seconds, such as \"1.5s\"".to_owned(),
            Kind::Timestamp => "a time, such as \"2026-11-22T16:59:09Z\"".to_owned(),
            Kind::FieldMask => "the names of fields in camel case, with commas between".to_owned(),
            Kind::Unread => "left out".to_owned(),
        }
    }

    fn number<E: de::Error>(self, number: Number) -> Result<(), E> {
        let put = match &self.field.kind {
            _ if self.is_list() => None,
            Kind::Number(number_type) => number.put(*number_type, self.field.number, self.wire),
            Kind::Enum(name) => number
                .as_whole()
                .filter(|it| schema::enumeration(name).has(*it))
                .map(|it: i32| wire::int32::encode(self.field.number, &it, self.wire)),
            _ => None,
        };
        put.ok_or_else(|| self.refuse())
    }

    fn text(&mut self, text: &str) -> Option<()> {
        if self.is_list() {
            return None;
        }
        let tag = self.field.number;
        match &self.field.kind {
            Kind::Text => self.bytes(text.as_bytes()),
            Kind::Number(number_type) => {
                Number::of_text(text)?.put(*number_type, tag, self.wire)?;
            }
            Kind::Enum(name) => {
                let number = schema::enumeration(name).number(text)?;
                wire::int32::encode(tag, &number, self.wire);
            }
            Kind::Duration => self.message(&of_text::<pbjson_types::Duration>(text)?),
            Kind::Timestamp => self.message(&of_text::<frontalis_proto::Timestamp>(text)?),
            Kind::FieldMask => self.message(&of_text::<frontalis_proto::FieldMask>(text)?),
            Kind::Bool | Kind::Message(_) | Kind::Unread => return None,
        }
        Some(())
    }

    fn message(&mut self, message: &impl prost::Message) {
        self.bytes(&message.encode_to_vec());
    }

    fn bytes(&mut self, content: &[u8]) {
        let kind = wire::WireType::LengthDelimited;
        wire::encode_key(self.field.number, kind, self.wire);
        wire::encode_varint(content.len() as u64, self.wire);
        self.wire.extend_from_slice(content);
    }
}

/// What has a form of its own in the mapping, from its text.
fn of_text<'de, T: Deserialize<'de>>(text: &'de str) -> Option<T> {
    T::deserialize(StrDeserializer::<TextError>::new(text)).ok()
}

impl<'de> DeserializeSeed<'de> for Value<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Value<'_> {
    type Value = ();

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.expected())
    }

    /// Null: the field's default. A list has no defaults in it.
    fn visit_unit<E: de::Error>(self) -> Result<(), E> {
        if !self.is_element {
            return Ok(());
        }
        if matches!(self.field.kind, Kind::Number(_)) {
            let what =
                "must be a number and not null: what was not seen is \"NaN\", three for a marker";
            return Err(self.reading.refuse(Found::field("JSON", what)));
        }
        Err(self.refuse())
    }

    fn visit_bool<E: de::Error>(self, value: bool) -> Result<(), E> {
        if self.is_list() || !matches!(self.field.kind, Kind::Bool) {
            return Err(self.refuse());
        }
        wire::bool::encode(self.field.number, &value, self.wire);
        Ok(())
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<(), E> {
        self.number(Number::Whole(number.into()))
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<(), E> {
        self.number(Number::Whole(number.into()))
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<(), E> {
        self.number(Number::Real(number))
    }

    fn visit_str<E: de::Error>(mut self, text: &str) -> Result<(), E> {
        self.text(text).ok_or_else(|| self.refuse())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<(), A::Error> {
        if !self.is_list() {
            return Err(self.refuse());
        }
        for idx in 0.. {
            let element = Value {
                reading: self.reading,
                field: self.field,
                is_element: true,
                wire: self.wire,
            };
            match elements.next_element_seed(element) {
                Ok(Some(())) => {}
                Ok(None) => break,
                Err(error) => {
                    self.reading.behind(Step::Element(idx));
                    return Err(error);
                }
            }
        }
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(mut self, map: A) -> Result<(), A::Error> {
        let Kind::Message(name) = &self.field.kind else {
            return Err(self.refuse());
        };
        if self.is_list() {
            return Err(self.refuse());
        }
        let mut content = Vec::new();
        let object = Object {
            reading: self.reading,
            message: schema::message(name),
            in_path: &[],
            wire: &mut content,
        };
        object.take(map)?;
        self.bytes(&content);
        Ok(())
    }
}
