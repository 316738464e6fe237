//! Friction of links in a URDF file, from the extensions of simulators, because URDF itself has no
//! friction.

use std::collections::HashMap;

use roxmltree::Node;

use pushplan::asset::Fault;

use super::xml::{Source, element, elements};

/// Properties of a link in `<gazebo reference="...">`.
#[derive(Default)]
pub(super) struct Gazebo {
    /// Friction value.
    pub friction: Option<f64>,
    /// Faults of the element.
    pub faults: Vec<Fault>,
}

/// Returns the friction of a link in Bullet's extension; the inner `None` with a fault if it is not
/// a number.
pub(super) fn friction<'a>(source: &mut Source<'a>, link: Node<'a, 'a>) -> Option<Option<f64>> {
    let contact = element(link, "contact")?;
    let value = element(contact, "lateral_friction")?.attribute_node("value")?;
    Some(source.number(value))
}

/// Returns the friction of a collision in Drake's extension: the dynamic friction, if stated.
pub(super) fn drake<'a>(source: &mut Source<'a>, collision: Node<'a, 'a>) -> Option<f64> {
    let find = |name: &str| {
        collision
            .descendants()
            .find(|node| node.tag_name().name() == name)
            .and_then(|node| node.attribute_node("value"))
    };
    let [slides, sticks] = ["mu_dynamic", "mu_static"].map(find);
    let friction = source.number(slides.or(sticks)?)?;
    if let Some(sticks) = sticks {
        let place = source.place_of(sticks);
        if source.number(sticks)? != friction {
            let note = "of the two friction values the dynamic one is used";
            source.ledger.note(place, note);
        }
    }
    Some(friction)
}

/// Returns the Gazebo properties of links, by name.
pub(super) fn gazebo<'a>(source: &mut Source<'a>, root: Node<'a, 'a>) -> HashMap<String, Gazebo> {
    let mut found: HashMap<String, Gazebo> = HashMap::new();
    for node in elements(root).filter(|node| node.has_tag_name("gazebo")) {
        let Some(link) = node.attribute("reference") else { continue };
        let before = source.ledger.count();
        let stated = ["mu1", "mu"].into_iter().find_map(|name| {
            let nested = || node.descendants().find(|inner| inner.has_tag_name(name));
            element(node, name).or_else(nested)
        });
        let friction = stated.and_then(|stated| {
            // Read as text, or as the attribute in old files.
            let text = stated.text().unwrap_or_default().trim();
            let text = if text.is_empty() { stated.attribute("value").unwrap_or("") } else { text };
            let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
            if number.is_none() {
                source.fault(stated, "this friction is not a number", "write a number such as 0.4");
            }
            number
        });
        for (name, bad, what) in [
            ("turnGravityOff", ["true", "1"], "does not have its full weight"),
            ("gravity", ["false", "0"], "does not have its full weight"),
            ("static", ["true", "1"], "is fixed"),
            ("kinematic", ["true", "1"], "is moved by a program"),
        ] {
            let word = element(node, name).and_then(|node| node.text()).unwrap_or_default();
            if bad.contains(&word.trim()) {
                let message = format!("<{name}> states that this link {what}");
                source.fault(node, message, "remove it");
            }
        }
        let known = found.entry(link.to_owned()).or_default();
        known.friction = friction.or(known.friction);
        known.faults.extend(source.ledger.since(before));
    }
    found
}
