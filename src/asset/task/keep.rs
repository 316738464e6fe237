//! Constraints of a task file: objects that must stay, and regions that must stay free.

use serde_json::{Value as Json, json};

use crate::asset::node::Node;
use crate::asset::shapes;
use crate::asset::spec::{ANGLE, Key, MOST_BODIES, POSITION, SIZE, Value, numbers};
use crate::asset::strict::Ledger;
use crate::asset::take::{name_of, pose, vector};
use crate::geometry::{ConvexPolygon, MAX_CORNERS, Pose, Shape};
use crate::scene::Region;

use super::bodies::body;

/// Height of a region as a solid, metres; the value has no effect.
const HEIGHT: f64 = 1.0;

/// Default distance by which a kept object may move, metres.
pub(super) const KEPT_WITHIN: f64 = 0.005;

/// Key of the objects that must stay in place.
pub(in crate::asset) const KEEP: Key = Key::optional(
    "keep",
    Value::Map(&[
        Key::required(
            "objects",
            Value::List { of: &Value::Name, items: "names of objects", min: 1, max: MOST_BODIES },
            "Names of objects that must stay in place.",
        ),
        Key::optional(
            "within",
            SIZE,
            "Largest displacement of any corner of a kept object at any time, metres; default \
             0.005.",
        ),
    ]),
    "Objects that no plan may move; by default every object may be displaced, but none may topple \
     or fall.",
);

/// Key of the regions that must stay free.
pub(in crate::asset) const KEEP_OUT: Key = Key::optional(
    "keep_out",
    Value::List { of: &REGION, items: "regions", min: 0, max: 16 },
    "Keep-out regions of the table for objects, tool or hand, from the table to the ceiling; by \
     default none.",
);

const REGION: Value = Value::Map(&[
    Key::required("name", Value::Name, "The region's name, different from the name of any body."),
    AREA,
    AREA_POSITION,
    AREA_YAW,
    Key::optional(
        "for",
        Value::List { of: &Value::Word(WORDS), items: "words", min: 1, max: 3 },
        "Kinds of bodies that must stay out: `objects`, `tool`, `hand`; by default all of them.",
    ),
]);

/// Key of the outline of a region.
pub(super) const AREA: Key = Key::required(
    "area",
    Value::Variant(&[
        Key::optional(
            "circle",
            Value::Map(&[Key::required("radius", SIZE, "Radius in metres.")]),
            "A circle; no default.",
        ),
        Key::optional(
            "rectangle",
            Value::Map(&[Key::required(
                "size",
                numbers(&SIZE, 2),
                "Full extents [x, y] in metres.",
            )]),
            "A rectangle; no default.",
        ),
        Key::optional(
            "polygon",
            Value::Map(&[Key::required(
                "corners",
                Value::List { of: &POSITION, items: "corners", min: 3, max: MAX_CORNERS },
                "Corners in order, [x, y] in metres from the region's position.",
            )]),
            "A convex polygon; no default.",
        ),
    ]),
    "Outline of the region.",
);

/// Key of the position of a region.
pub(super) const AREA_POSITION: Key = Key::optional(
    "position",
    POSITION,
    "Position, [x, y] in metres: the middle of a circle or rectangle; default [0, 0].",
);

/// Key of the rotation of a region.
pub(super) const AREA_YAW: Key = Key::optional("yaw_deg", ANGLE, "Rotation, degrees; default 0.");

const WORDS: &[&str] = &["objects", "tool", "hand"];

/// Returns the regions; `None` if one is faulty.
pub(super) fn regions(root: &Node) -> Option<Vec<Region>> {
    root.get("keep_out").map(Node::items).unwrap_or_default().iter().map(region).collect()
}

