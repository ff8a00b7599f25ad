//! Counts the HTTP/2 frames that cost a server more than they cost a peer, as they come in (CONTRACTS S-9, BAD_INPUT F8).
//!
//! The library bounds what such frames make it hold, not how many it answers. Each kind has a budget a second, far above
//! what clients send that mean well: two window updates and a ping for every sample of 64 streams at 120 Hz.

use std::time::Duration;

use tokio::time::Instant;

/// What a budget counts over.
const WINDOW: Duration = Duration::from_secs(1);

/// Length, type, flags and stream of a frame (RFC 9113, 4.1).
const HEADER_BYTES: usize = 9;

const END_STREAM: u8 = 0x1;

/// Frames that are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControlFrame {
    /// DATA without content that does not end its stream.
    EmptyData,
    /// PRIORITY.
    Priority,
    /// `RST_STREAM`.
    Reset,
    /// SETTINGS.
    Settings,
    /// PING.
    Ping,
    /// `WINDOW_UPDATE`.
    WindowUpdate,
    /// CONTINUATION.
    Continuation,
    /// A type that is ignored.
    Unknown,
}

const N_KINDS: usize = 8;

impl ControlFrame {
    /// As metrics call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::EmptyData => "empty_data",
            Self::Priority => "priority",
            Self::Reset => "rst_stream",
            Self::Settings => "settings",
            Self::Ping => "ping",
            Self::WindowUpdate => "window_update",
            Self::Continuation => "continuation",
            Self::Unknown => "unknown",
        }
    }

    /// How many may come in a second.
    pub fn budget(self) -> u32 {
        match self {
            // Some clients answer every batch of samples with a ping that measures the line.
            Self::Ping => 10_000,
            Self::WindowUpdate => 30_000,
            Self::Settings => 100,
            Self::EmptyData | Self::Priority | Self::Reset | Self::Continuation | Self::Unknown => {
                500
            }
        }
    }

    fn of(header: [u8; HEADER_BYTES]) -> Option<Self> {
        let [a, b, c, kind, flags, ..] = header;
        match kind {
            0x0 if [a, b, c] == [0, 0, 0] && flags & END_STREAM == 0 => Some(Self::EmptyData),
            // DATA and HEADERS are bounded by windows and by the number of streams; the others end the connection.
            0x0 | 0x1 | 0x5 | 0x7 => None,
            0x2 => Some(Self::Priority),
            0x3 => Some(Self::Reset),
            0x4 => Some(Self::Settings),
            0x6 => Some(Self::Ping),
            0x8 => Some(Self::WindowUpdate),
            0x9 => Some(Self::Continuation),
            _ => Some(Self::Unknown),
        }
    }
}

/// Reads the frames of one connection after its preface.
pub(super) struct FrameMeter {
    /// Bytes of the next frame's header that came so far.
    header: [u8; HEADER_BYTES],
    n_header: usize,
    /// Bytes of the present frame's content that are still to come.
    n_content: usize,
    counts: [u32; N_KINDS],
    since: Instant,
}

impl FrameMeter {
    pub(super) fn new(now: Instant) -> Self {
        Self {
            header: [0; HEADER_BYTES],
            n_header: 0,
            n_content: 0,
            counts: [0; N_KINDS],
            since: now,
        }
    }

    /// The kind of which these bytes bring more than its budget, if any.
    pub(super) fn observe(&mut self, mut bytes: &[u8], now: Instant) -> Option<ControlFrame> {
        if now.duration_since(self.since) >= WINDOW {
            self.counts = [0; N_KINDS];
            self.since = now;
        }
        while let Some(header) = self.next_header(&mut bytes) {
            let [a, b, c, ..] = header;
            self.n_content = u32::from_be_bytes([0, a, b, c]) as usize;
            let Some(kind) = ControlFrame::of(header) else {
                continue;
            };
            let count = &mut self.counts[kind as usize];
            *count += 1;
            if *count > kind.budget() {
                return Some(kind);
            }
        }
        None
    }

    /// Takes bytes up to the end of the next header; none when there are not enough.
    fn next_header(&mut self, bytes: &mut &[u8]) -> Option<[u8; HEADER_BYTES]> {
        let n_skipped = self.n_content.min(bytes.len());
        self.n_content -= n_skipped;
        *bytes = &bytes[n_skipped..];
        let n = (HEADER_BYTES - self.n_header).min(bytes.len());
        self.header[self.n_header..self.n_header + n].copy_from_slice(&bytes[..n]);
        self.n_header += n;
        *bytes = &bytes[n..];
        if self.n_header < HEADER_BYTES {
            return None;
        }
        self.n_header = 0;
        Some(self.header)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const PING: [u8; 17] = [0, 0, 8, 6, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8];

    fn frame(kind: u8, flags: u8, content: &[u8]) -> Vec<u8> {
        let length = u32::try_from(content.len()).unwrap().to_be_bytes();
        let mut frame = length[1..].to_vec();
        frame.extend([kind, flags, 0, 0, 0, 1]);
        frame.extend(content);
        frame
    }

    #[tokio::test(start_paused = true)]
    async fn more_than_the_budget_in_a_second_is_too_much_and_the_budget_is_not() {
        let kinds = [
            (0x0, ControlFrame::EmptyData),
            (0x2, ControlFrame::Priority),
            (0x3, ControlFrame::Reset),
            (0x4, ControlFrame::Settings),
            (0x6, ControlFrame::Ping),
            (0x8, ControlFrame::WindowUpdate),
            (0x9, ControlFrame::Continuation),
            (0xb, ControlFrame::Unknown),
        ];
        for (number, kind) in kinds {
            let mut meter = FrameMeter::new(Instant::now());
            let frame = frame(number, 0, &[]);
            for _second in 0..3 {
                for _ in 0..kind.budget() {
                    assert_eq!(meter.observe(&frame, Instant::now()), None);
                }
                tokio::time::advance(WINDOW).await;
            }
            let flood = frame.repeat(kind.budget() as usize + 1);
            assert_eq!(meter.observe(&flood, Instant::now()), Some(kind));
        }
    }

    #[test]
    fn requests_and_their_ends_are_never_too_many() {
        let mut meter = FrameMeter::new(Instant::now());
        let request = [frame(0x1, 0x4, &[0x82]), frame(0x0, END_STREAM, &[])].concat();
        let data = frame(0x0, 0, &[7; 100]);
        for bytes in [request, data] {
            assert_eq!(meter.observe(&bytes.repeat(100_000), Instant::now()), None);
        }
    }

    proptest! {
        #[test]
        fn it_does_not_matter_how_the_bytes_are_cut(
            cuts in prop::collection::vec(1_usize..40, 1..200),
            contents in prop::collection::vec((0_u8..12, 0_usize..60), 1..60),
        ) {
            let all: Vec<u8> = contents
                .iter()
                .flat_map(|&(kind, n)| frame(kind, 0, &vec![6; n]))
                .chain(PING)
                .collect();
            let now = Instant::now();
            let mut whole = FrameMeter::new(now);
            prop_assert_eq!(whole.observe(&all, now), None);
            let mut cut = FrameMeter::new(now);
            let mut rest = all.as_slice();
            for n in cuts.iter().cycle() {
                let (piece, later) = rest.split_at((*n).min(rest.len()));
                prop_assert_eq!(cut.observe(piece, now), None);
                rest = later;
                if rest.is_empty() {
                    break;
                }
            }
            prop_assert_eq!(whole.counts, cut.counts);
        }
    }
}
