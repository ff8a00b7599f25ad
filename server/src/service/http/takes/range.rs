//! Which part of a file a client asks for (RFC 9110, section 14).

use std::ops::Range;

use axum::http::{HeaderMap, HeaderValue, header};

/// A range that cannot be had: none of the file, several, or no range at all (BAD_INPUT I6).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Unsatisfiable;

/// The bytes that are wanted of `n_bytes`; `None` is all of them.
///
/// A range holds under `If-Range` for the file of that tag alone. Units other than bytes are passed over.
pub(super) fn wanted(
    headers: &HeaderMap,
    tag: &str,
    n_bytes: u64,
) -> Result<Option<Range<u64>>, Unsatisfiable> {
    let mut ranges = headers.get_all(header::RANGE).into_iter();
    let Some(range) = ranges.next() else {
        return Ok(None);
    };
    let is_other = |it: &HeaderValue| it.as_bytes() != tag.as_bytes();
    if headers.get(header::IF_RANGE).is_some_and(is_other) {
        return Ok(None);
    }
    if ranges.next().is_some() {
        return Err(Unsatisfiable);
    }
    let range = range.to_str().map_err(|_| Unsatisfiable)?;
    match range.split_once('=') {
        Some((unit, range)) if unit.trim().eq_ignore_ascii_case("bytes") => {
            bytes(range, n_bytes).map(Some).ok_or(Unsatisfiable)
        }
        Some(_) => Ok(None),
        None => Err(Unsatisfiable),
    }
}

fn bytes(range: &str, n_bytes: u64) -> Option<Range<u64>> {
    let range = match range.trim().split_once('-')? {
        ("", n_last) => n_bytes.saturating_sub(number(n_last)?)..n_bytes,
        (first, "") => number(first)?..n_bytes,
        (first, last) => number(first)?..number(last)?.saturating_add(1).min(n_bytes),
    };
    (range.start < range.end).then_some(range)
}

/// Digits; more of them than a number holds are a number beyond every file.
fn number(digits: &str) -> Option<u64> {
    let is_number = !digits.is_empty() && digits.bytes().all(|it| it.is_ascii_digit());
    is_number.then(|| digits.parse().unwrap_or(u64::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TAG: &str = "\"a\"";

    fn of(range: &str) -> Result<Option<Range<u64>>, Unsatisfiable> {
        let mut headers = HeaderMap::new();
        headers.insert(header::RANGE, range.parse().unwrap());
        wanted(&headers, TAG, 1_000)
    }

    #[test]
    fn one_range_is_had_as_far_as_the_file_goes() {
        for (range, expected) in [
            ("bytes=0-0", 0..1),
            ("bytes=10-19", 10..20),
            ("bytes=990-", 990..1_000),
            ("bytes=-5", 995..1_000),
            ("bytes=-5000", 0..1_000),
            ("bytes=0-99999999999999999999999999", 0..1_000),
            ("BYTES= 5-6 ", 5..7),
        ] {
            assert_eq!(of(range), Ok(Some(expected)), "{range}");
        }
    }

    #[test]
    fn i6_bombs_and_nonsense_are_unsatisfiable() {
        let bomb = format!("bytes={}", "0-,".repeat(1_000));
        for range in [
            "bytes=1000-",
            "bytes=5-4",
            "bytes=-0",
            "bytes=-",
            "bytes=",
            "bytes",
            "bytes=0-1,2-3",
            "bytes=+1-2",
            "bytes=1-2-3",
            &bomb,
        ] {
            assert_eq!(of(range), Err(Unsatisfiable), "{range}");
        }
        let empty = wanted(&HeaderMap::new(), TAG, 0);
        assert_eq!(empty, Ok(None));
    }

    #[test]
    fn another_file_or_another_unit_is_had_whole() {
        assert_eq!(of("lines=1-2"), Ok(None));
        let mut headers = HeaderMap::new();
        headers.insert(header::RANGE, "bytes=0-1".parse().unwrap());
        for (if_range, expected) in [(TAG, Some(0..2)), ("\"b\"", None), ("W/\"a\"", None)] {
            headers.insert(header::IF_RANGE, if_range.parse().unwrap());
            assert_eq!(wanted(&headers, TAG, 9), Ok(expected), "{if_range}");
        }
        headers.remove(header::IF_RANGE);
        headers.append(header::RANGE, "bytes=3-4".parse().unwrap());
        assert_eq!(wanted(&headers, TAG, 9), Err(Unsatisfiable));
    }
}
