//! A small file put together from its definition, for every processor and storage, with analog values between.

/// Intel, DEC, MIPS.
pub(super) const PROCESSORS: [u8; 3] = [84, 85, 86];

pub(super) struct ByHand {
    processor: u8,
    is_integer: bool,
    bytes: Vec<u8>,
}

const SCALE: f32 = 0.25;

impl ByHand {
    pub(super) fn new(processor: u8, is_integer: bool) -> Self {
        let bytes = Vec::new();
        Self {
            processor,
            is_integer,
            bytes,
        }
    }

    fn word(&mut self, word: u16) {
        self.bytes.extend(match self.processor {
            86 => word.to_be_bytes(),
            _ => word.to_le_bytes(),
        });
    }

    fn real(&mut self, real: f32) {
        let [b0, b1, b2, b3] = real.to_bits().to_be_bytes();
        self.bytes.extend(match self.processor {
            84 => [b3, b2, b1, b0],
            86 => [b0, b1, b2, b3],
            _ if real.abs() <= 0.0 => [0; 4],
            // The VAX's exponent is greater by two, and its words are swapped.
            _ => [b1, b0 + 1, b3, b2],
        });
    }

    /// A coordinate, or another value that is stored like one.
    fn stored(&mut self, value: f32) {
        if self.is_integer {
            #[expect(clippy::cast_possible_truncation, reason = "small values")]
            self.word(((value / SCALE) as i16).cast_unsigned());
        } else {
            self.real(value);
        }
    }

    fn mask(&mut self, mask: i16) {
        if self.is_integer {
            self.word(mask.cast_unsigned());
        } else {
            self.real(f32::from(mask));
        }
    }

    fn scale(&self) -> f32 {
        if self.is_integer { SCALE } else { -SCALE }
    }

    fn entry(&mut self, locked: bool, id: i8, name: &str, body: &[u8]) {
        let length = i8::try_from(name.len()).unwrap();
        let length = if locked { -length } else { length };
        self.bytes
            .extend([length.cast_unsigned(), id.cast_unsigned()]);
        self.bytes.extend(name.as_bytes());
        self.word(u16::try_from(2 + body.len()).unwrap());
        self.bytes.extend(body);
    }

    /// Header, then one unused block, then two blocks of parameters, then frames.
    pub(super) fn file(mut self) -> Vec<u8> {
        self.header();
        self.bytes.resize(1_024, 0xee);
        self.parameters();
        self.bytes.resize(2_048, 0);
        for frame in [
            [Some(([-12.5, 100.0, 0.25], 0x0502)), None],
            [Some(([3.0, 0.0, -0.5], 0)), Some(([1.0, 2.0, 3.0], 0))],
        ] {
            for point in frame {
                let (position, mask) = point.unwrap_or(([9.0; 3], -1));
                for coordinate in position {
                    self.stored(coordinate);
                }
                self.mask(mask);
            }
            for _ in 0..6 {
                self.stored(77.0);
            }
        }
        self.bytes
    }

    fn header(&mut self) {
        self.bytes.extend([3, 80]);
        for word in [2, 6, 5, 6, 10] {
            self.word(word);
        }
        self.real(self.scale());
        for word in [5, 2] {
            self.word(word);
        }
        self.real(59.5);
    }

    fn parameters(&mut self) {
        self.bytes.extend([0, 0, 2, self.processor]);
        // A parameter may come before its group, and a group may be locked and described.
        let unit = [&[0xff, 1, 4][..], b"cm  ", &[0]].concat();
        self.entry(false, 9, "UNITS", &unit);
        self.entry(true, -9, "POINT", b"\x06points");
        self.entry(true, -3, "analog", &[0]);
        let labels = [&[0xff, 2, 5, 1][..], b"lid  ", b"\x05names"].concat();
        self.entry(true, 9, "Labels", &labels);
        // Nobody needs it, so that its type, which does not exist, does not matter.
        self.entry(false, 3, "ODD", &[7, 0, 0]);
        let mut used = Self::new(self.processor, true);
        used.bytes.extend([2, 0]);
        used.word(3);
        self.entry(false, 3, "USED", &used.bytes);
        self.bytes.extend([0, 0]);
    }
}
