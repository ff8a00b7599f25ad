//! Client certificates: which subject is what (CONTRACTS S-2).
//!
//! A rule says whether it means the common name or the whole subject, and a whole subject is compared in a form in
//! which every name is escaped (RFC 4514): no name can be written so that it reads like another subject.

use std::fmt;

use x509_parser::{
    prelude::{FromDer as _, X509Certificate},
    x509::{AttributeTypeAndValue, X509Name},
};

use crate::{
    Principal, Refused, Role, Scope, UnixTime,
    principal::{Proof, is_shown_as_written},
};

/// A `[[certificate]]` of the token file. The handshake has verified the chain; this says what the subject may do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CertificateRule {
    /// Whom it means.
    pub subject: CertificateSubject,
    /// What it is.
    pub role: Role,
    /// Where it is that.
    pub scope: Scope,
    /// Whether an operator may read raw images.
    pub images: bool,
}

/// Whom a rule for certificates means.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CertificateSubject {
    /// Certificates of exactly one common name, which is this, whatever else their subject says.
    CommonName(String),
    /// Certificates of exactly this subject: `CN=renderer-1, O=Stage`, in the certificate's order, with `, ` between
    /// the parts and ` + ` inside of one, other attributes than CN, O, OU, C, ST, L by their number; a backslash
    /// before `, + " \ < > ; =`, before a `#` or space at the beginning of a name, and a space at its end.
    Whole(String),
}

/// What is read of a certificate.
struct Subject {
    whole: String,
    common_name: Option<String>,
    expire_time: UnixTime,
}

impl CertificateSubject {
    fn is_of(&self, subject: &Subject) -> bool {
        match self {
            Self::CommonName(name) => Some(name) == subject.common_name.as_ref(),
            Self::Whole(whole) => *whole == subject.whole,
        }
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
    let rule = rules.iter().find(|it| it.subject.is_of(&subject));
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
        whole: whole(subject)?,
        common_name,
        expire_time: UnixTime::from_secs(certificate.validity().not_after.timestamp()),
    })
}

/// The subject as text, another for every other subject; none when a name of it is no text that people could compare.
fn whole(subject: &X509Name<'_>) -> Option<String> {
    let parts = subject.iter_rdn().map(|part| {
        let attributes = part.iter().map(attribute);
        let attributes: Option<Vec<String>> = attributes.collect();
        attributes.map(|it| it.join(" + "))
    });
    let parts: Option<Vec<String>> = parts.collect();
    parts.map(|it| it.join(", "))
}

fn attribute(attribute: &AttributeTypeAndValue<'_>) -> Option<String> {
    let value = attribute
        .as_str()
        .ok()
        .filter(|it| is_shown_as_written(it))?;
    let number = attribute.attr_type().to_id_string();
    let name = ATTRIBUTES.iter().find(|it| it.0 == number);
    let name = name.map_or(number.as_str(), |it| it.1);
    Some(format!("{name}={}", Escaped(value)))
}

/// The attributes that have a name here.
const ATTRIBUTES: [(&str, &str); 6] = [
    ("2.5.4.3", "CN"),
    ("2.5.4.6", "C"),
    ("2.5.4.7", "L"),
    ("2.5.4.8", "ST"),
    ("2.5.4.10", "O"),
    ("2.5.4.11", "OU"),
];

/// A name in which nothing can be taken for what is between names.
struct Escaped<'a>(&'a str);

