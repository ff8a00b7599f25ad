//! The token file as TOML: strict on the way in, complete on the way out.

use std::fmt::Write as _;

use serde::Deserialize;
use toml::{Spanned, value::Datetime};

use super::{CreateError, MAX_TOKENS, TokenFile, TokenRecord};
use crate::{
    Algorithm, CertificateRule, CertificateSubject, Issuer, Role, Scope, ScopeError, TokenHash,
    UnixTime, issuer::KeyError,
};

/// Most issuers of a file, since a token may be tried against those of one name; and most rules for certificates.
const MAX_ISSUERS: usize = 16;
const MAX_CERTIFICATES: usize = 1_024;
/// Largest file that is read, bytes.
const MAX_FILE_BYTES: usize = 1024 * 1024;

/// Why a token file is refused, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TokenFileError {
    /// Not TOML, or a key that is unknown, missing or of another type; the text names the line.
    #[error("{0}")]
    Syntax(String),
    /// An entry that cannot stand.
    #[error("line {line}, [[{table}]]: {problem}")]
    Entry {
        /// Where the entry begins.
        line: usize,
        /// `token`, `issuer` or `certificate`.
        table: &'static str,
        /// What is wrong with it.
        problem: EntryError,
    },
    /// Too many entries.
    #[error("there are {found} [[{table}]], at most {limit} are taken")]
    TooMany {
        /// `token`, `issuer` or `certificate`.
        table: &'static str,
        /// How many there are.
        found: usize,
        /// How many there may be.
        limit: usize,
    },
    /// Too large to be one.
    #[error("the file has {found} bytes, at most {MAX_FILE_BYTES} are read")]
    TooLarge {
        /// How many it has.
        found: usize,
    },
}

