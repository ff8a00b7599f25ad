//! Who may do what (CONTRACTS S-3 to S-5): the one check that every door passes.

use http::Extensions;

/// Who sent a request; cheap to clone.
#[derive(Clone, Debug, Default)]
pub struct Caller {}

impl Caller {
    /// As the request's extensions say.
    pub fn of(extensions: &Extensions) -> Self {
        extensions.get::<Self>().cloned().unwrap_or_default()
    }
}
