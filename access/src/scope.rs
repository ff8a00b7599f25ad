//! Which sessions a caller may touch: exact ids, prefixes that end with `*`, or `*` for all (CONTRACTS S-5).

use std::{fmt, str::FromStr};

/// Most entries of one scope.
const MAX_ENTRIES: usize = 64;
/// Longest session id, bytes (CONTRACTS S-6).
const MAX_ID_BYTES: usize = 63;

/// A set of session ids. Never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scope(Vec<Pattern>);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Pattern {
    Id(String),
    /// Empty: every id.
    Prefix(String),
}

/// Why a scope is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ScopeError {
    /// It names nothing.
    #[error("a scope names at least one session id or prefix; \"*\" is all of them")]
    Empty,
    /// It names too much.
    #[error("a scope has {found} entries, at most {MAX_ENTRIES} are taken")]
    TooMany {
        /// How many it has.
        found: usize,
    },
    /// An entry that no session can match.
    #[error(
        "entry {number} is no session id and no prefix: 1 to 63 of a-z, 0-9, _ and -, starting with a letter or a \
         digit, and for a prefix a * at the end"
    )]
    Entry {
        /// Which, counted from 1.
        number: usize,
    },
}

impl Scope {
    /// Every session.
    pub fn all() -> Self {
        Self(vec![Pattern::Prefix(String::new())])
    }

    /// From its entries.
    ///
    /// # Errors
    ///
    /// [`ScopeError`] when there are none, too many, or one that is neither an id nor a prefix.
    pub fn new<T: AsRef<str>>(entries: &[T]) -> Result<Self, ScopeError> {
        match entries.len() {
            0 => return Err(ScopeError::Empty),
            found if found > MAX_ENTRIES => return Err(ScopeError::TooMany { found }),
            _ => {}
        }
        let numbered = entries.iter().enumerate();
        let patterns = numbered.map(|(idx, entry)| {
            Pattern::parse(entry.as_ref()).ok_or(ScopeError::Entry { number: idx + 1 })
        });
        Ok(Self(patterns.collect::<Result<_, _>>()?))
    }

    /// Whether the session of this id is in it.
    pub fn contains(&self, session_id: &str) -> bool {
        self.0.iter().any(|it| it.matches(session_id))
    }

    /// Whether every session is in it.
    pub fn is_all(&self) -> bool {
        self.contains_prefix("")
    }

    /// The prefix in which a session that has no id yet can be made: the only one there is, not `*`.
    pub fn only_prefix(&self) -> Option<&str> {
        let mut prefixes = self.0.iter().filter_map(Pattern::prefix);
        match (prefixes.next(), prefixes.next()) {
            (Some(prefix), None) => Some(prefix),
            _ => None,
        }
    }

    /// The entries as they are written.
    pub fn entries(&self) -> Vec<String> {
        self.0.iter().map(ToString::to_string).collect()
    }

    fn contains_prefix(&self, prefix: &str) -> bool {
        let mut prefixes = self.0.iter().filter_map(Pattern::prefix);
        prefixes.any(|it| prefix.starts_with(it))
    }
}

/// Entries separated by commas or spaces, as a command line gives them.
impl FromStr for Scope {
    type Err = ScopeError;

    fn from_str(text: &str) -> Result<Self, ScopeError> {
        let entries: Vec<&str> = text
            .split([',', ' '])
            .filter(|it| !it.is_empty())
            .take(MAX_ENTRIES + 1)
            .collect();
        Self::new(&entries)
    }
}

/// Entries separated by commas.
impl fmt::Display for Scope {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.entries().join(","))
    }
}

impl Pattern {
    fn parse(text: &str) -> Option<Self> {
        if let Some(prefix) = text.strip_suffix('*') {
            let fits = prefix.is_empty() || is_id(prefix);
            return fits.then(|| Self::Prefix(prefix.to_owned()));
        }
        is_id(text).then(|| Self::Id(text.to_owned()))
    }

    fn matches(&self, session_id: &str) -> bool {
        match self {
            Self::Id(id) => id == session_id,
            Self::Prefix(prefix) => session_id.starts_with(prefix),
        }
    }

    fn prefix(&self) -> Option<&str> {
        match self {
            Self::Id(_) => None,
            Self::Prefix(prefix) => Some(prefix),
        }
    }
}

impl fmt::Display for Pattern {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Id(id) => formatter.write_str(id),
            Self::Prefix(prefix) => write!(formatter, "{prefix}*"),
        }
    }
}

/// The grammar of CONTRACTS S-6, which a token's id follows too.
pub(crate) fn is_id(text: &str) -> bool {
    let plain = |byte: &u8| byte.is_ascii_lowercase() || byte.is_ascii_digit();
    let bytes = text.as_bytes();
    bytes.len() <= MAX_ID_BYTES
        && bytes.first().is_some_and(plain)
        && bytes
            .iter()
            .all(|byte| plain(byte) || matches!(byte, b'_' | b'-'))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn an_id_matches_itself_alone_and_a_prefix_what_starts_with_it() {
        let scope: Scope = "stage-a-*,demo".parse().unwrap();
        for inside in ["stage-a-", "stage-a-1", "demo"] {
            assert!(scope.contains(inside), "{inside}");
        }
        for outside in ["stage-a", "stage-b-1", "demo2", "dem", ""] {
            assert!(!scope.contains(outside), "{outside}");
        }
        assert_eq!(scope.only_prefix(), Some("stage-a-"));
        assert!(!scope.is_all());
    }

    #[test]
    fn a_star_is_every_session_and_two_prefixes_leave_no_choice() {
        assert!(Scope::all().contains("anything"));
        assert!(Scope::all().is_all());
        assert_eq!(Scope::all().only_prefix(), Some(""));
        let two: Scope = "a-* b-*".parse().unwrap();
        assert_eq!(two.only_prefix(), None);
    }

    #[test]
    fn what_no_session_can_be_called_is_refused_by_its_place() {
        for entry in ["**", "a*b", "A", "a/b", "-a", "-*", "\u{1b}[31m", "ä"] {
            let refused = Scope::new(&["fine", entry]);
            assert_eq!(refused, Err(ScopeError::Entry { number: 2 }), "{entry}");
        }
        assert_eq!("".parse::<Scope>(), Err(ScopeError::Empty));
        let found = MAX_ENTRIES + 1;
        assert_eq!(
            Scope::new(&vec!["a"; found]),
            Err(ScopeError::TooMany { found })
        );
    }

    proptest! {
        #[test]
        fn a_scope_reads_back_from_what_it_prints(
            entries in proptest::collection::vec("[a-z0-9][a-z0-9_-]{0,20}\\*?", 1..8),
            id in "[a-z0-9][a-z0-9_-]{0,8}",
        ) {
            let scope = Scope::new(&entries).unwrap();
            let back: Scope = scope.to_string().parse().unwrap();
            prop_assert_eq!(&back, &scope);
            let expected = entries.iter().any(|it| match it.strip_suffix('*') {
                Some(prefix) => id.starts_with(prefix),
                None => *it == id,
            });
            prop_assert_eq!(scope.contains(&id), expected);
        }
    }
}
