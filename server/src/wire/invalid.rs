//! A field of a request that cannot be used: which, and why.

use std::fmt;

use crate::name::NameError;

/// A refused field.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{path}: {problem}")]
pub struct FieldError {
    path: FieldPath,
    problem: FieldProblem,
}

/// Where a field stands in its request: `start.unit`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FieldPath {
    /// The message that holds it, if that is not the request itself.
    parent: Option<&'static str>,
    field: &'static str,
}

impl fmt::Display for FieldPath {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(parent) = self.parent {
            write!(formatter, "{parent}.")?;
        }
        formatter.write_str(self.field)
    }
}

/// What is wrong with a field. The client's text is never repeated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FieldProblem {
    /// Not a name.
    #[error("{0}")]
    Name(NameError),
    /// An enum value that this server does not know.
    #[error("{0} is not a value of this enum")]
    UnknownEnum(i32),
    /// Must be given.
    #[error("must be given")]
    Missing,
    /// A number out of its range, or not a number.
    #[error("{found} is not within {expected}")]
    Range {
        /// The number.
        found: f64,
        /// The range, as a person reads it.
        expected: &'static str,
    },
    /// A duration out of its range.
    #[error("the duration is not within {expected}")]
    Duration {
        /// The range, as a person reads it.
        expected: &'static str,
    },
    /// Known, but not built yet.
    #[error("this server cannot do that yet")]
    NotImplemented,
    /// A path of the field mask that names no field.
    #[error("path {index} names no field of the settings")]
    UnknownPath {
        /// Its place in the mask, from 0.
        index: usize,
    },
    /// Anything else that a stream's first message may have wrong.
    #[error("{detail}")]
    Unusable {
        /// The identifier on the wire.
        reason: &'static str,
        /// What is wrong, without repeating what was sent.
        detail: String,
    },
    /// A page token that this server did not make.
    #[error("is not a token that this server made")]
    PageToken,
}

impl FieldError {
    /// A refused field.
    pub fn new(field: &'static str, problem: FieldProblem) -> Self {
        let parent = None;
        let path = FieldPath { parent, field };
        Self { path, problem }
    }

    /// The same field of a message that is itself a field of the request.
    #[must_use]
    pub fn inside(mut self, parent: &'static str) -> Self {
        self.path.parent = Some(parent);
        self
    }

    /// A field with its reason, and what is wrong with it.
    pub fn unusable(field: &'static str, reason: &'static str, detail: impl Into<String>) -> Self {
        let detail = detail.into();
        Self::new(field, FieldProblem::Unusable { reason, detail })
    }

    /// Names the field of a refused name.
    pub fn name(field: &'static str) -> impl FnOnce(NameError) -> Self {
        move |error| Self::new(field, FieldProblem::Name(error))
    }

    /// The field's own name.
    pub fn field(&self) -> &'static str {
        self.path.field
    }

    /// Where the field stands in the request.
    pub fn path(&self) -> FieldPath {
        self.path
    }

    /// What is wrong with it.
    pub fn problem(&self) -> &FieldProblem {
        &self.problem
    }

    /// The identifier on the wire.
    pub fn reason(&self) -> &'static str {
        match self.problem {
            FieldProblem::Name(_) => "NAME",
            FieldProblem::UnknownEnum(_) => "ENUM",
            FieldProblem::Missing => "MISSING_FIELD",
            FieldProblem::Range { .. } | FieldProblem::Duration { .. } => "SOLVER_OPTIONS",
            FieldProblem::NotImplemented => "NOT_IMPLEMENTED",
            FieldProblem::UnknownPath { .. } => "FIELD_MASK",
            FieldProblem::PageToken => "PAGE_TOKEN",
            FieldProblem::Unusable { reason, .. } => reason,
        }
    }
}
