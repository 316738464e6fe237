//! Tree of numbered nodes that represents a YAML or JSON text.

use std::fmt;

/// Value in a file, numbered in reading order so that its place can be found.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Number in reading order.
    pub id: usize,
    /// Content of the node.
    pub content: Content,
}

/// Content of a node.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Null, or a key without a value.
    Nothing,
    /// Boolean.
    Switch(bool),
    /// Integer.
    Whole(i128),
    /// Any other number.
    Number(f64),
    /// Text.
    Text(String),
    /// List of values.
    List(Vec<Node>),
    /// Key-value pairs, in the order of the text.
    Map(Vec<(Node, Node)>),
}

impl Node {
    /// Returns the value under `key`, if this is a map that has the key.
    pub fn get(&self, key: &str) -> Option<&Node> {
        self.pairs().iter().find(|(k, _)| k.text() == Some(key)).map(|(_, value)| value)
    }

    /// Returns the pairs of a map; empty for other values.
    pub fn pairs(&self) -> &[(Node, Node)] {
        match &self.content {
            Content::Map(pairs) => pairs,
            _ => &[],
        }
    }

    /// Returns the items of a list; empty for other values.
    pub fn items(&self) -> &[Node] {
        match &self.content {
            Content::List(items) => items,
            _ => &[],
        }
    }

    /// Returns the text, if the value is text.
    pub fn text(&self) -> Option<&str> {
        match &self.content {
            Content::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Returns the boolean, if the value is one.
    pub fn switch(&self) -> Option<bool> {
        match self.content {
            Content::Switch(value) => Some(value),
            _ => None,
        }
    }

    /// Returns the number, if the value is one.
    pub fn number(&self) -> Option<f64> {
        match self.content {
            Content::Whole(value) => Some(value as f64),
            Content::Number(value) => Some(value),
            _ => None,
        }
    }
}

impl fmt::Display for Content {
    /// Describes the value for the "found …" part of a fault message.
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
