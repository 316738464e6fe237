//! Kinds of joints in a file: fixed, revolute and prismatic, with axis and limits.

use crate::asset::node::Node;
use crate::asset::take::{angle_of, vector};
use crate::geometry::Vector;
use crate::scene::{JointKind, Span};

/// Tolerance of the squared length of a unit vector. A vector within it is not normalised again, so
/// that repeated reading and writing keeps the same bits.
const UNIT: f64 = 1e-12;

/// Returns the kind of a joint; `None` if a required value is missing or faulty.
pub(super) fn kind_of(node: &Node) -> Option<JointKind> {
    Some(match node.get("kind")?.text()? {
        "fixed" => JointKind::Fixed,
        "revolute" => JointKind::Revolute {
            at: vector(node.get("at")?)?,
            limits: limits(node, "limits_deg", angle_of)?,
        },
        _ => JointKind::Prismatic {
            axis: unit(vector(node.get("axis")?)?)?,
            limits: limits(node, "limits", Node::number)?,
        },
    })
}

/// Returns the limits: `Some(None)` if there are none, `None` if they are faulty.
fn limits(node: &Node, key: &str, read: fn(&Node) -> Option<f64>) -> Option<Option<Span>> {
    match node.get(key).map(Node::items) {
        None => Some(None),
        Some([low, high]) => Some(Some(Span::new(read(low)?, read(high)?))),
        Some(_) => None,
    }
}

/// Returns `axis` normalised; `None` if it has length zero.
pub(super) fn unit(axis: Vector) -> Option<Vector> {
    if (axis.norm_squared() - 1.0).abs() <= UNIT {
        return Some(axis);
    }
    axis.try_normalize(0.0)
}
