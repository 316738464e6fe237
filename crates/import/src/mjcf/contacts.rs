//! Explicit contact pairs and exclusions.

use roxmltree::Node;

use crate::Language;
use crate::model::Model;
use crate::xml::{Source, elements};

use super::defaults::Lookup;
use super::geoms::Context;

/// Reads a `contact` element.
pub(super) fn pairs<'a>(
    source: &mut Source<'a>,
    context: &Context<'a>,
    node: Node<'a, 'a>,
    model: &mut Model,
) {
    for pair in elements(node) {
        let tag = pair.tag_name().name();
        if tag != "pair" && tag != "exclude" {
            let message = format!("<{tag}> is not supported: in pushplan all bodies collide");
            source.fault(pair, message, "remove it");
            continue;
        }
        let element = Lookup { node: pair, class: None };
        source.judge(Language::Mjcf, tag, pair, |name| context.defaults.find(element, name));
        if tag == "exclude" {
            let names = ["body1", "body2"].map(|name| pair.attribute(name).unwrap_or_default());
            model.excluded.push((source.place(pair), names.map(str::to_owned)));
            continue;
        }
        let names = ["geom1", "geom2"].map(|name| pair.attribute(name).unwrap_or_default());
        let Some(friction) = context.defaults.find(element, "friction") else { continue };
        if let Some([first, ..]) = source.list(friction).as_deref() {
            model.pairs.push((names.map(str::to_owned), *first));
        }
    }
}
