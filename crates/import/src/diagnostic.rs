//! Faults and notes of an imported file.

use pushplan::asset::{self, Fault, Faults};

use super::model::Place;

/// Effect of a difference from the file on motion; notes are ordered by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Effect {
    /// Something moves differently, or a value was assumed.
    Strong,
    /// Something moves a little differently.
    Some,
    /// Hardly any effect.
    Slight,
}

/// Difference from the file that does not prevent an import.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// Effect on motion.
    pub effect: Effect,
    /// File, with line and column if they are known.
    pub at: String,
    /// Description of the difference.
    pub message: String,
}

/// Collection of the faults and notes of a file.
#[derive(Debug)]
pub(super) struct Ledger {
    /// Names of the file and of the files it includes.
    files: Vec<String>,
    /// Whether nothing may be assumed.
    strict: bool,
    faults: Vec<Fault>,
    notes: Vec<Note>,
}

impl Ledger {
    /// Creates an empty ledger for the named file and the files it includes. If it is `strict`,
    /// nothing may be assumed.
    pub fn new(file: &str, files: &[String], strict: bool) -> Self {
        let mut files = files.to_vec();
        match files.first_mut() {
            Some(first) => file.clone_into(first),
            None => files.push(file.to_owned()),
        }
        Self { files, strict, faults: Vec::new(), notes: Vec::new() }
    }

    /// Returns the names of the file and of the files it includes or attaches.
    pub fn files(&self) -> &[String] {
        &self.files
    }

    /// Adds files; returns the index of the first one.
    pub fn more_files(&mut self, files: &[String]) -> usize {
        let first = self.files.len();
        self.files.extend_from_slice(files);
        first
    }

    fn file(&self, place: Place) -> &str {
        self.files.get(place.file).map_or("", String::as_str)
    }

    /// Adds a fault.
    pub fn fault(&mut self, place: Place, message: impl Into<String>, advice: impl Into<String>) {
        let (file, message, advice) = (self.file(place).to_owned(), message.into(), advice.into());
        let Place { line, column, .. } = place;
        let place = Some(asset::Place { line, column });
        self.faults.push(Fault { file, place, message, advice });
    }

    /// Adds a fault that concerns the whole file.
    pub fn fault_of_file(&mut self, message: impl Into<String>, advice: impl Into<String>) {
        self.faults.push(Fault::of_file(&self.files[0], message, advice));
    }

    /// Adds a note on the element at a place.
    pub fn note(&mut self, place: Place, message: impl AsRef<str>) {
        self.note_as(Effect::Some, place, message);
    }

    /// Adds a note with this effect.
    pub fn note_as(&mut self, effect: Effect, place: Place, message: impl AsRef<str>) {
        let Place { line, column, .. } = place;
        let at = format!("{}:{line}:{column}", self.file(place));
        self.note_all(&[Note { effect, at, message: message.as_ref().to_owned() }]);
    }

    /// Assumes something that the file leaves open, with a note on the element at a place or on the
    /// whole file. Returns `false` without a note if nothing may be assumed: the file is then read
    /// as it is, and the open point is a fault.
    pub fn assume(
        &mut self,
        effect: Effect,
        place: impl Into<Option<Place>>,
        note: impl AsRef<str>,
    ) -> bool {
        if !self.strict {
            match place.into() {
                Some(place) => self.note_as(effect, place, note),
                None => self.note_of_file(effect, note.as_ref()),
            }
        }
        !self.strict
    }

    /// Returns `true` if nothing may be assumed.
    pub fn is_strict(&self) -> bool {
        self.strict
    }

    /// Adds a note on the whole file.
    pub fn note_of_file(&mut self, effect: Effect, message: impl Into<String>) {
        self.notes.push(Note { effect, at: self.files[0].clone(), message: message.into() });
    }

    /// Returns the number of faults.
    pub fn count(&self) -> usize {
        self.faults.len()
    }

    /// Returns the number of notes.
    pub fn notes(&self) -> usize {
        self.notes.len()
    }

    /// Removes and returns all notes after the first `count`.
    pub fn notes_since(&mut self, count: usize) -> Vec<Note> {
        self.notes.split_off(count)
    }

    /// Adds notes found earlier.
    pub fn note_all(&mut self, notes: &[Note]) {
        for note in notes {
            if !self.notes.contains(note) {
                self.notes.push(note.clone());
            }
        }
    }

    /// Removes and returns all faults after the first `count`.
    pub fn since(&mut self, count: usize) -> Vec<Fault> {
        self.faults.split_off(count)
    }

    /// Adds faults found earlier.
    pub fn take(&mut self, faults: &[Fault]) {
        self.faults.extend_from_slice(faults);
    }

    /// Adds faults that do not affect the import in a single note.
    pub fn pass_over(&mut self, faults: &[Fault], of: &str) {
        let Some(first) = faults.first() else { return };
        let place = first.place.map_or(String::new(), |at| format!(":{}:{}", at.line, at.column));
        let message = match faults.len() {
            1 => format!(
                "{of} contains an element that cannot be imported and is ignored: {}",
                first.message
            ),
            count => format!(
                "{of} contains elements that cannot be imported and are ignored: {}, and {} more",
                first.message,
                count - 1
            ),
        };
        let at = format!("{}{place}", first.file);
        self.notes.push(Note { effect: Effect::Some, at, message });
    }

    /// Adds the faults of the converted result; their places are dropped, because they refer to an
    /// internal text.
    pub fn adopt(&mut self, kind: &str, faults: Faults) {
        for Fault { message, advice, .. } in faults.0 {
            self.fault_of_file(format!("as a {kind}: {message}"), advice);
        }
    }

    /// Returns the result with all notes.
    ///
    /// # Errors
    /// Returns all faults, if any.
    pub fn finish<T>(self, made: Option<T>) -> Result<(T, Vec<Note>), Faults> {
        match made {
            Some(made) if self.faults.is_empty() => Ok((made, self.notes)),
            _ => Err(self.faults()),
        }
    }

    /// Checks that there is no fault.
    ///
    /// # Errors
    /// Returns all faults so far.
    pub fn sound(self) -> Result<Self, Faults> {
        if self.faults.is_empty() { Ok(self) } else { Err(self.faults()) }
    }

    fn faults(mut self) -> Faults {
        if self.faults.is_empty() {
            // A failed import normally has a fault; this is the fallback.
            self.fault_of_file("the file cannot be imported", "");
        }
        // Faults of the file itself precede faults of included files.
        let files = self.files.clone();
        let order = |fault: &Fault| files.iter().position(|file| *file == fault.file);
        self.faults.sort_by_key(|fault| (order(fault), fault.place));
        Faults(self.faults)
    }
}

/// Returns notes as lines, those with a strong effect first, and equal ones together.
pub(super) fn lines(mut notes: Vec<Note>) -> Vec<String> {
    notes.sort_by_key(|note| note.effect);
    let mut lines: Vec<(Note, usize)> = Vec::new();
    for note in notes {
        match lines.iter_mut().find(|(first, _)| first.message == note.message) {
            Some((_, count)) => *count += 1,
            None => lines.push((note, 1)),
        }
    }
    let line = |(Note { at, message, .. }, count): (Note, usize)| match count {
        1 => format!("{at}: {message}"),
        count => format!("{at}: {message} (also at {} other places)", count - 1),
    };
    lines.into_iter().map(line).collect()
}
