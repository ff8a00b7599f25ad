//! Who may do what: roles, session scopes, tokens, and the file they are kept in (CONTRACTS S-3 to S-5).
//!
//! Pure: no network, no async, no clock and no file; bytes and the time come in as arguments.
