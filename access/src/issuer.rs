//! Signed tokens (JWT) of issuers that the token file names (CONTRACTS S-3).
//!
//! One algorithm an issuer, taken from the file and never from the token, so that neither `none` nor a symmetric
//! algorithm with the public key as its secret can pass. `iss`, `aud` and `exp` are required; a token lives 24 h at most.

use std::{fmt, str::FromStr};

use base64::{Engine as _, engine::general_purpose::URL_SAFE_NO_PAD};
use jsonwebtoken::{DecodingKey, Validation, dangerous::insecure_decode};
use serde_json::{Map, Value};
use x509_parser::{
    pem::Pem, prelude::FromDer as _, public_key::PublicKey, x509::SubjectPublicKeyInfo,
};

use crate::{
    Principal, Refused, Role, Scope, UnixTime,
    principal::{Proof, is_shown_as_written},
};

/// Longest life of a signed token: from `iat` where it says so, and from now in any case.
const MAX_LIFE_SECS: i64 = 24 * 3600;
/// How far the clocks of issuer and server may differ.
const LEEWAY_SECS: i64 = 30;
/// Shortest RSA modulus that is still a signature.
const MIN_RSA_BITS: usize = 2048;
/// Longest `sub`, characters.
const MAX_SUBJECT: usize = 128;

/// How an issuer signs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Algorithm {
    /// Ed25519.
    EdDsa,
    /// ECDSA on P-256 with SHA-256.
    Es256,
    /// RSASSA-PKCS1-v1_5 with SHA-256, 2048 bits or more.
    Rs256,
}

/// An `[[issuer]]` of the token file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Issuer {
    /// The `iss` of its tokens.
    pub iss: String,
    /// The `aud` that its tokens must name.
    pub aud: String,
    /// How it signs.
    pub algorithm: Algorithm,
    /// Its public key, PEM (`PUBLIC KEY`).
    pub public_key: String,
    /// The roles that it may give.
    pub roles: Vec<Role>,
    /// Name of the claim that holds the role.
    pub role_claim: String,
    /// Name of the claim that holds the scope: an array of ids and prefixes, or one text with spaces between them.
    pub sessions_claim: String,
    /// Content of the key: the bits after its algorithm's name.
    key: Vec<u8>,
}

/// Why a public key is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum KeyError {
    /// Not PEM, or another kind of PEM.
    #[error("public_key is no PEM block of the kind PUBLIC KEY")]
    Pem,
    /// Not a key of the algorithm.
    #[error("public_key is no key of the algorithm {algorithm}")]
    Kind {
        /// The algorithm that the issuer names.
        algorithm: Algorithm,
    },
    /// Too short.
    #[error("public_key has {bits} bits, RS256 needs {MIN_RSA_BITS}")]
    Short {
        /// How many it has.
        bits: usize,
    },
}

impl Algorithm {
    const ALL: [Self; 3] = [Self::EdDsa, Self::Es256, Self::Rs256];

    /// As `alg` names it.
    pub fn name(self) -> &'static str {
        match self {
            Self::EdDsa => "EdDSA",
            Self::Es256 => "ES256",
            Self::Rs256 => "RS256",
        }
    }

    fn of_library(self) -> jsonwebtoken::Algorithm {
        match self {
            Self::EdDsa => jsonwebtoken::Algorithm::EdDSA,
            Self::Es256 => jsonwebtoken::Algorithm::ES256,
            Self::Rs256 => jsonwebtoken::Algorithm::RS256,
        }
    }

    fn decoding_key(self, key: &[u8]) -> DecodingKey {
        match self {
            Self::EdDsa => DecodingKey::from_ed_der(key),
            Self::Es256 => DecodingKey::from_ec_der(key),
            Self::Rs256 => DecodingKey::from_rsa_der(key),
        }
    }
}

impl fmt::Display for Algorithm {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

impl FromStr for Algorithm {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let mut all = Self::ALL.into_iter();
        all.find(|it| it.name() == text).ok_or(())
    }
}

