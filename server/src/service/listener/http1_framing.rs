//! Where one HTTP/1 request ends and the next begins, strictly (RFC 9112, 6.3; BAD_INPUT F13).
//!
//! The library takes a lone line feed for the end of a line, one of two lengths when a request has two, and two that are
//! equal for one. A proxy in front of it may see that otherwise, and a request hidden in another is born. Here the byte
//! that completes such a request becomes NUL, which the library refuses with 400 wherever it may still answer, and it is the
//! last that is read of the connection: where NUL means nothing, as in the extension of a chunk, the end does not.

/// As much of a line as is looked at. One that says a length and is longer is refused: the library would read on.
const MAX_LINE_BYTES: usize = 64;

/// What no header, line or chunk may hold.
const SPOILED: u8 = 0;

/// What follows a head that was spoiled: the library looks at no head before its end has come.
const END_OF_HEAD: &[u8] = b"\r\n\r\n";

/// Follows the requests of one connection.
pub(super) struct Http1Framing {
    part: Part,
    line: Vec<u8>,
    /// The last byte was a carriage return.
    after_return: bool,
    head: Head,
    /// What is left to say once it is broken.
    last_words: &'static [u8],
}

/// What comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Head,
    /// So many bytes of a body, or of a chunk and the end of its line.
    Content {
        n_left: u64,
        is_chunk: bool,
    },
    ChunkSize,
    Trailers,
    /// No more requests: the connection speaks something else now.
    Opaque,
    /// Nothing at all: where the next request begins is not clear.
    Broken,
}

/// What the lines of a head said.
#[derive(Clone, Copy, Debug, Default)]
struct Head {
    n_lines: usize,
    n_lengths: usize,
    length: Option<u64>,
    is_chunked: bool,
    /// A length goes on beyond what is looked at.
    is_cut: bool,
}

impl Http1Framing {
    pub(super) fn new() -> Self {
        Self {
            part: Part::Head,
            line: Vec::new(),
            after_return: false,
            head: Head::default(),
            last_words: b"",
        }
    }

    /// The connection was upgraded: what comes is no HTTP any more.
    pub(super) fn upgraded(&mut self) {
        self.part = Part::Opaque;
    }

    /// Nothing more may be read.
    pub(super) fn is_broken(&self) -> bool {
        self.part == Part::Broken
    }

    /// What stands for the rest of a broken connection, at most so many bytes; with nothing it has ended.
    pub(super) fn last_words(&mut self, most: usize) -> &'static [u8] {
        let (now, later) = self.last_words.split_at(most.min(self.last_words.len()));
        self.last_words = later;
        now
    }

    /// Follows these bytes, and spoils the one that completes an ambiguous request; how many of them may be read.
    pub(super) fn follow(&mut self, bytes: &mut [u8]) -> usize {
        let mut n = 0;
        while n < bytes.len() {
            n += match self.part {
                Part::Broken => return n,
                Part::Opaque => bytes.len() - n,
                Part::Content { n_left, is_chunk } => self.skip(n_left, is_chunk, bytes.len() - n),
                Part::Head | Part::ChunkSize | Part::Trailers => {
                    let of_head = self.part == Part::Head;
                    if !self.take(bytes[n]) {
                        bytes[n] = SPOILED;
                        self.last_words = if of_head { END_OF_HEAD } else { b"" };
                        self.part = Part::Broken;
                    }
                    1
                }
            };
        }
        n
    }

    fn skip(&mut self, n_left: u64, is_chunk: bool, n_there: usize) -> usize {
        let n = usize::try_from(n_left).map_or(n_there, |it| it.min(n_there));
        let n_left = n_left - n as u64;
        self.part = match (n_left, is_chunk) {
            (0, true) => Part::ChunkSize,
            (0, false) => Part::Head,
            _ => Part::Content { n_left, is_chunk },
        };
        n
    }

    /// Whether this byte of a line may stay.
    fn take(&mut self, byte: u8) -> bool {
        let after_return = std::mem::replace(&mut self.after_return, byte == b'\r');
        if byte != b'\n' {
            // The return before it was part of the line, which the library refuses.
            if byte != b'\r' && self.line.len() <= MAX_LINE_BYTES {
                self.line.push(byte);
            }
            return true;
        }
        let line = std::mem::take(&mut self.line);
        let is_clear = after_return && self.end_line(&line);
        self.line = line;
        self.line.clear();
        is_clear
    }

    fn end_line(&mut self, line: &[u8]) -> bool {
        match self.part {
            Part::Head if line.is_empty() && self.head.n_lines == 0 => true,
            Part::Head if line.is_empty() => self.end_head(),
            Part::Head => {
                self.head.read(line);
                true
            }
            Part::ChunkSize => self.begin_chunk(line),
            Part::Trailers => {
                if line.is_empty() {
                    self.part = Part::Head;
                }
                true
            }
            Part::Content { .. } | Part::Opaque | Part::Broken => true,
        }
    }

    fn end_head(&mut self) -> bool {
        let head = std::mem::take(&mut self.head);
        let n_framings = head.n_lengths + usize::from(head.is_chunked);
        self.part = match head.length {
            _ if head.is_chunked => Part::ChunkSize,
            Some(n_left) if n_left > 0 => Part::Content {
                n_left,
                is_chunk: false,
            },
            _ => Part::Head,
        };
        n_framings <= 1 && !head.is_cut
    }

    fn begin_chunk(&mut self, line: &[u8]) -> bool {
        let digits = line.split(|it| matches!(it, b';' | b' ' | b'\t')).next();
        let size = digits
            .filter(|it| it.len() <= MAX_LINE_BYTES)
            .and_then(|it| std::str::from_utf8(it).ok())
            .and_then(|it| u64::from_str_radix(it, 16).ok());
        // The end of its line belongs to it.
        let whole = size.and_then(|it| it.checked_add(2));
        self.part = match (size, whole) {
            (Some(0), _) => Part::Trailers,
            (_, Some(n_left)) => Part::Content {
                n_left,
                is_chunk: true,
            },
            _ => return false,
        };
        true
    }
}

