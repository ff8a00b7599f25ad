//! The audit log's chain of hashes (CONTRACTS S-12): each line holds the hash of the one before and its own, so that a
//! changed, removed or inserted line shows. A cut end does not; the server logs the newest hash at every start.

use std::io::{self, BufRead, Read as _};

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

/// What the first line says of the one before.
const BEGINNING: &str = "0000000000000000000000000000000000000000000000000000000000000000";

/// Longest line that is read, bytes; many times the longest that is written.
pub const MAX_LINE_BYTES: usize = 64 * 1024;

/// An entry: a line without its own hash.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AuditLine {
    /// From 1, without a hole; set when the line is appended.
    pub sequence: u64,
    /// When it was written, RFC 3339.
    pub time: String,
    /// What happened.
    pub event: String,
    /// Who did it: a principal's key, and its name in brackets.
    pub who: String,
    /// The door and the address it came from.
    pub from: String,
    /// What it was done to.
    pub object: String,
    /// What came of it: `ok`, or the reason of the refusal.
    pub result: String,
    /// Entries since the line before that were only counted.
    pub left_out: u64,
    /// Hash of the line before; set when the line is appended.
    pub previous: String,
}

impl AuditLine {
    /// Event of the line after one that was not written whole.
    pub const TORN: &str = "torn_line";
}

/// The end of a chain, to which the next line is joined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChainEnd {
    /// Of the newest line; 0 before the first.
    pub sequence: u64,
    /// Of the newest line.
    pub hash: String,
}

impl Default for ChainEnd {
    fn default() -> Self {
        Self {
            sequence: 0,
            hash: BEGINNING.to_owned(),
        }
    }
}

impl ChainEnd {
    /// The text of the next line, with its line feed; the end moves on to it.
    ///
    /// # Panics
    ///
    /// Never: texts and numbers can be written as JSON.
    pub fn append(&mut self, mut line: AuditLine) -> String {
        line.sequence = self.sequence + 1;
        line.previous.clone_from(&self.hash);
        let body = serde_json::to_string(&line)
            .expect("invariant: texts and numbers can be written as JSON");
        let hash = hash_of(&body);
        let open = body.strip_suffix('}').unwrap_or(&body);
        let text = format!("{open},\"hash\":\"{hash}\"}}\n");
        *self = Self {
            sequence: line.sequence,
            hash,
        };
        text
    }

    /// The end that a line makes by itself, when it fits its own hash.
    pub fn of_line(text: &str) -> Option<Self> {
        read(text).map(|it| it.0)
    }

    /// The end after this line, if it was written after this end.
    fn after(&self, text: &str) -> Option<(Self, AuditLine)> {
        let (end, line) = read(text)?;
        let fits = line.previous == self.hash && end.sequence == self.sequence + 1;
        fits.then_some((end, line))
    }
}

/// A line that fits its own hash.
fn read(text: &str) -> Option<(ChainEnd, AuditLine)> {
    let (open, hash) = text.strip_suffix("\"}")?.rsplit_once(",\"hash\":\"")?;
    let body = format!("{open}}}");
    if hash_of(&body) != hash {
        return None;
    }
    let line: AuditLine = serde_json::from_str(&body).ok()?;
    let end = ChainEnd {
        sequence: line.sequence,
        hash: hash.to_owned(),
    };
    Some((end, line))
}

/// What a whole log turned out to be.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ChainReport {
    /// Lines of the log, whatever they are.
    pub n_lines: u64,
    /// The first line that is not the one that was written, or before which one is missing, counted from 1.
    pub first_broken: Option<u64>,
    /// The newest entry before that.
    pub end: ChainEnd,
}

/// Checks a whole log, one line in memory at a time.
///
/// A line that was not written whole, as after a power cut, is allowed where the next line says so.
///
/// # Errors
///
/// As reading gives them; a broken chain is no error but in the report.
pub fn verify_chain(mut log: impl BufRead) -> io::Result<ChainReport> {
    let mut checked = Checked::default();
    let (mut number, mut line) = (0, Vec::new());
    while read_line(&mut log, &mut line)? {
        number += 1;
        checked.take(number, &line);
    }
    Ok(checked.finish())
}