impl Issuer {
    /// An issuer that may give every role but operator, in the claims `role` and `sessions`.
    ///
    /// # Errors
    ///
    /// [`KeyError`] when the key is not one of the algorithm.
    pub fn new(
        iss: &str,
        aud: &str,
        algorithm: Algorithm,
        public_key: &str,
    ) -> Result<Self, KeyError> {
        Ok(Self {
            iss: iss.to_owned(),
            aud: aud.to_owned(),
            algorithm,
            public_key: public_key.to_owned(),
            roles: vec![Role::Publisher, Role::Renderer, Role::Viewer],
            role_claim: "role".to_owned(),
            sessions_claim: "sessions".to_owned(),
            key: key_content(public_key, algorithm)?,
        })
    }

    /// Whether a principal that `proof` speaks of could still be one of this issuer.
    pub(crate) fn signed(&self, iss: &str, key: &[u8]) -> bool {
        self.iss == iss && self.key == key
    }

    fn verify(&self, token: &[u8], now: UnixTime) -> Result<Principal, Refused> {
        let mut validation = Validation::new(self.algorithm.of_library());
        validation.set_issuer(&[&self.iss]);
        validation.set_audience(&[&self.aud]);
        validation.set_required_spec_claims(&["exp", "iss", "aud"]);
        // Times are checked below, by the time that was handed in.
        validation.validate_exp = false;
        validation.validate_nbf = false;
        let key = self.algorithm.decoding_key(&self.key);
        let decoded = jsonwebtoken::decode::<Map<String, Value>>(token, &key, &validation);
        let claims = decoded.map_err(|_| Refused::because("the signature or a claim is wrong"))?;
        let expire_time = check_times(&claims.claims, now)?;
        self.principal(&claims.claims, expire_time)
    }

    fn principal(
        &self,
        claims: &Map<String, Value>,
        expire_time: UnixTime,
    ) -> Result<Principal, Refused> {
        let text = |claim: &str| claims.get(claim).and_then(Value::as_str);
        let role = text(&self.role_claim).and_then(|it| it.parse().ok());
        let role = role.filter(|it| self.roles.contains(it));
        let role = role.ok_or(Refused::because("the claimed role is none to be given"))?;
        let subject = text("sub").filter(|it| is_subject(it));
        let subject = subject.ok_or(Refused::because("sub is missing or unusable"))?;
        Ok(Principal {
            // The first `#` ends the issuer, so that no subject reads like one of another issuer.
            key: format!(
                "issuer:{}#{subject}",
                self.iss.replace('%', "%25").replace('#', "%23")
            ),
            name: subject.to_owned(),
            role,
            scope: self.scope(claims, role)?,
            images: false,
            expire_time: Some(expire_time),
            proof: Proof::Issuer {
                iss: self.iss.clone(),
                key: self.key.clone(),
            },
        })
    }

    fn scope(&self, claims: &Map<String, Value>, role: Role) -> Result<Scope, Refused> {
        if role == Role::Operator {
            return Ok(Scope::all());
        }
        let scope = match claims.get(&self.sessions_claim) {
            Some(Value::String(entries)) => entries.parse().ok(),
            Some(Value::Array(entries)) => {
                let entries: Option<Vec<&str>> = entries.iter().map(Value::as_str).collect();
                entries.and_then(|it| Scope::new(&it).ok())
            }
            _ => None,
        };
        scope.ok_or(Refused::because("the claimed sessions are no scope"))
    }
}

/// Verifies with every key of the issuer that the token names: two of them while a key is changed.
pub(crate) fn authenticate(
    issuers: &[Issuer],
    token: &[u8],
    now: UnixTime,
) -> Result<Principal, Refused> {
    let claimed = insecure_decode::<Map<String, Value>>(token);
    let claimed =
        claimed.map_err(|_| Refused::because("neither a known token nor a signed one"))?;
    if has_critical_extensions(token) {
        return Err(Refused::because("the signed token has critical extensions"));
    }
    let iss = claimed.claims.get("iss").and_then(Value::as_str);
    let mut refused = None;
    for issuer in issuers.iter().filter(|it| Some(it.iss.as_str()) == iss) {
        match issuer.verify(token, now) {
            Ok(principal) => return Ok(principal),
            Err(error) => refused = Some(error),
        }
    }
    Err(refused.unwrap_or_else(|| {
        // As much work as for an issuer that is known, so that the time does not say which are.
        if let Some(any) = issuers.first() {
            drop(any.verify(token, now));
        }
        Refused::because("no issuer of that name")
    }))
}

