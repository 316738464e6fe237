//! XML elements, and numbers in their attributes.

use roxmltree::{Attribute, Node};

/// Fault of an element or attribute.
#[derive(Clone, Debug, PartialEq)]
pub struct Flaw {
    /// Byte offset in the text.
    pub at: usize,
    /// Description of the fault.
    pub message: String,
    /// Suggested fix.
    pub advice: String,
}

impl Flaw {
    /// Creates a fault of an element.
    pub fn of(node: Node, message: impl Into<String>, advice: impl Into<String>) -> Self {
        Self { at: node.range().start, message: message.into(), advice: advice.into() }
    }

    fn of_attribute(attribute: Attribute, message: String, advice: impl Into<String>) -> Self {
        Self { at: attribute.range().start, message, advice: advice.into() }
    }
}

/// Returns the child elements of `node`, in order.
pub fn elements<'a>(node: Node<'a, 'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(Node::is_element)
}

/// Returns the first child element of `node` with this name.
pub fn element<'a>(node: Node<'a, 'a>, name: &str) -> Option<Node<'a, 'a>> {
    elements(node).find(|child| child.tag_name().name() == name)
}

/// Reads all numbers of an attribute.
///
/// # Errors
/// Returns an error if a word is not a finite number.
pub fn list(attribute: Attribute) -> Result<Vec<f64>, Flaw> {
    read(attribute, f64::is_finite)
}

/// Reads exactly `N` limits of an attribute, which may be infinite.
///
/// # Errors
/// Returns the errors of [`numbers`].
pub fn limits<const N: usize>(attribute: Attribute) -> Result<[f64; N], Flaw> {
    counted(attribute, read(attribute, |number| !number.is_nan())?)
}

fn read(attribute: Attribute, sound: fn(f64) -> bool) -> Result<Vec<f64>, Flaw> {
    let number = |word: &str| match word.parse::<f64>() {
        Ok(number) if sound(number) => Ok(number),
        _ => {
            let message =
                format!("`{}` contains `{word}`, which is not a number", attribute.name());
            Err(Flaw::of_attribute(attribute, message, "write numbers separated by spaces"))
        }
    };
    attribute.value().split_whitespace().map(number).collect()
}

/// Reads exactly `N` numbers of an attribute.
///
/// # Errors
/// Returns an error for a different count of numbers, and the errors of [`list`].
pub fn numbers<const N: usize>(attribute: Attribute) -> Result<[f64; N], Flaw> {
    counted(attribute, list(attribute)?)
}

fn counted<const N: usize>(attribute: Attribute, found: Vec<f64>) -> Result<[f64; N], Flaw> {
    let count = found.len();
    <[f64; N]>::try_from(found).map_err(|_| {
        let many = if N == 1 { "one number".to_owned() } else { format!("{N} numbers") };
        let message = format!("`{}` has {count} numbers instead of {many}", attribute.name());
        Flaw::of_attribute(attribute, message, format!("write {many}"))
    })
}

/// Reads one number of an attribute.
///
/// # Errors
/// Returns the errors of [`numbers`].
pub fn number(attribute: Attribute) -> Result<f64, Flaw> {
    numbers::<1>(attribute).map(|[number]| number)
}
