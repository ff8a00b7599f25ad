//! Signed tokens, good and bad. The RS256 token was signed once by openssl; its private key is gone.

use jsonwebtoken::{EncodingKey, Header, encode};
use rcgen::{KeyPair, PKCS_ECDSA_P256_SHA256, PKCS_ED25519, SignatureAlgorithm};
use serde_json::json;

use super::*;

const NOW: UnixTime = UnixTime::from_secs(1_800_000_000);
const ISS: &str = "https://login.example";
const RS256_KEY: &str = include_str!("rs256.pem");
const RS256_TOKEN: &str = include_str!("rs256.jwt");
const RSA_1024_KEY: &str = include_str!("rsa_1024.pem");

struct Signer {
    key: KeyPair,
    algorithm: Algorithm,
}

impl Signer {
    fn new(algorithm: Algorithm, kind: &'static SignatureAlgorithm) -> Self {
        let key = KeyPair::generate_for(kind).unwrap();
        Self { key, algorithm }
    }

    fn ed25519() -> Self {
        Self::new(Algorithm::EdDsa, &PKCS_ED25519)
    }

    fn issuer(&self) -> Issuer {
        Issuer::new(ISS, "frontalis", self.algorithm, &self.key.public_key_pem()).unwrap()
    }

    fn sign(&self, changed: &Value) -> String {
        let der = self.key.serialize_der();
        let key = match self.algorithm {
            Algorithm::EdDsa => EncodingKey::from_ed_der(&der),
            Algorithm::Es256 => EncodingKey::from_ec_der(&der),
            Algorithm::Rs256 => EncodingKey::from_rsa_der(&der),
        };
        let header = Header::new(self.algorithm.of_library());
        encode(&header, &claims(changed), &key).unwrap()
    }
}

fn claims(changed: &Value) -> Value {
    let now = NOW.secs();
    let mut claims = json!({
        "iss": ISS, "aud": "frontalis", "sub": "renderer-1", "iat": now, "exp": now + 600,
        "role": "renderer", "sessions": ["own-*"],
    });
    for (key, value) in changed.as_object().unwrap() {
        claims[key] = value.clone();
    }
    claims
}

fn why(issuer: &Issuer, token: &str, now: UnixTime) -> &'static str {
    let outcome = authenticate(std::slice::from_ref(issuer), token.as_bytes(), now);
    outcome.map_or_else(|it| it.why, |_| "")
}

#[test]
fn every_algorithm_is_verified_and_the_claims_become_a_principal() {
    let (ed, es) = (
        Signer::ed25519(),
        Signer::new(Algorithm::Es256, &PKCS_ECDSA_P256_SHA256),
    );
    let rs = Issuer::new(ISS, "frontalis", Algorithm::Rs256, RS256_KEY).unwrap();
    let cases = [
        (ed.issuer(), ed.sign(&json!({}))),
        (es.issuer(), es.sign(&json!({}))),
        (rs, RS256_TOKEN.to_owned()),
    ];
    for (issuer, token) in &cases {
        let issuers = std::slice::from_ref(issuer);
        let principal = authenticate(issuers, token.as_bytes(), NOW).unwrap();
        assert_eq!(principal.role, Role::Renderer);
        assert_eq!(principal.key, "issuer:https://login.example#renderer-1");
        assert!(principal.scope.contains("own-1") && !principal.scope.contains("other"));
        assert_eq!(
            principal.expire_time,
            Some(UnixTime::from_secs(NOW.secs() + 600))
        );
        // No other key of the three verifies it.
        for (other, _) in cases.iter().filter(|it| it.0 != *issuer) {
            assert_ne!(why(other, token, NOW), "");
        }
        // One changed letter anywhere is too much.
        for at in [3, token.len() / 2, token.len() - 3] {
            let mut bytes = token.clone().into_bytes();
            bytes[at] = if bytes[at] == b'A' { b'B' } else { b'A' };
            let changed = String::from_utf8(bytes).unwrap();
            assert_ne!(why(issuer, &changed, NOW), "", "letter {at}");
        }
    }
}

#[test]
fn times_have_a_leeway_and_a_day_is_the_longest_life() {
    let signer = Signer::ed25519();
    let issuer = signer.issuer();
    let now = NOW.secs();
    let cases = [
        (json!({ "exp": now - 29 }), ""),
        (json!({ "exp": now - 30 }), "the signed token expired"),
        (json!({ "exp": i64::MIN }), "the signed token expired"),
        (json!({ "nbf": now + 30 }), ""),
        (
            json!({ "nbf": now + 31 }),
            "the signed token is not valid yet",
        ),
        (
            json!({ "iat": now + 31, "exp": now + 60 }),
            "the signed token is not valid yet",
        ),
        (json!({ "iat": now, "exp": now + 86_400 }), ""),
        (
            json!({ "iat": now, "exp": now + 86_401 }),
            "the signed token lives longer than 24 h",
        ),
        (
            json!({ "iat": now - 86_000, "exp": now + 500 }),
            "the signed token lives longer than 24 h",
        ),
        (
            json!({ "iat": null, "exp": now }),
            "a time among the claims is no number",
        ),
        (
            json!({ "exp": "soon" }),
            "a time among the claims is no number",
        ),
        (
            json!({ "exp": i64::MAX }),
            "the signed token lives longer than 24 h",
        ),
        (
            json!({ "exp": 1.0e300 }),
            "a time among the claims is no number",
        ),
    ];
    for (changed, expected) in cases {
        let token = signer.sign(&changed);
        let found = why(&issuer, &token, NOW);
        // What the library refuses by itself is refused under its own name.
        let fits = found == expected
            || (!expected.is_empty() && found == "the signature or a claim is wrong");
        assert!(fits, "{changed}: {found:?}, expected {expected:?}");
    }
}