impl fmt::Display for Escaped<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let last = self.0.chars().count().saturating_sub(1);
        for (idx, character) in self.0.chars().enumerate() {
            let is_special = match character {
                ',' | '+' | '"' | '\\' | '<' | '>' | ';' | '=' => true,
                '#' => idx == 0,
                ' ' => idx == 0 || idx == last,
                _ => false,
            };
            if is_special {
                formatter.write_str("\\")?;
            }
            write!(formatter, "{character}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use rcgen::{CertificateParams, DnType, KeyPair, date_time_ymd};

    use super::*;

    const NOW: UnixTime = UnixTime::from_secs(1_800_000_000);

    fn of(names: &[(DnType, &str)], until_year: i32) -> Vec<u8> {
        let mut params = CertificateParams::default();
        params.distinguished_name = rcgen::DistinguishedName::new();
        for (kind, name) in names {
            params.distinguished_name.push(kind.clone(), *name);
        }
        params.not_after = date_time_ymd(until_year, 1, 1);
        let key = KeyPair::generate().unwrap();
        params.self_signed(&key).unwrap().der().to_vec()
    }

    fn certificate(name: &str, until_year: i32) -> Vec<u8> {
        let names = [
            (DnType::CommonName, name),
            (DnType::OrganizationName, "Stage"),
        ];
        of(&names, until_year)
    }

    fn rule(subject: CertificateSubject) -> CertificateRule {
        CertificateRule {
            subject,
            role: Role::Renderer,
            scope: Scope::all(),
            images: false,
        }
    }

    fn common_name(name: &str) -> CertificateRule {
        rule(CertificateSubject::CommonName(name.to_owned()))
    }

    fn whole(subject: &str) -> CertificateRule {
        rule(CertificateSubject::Whole(subject.to_owned()))
    }

    const NO_ROLE: &str = "the certificate's subject has no role";

    fn why_refused(rule: CertificateRule, der: &[u8]) -> &'static str {
        authenticate(&[rule], der, NOW).unwrap_err().why
    }

    #[test]
    fn a_rule_names_the_common_name_or_the_whole_subject() {
        let der = certificate("renderer-1", 2100);
        for rule in [common_name("renderer-1"), whole("CN=renderer-1, O=Stage")] {
            let principal = authenticate(&[rule], &der, NOW).unwrap();
            assert_eq!(principal.name, "renderer-1");
            assert_eq!(principal.key, "certificate:CN=renderer-1, O=Stage");
            assert_eq!(principal.role, Role::Renderer);
        }
        for rule in [
            common_name("renderer"),
            common_name("CN=renderer-1"),
            common_name("CN=renderer-1, O=Stage"),
            common_name("Stage"),
            whole("renderer-1"),
            whole("O=Stage, CN=renderer-1"),
        ] {
            assert_eq!(why_refused(rule, &der), NO_ROLE);
        }
    }

    #[test]
    fn no_name_reads_like_another_subject() {
        let meant = "O=Stage, CN=renderer-1";
        let genuine = [
            (DnType::OrganizationName, "Stage"),
            (DnType::CommonName, "renderer-1"),
        ];
        let principal = authenticate(&[whole(meant)], &of(&genuine, 2100), NOW).unwrap();
        let spoofs = [
            of(&[(DnType::CommonName, meant)], 2100),
            of(&[(DnType::OrganizationName, "Stage, CN=renderer-1")], 2100),
        ];
        for spoof in &spoofs {
            assert_eq!(why_refused(whole(meant), spoof), NO_ROLE);
            assert_eq!(why_refused(common_name("renderer-1"), spoof), NO_ROLE);
        }
        // Whoever lets the first in by its common name has another principal.
        let other = authenticate(&[common_name(meant)], &spoofs[0], NOW).unwrap();
        assert_ne!(other.key, principal.key);
        assert_eq!(other.key, r"certificate:CN=O\=Stage\, CN\=renderer-1");
    }

    #[test]
    fn names_that_would_show_as_something_else_are_refused() {
        for name in [
            "a\u{202e}b",
            "a\u{2028}b",
            "a\nb",
            "a\u{1b}[31m",
            "\u{2066}a",
        ] {
            let der = certificate(name, 2100);
            let why = why_refused(common_name(name), &der);
            assert_eq!(why, "the certificate cannot be read", "{name:?}");
        }
    }

    /// Takes an escaped text apart again.
    fn unescaped(text: &str) -> Vec<String> {
        let (mut parts, mut is_escaped) = (vec![String::new()], false);
        for character in text.chars() {
            match character {
                '\\' if !is_escaped => is_escaped = true,
                ',' if !is_escaped => parts.push(String::new()),
                _ => {
                    parts.last_mut().unwrap().push(character);
                    is_escaped = false;
                }
            }
        }
        parts
    }

    proptest::proptest! {
        #[test]
        fn what_is_escaped_is_read_back_as_it_was(
            names in proptest::collection::vec(r#"[-a=,+"\\\\<>;# ]{0,12}"#, 1..4),
        ) {
            let escaped: Vec<String> = names.iter().map(|it| Escaped(it).to_string()).collect();
            proptest::prop_assert_eq!(unescaped(&escaped.join(",")), names);
        }
    }

    #[test]
    fn an_expired_or_unreadable_certificate_proves_nothing() {
        let expired = certificate("renderer-1", 2020);
        let mut longer = certificate("renderer-1", 2100);
        longer.push(0);
        for der in [&expired[..], &longer[..], &expired[..20], b""] {
            authenticate(&[common_name("renderer-1")], der, NOW).unwrap_err();
        }
    }
}
