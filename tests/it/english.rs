//! Counts of places that are not plain engineering English. The ceilings may only be lowered.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::ROOT;

/// A rule: its subject, the phrases that break it, and the maximum number of places.
///
/// A phrase is a sequence of words with single spaces; `/` separates alternatives of a word, `*` is
/// any lower-case word, and a `^` requires the beginning of a line.
type Rule = (&'static str, &'static [&'static str], usize);

/// First words of a doc comment that hide its noun or verb.
const OPENINGS: [Rule; 4] = [
    ("a wh-clause", &["What/How/Where/Which/Who/Why/When"], 0),
    ("a preposition", &["Of/By/From/To/As/In/With/For/At/On/Under/Among"], 0),
    ("a back-reference", &["The same", "Those/Such/One/It/That/All"], 0),
    ("a superlative for a bound", &["Most/Fewest/Least"], 0),
];

/// Phrases for which there is a plainer one.
const PHRASES: [Rule; 8] = [
    (
        "a free relative clause",
        &[
            "What/what is/was/are/were/has/had/have/may/can/must/does/did",
            "What/what it/they/the/a/an/its/stands/lies/moves/else",
        ],
        11,
    ),
    (
        "a free relative clause after a preposition",
        &["of/for/to/from/with/in/by/on/at/after/before/than/beside/besides what"],
        0,
    ),
    (
        "speaking code",
        &["say/says/said/tell/tells/told/hear/hears/heard", "speak/speaks of", "knows of"],
        11,
    ),
    (
        "`as` for because",
        &[
            ", as it/they/that/there/the/a/an/what/no/its/this/these/those/all/only/one/most",
            ", as nothing/nobody",
        ],
        0,
    ),
    (
        "or else, go on",
        &["^Else/else", "./;/:/, Else/else", "or else", "go/goes/going/went/gone on"],
        0,
    ),
    ("a person without a name", &["nobody/somebody/anybody/whoever/everybody"], 2),
    ("a noun replaced by that or those", &["that/those of"], 3),
    (
        "a literal translation",
        &[
            "come/comes of",
            "come/comes to lie/rest/stand",
            "become/becomes of",
            "hang/hangs on/together",
            "made/make/makes of",
            "besides",
            "is/are/was/were to *",
        ],
        21,
    ),
];

/// Files in which people read sentences.
const EXTENSIONS: [&str; 4] = ["rs", "md", "py", "yaml"];

#[test]
fn doc_comments_open_with_a_noun_or_a_verb() {
    let texts = texts(&["src", "crates", "book/src", "tests", "README.md"]);
    let opening = |line: &str| -> Option<String> {
        let line = line.trim_start();
        let text = line.strip_prefix("/// ").or_else(|| line.strip_prefix("//! "));
        text.map(str::to_owned)
    };
    let opened: Vec<String> = lines(&texts).filter_map(|(_, line)| opening(line)).collect();
    let mut report = Report(Vec::new());
    for (kind, phrases, ceiling) in OPENINGS {
        let found = opened.iter().filter(|line| {
            let line = words(line);
            phrases.iter().any(|own| begins(&line, own))
        });
        report.at_most(kind, found.count(), ceiling);
    }
    report.end();
}

#[test]
fn sentences_use_plain_words() {
    let texts = texts(&["src", "crates", "book/src", "tests", "README.md"]);
    let phrases = PHRASES.iter().flat_map(|(_, phrases, _)| *phrases);
    let first = |phrase: &&'static str| phrase.trim_start_matches('^').split(' ').next();
    let firsts: HashSet<&str> =
        phrases.filter_map(first).flat_map(|word| word.split('/')).collect();
    let mut found = [0; PHRASES.len()];
    for line in lines(&texts).map(|(_, line)| words(line)) {
        for at in (0..line.len()).filter(|at| firsts.contains(line[*at])) {
            for (found, (_, phrases, _)) in found.iter_mut().zip(PHRASES) {
                *found += usize::from(phrases.iter().any(|phrase| stands(&line, at, phrase)));
            }
        }
    }
    let mut report = Report(Vec::new());
    PHRASES
        .iter()
        .zip(found)
        .for_each(|((kind, _, most), found)| report.at_most(kind, found, *most));
    report.end();
}

#[test]
fn sentences_have_at_most_30_words() {
    let texts = texts(&["book/src", "README.md", "CHANGELOG.md"]);
    let long: Vec<String> = texts.iter().flat_map(|(_, text)| long_sentences(text)).collect();
    assert!(long.is_empty(), "too long:\n{}", long.join("\n"));
}

#[test]
fn lines_have_at_most_100_columns() {
    let texts = texts(&["src", "crates", "book/src", "tests", "README.md", "CHANGELOG.md"]);
    let mut long = Vec::new();
    for (path, text) in &texts {
        let mut block = false;
        for line in text.lines() {
            // Blocks of code in pages are commands, tasks and their output.
            block ^= line.trim_start().starts_with("```") && path.ends_with(".md");
            if line.chars().count() > 100 && !block && breakable(path, line) {
                long.push(format!("{path}: {line}"));
            }
        }
    }
    let (found, listed) = (long.len(), long.join("\n"));
    assert!(found == 0, "{found} lines over 100 columns:\n{listed}");
}

/// Returns `true` if a line may be broken: it has no table, address, markup, pragma or test data.
fn breakable(path: &str, line: &str) -> bool {
    let text = line.trim_start();
    let text = text.strip_prefix("/// ").unwrap_or(text);
    let data = ["|", "- {", "- [", "<", "@\""].iter().any(|start| text.starts_with(start));
    let whole = ["http", "type: ignore"].iter().any(|part| text.contains(part));
    // Strings of tests are files and their expected messages; rustfmt breaks all other code.
    let test = path.contains("tests/") || path.ends_with("tests.rs");
    let rust_test = test && path.ends_with(".rs") && !text.starts_with("//");
    let yaml = path.ends_with(".yaml") && !text.starts_with('#');
    !(data || whole || rust_test || yaml || path.contains("tests/cmd"))
}

/// Rules that are broken more often than allowed.
struct Report(Vec<String>);

impl Report {
    fn at_most(&mut self, kind: &str, found: usize, ceiling: usize) {
        if found > ceiling {
            self.0.push(format!("{found} places with {kind}, at most {ceiling} are allowed"));
        }
    }

    /// Fails if a rule is broken too often.
    fn end(self) {
        assert!(self.0.is_empty(), "{}", self.0.join("\n"));
    }
}

/// Returns `true` if a phrase begins at this word of a line.
fn stands(line: &[&str], at: usize, phrase: &str) -> bool {
    match phrase.strip_prefix('^') {
        Some(phrase) => at == 0 && begins(line, phrase),
        None => begins(&line[at..], phrase),
    }
}

/// Returns `true` if a line begins with a phrase.
fn begins(line: &[&str], phrase: &str) -> bool {
    let Some((word, rest)) = line.split_first() else { return false };
    let (own, more) = phrase.split_once(' ').unwrap_or((phrase, ""));
    let any = own == "*" && word.chars().all(|c| c.is_ascii_lowercase());
    let first = any || own.split('/').any(|own| own == *word);
    first && (more.is_empty() || rest.first() == Some(&" ") && begins(&rest[1..], more))
}

/// Words of a line, and single characters between them.
fn words(mut line: &str) -> Vec<&str> {
    let mut found = Vec::new();
    while let Some(c) = line.chars().next() {
        let word = line.find(|c| !in_word(c)).unwrap_or(line.len());
        let (first, rest) = line.split_at(if in_word(c) { word } else { c.len_utf8() });
        found.push(first);
        line = rest;
    }
    found
}

fn in_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Sentences of a Markdown text with more than 30 words, without tables, headings and code.
fn long_sentences(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for paragraph in paragraphs(text) {
        let words: Vec<&str> = paragraph.split_whitespace().collect();
        let mut first = 0;
        for end in 1..=words.len() {
            let next = words.get(end).copied();
            let last = words[end - 1].trim_end_matches(['*', '_', ')', '"']);
            let stops = last.ends_with(['.', '!', '?']) && next.is_none_or(opens_sentence);
            if next.is_some() && !stops {
                continue;
            }
            let own = &words[first..end];
            if own.iter().filter(|word| word.contains(in_word)).count() > 30 {
                found.push(own.join(" "));
            }
            first = end;
        }
    }
    found
}

/// Returns `true` if a word may be the first of a sentence.
fn opens_sentence(word: &str) -> bool {
    let first = |c: char| c.is_ascii_uppercase() || c.is_ascii_digit() || "(`*\"".contains(c);
    word.starts_with(first) || word.starts_with("pushplan")
}

/// Paragraphs and list items of a Markdown text. Code is one word, and links are only their text.
fn paragraphs(text: &str) -> Vec<String> {
    let mut found = vec![String::new()];
    let (mut block, mut comment) = (false, false);
    for line in text.lines().map(str::trim) {
        comment |= line.starts_with("<!--");
        let skipped = comment || block || line.is_empty();
        comment &= !line.ends_with("-->");
        block ^= line.starts_with("```");
        let other = ["```", "#", "|", "![", "{{"].iter().any(|start| line.starts_with(start));
        if skipped || other {
            found.push(String::new());
            continue;
        }
        let number = line.trim_start_matches(|c: char| c.is_ascii_digit());
        let item = line.strip_prefix("- ").or_else(|| line.strip_prefix("* "));
        let item = item.or_else(|| number.strip_prefix(". ").filter(|_| number != line));
        if item.is_some() {
            found.push(String::new());
        }
        let paragraph = found.last_mut().expect("a paragraph");
        paragraph.push_str(item.unwrap_or(line));
        paragraph.push(' ');
    }
    found.iter().map(|paragraph| spoken(paragraph)).collect()
}

/// Returns a paragraph with code as single words, and without the targets of links.
fn spoken(paragraph: &str) -> String {
    let (mut code, mut rest, mut out) = (false, paragraph, String::new());
    while let Some(c) = rest.chars().next() {
        if let Some(target) = rest.strip_prefix("](").filter(|_| !code) {
            rest = target.split_once(')').map_or("", |(_, after)| after);
            continue;
        }
        code ^= c == '`';
        rest = &rest[c.len_utf8()..];
        if code || c != '[' {
            out.push(if code && " .!?:".contains(c) { '_' } else { c });
        }
    }
    out
}

/// Lines of all texts, each with the path of its file.
fn lines(texts: &[(String, String)]) -> impl Iterator<Item = (&str, &str)> {
    texts.iter().flat_map(|(path, text)| text.lines().map(move |line| (&path[..], line)))
}

/// Texts below these roots that people read, each with its path relative to the repository.
fn texts(roots: &[&str]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    roots.iter().for_each(|root| collect(&Path::new(ROOT).join(root), &mut found));
    let read = |path: &PathBuf| {
        // Some inputs of tests are no text on purpose.
        let text = String::from_utf8_lossy(&fs::read(path).expect("a file")).into_owned();
        let path = path.strip_prefix(ROOT).expect("a path below the root");
        (path.to_string_lossy().into_owned(), text)
    };
    // This file lists the words themselves.
    found.iter().filter(|path| !path.ends_with("tests/it/english.rs")).map(read).collect()
}

/// Collects the files of a folder that are read by people, in order.
fn collect(path: &Path, found: &mut Vec<PathBuf>) {
    // Pages that belong to other folders are links in the book.
    if path.is_symlink() {
        return;
    }
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
    let places = |line, phrases: &[&str]| {
        let line = words(line);
        (0..line.len()).filter(|at| phrases.iter().any(|own| stands(&line, *at, own))).count()
    };
    assert_eq!(places("It goes on. They forgo on it; he goes only.", &["goes on"]), 1);
    assert_eq!(places("else, or else; x: else", &["^else", ":/; else", "or else"]), 3);
    assert_eq!(places("is to be done, are to 2, was to go", &["is/are/was to *"]), 2);
    assert_eq!(places("fast, as it is, as is", &[", as it/the"]), 1);
    assert_eq!(places("What is. Whatever is", &["What/How is"]), 1);
}

#[test]
fn sentences_end_at_full_stops_outside_code() {
    let text_of = |count: usize| vec!["word"; count].join(" ");
    let text = format!(
        "# {0}\n\nA {0}. B [{1}](c d. E) `f. g`.\n- {2}\n",
        text_of(29),
        text_of(28),
        text_of(31)
    );
    assert_eq!(long_sentences(&text), [text_of(31)]);
    assert_eq!(long_sentences(&format!("A {}.\nB.", text_of(30))).len(), 1);
}
