//! Extraction of values from checked nodes. A value emptied by the check gives `None` without a
//! further fault, because its fault is already reported.

use crate::geometry::{Pose, Vector};

use super::node::Node;
use super::strict::Ledger;

/// Returns the value of `name`.
pub(super) fn name_of(node: &Node) -> Option<&str> {
    node.get("name")?.text()
}

/// Returns the number under `key`, `default` if the key is missing, or `None` if the number is
/// faulty.
pub(super) fn number_or(node: &Node, key: &str, default: f64) -> Option<f64> {
    node.get(key).map_or(Some(default), Node::number)
}

/// Returns the angle under `key` in radians; the default is `default` degrees.
pub(super) fn angle(node: &Node, key: &str, default: f64) -> Option<f64> {
    number_or(node, key, default).map(f64::to_radians)
}

/// Converts an angle written in degrees to radians.
pub(super) fn angle_of(node: &Node) -> Option<f64> {
    node.number().map(f64::to_radians)
}

/// Returns the first two numbers of a list.
pub(super) fn vector(node: &Node) -> Option<Vector> {
    let items = node.items();
    Some(Vector::new(items.first()?.number()?, items.get(1)?.number()?))
}

/// Returns the value of `position`, metres.
pub(super) fn position(node: &Node) -> Option<Vector> {
    vector(node.get("position")?)
}

/// Returns the pose given by `position` and `yaw_deg`.
pub(super) fn pose(node: &Node) -> Option<Pose> {
    Some(Pose { position: position(node)?, heading: angle(node, "yaw_deg", 0.0)? })
}

/// Returns the three numbers under `key`.
pub(super) fn triple(node: &Node, key: &str) -> Option<[f64; 3]> {
    match node.get(key)?.items() {
        [x, y, z] => Some([x.number()?, y.number()?, z.number()?]),
        _ => None,
    }
}

/// Reports every name that an earlier node already has.
pub(super) fn unique_names<'a>(
    nodes: impl IntoIterator<Item = &'a Node>,
    kind: &str,
    ledger: &mut Ledger,
) {
    let mut seen = Vec::new();
    for node in nodes {
        let Some(name) = node.get("name").filter(|name| name.text().is_some()) else { continue };
        if seen.contains(&name.text()) {
            let message = format!("two {kind} are called `{}`", name.text().unwrap_or_default());
            ledger.fault(name, message, "rename one; plans and messages refer to names");
        }
        seen.push(name.text());
    }
}
