//! Objects with room for a blade below them: keys of their heights, their reading, and their rules.

use crate::asset::node::Node;
use crate::asset::spec::{Key, Range, Value};
use crate::asset::strict::Ledger;
use crate::asset::take::{angle, name_of, pose, triple, vector};
use crate::geometry::{Pose, Solid, Vector, centroid, common_area, cross};
use crate::scene::{Object, Obstacle, Plate, Slab, carries};

use super::obstacles::obstacle;
use super::parts::rise;

/// A centre of mass that is nearer to the origin of its frame is there, metres: sums of corners
/// that were written about it do not come to zero exactly.
const CENTRED: f64 = 1e-9;

/// Bodies may sink into each other by this much before it is a fault, metres: the rounding of
/// sizes written in tenths of millimetres and turned by degrees.
const SLACK: f64 = 1e-4;

/// Room for a blade below an object.
pub(super) const CLEARANCE: Key = Key::optional(
    "clearance",
    HEIGHT,
    "Free height below the underside at its edge, metres: room for a blade. An object that lies no \
     higher stands on feet of this height at its corners; default `z`.",
);

/// Height of an object above the table.
pub(super) const Z: Key = Key::optional(
    "z",
    HEIGHT,
    "Height of the underside above the table, metres; default `clearance`, or else 0. An object that \
     lies higher than its clearance needs obstacles below it.",
);

const HEIGHT: Value = Value::Number(Range {
    what: "a height in metres",
    low: 0.0,
    high: 1.0,
    advice: "6 mm is 0.006",
});

/// Returns `true` if an object is described as one that a blade goes under.
pub(super) fn is_plate(object: &Node) -> bool {
    object.get("clearance").is_some() || object.get("z").is_some()
}

/// The object as a scene has it.
pub(super) fn object(node: &Node) -> Option<Object> {
    plate(node)?.object()
}

/// A plate with its frame below its centre of mass.
fn plate(node: &Node) -> Option<Plate> {
    let (base, origin) = solid(node.get("shape")?)?;
    let top = base.height;
    let mut slabs = vec![base];
    for part in node.get("parts").map(Node::items).unwrap_or_default() {
        let (mut slab, own) = solid(part.get("shape")?)?;
        let turn = Pose { position: Vector::zeros(), heading: angle(part, "yaw_deg", 0.0)? };
        let place = part.get("position")?;
        let shift = vector(place)? - origin;
        slab.bottom = rise(part, top)?;
        for corner in &mut slab.corners {
            *corner = turn.vector(*corner - own) + shift;
        }
        slabs.push(slab);
    }
    slabs[0].corners.iter_mut().for_each(|corner| *corner -= origin);
    let stated = |key| node.get(key).map(Node::number);
    let (clearance, z) = match (stated("clearance"), stated("z")) {
        (Some(clearance), Some(z)) => (clearance?, z?),
        (Some(both), None) | (None, Some(both)) => (both?, both?),
        (None, None) => return None,
    };
    let plate = Plate {
        name: name_of(node)?.into(),
        slabs,
        mass: node.get("mass")?.number()?,
        friction: node.get("friction")?.number()?,
        clearance,
        pose: pose(node)?,
        z,
    };
    let off = plate.weight().centre.xy().norm();
    Some(if off > CENTRED { plate.balanced() } else { plate })
}

/// A solid in the frame that its corners are written in, and the point of it that a position
/// speaks of.
fn solid(shape: &Node) -> Option<(Slab, Vector)> {
    if let Some(prism) = shape.get("prism") {
        let corners = prism.get("corners")?.items().iter().map(vector);
        let mut corners: Vec<Vector> = corners.collect::<Option<_>>()?;
        if corners.len() < 3 {
            return None;
        }
        let area: f64 =
            (0..corners.len()).map(|k| cross(corners[k], corners[(k + 1) % corners.len()])).sum();
        // Counter-clockwise, the first corner staying the first.
        if area < 0.0 {
            corners[1..].reverse();
        }
        let origin = match prism.get("origin") {
            Some(origin) => vector(origin)?,
            None => centroid(&corners),
        };
        let height = prism.get("height")?.number()?;
        return Some((Slab { corners, bottom: 0.0, height }, origin));
    }
    let [x, y, height] = triple(shape.get("cuboid")?, "size")?;
    let (x, y) = (0.5 * x, 0.5 * y);
    let corners = [[-x, -y], [x, -y], [x, y], [-x, y]].map(|[x, y]| Vector::new(x, y));
    Some((Slab { corners: corners.to_vec(), bottom: 0.0, height }, Vector::zeros()))
}

