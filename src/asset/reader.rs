//! YAML or JSON text as a tree of nodes, and the place of a node.
//!
//! The crates that read both tell positions only in their errors. So nodes are numbered in the
//! order in which they are read, and the place of one is found by reading the text again and
//! failing on purpose at its number. That costs one more parse per fault and nothing for a good
//! file, and the positions are the parser's own (YAML: where the value begins; JSON: where the
//! parser stood, which is the value's last character or first bracket).

use std::cell::Cell;
use std::fmt;

use serde::de::{
    self, DeserializeSeed, Deserializer, EnumAccess, IgnoredAny, MapAccess, SeqAccess, Visitor,
};

use super::fault::{Fault, Faults, Place};
use super::node::{Content, Node};
use super::text::{Language, Source};

/// The longest YAML text that is read, bytes: far above any task, and small enough that a wrong
/// file is refused at once.
const MAX_YAML_BYTES: usize = 1 << 18;

/// The most values that a YAML text may hold; anchors and aliases can write many with few
/// letters.
const MAX_YAML_NODES: usize = 100_000;

/// The most bytes of words that a YAML text may hold: aliases repeat long ones as well.
const MAX_YAML_WORDS: usize = 1 << 20;

/// Lists and maps within each other: a trajectory file, the deepest there is, has nine.
const MAX_DEPTH: usize = 32;

/// Brackets, dashes and colons of a YAML text that are read before their depth is checked. The
/// parser's time grows with the square of the depth: this many levels take it some 30 ms.
const OPENERS_AT_ONCE: usize = 2000;

const TAGS: &str = "tags such as `!name` have no meaning here";

const DEEP: &str = "lists and maps are nested too deeply";

impl Node {
    /// Reads a text.
    ///
    /// # Errors
    /// One fault if it is not of its language.
    pub fn parse(source: Source) -> Result<Self, Faults> {
        let Source { file, text, language } = source;
        if language == Language::Yaml && text.len() > MAX_YAML_BYTES {
            let message =
                format!("the file has {} bytes; at most {MAX_YAML_BYTES} are read", text.len());
            return Err(Fault::of_file(file, message, "is this the right file?").into());
        }
        check_depth(source)
            .and_then(|()| read(source, usize::MAX))
            .map_err(|failure| failure.explain(source).into())
    }
}

/// Returns the place of node `id` of a text.
pub fn locate(source: Source, id: usize) -> Option<Place> {
    read(source, id).err()?.place
}

/// Why and where reading stopped.
struct Failure {
    message: String,
    place: Option<Place>,
}

impl Failure {
    /// What is wrong with the text, and what to try.
    fn explain(self, Source { file, text, language }: Source) -> Fault {
        // The place is said once, in front.
        let message = self.message.split(" at line ").next().unwrap_or_default();
        let advice = if message.contains(TAGS) {
            "write the value without a tag"
        } else if message.contains(DEEP) {
            "look for brackets that are never closed; is this the right file?"
        } else if message.contains("number out of range") {
            "write a number that is smaller than 1e308"
        } else if text.trim().is_empty() {
            "the file is empty; `pushplan check --schema KIND` shows what belongs in it"
        } else if language == Language::Yaml && text.contains('\t') {
            "YAML indents with spaces; tabs are not allowed"
        } else if language == Language::Json && names_no_number(text) {
            "JSON has no NaN and no Infinity: leave out what was not measured"
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

/// Refuses a YAML text nested so deeply that its parser, which reads a text to the end before it
/// gives any of it, would take minutes. So the parser is given the beginning of the text, then
/// more and more of it, and the depth of each part is looked at before the next is read.
fn check_depth(source: Source) -> Result<(), Failure> {
    if source.language == Language::Json {
        // Its parser gives every value as it comes, and so stops by itself.
        return Ok(());
    }
    let mut broken = None;
    for cut in cuts(source.text, OPENERS_AT_ONCE) {
        let part = Source { text: &source.text[..cut], ..source };
        let Err(failure) = read(part, usize::MAX) else { continue };
        // A text that is cut off fails in the parser itself. What is refused for what it says
        // (nesting, tags, a second document) more text could not mend.
        let parsed = serde_yaml::from_str::<IgnoredAny>(part.text);
        let cut_off = parsed.is_err_and(|error| error.to_string() == failure.message);
        if !cut_off || failure.place.is_none() {
            return Err(failure);
        }
        // More text did not move the end: the parser never comes past this place.
        if broken.replace(failure.place) == Some(failure.place) {
            break;
        }
    }
    Ok(())
}

/// Ends of the parts of a text with `count` openers each. A level of YAML takes a bracket, a dash,
/// a question mark or a colon at least, so none of them is deeper than the one before by more
/// than twice that many.
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

/// Where the second document of a YAML text begins: the one thing that its parser refuses without
/// a place.
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

/// Whether a value of a JSON text is written as Python writes numbers that are not finite.
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
    /// Bytes of words so far, and how many there may be.
    words: (&'a Cell<usize>, usize),
    /// Lists and maps around the value.
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

    /// The number of a list or map, and the reader of what is in it.
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
            return Err(E::custom(format_args!("more than {most} bytes of words")));
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
        assert!(faults.contains("bytes of words"), "{faults}");
    }

    #[test]
    fn sound_texts_may_be_cut_anywhere() {
        let text = "a: 'x: [{ - y'\nb: see [1]\nc: # {\n  - |\n    [ {\n  - \"\\\"[ \"\n? d\n: [e: {f: 1}]\n";
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
