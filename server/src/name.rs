//! Names that clients choose, checked once where they enter.
//!
//! Ids are `[a-z0-9][a-z0-9_-]{0,62}`, display names NFC, at most 128 code points, without control or bidi-override
//! characters (CONTRACTS S-6). Error texts never repeat the refused text, which may be hostile to a terminal or a log.

use std::{fmt, sync::Arc};

use unicode_normalization::UnicodeNormalization as _;

/// Longest id in bytes.
const MAX_ID_BYTES: usize = 63;
/// Longest publisher id in bytes.
const MAX_PUBLISHER_BYTES: usize = 64;
/// Longest display name in code points.
const MAX_DISPLAY_CODE_POINTS: usize = 128;

/// Why a name is refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NameError {
    /// The text is not an id.
    #[error("{what} must be 1 to 63 of a-z, 0-9, _ and -, and start with a letter or a digit")]
    Id {
        /// What the name names: `session id`, `actor id`.
        what: &'static str,
    },
    /// The text does not start with its collection.
    #[error("the name of {what} must have the form \"{collection}/ID\"")]
    Collection {
        /// What the name names.
        what: &'static str,
        /// The expected first part.
        collection: &'static str,
    },
    /// The text is not a publisher id.
    #[error("publisher must be 1 to 64 of A-Z, a-z, 0-9, ., _ and -")]
    Publisher,
    /// The text is too long, or would change how the text around it is shown.
    #[error("{what} must have at most 128 code points and no control or text direction characters")]
    Display {
        /// What the name names.
        what: &'static str,
    },
}

fn is_id(text: &str) -> bool {
    let bytes = text.as_bytes();
    let plain = |byte: &u8| byte.is_ascii_lowercase() || byte.is_ascii_digit();
    bytes.len() <= MAX_ID_BYTES
        && bytes.first().is_some_and(plain)
        && bytes
            .iter()
            .all(|byte| plain(byte) || matches!(byte, b'_' | b'-'))
}

macro_rules! identifier {
    ($(#[$doc:meta])* $name:ident, $what:literal, $collection:literal) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(Arc<str>);

        impl $name {
            /// Checks a bare id.
            ///
            /// # Errors
            ///
            /// [`NameError::Id`] when it has another form.
            pub fn parse(text: &str) -> Result<Self, NameError> {
                if is_id(text) {
                    Ok(Self(text.into()))
                } else {
                    Err(NameError::Id { what: concat!($what, " id") })
                }
            }

            #[doc = concat!("Checks a resource name, `", $collection, "/ID`.")]
            ///
            /// # Errors
            ///
            /// [`NameError`] when the collection or the id has another form.
            pub fn from_resource(text: &str) -> Result<Self, NameError> {
                let id = text
                    .strip_prefix(concat!($collection, "/"))
                    .ok_or(NameError::Collection { what: $what, collection: $collection })?;
                Self::parse(id)
            }

            /// The bare id.
            pub fn as_str(&self) -> &str {
                &self.0
            }

            #[doc = concat!("The resource name, `", $collection, "/ID`.")]
            pub fn resource(&self) -> String {
                format!(concat!($collection, "/{}"), self.0)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str(&self.0)
            }
        }
    };
}

identifier!(
    /// Identity of a session; cheap to clone.
    SessionId, "session", "sessions"
);
identifier!(
    /// Identity of an actor; cheap to clone.
    ActorId, "actor", "actors"
);

identifier!(
    /// Identity of a take; cheap to clone.
    TakeId, "take", "takes"
);

/// Stable identity of a capture client: 1 to 64 of `[A-Za-z0-9._-]`; cheap to clone.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PublisherId(Arc<str>);

impl PublisherId {
    /// Checks a publisher id.
    ///
    /// # Errors
    ///
    /// [`NameError::Publisher`] when it has another form.
    pub fn parse(text: &str) -> Result<Self, NameError> {
        let allowed = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'.' | b'_' | b'-');
        if text.is_empty() || text.len() > MAX_PUBLISHER_BYTES || !text.bytes().all(allowed) {
            return Err(NameError::Publisher);
        }
        Ok(Self(text.into()))
    }

    /// The id.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for PublisherId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

/// A name for people: NFC, at most 128 code points, nothing that moves a cursor or turns text around.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DisplayName(String);

impl DisplayName {
    /// Normalizes and checks a display name; `what` names the field in the error. Empty is allowed.
    ///
    /// # Errors
    ///
    /// [`NameError::Display`] when it is too long or has control or bidi-override characters.
    pub fn parse(what: &'static str, text: &str) -> Result<Self, NameError> {
        // One code point past the limit is enough to know, so a huge text costs no more than a short one.
        let normalized: String = text.nfc().take(MAX_DISPLAY_CODE_POINTS + 1).collect();
        let too_long = normalized.chars().count() > MAX_DISPLAY_CODE_POINTS;
        if too_long || normalized.chars().any(disturbs_its_surroundings) {
            return Err(NameError::Display { what });
        }
        Ok(Self(normalized))
    }

    /// The name.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The name as an owned text.
    pub fn into_string(self) -> String {
        self.0
    }
}

fn disturbs_its_surroundings(character: char) -> bool {
    character.is_control()
        || matches!(character,
            '\u{061C}' | '\u{200E}' | '\u{200F}' | '\u{2028}' | '\u{2029}'
            | '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_keep_to_their_alphabet() {
        for good in ["a", "0", "take_3-b", &"z".repeat(63)] {
            assert_eq!(SessionId::parse(good).unwrap().as_str(), good);
        }
        let long = "z".repeat(64);
        let bad = [
            "", ".", "-a", "_a", "A", "a b", "../x", "..%2f", "/etc", "C:\\", "a\0", "a\n", "é",
            &long,
        ];
        for text in bad {
            assert!(SessionId::parse(text).is_err(), "{text:?}");
        }
    }

    #[test]
    fn a_resource_name_has_its_collection() {
        let id = SessionId::from_resource("sessions/stage-1").unwrap();
        assert_eq!(id.resource(), "sessions/stage-1");
        assert!(SessionId::from_resource("stage-1").is_err());
        assert!(SessionId::from_resource("actors/stage-1").is_err());
        assert!(SessionId::from_resource("sessions/a/b").is_err());
    }

    #[test]
    fn display_names_are_normalized_and_bounded() {
        let name = DisplayName::parse("display_name", "Ame\u{301}lie").unwrap();
        assert_eq!(name.as_str(), "Am\u{e9}lie");
        assert!(DisplayName::parse("display_name", &"x".repeat(128)).is_ok());
        assert!(DisplayName::parse("display_name", &"x".repeat(129)).is_err());
        for bad in ["a\u{202E}b", "\u{1b}[2J", "a\nb", "\u{2066}"] {
            assert!(DisplayName::parse("display_name", bad).is_err(), "{bad:?}");
        }
    }

    #[test]
    fn publisher_ids_allow_capitals_and_dots() {
        assert!(PublisherId::parse("Stage.A_1-x").is_ok());
        for bad in ["", "a b", "é", &"x".repeat(65)] {
            assert!(PublisherId::parse(bad).is_err(), "{bad:?}");
        }
    }
}
