//! Bodies of a scene in a file: their footprints, heights and names.

use crate::asset::diagnostic::did_you_mean;
use crate::asset::node::Node;
use crate::asset::shapes::{placed, shape};
use crate::asset::strict::Ledger;
use crate::asset::take::{name_of, triple};
use crate::geometry::{Footprint, Pose, Shape};

use super::obstacles as fixed;

/// Penetration depth between bodies that is not yet a fault, metres. It covers the rounding of
/// sizes in whole millimetres and headings in whole degrees.
pub(super) const SLACK: f64 = 1e-4;

/// Returns footprint and pose of a body.
pub(super) fn body(node: &Node) -> Option<(Footprint, Pose)> {
    let shape = match node.get("shape") {
        Some(node) => shape(node)?,
        None => Shape::Cuboid { size: triple(node, "size")? },
    };
    Some((shape.footprint(), placed(node)?))
}

/// Returns `true` if one of the two bodies ends below the other.
pub(super) fn passes(one: &Node, other: &Node, slack: f64) -> bool {
    let heights = heights(one).zip(heights(other));
    let ends_below = |one: [f64; 2], other: [f64; 2]| other[0] > 0.0 && one[1] - slack <= other[0];
    heights.is_some_and(|(one, other)| ends_below(one, other) || ends_below(other, one))
}

/// Returns the heights of the underside and the top of a body above the table, metres.
fn heights(node: &Node) -> Option<[f64; 2]> {
    let height = match node.get("shape") {
        Some(solid) => shape(solid)?.height(),
        None => triple(node, "size")?[2],
    };
    let low = fixed::height(node.get("position")?, 0.0)?;
    Some([low, low + height])
}

/// Returns the object called `name`; reports a fault if there is none.
pub(super) fn known_object<'a>(
    name: &Node,
    objects: &'a [Node],
    obstacles: &[Node],
    ledger: &mut Ledger,
) -> Option<&'a Node> {
    let wanted = name.text()?;
    let found = objects.iter().find(|object| name_of(object) == Some(wanted));
    if found.is_none() {
        if obstacles.iter().any(|obstacle| name_of(obstacle) == Some(wanted)) {
            let message = format!("`{wanted}` is an obstacle, which is fixed to the table");
            ledger.fault(name, message, "name an object; only objects can be pushed");
        } else {
            let advice = did_you_mean(wanted, objects.iter().filter_map(name_of));
            ledger.fault(name, format!("no object is called `{wanted}`"), advice);
        }
    }
    found
}
