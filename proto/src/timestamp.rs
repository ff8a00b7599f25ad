//! `google.protobuf.Timestamp` with its JSON form: RFC 3339 in UTC, ending in `Z`.

use std::fmt;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

/// A moment, whatever the time zone.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, prost::Message)]
pub struct Timestamp {
    /// Seconds since 1970-01-01T00:00:00Z; negative before.
    #[prost(int64, tag = "1")]
    pub seconds: i64,
    /// Nanoseconds after `seconds`, 0..999,999,999.
    #[prost(int32, tag = "2")]
    pub nanos: i32,
}

impl Timestamp {
    /// As text: `2026-11-22T16:59:09Z`, with as many digits of a second as it needs.
    pub fn to_rfc3339(self) -> String {
        let Self { seconds, nanos } = self;
        prost_types::Timestamp { seconds, nanos }.to_string()
    }
}

impl Serialize for Timestamp {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.to_rfc3339())
    }
}

impl<'de> Deserialize<'de> for Timestamp {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let read = text.parse::<prost_types::Timestamp>();
        let read = read.map_err(|_| D::Error::custom(Unreadable))?;
        Ok(Self {
            seconds: read.seconds,
            nanos: read.nanos,
        })
    }
}

/// What is said of a text that is no moment; the text itself is not repeated.
struct Unreadable;

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a timestamp is RFC 3339, such as 2026-11-22T16:59:09Z")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moment_ends_in_z_and_reads_back() {
        let moment = Timestamp {
            seconds: 1_795_366_749,
            nanos: 250_000_000,
        };
        let text = serde_json::to_string(&moment).unwrap_or_default();
        assert!(text.ends_with(".250Z\""), "{text}");
        assert_eq!(serde_json::from_str::<Timestamp>(&text).ok(), Some(moment));
    }

    #[test]
    fn another_zone_is_the_same_moment() {
        let read = |text: &str| serde_json::from_str::<Timestamp>(text).ok();
        let utc = read(r#""2026-11-22T16:59:09Z""#);
        assert!(utc.is_some());
        assert_eq!(read(r#""2026-11-22T18:59:09+02:00""#), utc);
        assert_eq!(read(r#""yesterday""#), None);
    }
}
