//! The token file: who may come, as TOML that people read and `frontalis token` writes.
//!
//! ```toml
//! [[token]]
//! id = "t-5f0c2a91"
//! name = "Stage A capture"
//! role = "publisher"                  # operator, publisher, renderer, viewer
//! sessions = ["stage-a-*", "demo"]    # ids and prefixes; an operator has them all
//! hash = "sha256:..."                 # the token itself is nowhere
//! create_time = 2026-01-31T18:00:00Z
//! expire_time = 2026-03-01T00:00:00Z  # left out: until it is revoked
//! revoked = false
//!
//! [[issuer]]                          # of signed tokens (JWT)
//! iss = "https://login.example"
//! aud = "frontalis"
//! algorithm = "EdDSA"                 # or ES256, RS256
//! public_key = """-----BEGIN PUBLIC KEY-----..."""
//! roles = ["publisher", "renderer"]   # left out: all but operator
//!
//! [[certificate]]                     # of clients, when the server asks for them
//! common_name = "renderer-1"          # or the whole subject: subject = "O=Stage, CN=renderer-1"
//! role = "renderer"
//! sessions = ["*"]
//! ```
//!
//! Reading is strict: an unknown key, a role that is none, a hash of another form are refused, with their place.

use subtle::{Choice, ConditionallySelectable as _};

use crate::{
    CertificateRule, Issuer, MAX_PRESENTED_BYTES, NoEntropy, Principal, Refused, Role, Scope,
    Token, TokenHash, UnixTime, certificate, issuer,
    principal::{Proof, is_shown_as_written},
    scope::is_id,
    token::random,
};

mod change;
mod text;

pub use change::TokenFileChange;
pub use text::TokenFileError;

/// Most tokens of a file; each is compared with what a caller presents.
pub const MAX_TOKENS: usize = 1_024;
/// Longest name of a token, characters.
const MAX_NAME: usize = 64;

/// Who may come. Empty: nobody.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TokenFile {
    tokens: Vec<TokenRecord>,
    issuers: Vec<Issuer>,
    certificates: Vec<CertificateRule>,
}

/// A `[[token]]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TokenRecord {
    /// Unique in the file; not secret.
    pub id: String,
    /// For people.
    pub name: String,
    /// What its holder is.
    pub role: Role,
    /// Where; all sessions for an operator.
    pub scope: Scope,
    /// Whether an operator may read raw images.
    pub images: bool,
    /// Of the token itself.
    pub hash: TokenHash,
    /// When it was made.
    pub create_time: UnixTime,
    /// When it stops to hold; none: never.
    pub expire_time: Option<UnixTime>,
    /// Taken back.
    pub revoked: bool,
}

/// A token to be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NewToken {
    /// Unique in the file, `[a-z0-9][a-z0-9_-]{0,62}`; none: one is made.
    pub id: Option<String>,
    /// For people.
    pub name: String,
    /// What its holder shall be.
    pub role: Role,
    /// Where; must be all sessions for an operator.
    pub scope: Scope,
    /// Whether an operator may read raw images.
    pub images: bool,
    /// When it shall stop to hold; none: never.
    pub expire_time: Option<UnixTime>,
}

/// Why a token is not made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CreateError {
    /// The id is of another form.
    #[error("a token id is 1 to 63 of a-z, 0-9, _ and -, starting with a letter or a digit")]
    Id,
    /// The id is in use.
    #[error("there is a token of this id")]
    Exists,
    /// The name is too long, or would steer a terminal.
    #[error("a token's name has 1 to {MAX_NAME} characters, none of them a control character")]
    Name,
    /// An operator's scope is everything.
    #[error("an operator has every session; only the scope \"*\" says so")]
    OperatorScope,
    /// Only an operator can have it.
    #[error("only an operator's token can have images")]
    Images,
    /// It would be dead at once.
    #[error("the token would expire at {at}, which has passed")]
    Expired {
        /// When.
        at: UnixTime,
    },
    /// The file is full.
    #[error("the file has {MAX_TOKENS} tokens, the most it may have; remove revoked ones")]
    Full,
    /// No randomness.
    #[error(transparent)]
    NoEntropy(#[from] NoEntropy),
}

