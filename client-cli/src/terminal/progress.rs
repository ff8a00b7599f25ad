//! Progress bars for work that takes a while; silent when nobody looks.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar over `total` bytes.
pub fn bytes(total: u64, what: &'static str) -> ProgressBar {
    bar(
        total,
        what,
        "{msg} {wide_bar} {bytes}/{total_bytes} {bytes_per_sec}",
    )
}

/// A bar over `total` frames.
pub fn frames(total: u64, what: &'static str) -> ProgressBar {
    bar(
        total,
        what,
        "{msg} {wide_bar} {pos}/{len} frames {per_sec} {eta}",
    )
}

/// A sign of life for work of unknown length.
pub fn spinner(what: impl Into<String>) -> ProgressBar {
    // Drawn to stderr, and only when that is a terminal.
    let spinner = ProgressBar::new_spinner().with_message(what.into());
    spinner.enable_steady_tick(Duration::from_millis(100));
    spinner
}

fn bar(total: u64, what: &'static str, template: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.with_message(what)
}