impl Head {
    /// The first line is the request's own.
    fn read(&mut self, line: &[u8]) {
        self.n_lines += 1;
        if self.n_lines == 1 {
            return;
        }
        let Some(colon) = line.iter().position(|it| *it == b':') else {
            return;
        };
        let (name, value) = (&line[..colon], &line[colon + 1..]);
        if name.eq_ignore_ascii_case(b"content-length") {
            self.n_lengths += 1;
            self.is_cut |= line.len() > MAX_LINE_BYTES;
            let value = std::str::from_utf8(value.trim_ascii()).ok();
            // The library refuses what is no number.
            self.length = value.and_then(|it| it.parse().ok());
        } else if name.eq_ignore_ascii_case(b"transfer-encoding") {
            self.is_chunked = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const GET: &str = "GET / HTTP/1.1\r\nHost: x\r\n\r\n";

    /// What the library is handed for these bytes, however they are cut.
    fn followed(sent: &str, n_piece: usize) -> String {
        let mut framing = Http1Framing::new();
        let mut bytes = sent.as_bytes().to_vec();
        let mut handed = Vec::new();
        for piece in bytes.chunks_mut(n_piece) {
            let n = framing.follow(piece);
            assert!(framing.is_broken() || n == piece.len());
            handed.extend_from_slice(&piece[..n]);
        }
        String::from_utf8(handed).unwrap()
    }

    /// Whether these bytes are spoiled; then they end there, whatever follows.
    fn is_spoiled(sent: &str) -> bool {
        let whole = followed(sent, sent.len());
        assert_eq!(whole, followed(sent, 1));
        assert_eq!(whole.ends_with(char::from(SPOILED)), whole != sent);
        if whole != sent {
            assert_eq!(whole, followed(&format!("{sent}{GET}"), 7));
        }
        whole != sent
    }

    #[test]
    fn clear_requests_pass_as_they_are() {
        let clear = [
            GET.repeat(3),
            format!("\r\n{GET}"),
            format!("POST / HTTP/1.1\r\nContent-Length: 4\r\n\r\na\n\nb{GET}"),
            format!(
                "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n3;x=y\r\n\n\n\n\r\n0\r\nA: b\r\n\r\n{GET}"
            ),
            format!(
                "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n3;{}\r\n\n\n\n\r\n0\r\n\r\n{GET}",
                "x".repeat(99)
            ),
            format!("GET /{} HTTP/1.1\r\nHost: x\r\n\r\n", "x".repeat(500)),
        ];
        for sent in clear {
            assert!(!is_spoiled(&sent), "{sent}");
        }
    }

    #[test]
    fn ambiguous_requests_are_spoiled_wherever_they_stand() {
        let ambiguous = [
            "GET / HTTP/1.1\nHost: x\r\n\r\n",
            "GET / HTTP/1.1\r\nHost: x\n\r\n",
            "GET / HTTP/1.1\r\nHost: x\r\n\n",
            "POST / HTTP/1.1\r\nContent-Length: 4\r\nTransfer-Encoding: chunked\r\n\r\n",
            "POST / HTTP/1.1\r\ntransfer-encoding: chunked\r\ncontent-length: 4\r\n\r\n",
            "POST / HTTP/1.1\r\nContent-Length: 4\r\nContent-Length: 4\r\n\r\n",
            "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n3\nabc\r\n",
            "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n3;\n\r\nabc\r\n",
            "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n0\r\nA: b\n\r\n",
            "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\n",
            "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nfffffffffffffffff\r\n",
            "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n",
        ];
        for sent in ambiguous {
            assert!(is_spoiled(sent), "{sent}");
            assert!(is_spoiled(&format!("{GET}{sent}")), "{sent}");
        }
    }

    #[test]
    fn lengths_that_are_longer_than_what_is_looked_at_are_spoiled() {
        let zeros = "0".repeat(MAX_LINE_BYTES);
        let spaces = " ".repeat(MAX_LINE_BYTES);
        let post = "POST / HTTP/1.1\r\n";
        for sent in [
            format!("{post}Content-Length:{spaces}5\r\n\r\n"),
            format!("{post}Content-Length:{zeros}5\r\n\r\n"),
            format!("{post}Transfer-Encoding: chunked\r\n\r\n{zeros}5\r\n"),
        ] {
            assert!(is_spoiled(&sent), "{sent}");
        }
    }

    #[test]
    fn after_an_upgrade_nothing_is_looked_at() {
        let mut framing = Http1Framing::new();
        framing.follow(&mut GET.as_bytes().to_vec());
        framing.upgraded();
        let mut frames = b"\n\n\n".to_vec();
        framing.follow(&mut frames);
        assert_eq!(frames, b"\n\n\n");
    }

    proptest! {
        #[test]
        fn any_bytes_are_followed_without_a_panic(
            mut bytes in prop::collection::vec(prop_oneof![Just(b'\r'), Just(b'\n'), Just(b'0'), any::<u8>()], 0..300),
            n_piece in 1_usize..20,
        ) {
            let mut framing = Http1Framing::new();
            for piece in bytes.chunks_mut(n_piece) {
                framing.follow(piece);
            }
            prop_assert!(framing.line.len() <= MAX_LINE_BYTES + 1);
        }
    }
}