/// No token has this id.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no token of this id")]
pub struct NoSuchToken;

impl NewToken {
    /// A token without images or expiry, whose id is made.
    pub fn new(name: &str, role: Role, scope: Scope) -> Self {
        Self {
            id: None,
            name: name.to_owned(),
            role,
            scope,
            images: false,
            expire_time: None,
        }
    }
}

impl TokenFile {
    /// Reads a file.
    ///
    /// # Errors
    ///
    /// [`TokenFileError`] says what is wrong, and where.
    pub fn parse(text: &str) -> Result<Self, TokenFileError> {
        text::parse(text)
    }

    /// The file as text; [`Self::parse`] reads the same back. Comments of a file that was read are not kept.
    pub fn to_toml(&self) -> String {
        text::print(self)
    }

    /// The tokens, in the order of the file.
    pub fn tokens(&self) -> &[TokenRecord] {
        &self.tokens
    }

    /// The issuers of signed tokens.
    pub fn issuers(&self) -> &[Issuer] {
        &self.issuers
    }

    /// The rules for client certificates.
    pub fn certificates(&self) -> &[CertificateRule] {
        &self.certificates
    }

    /// Whether nobody can come.
    pub fn is_empty(&self) -> bool {
        self.tokens.is_empty() && self.issuers.is_empty() && self.certificates.is_empty()
    }

    /// Makes a token and keeps its hash. The token itself is only in the answer.
    ///
    /// # Errors
    ///
    /// [`CreateError`]; then the file is as it was.
    pub fn create(&mut self, new: NewToken, now: UnixTime) -> Result<Token, CreateError> {
        let token = Token::generate()?;
        self.add(new, &token, now)?;
        Ok(token)
    }

    /// Keeps the hash of a token that was made elsewhere; its record.
    ///
    /// # Errors
    ///
    /// [`CreateError`]; then the file is as it was.
    pub fn add(
        &mut self,
        new: NewToken,
        token: &Token,
        now: UnixTime,
    ) -> Result<&TokenRecord, CreateError> {
        if self.tokens.len() >= MAX_TOKENS {
            return Err(CreateError::Full);
        }
        if let Some(at) = new.expire_time.filter(|at| *at <= now) {
            return Err(CreateError::Expired { at });
        }
        let id = match new.id {
            Some(id) => id,
            None => made_id()?,
        };
        let record = TokenRecord {
            id,
            name: new.name,
            role: new.role,
            scope: new.scope,
            images: new.images,
            hash: token.hash(),
            create_time: now,
            expire_time: new.expire_time,
            revoked: false,
        };
        self.push(record)?;
        Ok(&self.tokens[self.tokens.len() - 1])
    }

    /// Takes a token back. Its entry stays, so that the log's ids keep their meaning; a second time is as good as once.
    ///
    /// # Errors
    ///
    /// [`NoSuchToken`].
    pub fn revoke(&mut self, id: &str) -> Result<&TokenRecord, NoSuchToken> {
        let record = self.tokens.iter_mut().find(|it| it.id == id);
        let record = record.ok_or(NoSuchToken)?;
        record.revoked = true;
        Ok(record)
    }

    /// Removes a token's entry.
    ///
    /// # Errors
    ///
    /// [`NoSuchToken`].
    pub fn remove(&mut self, id: &str) -> Result<TokenRecord, NoSuchToken> {
        let idx = self.tokens.iter().position(|it| it.id == id);
        Ok(self.tokens.remove(idx.ok_or(NoSuchToken)?))
    }

    /// The token of this id.
    pub fn token(&self, id: &str) -> Option<&TokenRecord> {
        self.tokens.iter().find(|it| it.id == id)
    }

