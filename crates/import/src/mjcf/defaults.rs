//! Classes of defaults.

use std::collections::HashMap;

use roxmltree::{Attribute, Node};

use crate::xml::{Source, elements};

/// The class of elements that name none.
const MAIN: &str = "main";

/// Deepest nesting of classes, less than a stack holds.
const DEEPEST: usize = 200;

/// An element whose attributes are looked for, with the class that its body gives to what names
/// none.
#[derive(Clone, Copy)]
pub(super) struct Lookup<'a, 'c> {
    pub node: Node<'a, 'a>,
    pub class: Option<&'c str>,
}

/// The attributes that classes give to elements which do not state them.
#[derive(Default)]
pub(super) struct Defaults<'a> {
    /// By name: the class that it goes on from, and its attributes by element and name.
    classes: HashMap<&'a str, Class<'a>>,
}

#[derive(Default)]
struct Class<'a> {
    parent: Option<&'a str>,
    values: HashMap<(&'a str, &'a str), Attribute<'a, 'a>>,
}

impl<'a> Defaults<'a> {
    /// Takes in an element `default` and those in it.
    pub fn read(&mut self, source: &mut Source<'a>, node: Node<'a, 'a>, parent: Option<&'a str>) {
        source.only(node, &[&["class"]]);
        let name = match (node.attribute("class"), parent) {
            (Some(name), _) => name,
            (None, None) => MAIN,
            (None, Some(_)) => {
                source.fault(node, "a <default> in another has no class", "name its `class`");
                return;
            }
        };
        if name != MAIN && parent.is_none() {
            let message = format!("the outermost <default> has the class `{name}`, not `main`");
            source.fault(node, message, "leave its `class` out");
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
            let values = &mut self.classes.entry(name).or_default().values;
            values.extend(child.attributes().map(|value| ((tag, value.name()), value)));
        }
    }

    /// The attribute `name` of an element: its own, or that of its class, of the class that this goes
    /// on from, and so on.
    pub fn find(&self, element: Lookup<'a, '_>, name: &str) -> Option<Attribute<'a, 'a>> {
        let Lookup { node, class } = element;
        if let Some(own) = node.attribute_node(name) {
            return Some(own);
        }
        let tag = node.tag_name().name();
        // A free joint takes nothing from joints, nor has a body any defaults.
        let mut class = Some(node.attribute("class").or(class).unwrap_or(MAIN));
        while let Some(found) = class.and_then(|class| self.classes.get(class)) {
            if let Some(value) = found.values.get(&(tag, name)) {
                return Some(*value);
            }
            class = found.parent;
        }
        None
    }

    /// Notes a class that does not exist.
    pub fn check(&self, source: &mut Source<'a>, node: Node<'a, 'a>, attribute: &str) {
        let Some(named) = node.attribute_node(attribute) else { return };
        if named.value() != MAIN && !self.classes.contains_key(named.value()) {
            let message = format!("there is no class `{}`", named.value());
            source.fault_of(named, message, "name one of those under <default>");
        }
    }
}
