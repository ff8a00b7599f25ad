//! Proofs of identity, good and bad: an issuer that the token file names, and what an attacker makes of its public key.

use base64::{Engine as _, engine::general_purpose::URL_SAFE_NO_PAD};
use harness::now;
use jsonwebtoken::{Algorithm, EncodingKey, Header, encode};
use rcgen::{KeyPair, PKCS_ED25519, PublicKeyData as _};
use serde_json::{Value, json};

const ISS: &str = "https://login.example";

/// Who signs.
pub(super) struct Issuer {
    key: KeyPair,
}

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

impl Issuer {
    pub(super) fn new() -> Self {
        Self {
            key: KeyPair::generate_for(&PKCS_ED25519).unwrap(),
        }
    }

    /// Its entry in the token file.
    pub(super) fn entry(&self) -> String {
        format!(
            "\n[[issuer]]\niss = \"{ISS}\"\naud = \"frontalis\"\nalgorithm = \"EdDSA\"\npublic_key = '''\n{}'''\n",
            self.key.public_key_pem()
        )
    }

    pub(super) fn good(&self) -> String {
        self.signed(&claims(&json!({})))
    }

    fn signed(&self, claims: &Value) -> String {
        let key = EncodingKey::from_ed_der(&self.key.serialize_der());
        let token = encode(&Header::new(Algorithm::EdDSA), claims, &key).unwrap();
        format!("Bearer {token}")
    }

    /// What must not pass, each under its name.
    pub(super) fn bad_proofs(&self) -> Vec<Proof> {
        let now = now().secs();
        let with = |changed: Value| self.signed(&claims(&changed));
        let good = self.good();
        let unsigned = unsigned(&claims(&json!({})));
        let pem = self.key.public_key_pem();
        let raw = self.key.der_bytes();
        let cut = good[..good.len() - 4].to_owned();
        let other = Self::new().good();
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
            ("alg none", format!("Bearer {unsigned}.")),
            ("HS256 with the PEM", confused(pem.as_bytes())),
            ("HS256 with the key's bytes", confused(raw)),
            ("cut signature", cut),
            ("another key", other),
            // The longest that the limit of all headers lets through.
            ("long", format!("Bearer {}", "a".repeat(12 << 10))),
        ]
        .map(|(what, value)| Proof::header(what, value))
        .into()
    }
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
    let now = now().secs();
    let mut claims = json!({
        "iss": ISS, "aud": "frontalis", "sub": "renderer-1", "iat": now, "exp": now + 600,
        "role": "renderer", "sessions": ["own-*"],
    });
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
