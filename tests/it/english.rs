//! Counts of sentences that are no plain engineering English. The ceilings may only be lowered.

use std::fs;
use std::path::{Path, PathBuf};

use crate::ROOT;

/// First words of a doc comment that hide its noun or verb, and the number of such comments allowed.
const OPENINGS: [(&str, &[&str], usize); 4] = [
    ("a wh-clause", &["What", "How", "Where", "Which", "Who", "Why", "When"], 2011),
    (
        "a preposition",
        &["Of", "By", "From", "To", "As", "In", "With", "For", "At", "On", "Under", "Among"],
        432,
    ),
    ("a back-reference", &["The same", "Those", "Such", "One", "It", "That", "All"], 517),
    ("a superlative for a bound", &["Most", "Fewest", "Least"], 46),
];

/// Words after `, as ` where *because* is meant, and the number of such places allowed.
const CAUSES: (&[&str], usize) = (
    &[
        "it", "they", "that", "there", "the", "a", "an", "what", "no", "its", "this", "these",
        "those", "all", "only", "one", "nothing", "nobody", "most",
    ],
    175,
);

/// Phrases for which there is a plainer word (*otherwise*, *continue*), and the number allowed.
const PHRASES: (&[&str], usize) =
    (&["or else", "go on", "goes on", "going on", "gone on", "went on"], 152);

/// Files in which people read sentences.
const EXTENSIONS: [&str; 4] = ["rs", "md", "py", "yaml"];

#[test]
fn doc_comments_open_with_a_noun_or_a_verb() {
    let texts = texts();
    let opening = |line: &str| {
        let line = line.trim_start();
        let text = line.strip_prefix("/// ").or_else(|| line.strip_prefix("//! "));
        text.map(str::to_owned)
    };
    let opened: Vec<String> =
        texts.iter().flat_map(|text| text.lines().filter_map(opening)).collect();
    for (kind, words, ceiling) in OPENINGS {
        let found = opened.iter().filter(|line| words.iter().any(|word| starts(line, word)));
        at_most(kind, found.count(), ceiling);
    }
}

#[test]
fn causes_and_continuations_have_their_own_words() {
    let texts = texts();
    let cause = |text: &str| {
        let after = text.split(", as ").skip(1);
        after.filter(|rest| CAUSES.0.iter().any(|word| starts(rest, word))).count()
    };
    let phrase = |text: &str| PHRASES.0.iter().map(|phrase| whole(text, phrase)).sum::<usize>();
    at_most("`as` for because", texts.iter().map(|text| cause(text)).sum(), CAUSES.1);
    at_most("or else, go on", texts.iter().map(|text| phrase(text)).sum(), PHRASES.1);
}

/// Fails if there are more places than allowed.
fn at_most(kind: &str, found: usize, ceiling: usize) {
    assert!(found <= ceiling, "{found} places with {kind}, at most {ceiling} are allowed");
}

/// Returns `true` if a line starts with a word or phrase.
fn starts(line: &str, word: &str) -> bool {
    let rest = line.strip_prefix(word);
    rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
}

/// Number of places where a phrase stands between word boundaries.
fn whole(text: &str, phrase: &str) -> usize {
    let letter = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    let alone = |(at, _): &(usize, &str)| {
        let (before, after) = (&text[..*at], &text[at + phrase.len()..]);
        !letter(before.chars().next_back()) && !letter(after.chars().next())
    };
    text.match_indices(phrase).filter(alone).count()
}

/// Texts of all sources, tests and pages of the book.
fn texts() -> Vec<String> {
    let mut found = Vec::new();
    for root in ["src", "crates", "book/src", "tests", "README.md"] {
        collect(&Path::new(ROOT).join(root), &mut found);
    }
    // This file lists the words themselves.
    let own = Path::new(ROOT).join("tests/it/english.rs");
    found.retain(|path| *path != own);
    // Some inputs of tests are no text on purpose.
    let text =
        |path: &PathBuf| String::from_utf8_lossy(&fs::read(path).expect("a file")).into_owned();
    found.iter().map(text).collect()
}

/// Collects the files of a folder that are read by people, in order.
fn collect(path: &Path, found: &mut Vec<PathBuf>) {
    if path.is_dir() {
        let entries = fs::read_dir(path).expect("a folder");
        let mut paths: Vec<PathBuf> =
            entries.map(|entry| entry.expect("an entry").path()).collect();
        paths.sort();
        let hidden = |path: &PathBuf| path.ends_with("target") || path.ends_with("node_modules");
        paths.iter().filter(|path| !hidden(path)).for_each(|path| collect(path, found));
    } else if EXTENSIONS.iter().any(|kind| path.extension().is_some_and(|own| own == *kind)) {
        found.push(path.to_owned());
    }
}

#[test]
fn phrases_are_counted_between_word_boundaries() {
    assert_eq!(whole("It goes on. They forgo on it; he goes only.", "goes on"), 1);
    assert!(starts("What is", "What") && !starts("Whatever", "What"));
}