/// Whether the header demands what is not understood here; such a token must be refused (RFC 7515, 4.1.11).
fn has_critical_extensions(token: &[u8]) -> bool {
    let header = token.split(|it| *it == b'.').next().unwrap_or_default();
    let header = URL_SAFE_NO_PAD.decode(header).unwrap_or_default();
    let header = serde_json::from_slice::<Map<String, Value>>(&header);
    header.is_ok_and(|it| it.contains_key("crit"))
}

/// The expiry, when all times of the claims fit `now`.
fn check_times(claims: &Map<String, Value>, now: UnixTime) -> Result<UnixTime, Refused> {
    let now = now.secs();
    let exp = secs(claims, "exp")?.ok_or(Refused::because("exp is missing"))?;
    let nbf = secs(claims, "nbf")?;
    let iat = secs(claims, "iat")?;
    if exp <= now.saturating_sub(LEEWAY_SECS) {
        return Err(Refused::because("the signed token expired"));
    }
    let soon = now.saturating_add(LEEWAY_SECS);
    if exp > iat.unwrap_or(soon).min(soon).saturating_add(MAX_LIFE_SECS) {
        return Err(Refused::because("the signed token lives longer than 24 h"));
    }
    if nbf.is_some_and(|it| it > soon) || iat.is_some_and(|it| it > soon) {
        return Err(Refused::because("the signed token is not valid yet"));
    }
    // The leeway is for calls; a stream ends when the token says so.
    Ok(UnixTime::from_secs(exp))
}

/// A claim in whole seconds; fractions are allowed by the standard and cut.
fn secs(claims: &Map<String, Value>, claim: &str) -> Result<Option<i64>, Refused> {
    let Some(value) = claims.get(claim) else {
        return Ok(None);
    };
    let whole = value.as_i64().or_else(|| {
        let secs = value.as_f64().filter(|it| it.abs() < 1.0e12)?;
        #[expect(
            clippy::cast_possible_truncation,
            reason = "below 1e12, fractions are meant to go"
        )]
        Some(secs.floor() as i64)
    });
    whole
        .map(Some)
        .ok_or(Refused::because("a time among the claims is no number"))
}

/// Shown to operators and written to logs, so nothing that would steer a terminal.
fn is_subject(text: &str) -> bool {
    !text.is_empty() && text.chars().count() <= MAX_SUBJECT && is_shown_as_written(text)
}

fn key_content(pem: &str, algorithm: Algorithm) -> Result<Vec<u8>, KeyError> {
    let mut blocks = Pem::iter_from_buffer(pem.as_bytes());
    let block = match (blocks.next(), blocks.next()) {
        (Some(Ok(block)), None) if block.label == "PUBLIC KEY" => block,
        _ => return Err(KeyError::Pem),
    };
    let (rest, info) =
        SubjectPublicKeyInfo::from_der(&block.contents).map_err(|_| KeyError::Pem)?;
    if !rest.is_empty() {
        return Err(KeyError::Pem);
    }
    let content = info.subject_public_key.data.to_vec();
    let kind = info.algorithm.algorithm.to_id_string();
    let curve = info
        .algorithm
        .parameters
        .as_ref()
        .and_then(|it| it.as_oid().ok());
    let curve = curve.map(|it| it.to_id_string());
    let fits = match algorithm {
        Algorithm::EdDsa => kind == "1.3.101.112" && content.len() == 32,
        Algorithm::Es256 => {
            kind == "1.2.840.10045.2.1" && curve.as_deref() == Some("1.2.840.10045.3.1.7")
        }
        Algorithm::Rs256 => kind == "1.2.840.113549.1.1.1",
    };
    if !fits {
        return Err(KeyError::Kind { algorithm });
    }
    match info.parsed() {
        Ok(PublicKey::RSA(key)) if key.key_size() < MIN_RSA_BITS => Err(KeyError::Short {
            bits: key.key_size(),
        }),
        Err(_) if algorithm == Algorithm::Rs256 => Err(KeyError::Kind { algorithm }),
        _ => Ok(content),
    }
}

#[cfg(test)]
mod tests;
