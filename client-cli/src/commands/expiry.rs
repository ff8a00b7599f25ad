//! When a token stops to hold, as a person types it: after some time, or at a moment.

use std::{str::FromStr, time::Duration};

use frontalis_access::UnixTime;

/// A time from now, or a moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expiry {
    After(Duration),
    At(UnixTime),
}

/// A text that says no time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a time is written like 30m, 12h, 90d or 2027-01-31T18:00:00Z")]
pub struct NotATime;

impl Expiry {
    /// The moment, seen from now.
    pub fn at(self, now: UnixTime) -> UnixTime {
        match self {
            Self::After(delay) => now.after(delay),
            Self::At(moment) => moment,
        }
    }
}

impl FromStr for Expiry {
    type Err = NotATime;

    fn from_str(text: &str) -> Result<Self, NotATime> {
        if let Ok(moment) = text.parse() {
            return Ok(Self::At(moment));
        }
        let unit_secs: u64 = match text.chars().last() {
            Some('m') => 60,
            Some('h') => 3_600,
            Some('d') => 86_400,
            _ => return Err(NotATime),
        };
        let number = &text[..text.len() - 1];
        if !number.bytes().all(|it| it.is_ascii_digit()) {
            return Err(NotATime);
        }
        let number: u64 = number.parse().map_err(|_| NotATime)?;
        let secs = number.checked_mul(unit_secs).filter(|it| *it > 0);
        Ok(Self::After(Duration::from_secs(secs.ok_or(NotATime)?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_has_a_unit_or_is_a_moment() {
        let secs = |text: &str| match text.parse() {
            Ok(Expiry::After(it)) => Some(it.as_secs()),
            _ => None,
        };
        assert_eq!(secs("30m"), Some(1_800));
        assert_eq!(secs("12h"), Some(43_200));
        assert_eq!(secs("90d"), Some(7_776_000));
        let moment = "2027-01-15T08:00:00Z".parse::<Expiry>().unwrap();
        assert_eq!(moment, Expiry::At(UnixTime::from_secs(1_800_000_000)));
        for text in [
            "",
            "90",
            "d",
            "0d",
            "-1d",
            "+1d",
            "1.5d",
            "1y",
            "99999999999999999999d",
            "1ü",
        ] {
            assert_eq!(text.parse::<Expiry>(), Err(NotATime), "{text}");
        }
    }
}
