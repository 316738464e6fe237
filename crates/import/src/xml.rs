//! XML elements with their places, and numbers in attributes.

use roxmltree::{Attribute, Node};

use super::diagnostic::Ledger;
use super::model::Place;
use super::spliced::Spliced;
use crate::foreign::xml::{self, Flaw};
pub(super) use crate::foreign::xml::{element, elements};

/// File being read.
pub(super) struct Source<'a> {
    text: &'a Spliced,
    /// Faults and notes so far.
    pub ledger: Ledger,
}

impl<'a> Source<'a> {
    /// Creates a source without faults.
    pub fn new(text: &'a Spliced, ledger: Ledger) -> Self {
        Self { text, ledger }
    }

    /// Returns the start of an element.
    pub fn place(&self, node: Node<'a, 'a>) -> Place {
        self.text.place(node.range().start)
    }

    /// Returns the start of an attribute.
    pub fn place_of(&self, attribute: Attribute<'a, 'a>) -> Place {
        self.text.place(attribute.range().start)
    }

    /// Reports a fault of an element.
    pub fn fault(
        &mut self,
        node: Node<'a, 'a>,
        message: impl Into<String>,
        advice: impl Into<String>,
    ) {
        let place = self.place(node);
        self.ledger.fault(place, message, advice);
    }

    /// Reports a fault of an attribute.
    pub fn fault_of(
        &mut self,
        attribute: Attribute<'a, 'a>,
        message: impl Into<String>,
        advice: impl Into<String>,
    ) {
        let place = self.text.place(attribute.range().start);
        self.ledger.fault(place, message, advice);
    }

    /// Reports attributes of an element that are not among `known`.
    pub fn only(&mut self, node: Node<'a, 'a>, known: &[&[&str]]) {
        for attribute in node.attributes() {
            let name = attribute.name();
            // Attributes of other namespaces are ignored.
            if attribute.namespace().is_none() && !known.iter().any(|list| list.contains(&name)) {
                let tag = node.tag_name().name();
                let message = format!("<{tag}> has the unknown attribute `{name}`");
                self.fault_of(attribute, message, "correct its name, or remove it");
            }
        }
    }

    /// Returns the content; `None` with its fault if it could not be read.
    pub fn sound<T>(&mut self, read: Result<T, Flaw>) -> Option<T> {
        let note = |Flaw { at, message, advice }: Flaw| {
            let place = self.text.place(at);
            self.ledger.fault(place, message, advice);
        };
        read.map_err(note).ok()
    }

    /// Returns all numbers of an attribute; `None` with a fault if one is not a finite number.
    pub fn list(&mut self, attribute: Attribute<'a, 'a>) -> Option<Vec<f64>> {
        self.sound(xml::list(attribute))
    }

    /// Returns exactly `N` numbers of an attribute.
    pub fn numbers<const N: usize>(&mut self, attribute: Attribute<'a, 'a>) -> Option<[f64; N]> {
        self.sound(xml::numbers(attribute))
    }

    /// Returns one number of an attribute.
    pub fn number(&mut self, attribute: Attribute<'a, 'a>) -> Option<f64> {
        self.sound(xml::number(attribute))
    }

    /// Returns the attribute with this name, if the element has it.
    pub fn attribute(&self, node: Node<'a, 'a>, name: &str) -> Option<Attribute<'a, 'a>> {
        node.attribute_node(name)
    }
}
