//! The four roles (CONTRACTS S-4).

use std::{fmt, str::FromStr};

/// What a caller is to the server.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// Everything, in every session.
    Operator,
    /// Its own sessions: create, publish, calibrate, subscribe, end.
    Publisher,
    /// The sessions granted to it: subscribe, read the actor.
    Renderer,
    /// The state of sessions.
    Viewer,
}

/// A word that names no role.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a role is operator, publisher, renderer or viewer")]
pub struct UnknownRole;

impl Role {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::Operator,
        Self::Publisher,
        Self::Renderer,
        Self::Viewer,
    ];

    /// As files and claims say it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Operator => "operator",
            Self::Publisher => "publisher",
            Self::Renderer => "renderer",
            Self::Viewer => "viewer",
        }
    }
}

impl fmt::Display for Role {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

impl FromStr for Role {
    type Err = UnknownRole;

    fn from_str(text: &str) -> Result<Self, UnknownRole> {
        let mut all = Self::ALL.into_iter();
        all.find(|it| it.name() == text).ok_or(UnknownRole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_role_reads_back_from_its_name() {
        for role in Role::ALL {
            assert_eq!(role.name().parse(), Ok(role));
        }
        for other in ["", "Operator", "admin", "operator "] {
            assert_eq!(other.parse::<Role>(), Err(UnknownRole));
        }
    }
}