#[test]
fn an_issuer_gives_no_role_that_it_may_not() {
    let signer = Signer::ed25519();
    let mut issuer = signer.issuer();
    let operator = signer.sign(&json!({ "role": "operator", "sessions": null }));
    assert_eq!(
        why(&issuer, &operator, NOW),
        "the claimed role is none to be given"
    );
    issuer.roles = vec![Role::Operator];
    let principal = authenticate(std::slice::from_ref(&issuer), operator.as_bytes(), NOW);
    assert!(principal.unwrap().scope.is_all());
    let renderer = signer.sign(&json!({}));
    assert_eq!(
        why(&issuer, &renderer, NOW),
        "the claimed role is none to be given"
    );
}

#[test]
fn a_scope_is_a_list_or_words_and_never_nothing() {
    let signer = Signer::ed25519();
    let issuer = signer.issuer();
    let fine = signer.sign(&json!({ "sessions": "a-* b" }));
    assert_eq!(why(&issuer, &fine, NOW), "");
    for sessions in [
        json!([]),
        json!(""),
        json!(null),
        json!(7),
        json!(["A"]),
        json!([1]),
    ] {
        let token = signer.sign(&json!({ "sessions": sessions }));
        assert_eq!(
            why(&issuer, &token, NOW),
            "the claimed sessions are no scope",
            "{sessions}"
        );
    }
    for sub in ["a\u{1b}[31m", "a\u{202e}b", "a\u{2028}b"] {
        let hostile = signer.sign(&json!({ "sub": sub }));
        assert_eq!(why(&issuer, &hostile, NOW), "sub is missing or unusable");
    }
}

#[test]
fn a_key_of_another_kind_is_refused_when_the_file_is_read() {
    let ed = Signer::ed25519().key.public_key_pem();
    let make = |algorithm, pem: &str| Issuer::new(ISS, "frontalis", algorithm, pem).unwrap_err();
    let kind = |algorithm| KeyError::Kind { algorithm };
    assert_eq!(make(Algorithm::Rs256, &ed), kind(Algorithm::Rs256));
    assert_eq!(make(Algorithm::Es256, &ed), kind(Algorithm::Es256));
    assert_eq!(make(Algorithm::EdDsa, RS256_KEY), kind(Algorithm::EdDsa));
    assert_eq!(
        make(Algorithm::Rs256, RSA_1024_KEY),
        KeyError::Short { bits: 1024 }
    );
    let private = Signer::ed25519().key.serialize_pem();
    assert_eq!(make(Algorithm::EdDsa, &private), KeyError::Pem);
    assert_eq!(make(Algorithm::EdDsa, "no key"), KeyError::Pem);
}

#[test]
fn a_principal_stands_while_its_issuer_and_its_key_do() {
    let signer = Signer::ed25519();
    let token = signer.sign(&json!({}));
    let entry = |issuer: &Issuer| {
        format!(
            "[[issuer]]\niss = \"{ISS}\"\naud = \"frontalis\"\nalgorithm = \"EdDSA\"\npublic_key = '''\n{}'''\n",
            issuer.public_key
        )
    };
    let file = crate::TokenFile::parse(&entry(&signer.issuer())).unwrap();
    assert_eq!(crate::TokenFile::parse(&file.to_toml()).unwrap(), file);
    let principal = file.authenticate(token.as_bytes(), NOW).unwrap();
    assert!(file.still_stands(&principal, NOW));
    assert!(!file.still_stands(&principal, UnixTime::from_secs(NOW.secs() + 600)));
    let rotated = crate::TokenFile::parse(&entry(&Signer::ed25519().issuer())).unwrap();
    assert!(!rotated.still_stands(&principal, NOW));
}

#[test]
fn what_a_header_calls_critical_is_not_understood() {
    let signer = Signer::ed25519();
    let mut header = Header::new(jsonwebtoken::Algorithm::EdDSA);
    header.extras.insert("crit".to_owned(), json!(["b64"]));
    let key = EncodingKey::from_ed_der(&signer.key.serialize_der());
    let token = encode(&header, &claims(&json!({})), &key).unwrap();
    let critical = "the signed token has critical extensions";
    assert_eq!(why(&signer.issuer(), &token, NOW), critical);
}

#[test]
fn a_principal_of_one_issuer_is_none_of_another() {
    let signer = Signer::ed25519();
    let key = |iss: &str, sub: &str| {
        let pem = signer.key.public_key_pem();
        let issuer = Issuer::new(iss, "frontalis", Algorithm::EdDsa, &pem).unwrap();
        let token = signer.sign(&json!({ "iss": iss, "sub": sub }));
        authenticate(&[issuer], token.as_bytes(), NOW).unwrap().key
    };
    assert_ne!(key("a#b", "c"), key("a", "b#c"));
    assert_ne!(key("a%23b", "c"), key("a#b", "c"));
}
