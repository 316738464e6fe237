//! Escaping of user text for output on a terminal.

use std::borrow::Cow;

/// Escapes every character that a terminal would interpret instead of display. Escaped are control
/// characters except the tab, and characters that change the writing direction. They are written as
/// `\u001b`, as in JSON. Line feeds are also escaped, so that one line stays one line.
pub fn printable(text: &str) -> Cow<'_, str> {
    if !text.contains(obeyed) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        match obeyed(c) {
            true => shown.push_str(&format!("\\u{:04x}", u32::from(c))),
            false => shown.push(c),
        }
    }
    Cow::Owned(shown)
}

fn obeyed(c: char) -> bool {
    let turns =
        matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || matches!(c, '\u{2028}' | '\u{2029}') || c.is_control() && c != '\t'
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_that_move_the_cursor_are_escaped() {
        assert_eq!(
            printable("a\u{1b}[2Jb\u{9b}c\u{7f}\r\n"),
            "a\\u001b[2Jb\\u009bc\\u007f\\u000d\\u000a"
        );
        assert_eq!(printable("\u{202e}evil\u{2066}"), "\\u202eevil\\u2066");
        assert!(matches!(printable("Hüte, 木\t2 \u{2212} 1"), Cow::Borrowed(_)));
    }
}