    /// Who presents this token: one of the file, or a signed one of its issuers.
    ///
    /// A hash is made and compared with every token of the file, all of them whatever is presented.
    ///
    /// # Errors
    ///
    /// [`Refused`], which a caller is told nothing more of.
    pub fn authenticate(&self, presented: &[u8], now: UnixTime) -> Result<Principal, Refused> {
        let record = self.find(&TokenHash::of(presented));
        if presented.len() > MAX_PRESENTED_BYTES {
            return Err(Refused::because("longer than any token"));
        }
        match record {
            Some(record) => record.principal(now),
            None => issuer::authenticate(&self.issuers, presented, now),
        }
    }

    /// Who has this client certificate (DER), of which the handshake has verified the chain.
    ///
    /// # Errors
    ///
    /// [`Refused`] when it expired or its subject has no role.
    pub fn authenticate_certificate(
        &self,
        der: &[u8],
        now: UnixTime,
    ) -> Result<Principal, Refused> {
        certificate::authenticate(&self.certificates, der, now)
    }

    /// Whether what proved `principal` once still does, with the same rights: not expired, not revoked, not changed.
    pub fn still_stands(&self, principal: &Principal, now: UnixTime) -> bool {
        if principal.expire_time.is_some_and(|at| at <= now) {
            return false;
        }
        match &principal.proof {
            Proof::Token { hash } => self
                .find(hash)
                .is_some_and(|it| it.principal(now).as_ref() == Ok(principal)),
            Proof::Issuer { iss, key } => self
                .issuers
                .iter()
                .any(|it| it.signed(iss, key) && it.roles.contains(&principal.role)),
            Proof::Certificate { subject } => self.certificates.iter().any(|it| {
                it.subject == *subject
                    && (it.role, &it.scope, it.images)
                        == (principal.role, &principal.scope, principal.images)
            }),
        }
    }

    /// In the same time wherever the token is, or is not.
    fn find(&self, hash: &TokenHash) -> Option<&TokenRecord> {
        let (mut found, mut at) = (Choice::from(0), 0_u64);
        for (idx, record) in (0_u64..).zip(&self.tokens) {
            let same = record.hash.is(hash);
            at.conditional_assign(&idx, same);
            found |= same;
        }
        let idx = usize::try_from(at).ok()?;
        bool::from(found).then(|| self.tokens.get(idx)).flatten()
    }

    /// Adds a record that keeps the rules of the file.
    fn push(&mut self, record: TokenRecord) -> Result<(), CreateError> {
        if !is_id(&record.id) {
            return Err(CreateError::Id);
        }
        if self.token(&record.id).is_some() || bool::from(self.has(&record.hash)) {
            return Err(CreateError::Exists);
        }
        let n_characters = record.name.chars().count();
        if !(1..=MAX_NAME).contains(&n_characters) || !is_shown_as_written(&record.name) {
            return Err(CreateError::Name);
        }
        if record.role == Role::Operator && !record.scope.is_all() {
            return Err(CreateError::OperatorScope);
        }
        if record.images && record.role != Role::Operator {
            return Err(CreateError::Images);
        }
        self.tokens.push(record);
        Ok(())
    }

    fn has(&self, hash: &TokenHash) -> Choice {
        let all = self.tokens.iter().map(|it| it.hash.is(hash));
        all.fold(Choice::from(0), |found, same| found | same)
    }
}

impl TokenRecord {
    /// Whether it holds at this time.
    pub fn is_valid(&self, now: UnixTime) -> bool {
        !self.revoked && self.expire_time.is_none_or(|at| at > now)
    }

    fn principal(&self, now: UnixTime) -> Result<Principal, Refused> {
        if !self.is_valid(now) {
            let why = if self.revoked {
                "the token is revoked"
            } else {
                "the token expired"
            };
            return Err(Refused {
                token_id: Some(self.id.clone()),
                why,
            });
        }
        Ok(Principal {
            key: format!("token:{}", self.id),
            name: self.name.clone(),
            role: self.role,
            scope: self.scope.clone(),
            images: self.images,
            expire_time: self.expire_time,
            proof: Proof::Token { hash: self.hash },
        })
    }
}

fn made_id() -> Result<String, NoEntropy> {
    let number = u32::from_be_bytes(random::<4>()?);
    Ok(format!("t-{number:08x}"))
}

#[cfg(test)]
mod tests;
