//! An object as a message: each member goes to its field, and no field comes twice.

use serde::{
    Deserializer,
    de::{DeserializeSeed, MapAccess, Visitor},
};

use super::{
    fault::{Found, Reading, Step},
    schema::{Field, MessageType},
    value::Value,
};

/// A message on its way from an object to its wire form.
pub(super) struct Object<'r> {
    pub(super) reading: &'r mut Reading,
    pub(super) message: &'static MessageType,
    /// Fields that must not be there.
    pub(super) in_path: &'static [&'static str],
    pub(super) wire: &'r mut Vec<u8>,
}

impl Object<'_> {
    pub(super) fn take<'de, A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Self {
            reading,
            message,
            in_path,
            wire,
        } = self;
        reading.begin_object()?;
        let mut has_come = vec![false; message.fields().len()];
        while let Some((idx, field)) = map.next_key_seed(Key { reading, message })? {
            if std::mem::replace(&mut has_come[idx], true) {
                reading.behind(Step::Field(&field.json_name));
                return Err(reading.refuse(Found::field("JSON", "stands twice")));
            }
            if in_path.contains(&field.json_name.as_str()) {
                reading.behind(Step::Field(&field.json_name));
                let what = "is said by the path already";
                return Err(reading.refuse(Found::field("JSON", what)));
            }
            let value = Value {
                reading,
                field,
                is_element: false,
                wire,
            };
            if let Err(error) = map.next_value_seed(value) {
                reading.behind(Step::Field(&field.json_name));
                return Err(error);
            }
        }
        Ok(())
    }
}

/// The object that a text is.
pub(super) struct Whole<'r>(pub(super) Object<'r>);

impl Whole<'_> {
    pub(super) fn read<'de, D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Whole<'_> {
    type Value = ();

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<(), A::Error> {
        self.0.take(map)
    }
}

/// The name of a member, which must be that of a field.
struct Key<'r> {
    reading: &'r mut Reading,
    message: &'static MessageType,
}

impl<'de> DeserializeSeed<'de> for Key<'_> {
    type Value = (usize, &'static Field);

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl Visitor<'_> for Key<'_> {
    type Value = (usize, &'static Field);

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("the name of a field")
    }

    fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<Self::Value, E> {
        let message = self.message;
        message.field(name).ok_or_else(|| {
            let what = format!("a field that {} does not have", message.name);
            self.reading.refuse(Found::text("JSON", what))
        })
    }
}
