//! What lasts from one frame to the next, written down as named numbers and read back bit for bit.
//!
//! One function of a thing with a state names all that lasts, and serves both ways: what is written is what is read, so the
//! two cannot differ. Reading checks names, lengths and values: it may come from a file.

/// The numbers of one field.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Entry {
    /// Its place: `solver.joint.free`.
    pub name: String,
    /// Finite numbers.
    pub reals: Vec<f64>,
    /// Counts, places and flags.
    pub integers: Vec<u64>,
}

/// Why numbers cannot be read back.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TapeError {
    /// Another field stands there.
    #[error("expected the numbers of {expected}, found {}", found.as_deref().unwrap_or("the end"))]
    Name {
        /// What is read.
        expected: String,
        /// What is there.
        found: Option<String>,
    },
    /// There are more or fewer of them.
    #[error("{name} has {found} numbers, expected {expected}")]
    Length {
        /// Which field.
        name: String,
        /// How many it has.
        found: usize,
        /// How many it must have, or may have at most.
        expected: usize,
    },
    /// One of them cannot be.
    #[error("{name} has a number that it cannot have")]
    Value {
        /// Which field.
        name: String,
    },
}

/// Fields in order: being written, or being read.
#[derive(Debug)]
pub(crate) struct Tape {
    entries: Vec<Entry>,
    /// What is read next; `None` while it is written.
    next: Option<usize>,
    scope: String,
}

impl Tape {
    /// To be written.
    pub fn blank() -> Self {
        Self {
            entries: Vec::new(),
            next: None,
            scope: String::new(),
        }
    }

    /// To be read.
    pub fn recorded(entries: Vec<Entry>) -> Self {
        Self {
            next: Some(0),
            entries,
            scope: String::new(),
        }
    }

    /// What was written.
    pub fn into_entries(self) -> Vec<Entry> {
        self.entries
    }

    /// Whether fields are given their values rather than written down.
    pub fn is_read(&self) -> bool {
        self.next.is_some()
    }

    /// Nothing more is read.
    pub fn end(self) -> Result<(), TapeError> {
        let left = self.entries.into_iter().skip(self.next.unwrap_or_default());
        match left.map(|it| it.name).next() {
            None => Ok(()),
            found => Err(TapeError::Name {
                expected: "the end".to_owned(),
                found,
            }),
        }
    }

    /// The fields of a part.
    pub fn within<T>(
        &mut self,
        part: &str,
        fields: impl FnOnce(&mut Self) -> Result<T, TapeError>,
    ) -> Result<T, TapeError> {
        let n_bytes = self.scope.len();
        self.scope.push_str(part);
        self.scope.push('.');
        let result = fields(self);
        self.scope.truncate(n_bytes);
        result
    }

    fn full(&self, name: &str) -> String {
        format!("{}{name}", self.scope)
    }

    /// That the field of this name has a value that it cannot have.
    pub fn wrong(&self, name: &str) -> TapeError {
        TapeError::Value {
            name: self.full(name),
        }
    }

