//! What each message has in JSON: its fields by both of their names, and what each of them holds.

use std::{collections::BTreeMap, sync::LazyLock};

use prost_types::{
    DescriptorProto, EnumDescriptorProto, FieldDescriptorProto,
    field_descriptor_proto::{Label, Type},
};

use crate::service::http::descriptors;

static PROTOCOL: LazyLock<Protocol> = LazyLock::new(Protocol::of_the_descriptors);

/// Every message and enum, by name.
struct Protocol {
    messages: BTreeMap<String, MessageType>,
    enums: BTreeMap<String, EnumType>,
}

/// A message's fields.
#[derive(Debug)]
pub(super) struct MessageType {
    /// Without the package.
    pub(super) name: String,
    fields: Vec<Field>,
}

/// One field.
#[derive(Debug)]
pub(super) struct Field {
    /// In camel case.
    pub(super) json_name: String,
    /// As the `.proto` file has it.
    name: String,
    /// On the wire.
    pub(super) number: u32,
    /// Whether it holds a list.
    pub(super) is_list: bool,
    /// What it holds, or each element of the list.
    pub(super) kind: Kind,
}

/// What a field holds.
#[derive(Debug)]
pub(super) enum Kind {
    Bool,
    Text,
    /// `Type` is one of the types of numbers.
    Number(Type),
    Enum(String),
    Message(String),
    Duration,
    Timestamp,
    FieldMask,
    /// Bytes, and what proto3 has not: in no message that is read from JSON.
    Unread,
}

/// An enum's values.
#[derive(Debug)]
pub(in crate::service::http) struct EnumType {
    /// Names and numbers.
    values: Vec<(String, i32)>,
    /// With what each name begins.
    prefix: String,
}

/// The message of this name, without its package.
pub(super) fn message(name: &str) -> &'static MessageType {
    PROTOCOL
        .messages
        .get(name)
        .expect("invariant: the descriptors hold every message of the code that was made of them")
}

/// The enum of this name, without its package.
pub(in crate::service::http) fn enumeration(name: &str) -> &'static EnumType {
    PROTOCOL
        .enums
        .get(name)
        .expect("invariant: the descriptors hold every enum of the code that was made of them")
}

impl Protocol {
    fn of_the_descriptors() -> Self {
        let (mut messages, mut enums) = (BTreeMap::new(), BTreeMap::new());
        for file in descriptors::files() {
            let named = |it: &DescriptorProto| (it.name().to_owned(), MessageType::new(it));
            messages.extend(file.message_type.iter().map(named));
            let named = |it: &EnumDescriptorProto| (it.name().to_owned(), EnumType::new(it));
            enums.extend(file.enum_type.iter().map(named));
        }
        Self { messages, enums }
    }
}

impl MessageType {
    fn new(descriptor: &DescriptorProto) -> Self {
        Self {
            name: descriptor.name().to_owned(),
            fields: descriptor.field.iter().map(Field::new).collect(),
        }
    }

    /// The field of this name, in either spelling, and its place in the message.
    pub(super) fn field(&self, name: &str) -> Option<(usize, &Field)> {
        let mut fields = self.fields.iter().enumerate();
        fields.find(|(_, it)| it.json_name == name || it.name == name)
    }

    /// In the order of the `.proto` file.
    pub(super) fn fields(&self) -> &[Field] {
        &self.fields
    }
}

impl Field {
    fn new(descriptor: &FieldDescriptorProto) -> Self {
        Self {
            json_name: descriptor.json_name().to_owned(),
            name: descriptor.name().to_owned(),
            number: descriptor.number().unsigned_abs(),
            is_list: descriptor.label() == Label::Repeated,
            kind: Kind::new(descriptor),
        }
    }
}

impl Kind {
    fn new(descriptor: &FieldDescriptorProto) -> Self {
        let named = || descriptors::bare(descriptor.type_name()).map(str::to_owned);
        match descriptor.r#type() {
            Type::Bool => Self::Bool,
            Type::String => Self::Text,
            Type::Enum => named().map_or(Self::Unread, Self::Enum),
            Type::Message => match descriptor.type_name() {
                ".google.protobuf.Duration" => Self::Duration,
                ".google.protobuf.Timestamp" => Self::Timestamp,
                ".google.protobuf.FieldMask" => Self::FieldMask,
                _ => named().map_or(Self::Unread, Self::Message),
            },
            Type::Bytes | Type::Group => Self::Unread,
            number => Self::Number(number),
        }
    }
}

impl EnumType {
    fn new(descriptor: &EnumDescriptorProto) -> Self {
        let values = descriptor.value.iter();
        let values: Vec<_> = values
            .map(|it| (it.name().to_owned(), it.number()))
            .collect();
        // Every enum starts so.
        let first = values.first().map(|(name, _)| name.as_str());
        let prefix = first.and_then(|it| it.strip_suffix("UNSPECIFIED"));
        Self {
            prefix: prefix.unwrap_or_default().to_owned(),
            values,
        }
    }

    /// The number of a value by its name.
    pub(super) fn number(&self, name: &str) -> Option<i32> {
        let value = self.values.iter().find(|(it, _)| it == name);
        value.map(|(_, number)| *number)
    }

    /// The number of a value by its name or by what follows the enum's own name in it, in letters of either case.
    pub(in crate::service::http) fn number_of_word(&self, word: &str) -> Option<i32> {
        let name = word.to_ascii_uppercase();
        self.number(&name)
            .or_else(|| self.number(&format!("{}{name}", self.prefix)))
    }

    /// Whether a value has this number.
    pub(super) fn has(&self, number: i32) -> bool {
        self.values.iter().any(|(_, it)| *it == number)
    }

    /// All names, for a person.
    pub(in crate::service::http) fn names(&self) -> String {
        let names: Vec<_> = self.values.iter().map(|(name, _)| name.as_str()).collect();
        names.join(", ")
    }
}
