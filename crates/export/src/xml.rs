//! XML as text: elements, one per line, and their attributes.

use std::fmt::Write;

/// XML document under construction.
#[derive(Debug, Default)]
pub(super) struct Xml {
    text: String,
    /// Names of the open elements.
    open: Vec<&'static str>,
}

impl Xml {
    /// Writes a comment; `text` must not contain `--`.
    pub fn comment(&mut self, text: &str) {
        self.indent();
        let _ = writeln!(self.text, "<!-- {text} -->");
    }

    /// Opens an element, which contains the elements written until [`Self::close`].
    pub fn open(&mut self, name: &'static str, attributes: &[(&str, String)]) {
        self.element(name, attributes, "");
        self.open.push(name);
    }

    /// Writes an element without content.
    pub fn leaf(&mut self, name: &'static str, attributes: &[(&str, String)]) {
        self.element(name, attributes, "/");
    }

    /// Closes the last opened element.
    pub fn close(&mut self) {
        if let Some(name) = self.open.pop() {
            self.indent();
            let _ = writeln!(self.text, "</{name}>");
        }
    }

    /// Returns the document.
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

/// Formats numbers as an attribute, with digits that parse to exactly the same value.
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
            // Control characters are not allowed in XML, or are read as a space.
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
    fn any_name_stays_within_its_attribute() {
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
