//! Faults and notes of a file that is imported.

use crate::asset::{Fault, Faults, Place};

/// Collects what is wrong with a file, and what is expressed slightly differently.
#[derive(Debug)]
pub(super) struct Ledger {
    file: String,
    faults: Vec<Fault>,
    notes: Vec<String>,
}

impl Ledger {
    /// Nothing yet of the file of that name.
    pub fn new(file: &str) -> Self {
        Self { file: file.to_owned(), faults: Vec::new(), notes: Vec::new() }
    }

    /// One more fault.
    pub fn fault(&mut self, place: Place, message: impl Into<String>, advice: impl Into<String>) {
        let place = Some(place);
        let (file, message, advice) = (self.file.clone(), message.into(), advice.into());
        self.faults.push(Fault { file, place, message, advice });
    }

    /// One more fault, of the file as a whole.
    pub fn fault_of_file(&mut self, message: impl Into<String>, advice: impl Into<String>) {
        self.faults.push(Fault::of_file(&self.file, message, advice));
    }

    /// Something that people should know about the element at a place.
    pub fn note(&mut self, place: Place, message: impl AsRef<str>) {
        let Place { line, column } = place;
        let note = format!("{}:{line}:{column}: {}", self.file, message.as_ref());
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
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
        self.faults.sort_by_key(|fault| fault.place);
        Faults(self.faults)
    }
}
