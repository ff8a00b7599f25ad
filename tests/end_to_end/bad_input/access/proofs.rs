//! Proofs of identity that prove nothing: what is malformed, wrong or over, and what an attacker makes of an issuer's
//! public key.

use base64::{Engine as _, engine::general_purpose::URL_SAFE_NO_PAD};
use frontalis_access::Role;
use harness::{TestIssuer, now};
use jsonwebtoken::{Algorithm, EncodingKey, Header, encode};
use serde_json::{Value, json};

/// Something in a request that proves nothing.
pub(super) struct Proof {
    pub(super) what: &'static str,
    pub(super) authorization: Option<String>,
    pub(super) query: String,
}

impl Proof {
    pub(super) fn header(what: &'static str, authorization: String) -> Self {
        Self {
            what,
            authorization: Some(authorization),
            query: String::new(),
        }
    }
}

/// What is in `Authorization` of a renderer whom the issuer vouches for.
pub(super) fn good(issuer: &TestIssuer) -> String {
    signed(issuer, &json!({}))
}

/// What must not pass, each under its name.
pub(super) fn bad(issuer: &TestIssuer) -> Vec<Proof> {
    let now = now().secs();
    let with = |changed: Value| signed(issuer, &changed);
    let good = good(issuer);
    let cut = good[..good.len() - 4].to_owned();
    let pem = issuer.public_key_pem();
    [
        ("malformed", "Bearer".to_owned()),
        ("another scheme", "Basic b3BlcmF0b3I6".to_owned()),
        ("wrong", format!("Bearer frontalis_{}", "A".repeat(43))),
        ("expired", with(json!({ "exp": now - 60 }))),
        ("not yet valid", with(json!({ "nbf": now + 600 }))),
        ("made in the future", with(json!({ "iat": now + 600 }))),
        ("wrong audience", with(json!({ "aud": "another" }))),
        ("no audience", with(json!({ "aud": null }))),
        (
            "wrong issuer",
            with(json!({ "iss": "https://evil.example" })),
        ),
        ("no expiry", with(json!({ "exp": null }))),
        ("longer than a day", with(json!({ "exp": now + 90_000 }))),
        (
            "operator by its own word",
            with(json!({ "role": "operator" })),
        ),
        ("no scope", with(json!({ "sessions": [] }))),
        (
            "alg none",
            format!("Bearer {}.", unsigned(&claims(&json!({})))),
        ),
        ("HS256 with the PEM", confused(pem.as_bytes())),
        ("HS256 with the key's bytes", confused(issuer.public_key())),
        ("cut signature", cut),
        ("another key", self::good(&TestIssuer::new())),
        // The longest that the limit of all headers lets through.
        ("long", format!("Bearer {}", "a".repeat(12 << 10))),
    ]
    .map(|(what, value)| Proof::header(what, value))
    .into()
}

fn signed(issuer: &TestIssuer, changed: &Value) -> String {
    format!("Bearer {}", issuer.signed(&claims(changed)))
}

/// Signed with the public key as if it were a secret.
fn confused(secret: &[u8]) -> String {
    let key = EncodingKey::from_secret(secret);
    let claims = claims(&json!({}));
    let token = encode(&Header::new(Algorithm::HS256), &claims, &key).unwrap();
    format!("Bearer {token}")
}

/// Claims that pass, but for what is changed; null leaves a claim out.
fn claims(changed: &Value) -> Value {
    let mut claims = TestIssuer::claims(Role::Renderer, "own-*");
    for (key, value) in changed.as_object().unwrap() {
        if value.is_null() {
            claims.as_object_mut().unwrap().remove(key);
        } else {
            claims[key] = value.clone();
        }
    }
    claims
}

fn unsigned(claims: &Value) -> String {
    let part = |it: &Value| URL_SAFE_NO_PAD.encode(it.to_string());
    let header = json!({ "alg": "none", "typ": "JWT" });
    format!("{}.{}", part(&header), part(claims))
}
