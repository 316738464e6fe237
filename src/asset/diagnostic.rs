//! Faults in user files: place, expected and found content, and advice.

use std::fmt;
use std::path::Path;

use super::printable::printable;

/// Line and column, both counted from one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Line number.
    pub line: usize,
    /// Column, in characters.
    pub column: usize,
}

impl Place {
    /// Converts an error position of serde_json in `text`. serde_json counts bytes and reports the
    /// end of a line as column 0 of the next line.
    pub(super) fn in_json(text: &str, line: usize, column: usize) -> Self {
        let line = line.max(1);
        let words = |line: usize| text.split('\n').nth(line - 1).unwrap_or_default();
        if column == 0 {
            let line = (line - 1).max(1);
            return Self { line, column: words(line).chars().count() + 1 };
        }
        let before = words(line).char_indices().take_while(|(at, _)| *at + 1 < column);
        Self { line, column: before.count() + 1 }
    }
}

/// Single fault in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// File name as given by the user.
    pub file: String,
    /// Position in the file; `None` if the fault concerns the whole file.
    pub place: Option<Place>,
    /// Expected and found content.
    pub message: String,
    /// Suggested fix; may be empty.
    pub advice: String,
}

impl Fault {
    /// Creates a fault that concerns the whole of `file`.
    pub fn of_file(file: &str, message: impl Into<String>, advice: impl Into<String>) -> Self {
        Self { file: file.into(), place: None, message: message.into(), advice: advice.into() }
    }

    /// Creates a fault for a file that cannot be read or written.
    pub fn io(path: &Path, doing: &str, error: &std::io::Error) -> Self {
        use std::io::ErrorKind;
        let advice = match error.kind() {
            ErrorKind::NotFound => "check the path; it is relative to the current folder",
            ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
                "check the permissions, or name another folder"
            }
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
                "free some space, or name a folder on another disk"
            }
            ErrorKind::IsADirectory => "name a file, not a folder",
            ErrorKind::InvalidInput => {
                "name a plain file; write the output of another program to a file first"
            }
            ErrorKind::InvalidData => "the file must be text in UTF-8",
            _ => "",
        };
        Self::of_file(&path.display().to_string(), format!("cannot {doing}: {error}"), advice)
    }
}

impl fmt::Display for Fault {
    /// Formats the fault for a terminal, with text of the file escaped by [`printable`].
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", printable(&self.file))?;
        if let Some(place) = self.place {
            write!(f, ":{}:{}", place.line, place.column)?;
        }
        write!(f, ": error: {}", printable(&self.message))?;
        if !self.advice.is_empty() {
            write!(f, "\n  help: {}", printable(&self.advice))?;
        }
        Ok(())
    }
}

/// Returns all faults of one or more files; never empty when returned as an error.
#[derive(Clone, Default, PartialEq, Eq)]
pub struct Faults(pub Vec<Fault>);

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, fault) in self.0.iter().enumerate() {
            if k > 0 {
                writeln!(f)?;
            }
            write!(f, "{fault}")?;
        }
        Ok(())
    }
}

/// Delegates to [`Display`](fmt::Display), so that an error returned from `main` is readable.
impl fmt::Debug for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for Faults {}

impl From<Fault> for Faults {
    fn from(fault: Fault) -> Self {
        Faults(vec![fault])
    }
}

/// Returns advice that names the known word nearest to `word`, or lists all known words if none is
/// near.
pub(super) fn did_you_mean<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let nearest = known.iter().map(|k| (edit_distance(word, k), *k)).min();
    match nearest {
        // Up to a third of the letters may differ; beyond that it is another word, not a typing
        // error.
        Some((distance, name)) if distance <= 1 + name.chars().count() / 3 => {
            format!("did you mean `{name}`?")
        }
        Some(_) => {
            let names: Vec<String> = known.iter().map(|k| format!("`{k}`")).collect();
            format!("use {}", one_of(&names))
        }
        None => String::new(),
    }
}

/// Formats a list as `a`, `a or b` or `a, b or c`.
pub(super) fn one_of(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}

/// Returns the number of insertions, deletions, replacements and swaps of adjacent letters that
/// turn `a` into `b`, ignoring case.
fn edit_distance(a: &str, b: &str) -> usize {
    strsim::osa_distance(&a.to_lowercase(), &b.to_lowercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_recognised_and_other_words_are_not() {
        let known = ["position", "yaw_deg", "friction"];
        assert_eq!(did_you_mean("positon", known), "did you mean `position`?");
        assert_eq!(did_you_mean("yaw", known), "use `position`, `yaw_deg` or `friction`");
        assert_eq!(edit_distance("mass", "amss"), 1);
        assert_eq!(did_you_mean("x", []), "");
    }

    #[test]
    fn places_in_json_count_characters_and_lines_have_ends() {
        let place = |line, column| {
            let Place { line, column } = Place::in_json("\"\u{e9}\u{e9}x\n\"y\"", line, column);
            (line, column)
        };
        // Byte offsets: a quote, two letters of two bytes each, an x.
        assert_eq!([place(1, 1), place(1, 6), place(2, 2)], [(1, 1), (1, 4), (2, 2)]);
        assert_eq!(place(2, 0), (1, 5), "the end of the first line");
        assert_eq!(place(1, 0), (1, 5), "an end without a beginning");
        assert_eq!(place(9, 7), (9, 1), "behind the end");
    }

    #[test]
    fn a_fault_reads_like_a_compiler_message() {
        let fault = Fault {
            file: "tasks/x.yaml".into(),
            place: Some(Place { line: 12, column: 7 }),
            message: "unknown key `masss`".into(),
            advice: "did you mean `mass`?".into(),
        };
        assert_eq!(
            fault.to_string(),
            "tasks/x.yaml:12:7: error: unknown key `masss`\n  help: did you mean `mass`?"
        );
    }
}
