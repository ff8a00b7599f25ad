//! Whole numbers, however they are written: the mapping reads `3.0` and `3e0` where 3 is due, the parser does not.

use std::borrow::Cow;

/// Up to here every whole number is one that a double holds.
const MAX_WHOLE: f64 = 9_007_199_254_740_992.0;

/// The same JSON with whole numbers written as such; what is no JSON stays no JSON.
pub(super) fn whole(json: &[u8]) -> Cow<'_, [u8]> {
    let mut written: Vec<u8> = Vec::new();
    let mut n_taken = 0;
    let mut at = 0;
    while at < json.len() {
        let end = match json[at] {
            b'"' => at + string_len(&json[at..]),
            b'-' | b'0'..=b'9' => {
                let end = at + number_len(&json[at..]);
                if let Some(number) = as_whole(&json[at..end]) {
                    written.extend_from_slice(&json[n_taken..at]);
                    written.extend_from_slice(number.to_string().as_bytes());
                    n_taken = end;
                }
                end
            }
            _ => at + 1,
        };
        at = end;
    }
    if n_taken == 0 {
        return json.into();
    }
    written.extend_from_slice(&json[n_taken..]);
    written.into()
}

/// Of the text that begins here, its quotes included.
fn string_len(json: &[u8]) -> usize {
    let mut escaped = false;
    let end = json.iter().skip(1).position(|&byte| {
        let is_end = byte == b'"' && !escaped;
        escaped = byte == b'\\' && !escaped;
        is_end
    });
    end.map_or(json.len(), |it| it + 2)
}

fn number_len(json: &[u8]) -> usize {
    let belongs = |it: &u8| it.is_ascii_digit() || b"+-.eE".contains(it);
    json.iter()
        .position(|it| !belongs(it))
        .unwrap_or(json.len())
}

/// A number that is written with a fraction or an exponent and has neither. The sign of a zero is kept.
#[expect(
    clippy::cast_possible_truncation,
    reason = "whole and within what both types hold"
)]
fn as_whole(text: &[u8]) -> Option<i64> {
    if !text.iter().any(|it| b".eE".contains(it)) {
        return None;
    }
    // What Rust reads beyond JSON, such as `1.`, must stay refused.
    let number: f64 = serde_json::from_slice(text).ok()?;
    let is_whole = number.fract() == 0.0 && number.abs() <= MAX_WHOLE;
    let is_negative_zero = number == 0.0 && number.is_sign_negative();
    (is_whole && !is_negative_zero).then_some(number as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(json: &str, expected: &str) {
        let found = whole(json.as_bytes());
        assert_eq!(std::str::from_utf8(&found), Ok(expected));
    }

    #[test]
    fn whole_numbers_are_written_as_such() {
        check(r#"{"a":3.0,"b":[4e2,-1.50E1]}"#, r#"{"a":3,"b":[400,-15]}"#);
        check("9007199254740992.0", "9007199254740992");
    }

    #[test]
    fn everything_else_stays() {
        let rest = [
            r#"{"a":"3.0","b\"1.0":0.5}"#,
            "[-0.0,1e400,1e300,1.,.5,3,18446744073709551615]",
            r#"["1.0"#,
            r#"["\\",1.5,"\"2.0"]"#,
            "",
            "-",
        ];
        for json in rest {
            check(json, json);
        }
    }
}
