//! Solids in files: cylinders, cuboids and prisms. Corners and centre of mass of a prism are given
//! in the file's own frame.

use crate::geometry::{ConvexPolygon, MAX_CORNERS, PolygonError, Pose, Shape, Vector, centroid};

use super::node::Node;
use super::spec::{EXTENTS, Key, POSITION, SIZE, Value};
use super::strict::Ledger;
use super::take::{pose, triple, vector};

/// Upright solid.
pub(super) const SHAPE: Value = Value::Variant(&[
    Key::optional("cylinder", CYLINDER, "An upright cylinder; no default."),
    Key::optional("cuboid", CUBOID, "A cuboid with its faces along its own axes; no default."),
    Key::optional("prism", PRISM, "An upright prism on a convex polygon; no default."),
]);

/// Upright solid, with the reference point of `position`.
pub(super) const PLACED_SHAPE: Value = Value::Variant(&[
    Key::optional("cylinder", CYLINDER, "An upright cylinder; no default."),
    Key::optional("cuboid", CUBOID, "A cuboid with its faces along its own axes; no default."),
    Key::optional("prism", PLACED_PRISM, "An upright prism on a convex polygon; no default."),
]);

/// Extents of a cylinder.
pub(super) const CYLINDER: Value = Value::Map(&[
    Key::required("radius", SIZE, "Radius in metres."),
    Key::required("height", SIZE, "Height in metres."),
]);

/// Extents of a cuboid.
pub(super) const CUBOID: Value =
    Value::Map(&[Key::required("size", EXTENTS, "Full extents [x, y, z] in metres.")]);

/// Specification of a prism.
const PRISM: Value = Value::Map(&[CORNERS, HEIGHT, CENTRE]);

/// Specification of a prism whose `position` may refer to another point than the centre of mass.
const PLACED_PRISM: Value = Value::Map(&[
    CORNERS,
    HEIGHT,
    CENTRE,
    Key::optional(
        "origin",
        POSITION,
        "The point located by `position`, [x, y] in metres from the same origin; by default the \
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
    "Centre of mass, [x, y] in metres from the same origin; by default the centroid of the base. \
     It is the point located by the body's position.",
);

/// Returns the solid under `shape`.
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

/// Returns the pose of a body whose `shape` may state the reference point of `position`.
pub(super) fn placed(node: &Node) -> Option<Pose> {
    let pose = pose(node)?;
    let shift = node.get("shape").map_or(Some(Vector::zeros()), self::shift)?;
    // Without a stated reference point, adding a zero shift would still round.
    let moved = shift != Vector::zeros();
    Some(if moved { Pose { position: pose.point(shift), ..pose } } else { pose })
}

/// Returns the prism unless a value is missing or faulty.
fn prism(node: &Node) -> Option<Shape> {
    let base = base(&corners(node)?, centre(node)?).ok()?;
    Some(Shape::Prism { base, height: node.get("height")?.number()? })
}

/// Returns the origin of a body of the given `shape` in the frame of the file: a prism's centre of
/// mass.
pub(super) fn origin(shape: &Node) -> Option<Vector> {
    match shape.get("prism") {
        Some(node) => Some(centre(node)?.unwrap_or(centroid(&corners(node)?))),
        None => Some(Vector::zeros()),
    }
}

/// Returns the origin of a body of the given `shape` relative to the reference point of `position`;
/// nonzero only for a prism that states an `origin`.
pub(super) fn shift(shape: &Node) -> Option<Vector> {
    match shape.get("prism").and_then(|prism| prism.get("origin")) {
        Some(named) => Some(origin(shape)? - vector(named)?),
        None => Some(Vector::zeros()),
    }
}

/// Reports a fault if the `shape` of a body is not a convex prism.
pub(super) fn check(shape: Option<&Node>, ledger: &mut Ledger) {
    if let Some(node) = shape.and_then(|shape| shape.get("prism")) {
        check_base(node, ledger);
    }
}

/// Reports a fault if the corners of `node` do not form a convex polygon.
pub(super) fn check_base(node: &Node, ledger: &mut Ledger) {
    let (Some(corners), Some(centre)) = (corners(node), centre(node)) else { return };
    let Err(error) = base(&corners, centre) else { return };
    let list = node.get("corners");
    let corner = |k: usize| list.and_then(|list| list.items().get(k));
    let (place, advice) = match error {
        PolygonError::Count(_) => (list, "leave out the corners that matter least"),
        PolygonError::Doubled(k) => (corner(k), "leave it out; corners must be 1 mm apart or more"),
        PolygonError::Straight(k) => (corner(k), "leave it out; the outline does not change"),
        PolygonError::Inwards(k) => {
            (corner(k), "make it convex, or join several convex objects by fixed joints")
        }
        PolygonError::Crossing => (list, "write the corners in their order around the outline"),
        PolygonError::Size => (list, "lengths are in metres: 50 mm is 0.05"),
        PolygonError::Unbalanced => {
            (node.get("centre_of_mass"), "it is measured from the same origin as the corners")
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

/// Returns the corners; `None` if their list is faulty.
fn corners(node: &Node) -> Option<Vec<Vector>> {
    let corners: Vec<Vector> =
        node.get("corners")?.items().iter().map(vector).collect::<Option<_>>()?;
    (!corners.is_empty()).then_some(corners)
}

/// Returns the stated centre of mass, if any; the outer `None` if it is faulty.
fn centre(node: &Node) -> Option<Option<Vector>> {
    match node.get("centre_of_mass") {
        Some(centre) => Some(Some(vector(centre)?)),
        None => Some(None),
    }
}