/// What is wrong with an entry of a token file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EntryError {
    /// As when a token is made.
    #[error(transparent)]
    Token(#[from] CreateError),
    /// The role is none.
    #[error("a role is operator, publisher, renderer or viewer")]
    Role,
    /// The sessions are no scope.
    #[error("sessions: {0}")]
    Scope(#[from] ScopeError),
    /// Neither role has every session by itself nor are there any.
    #[error("sessions is missing")]
    NoScope,
    /// The hash has another form.
    #[error("hash is not \"sha256:\" and 64 hexadecimal digits")]
    Hash,
    /// A time has another form.
    #[error("{key} is no time with a zone, like 2026-01-31T18:00:00Z")]
    Time {
        /// Which.
        key: &'static str,
    },
    /// The algorithm is not one that is taken.
    #[error("algorithm is EdDSA, ES256 or RS256")]
    Algorithm,
    /// The key of an issuer.
    #[error(transparent)]
    Key(#[from] KeyError),
    /// A certificate is named in one way.
    #[error("exactly one of common_name and subject says whose certificate it is")]
    Subject,
    /// A text that must not be empty.
    #[error("{key} is empty")]
    Empty {
        /// Which.
        key: &'static str,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawFile {
    #[serde(default)]
    token: Vec<Spanned<RawToken>>,
    #[serde(default)]
    issuer: Vec<Spanned<RawIssuer>>,
    #[serde(default)]
    certificate: Vec<Spanned<RawCertificate>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawToken {
    id: String,
    name: String,
    role: String,
    sessions: Option<Vec<String>>,
    #[serde(default)]
    images: bool,
    hash: String,
    create_time: Datetime,
    expire_time: Option<Datetime>,
    #[serde(default)]
    revoked: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawIssuer {
    iss: String,
    aud: String,
    algorithm: String,
    public_key: String,
    roles: Option<Vec<String>>,
    role_claim: Option<String>,
    sessions_claim: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCertificate {
    common_name: Option<String>,
    subject: Option<String>,
    role: String,
    sessions: Option<Vec<String>>,
    #[serde(default)]
    images: bool,
}

pub(super) fn parse(text: &str) -> Result<TokenFile, TokenFileError> {
    if text.len() > MAX_FILE_BYTES {
        return Err(TokenFileError::TooLarge { found: text.len() });
    }
    let raw: RawFile = toml::from_str(text).map_err(|error| {
        // Without the excerpt that the library prints: a line of this file may hold what was pasted by mistake.
        let line = error.span().map_or(1, |it| line_of(text, it.start));
        TokenFileError::Syntax(format!("line {line}: {}", error.message()))
    })?;
    check_count("token", raw.token.len(), MAX_TOKENS)?;
    check_count("issuer", raw.issuer.len(), MAX_ISSUERS)?;
    check_count("certificate", raw.certificate.len(), MAX_CERTIFICATES)?;
    let mut file = TokenFile::default();
    for entry in raw.token {
        read(text, "token", entry, |raw| Ok(file.push(record(raw)?)?))?;
    }
    for entry in raw.issuer {
        file.issuers.push(read(text, "issuer", entry, issuer)?);
    }
    for entry in raw.certificate {
        let rule = read(text, "certificate", entry, certificate)?;
        file.certificates.push(rule);
    }
    Ok(file)
}

fn check_count(table: &'static str, found: usize, limit: usize) -> Result<(), TokenFileError> {
    if found > limit {
        return Err(TokenFileError::TooMany {
            table,
            found,
            limit,
        });
    }
    Ok(())
}

/// Reads one entry; its place goes into the error.
fn read<R, T>(
    text: &str,
    table: &'static str,
    entry: Spanned<R>,
    convert: impl FnOnce(R) -> Result<T, EntryError>,
) -> Result<T, TokenFileError> {
    let line = line_of(text, entry.span().start);
    convert(entry.into_inner()).map_err(|problem| TokenFileError::Entry {
        line,
        table,
        problem,
    })
}

fn line_of(text: &str, at_byte: usize) -> usize {
    let before = text.as_bytes().iter().take(at_byte);
    before.filter(|it| **it == b'\n').count() + 1
}

fn record(raw: RawToken) -> Result<TokenRecord, EntryError> {
    let role = role(&raw.role)?;
    Ok(TokenRecord {
        role,
        scope: scope(role, raw.sessions.as_deref())?,
        images: raw.images,
        hash: TokenHash::parse(&raw.hash).ok_or(EntryError::Hash)?,
        create_time: time("create_time", raw.create_time)?,
        expire_time: raw
            .expire_time
            .map(|it| time("expire_time", it))
            .transpose()?,
        revoked: raw.revoked,
        id: raw.id,
        name: raw.name,
    })
}

fn issuer(raw: RawIssuer) -> Result<Issuer, EntryError> {
    for (key, text) in [("iss", &raw.iss), ("aud", &raw.aud)] {
        if text.is_empty() {
            return Err(EntryError::Empty { key });
        }
    }
    let algorithm: Algorithm = raw.algorithm.parse().map_err(|()| EntryError::Algorithm)?;
    let mut issuer = Issuer::new(&raw.iss, &raw.aud, algorithm, &raw.public_key)?;
    if let Some(roles) = raw.roles {
        issuer.roles = roles.iter().map(|it| role(it)).collect::<Result<_, _>>()?;
    }
    if let Some(claim) = raw.role_claim {
        issuer.role_claim = claim;
    }
    if let Some(claim) = raw.sessions_claim {
        issuer.sessions_claim = claim;
    }
    Ok(issuer)
}

fn certificate(raw: RawCertificate) -> Result<CertificateRule, EntryError> {
    let subject = match (raw.common_name, raw.subject) {
        (Some(name), None) => CertificateSubject::CommonName(filled("common_name", name)?),
        (None, Some(whole)) => CertificateSubject::Whole(filled("subject", whole)?),
        _ => return Err(EntryError::Subject),
    };
    let role = role(&raw.role)?;
    if raw.images && role != Role::Operator {
        return Err(CreateError::Images.into());
    }
    Ok(CertificateRule {
        subject,
        role,
        scope: scope(role, raw.sessions.as_deref())?,
        images: raw.images,
    })
}

fn filled(key: &'static str, text: String) -> Result<String, EntryError> {
    if text.is_empty() {
        return Err(EntryError::Empty { key });
    }
    Ok(text)
}

fn role(text: &str) -> Result<Role, EntryError> {
    text.parse().map_err(|_| EntryError::Role)
}

fn scope(role: Role, entries: Option<&[String]>) -> Result<Scope, EntryError> {
    let scope = match entries {
        Some(entries) => Scope::new(entries)?,
        None if role == Role::Operator => Scope::all(),
        None => return Err(EntryError::NoScope),
    };
    if role == Role::Operator && !scope.is_all() {
        return Err(CreateError::OperatorScope.into());
    }
    Ok(scope)
}

fn time(key: &'static str, value: Datetime) -> Result<UnixTime, EntryError> {
    value
        .to_string()
        .parse()
        .map_err(|_| EntryError::Time { key })
}

const HEADER: &str = "\
# Who may use this Frontalis server. Written by `frontalis token`; the server reads it again when it changes.
# Only hashes are kept: a token is shown once, when it is made.
";

pub(super) fn print(file: &TokenFile) -> String {
    let mut text = HEADER.to_owned();
    for record in &file.tokens {
        text.push_str("\n[[token]]\n");
        put(&mut text, "id", &quoted(&record.id));
        put(&mut text, "name", &quoted(&record.name));
        put_rights(&mut text, record.role, &record.scope, record.images);
        put(&mut text, "hash", &quoted(&record.hash.to_text()));
        put(&mut text, "create_time", &record.create_time.to_string());
        if let Some(at) = record.expire_time {
            put(&mut text, "expire_time", &at.to_string());
        }
        if record.revoked {
            put(&mut text, "revoked", "true");
        }
    }
    for issuer in &file.issuers {
        text.push_str("\n[[issuer]]\n");
        put(&mut text, "iss", &quoted(&issuer.iss));
        put(&mut text, "aud", &quoted(&issuer.aud));
        put(&mut text, "algorithm", &quoted(issuer.algorithm.name()));
        put(&mut text, "public_key", &quoted(&issuer.public_key));
        let roles: Vec<String> = issuer.roles.iter().map(ToString::to_string).collect();
        put(&mut text, "roles", &list(&roles));
        put(&mut text, "role_claim", &quoted(&issuer.role_claim));
        put(&mut text, "sessions_claim", &quoted(&issuer.sessions_claim));
    }
    for rule in &file.certificates {
        text.push_str("\n[[certificate]]\n");
        let (key, name) = match &rule.subject {
            CertificateSubject::CommonName(name) => ("common_name", name),
            CertificateSubject::Whole(whole) => ("subject", whole),
        };
        put(&mut text, key, &quoted(name));
        put_rights(&mut text, rule.role, &rule.scope, rule.images);
    }
    text
}

fn put_rights(text: &mut String, role: Role, scope: &Scope, images: bool) {
    put(text, "role", &quoted(role.name()));
    put(text, "sessions", &list(&scope.entries()));
    if images {
        put(text, "images", "true");
    }
}

fn put(text: &mut String, key: &str, value: &str) {
    writeln!(text, "{key} = {value}").expect("invariant: a String takes every write");
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

fn list(entries: &[String]) -> String {
    let quoted: Vec<String> = entries.iter().map(|it| quoted(it)).collect();
    format!("[{}]", quoted.join(", "))
}
