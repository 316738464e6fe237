//! XML elements with their places, and numbers in attributes.

use std::path::PathBuf;

use roxmltree::{Attribute, Node};

use super::attributes::{self, Row, Treatment};
use super::diagnostic::{Effect, Ledger};
use super::model::Place;
use super::spliced::Spliced;
use crate::Language;
use crate::foreign::xml::{self, Flaw};
pub(super) use crate::foreign::xml::{element, elements};
use crate::foreign::{Files, Refused};

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

    /// Checks all attributes of an element against the table of its format. Unknown attributes are
    /// faults; attributes that are not expressed are notes or faults. `find` returns the attribute
    /// in force, which may belong to a class.
    pub fn judge(
        &mut self,
        language: Language,
        element: &str,
        node: Node<'a, 'a>,
        find: impl Fn(&str) -> Option<Attribute<'a, 'a>>,
    ) {
        let rows = attributes::rows(language, element);
        let tag = node.tag_name().name();
        // Attributes of other namespaces are ignored.
        for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
            match attributes::row(rows, attribute.name()) {
                Some(row) if row.name == "*" => self.report(tag, attribute, row),
                Some(_) => {}
                None => {
                    let message =
                        format!("<{tag}> has the unknown attribute `{}`", attribute.name());
                    self.fault_of(attribute, message, "correct its name, or remove it");
                }
            }
        }
        for row in rows {
            if let Some(stated) = find(row.name).filter(|stated| row.applies(stated.value())) {
                self.report(tag, stated, row);
            }
        }
    }

    /// Reports an attribute that is not expressed.
    fn report(&mut self, tag: &str, attribute: Attribute<'a, 'a>, row: &Row) {
        let (name, value) = (attribute.name(), attribute.value());
        match row.treatment {
            Treatment::Noted => {
                let place = self.place_of(attribute);
                let note = format!("`{name}` of this {tag} is ignored: {}", row.effect);
                self.ledger.note_as(row.strength, place, note);
            }
            Treatment::Refused => {
                let message = format!("{name}=\"{value}\" of this {tag} is not supported");
                self.fault_of(attribute, message, row.effect);
            }
            Treatment::Used | Treatment::Harmless => {}
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

    /// Finds the mesh `name` of an element, optionally in the folder `base` that the file states. A
    /// mesh in another folder around the file is an assumption.
    pub fn mesh(
        &mut self,
        node: Node<'a, 'a>,
        (files, base): (&Files, &str),
        name: &str,
    ) -> Result<PathBuf, Refused> {
        let place = self.place(node);
        files.find(base, name).or_else(|refused| {
            let elsewhere = files.around(base, name).filter(|path| {
                let path = path.display();
                let note = format!("`{name}` is outside the folder of the file; {path} is used");
                self.ledger.assume(Effect::Slight, place, note)
            });
            elsewhere.ok_or(refused)
        })
    }

    /// Returns all numbers of an attribute; `None` with a fault if one is not a finite number.
    pub fn list(&mut self, attribute: Attribute<'a, 'a>) -> Option<Vec<f64>> {
        self.sound(xml::list(attribute))
    }

    /// Returns exactly `N` numbers of an attribute.
    pub fn numbers<const N: usize>(&mut self, attribute: Attribute<'a, 'a>) -> Option<[f64; N]> {
        self.sound(xml::numbers(attribute))
    }

    /// Returns both limits of an attribute, which may be infinite.
    pub fn limits(&mut self, attribute: Attribute<'a, 'a>) -> Option<[f64; 2]> {
        self.sound(xml::limits(attribute))
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
