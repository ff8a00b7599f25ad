//! The token that proves who calls (RFC 6750), and the place that puts it on every call.
//!
//! CONTRACTS S-11: a token comes from a file, the environment or standard input, and `Debug` never shows it.

use std::fmt;

use tonic::{
    Request, Status,
    metadata::{Ascii, MetadataValue},
    service::Interceptor,
};

/// Longest token that is sent; a server takes 16 KiB of headers in all.
const MAX_TOKEN_BYTES: usize = 8 << 10;

/// Why a text is no token.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TokenError {
    /// Nothing but white space.
    #[error("there is no token in it")]
    Empty,
    /// Longer than any header may be.
    #[error("{n_bytes} bytes are no token; the longest has {MAX_TOKEN_BYTES}")]
    TooLong {
        /// Its length.
        n_bytes: usize,
    },
    /// A character that RFC 6750 does not allow, for example a line break inside.
    #[error("a token has only letters, digits and - . _ ~ + / =, in one line")]
    Characters,
}

/// A secret that is shown to a server with every call.
#[derive(Clone, PartialEq, Eq)]
pub struct Token(String);

impl Token {
    /// Takes the token from a text; white space around it is left out.
    ///
    /// # Errors
    ///
    /// When the text is empty, too long, or holds a character that a token cannot have.
    pub fn parse(text: &str) -> Result<Self, TokenError> {
        let text = text.trim();
        if text.is_empty() {
            return Err(TokenError::Empty);
        }
        if text.len() > MAX_TOKEN_BYTES {
            return Err(TokenError::TooLong {
                n_bytes: text.len(),
            });
        }
        let is_allowed = |it: u8| it.is_ascii_alphanumeric() || b"-._~+/=".contains(&it);
        if !text.bytes().all(is_allowed) {
            return Err(TokenError::Characters);
        }
        Ok(Self(text.to_owned()))
    }

    /// The secret itself, to be stored where only its owner reads it.
    pub fn secret(&self) -> &str {
        &self.0
    }
}

impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("***")
    }
}

/// Writes `authorization: Bearer …` on every call, or nothing.
#[derive(Clone)]
pub struct Bearer {
    header: Option<MetadataValue<Ascii>>,
}

impl Bearer {
    /// With this token, or without one.
    pub fn new(token: Option<&Token>) -> Self {
        // `Token::parse` lets through only what a header can carry.
        let header = token.and_then(|it| {
            let mut value = MetadataValue::try_from(format!("Bearer {}", it.secret())).ok()?;
            // Kept out of HPACK's tables and of Debug.
            value.set_sensitive(true);
            Some(value)
        });
        Self { header }
    }
}

impl fmt::Debug for Bearer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = self.header.as_ref().map(|_| "***");
        f.debug_struct("Bearer").field("token", &shown).finish()
    }
}

impl Interceptor for Bearer {
    fn call(&mut self, mut request: Request<()>) -> Result<Request<()>, Status> {
        if let Some(header) = &self.header {
            request
                .metadata_mut()
                .insert("authorization", header.clone());
        }
        Ok(request)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_space_around_a_token_is_left_out() {
        let token = Token::parse("  frt_abc-1.2~3+/=\n").unwrap();
        assert_eq!(token.secret(), "frt_abc-1.2~3+/=");
    }

    #[test]
    fn what_no_header_could_carry_is_no_token() {
        assert_eq!(Token::parse(" \n"), Err(TokenError::Empty));
        for text in ["a b", "a\nb", "a\u{0}", "ü", "a\r\nx: y"] {
            assert_eq!(Token::parse(text), Err(TokenError::Characters), "{text:?}");
        }
        let long = "a".repeat(MAX_TOKEN_BYTES + 1);
        let refused = TokenError::TooLong {
            n_bytes: long.len(),
        };
        assert_eq!(Token::parse(&long), Err(refused));
    }

    #[test]
    fn debug_never_shows_a_token() {
        let token = Token::parse("hunter2").unwrap();
        let bearer = Bearer::new(Some(&token));
        let request = bearer.clone().call(Request::new(())).unwrap();
        for text in [
            format!("{token:?}"),
            format!("{bearer:?}"),
            format!("{request:?}"),
        ] {
            assert!(!text.contains("hunter2"), "{text}");
        }
        assert!(format!("{bearer:?}").contains("***"));
    }

    #[test]
    fn every_call_carries_the_token() {
        let token = Token::parse("abc").unwrap();
        let sent = |token| {
            let request = Bearer::new(token).call(Request::new(())).unwrap();
            let header = request.metadata().get("authorization");
            header.map(|it| it.to_str().unwrap().to_owned())
        };
        assert_eq!(sent(Some(&token)), Some("Bearer abc".to_owned()));
        assert_eq!(sent(None), None);
    }
}
