//! Bytes to types and back. No files: bytes are handed in, bytes come back.
//!
//! Everything here reads what a stranger sent: every length is checked before it is believed, every loop and allocation
//! has a limit with a name, and every error says where.

pub mod actor_package;
pub mod c3d;
pub mod curve_csv;
pub mod glb;
pub mod live_link;
pub mod obj;
pub mod trc;

#[cfg(test)]
mod shared_data;

/// A stranger's text as it may appear in an error: printable, and not longer than a line.
pub(crate) fn quoted(text: &str) -> String {
    const SHOWN_CHARS: usize = 120;
    let mut shown: String = text
        .chars()
        .take(SHOWN_CHARS)
        .flat_map(|c| {
            let plain = c == ' ' || c.is_ascii_graphic();
            let escaped = (!plain).then(|| c.escape_default());
            escaped.into_iter().flatten().chain(plain.then_some(c))
        })
        .collect();
    if text.chars().nth(SHOWN_CHARS).is_some() {
        shown.push_str("...");
    }
    shown
}
