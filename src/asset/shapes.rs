//! Solids in files: cylinders, cuboids and prisms, these with corners and centre of mass in a frame of the file's own.

use crate::geometry::{ConvexPolygon, MAX_CORNERS, PolygonError, Pose, Shape, Vector, centroid};

use super::node::Node;
use super::spec::{EXTENTS, Key, POSITION, SIZE, Value};
use super::strict::Ledger;
use super::take::{pose, triple, vector};

/// A solid standing upright.
pub(super) const SHAPE: Value = Value::Variant(&[
    Key::optional("cylinder", CYLINDER, "An upright cylinder; no default."),
    Key::optional("cuboid", CUBOID, "A cuboid with its faces along its own axes; no default."),
    Key::optional("prism", PRISM, "An upright prism on a convex polygon; no default."),
]);

/// A solid standing upright, with the point of it that a position names.
pub(super) const PLACED_SHAPE: Value = Value::Variant(&[
    Key::optional("cylinder", CYLINDER, "An upright cylinder; no default."),
    Key::optional("cuboid", CUBOID, "A cuboid with its faces along its own axes; no default."),
    Key::optional("prism", PLACED_PRISM, "An upright prism on a convex polygon; no default."),
]);

/// The extents of a cylinder.
pub(super) const CYLINDER: Value = Value::Map(&[
    Key::required("radius", SIZE, "Radius in metres."),
    Key::required("height", SIZE, "Height in metres."),
]);

/// The extents of a cuboid.
pub(super) const CUBOID: Value =
    Value::Map(&[Key::required("size", EXTENTS, "Full extents [x, y, z] in metres.")]);

/// What a file may say of a prism.
const PRISM: Value = Value::Map(&[CORNERS, HEIGHT, CENTRE]);

/// What a file may say of a prism whose position may be that of another point.
const PLACED_PRISM: Value = Value::Map(&[
    CORNERS,
    HEIGHT,
    CENTRE,
    Key::optional(
        "origin",
        POSITION,
        "The point whose place `position` names, [x, y] in metres from the same origin; by default the \
         centre of mass.",
    ),
]);

const CORNERS: Key = Key::required(
    "corners",
    Value::List { of: &POSITION, items: "corners", min: 3, max: MAX_CORNERS },
    "Corners of the convex base in order, [x, y] in metres, from any origin along the axes of the \
     body's own frame.",
);

const HEIGHT: Key = Key::required("height", SIZE, "Height in metres.");

const CENTRE: Key = Key::optional(
    "centre_of_mass",
    POSITION,
    "Centre of mass, [x, y] in metres from the same origin; by default the centroid of the base. The \
     body's position is where this is.",
);

/// The solid under `shape`.
pub(super) fn shape(node: &Node) -> Option<Shape> {
    if let Some(cylinder) = node.get("cylinder") {
        let radius = cylinder.get("radius")?.number()?;
        return Some(Shape::Cylinder { radius, height: cylinder.get("height")?.number()? });
    }
    if let Some(prism) = node.get("prism") {
        return self::prism(prism);
    }
    Some(Shape::Cuboid { size: triple(node.get("cuboid")?, "size")? })
}

/// The pose of a body whose `shape` may state the point that its position names.
pub(super) fn placed(node: &Node) -> Option<Pose> {
    let pose = pose(node)?;
    let shift = node.get("shape").map_or(Some(Vector::zeros()), self::shift)?;
    // Most state none, and adding nothing would still round.
    let moved = shift != Vector::zeros();
    Some(if moved { Pose { position: pose.point(shift), ..pose } } else { pose })
}

/// The prism, if nothing of it is missing or faulty.
fn prism(node: &Node) -> Option<Shape> {
    let base = base(&corners(node)?, centre(node)?).ok()?;
    Some(Shape::Prism { base, height: node.get("height")?.number()? })
}

/// Where the origin of a body of that `shape` lies in the frame in which the file describes it: a
/// prism's centre of mass.
pub(super) fn origin(shape: &Node) -> Option<Vector> {
    match shape.get("prism") {
        Some(node) => Some(centre(node)?.unwrap_or(centroid(&corners(node)?))),
        None => Some(Vector::zeros()),
    }
}

/// Where the origin of a body of that `shape` lies from the point that a position names: elsewhere for a
/// prism that states one.
pub(super) fn shift(shape: &Node) -> Option<Vector> {
    match shape.get("prism").and_then(|prism| prism.get("origin")) {
        Some(named) => Some(origin(shape)? - vector(named)?),
        None => Some(Vector::zeros()),
    }
}

/// Notes what makes the `shape` of a body no convex prism.
pub(super) fn check(shape: Option<&Node>, ledger: &mut Ledger) {
    if let Some(node) = shape.and_then(|shape| shape.get("prism")) {
        check_base(node, ledger);
    }
}

/// Notes what makes the corners of `node` no convex polygon.
pub(super) fn check_base(node: &Node, ledger: &mut Ledger) {
    let (Some(corners), Some(centre)) = (corners(node), centre(node)) else { return };
    let Err(error) = base(&corners, centre) else { return };
    let list = node.get("corners");
    let corner = |k: usize| list.and_then(|list| list.items().get(k));
    let (place, advice) = match error {
        PolygonError::Count(_) => (list, "leave out corners that matter least"),
        PolygonError::Doubled(k) => (corner(k), "leave it out; corners are 1 mm apart or more"),
        PolygonError::Straight(k) => (corner(k), "leave it out; the outline is the same"),
        PolygonError::Inwards(k) => {
            (corner(k), "make it convex, or join several convex objects by fixed joints")
        }
        PolygonError::Crossing => (list, "write the corners in the order around the outline"),
        PolygonError::Size => (list, "lengths are in metres: 50 mm is 0.05"),
        PolygonError::Unbalanced => {
            (node.get("centre_of_mass"), "it is counted from the same origin as the corners")
        }
    };
    ledger.fault(place.unwrap_or(node), error.to_string(), advice);
}

fn base(corners: &[Vector], centre: Option<Vector>) -> Result<ConvexPolygon, PolygonError> {
    match centre {
        Some(centre) => ConvexPolygon::balanced(corners, centre),
        None => ConvexPolygon::new(corners),
    }
}

/// The corners; none where their list was faulty.
fn corners(node: &Node) -> Option<Vec<Vector>> {
    let corners: Vec<Vector> =
        node.get("corners")?.items().iter().map(vector).collect::<Option<_>>()?;
    (!corners.is_empty()).then_some(corners)
}

/// The centre of mass, if one is stated; the outer `None` if it is faulty.
fn centre(node: &Node) -> Option<Option<Vector>> {
    match node.get("centre_of_mass") {
        Some(centre) => Some(Some(vector(centre)?)),
        None => Some(None),
    }
}
