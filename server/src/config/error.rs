//! Why a configuration is refused: each kind names the file, the variable or the key, and what would be taken.

use std::{net::SocketAddr, path::PathBuf};

/// Why a configuration is refused.
#[derive(Debug, thiserror::Error)]
pub enum ConfigError {
    /// The file cannot be read.
    #[error("the configuration file {} cannot be read", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        #[source]
        cause: std::io::Error,
    },
    /// The file is not TOML.
    #[error("the configuration file {} is not valid TOML", path.display())]
    Syntax {
        /// The file.
        path: PathBuf,
        /// What the parser says.
        #[source]
        cause: toml::de::Error,
    },
    /// A key is unknown or its value has another type.
    #[error("the configuration is refused")]
    Key(#[source] toml::de::Error),
    /// An environment variable names no key.
    #[error("the environment variable {name} names no configuration key")]
    UnknownVariable {
        /// Name of the variable.
        name: String,
    },
    /// An environment variable's value has another type than its key.
    #[error("the environment variable {name} must be {wanted}")]
    Variable {
        /// Name of the variable.
        name: String,
        /// The type of its key.
        wanted: &'static str,
    },
    /// A value is out of its range.
    #[error("{key} is {found}, it must be within {least}..={most}")]
    Range {
        /// The key.
        key: &'static str,
        /// Its value.
        found: u64,
        /// Smallest value.
        least: u64,
        /// Largest value.
        most: u64,
    },
    /// A bind that others can reach, without protection.
    #[error(
        "listen is {listen}: others can reach this address and there are {missing}; \
         give --tls-cert, --tls-key and --token-file, or --allow-insecure to accept that"
    )]
    Insecure {
        /// The address.
        listen: SocketAddr,
        /// What is not there.
        missing: &'static str,
    },
    /// One key is of no use without another.
    #[error("{given} is given, {missing} is not: both are needed")]
    Incomplete {
        /// The key that is there.
        given: &'static str,
        /// The key that is not.
        missing: &'static str,
    },
    /// A text is not what its key takes.
    #[error("{key} has {found:?}, it must be {wanted}")]
    Text {
        /// The key.
        key: &'static str,
        /// What it says.
        found: String,
        /// What is taken.
        wanted: &'static str,
    },
    /// The limits allow more memory than the budget.
    #[error(
        "the limits allow {needed_mib} MiB in the worst case, memory_budget_mib is {budget_mib}; \
         lower the limits or raise the budget"
    )]
    Memory {
        /// Worst case, MiB.
        needed_mib: u64,
        /// The budget, MiB.
        budget_mib: u64,
    },
}
