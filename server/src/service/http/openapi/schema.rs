//! One message or enum as a JSON schema, in the protobuf JSON mapping.
//!
//! What is read may have numbers as text, enums as numbers, and null for a default; what is written has one form only.

use prost_types::{
    DescriptorProto, EnumDescriptorProto, EnumValueDescriptorProto, FieldDescriptorProto,
    field_descriptor_proto::{Label, Type},
};
use serde_json::{Map, Value, json};

use super::{SCHEMAS, limits, messages::Described};
use crate::service::http::descriptors::bare;

pub(super) fn message(message: &Described<DescriptorProto>, read: bool) -> Value {
    let name = message.descriptor.name();
    let in_path = limits::in_path(name);
    let fields = message.descriptor.field.iter().zip(&message.members);
    let fields = fields.filter(|(it, _)| !in_path.contains(&it.json_name()));
    let properties: Map<String, Value> = fields
        .map(|(it, comment)| (it.json_name().to_owned(), field(name, it, comment, read)))
        .collect();
    let mut schema = json!({
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
    });
    describe(&mut schema, &message.comment);
    let required = limits::required(name);
    if read && !required.is_empty() {
        schema["required"] = json!(required);
    }
    schema
}

pub(super) fn enumeration(values: &Described<EnumDescriptorProto>, read: bool) -> Value {
    let all = values.descriptor.value.iter();
    let names: Vec<&str> = all.clone().map(EnumValueDescriptorProto::name).collect();
    let mut schema = if read {
        let numbers: Vec<i32> = all.clone().map(EnumValueDescriptorProto::number).collect();
        json!({ "enum": mixed(&names, &numbers) })
    } else {
        json!({ "type": "string", "enum": names })
    };
    let said = all.zip(&values.members).filter(|(_, it)| !it.is_empty());
    let said = said.map(|(it, comment)| format!("\n- `{}`: {comment}", it.name()));
    let text = format!("{}\n{}", values.comment, said.collect::<String>());
    describe(&mut schema, text.trim());
    schema
}

fn mixed(names: &[&str], numbers: &[i32]) -> Vec<Value> {
    let names = names.iter().map(|it| json!(it));
    names.chain(numbers.iter().map(|it| json!(it))).collect()
}

fn field(message: &str, field: &FieldDescriptorProto, comment: &str, read: bool) -> Value {
    let mut schema = kind(field, read);
    if let Some(limit) = limits::of(message, field.name()) {
        schema = narrowed(schema, limit);
    }
    if field.label() == Label::Repeated {
        schema = json!({ "type": "array", "items": schema });
        if let Some(most) = limits::max_items(message, field.name()) {
            schema["maxItems"] = json!(most);
        }
    }
    if read && !limits::required(message).contains(&field.json_name()) {
        schema = json!({ "oneOf": [{ "type": "null" }, schema] });
    }
    describe(&mut schema, comment);
    schema
}

/// A limit on a referred schema takes its place.
fn narrowed(mut schema: Value, limit: Value) -> Value {
    if schema.get("$ref").is_some() {
        return limit;
    }
    if let (Some(schema), Value::Object(limit)) = (schema.as_object_mut(), limit) {
        schema.extend(limit);
    }
    schema
}

fn describe(schema: &mut Value, comment: &str) {
    if !comment.is_empty() {
        schema["description"] = json!(comment);
    }
}

fn kind(field: &FieldDescriptorProto, read: bool) -> Value {
    match field.r#type() {
        Type::Double | Type::Float => float(read),
        Type::Int32 | Type::Sint32 | Type::Sfixed32 => {
            integer(read, i32::MIN.into(), i32::MAX.into())
        }
        Type::Uint32 | Type::Fixed32 => integer(read, 0, u32::MAX.into()),
        Type::Int64 | Type::Sint64 | Type::Sfixed64 => {
            long(read, "^-?[0-9]{1,18}$", "^-?[0-9]{1,19}$")
        }
        Type::Uint64 | Type::Fixed64 => long(read, "^[0-9]{1,19}$", "^[0-9]{1,20}$"),
        Type::Bool => json!({ "type": "boolean" }),
        Type::String => json!({ "type": "string" }),
        Type::Bytes => json!({ "type": "string", "contentEncoding": "base64" }),
        Type::Message | Type::Enum | Type::Group => referred(field.type_name()),
    }
}

fn float(read: bool) -> Value {
    if read {
        json!({
            "type": ["number", "string"],
            "pattern": r"^(NaN|-?Infinity|-?[0-9]{1,9}(\.[0-9]{1,9})?)$",
        })
    } else {
        json!({ "type": "number" })
    }
}

fn integer(read: bool, least: i64, most: i64) -> Value {
    if read {
        let pattern = if least < 0 {
            "^-?[0-9]{1,9}$"
        } else {
            "^[0-9]{1,9}$"
        };
        json!({
            "type": ["integer", "string"],
            "minimum": least,
            "maximum": most,
            "pattern": pattern,
        })
    } else {
        json!({ "type": "integer", "minimum": least, "maximum": most })
    }
}

/// 64 bits: text is exact everywhere, a number only as far as the reader holds it.
fn long(read: bool, read_pattern: &str, written_pattern: &str) -> Value {
    const EXACT: i64 = 1 << 53;
    if read {
        let least = if read_pattern.starts_with("^-?") {
            -EXACT
        } else {
            0
        };
        json!({
            "type": ["string", "integer"],
            "pattern": read_pattern,
            "minimum": least,
            "maximum": EXACT,
        })
    } else {
        json!({ "type": "string", "pattern": written_pattern })
    }
}

fn referred(type_name: &str) -> Value {
    match type_name {
        ".google.protobuf.Timestamp" => json!({ "type": "string", "format": "date-time" }),
        ".google.protobuf.Duration" => {
            json!({ "type": "string", "pattern": r"^-?[0-9]{1,12}(\.[0-9]{1,9})?s$" })
        }
        ".google.protobuf.FieldMask" => json!({ "type": "string" }),
        ours => {
            let name = bare(ours).unwrap_or_default();
            json!({ "$ref": format!("{SCHEMAS}{name}") })
        }
    }
}