/// Notes faults between the heights of an object.
pub(super) fn heights(object: &Node, ledger: &mut Ledger) {
    if let (Some(clearance), Some(node)) = (object.get("clearance"), object.get("z"))
        && let (Some(clearance), Some(z)) = (clearance.number(), node.number())
        && z < clearance
    {
        let message = format!("the underside is at {z} m, but {clearance} m are free below");
        ledger.fault(node, message, "raise `z`, or lower the clearance");
    }
}

/// Notes what shares space in three dimensions, and what nothing holds.
pub(super) fn bodies(objects: &[Node], obstacles: &[Node], ledger: &mut Ledger) {
    let plates: Vec<Option<Plate>> = objects.iter().map(plate).collect();
    let blocks: Vec<Option<Obstacle>> = obstacles.iter().map(obstacle).collect();
    for (k, (node, plate)) in objects.iter().zip(&plates).enumerate() {
        let Some(plate) = plate else { continue };
        let place = node.get("position").unwrap_or(node);
        let own = plate.solids();
        let earlier = plates[..k].iter().flatten().map(|other| (&other.name, other.solids()));
        let fixed = blocks.iter().flatten().map(|block| (&block.name, vec![block.solid()]));
        for (name, others) in earlier.chain(fixed) {
            let deep = |a: &Solid| others.iter().any(|b| a.depth(b) > SLACK);
            if own.iter().any(deep) {
                let message = format!("`{}` overlaps `{name}`", plate.name);
                let advice = "move one of them, or mind `z`; bodies may touch but not share space";
                ledger.fault(place, message, advice);
            }
        }
        if !plate.has_feet() && !is_held(plate, &blocks) {
            let message = format!("nothing holds `{}` at {} m", plate.name, micrometres(plate.z));
            let advice = "obstacles below it must end at `z` on both sides of its centre of mass; \
                          or let it stand on feet: leave `z` out";
            ledger.fault(node.get("z").unwrap_or(place), message, advice);
        }
    }
}

/// Whether blocks that end at its underside carry a plate.
fn is_held(plate: &Plate, blocks: &[Option<Obstacle>]) -> bool {
    let mut points: Vec<Vector> = Vec::new();
    let below = |block: &&Obstacle| (block.z + block.size[2] - plate.z).abs() <= SLACK;
    for block in blocks.iter().flatten().filter(below) {
        let [x, y] = [0.5 * block.size[0], 0.5 * block.size[1]];
        let local = |corner: [f64; 2]| {
            let at: Pose = plate.pose.inverse() * block.pose;
            at.point(Vector::new(corner[0], corner[1]))
        };
        let corners = [[-x, -y], [x, -y], [x, y], [-x, y]].map(local);
        points.extend(common_area(plate.corners(), &corners));
    }
    points.len() >= 3 && carries(&points).is_some()
}

/// A height without what adding lengths in binary leaves behind.
fn micrometres(metres: f64) -> f64 {
    (metres * 1e6).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plate_is_held_by_what_ends_below_it_on_both_sides() {
        let block = |x: f64, top: f64| Obstacle {
            name: "standoff".into(),
            size: [0.01, 0.06, top],
            pose: Pose::new(x, 0.0, 0.0),
            z: 0.0,
            friction: 0.5,
        };
        let corner = |x: f64, y: f64| Vector::new(x, y);
        let corners = vec![
            corner(-0.04, -0.03),
            corner(0.04, -0.03),
            corner(0.04, 0.03),
            corner(-0.04, 0.03),
        ];
        let plate = Plate {
            name: "board".into(),
            slabs: vec![crate::scene::Slab { corners, bottom: 0.0, height: 0.002 }],
            mass: 0.03,
            friction: 0.4,
            clearance: 0.006,
            pose: Pose::default(),
            z: 0.01,
        };
        let held = |blocks: &[Obstacle]| {
            is_held(&plate, &blocks.iter().cloned().map(Some).collect::<Vec<_>>())
        };
        assert!(held(&[block(-0.03, 0.01), block(0.03, 0.01)]));
        assert!(!held(&[block(0.02, 0.01), block(0.03, 0.01)]), "both on one side");
        assert!(!held(&[block(-0.03, 0.01), block(0.03, 0.009)]), "one is too low");
        assert_eq!(plate.solids()[0].lowest(), plate.z);
    }
}