/// A line without its line feed; what is longer than any line comes in pieces. False at the end of the log.
fn read_line(log: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<bool> {
    line.clear();
    let n_read = log.take(MAX_LINE_BYTES as u64).read_until(b'\n', line)?;
    if line.last() == Some(&b'\n') {
        line.pop();
    }
    Ok(n_read > 0)
}

/// A log as far as it was read.
#[derive(Default)]
struct Checked {
    report: ChainReport,
    /// A line that fits nothing; the next may say that it was not written whole.
    torn_at: Option<u64>,
}

impl Checked {
    fn take(&mut self, number: u64, line: &[u8]) {
        let report = &mut self.report;
        report.n_lines = number;
        if line.is_empty() || report.first_broken.is_some() {
            return;
        }
        let line = std::str::from_utf8(line).ok();
        let after = line.and_then(|it| report.end.after(it));
        match (after, self.torn_at) {
            (Some((end, line)), at) if at.is_none() || line.event == AuditLine::TORN => {
                report.end = end;
                self.torn_at = None;
            }
            (None, None) => self.torn_at = Some(number),
            (_, at) => report.first_broken = at.or(Some(number)),
        }
    }

    fn finish(self) -> ChainReport {
        let mut report = self.report;
        report.first_broken = report.first_broken.or(self.torn_at);
        report
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

    fn line(event: &str) -> AuditLine {
        AuditLine {
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
        let mut end = ChainEnd::default();
        events.iter().map(|it| end.append(line(it))).collect()
    }

    fn first_broken(log: impl AsRef<[u8]>) -> Option<u64> {
        verify_chain(log.as_ref()).unwrap().first_broken
    }

    #[test]
    fn a_log_verifies_and_every_changed_letter_is_found_in_its_line() {
        let text = log(&["a", "b", "c"]);
        let report = verify_chain(text.as_bytes()).unwrap();
        let last = text.lines().last().unwrap();
        assert_eq!((report.n_lines, report.first_broken), (3, None));
        assert_eq!(Some(report.end), ChainEnd::of_line(last));
        assert_eq!(verify_chain(&b""[..]).unwrap(), ChainReport::default());
        for at in (0..text.len()).filter(|at| !text[*at..].starts_with('\n')) {
            let mut bytes = text.clone().into_bytes();
            bytes[at] = if bytes[at] == b'0' { b'1' } else { b'0' };
            let line = text[..at].matches('\n').count() as u64 + 1;
            let report = verify_chain(&bytes[..]).unwrap();
            assert_eq!(report.first_broken, Some(line), "letter {at}");
            assert_eq!(report.end.sequence, line - 1, "letter {at}");
            assert_eq!(report.n_lines, 3, "letter {at}");
        }
    }

    #[test]
    fn lines_that_changed_places_or_are_missing_are_found() {
        let text = log(&["a", "b", "c"]);
        let [a, b, c]: [&str; 3] = text.lines().collect::<Vec<_>>().try_into().unwrap();
        for (lines, line) in [([a, c, b], 2), ([b, a, c], 1), ([a, a, b], 2)] {
            assert_eq!(first_broken(lines.join("\n")), Some(line));
        }
        assert_eq!(first_broken([a, c].join("\n")), Some(2));
    }

    #[test]
    fn half_a_line_is_allowed_only_where_the_next_says_so() {
        let mut end = ChainEnd::default();
        let first = end.append(line("a"));
        let half = "{\"sequence\":2,\"ti\n";
        let honest = end.clone().append(line(AuditLine::TORN));
        let silent = end.append(line("b"));
        let report = verify_chain(format!("{first}{half}{honest}").as_bytes()).unwrap();
        assert_eq!((report.first_broken, report.end.sequence), (None, 2));
        assert_eq!(first_broken(format!("{first}{half}{silent}")), Some(2));
        assert_eq!(first_broken(format!("{first}{half}")), Some(2));
    }

    #[test]
    fn what_is_no_text_or_longer_than_any_line_is_broken_and_read_in_bounded_memory() {
        let first = log(&["a"]);
        assert_eq!(
            first_broken([first.as_bytes(), b"\xff\n"].concat()),
            Some(2)
        );
        let long = vec![b'x'; 3 * MAX_LINE_BYTES];
        assert_eq!(first_broken([first.as_bytes(), &long].concat()), Some(2));
    }
}
