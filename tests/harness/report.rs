//! Sections of `docs/reliability.md` that runs write.

use std::{fs, path::Path};

/// Puts `body` in place of the section of this title, or at the end of the page.
///
/// # Panics
///
/// When the page cannot be read or written.
pub fn write_section(title: &str, body: &str) {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/reliability.md");
    let text = fs::read_to_string(&page).unwrap();
    fs::write(&page, with_section(&text, title, body)).unwrap();
}

fn with_section(text: &str, title: &str, body: &str) -> String {
    let heading = format!("## {title}\n");
    let section = format!("{heading}\n{}\n", body.trim());
    let Some(start) = text.find(&heading) else {
        return format!("{}\n\n{section}", text.trim_end());
    };
    let behind = &text[start + heading.len()..];
    match behind.find("\n## ") {
        Some(end) => format!("{}{section}{}", &text[..start], &behind[end..]),
        None => format!("{}{section}", &text[..start]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_is_replaced_in_its_place_or_added_at_the_end() {
        let page = "# Page\n\n## One\n\nold\n\n## Two\n\nkept\n";
        let replaced = with_section(page, "One", "new");
        assert_eq!(replaced, "# Page\n\n## One\n\nnew\n\n## Two\n\nkept\n");
        let last = with_section(page, "Two", "new");
        assert_eq!(last, "# Page\n\n## One\n\nold\n\n## Two\n\nnew\n");
        let added = with_section(page, "Three", "new");
        assert!(added.ends_with("kept\n\n## Three\n\nnew\n"));
    }
}
