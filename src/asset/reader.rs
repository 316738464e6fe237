//! Parsing of YAML or JSON text into a tree of nodes, and lookup of a node's place.
//!
//! Both parsers report positions only in their errors. Nodes are therefore numbered in reading
//! order. The place of a node is found by parsing the text again and failing on purpose at its
//! number. This costs one more parse per fault and nothing for a valid file. The positions are the
//! parser's own: in YAML the start of the value, in JSON the value's last character or first
//! bracket.

use std::cell::Cell;
use std::fmt;

use serde::de::{
    self, DeserializeSeed, Deserializer, EnumAccess, IgnoredAny, MapAccess, SeqAccess, Visitor,
};

use super::diagnostic::{Fault, Faults, Place};
use super::node::{Content, Node};
use super::text::{Language, Source};

/// Maximum size of a YAML text, bytes: far above any task, and small enough to refuse a wrong file
/// at once.
const MAX_YAML_BYTES: usize = 1 << 18;

/// Maximum number of values in a YAML text, because anchors and aliases can expand a few letters to
/// many values.
const MAX_YAML_NODES: usize = 100_000;

/// Maximum total size of words in a YAML text, bytes, because aliases also repeat long words.
const MAX_YAML_WORDS: usize = 1 << 20;

/// Maximum nesting depth of lists and maps; the deepest file format, the trajectory, has nine
/// levels.
const MAX_DEPTH: usize = 32;

/// Number of brackets, dashes and colons of a YAML text that are read before their depth is
/// checked. The parser's time grows with the square of the depth: this number of levels takes some
/// 30 ms.
const OPENERS_AT_ONCE: usize = 2000;

const TAGS: &str = "tags such as `!name` are not supported here";

const DEEP: &str = "lists and maps are nested too deeply";

impl Node {
    /// Parses a text.
    ///
    /// # Errors
    /// Returns one fault if the text is not valid in its language.
    pub fn parse(source: Source) -> Result<Self, Faults> {
        let Source { file, text, language } = source;
        if language == Language::Yaml && text.len() > MAX_YAML_BYTES {
            let message =
                format!("the file has {} bytes; the limit is {MAX_YAML_BYTES}", text.len());
            return Err(Fault::of_file(file, message, "is this the right file?").into());
        }
        check_depth(source)
            .and_then(|()| read(source, usize::MAX))
            .map_err(|failure| failure.explain(source).into())
    }
}

/// Returns the place of node `id` in a text.
pub fn locate(source: Source, id: usize) -> Option<Place> {
    read(source, id).err()?.place
}

/// Reason and place at which parsing stopped.
struct Failure {
    message: String,
    place: Option<Place>,
}

impl Failure {
    /// Converts the failure to a fault with advice.
    fn explain(self, Source { file, text, language }: Source) -> Fault {
        // The place is reported separately, so it is cut from the message.
        let message = self.message.split(" at line ").next().unwrap_or_default();
        let advice = if message.contains(TAGS) {
            "write the value without a tag"
        } else if message.contains(DEEP) {
            "look for brackets that are never closed, or check whether this is the right file"
        } else if message.contains("number out of range") {
            "write a number that is smaller than 1e308"
        } else if text.trim().is_empty() {
            "the file is empty; `pushplan check --schema KIND` prints its format"
        } else if language == Language::Yaml && text.contains('\t') {
            "indent YAML with spaces; tabs are not allowed"
        } else if language == Language::Json && names_no_number(text) {
            "JSON has no NaN and no Infinity; leave out values that were not measured"
        } else {
            "check indentation, brackets and quotes around this place"
        };
        let message = match message.contains(DEEP) {
            true => format!("{DEEP}: more than {MAX_DEPTH} levels"),
            false => format!("not valid {}: {message}", language.name()),
        };
        let place = Some(self.place.unwrap_or_else(|| second_document(text)));
        Fault { file: file.into(), place, message, advice: advice.into() }
    }
}

/// Refuses a YAML text that is nested so deeply that parsing would take minutes. The YAML parser
/// reads a text to its end before it returns any node. Therefore the parser receives increasing
/// prefixes of the text, and the depth of each prefix is checked before the next one is parsed.
fn check_depth(source: Source) -> Result<(), Failure> {
    if source.language == Language::Json {
        // The JSON parser returns each value as it is read, so the depth limit stops it.
        return Ok(());
    }
    let mut broken = None;
    for cut in cuts(source.text, OPENERS_AT_ONCE) {
        let part = Source { text: &source.text[..cut], ..source };
        let Err(failure) = read(part, usize::MAX) else { continue };
        // A truncated text fails in the parser itself. A failure of another kind (nesting, tags, a
        // second document) remains when more text is added.
        let parsed = serde_yaml::from_str::<IgnoredAny>(part.text);
        let cut_off = parsed.is_err_and(|error| error.to_string() == failure.message);
        if !cut_off || failure.place.is_none() {
            return Err(failure);
        }
        // The end did not move although text was added: the parser never gets past this place.
        if broken.replace(failure.place) == Some(failure.place) {
            break;
        }
    }
    Ok(())
}

