//! The parameter section: a chain of groups and parameters, in any order, each with the way to the next.
//!
//! Only the chain is checked here; what a parameter holds is looked at when it is asked for, so that what nobody needs
//! cannot spoil a file.

use super::{C3dError, C3dProblem, MAX_PARAMETERS, number::Processor};
use crate::face::actor::MAX_MARKERS;

/// The section's own four bytes: two that mean nothing, number of blocks, processor.
pub(super) const PREFIX_BYTES: usize = 4;

/// Groups and parameters by name.
#[derive(Debug)]
pub(super) struct Parameters<'a> {
    processor: Processor,
    /// The id of each group and its name; two groups may share either.
    groups: Vec<(u8, &'a [u8])>,
    entries: Vec<Entry<'a>>,
}

/// One parameter: its type, its dimensions, its data, and behind them its description.
#[derive(Clone, Copy, Debug)]
struct Entry<'a> {
    group: u8,
    name: &'a [u8],
    offset: usize,
    body: &'a [u8],
}

/// What a parameter holds.
struct Content<'a> {
    offset: usize,
    kind: Kind,
    dimensions: &'a [u8],
    data: &'a [u8],
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Text,
    Byte,
    Word,
    Real,
}

impl Kind {
    fn of(code: u8) -> Option<Self> {
        match code.cast_signed() {
            -1 => Some(Self::Text),
            1 => Some(Self::Byte),
            2 => Some(Self::Word),
            4 => Some(Self::Real),
            _ => None,
        }
    }

    fn size(self) -> usize {
        match self {
            Self::Text | Self::Byte => 1,
            Self::Word => 2,
            Self::Real => 4,
        }
    }
}

impl<'a> Parameters<'a> {
    /// Follows the chain from `start` (a byte of the file) to its end, or to `end`.
    pub(super) fn read(
        bytes: &'a [u8],
        start: usize,
        end: usize,
        processor: Processor,
    ) -> Result<Self, C3dError> {
        let bytes = &bytes[..end.min(bytes.len())];
        let (mut groups, mut entries) = (Vec::new(), Vec::new());
        let mut at = start;
        while let Some(step) = step(bytes, at, processor)? {
            if groups.len() + entries.len() == MAX_PARAMETERS {
                return Err(C3dProblem::TooManyParameters.at(at));
            }
            let id = step.id.unsigned_abs();
            if step.id < 0 {
                groups.push((id, step.name));
            } else {
                entries.push(Entry {
                    group: id,
                    name: step.name,
                    offset: at,
                    body: step.body,
                });
            }
            let Some(next) = step.next else { break };
            at = next;
        }
        Ok(Self {
            processor,
            groups,
            entries,
        })
    }

