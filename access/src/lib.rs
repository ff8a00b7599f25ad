//! Who may do what: roles, session scopes, tokens, and the file they are kept in (CONTRACTS S-3 to S-5); and the form of
//! the log of who did what (S-12).
//!
//! Pure: no network, no async, no clock and no file; bytes and the time come in as arguments.
//! The only thing taken from the system is randomness, for new tokens.
//!
//! ```
//! use frontalis_access::{NewToken, Role, Scope, TokenFile, UnixTime};
//!
//! let now = UnixTime::from_secs(1_800_000_000);
//! let mut file = TokenFile::default();
//! let new = NewToken::new("Stage A", Role::Publisher, "stage-a-*".parse::<Scope>()?);
//! let token = file.create(new, now)?;
//!
//! let file = TokenFile::parse(&file.to_toml())?;
//! let principal = file.authenticate(token.reveal().as_bytes(), now)?;
//! assert_eq!(principal.role, Role::Publisher);
//! assert!(principal.scope.contains("stage-a-7"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod audit_chain;
mod certificate;
mod issuer;
mod principal;
mod role;
mod scope;
mod token;
mod token_file;
mod unix_time;

pub use audit_chain::{AuditLine, ChainEnd, ChainReport, verify_chain};
pub use certificate::{CertificateRule, CertificateSubject};
pub use issuer::{Algorithm, Issuer, KeyError};
pub use principal::{Principal, Refused};
pub use role::{Role, UnknownRole};
pub use scope::{Scope, ScopeError};
pub use token::{MAX_PRESENTED_BYTES, NoEntropy, Token, TokenHash};
pub use token_file::{
    CreateError, MAX_TOKENS, NewToken, NoSuchToken, TokenFile, TokenFileChange, TokenFileError,
    TokenRecord,
};
pub use unix_time::{NotATime, UnixTime};
