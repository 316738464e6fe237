//! XML as text: elements, one a line, and their attributes.

use std::fmt::Write;

/// A growing XML document.
#[derive(Debug, Default)]
pub(super) struct Xml {
    text: String,
    /// Names of the elements that are open.
    open: Vec<&'static str>,
}

impl Xml {
    /// A comment; `text` is ours and holds no `--`.
    pub fn comment(&mut self, text: &str) {
        self.indent();
        let _ = writeln!(self.text, "<!-- {text} -->");
    }

    /// An element that later ones belong to.
    pub fn open(&mut self, name: &'static str, attributes: &[(&str, String)]) {
        self.element(name, attributes, "");
        self.open.push(name);
    }

    /// An element with nothing in it.
    pub fn leaf(&mut self, name: &'static str, attributes: &[(&str, String)]) {
        self.element(name, attributes, "/");
    }

    /// Ends what was opened last.
    pub fn close(&mut self) {
        if let Some(name) = self.open.pop() {
            self.indent();
            let _ = writeln!(self.text, "</{name}>");
        }
    }

    /// The document.
    pub fn finish(mut self) -> String {
        while !self.open.is_empty() {
            self.close();
        }
        self.text
    }

    fn element(&mut self, name: &str, attributes: &[(&str, String)], end: &str) {
        self.indent();
        let _ = write!(self.text, "<{name}");
        for (key, value) in attributes {
            let _ = write!(self.text, " {key}=\"{}\"", escaped(value));
        }
        let _ = writeln!(self.text, "{end}>");
    }

    fn indent(&mut self) {
        self.text += &"  ".repeat(self.open.len());
    }
}

/// Numbers as an attribute, each with the digits that read back as exactly it.
pub(super) fn numbers(values: &[f64]) -> String {
    let words: Vec<String> = values.iter().map(f64::to_string).collect();
    words.join(" ")
}

fn escaped(value: &str) -> String {
    let mut safe = String::with_capacity(value.len());
    for c in value.chars() {
        match c {
            '&' => safe += "&amp;",
            '<' => safe += "&lt;",
            '>' => safe += "&gt;",
            '"' => safe += "&quot;",
            // Not allowed in XML at all, or read as a space.
            c if c.is_control() => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whatever_a_name_holds_stays_in_its_attribute() {
        let mut xml = Xml::default();
        xml.open("a", &[("b", "\"/><c d=\"1\" & more\u{7}".into())]);
        assert_eq!(xml.finish(), "<a b=\"&quot;/&gt;&lt;c d=&quot;1&quot; &amp; more \">\n</a>\n");
    }

    #[test]
    fn numbers_read_back_as_they_were() {
        for value in [0.1 + 0.2, -1e-9, 1.0 / 3.0, 5e-324] {
            assert_eq!(numbers(&[value]).parse(), Ok(value));
        }
    }
}
