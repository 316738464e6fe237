//! Positions of values in a text.

use std::ops::Range;

use pushplan::asset::{Content, Node, Place, Source, locate};

/// Returns the byte range of a node. Returns `None` where its end is known only to a full parser:
/// words over several lines, anchors. `flow` states whether brackets surround the node.
pub fn span(source: Source, node: &Node, flow: bool) -> Option<Range<usize>> {
    let start = start(source, node)?;
    let text = source.text;
    let end = match (text[start..].chars().next()?, &node.content) {
        ('[' | '{', _) => closing(text, start)? + 1,
        ('"' | '\'', Content::Text(_)) => end_of_quotes(text, start)?,
        ('|' | '>' | '&' | '*' | '!', _) => return None,
        (_, Content::List(_) | Content::Map(_)) => end_of_block(text, start, &node.content),
        _ => end_of_word(text, start, flow),
    };
    Some(start..end)
}

/// Returns the byte at which a node begins.
pub fn start(source: Source, node: &Node) -> Option<usize> {
    let Place { line, column } = locate(source, node.id)?;
    let begin = line_starts(source.text).nth(line - 1)?;
    let line = &source.text[begin..];
    let place = line.char_indices().nth(column - 1).map_or(line.len(), |(at, _)| at);
    Some(begin + place)
}

/// Returns `true` if a node has brackets of its own.
pub fn is_flow(text: &str, start: usize) -> bool {
    text[start..].starts_with(['[', '{'])
}

/// Returns the byte at which the line of `at` begins.
pub fn line_start(text: &str, at: usize) -> usize {
    text[..at].rfind('\n').map_or(0, |end| end + 1)
}

/// Returns the byte behind the line of `at`, its end included.
pub fn line_end(text: &str, at: usize) -> usize {
    text[at..].find('\n').map_or(text.len(), |end| at + end + 1)
}

fn line_starts(text: &str) -> impl Iterator<Item = usize> {
    std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1))
}

/// Returns the position of the bracket that closes the one at `start`.
fn closing(text: &str, start: usize) -> Option<usize> {
    let mut depth = 0;
    let mut at = start;
    let mut before = ' ';
    while let Some(letter) = text[at..].chars().next() {
        match letter {
            '[' | '{' => depth += 1,
            ']' | '}' => {
                depth -= 1;
                if depth == 0 {
                    return Some(at);
                }
            }
            // Within a word a quote is a letter.
            '"' | '\'' if before.is_whitespace() || "[{,:".contains(before) => {
                at = end_of_quotes(text, at)?;
                before = letter;
                continue;
            }
            '#' if before.is_whitespace() => {
                at = line_end(text, at);
                before = '\n';
                continue;
            }
            _ => {}
        }
        before = letter;
        at += letter.len_utf8();
    }
    None
}

/// Returns the byte behind the quotes that open at `start`.
fn end_of_quotes(text: &str, start: usize) -> Option<usize> {
    let quote = text[start..].chars().next()?;
    let mut letters = text[start + 1..].char_indices().peekable();
    while let Some((at, letter)) = letters.next() {
        match letter {
            '\\' if quote == '"' => drop(letters.next()),
            _ if letter == quote => {
                // Two single quotes stand for one.
                if quote == '"' || letters.peek().is_none_or(|(_, next)| *next != quote) {
                    return Some(start + 1 + at + 1);
                }
                letters.next();
            }
            _ => {}
        }
    }
    None
}

/// Returns the end of the last line that is indented at least as far as the first.
fn end_of_block(text: &str, start: usize, content: &Content) -> usize {
    let column = text[line_start(text, start)..start].chars().count();
    let listed = matches!(content, Content::List(_));
    let mut end = line_end(text, start);
    let mut at = end;
    while at < text.len() {
        let next = line_end(text, at);
        let line = &text[at..next];
        let words = line.trim_start();
        let indent = line.len() - words.len();
        let blank = words.is_empty() || words.starts_with('#');
        // The dashes of a list may be aligned with its key.
        let inside = indent > column || indent == column && listed == words.starts_with("- ");
        match (blank, inside) {
            (true, _) => {}
            (false, true) => end = next,
            (false, false) => break,
        }
        at = next;
    }
    text[..end].trim_end_matches(['\n', '\r']).len().max(start)
}

/// Returns the end of a word without quotes in one line.
fn end_of_word(text: &str, start: usize, flow: bool) -> usize {
    let line = &text[start..line_end(text, start)];
    let ends = |(at, letter): &(usize, char)| match letter {
        ',' | ']' | '}' | '[' | '{' => flow,
        ':' => line[at + 1..].starts_with([' ', '\n', '\r']) || line.len() == at + 1,
        '#' => line[..*at].ends_with([' ', '\t']),
        _ => false,
    };
    let end = line.char_indices().find(ends).map_or(line.len(), |(at, _)| at);
    start + line[..end].trim_end().len()
}
