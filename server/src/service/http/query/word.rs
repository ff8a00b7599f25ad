//! An enum's value in a query: its name, with or without the enum's own name in front.

use axum::http::StatusCode;
use serde::Deserialize;

use crate::service::http::{json::enumeration, problem::Problem};

/// The name of an enum's value, as it was sent.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(transparent)]
pub(in crate::service::http) struct Word(String);

impl Word {
    /// The number of the value of the enum `name`; 0 where nothing was sent.
    ///
    /// # Errors
    ///
    /// `ENUM` with the parameter `field` when no value is called so.
    pub(in crate::service::http) fn number(&self, field: &str, name: &str) -> Result<i32, Problem> {
        if self.0.is_empty() {
            return Ok(0);
        }
        let values = enumeration(name);
        values.number_of_word(&self.0).ok_or_else(|| {
            let detail = format!("{field} must be one of {}", values.names());
            Problem::new(StatusCode::BAD_REQUEST, "ENUM", &detail).with("field", field)
        })
    }
}

#[cfg(test)]
impl From<&str> for Word {
    fn from(word: &str) -> Self {
        Self(word.to_owned())
    }
}

#[cfg(test)]
mod tests {
    use frontalis_proto::v1::Delivery;

    use super::*;

    #[test]
    fn an_enum_is_named_in_full_or_in_short() {
        for word in ["DELIVERY_EVERY_FRAME", "every_frame", "EVERY_FRAME"] {
            let number = Word::from(word).number("delivery", "Delivery").unwrap();
            assert_eq!(Delivery::try_from(number), Ok(Delivery::EveryFrame));
        }
        assert_eq!(Word::default().number("delivery", "Delivery").unwrap(), 0);
    }

    #[test]
    fn a_word_that_is_none_is_refused_by_its_parameter_without_being_repeated() {
        for word in ["secret", "2", "DELIVERY_", "DELIVERY_DELIVERY_LATEST"] {
            let refused = Word::from(word).number("delivery", "Delivery").unwrap_err();
            let problem = refused.document("/");
            assert_eq!(problem["type"], "urn:frontalis:problem:ENUM", "{word}");
            assert_eq!(problem["field"], "delivery");
            let detail = problem["detail"].as_str().unwrap();
            assert!(detail.contains("DELIVERY_EVERY_FRAME"), "{detail}");
            assert!(!detail.contains("secret"), "{detail}");
        }
    }
}
