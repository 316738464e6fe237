//! Text of a file, with its name in faults and its language.

use std::io::Read;
use std::path::Path;

use unicode_ident::is_xid_continue;

use crate::checksum::checksum;
use crate::plain_file;

use super::diagnostic::Fault;

/// Maximum size of a file, bytes; a trajectory of hundreds of objects is smaller.
const MAX_BYTES: u64 = 1 << 28;

/// Language of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Language {
    Yaml,
    Json,
}

impl Language {
    pub fn name(self) -> &'static str {
        match self {
            Language::Yaml => "YAML",
            Language::Json => "JSON",
        }
    }
}

/// Text with its name and language.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// Name used in faults.
    pub file: &'a str,
    /// Text of the file.
    pub text: &'a str,
    pub(super) language: Language,
}

impl<'a> Source<'a> {
    /// Creates a source in YAML.
    pub fn yaml(file: &'a str, text: &'a str) -> Self {
        Self { file, text, language: Language::Yaml }
    }

    /// Creates a source in JSON if the file's name ends in `.json`, otherwise in YAML.
    pub fn of(file: &'a str, text: &'a str) -> Self {
        let json = Path::new(file).extension().is_some_and(|end| end.eq_ignore_ascii_case("json"));
        if json { Self::json(file, text) } else { Self::yaml(file, text) }
    }

    /// Creates a source in JSON.
    pub fn json(file: &'a str, text: &'a str) -> Self {
        Self { file, text, language: Language::Json }
    }
}

/// Maximum number of characters in a name.
pub(super) const LONGEST_NAME: usize = 64;

/// Returns `true` if a name may contain `c`.
pub fn is_in_names(c: char) -> bool {
    // Scripts write vowels and accents as marks after a letter.
    let is_mark = c > '\u{ff}' && !('\u{2000}'..'\u{20d0}').contains(&c) && is_xid_continue(c);
    c.is_alphanumeric() || c == '-' || c == '_' || is_mark
}

/// Returns a name for the content of a file without a `name` key: the `stem` of the file, with a
/// dash for every invalid character.
pub fn named_after(stem: &str) -> String {
    let dashed = |c: char| if is_in_names(c) { c } else { '-' };
    let name: String = stem.chars().map(dashed).take(LONGEST_NAME).collect();
    if name.is_empty() { "unnamed".to_owned() } else { name }
}

/// Returns a name for results derived from `stem`. A name that was truncated or changed ends in a
/// checksum, so that two files do not overwrite each other's results.
pub fn apart_by_name(stem: &str) -> String {
    let name = named_after(stem);
    if name == stem {
        return name;
    }
    let sum = format!("{:08x}", checksum(stem.as_bytes()) as u32);
    let kept: String = name.chars().take(LONGEST_NAME - 1 - sum.len()).collect();
    format!("{kept}-{sum}")
}

/// Reads a file; returns its name for messages and its text.
///
/// # Errors
/// Returns an error if the file cannot be read, is not UTF-8 or is far too long.
pub fn read_text(path: &Path) -> Result<(String, String), Fault> {
    let fault = |error: std::io::Error| Fault::io(path, "read the file", &error);
    let name = path.display().to_string();
    let mut text = String::new();
    plain_file::open(path)
        .map_err(fault)?
        .take(MAX_BYTES + 1)
        .read_to_string(&mut text)
        .map_err(fault)?;
    if text.len() as u64 > MAX_BYTES {
        let message = format!("the file has more than {MAX_BYTES} bytes");
        return Err(Fault::of_file(&name, message, "is this the right file?"));
    }
    Ok((name, text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_hold_the_marks_of_all_scripts() {
        let names = [
            "\u{915}\u{94d}\u{937}\u{93f}",
            "e\u{301}tui",
            "\u{e01}\u{e34}\u{e48}\u{e07}",
            "Stra\u{df}e",
        ];
        for name in names {
            assert_eq!(named_after(name), name);
        }
        assert_eq!(named_after("a\u{200b}b\u{203f}c d"), "a-b-c-d");
    }
}
