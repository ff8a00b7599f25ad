//! Bearer tokens: 256 random bits, of which only the SHA-256 is kept (CONTRACTS S-3, S-11).

use std::fmt;

use base64::{Engine as _, engine::general_purpose::URL_SAFE_NO_PAD};
use rand::{TryRng as _, rngs::SysRng};
use sha2::{Digest as _, Sha256};
use subtle::{Choice, ConstantTimeEq};

/// What every token starts with, so that people and leak scanners know one when they see it.
const MARK: &str = "frontalis_";
/// Random bytes of a token.
const RANDOM_BYTES: usize = 32;
/// Longest thing that is looked at as a token, bytes; longer ones are refused unread (BAD_INPUT I1).
pub const MAX_PRESENTED_BYTES: usize = 8 * 1024;

/// A token in the clear: shown once to whoever made it, never stored.
#[derive(Clone, PartialEq, Eq)]
pub struct Token(String);

/// The system has no randomness to give.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the system gave no random bytes")]
pub struct NoEntropy;

impl Token {
    /// A new one, from the system's randomness.
    ///
    /// # Errors
    ///
    /// [`NoEntropy`].
    pub fn generate() -> Result<Self, NoEntropy> {
        Ok(Self::from_bytes(&random::<RANDOM_BYTES>()?))
    }

    /// The token of these random bytes.
    pub fn from_bytes(random: &[u8; RANDOM_BYTES]) -> Self {
        Self(format!("{MARK}{}", URL_SAFE_NO_PAD.encode(random)))
    }

    /// The text that a client sends.
    pub fn reveal(&self) -> &str {
        &self.0
    }

    /// What is stored of it.
    pub fn hash(&self) -> TokenHash {
        TokenHash::of(self.0.as_bytes())
    }
}

impl fmt::Debug for Token {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("Token(***)")
    }
}

/// SHA-256 of a token. A token has 256 random bits, so that neither salt nor stretching would add anything.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct TokenHash([u8; 32]);

impl TokenHash {
    /// The hash of what a client presented. Of overlong input only the first [`MAX_PRESENTED_BYTES`] are read.
    pub fn of(presented: &[u8]) -> Self {
        let read = presented.len().min(MAX_PRESENTED_BYTES);
        Self(Sha256::digest(&presented[..read]).into())
    }

    /// As the token file writes it, `sha256:` and 64 hexadecimal digits.
    pub fn to_text(self) -> String {
        use fmt::Write as _;
        let mut text = String::from("sha256:");
        for byte in self.0 {
            write!(text, "{byte:02x}").expect("invariant: a String takes every write");
        }
        text
    }

    /// Reads [`Self::to_text`].
    pub fn parse(text: &str) -> Option<Self> {
        let digits = text.strip_prefix("sha256:")?;
        if digits.len() != 64 || !digits.bytes().all(|it| it.is_ascii_hexdigit()) {
            return None;
        }
        let mut hash = [0; 32];
        for (byte, pair) in hash.iter_mut().zip(digits.as_bytes().chunks_exact(2)) {
            *byte = u8::from_str_radix(std::str::from_utf8(pair).ok()?, 16).ok()?;
        }
        Some(Self(hash))
    }

    /// Equality that takes the same time whatever the bytes are.
    pub(crate) fn is(&self, other: &Self) -> Choice {
        self.0.ct_eq(&other.0)
    }
}

impl fmt::Debug for TokenHash {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("TokenHash(***)")
    }
}

/// Bytes that nobody can guess.
pub(crate) fn random<const N: usize>() -> Result<[u8; N], NoEntropy> {
    let mut bytes = [0; N];
    SysRng.try_fill_bytes(&mut bytes).map_err(|_| NoEntropy)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_token_is_long_marked_and_never_the_same_twice() {
        let [a, b] = [Token::generate().unwrap(), Token::generate().unwrap()];
        assert_ne!(a, b);
        assert_eq!(a.reveal().len(), MARK.len() + 43);
        assert!(a.reveal().starts_with("frontalis_"));
    }

    #[test]
    fn nothing_that_is_printed_for_debugging_tells_a_token_or_its_hash() {
        let token = Token::generate().unwrap();
        assert_eq!(format!("{token:?}"), "Token(***)");
        assert_eq!(format!("{:?}", token.hash()), "TokenHash(***)");
    }

    #[test]
    fn the_hash_is_sha_256() {
        let expected = "sha256:ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(TokenHash::of(b"abc").to_text(), expected);
    }

    proptest! {
        #[test]
        fn a_hash_reads_back_and_any_other_text_does_not(token: [u8; 32], other in ".{0,80}") {
            let hash = Token::from_bytes(&token).hash();
            prop_assert_eq!(TokenHash::parse(&hash.to_text()), Some(hash));
            prop_assert!(bool::from(hash.is(&hash)));
            prop_assert_eq!(TokenHash::parse(&other), None);
        }
    }
}