/// Returns the ends of prefixes of a text with `count` more openers each. A YAML level takes at
/// least a bracket, a dash, a question mark or a colon. Each prefix is therefore deeper than the
/// previous one by at most twice that number.
fn cuts(text: &str, count: usize) -> impl Iterator<Item = usize> {
    let bytes = text.as_bytes();
    let spaced = |at: usize| bytes.get(at + 1).is_none_or(u8::is_ascii_whitespace);
    let openers = bytes.iter().enumerate().filter(move |(at, byte)| match byte {
        b'[' | b'{' => true,
        b'-' | b'?' | b':' => spaced(*at),
        _ => false,
    });
    openers.map(|(at, _)| at + 1).skip(count - 1).step_by(count)
}

/// Reads all nodes, failing on purpose at node `stop`.
fn read(source: Source, stop: usize) -> Result<Node, Failure> {
    let (next, words) = (Cell::new(0), Cell::new(0));
    match source.language {
        Language::Yaml => {
            let reader = Reader {
                next: &next,
                stop,
                limit: MAX_YAML_NODES,
                words: (&words, MAX_YAML_WORDS),
                depth: 0,
            };
            reader.deserialize(serde_yaml::Deserializer::from_str(source.text)).map_err(|error| {
                let place = error.location().map(|l| Place { line: l.line(), column: l.column() });
                Failure { message: error.to_string(), place }
            })
        }
        Language::Json => {
            let reader = Reader {
                next: &next,
                stop,
                limit: usize::MAX,
                words: (&words, usize::MAX),
                depth: 0,
            };
            let mut json = serde_json::Deserializer::from_str(source.text);
            let read = reader.deserialize(&mut json).and_then(|node| json.end().map(|()| node));
            read.map_err(|error| {
                let place = Place::in_json(source.text, error.line(), error.column());
                Failure { message: error.to_string(), place: Some(place) }
            })
        }
    }
}

/// Returns the start of the second document in a YAML text, the only error that the parser reports
/// without a place.
fn second_document(text: &str) -> Place {
    let mut lines = text.lines().enumerate();
    let begun = lines.by_ref().find(|(_, line)| {
        let line = line.trim();
        !line.is_empty() && !line.starts_with(['#', '%']) && line != "---"
    });
    let next = lines.find(|(_, line)| line.starts_with("---") || line.starts_with("..."));
    let line = next.or(begun).map_or(1, |(index, _)| index + 1);
    Place { line, column: 1 }
}

/// Returns `true` if a JSON text contains a non-finite number in Python's notation.
fn names_no_number(text: &str) -> bool {
    ["NaN", "Infinity"].iter().any(|word| {
        text.match_indices(word)
            .any(|(at, _)| text[..at].trim_end().ends_with([',', '[', ':', '-']))
    })
}

#[derive(Clone, Copy)]
struct Reader<'a> {
    next: &'a Cell<usize>,
    stop: usize,
    limit: usize,
    /// Bytes of words so far, and their maximum.
    words: (&'a Cell<usize>, usize),
    /// Number of lists and maps around the value.
    depth: usize,
}

impl Reader<'_> {
    fn number<E: de::Error>(self) -> Result<usize, E> {
        let id = self.next.get();
        self.next.set(id + 1);
        if id == self.stop {
            return Err(E::custom("located"));
        }
        if id == self.limit {
            return Err(E::custom(format_args!("more than {} values", self.limit)));
        }
        Ok(id)
    }

    /// Returns the number of a list or map, and the reader of its content.
    fn enter<E: de::Error>(self) -> Result<(usize, Self), E> {
        let id = self.number()?;
        let depth = self.depth + 1;
        if depth > MAX_DEPTH {
            return Err(E::custom(DEEP));
        }
        Ok((id, Self { depth, ..self }))
    }

    fn leaf<E: de::Error>(self, content: Content) -> Result<Node, E> {
        Ok(Node { id: self.number()?, content })
    }
}

