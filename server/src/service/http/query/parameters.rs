//! A query as the parameters of its path: each by its name, at most once, and with a value of its kind.
//!
//! What is wrong is told by the parameter's name; what a client sent is not repeated.

use std::{borrow::Cow, fmt};

use axum::http::StatusCode;
use form_urlencoded::Parse;
use serde::{
    Deserializer,
    de::{
        self, DeserializeOwned, DeserializeSeed, IntoDeserializer as _, MapAccess, Visitor,
        value::StrDeserializer,
    },
    forward_to_deserialize_any,
};

use crate::service::http::{json::Number, problem::Problem};

/// Reads what a path takes from its query.
///
/// # Errors
///
/// `QUERY`, with the parameter as `field` where it is one that the path has.
pub(in crate::service::http) fn read<Q: DeserializeOwned>(query: &str) -> Result<Q, Problem> {
    let parameters = Parameters(form_urlencoded::parse(query.as_bytes()));
    Q::deserialize(parameters).map_err(Problem::from)
}

/// Why a query cannot be read.
#[derive(Debug)]
struct Fault {
    field: Option<&'static str>,
    what: String,
}

impl Fault {
    fn must_be(what: &str) -> Self {
        Self {
            field: None,
            what: format!("must be {what}"),
        }
    }
}

impl From<Fault> for Problem {
    fn from(fault: Fault) -> Self {
        let status = StatusCode::BAD_REQUEST;
        match fault.field {
            Some(field) => {
                let detail = format!("{field} {}", fault.what);
                Self::new(status, "QUERY", &detail).with("field", field)
            }
            None => Self::new(status, "QUERY", &fault.what),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.what)
    }
}

impl std::error::Error for Fault {}

impl de::Error for Fault {
    /// What a type says of itself may repeat what was sent.
    fn custom<T: fmt::Display>(_said: T) -> Self {
        Self::must_be("a value of another kind")
    }
}

struct Parameters<'q>(Parse<'q>);

impl<'de> Deserializer<'de> for Parameters<'de> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_struct("", &[], visitor)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        visitor.visit_map(Members {
            pairs: self.0,
            fields,
            seen: Vec::new(),
            value: Cow::default(),
        })
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option
        unit unit_struct newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

/// The pairs of a query, whose names are among `fields`.
struct Members<'q> {
    pairs: Parse<'q>,
    fields: &'static [&'static str],
    /// In their order; the last is the one whose value is due.
    seen: Vec<&'static str>,
    value: Cow<'q, str>,
}

impl Members<'_> {
    fn known(&self, name: &str) -> Result<&'static str, Fault> {
        let field = self.fields.iter().find(|it| **it == name);
        let field = *field.ok_or_else(|| self.unknown())?;
        if self.seen.contains(&field) {
            return Err(Fault {
                field: Some(field),
                what: "stands twice".to_owned(),
            });
        }
        Ok(field)
    }

    fn unknown(&self) -> Fault {
        let what = match self.fields {
            [] => "this path takes no parameters in its query".to_owned(),
            fields => format!(
                "a parameter that this path does not take; it takes {}",
                fields.join(", ")
            ),
        };
        Fault { field: None, what }
    }
}

impl<'de> MapAccess<'de> for Members<'de> {
    type Error = Fault;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        key: K,
    ) -> Result<Option<K::Value>, Fault> {
        let Some((name, value)) = self.pairs.next() else {
            return Ok(None);
        };
        let field = self.known(&name)?;
        self.seen.push(field);
        self.value = value;
        let name: StrDeserializer<'_, Fault> = field.into_deserializer();
        key.deserialize(name).map(Some)
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, Fault> {
        let value = seed.deserialize(Text(std::mem::take(&mut self.value)));
        value.map_err(|fault| Fault {
            field: self.seen.last().copied(),
            ..fault
        })
    }
}

/// The value of a parameter.
struct Text<'q>(Cow<'q, str>);

impl Text<'_> {
    fn number(&self) -> Option<Number> {
        Number::of_text(&self.0)
    }
}

impl<'de> Deserializer<'de> for Text<'de> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_str(&self.0)
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.0.as_ref() {
            "true" => visitor.visit_bool(true),
            "false" => visitor.visit_bool(false),
            _ => Err(Fault::must_be("true or false")),
        }
    }

    fn deserialize_u32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let number = self.number().and_then(Number::as_whole);
        let due = || Fault::must_be("a whole number from 0 to 4294967295");
        visitor.visit_u32(number.ok_or_else(due)?)
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let number = self.number().and_then(Number::as_whole);
        let due = || Fault::must_be("a whole number from 0 to 18446744073709551615");
        visitor.visit_u64(number.ok_or_else(due)?)
    }

    fn deserialize_f32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let number = self.number().and_then(Number::single);
        let due = || Fault::must_be("a number");
        visitor.visit_f32(number.ok_or_else(due)?)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }

    forward_to_deserialize_any! {
        i8 i16 i32 i64 i128 u8 u16 u128 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map struct enum identifier ignored_any
    }
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;

    #[derive(Debug, Default, PartialEq, Deserialize)]
    #[serde(default, rename_all = "camelCase")]
    struct Asked {
        page_size: u32,
        after: Option<u64>,
        max_rate_hz: f32,
        with_markers: bool,
        subscriber: String,
    }

    #[test]
    fn each_parameter_is_read_as_its_kind() {
        let query = "pageSize=1e1&after=18446744073709551615&maxRateHz=0.5&withMarkers=true&subscriber=a+%26";
        let asked = Asked {
            page_size: 10,
            after: Some(u64::MAX),
            max_rate_hz: 0.5,
            with_markers: true,
            subscriber: "a &".to_owned(),
        };
        assert_eq!(read::<Asked>(query).unwrap(), asked);
        assert_eq!(read::<Asked>("").unwrap(), Asked::default());
    }

    #[test]
    fn what_is_wrong_is_told_by_the_parameter_without_repeating_it() {
        let cases = [
            (
                "pageSize=secret",
                Some("pageSize"),
                "must be a whole number from 0",
            ),
            (
                "pageSize=-1",
                Some("pageSize"),
                "must be a whole number from 0",
            ),
            (
                "pageSize=",
                Some("pageSize"),
                "must be a whole number from 0",
            ),
            (
                "after=18446744073709551616",
                Some("after"),
                "must be a whole number from 0",
            ),
            ("maxRateHz=secret", Some("maxRateHz"), "must be a number"),
            (
                "withMarkers=1",
                Some("withMarkers"),
                "must be true or false",
            ),
            ("after=1&after=1", Some("after"), "stands twice"),
            (
                "secret=1",
                None,
                "it takes pageSize, after, maxRateHz, withMarkers, subscriber",
            ),
        ];
        for (query, field, says) in cases {
            let problem = read::<Asked>(query).unwrap_err().document("/");
            assert_eq!(problem["type"], "urn:frontalis:problem:QUERY", "{query}");
            assert_eq!(problem["field"].as_str(), field, "{query}");
            let detail = problem["detail"].as_str().unwrap();
            assert!(detail.contains(says), "{query}: {detail}");
            assert!(!detail.contains("secret"), "{query}: {detail}");
        }
    }
}