    /// A parameter by `GROUP:NAME`.
    fn find(&self, full_name: &str) -> Option<Entry<'a>> {
        let (group, name) = full_name.split_once(':')?;
        let is_group = |id: u8| {
            let mut groups = self.groups.iter();
            groups.any(|it| it.0 == id && it.1.eq_ignore_ascii_case(group.as_bytes()))
        };
        let is_it =
            |it: &&Entry<'_>| it.name.eq_ignore_ascii_case(name.as_bytes()) && is_group(it.group);
        self.entries.iter().find(is_it).copied()
    }

    fn content(&self, name: &'static str) -> Result<Option<Content<'a>>, C3dError> {
        let Some(entry) = self.find(name) else {
            return Ok(None);
        };
        let content = entry.content().ok_or_else(|| {
            let expected = "a parameter of a known type whose data fit into it";
            C3dProblem::Parameter { name, expected }.at(entry.offset)
        })?;
        Ok(Some(content))
    }

    /// The byte at which a parameter stands, for errors about its value; the section's if it is not there.
    pub(super) fn offset(&self, name: &str) -> Option<usize> {
        self.find(name).map(|it| it.offset)
    }

    /// A number, integers without sign; `None` if the parameter is absent or empty.
    pub(super) fn number(&self, name: &'static str) -> Result<Option<f64>, C3dError> {
        let Some(content) = self.content(name)? else {
            return Ok(None);
        };
        let number = match content.kind {
            Kind::Text => {
                let expected = "a number";
                return Err(C3dProblem::Parameter { name, expected }.at(content.offset));
            }
            Kind::Byte => content.data.first().map(|&it| f64::from(it)),
            Kind::Word => self.words(content.data).next().map(f64::from),
            Kind::Real => {
                let first = content.data.first_chunk();
                first.map(|&it| f64::from(self.processor.real(it)))
            }
        };
        Ok(number)
    }

    /// A whole number, which may lie in two words, the lower first.
    pub(super) fn count(&self, name: &'static str) -> Result<Option<u32>, C3dError> {
        if let Some(content) = self.content(name)?
            && content.kind == Kind::Word
        {
            let mut words = self.words(content.data).map(u32::from);
            let low = words.next();
            return Ok(low.map(|low| low | words.next().unwrap_or(0) << 16));
        }
        let Some(number) = self.number(name)? else {
            return Ok(None);
        };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "it is whole and in range"
        )]
        let count = (number.fract().abs() <= 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number))
            .then_some(number as u32);
        let expected = "a whole number from 0";
        let offset = self.offset(name).unwrap_or_default();
        let refused = || C3dProblem::Parameter { name, expected }.at(offset);
        count.ok_or_else(refused).map(Some)
    }

    /// Texts of equal length, without what fills them up, as many as there may be markers; none if the parameter is absent.
    pub(super) fn texts(&self, name: &'static str) -> Result<Vec<String>, C3dError> {
        let Some(content) = self.content(name)? else {
            return Ok(Vec::new());
        };
        if content.kind != Kind::Text {
            let expected = "a text";
            return Err(C3dProblem::Parameter { name, expected }.at(content.offset));
        }
        let width = content.dimensions.first().map_or(1, |&it| usize::from(it));
        let texts = content.data.chunks_exact(width.max(1));
        Ok(texts.take(MAX_MARKERS).map(filled_text).collect())
    }

    fn words(&self, data: &'a [u8]) -> impl Iterator<Item = u16> {
        let processor = self.processor;
        data.as_chunks().0.iter().map(move |&it| processor.word(it))
    }
}

/// A text without the blanks or zeros that fill it up; names may be in any encoding, so what is not UTF-8 is replaced.
fn filled_text(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let is_filling = |c: char| c.is_whitespace() || c == '\0';
    text.trim_matches(is_filling).to_owned()
}

/// One link of the chain.
struct Step<'a> {
    /// Negative for a group.
    id: i8,
    name: &'a [u8],
    body: &'a [u8],
    /// Where the next begins.
    next: Option<usize>,
}

/// The link at `at`; `None` at the chain's end, which is a name without length or the end of the section.
fn step(bytes: &[u8], at: usize, processor: Processor) -> Result<Option<Step<'_>>, C3dError> {
    let cut = || C3dProblem::CutParameter.at(at);
    let rest = bytes.get(at..).unwrap_or_default();
    // A negative length locks the entry against changes, which is nothing to a reader.
    let name_bytes = match rest.first() {
        None | Some(0) => return Ok(None),
        Some(&length) => usize::from(length.cast_signed().unsigned_abs()),
    };
    let id = rest.get(1).ok_or_else(cut)?.cast_signed();
    let name = rest.get(2..2 + name_bytes).ok_or_else(cut)?;
    let way_at = at + 2 + name_bytes;
    let way = bytes.get(way_at..).and_then(<[u8]>::first_chunk);
    let way = usize::from(processor.word(*way.ok_or_else(cut)?));
    let next = (way != 0).then_some(way_at + way);
    if way == 1 {
        return Err(C3dProblem::NextParameter.at(at));
    }
    let end = next.unwrap_or(bytes.len());
    let body = bytes.get(way_at + 2..end).ok_or_else(cut)?;
    Ok(Some(Step {
        id,
        name,
        body,
        next,
    }))
}

impl<'a> Entry<'a> {
    fn content(&self) -> Option<Content<'a>> {
        let (&[kind, n_dimensions], rest) = self.body.split_first_chunk()?;
        let kind = Kind::of(kind)?;
        let (dimensions, rest) = rest.split_at_checked(usize::from(n_dimensions))?;
        let elements = (dimensions.iter())
            .try_fold(1_usize, |product, &it| product.checked_mul(usize::from(it)))?;
        let data = rest.get(..elements.checked_mul(kind.size())?)?;
        Some(Content {
            offset: self.offset,
            kind,
            dimensions,
            data,
        })
    }
}
