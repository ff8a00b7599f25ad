//! Client certificates: which subject is what (CONTRACTS S-2).

use x509_parser::prelude::{FromDer as _, X509Certificate};

use crate::{Principal, Refused, Role, Scope, UnixTime, principal::Proof};

/// A `[[certificate]]` of the token file. The handshake has verified the chain; this says what the subject may do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CertificateRule {
    /// The common name, or the whole subject as `CN=..., O=...`.
    pub subject: String,
    /// What it is.
    pub role: Role,
    /// Where it is that.
    pub scope: Scope,
    /// Whether an operator may read raw images.
    pub images: bool,
}

/// What is read of a certificate.
struct Subject {
    whole: String,
    common_name: Option<String>,
    expire_time: UnixTime,
}

impl CertificateRule {
    fn is_of(&self, subject: &Subject) -> bool {
        self.subject == subject.whole || Some(&self.subject) == subject.common_name.as_ref()
    }
}

/// The principal of a certificate (DER) by the first rule of its subject.
pub(crate) fn authenticate(
    rules: &[CertificateRule],
    der: &[u8],
    now: UnixTime,
) -> Result<Principal, Refused> {
    let subject = read(der).ok_or(Refused::because("the certificate cannot be read"))?;
    if subject.expire_time <= now {
        return Err(Refused::because("the certificate expired"));
    }
    let rule = rules.iter().find(|it| it.is_of(&subject));
    let rule = rule.ok_or(Refused::because("the certificate's subject has no role"))?;
    Ok(Principal {
        key: format!("certificate:{}", subject.whole),
        name: subject.common_name.unwrap_or(subject.whole),
        role: rule.role,
        scope: rule.scope.clone(),
        images: rule.images,
        expire_time: Some(subject.expire_time),
        proof: Proof::Certificate {
            subject: rule.subject.clone(),
        },
    })
}

fn read(der: &[u8]) -> Option<Subject> {
    let (rest, certificate) = X509Certificate::from_der(der).ok()?;
    if !rest.is_empty() {
        return None;
    }
    let subject = certificate.subject();
    // Of two common names neither is the one that a rule meant.
    let mut names = subject.iter_common_name();
    let common_name = match (names.next(), names.next()) {
        (Some(name), None) => name.as_str().ok().map(str::to_owned),
        _ => None,
    };
    Some(Subject {
        whole: subject.to_string(),
        common_name,
        expire_time: UnixTime::from_secs(certificate.validity().not_after.timestamp()),
    })
}

#[cfg(test)]
mod tests {
    use rcgen::{CertificateParams, DnType, KeyPair, date_time_ymd};

    use super::*;

    const NOW: UnixTime = UnixTime::from_secs(1_800_000_000);

    fn certificate(names: &[&str], until_year: i32) -> Vec<u8> {
        let mut params = CertificateParams::default();
        params.distinguished_name = rcgen::DistinguishedName::new();
        for name in names {
            params.distinguished_name.push(DnType::CommonName, *name);
        }
        params
            .distinguished_name
            .push(DnType::OrganizationName, "Stage");
        params.not_after = date_time_ymd(until_year, 1, 1);
        let key = KeyPair::generate().unwrap();
        params.self_signed(&key).unwrap().der().to_vec()
    }

    fn rule(subject: &str) -> CertificateRule {
        CertificateRule {
            subject: subject.to_owned(),
            role: Role::Renderer,
            scope: Scope::all(),
            images: false,
        }
    }

    #[test]
    fn a_rule_names_the_common_name_or_the_whole_subject() {
        let der = certificate(&["renderer-1"], 2100);
        for subject in ["renderer-1", "CN=renderer-1, O=Stage"] {
            let principal = authenticate(&[rule(subject)], &der, NOW).unwrap();
            assert_eq!(principal.name, "renderer-1");
            assert_eq!(principal.key, "certificate:CN=renderer-1, O=Stage");
            assert_eq!(principal.role, Role::Renderer);
        }
        for subject in ["renderer", "CN=renderer-1", "Stage"] {
            let refused = authenticate(&[rule(subject)], &der, NOW).unwrap_err();
            assert_eq!(refused.why, "the certificate's subject has no role");
        }
    }

    #[test]
    fn an_expired_or_unreadable_certificate_proves_nothing() {
        let expired = certificate(&["renderer-1"], 2020);
        let mut longer = certificate(&["renderer-1"], 2100);
        longer.push(0);
        for der in [&expired[..], &longer[..], &expired[..20], b""] {
            authenticate(&[rule("renderer-1")], der, NOW).unwrap_err();
        }
    }
}
