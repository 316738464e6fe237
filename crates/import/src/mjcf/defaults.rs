//! Classes of defaults.

use std::collections::HashMap;

use roxmltree::{Attribute, Node};

use crate::Language;
use crate::attributes;
use crate::xml::{Source, elements};

/// Class of elements that name none.
const MAIN: &str = "main";

/// Maximum nesting depth of classes, safe for the stack.
const DEEPEST: usize = 200;

/// Element whose attributes are looked up, with the default class that its body sets for elements
/// without a class.
#[derive(Clone, Copy)]
pub(super) struct Lookup<'a, 'c> {
    pub node: Node<'a, 'a>,
    pub class: Option<&'c str>,
}

/// Default attributes by class.
#[derive(Default)]
pub(super) struct Defaults<'a> {
    /// Parent class and attributes of every class, by class name; attributes by element and name.
    classes: HashMap<&'a str, Class<'a>>,
}

#[derive(Default)]
struct Class<'a> {
    parent: Option<&'a str>,
    values: HashMap<(&'a str, &'a str), Attribute<'a, 'a>>,
}

impl<'a> Defaults<'a> {
    /// Reads a `default` element and the nested ones.
    pub fn read(&mut self, source: &mut Source<'a>, node: Node<'a, 'a>, parent: Option<&'a str>) {
        source.judge(Language::Mjcf, "default", node, |_| None);
        let name = match (node.attribute("class"), parent) {
            (Some(name), _) => name,
            (None, None) => MAIN,
            (None, Some(_)) => {
                source.fault(node, "a nested <default> has no class", "add its `class`");
                return;
            }
        };
        if name != MAIN && parent.is_none() {
            let message = format!("the outermost <default> has the class `{name}`, not `main`");
            source.fault(node, message, "remove its `class`");
            return;
        }
        self.classes.entry(name).or_default().parent = parent;
        if node.ancestors().count() > DEEPEST {
            source.fault(node, "classes are nested too deeply", "is this the right file?");
            return;
        }
        for child in elements(node) {
            let tag = child.tag_name().name();
            if tag == "default" {
                self.read(source, child, Some(name));
                continue;
            }
            // Attributes of a class are judged by the elements that use it.
            if !attributes::rows(Language::Mjcf, tag).is_empty() {
                source.judge(Language::Mjcf, tag, child, |_| None);
            }
            let values = &mut self.classes.entry(name).or_default().values;
            values.extend(child.attributes().map(|value| ((tag, value.name()), value)));
        }
    }

    /// Returns the attribute `name` of an element: its own, or inherited from its class or the
    /// nearest parent class that has it.
    pub fn find(&self, element: Lookup<'a, '_>, name: &str) -> Option<Attribute<'a, 'a>> {
        let Lookup { node, class } = element;
        if let Some(own) = node.attribute_node(name) {
            return Some(own);
        }
        let section = node.parent().map_or("", |parent| parent.tag_name().name());
        let tag = if section == "equality" { section } else { node.tag_name().name() };
        // A free joint does not inherit from `joint`, and bodies have no defaults.
        let mut class = Some(node.attribute("class").or(class).unwrap_or(MAIN));
        while let Some(found) = class.and_then(|class| self.classes.get(class)) {
            if let Some(value) = found.values.get(&(tag, name)) {
                return Some(*value);
            }
            class = found.parent;
        }
        None
    }

    /// Reports a class that does not exist.
    pub fn check(&self, source: &mut Source<'a>, node: Node<'a, 'a>, attribute: &str) {
        let Some(named) = node.attribute_node(attribute) else { return };
        if named.value() != MAIN && !self.classes.contains_key(named.value()) {
            let message = format!("there is no class `{}`", named.value());
            source.fault_of(named, message, "use a class defined under <default>");
        }
    }
}
