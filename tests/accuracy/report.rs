//! The page as it grows, and its pictures beside it.

use std::path::PathBuf;

/// The page's name, and its pictures' folder.
const NAME: &str = "accuracy";

/// Markdown, one sentence a line, and pictures in a folder of the same name.
pub struct Report {
    folder: PathBuf,
    text: String,
}

impl Report {
    /// An empty page in `folder`.
    pub fn new(folder: PathBuf) -> Self {
        Self {
            folder,
            text: String::new(),
        }
    }

    /// Appends text, which ends its own lines, and an empty line.
    pub fn add(&mut self, text: &str) {
        self.text.push_str(text.trim_end());
        self.text.push_str("\n\n");
    }

    /// Writes a picture and shows it on the page.
    pub fn add_picture(&mut self, name: &str, caption: &str, svg: &str) {
        let pictures = self.folder.join(NAME);
        std::fs::create_dir_all(&pictures).unwrap();
        std::fs::write(pictures.join(format!("{name}.svg")), svg).unwrap();
        self.add(&format!("![{caption}]({NAME}/{name}.svg)"));
    }

    /// Says on the page and on the terminal that something was left out.
    pub fn leave_out(&mut self, what: &str) {
        println!("left out: {what}");
        self.add(&format!("*Left out: {what}.*"));
    }

    /// Writes the page.
    pub fn save(&self) {
        let path = self.folder.join(format!("{NAME}.md"));
        std::fs::write(&path, format!("{}\n", self.text.trim_end())).unwrap();
        println!("written: docs/{NAME}.md and its pictures");
    }
}
