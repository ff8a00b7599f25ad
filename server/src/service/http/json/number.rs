//! Numbers however they are written: `13`, `13.0`, `1.3e1`, and each of them as text.

use prost::encoding as wire;
use prost_types::field_descriptor_proto::Type;

/// Up to here every whole number is one that a double holds.
const MAX_WHOLE: f64 = 9_007_199_254_740_992.0;

/// A number that was read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::service::http) enum Number {
    /// Written without fraction and exponent.
    Whole(i128),
    /// Any other.
    Real(f64),
}

impl Number {
    /// Reads a number that is written as text.
    pub(in crate::service::http) fn of_text(text: &str) -> Option<Self> {
        match text {
            "NaN" => return Some(Self::Real(f64::NAN)),
            "Infinity" => return Some(Self::Real(f64::INFINITY)),
            "-Infinity" => return Some(Self::Real(f64::NEG_INFINITY)),
            _ => {}
        }
        if !is_decimal(text) {
            return None;
        }
        match text.parse::<i128>() {
            // Minus zero is a double, and no whole number.
            Ok(whole) if whole != 0 => Some(Self::Whole(whole)),
            _ => text
                .parse::<f64>()
                .ok()
                .filter(|it| it.is_finite())
                .map(Self::Real),
        }
    }

    /// The whole number that it is.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "whole and within what both types hold"
    )]
    pub(in crate::service::http) fn whole(self) -> Option<i128> {
        match self {
            Self::Whole(number) => Some(number),
            Self::Real(number) => {
                let is_whole = number.fract() == 0.0 && number.abs() <= MAX_WHOLE;
                is_whole.then_some(number as i128)
            }
        }
    }

    /// As a double.
    pub(in crate::service::http) fn real(self) -> f64 {
        match self {
            Self::Whole(number) => number as f64,
            Self::Real(number) => number,
        }
    }

    /// As the single that is nearest; none when it is finite and no single is.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "rounded, which is what a field of this width asks for"
    )]
    pub(in crate::service::http) fn single(self) -> Option<f32> {
        let single = self.real() as f32;
        (single.is_finite() || !self.real().is_finite()).then_some(single)
    }

    /// Writes it as a field of this type; none when the type has no such number.
    pub(super) fn put(self, number_type: Type, tag: u32, out: &mut Vec<u8>) -> Option<()> {
        match number_type {
            Type::Double => wire::double::encode(tag, &self.real(), out),
            Type::Float => wire::float::encode(tag, &self.single()?, out),
            Type::Int32 => wire::int32::encode(tag, &self.as_whole()?, out),
            Type::Int64 => wire::int64::encode(tag, &self.as_whole()?, out),
            Type::Uint32 => wire::uint32::encode(tag, &self.as_whole()?, out),
            Type::Uint64 => wire::uint64::encode(tag, &self.as_whole()?, out),
            Type::Sint32 => wire::sint32::encode(tag, &self.as_whole()?, out),
            Type::Sint64 => wire::sint64::encode(tag, &self.as_whole()?, out),
            Type::Fixed32 => wire::fixed32::encode(tag, &self.as_whole()?, out),
            Type::Fixed64 => wire::fixed64::encode(tag, &self.as_whole()?, out),
            Type::Sfixed32 => wire::sfixed32::encode(tag, &self.as_whole()?, out),
            Type::Sfixed64 => wire::sfixed64::encode(tag, &self.as_whole()?, out),
            Type::Bool | Type::String | Type::Bytes | Type::Enum | Type::Message | Type::Group => {
                return None;
            }
        }
        Some(())
    }

    /// The whole number that it is, in a type that holds it.
    pub(in crate::service::http) fn as_whole<W: TryFrom<i128>>(self) -> Option<W> {
        self.whole()?.try_into().ok()
    }
}

/// What a field of this type may hold, for a person.
pub(super) fn expected(number_type: Type) -> &'static str {
    match number_type {
        Type::Double | Type::Float => "a number, or \"NaN\"",
        Type::Int32 | Type::Sint32 | Type::Sfixed32 => {
            "a whole number from -2147483648 to 2147483647"
        }
        Type::Uint32 | Type::Fixed32 => "a whole number from 0 to 4294967295",
        Type::Int64 | Type::Sint64 | Type::Sfixed64 => {
            "a whole number of 64 bits, as text beyond 2^53"
        }
        _ => "a whole number of 64 bits from 0, as text beyond 2^53",
    }
}

/// Digits with a sign, a fraction and an exponent, as JSON has them, except that zeros may lead.
fn is_decimal(text: &str) -> bool {
    let is_digits = |it: &str| !it.is_empty() && it.bytes().all(|it| it.is_ascii_digit());
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (text, None),
    };
    let mantissa = mantissa.strip_prefix('-').unwrap_or(mantissa);
    let (whole, fraction) = match mantissa.split_once('.') {
        Some((whole, fraction)) => (whole, Some(fraction)),
        None => (mantissa, None),
    };
    let unsigned = |it: &str| is_digits(it.strip_prefix(['+', '-']).unwrap_or(it));
    is_digits(whole) && fraction.is_none_or(is_digits) && exponent.is_none_or(unsigned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_number_is_one_however_it_is_written() {
        for text in ["13", "13.0", "1.3e1", "1.3E+1", "130e-1", "0013"] {
            let number = Number::of_text(text);
            assert_eq!(number.and_then(Number::whole), Some(13), "{text}");
        }
        assert_eq!(Number::Real(13.0).as_whole::<u32>(), Some(13));
        assert_eq!(Number::Real(-0.0).as_whole::<u32>(), Some(0));
        let most = Number::of_text("18446744073709551615");
        assert_eq!(most.and_then(Number::as_whole::<u64>), Some(u64::MAX));
        for text in [
            "1.5",
            "1e16",
            "1e400",
            "NaN",
            "-Infinity",
            "18446744073709551616",
        ] {
            let number = Number::of_text(text);
            assert_eq!(number.and_then(Number::as_whole::<u64>), None, "{text}");
        }
    }

    #[test]
    fn what_is_no_number_of_json_is_none_as_text_either() {
        for text in [
            "", "-", "+1", " 1", "1 ", ".5", "1.", "1e", "e1", "1e1.5", "0x1", "inf", "nan",
            "infinity", "1_0",
        ] {
            assert_eq!(Number::of_text(text), None, "{text}");
        }
    }

    #[test]
    fn a_float_keeps_the_sign_of_zero_and_is_never_made_infinite() {
        for text in ["-0", "-0.0"] {
            let single = Number::of_text(text).and_then(Number::single).unwrap();
            assert_eq!(single.to_bits(), (-0.0_f32).to_bits(), "{text}");
        }
        assert_eq!(Number::Real(1e39).single(), None);
        assert_eq!(Number::Real(f64::INFINITY).single(), Some(f32::INFINITY));
        assert_eq!(
            Number::of_text("1e39").unwrap().real().to_bits(),
            1e39_f64.to_bits()
        );
    }
}
