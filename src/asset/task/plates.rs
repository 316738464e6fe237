//! Objects with clearance for a blade: keys of their heights, parsing and rules.

use crate::asset::node::Node;
use crate::asset::shapes::{origin, shape};
use crate::asset::strict::Ledger;
use crate::asset::take::{angle, number_or, pose, position, triple, vector};
use crate::geometry::{ConvexPolygon, Pose, Shape, Solid, Vector, centroid, common_area, cross};
use crate::scene::{Object, Obstacle, Plate, Scene, Slab, Support, Whole, carries};

use super::obstacles::obstacle;
use super::part::{self, part_name, rise, shares};
use super::parts::objects as objects_of;
use super::support::support;

/// Distance below which a centre of mass counts as the origin of its frame, metres, because sums of
/// corners written about the centre are not exactly zero.
const CENTRED: f64 = 1e-9;

/// Penetration depth between bodies that is not yet a fault, metres. It covers the rounding of
/// sizes in tenths of millimetres and headings in whole degrees.
const SLACK: f64 = 1e-4;

/// Returns `true` if the description of an object states a clearance or a height.
pub(super) fn is_plate(object: &Node) -> bool {
    object.get("clearance").is_some() || object.get("z").is_some()
}

/// Solid in the frame of its corners, with the reference point of its position.
struct Drawn {
    corners: Vec<Vector>,
    height: f64,
    named: Vector,
}

impl Drawn {
    /// Reads the solid under `shape`; its corners run counter-clockwise from the first one.
    fn read(shape: &Node) -> Option<Self> {
        let Some(prism) = shape.get("prism") else {
            let [x, y, height] = triple(shape.get("cuboid")?, "size")?;
            let (x, y) = (0.5 * x, 0.5 * y);
            let corners = [[-x, -y], [x, -y], [x, y], [-x, y]].map(|[x, y]| Vector::new(x, y));
            return Some(Self { corners: corners.to_vec(), height, named: Vector::zeros() });
        };
        let corners = prism.get("corners")?.items().iter().map(vector);
        let mut corners: Vec<Vector> = corners.collect::<Option<_>>()?;
        if corners.len() < 3 {
            return None;
        }
        let area: f64 =
            (0..corners.len()).map(|k| cross(corners[k], corners[(k + 1) % corners.len()])).sum();
        if area < 0.0 {
            corners[1..].reverse();
        }
        let named = match prism.get("origin") {
            Some(origin) => vector(origin)?,
            None => centroid(&corners),
        };
        Some(Self { corners, height: prism.get("height")?.number()?, named })
    }

    /// Returns the solid about its own centre, and the centre in the frame of its corners.
    fn solid(&self, shape: &Node) -> Option<(Shape, Vector)> {
        if shape.get("cuboid").is_some() {
            return Some((self::shape(shape)?, self.named));
        }
        let own = centroid(&self.corners);
        let centre = if (own - self.named).norm() > CENTRED { own } else { self.named };
        let base = ConvexPolygon::balanced(&self.corners, centre).ok()?;
        Some((Shape::Prism { base, height: self.height }, centre))
    }
}

