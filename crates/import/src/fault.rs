//! Faults and notes of a file that is imported.

use pushplan::asset::{self, Fault, Faults};

use super::model::Place;

/// Collects what is wrong with a file, and what is expressed slightly differently.
#[derive(Debug)]
pub(super) struct Ledger {
    /// The file, and those that it includes.
    files: Vec<String>,
    faults: Vec<Fault>,
    notes: Vec<String>,
}

impl Ledger {
    /// Nothing yet of the file of that name, and of those that it includes.
    pub fn new(file: &str, files: &[String]) -> Self {
        let mut files = files.to_vec();
        match files.first_mut() {
            Some(first) => file.clone_into(first),
            None => files.push(file.to_owned()),
        }
        Self { files, faults: Vec::new(), notes: Vec::new() }
    }

    /// The file, and those that it includes and attaches.
    pub fn files(&self) -> &[String] {
        &self.files
    }

    /// More files, and at which index they begin.
    pub fn more_files(&mut self, files: &[String]) -> usize {
        let first = self.files.len();
        self.files.extend_from_slice(files);
        first
    }

    fn file(&self, place: Place) -> &str {
        self.files.get(place.file).map_or("", String::as_str)
    }

    /// One more fault.
    pub fn fault(&mut self, place: Place, message: impl Into<String>, advice: impl Into<String>) {
        let (file, message, advice) = (self.file(place).to_owned(), message.into(), advice.into());
        let Place { line, column, .. } = place;
        let place = Some(asset::Place { line, column });
        self.faults.push(Fault { file, place, message, advice });
    }

    /// One more fault, of the file as a whole.
    pub fn fault_of_file(&mut self, message: impl Into<String>, advice: impl Into<String>) {
        self.faults.push(Fault::of_file(&self.files[0], message, advice));
    }

    /// Something that people should know about the element at a place.
    pub fn note(&mut self, place: Place, message: impl AsRef<str>) {
        let Place { line, column, .. } = place;
        let note = format!("{}:{line}:{column}: {}", self.file(place), message.as_ref());
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// A note on the file as a whole.
    pub fn note_of_file(&mut self, message: impl AsRef<str>) {
        self.notes.push(format!("{}: {}", self.files[0], message.as_ref()));
    }

    /// How many faults there are.
    pub fn count(&self) -> usize {
        self.faults.len()
    }

    /// How many notes there are.
    pub fn notes(&self) -> usize {
        self.notes.len()
    }

    /// Takes back all notes but the first `count`.
    pub fn notes_since(&mut self, count: usize) -> Vec<String> {
        self.notes.split_off(count)
    }

    /// Takes over notes that were made earlier.
    pub fn note_all(&mut self, notes: &[String]) {
        for note in notes {
            if !self.notes.contains(note) {
                self.notes.push(note.clone());
            }
        }
    }

    /// Takes back all faults but the first `count`.
    pub fn since(&mut self, count: usize) -> Vec<Fault> {
        self.faults.split_off(count)
    }

    /// Takes over faults that were found earlier.
    pub fn take(&mut self, faults: &[Fault]) {
        self.faults.extend_from_slice(faults);
    }

    /// Faults that do not matter to what is imported, as one note.
    pub fn pass_over(&mut self, faults: &[Fault], of: &str) {
        let Some(first) = faults.first() else { return };
        let place = first.place.map_or(String::new(), |at| format!("{}:{}:", at.line, at.column));
        let note = match faults.len() {
            1 => format!("{of} is passed over, which cannot be imported: {}", first.message),
            count => format!(
                "{of} is passed over, which cannot be imported: {}, and {} other faults",
                first.message,
                count - 1
            ),
        };
        self.notes.push(format!("{}:{place} {note}", first.file));
    }

    /// The faults of the finished thing, as it would stand in a file of ours: places in that are of
    /// no use to anybody.
    pub fn adopt(&mut self, kind: &str, faults: Faults) {
        for Fault { message, advice, .. } in faults.0 {
            self.fault_of_file(format!("as a {kind}: {message}"), advice);
        }
    }

    /// What was made, with all notes.
    ///
    /// # Errors
    /// All faults, if there is any.
    pub fn finish<T>(self, made: Option<T>) -> Result<(T, Vec<String>), Faults> {
        match made {
            Some(made) if self.faults.is_empty() => Ok((made, self.notes)),
            _ => Err(self.faults()),
        }
    }

    /// Ends early if there is a fault.
    ///
    /// # Errors
    /// All faults so far.
    pub fn sound(self) -> Result<Self, Faults> {
        if self.faults.is_empty() { Ok(self) } else { Err(self.faults()) }
    }

    fn faults(mut self) -> Faults {
        if self.faults.is_empty() {
            // Whatever gives up says why; this is for a case that was forgotten.
            self.fault_of_file("the file cannot be imported", "");
        }
        // Those of the file itself before those of files that it includes.
        let files = self.files.clone();
        let order = |fault: &Fault| files.iter().position(|file| *file == fault.file);
        self.faults.sort_by_key(|fault| (order(fault), fault.place));
        Faults(self.faults)
    }
}
