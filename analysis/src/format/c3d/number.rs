//! Numbers as three families of processors wrote them.

/// Who wrote the file: in which order bytes lie, and what a real is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Processor {
    /// Little-endian, IEEE 754.
    Intel,
    /// Little-endian words, VAX `F_floating`.
    Dec,
    /// Big-endian, IEEE 754.
    Mips,
}

impl Processor {
    pub(super) const INTEL_CODE: u8 = 84;

    pub(super) fn of(code: u8) -> Option<Self> {
        match code {
            Self::INTEL_CODE => Some(Self::Intel),
            85 => Some(Self::Dec),
            86 => Some(Self::Mips),
            _ => None,
        }
    }

    pub(super) fn word(self, bytes: [u8; 2]) -> u16 {
        match self {
            Self::Intel | Self::Dec => u16::from_le_bytes(bytes),
            Self::Mips => u16::from_be_bytes(bytes),
        }
    }

    pub(super) fn real(self, bytes: [u8; 4]) -> f32 {
        match self {
            Self::Intel => f32::from_le_bytes(bytes),
            Self::Mips => f32::from_be_bytes(bytes),
            Self::Dec => vax_real(bytes),
        }
    }
}

/// (−1)^s × 0.1f₂ × 2^(e − 128), the word with sign and exponent first; exponent 0 is 0, or with the sign no number.
fn vax_real([b0, b1, b2, b3]: [u8; 4]) -> f32 {
    let bits = u32::from_be_bytes([b1, b0, b3, b2]);
    let is_negative = bits >> 31 == 1;
    let exponent = bits >> 23 & 0xff;
    if exponent == 0 {
        return if is_negative { f32::NAN } else { 0.0 };
    }
    let fraction = f64::from(bits & 0x007f_ffff | 0x0080_0000);
    // The hidden bit is the first behind the point: 24 places, and 128 for the exponent's bias.
    let magnitude = fraction * 2_f64.powi(exponent.cast_signed() - 128 - 24);
    #[expect(
        clippy::cast_possible_truncation,
        reason = "24 bits fit; the two smallest exponents lose bits that no coordinate has"
    )]
    let magnitude = magnitude as f32;
    if is_negative { -magnitude } else { magnitude }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bits, bytes as a VAX keeps them, value: from the VAX Architecture Reference Manual's definition.
    #[test]
    fn vax_reals_are_what_their_definition_says() {
        for (bytes, value) in [
            ([0x00, 0x00, 0x00, 0x00], 0.0_f32),
            ([0x80, 0x40, 0x00, 0x00], 1.0),
            ([0x80, 0xc0, 0x00, 0x00], -1.0),
            ([0x00, 0x40, 0x00, 0x00], 0.5),
            ([0x60, 0x41, 0x00, 0x00], 3.5),
            ([0x48, 0x44, 0x00, 0x00], 200.0),
            ([0xcc, 0x3e, 0xcd, 0xcc], 0.1),
            ([0xff, 0x7f, 0xff, 0xff], 1.701_412e38),
            ([0x80, 0x00, 0x00, 0x00], 2.938_736e-39),
        ] {
            let read = Processor::Dec.real(bytes);
            let error = (f64::from(read) - f64::from(value)).abs();
            assert!(error <= f64::from(value).abs() * 3e-7, "{bytes:x?}: {read}");
        }
        assert!(Processor::Dec.real([0x00, 0x80, 0x00, 0x00]).is_nan());
    }

    #[test]
    fn words_and_reals_follow_the_byte_order() {
        assert_eq!(Processor::Intel.word([0x01, 0x02]), 0x0201);
        assert_eq!(Processor::Dec.word([0x01, 0x02]), 0x0201);
        assert_eq!(Processor::Mips.word([0x01, 0x02]), 0x0102);
        let one = 1.0_f32.to_bits();
        assert_eq!(Processor::Mips.real([0x3f, 0x80, 0, 0]).to_bits(), one);
        assert_eq!(Processor::Intel.real([0, 0, 0x80, 0x3f]).to_bits(), one);
    }
}
