//! Whole seconds of Unix time, written as RFC 3339.

use std::{
    fmt,
    str::FromStr,
    time::{Duration, SystemTime, UNIX_EPOCH},
};

use time::{OffsetDateTime, format_description::well_known::Rfc3339};

/// The end of the year 9999, the last that RFC 3339 can say.
const LAST_SECS: i64 = 253_402_300_799;

/// A moment, to the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct UnixTime(i64);

/// A text that is no moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a time is written like 2026-01-31T18:00:00Z, between 1970 and 9999")]
pub struct NotATime;

impl UnixTime {
    /// Seconds since 1970, held within the years 1970 to 9999.
    pub const fn from_secs(secs: i64) -> Self {
        match secs {
            ..0 => Self(0),
            0..=LAST_SECS => Self(secs),
            _ => Self(LAST_SECS),
        }
    }

    /// Seconds since 1970.
    pub fn secs(self) -> i64 {
        self.0
    }

    /// Later by this much.
    #[must_use]
    pub fn after(self, delay: Duration) -> Self {
        let secs = i64::try_from(delay.as_secs()).unwrap_or(i64::MAX);
        Self::from_secs(self.0.saturating_add(secs))
    }
}

impl From<SystemTime> for UnixTime {
    fn from(time: SystemTime) -> Self {
        let since = time.duration_since(UNIX_EPOCH).unwrap_or_default();
        Self::from_secs(0).after(since)
    }
}

impl fmt::Display for UnixTime {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let time = OffsetDateTime::from_unix_timestamp(self.0).map_err(|_| fmt::Error)?;
        formatter.write_str(&time.format(&Rfc3339).map_err(|_| fmt::Error)?)
    }
}

impl FromStr for UnixTime {
    type Err = NotATime;

    fn from_str(text: &str) -> Result<Self, NotATime> {
        let time = OffsetDateTime::parse(text, &Rfc3339).map_err(|_| NotATime)?;
        let secs = time.unix_timestamp();
        (0..=LAST_SECS)
            .contains(&secs)
            .then_some(Self(secs))
            .ok_or(NotATime)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn is_written_as_rfc_3339() {
        assert_eq!(
            UnixTime::from_secs(1_800_000_000).to_string(),
            "2027-01-15T08:00:00Z"
        );
        assert_eq!(
            "2027-01-15T09:00:00+01:00".parse(),
            Ok(UnixTime::from_secs(1_800_000_000))
        );
        for other in [
            "",
            "2027-01-15",
            "2027-01-15T08:00:00",
            "1969-12-31T23:59:59Z",
        ] {
            assert_eq!(other.parse::<UnixTime>(), Err(NotATime), "{other}");
        }
    }

    proptest! {
        #[test]
        fn reads_back(secs: i64) {
            let time = UnixTime::from_secs(secs);
            prop_assert_eq!(time.to_string().parse(), Ok(time));
        }
    }
}
