//! An issuer of signed tokens (JWT) that a token file may name.

use frontalis_access::Role;
use jsonwebtoken::{Algorithm, EncodingKey, Header, encode};
use rcgen::{KeyPair, PKCS_ED25519, PublicKeyData as _};
use serde_json::{Value, json};

const ISS: &str = "https://login.example";

/// Who signs, with Ed25519.
pub struct TestIssuer {
    key: KeyPair,
}

impl TestIssuer {
    /// One with a key of its own.
    pub fn new() -> Self {
        Self {
            key: KeyPair::generate_for(&PKCS_ED25519).unwrap(),
        }
    }

    /// Its entry in a token file, to be put at the end: it may give these roles.
    pub fn entry(&self, roles: &[Role]) -> String {
        let roles: Vec<&str> = roles.iter().map(|it| it.name()).collect();
        format!(
            "\n[[issuer]]\niss = \"{ISS}\"\naud = \"frontalis\"\nalgorithm = \"EdDSA\"\nroles = {roles:?}\npublic_key = '''\n{}'''\n",
            self.public_key_pem()
        )
    }

    /// Claims that pass for the next hour.
    pub fn claims(role: Role, sessions: &str) -> Value {
        let now = crate::now().secs();
        json!({
            "iss": ISS, "aud": "frontalis", "sub": format!("{role}-1"), "iat": now, "exp": now + 3_600,
            "role": role.name(), "sessions": [sessions],
        })
    }

    /// A token.
    pub fn signed(&self, claims: &Value) -> String {
        let key = EncodingKey::from_ed_der(&self.key.serialize_der());
        encode(&Header::new(Algorithm::EdDSA), claims, &key).unwrap()
    }

    /// The key that a server verifies with.
    pub fn public_key_pem(&self) -> String {
        self.key.public_key_pem()
    }

    /// The same without its frame.
    pub fn public_key(&self) -> &[u8] {
        self.key.der_bytes()
    }
}

impl Default for TestIssuer {
    fn default() -> Self {
        Self::new()
    }
}
