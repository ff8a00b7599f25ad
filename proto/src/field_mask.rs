//! `google.protobuf.FieldMask` with its JSON form: one string, paths in camel case, joined by commas.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

/// The fields that a request means.
#[derive(Clone, PartialEq, Eq, Hash, prost::Message)]
pub struct FieldMask {
    /// Names as in the `.proto` files.
    #[prost(string, repeated, tag = "1")]
    pub paths: Vec<String>,
}

impl Serialize for FieldMask {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let camel: Vec<_> = self.paths.iter().map(|it| json_name(it)).collect();
        serializer.serialize_str(&camel.join(","))
    }
}

impl<'de> Deserialize<'de> for FieldMask {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        if text.contains('_') {
            return Err(D::Error::custom("a field mask's paths are in camel case"));
        }
        let paths = text.split(',').filter(|it| !it.is_empty());
        Ok(Self {
            paths: paths.map(snake_case).collect(),
        })
    }
}

/// A field's name in the JSON mapping, or a path of such names: `start.rate_hz` is `start.rateHz`.
pub fn json_name(path: &str) -> String {
    let mut camel = String::with_capacity(path.len());
    let mut after_underscore = false;
    for letter in path.chars() {
        if letter == '_' {
            after_underscore = true;
        } else if std::mem::take(&mut after_underscore) {
            camel.push(letter.to_ascii_uppercase());
        } else {
            camel.push(letter);
        }
    }
    camel
}

fn snake_case(path: &str) -> String {
    let mut snake = String::with_capacity(path.len() + 4);
    for letter in path.chars() {
        if letter.is_ascii_uppercase() {
            snake.push('_');
        }
        snake.push(letter.to_ascii_lowercase());
    }
    snake
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mask_reads_back_what_it_wrote() {
        let mask = FieldMask {
            paths: vec!["stale_after".into(), "region_mode".into()],
        };
        let text = serde_json::to_string(&mask).unwrap_or_default();
        assert_eq!(text, r#""staleAfter,regionMode""#);
        assert_eq!(serde_json::from_str::<FieldMask>(&text).ok(), Some(mask));
    }

    #[test]
    fn an_empty_mask_names_nothing() {
        let empty = serde_json::from_str::<FieldMask>(r#""""#).ok();
        assert_eq!(empty, Some(FieldMask::default()));
    }
}
