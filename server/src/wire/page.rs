//! Pages of a list: the token is the last id of the page before.

use super::invalid::{FieldError, FieldProblem};

/// Entries of a page when the client names no size.
const DEFAULT_SIZE: u32 = 50;
/// Most entries of a page.
const MAX_SIZE: u32 = 500;
/// A token is an id, and no id is longer.
const MAX_TOKEN_BYTES: usize = 63;

/// Part of a list that is asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// Ids after this one.
    pub after: String,
    /// At most so many.
    pub size: usize,
}

impl Page {
    /// Reads size and token of a request; 0 is the default size, and more than the most is the most.
    ///
    /// # Errors
    ///
    /// When the token has a form that no token has.
    pub fn parse(size: u32, token: &str) -> Result<Self, FieldError> {
        let known =
            |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || b"_-".contains(&byte);
        if token.len() > MAX_TOKEN_BYTES || !token.bytes().all(known) {
            return Err(FieldError::new("page_token", FieldProblem::PageToken));
        }
        let size = match size {
            0 => DEFAULT_SIZE,
            size => size.min(MAX_SIZE),
        };
        Ok(Self {
            after: token.to_owned(),
            size: size as usize,
        })
    }

    /// How many to read: one more than the page holds tells whether another follows.
    pub fn n_to_read(&self) -> usize {
        self.size + 1
    }

    /// Cuts what was read to the page and says the next page's token, empty at the end.
    pub fn cut<T>(&self, found: &mut Vec<T>, id: impl Fn(&T) -> String) -> String {
        if found.len() <= self.size {
            return String::new();
        }
        found.truncate(self.size);
        found.last().map(id).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_page_has_no_token() {
        let page = Page::parse(2, "a").unwrap();
        let mut more = vec!["b", "c", "d"];
        assert_eq!(page.cut(&mut more, ToString::to_string), "c");
        assert_eq!(more, ["b", "c"]);
        assert_eq!(page.cut(&mut vec!["d"], ToString::to_string), "");
    }

    #[test]
    fn sizes_are_bounded_and_foreign_tokens_refused() {
        assert_eq!(Page::parse(0, "").unwrap().size, 50);
        assert_eq!(Page::parse(u32::MAX, "").unwrap().size, 500);
        assert!(Page::parse(1, "../x").is_err());
        assert!(Page::parse(1, &"x".repeat(64)).is_err());
    }
}
