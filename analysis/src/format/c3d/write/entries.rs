//! Groups and parameters as bytes.

use crate::format::c3d::BLOCK_BYTES;

/// Longest text: some readers take a dimension for a signed byte.
pub(super) const MAX_NAME_BYTES: usize = 127;

const TEXT: i8 = -1;
const WORD: i8 = 2;
const REAL: i8 = 4;

/// The growing chain.
#[derive(Default)]
pub(super) struct Entries {
    bytes: Vec<u8>,
    n_groups: u8,
}

impl Entries {
    /// Begins a group; its id.
    pub(super) fn group(&mut self, name: &str) -> u8 {
        self.n_groups += 1;
        let id = self.n_groups.cast_signed();
        // An empty description.
        self.entry(-id, name, &[0]);
        self.n_groups
    }

    pub(super) fn words(&mut self, group: u8, name: &str, words: &[u16]) {
        let data: Vec<u8> = words.iter().flat_map(|it| it.to_le_bytes()).collect();
        match words.len() {
            1 => self.parameter(group, name, WORD, &[], &data),
            length => self.parameter(group, name, WORD, &[length], &data),
        }
    }

    pub(super) fn real(&mut self, group: u8, name: &str, real: f32) {
        self.parameter(group, name, REAL, &[], &real.to_le_bytes());
    }

    pub(super) fn text(&mut self, group: u8, name: &str, text: &str) {
        self.parameter(group, name, TEXT, &[text.len()], text.as_bytes());
    }

    /// Texts of equal length, filled up with blanks.
    pub(super) fn texts(&mut self, group: u8, name: &str, texts: &[String]) {
        let width = texts.iter().map(String::len).max().unwrap_or(0).max(1);
        let mut data = Vec::with_capacity(width * texts.len());
        for text in texts {
            data.extend(text.as_bytes());
            data.resize(data.len() + width - text.len(), b' ');
        }
        self.parameter(group, name, TEXT, &[width, texts.len()], &data);
    }

    fn parameter(&mut self, group: u8, name: &str, kind: i8, dimensions: &[usize], data: &[u8]) {
        let mut body = vec![kind.cast_unsigned(), byte(dimensions.len())];
        body.extend(dimensions.iter().map(|&it| byte(it)));
        body.extend(data);
        // An empty description.
        body.push(0);
        self.entry(group.cast_signed(), name, &body);
    }

    fn entry(&mut self, id: i8, name: &str, body: &[u8]) {
        self.bytes.push(byte(name.len()));
        self.bytes.push(id.cast_unsigned());
        self.bytes.extend(name.as_bytes());
        // To the next entry, counted from this word on.
        let way = u16::try_from(2 + body.len());
        let way = way.expect("invariant: 255 texts of 127 bytes fit");
        self.bytes.extend(way.to_le_bytes());
        self.bytes.extend(body);
    }

    /// The section in whole blocks, with the place of the frames in the group `point`.
    pub(super) fn finish(mut self, point: u8, first_block: u8, processor: u8) -> Vec<u8> {
        const PREFIX_BYTES: usize = 4;
        /// Two dimensions' worth of head, a word, an empty description, and the chain's end.
        const DATA_START_BYTES: usize = 2 + "DATA_START".len() + 2 + 2 + 2 + 1 + 2;
        let n_bytes = PREFIX_BYTES + self.bytes.len() + DATA_START_BYTES;
        let n_blocks = n_bytes.div_ceil(BLOCK_BYTES);
        // The most names, as long as may be, and all else fit into the 255 blocks that a byte can count.
        let n_blocks = byte(n_blocks);
        let data_block = u16::from(first_block) + u16::from(n_blocks);
        self.words(point, "DATA_START", &[data_block]);
        let mut section = vec![1, 80, n_blocks, processor];
        section.extend(self.bytes);
        section.resize(usize::from(n_blocks) * BLOCK_BYTES, 0);
        section
    }
}

fn byte(number: usize) -> u8 {
    u8::try_from(number).expect("invariant: names, dimensions and blocks have been checked")
}