impl<'de> DeserializeSeed<'de> for Reader<'_> {
    type Value = Node;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Node, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Reader<'_> {
    type Value = Node;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_unit<E: de::Error>(self) -> Result<Node, E> {
        self.leaf(Content::Nothing)
    }

    fn visit_none<E: de::Error>(self) -> Result<Node, E> {
        self.leaf(Content::Nothing)
    }

    fn visit_bool<E: de::Error>(self, value: bool) -> Result<Node, E> {
        self.leaf(Content::Switch(value))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Node, E> {
        self.leaf(Content::Whole(value.into()))
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Node, E> {
        self.leaf(Content::Whole(value.into()))
    }

    fn visit_i128<E: de::Error>(self, value: i128) -> Result<Node, E> {
        self.leaf(Content::Whole(value))
    }

    fn visit_u128<E: de::Error>(self, value: u128) -> Result<Node, E> {
        self.leaf(i128::try_from(value).map_or(Content::Number(value as f64), Content::Whole))
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Node, E> {
        self.leaf(Content::Number(value))
    }

    fn visit_str<E: de::Error>(self, value: &str) -> Result<Node, E> {
        let (words, most) = self.words;
        words.set(words.get() + value.len());
        if words.get() > most {
            return Err(E::custom(format_args!("more than {most} bytes of text")));
        }
        self.leaf(Content::Text(value.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Node, A::Error> {
        let (id, inside) = self.enter()?;
        let mut items = Vec::new();
        while let Some(item) = access.next_element_seed(inside)? {
            items.push(item);
        }
        Ok(Node { id, content: Content::List(items) })
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Node, A::Error> {
        let (id, inside) = self.enter()?;
        let mut pairs = Vec::new();
        while let Some(pair) = access.next_entry_seed(inside, inside)? {
            pairs.push(pair);
        }
        Ok(Node { id, content: Content::Map(pairs) })
    }

    fn visit_enum<A: EnumAccess<'de>>(self, _: A) -> Result<Node, A::Error> {
        Err(de::Error::custom(TAGS))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_node_is_found_again() {
        let text = "a: {b: 1, c: [x, .nan]}\nä: [\n  2.5,\n  ]\n";
        let source = Source::yaml("t", text);
        let root = Node::parse(source).unwrap();
        let place = |node: &Node| locate(source, node.id).map(|p| (p.line, p.column));
        assert_eq!(place(&root), Some((1, 1)));
        let a = root.get("a").unwrap();
        assert_eq!(place(a), Some((1, 4)));
        assert_eq!(place(a.get("b").unwrap()), Some((1, 8)));
        assert_eq!(place(&a.pairs()[1].0), Some((1, 11)));
        assert_eq!(place(&a.get("c").unwrap().items()[1]), Some((1, 18)));
        assert_eq!(place(&root.get("ä").unwrap().items()[0]), Some((3, 3)));
        assert_eq!(locate(source, 1000), None);
    }

    #[test]
    fn long_words_are_not_repeated_for_ever() {
        let text = format!("a: &a {}\nb: [{}]\n", "x".repeat(9000), "*a, ".repeat(200));
        let faults = Node::parse(Source::yaml("t", &text)).unwrap_err().to_string();
        assert!(faults.contains("bytes of text"), "{faults}");
    }

    #[test]
    fn sound_texts_may_be_cut_anywhere() {
        let text = "a: 'x: [{ - y'\nb: see [1]\nc: # {\n  - |\n    [ {\n  - \"\\\"[ \"\n\
                    ? d\n: [e: {f: 1}]\n";
        assert!(Node::parse(Source::yaml("t", text)).is_ok());
        for cut in cuts(text, 1) {
            let part = Source::yaml("t", &text[..cut]);
            let Err(failure) = read(part, usize::MAX) else { continue };
            let parsed = serde_yaml::from_str::<IgnoredAny>(part.text);
            assert_eq!(parsed.unwrap_err().to_string(), failure.message, "{}", part.text);
            assert!(failure.place.is_some(), "{}", part.text);
        }
        assert_eq!(cuts("[[a: -1- {?", 2).collect::<Vec<_>>(), [2, 8, 11]);
    }

    #[test]
    fn nodes_of_json_are_found_too() {
        let text = "{\n  \"a\": [1.5,\n    {\"b\": true}]\n}";
        let source = Source::json("t", text);
        let root = Node::parse(source).unwrap();
        let place = |node: &Node| locate(source, node.id).map(|p| (p.line, p.column));
        let items = root.get("a").unwrap().items();
        assert_eq!(place(&items[0]), Some((2, 11)));
        assert_eq!(place(items[1].get("b").unwrap()), Some((3, 14)));
    }
}
