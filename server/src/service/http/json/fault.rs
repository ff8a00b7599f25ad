//! What is wrong with a text, and where: the field by its path, and the place in the text.

use std::fmt::Write as _;

use serde::de;
use serde_json::error::Category;
use tonic::{Code, Status};

use crate::service::grpc::status::Refusal;

/// A text that is not the message that is due.
#[derive(Clone, Debug)]
pub(in crate::service::http) struct Fault {
    reason: &'static str,
    what: String,
    field: String,
    limit: Option<usize>,
    line: u64,
    column: usize,
}

/// What was found while reading; the parser knows where.
#[derive(Clone, Debug)]
pub(super) struct Found {
    reason: &'static str,
    what: String,
    limit: Option<usize>,
    /// Whether `what` says something of the field, whose path comes before it.
    is_of_field: bool,
}

impl Found {
    /// Of a field: `must be …`, `stands twice`.
    pub(super) fn field(reason: &'static str, what: impl Into<String>) -> Self {
        Self {
            is_of_field: true,
            ..Self::text(reason, what)
        }
    }

    /// Of the text.
    pub(super) fn text(reason: &'static str, what: impl Into<String>) -> Self {
        Self {
            reason,
            what: what.into(),
            limit: None,
            is_of_field: false,
        }
    }

    /// There is more of something than the limit.
    pub(super) fn above(limit: usize, reason: &'static str, what: &str) -> Self {
        let what = format!("more than {limit} {what}");
        Self {
            limit: Some(limit),
            ..Self::text(reason, what)
        }
    }
}

/// A step from a message to what it holds.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    Field(&'static str),
    Element(usize),
}

/// One reading of a text: what may still come, and what was wrong.
#[derive(Debug)]
pub(super) struct Reading {
    max_objects: usize,
    n_objects: usize,
    found: Option<Found>,
    /// The way to it, from the inside out.
    trail: Vec<Step>,
}

impl Reading {
    pub(super) fn new(max_objects: usize) -> Self {
        Self {
            max_objects,
            n_objects: 0,
            found: None,
            trail: Vec::new(),
        }
    }

    /// Counts an object.
    pub(super) fn begin_object<E: de::Error>(&mut self) -> Result<(), E> {
        self.n_objects += 1;
        if self.n_objects <= self.max_objects {
            return Ok(());
        }
        let what = "objects in a message";
        Err(self.refuse(Found::above(self.max_objects, "FRAME_COUNT", what)))
    }

    /// Keeps what is wrong; the error only ends the parser.
    pub(super) fn refuse<E: de::Error>(&mut self, found: Found) -> E {
        self.found = Some(found);
        E::custom("refused")
    }

    /// Remembers that what is wrong lies behind this step.
    pub(super) fn behind(&mut self, step: Step) {
        self.trail.push(step);
    }

    /// The fault, where the parser stopped.
    pub(super) fn fault(self, error: &serde_json::Error) -> Fault {
        let field = path(&self.trail);
        let found = self.found.unwrap_or_else(|| of_parser(error));
        let what = match (found.is_of_field, field.as_str()) {
            (false, _) => found.what,
            (true, "") => format!("the message {}", found.what),
            (true, field) => format!("{field} {}", found.what),
        };
        Fault {
            reason: found.reason,
            what,
            field,
            limit: found.limit,
            line: error.line() as u64,
            column: error.column(),
        }
    }
}

/// `frames[2].positions[0]`.
fn path(trail: &[Step]) -> String {
    let mut path = String::new();
    for step in trail.iter().rev() {
        let written = match step {
            Step::Field(name) if path.is_empty() => write!(path, "{name}"),
            Step::Field(name) => write!(path, ".{name}"),
            Step::Element(idx) => write!(path, "[{idx}]"),
        };
        written.expect("invariant: a string takes all that is written");
    }
    path
}

/// What the parser itself cannot read. Its own texts may repeat the client's.
fn of_parser(error: &serde_json::Error) -> Found {
    match error.classify() {
        Category::Eof => Found::text("JSON", "the JSON ends too early"),
        // Among what is well formed, only numbers are refused by the parser itself.
        Category::Syntax if error.to_string().starts_with("number out of range") => {
            Found::text("JSON", "a number that no field can hold")
        }
        Category::Syntax | Category::Io => Found::text("JSON", "no JSON, or more after its end"),
        Category::Data => Found::field("JSON", "must be an object"),
    }
}

impl Fault {
    /// The same fault in a text that begins on a later line.
    #[must_use]
    pub(in crate::service::http) fn on_line(mut self, first: u64) -> Self {
        self.line += first.saturating_sub(1);
        self
    }
}

impl From<Fault> for Status {
    fn from(fault: Fault) -> Self {
        let Fault { line, column, .. } = fault;
        let message = format!("line {line}, column {column}: {}", fault.what);
        let mut refusal = Refusal::new(Code::InvalidArgument, fault.reason, message)
            .with("line", &line)
            .with("column", &column);
        if !fault.field.is_empty() {
            refusal = refusal.with("field", &fault.field);
        }
        if let Some(limit) = fault.limit {
            refusal = refusal.with("value", &limit);
        }
        refusal.into_status()
    }
}
