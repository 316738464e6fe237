//! A file's text as a tree of numbered nodes, whatever its language.

use std::fmt;

/// A value of a file's text, numbered in reading order so that its place can be found.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its number in reading order.
    pub id: usize,
    /// Its value.
    pub content: Content,
}

/// The value of a node.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Null, or a key without a value.
    Nothing,
    /// True or false.
    Switch(bool),
    /// A number without fraction.
    Whole(i128),
    /// Any other number.
    Number(f64),
    /// A text.
    Text(String),
    /// A list of values.
    List(Vec<Node>),
    /// Keys with their values, in the order of the text.
    Map(Vec<(Node, Node)>),
}

impl Node {
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