/// Returns outline and pose of a region.
pub(super) fn area(node: &Node) -> Option<(Shape, Pose)> {
    let area = node.get("area")?;
    let at = match node.get("position") {
        Some(_) => pose(node)?,
        None => {
            Pose { heading: crate::asset::take::angle(node, "yaw_deg", 0.0)?, ..Pose::default() }
        }
    };
    if let Some(circle) = area.get("circle") {
        return Some((
            Shape::Cylinder { radius: circle.get("radius")?.number()?, height: HEIGHT },
            at,
        ));
    }
    if let Some(rectangle) = area.get("rectangle") {
        let size = vector(rectangle.get("size")?)?;
        return Some((Shape::Cuboid { size: [size.x, size.y, HEIGHT] }, at));
    }
    let corners = area.get("polygon")?.get("corners")?.items();
    let corners: Vec<_> = corners.iter().map(vector).collect::<Option<_>>()?;
    let centre = crate::geometry::centroid(&corners);
    let base = ConvexPolygon::new(&corners).ok()?;
    let middle = Pose { position: centre, heading: 0.0 };
    Some((Shape::Prism { base, height: HEIGHT }, at * middle))
}

fn region(node: &Node) -> Option<Region> {
    let (shape, pose) = area(node)?;
    let words = node.get("for").map(Node::items);
    let is_for =
        |word: &str| words.is_none_or(|words| words.iter().any(|one| one.text() == Some(word)));
    Some(Region {
        name: name_of(node)?.into(),
        shape,
        pose,
        objects: is_for("objects"),
        tool: is_for("tool"),
        hand: is_for("hand"),
    })
}

/// Reports a fault if an outline is invalid.
pub(super) fn check_area(node: &Node, ledger: &mut Ledger) {
    if let Some(polygon) = node.get("area").and_then(|area| area.get("polygon")) {
        shapes::check_base(polygon, ledger);
    }
}

/// Reports regions that are invalid, share a name with another body, or contain an object.
pub(super) fn check(root: &Node, bodies: &[&Node], objects: &[Node], ledger: &mut Ledger) {
    let regions = root.get("keep_out").map(Node::items).unwrap_or_default();
    for (k, node) in regions.iter().enumerate() {
        let taken = |other: &&Node| name_of(other).is_some() && name_of(other) == name_of(node);
        if bodies.iter().copied().chain(&regions[..k]).any(|other| taken(&other)) {
            let message =
                format!("another body or region is called `{}`", name_of(node).unwrap_or("?"));
            ledger.fault(
                node.get("name").unwrap_or(node),
                message,
                "rename one; messages refer to names",
            );
        }
        check_area(node, ledger);
        let Some(region) = region(node).filter(|region| region.objects) else { continue };
        for object in objects {
            let inside = body(object).is_some_and(|(shape, pose)| region.holds(&shape, &pose, 0.0));
            if inside {
                let name = name_of(object).unwrap_or("?");
                let message = format!("`{name}` stands in the keep-out region `{}`", region.name);
                ledger.fault(node, message, "move one of them, or leave `objects` out of `for`");
            }
        }
    }
}

/// Returns the outline of a region as in a task file.
pub(in crate::asset) fn emitted_area(shape: &Shape) -> Json {
    match *shape {
        Shape::Cylinder { radius, .. } => json!({"circle": {"radius": radius}}),
        Shape::Cuboid { size: [x, y, _] } => json!({"rectangle": {"size": [x, y]}}),
        Shape::Prism { base, .. } => {
            let corners: Vec<[f64; 2]> = base.corners().iter().map(|at| (*at).into()).collect();
            json!({"polygon": {"corners": corners}})
        }
    }
}

/// Returns a region as in a task file.
pub(in crate::asset) fn emitted(region: &Region) -> Json {
    let area = emitted_area(&region.shape);
    let words = [(region.objects, "objects"), (region.tool, "tool"), (region.hand, "hand")];
    let words = words.iter().filter(|(is_for, _)| *is_for).map(|(_, word)| *word);
    json!({"name": region.name, "area": area, "for": words.collect::<Vec<_>>()})
}
