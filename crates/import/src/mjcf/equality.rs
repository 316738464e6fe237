//! Equality constraints: a weld fixes two bodies to each other, every other one acts on the bodies
//! that it names.

use roxmltree::Node;

use crate::Language;
use crate::model::{Beyond, Model, Motion};
use crate::xml::{Source, elements};

use super::defaults::Lookup;
use super::geoms::Context;

/// Reads an `equality` element; inactive constraints have no effect.
pub(super) fn equality<'a>(
    source: &mut Source<'a>,
    context: &Context<'a>,
    section: Node<'a, 'a>,
    model: &mut Model,
) {
    for node in elements(section) {
        let tag = node.tag_name().name();
        let element = Lookup { node, class: None };
        let find = |name: &str| context.defaults.find(element, name);
        let inactive = find("active").is_some_and(|active| active.value() == "false");
        if inactive || !context.equality {
            continue;
        }
        let place = source.place(node);
        let before = source.ledger.count();
        source.judge(Language::Mjcf, &format!("equality/{tag}"), node, find);
        let faults = source.ledger.since(before);
        // A second body that is not named is the world.
        let body = |name: &str, other: Option<usize>| match find(name).map(|named| named.value()) {
            Some(name) => model.bodies.iter().position(|body| body.name == name),
            None => other,
        };
        let joint = |name: &str| model.joint(find(name)?.value());
        let bodies = match tag {
            "weld" | "connect" if find("site1").is_none() => {
                body("body1", None).zip(body("body2", Some(0))).map(|(a, b)| vec![a, b])
            }
            "joint" => joint("joint1").map(|a| {
                let second = find("joint2").map(|named| model.joint(named.value()));
                std::iter::once(a).chain(second.flatten()).collect()
            }),
            _ => None,
        };
        if let (Some(&[a, b]), "weld", true) = (bodies.as_deref(), tag, faults.is_empty())
            && welded(model, [a, b])
        {
            continue;
        }
        let why = faults.first().map_or(String::new(), |fault| format!(" ({})", fault.message));
        model.beyond.push(Beyond { place, what: format!("<{tag}>{why}"), bodies });
    }
}

/// Fixes two bodies to each other; returns `false` if their joints do not permit it.
fn welded(model: &mut Model, bodies: [usize; 2]) -> bool {
    let [a, b] = [bodies[0].min(bodies[1]), bodies[0].max(bodies[1])];
    let body = &mut model.bodies[b];
    // A body that is welded to itself stays as it is.
    if a == b {
        return true;
    }
    if body.parent == Some(a) || body.motion == Motion::Free && body.parent == Some(0) {
        body.parent = Some(a);
        body.motion = Motion::Fixed;
        return true;
    }
    false
}
