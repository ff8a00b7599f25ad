//! The chain of hashes: each line holds the hash of the one before and its own, so that a changed, removed or inserted
//! line shows. A cut end does not; the newest hash is in the server's log at every start.

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

/// What the first line says of the one before.
pub(super) const BEGINNING: &str =
    "0000000000000000000000000000000000000000000000000000000000000000";

/// Event of the line after one that was not written whole.
pub(super) const TORN: &str = "torn_line";

/// A line without its own hash.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Line {
    pub(super) sequence: u64,
    pub(super) time: String,
    pub(super) event: String,
    pub(super) who: String,
    pub(super) from: String,
    pub(super) object: String,
    pub(super) result: String,
    /// Entries since the line before that were only counted.
    pub(super) left_out: u64,
    pub(super) previous: String,
}

/// The end of a chain, to which the next line is joined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Tail {
    pub(super) sequence: u64,
    pub(super) hash: String,
}

/// Where a log is not what was written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line} is not the one that was written, or one before it is missing")]
pub struct ChainError {
    /// The first line that does not fit, counted from 1.
    pub line: usize,
}

impl Default for Tail {
    fn default() -> Self {
        Self {
            sequence: 0,
            hash: BEGINNING.to_owned(),
        }
    }
}

impl Tail {
    /// The text of the next line, with its end; the tail moves on to it.
    pub(super) fn append(&mut self, mut line: Line) -> String {
        line.sequence = self.sequence + 1;
        line.previous.clone_from(&self.hash);
        let body = serde_json::to_string(&line).expect("invariant: a line is texts and numbers");
        let hash = hash_of(&body);
        let open = body.strip_suffix('}').unwrap_or(&body);
        let text = format!("{open},\"hash\":\"{hash}\"}}\n");
        *self = Self {
            sequence: line.sequence,
            hash,
        };
        text
    }

    /// The tail after this line, if it was written after this tail.
    fn after(&self, text: &str) -> Option<(Self, Line)> {
        let (tail, line) = read(text)?;
        let fits = line.previous == self.hash && tail.sequence == self.sequence + 1;
        fits.then_some((tail, line))
    }
}

/// A line that fits its own hash.
pub(super) fn read(text: &str) -> Option<(Tail, Line)> {
    let (open, hash) = text.strip_suffix("\"}")?.rsplit_once(",\"hash\":\"")?;
    let body = format!("{open}}}");
    if hash_of(&body) != hash {
        return None;
    }
    let line: Line = serde_json::from_str(&body).ok()?;
    let tail = Tail {
        sequence: line.sequence,
        hash: hash.to_owned(),
    };
    Some((tail, line))
}

/// Checks a whole log; how many entries it has.
///
/// A line that was not written whole, as after a power cut, is allowed where the next line says so.
///
/// # Errors
///
/// [`ChainError`] names the first line that is not as it was written.
pub fn verify(text: &str) -> Result<u64, ChainError> {
    let mut tail = Tail::default();
    let mut torn_at = None;
    let lines = text.lines().enumerate();
    for (idx, line) in lines.filter(|it| !it.1.is_empty()) {
        let number = idx + 1;
        match (tail.after(line), torn_at) {
            (Some((next, read)), _) if torn_at.is_none() || read.event == TORN => {
                tail = next;
                torn_at = None;
            }
            (None, None) => torn_at = Some(number),
            (_, at) => {
                return Err(ChainError {
                    line: at.unwrap_or(number),
                });
            }
        }
    }
    match torn_at {
        Some(line) => Err(ChainError { line }),
        None => Ok(tail.sequence),
    }
}

fn hash_of(body: &str) -> String {
    use std::fmt::Write as _;
    let mut text = String::with_capacity(64);
    for byte in Sha256::digest(body.as_bytes()) {
        write!(text, "{byte:02x}").expect("invariant: a String takes every write");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(event: &str) -> Line {
        Line {
            sequence: 0,
            time: "2027-01-15T08:00:00Z".to_owned(),
            event: event.to_owned(),
            who: "token:t-1 (Stage \"A\", {x}\u{1b}[31m)".to_owned(),
            from: "grpc 127.0.0.1:9".to_owned(),
            object: "sessions/s".to_owned(),
            result: "ok".to_owned(),
            left_out: 0,
            previous: String::new(),
        }
    }

    fn log(events: &[&str]) -> String {
        let mut tail = Tail::default();
        events.iter().map(|it| tail.append(line(it))).collect()
    }

    #[test]
    fn a_log_verifies_and_every_changed_letter_is_found_in_its_line() {
        let text = log(&["a", "b", "c"]);
        assert_eq!(verify(&text), Ok(3));
        assert_eq!(verify(""), Ok(0));
        for at in (0..text.len()).filter(|at| !text[*at..].starts_with('\n')) {
            let mut bytes = text.clone().into_bytes();
            bytes[at] = if bytes[at] == b'0' { b'1' } else { b'0' };
            let changed = String::from_utf8_lossy(&bytes).into_owned();
            let line = text[..at].matches('\n').count() + 1;
            assert_eq!(verify(&changed), Err(ChainError { line }), "letter {at}");
        }
    }

    #[test]
    fn lines_that_changed_places_or_are_missing_are_found() {
        let text = log(&["a", "b", "c"]);
        let [a, b, c]: [&str; 3] = text.lines().collect::<Vec<_>>().try_into().unwrap();
        for (lines, line) in [([a, c, b], 2), ([b, a, c], 1), ([a, a, b], 2)] {
            assert_eq!(verify(&lines.join("\n")), Err(ChainError { line }));
        }
        assert_eq!(verify(&[a, c].join("\n")), Err(ChainError { line: 2 }));
    }

    #[test]
    fn half_a_line_is_allowed_only_where_the_next_says_so() {
        let mut tail = Tail::default();
        let first = tail.append(line("a"));
        let half = "{\"sequence\":2,\"ti\n";
        let honest = tail.clone().append(line(TORN));
        let silent = tail.append(line("b"));
        assert_eq!(verify(&format!("{first}{half}{honest}")), Ok(2));
        let silent = format!("{first}{half}{silent}");
        assert_eq!(verify(&silent), Err(ChainError { line: 2 }));
        assert_eq!(
            verify(&format!("{first}{half}")),
            Err(ChainError { line: 2 })
        );
    }
}