/// Returns the solids of the object with index `index` in the scene, the object itself first. All
/// are in a frame whose origin is below the common centre of mass.
pub(super) fn solids(node: &Node, object: Object, index: usize) -> Option<Vec<Object>> {
    let name = &object.name;
    let Drawn { mut corners, height, named } = Drawn::read(node.get("shape")?)?;
    corners.iter_mut().for_each(|corner| *corner -= named);
    let mut slabs = vec![Slab { corners, bottom: 0.0, height }];
    let (mut others, mut stated) = (Vec::new(), vec![None]);
    for (k, part) in part::parts(node).iter().enumerate() {
        let drawn = Drawn::read(part.get("shape")?)?;
        let turn = Pose { position: Vector::zeros(), heading: angle(part, "yaw_deg", 0.0)? };
        let (shift, bottom) = (position(part)? - named, rise(part, height)?);
        let placed = |at: &Vector| turn.vector(*at - drawn.named) + shift;
        let corners = drawn.corners.iter().map(placed).collect();
        let (shape, centre) = drawn.solid(part.get("shape")?)?;
        let solid = Object {
            friction: number_or(part, "friction", object.friction)?,
            support: support(part)?,
            may_fall: object.may_fall,
            ..Object::new(part_name(name, part, k), shape).raised(bottom)
        };
        stated.push(part.get("mass").and_then(Node::number));
        others.push((solid, Pose { position: placed(&centre), ..turn }));
        slabs.push(Slab { corners, bottom, height: drawn.height });
    }
    let height = |key| node.get(key).map(Node::number);
    let (clearance, z) = match (height("clearance"), height("z")) {
        (Some(clearance), Some(z)) => (clearance?, z?),
        (Some(both), None) | (None, Some(both)) => (both?, both?),
        (None, None) => (0.0, 0.0),
    };
    let Object { mass, friction, .. } = object;
    let name = object.name.clone();
    let plate = Plate { name, slabs, mass, friction, clearance, pose: pose(node)?, z };
    let own = stated.iter().flatten().sum::<f64>();
    let volumes: Vec<f64> = plate.slabs.iter().map(Slab::volume).collect();
    let open = |k: &usize| stated[*k].is_none();
    let all: f64 = (0..volumes.len()).filter(open).map(|k| volumes[k]).sum();
    let share = |k: usize| stated[k].unwrap_or_else(|| (mass - own) * (volumes[k] / all));
    let masses: Vec<f64> = (0..volumes.len()).map(share).collect();
    let centre = plate.weight_of(&masses).centre.xy();
    let (plate, shift) = match centre.norm() > CENTRED {
        true => (plate.shifted(centre), centre),
        false => (plate, Vector::zeros()),
    };
    let shape = plate.slabs[0].around_origin()?;
    // Points of a support are given in the frame of the corners.
    let moved = origin(node.get("shape")?)? - named - shift;
    let support = match object.support {
        Support::Points(points) => {
            Support::Points(points.into_iter().map(|point| point + moved).collect())
        }
        other => other,
    };
    let object = Object { shape, pose: plate.pose, clearance, z, support, ..object };
    let part = |(solid, at): (Object, Pose)| {
        let place = Pose { position: at.position - shift, ..at };
        let whole = Some(Whole { object: index, place });
        Object { pose: object.pose * place, whole, ..solid }
    };
    let mut solids = vec![object.clone()];
    solids.extend(others.into_iter().map(part));
    let masses = shares(mass - own, &solids, &stated);
    solids.iter_mut().zip(masses).for_each(|(solid, mass)| solid.mass = mass);
    Some(solids)
}

/// Reports inconsistent heights of an object.
pub(super) fn heights(object: &Node, ledger: &mut Ledger) {
    if let (Some(clearance), Some(node)) = (object.get("clearance"), object.get("z"))
        && let (Some(clearance), Some(z)) = (clearance.number(), node.number())
        && z < clearance
    {
        let message = format!("the underside is at {z} m, but the clearance is {clearance} m");
        ledger.fault(node, message, "raise `z`, or lower the clearance");
    }
}

/// Reports bodies that overlap in three dimensions, and bodies that nothing supports.
pub(super) fn bodies(objects: &[Node], obstacles: &[Node], ledger: &mut Ledger) {
    let Some(solids) = objects_of(objects) else {
        let unread = |node: &&Node| objects_of(std::slice::from_ref(*node)).is_none();
        for node in objects.iter().filter(|node| is_plate(node)).filter(unread) {
            let message = "the outline of `shape` does not contain the centre of mass of all parts";
            let advice =
                "a blade lifts that outline: enlarge it, move the parts, or make them lighter";
            ledger.fault(node.get("shape").unwrap_or(node), message, advice);
        }
        return;
    };
    let plates: Vec<Plate> = Scene::new(solids).plates().collect();
    let blocks: Vec<Option<Obstacle>> = obstacles.iter().map(obstacle).collect();
    for (k, (node, plate)) in objects.iter().zip(&plates).enumerate() {
        let place = node.get("position").unwrap_or(node);
        let own = plate.solids();
        let earlier = plates[..k].iter().map(|other| (&other.name, other.solids()));
        let fixed = blocks.iter().flatten().map(|block| (&block.name, vec![block.solid()]));
        for (name, others) in earlier.chain(fixed) {
            let deep = |a: &Solid| others.iter().any(|b| a.depth(b) > SLACK);
            if own.iter().any(deep) {
                let message = format!("`{}` overlaps `{name}`", plate.name);
                let advice = "move one of them, or check `z`; bodies may touch but not overlap";
                ledger.fault(place, message, advice);
            }
        }
        if !plate.has_feet() && !is_held(plate, &blocks) {
            let message =
                format!("no obstacle supports `{}` at {} m", plate.name, micrometres(plate.z));
            let advice = "obstacles below it must end at `z` on both sides of its centre of mass; \
                          leave `z` out for an object on feet";
            ledger.fault(node.get("z").unwrap_or(place), message, advice);
        }
    }
}

/// Returns `true` if blocks that end at the plate's underside carry the plate.
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

/// Rounds a height to micrometres, which removes binary rounding errors of sums.
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