    /// Writes numbers, or reads as many as `expects` allows.
    pub fn entry(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut Entry),
        expects: impl FnOnce(usize, usize) -> Result<(), usize>,
    ) -> Result<Option<Entry>, TapeError> {
        let name = self.full(name);
        let Some(next) = &mut self.next else {
            let mut entry = Entry {
                name,
                ..Entry::default()
            };
            write(&mut entry);
            self.entries.push(entry);
            return Ok(None);
        };
        let found = self.entries.get_mut(*next).map(std::mem::take);
        *next += 1;
        let Some(entry) = found.as_ref().filter(|it| it.name == name) else {
            return Err(TapeError::Name {
                expected: name,
                found: found.map(|it| it.name),
            });
        };
        let (n_reals, n_integers) = (entry.reals.len(), entry.integers.len());
        if let Err(expected) = expects(n_reals, n_integers) {
            return Err(TapeError::Length {
                name,
                found: n_reals + n_integers,
                expected,
            });
        }
        if !entry.reals.iter().all(|it| it.is_finite()) {
            return Err(TapeError::Value { name });
        }
        Ok(found)
    }

    /// Numbers of a fixed count.
    pub fn reals(&mut self, name: &str, values: &mut [f64]) -> Result<(), TapeError> {
        let n = values.len();
        let exactly = |reals, integers| expect(reals == n && integers == 0, n);
        let write = |it: &mut Entry| it.reals.extend_from_slice(values);
        if let Some(found) = self.entry(name, write, exactly)? {
            values.copy_from_slice(&found.reals);
        }
        Ok(())
    }

    /// One number.
    pub fn real(&mut self, name: &str, value: &mut f64) -> Result<(), TapeError> {
        self.reals(name, std::slice::from_mut(value))
    }

    /// Counts of a fixed count.
    pub fn integers(&mut self, name: &str, values: &mut [u64]) -> Result<(), TapeError> {
        let n = values.len();
        let exactly = |reals, integers| expect(integers == n && reals == 0, n);
        let write = |it: &mut Entry| it.integers.extend_from_slice(values);
        if let Some(found) = self.entry(name, write, exactly)? {
            values.copy_from_slice(&found.integers);
        }
        Ok(())
    }

    /// One count.
    pub fn integer(&mut self, name: &str, value: &mut u64) -> Result<(), TapeError> {
        self.integers(name, std::slice::from_mut(value))
    }

    /// One count that fits fewer bits.
    pub fn small(&mut self, name: &str, value: &mut u32) -> Result<(), TapeError> {
        let mut wide = u64::from(*value);
        self.integer(name, &mut wide)?;
        *value = u32::try_from(wide).map_err(|_| self.wrong(name))?;
        Ok(())
    }

    /// A count, or none.
    pub fn maybe_integer(&mut self, name: &str, value: &mut Option<u64>) -> Result<(), TapeError> {
        let at_most_one = |reals, integers| expect(integers <= 1 && reals == 0, 1);
        let present = *value;
        let write = |it: &mut Entry| it.integers.extend(present);
        if let Some(found) = self.entry(name, write, at_most_one)? {
            *value = found.integers.first().copied();
        }
        Ok(())
    }

    /// Yes or no, of a fixed count.
    pub fn flags(&mut self, name: &str, values: &mut [bool]) -> Result<(), TapeError> {
        let mut numbers: Vec<u64> = values.iter().map(|it| u64::from(*it)).collect();
        self.integers(name, &mut numbers)?;
        if numbers.iter().any(|it| *it > 1) {
            return Err(self.wrong(name));
        }
        for (value, number) in values.iter_mut().zip(numbers) {
            *value = number == 1;
        }
        Ok(())
    }

    /// Yes or no.
    pub fn flag(&mut self, name: &str, value: &mut bool) -> Result<(), TapeError> {
        self.flags(name, std::slice::from_mut(value))
    }

    /// Places below `bound`, each at most once.
    pub fn places(
        &mut self,
        name: &str,
        values: &mut Vec<usize>,
        bound: usize,
    ) -> Result<(), TapeError> {
        let at_most = |reals, integers| expect(integers <= bound && reals == 0, bound);
        let write = |it: &mut Entry| it.integers.extend(values.iter().map(|it| *it as u64));
        let Some(found) = self.entry(name, write, at_most)? else {
            return Ok(());
        };
        let mut is_taken = vec![false; bound];
        values.clear();
        for number in found.integers {
            let place = usize::try_from(number).ok().filter(|it| *it < bound);
            let place = place.ok_or_else(|| self.wrong(name))?;
            if std::mem::replace(&mut is_taken[place], true) {
                return Err(self.wrong(name));
            }
            values.push(place);
        }
        Ok(())
    }
}

/// `Err` with what is expected.
pub(crate) fn expect(holds: bool, expected: usize) -> Result<(), usize> {
    if holds { Ok(()) } else { Err(expected) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fields(
        tape: &mut Tape,
        x: &mut [f64],
        free: &mut Vec<usize>,
        is_settled: &mut bool,
    ) -> Result<(), TapeError> {
        tape.within("qp", |tape| {
            tape.reals("x", x)?;
            tape.places("free", free, 4)?;
            tape.flag("is_settled", is_settled)
        })
    }

    fn written() -> Vec<Entry> {
        let mut tape = Tape::blank();
        fields(
            &mut tape,
            &mut [0.25, -0.0, 1e-300],
            &mut vec![3, 0],
            &mut true,
        )
        .unwrap();
        tape.into_entries()
    }

    fn read(entries: Vec<Entry>) -> Result<([f64; 3], Vec<usize>, bool), TapeError> {
        let mut tape = Tape::recorded(entries);
        let (mut x, mut free, mut is_settled) = ([9.0; 3], vec![1], false);
        fields(&mut tape, &mut x, &mut free, &mut is_settled)?;
        tape.end()?;
        Ok((x, free, is_settled))
    }

    #[test]
    fn what_was_written_is_read_back_bit_for_bit() {
        let (x, free, is_settled) = read(written()).unwrap();
        assert_eq!(
            x.map(f64::to_bits),
            [0.25_f64, -0.0, 1e-300].map(f64::to_bits)
        );
        assert_eq!((free, is_settled), (vec![3, 0], true));
    }

    #[test]
    fn what_is_not_as_it_was_written_is_refused_by_name() {
        let check = |change: fn(&mut Vec<Entry>), expected: &str| {
            let mut entries = written();
            change(&mut entries);
            let error = read(entries).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        };
        check(
            |it| it[0].reals[1] = f64::NAN,
            "qp.x has a number that it cannot have",
        );
        check(
            |it| it[0].reals.truncate(2),
            "qp.x has 2 numbers, expected 3",
        );
        check(|it| it[1].integers[0] = 4, "qp.free has a number");
        check(|it| it[1].integers[0] = 0, "qp.free has a number");
        check(|it| it[2].integers[0] = 2, "qp.is_settled has a number");
        check(
            |it| drop(it.pop()),
            "expected the numbers of qp.is_settled, found the end",
        );
        check(
            |it| it.swap(0, 1),
            "expected the numbers of qp.x, found qp.free",
        );
        check(|it| it.push(Entry::default()), "expected the numbers of");
    }
}
