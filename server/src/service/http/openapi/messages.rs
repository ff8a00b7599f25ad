//! The messages and enums of the protocol, from the descriptors in the binary.

use std::collections::{BTreeMap, BTreeSet};

use prost_types::{
    DescriptorProto, EnumDescriptorProto, FileDescriptorProto, source_code_info::Location,
};
use serde_json::Value;

use super::schema;
use crate::service::http::descriptors::{self, bare};

/// Number of `FileDescriptorProto.message_type`.
const MESSAGES: i32 = 4;
/// Number of `FileDescriptorProto.enum_type`.
const ENUMS: i32 = 5;
/// Number of `DescriptorProto.field` and of `EnumDescriptorProto.value`.
const MEMBERS: i32 = 2;

/// A message or an enum with its comments.
pub(super) struct Described<T> {
    /// The descriptor.
    pub descriptor: T,
    /// What the `.proto` file says above it.
    pub comment: String,
    /// What it says of each field or value, in their order.
    pub members: Vec<String>,
}

/// Everything that the protocol defines, by name.
pub(super) struct Messages {
    messages: BTreeMap<String, Described<DescriptorProto>>,
    enums: BTreeMap<String, Described<EnumDescriptorProto>>,
}

impl Messages {
    /// Reads the descriptors.
    pub fn of_the_protocol() -> Self {
        let mut all = Self {
            messages: BTreeMap::new(),
            enums: BTreeMap::new(),
        };
        descriptors::files().for_each(|it| all.add(&it));
        all
    }

    fn add(&mut self, file: &FileDescriptorProto) {
        for (idx, descriptor) in (0..).zip(&file.message_type) {
            let n_members = descriptor.field.len();
            let (comment, members) = comments(file, [MESSAGES, idx], n_members);
            let described = Described {
                descriptor: descriptor.clone(),
                comment,
                members,
            };
            let name = descriptor.name().to_owned();
            self.messages.insert(name, described);
        }
        for (idx, descriptor) in (0..).zip(&file.enum_type) {
            let n_members = descriptor.value.len();
            let (comment, members) = comments(file, [ENUMS, idx], n_members);
            let described = Described {
                descriptor: descriptor.clone(),
                comment,
                members,
            };
            let name = descriptor.name().to_owned();
            self.enums.insert(name, described);
        }
    }

    /// `roots` and all that their fields are made of.
    pub fn closure(&self, roots: &BTreeSet<String>) -> BTreeSet<String> {
        let mut found = BTreeSet::new();
        let mut open: Vec<String> = roots.iter().cloned().collect();
        while let Some(name) = open.pop() {
            if let Some(message) = self.messages.get(&name) {
                let fields = message.descriptor.field.iter();
                let parts = fields.filter_map(|it| bare(it.type_name()));
                open.extend(parts.filter(|it| !found.contains(*it)).map(str::to_owned));
            }
            found.insert(name);
        }
        found
    }

    /// The schema of a message or an enum of that name; `read`: as wide as it is read, not as narrow as it is written.
    pub fn schema(&self, name: &str, read: bool) -> Option<Value> {
        let message = self.messages.get(name);
        let message = message.map(|it| schema::message(it, read));
        message.or_else(|| {
            let values = self.enums.get(name)?;
            Some(schema::enumeration(values, read))
        })
    }
}

/// The names of an enum's values.
pub(super) fn names_of(name: &str) -> Vec<String> {
    let all = Messages::of_the_protocol();
    let values = all.enums.get(name).map(|it| it.descriptor.value.iter());
    let names = values.into_iter().flatten();
    names.map(|it| it.name().to_owned()).collect()
}

/// What a file says of the definition at `path`, and of its members.
fn comments(file: &FileDescriptorProto, path: [i32; 2], n_members: usize) -> (String, Vec<String>) {
    let of = |path: &[i32]| {
        let source = file.source_code_info.iter().flat_map(|it| &it.location);
        let mut here = source.filter(|it| it.path == path);
        here.next().map_or_else(String::new, words)
    };
    let members = (0..).take(n_members);
    let members = members.map(|idx| of(&[path[0], path[1], MEMBERS, idx]));
    (of(&path), members.collect())
}

fn words(location: &Location) -> String {
    let both = [location.leading_comments(), location.trailing_comments()];
    let words = both.iter().flat_map(|it| it.split_whitespace());
    words.collect::<Vec<_>>().join(" ")
}
