//! Who a caller turned out to be.

use crate::{CertificateSubject, Role, Scope, TokenHash, UnixTime};

/// A proven identity and its rights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Principal {
    /// Stable identity, different for every token, subject of an issuer, and certificate: `token:ID`,
    /// `issuer:ISS#SUBJECT` (with `%` and `#` of the issuer as `%25` and `%23`), `certificate:SUBJECT` (escaped, RFC 4514).
    /// Two callers are the same principal when this is the same.
    pub key: String,
    /// For people: the token's name, the token's `sub`, or the certificate's subject.
    pub name: String,
    /// What it is.
    pub role: Role,
    /// Where it is that.
    pub scope: Scope,
    /// Whether an operator may read raw images.
    pub images: bool,
    /// When the proof stops to hold; none: when it is revoked.
    pub expire_time: Option<UnixTime>,
    /// What [`crate::TokenFile::still_stands`] looks for.
    pub(crate) proof: Proof,
}

/// What a principal's rights rest on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Proof {
    /// An entry of the token file.
    Token { hash: TokenHash },
    /// A signature by an issuer; its claims stand until they expire.
    Issuer { iss: String, key: Vec<u8> },
    /// A client certificate that the handshake accepted.
    Certificate { subject: CertificateSubject },
}

/// The proof that a caller gave proves nothing; callers learn no more than that (BAD_INPUT I1).
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a valid token is needed")]
pub struct Refused {
    /// For the audit log and rate limits, never for the caller: the token's id, where one is known.
    pub token_id: Option<String>,
    /// For the audit log, never for the caller: what was wrong.
    pub why: &'static str,
}

impl Refused {
    pub(crate) fn because(why: &'static str) -> Self {
        Self {
            token_id: None,
            why,
        }
    }
}

/// Whether a name that others chose is shown as it is: without characters that steer a terminal, break a line, or turn
/// the direction of what is around them.
pub(crate) fn is_shown_as_written(text: &str) -> bool {
    let steers = |it: char| {
        it.is_control()
            || matches!(it, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    !text.chars().any(steers)
}
