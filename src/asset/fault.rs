//! Faults of user files: where, what was expected and found, and what to try.

use std::fmt;
use std::path::Path;

use super::printable::printable;

/// A line and a column, both counted from one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Line.
    pub line: usize,
    /// Column, in characters.
    pub column: usize,
}

impl Place {
    /// Where serde_json means in `text`: it counts bytes, and gives column 0 of the next line for
    /// the end of a line.
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

/// One thing that is wrong with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The file as the user named it.
    pub file: String,
    /// Where in the file; `None` if the fault is of the file as a whole.
    pub place: Option<Place>,
    /// What was expected and what was found.
    pub message: String,
    /// What to try; may be empty.
    pub advice: String,
}

impl Fault {
    /// A fault of the whole of `file`.
    pub fn of_file(file: &str, message: impl Into<String>, advice: impl Into<String>) -> Self {
        Self { file: file.into(), place: None, message: message.into(), advice: advice.into() }
    }

    /// A file that cannot be read or written.
    pub fn io(path: &Path, doing: &str, error: &std::io::Error) -> Self {
        use std::io::ErrorKind;
        let advice = match error.kind() {
            ErrorKind::NotFound => "check the path; it is relative to the folder you are in",
            ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
                "check the permissions, or name another folder"
            }
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
                "free some space, or name a folder on another disk"
            }
            ErrorKind::IsADirectory => "name a file, not a folder",
            ErrorKind::InvalidData => "the file must be text in UTF-8",
            _ => "",
        };
        Self::of_file(&path.display().to_string(), format!("cannot {doing}: {error}"), advice)
    }
}

impl fmt::Display for Fault {
    /// As lines for a terminal: words of the file stay words, see [`printable`].
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

/// Everything that is wrong with one or more files; never empty when returned as an error.
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

/// The text of [`Display`](fmt::Display), so that it reads well when it leaves `main`.
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

/// Advice that names the known word nearest to `word`, or else all of them.
pub(super) fn did_you_mean<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let nearest = known.iter().map(|k| (edit_distance(word, k), *k)).min();
    match nearest {
        // A third of the letters wrong still looks like a slip rather than another word.
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

/// `a`, `a or b`, `a, b or c`.
pub(super) fn one_of(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}

/// Returns the number of single-letter insertions, deletions, replacements and swaps of neighbours that
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
        // Bytes: a quote, two letters of two bytes, an x.
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
