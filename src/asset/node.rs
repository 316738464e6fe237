//! YAML or JSON text as a tree of numbered nodes that know their place.
//!
//! The crates that read both tell positions only in their errors. So nodes are numbered in the
//! order in which they are read, and the place of one is found by reading the text again and
//! failing on purpose at its number. That costs one more parse per fault and nothing for a good
//! file, and the positions are the parser's own (YAML: where the value begins; JSON: where the
//! parser stood, which is the value's last character or first bracket).

use std::cell::Cell;
use std::fmt;

use serde::de::{self, DeserializeSeed, Deserializer, EnumAccess, MapAccess, SeqAccess, Visitor};

use super::fault::{Fault, Faults, Place};
use super::text::{Language, Source};

/// The longest YAML text that is read, bytes: far above any task, and small enough that a wrong
/// file is refused at once.
const MAX_YAML_BYTES: usize = 1 << 18;

/// The most values that a YAML text may hold; anchors and aliases can write many with few
/// letters.
const MAX_YAML_NODES: usize = 100_000;

const TAGS: &str = "tags such as `!name` have no meaning here";

/// A value and its number in reading order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub id: usize,
    pub content: Content,
}

/// What a node holds.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Content {
    Nothing,
    Switch(bool),
    Whole(i128),
    Number(f64),
    Text(String),
    List(Vec<Node>),
    Map(Vec<(Node, Node)>),
}

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
        read(source, usize::MAX).map_err(|failure| {
            let advice = if text.trim().is_empty() {
                "the file is empty; `pushplan schema` shows what belongs into it"
            } else if language == Language::Yaml && text.contains('\t') {
                "YAML indents with spaces; tabs are not allowed"
            } else if language == Language::Json && names_no_number(text) {
                "JSON has no NaN and no Infinity: leave out what was not measured"
            } else {
                "check indentation, brackets and quotes around this place"
            };
            // The place is said once, in front.
            let message = failure.message.split(" at line ").next().unwrap_or_default();
            let advice =
                if message.contains(TAGS) { "write the value without a tag" } else { advice };
            Faults(vec![Fault {
                file: file.into(),
                place: Some(failure.place.unwrap_or_else(|| second_document(text))),
                message: format!("not valid {}: {message}", language.name()),
                advice: advice.into(),
            }])
        })
    }

    /// The value under `key`, if this is a map that has it.
    pub fn get(&self, key: &str) -> Option<&Node> {
        self.pairs().iter().find(|(k, _)| k.text() == Some(key)).map(|(_, value)| value)
    }

    /// The pairs of a map; empty for anything else.
    pub fn pairs(&self) -> &[(Node, Node)] {
        match &self.content {
            Content::Map(pairs) => pairs,
            _ => &[],
        }
    }

    /// The items of a list; empty for anything else.
    pub fn items(&self) -> &[Node] {
        match &self.content {
            Content::List(items) => items,
            _ => &[],
        }
    }

    /// The text, if it is one.
    pub fn text(&self) -> Option<&str> {
        match &self.content {
            Content::Text(text) => Some(text),
            _ => None,
        }
    }

    /// True or false, if it is one of them.
    pub fn switch(&self) -> Option<bool> {
        match self.content {
            Content::Switch(value) => Some(value),
            _ => None,
        }
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self.content {
            Content::Whole(value) => Some(value as f64),
            Content::Number(value) => Some(value),
            _ => None,
        }
    }
}

impl fmt::Display for Content {
    /// What a fault message says was found.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Content::Nothing => f.write_str("nothing"),
            Content::Switch(value) => write!(f, "the truth value {value}"),
            Content::Whole(value) => write!(f, "the number {value}"),
            Content::Number(value) => write!(f, "the number {value:?}"),
            Content::Text(text) if text.chars().count() > 40 => {
                write!(f, "the text \"{}...\"", text.chars().take(40).collect::<String>())
            }
            Content::Text(text) => write!(f, "the text \"{text}\""),
            Content::List(items) if items.is_empty() => f.write_str("an empty list"),
            Content::List(items) if items.len() == 1 => f.write_str("a list of 1 item"),
            Content::List(items) => write!(f, "a list of {} items", items.len()),
            Content::Map(pairs) if pairs.is_empty() => f.write_str("an empty map"),
            Content::Map(_) => f.write_str("a map"),
        }
    }
}

/// Where node `id` of a text is.
pub(super) fn locate(source: Source, id: usize) -> Option<Place> {
    read(source, id).err()?.place
}

/// Why and where reading stopped.
struct Failure {
    message: String,
    place: Option<Place>,
}

/// Reads all nodes, failing on purpose at node `stop`.
fn read(source: Source, stop: usize) -> Result<Node, Failure> {
    let next = Cell::new(0);
    match source.language {
        Language::Yaml => {
            let reader = Reader { next: &next, stop, limit: MAX_YAML_NODES };
            reader.deserialize(serde_yaml::Deserializer::from_str(source.text)).map_err(|error| {
                let place = error.location().map(|l| Place { line: l.line(), column: l.column() });
                Failure { message: error.to_string(), place }
            })
        }
        Language::Json => {
            let reader = Reader { next: &next, stop, limit: usize::MAX };
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
        self.leaf(Content::Text(value.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Node, A::Error> {
        let id = self.number()?;
        let mut items = Vec::new();
        while let Some(item) = access.next_element_seed(self)? {
            items.push(item);
        }
        Ok(Node { id, content: Content::List(items) })
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Node, A::Error> {
        let id = self.number()?;
        let mut pairs = Vec::new();
        while let Some(pair) = access.next_entry_seed(self, self)? {
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
