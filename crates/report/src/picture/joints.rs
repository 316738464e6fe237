//! Joint symbols: a bar for a fixed joint, a pin for a revolute one, a slot for a prismatic one.

use crate::svg::{Style, Svg};
use pushplan::geometry::{ContactPoint, Pose, Vector, contact_points, perpendicular};
use pushplan::scene::{Joint, JointKind, Object, Scene, Span};

use super::view::View;

/// Maximum difference of the gaps at both ends of two faces that count as flush, metres.
const FLAT: f64 = 5e-3;

/// Symbol of a joint type, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    /// Thick short bar across the gap.
    Bar,
    /// Pin at the axis.
    Pin,
    /// Two rails along the axis.
    Slot,
}

impl Symbol {
    /// Symbols with their meanings.
    pub const ALL: [(Symbol, &'static str); 3] = [
        (Symbol::Bar, "fixed joint"),
        (Symbol::Pin, "revolute joint"),
        (Symbol::Slot, "prismatic joint"),
    ];

    /// Returns the symbol of a joint.
    pub fn of(joint: &Joint) -> Self {
        match joint.kind {
            JointKind::Fixed => Symbol::Bar,
            JointKind::Revolute { .. } => Symbol::Pin,
            JointKind::Prismatic { .. } => Symbol::Slot,
        }
    }

    /// Draws the symbol at a position of the page, along a unit vector of the page, across a gap of
    /// `gap` pixels.
    pub fn draw(self, svg: &mut Svg, at: Vector, along: Vector, gap: f64, colour: &'static str) {
        let rim = "#ffffff";
        match self {
            Symbol::Bar => {
                let half = along * (0.5 * gap + 5.0).max(8.0);
                svg.line(at - half - along, at + half + along, Style::stroke(rim, 8.0));
                svg.line(at - half, at + half, Style::stroke(colour, 5.0));
            }
            Symbol::Pin => {
                svg.circle(at, 5.5, Style::fill(rim).outlined(colour, 2.0));
                svg.circle(at, 1.8, Style::fill(colour));
            }
            Symbol::Slot => {
                let half = along * (0.5 * gap + 8.0).max(13.0);
                svg.line(at - half, at + half, Style::stroke(rim, 10.0));
                for side in [3.5, -3.5].map(|offset| at + perpendicular(along) * offset) {
                    svg.line(side - half, side + half, Style::stroke(colour, 2.0));
                }
            }
        }
    }
}

/// Returns the joints of a scene except those between parts of one object.
pub fn between_things(scene: &Scene) -> impl Iterator<Item = &Joint> {
    let apart = |joint: &&Joint| {
        let [a, b] = joint.between.map(|k| scene.thing(k));
        a != b
    };
    scene.joints.iter().filter(apart)
}

/// Draws a joint with its objects at `poses`.
pub fn joint(
    svg: &mut Svg,
    view: &View,
    objects: &[Object],
    joint: &Joint,
    poses: &[Pose],
    colour: &'static str,
) {
    let [first, second] = joint.between;
    let [at_first, _] = joint.frames(objects);
    let own = poses[first] * at_first;
    let (from, to) = nearest(objects, joint, poses);
    let middle = 0.5 * (from + to);
    let (place, along) = match joint.kind {
        JointKind::Fixed => (middle, poses[second].position - poses[first].position),
        JointKind::Revolute { .. } => (own.position, Vector::x()),
        JointKind::Prismatic { .. } => (middle, own.vector(Vector::x())),
    };
    let gap = view.length((to - from).dot(&along.try_normalize(1e-9).unwrap_or(Vector::x())).abs());
    let at = view.map(place);
    // The page's y axis points down.
    let along = Vector::new(along.x, -along.y).try_normalize(1e-9).unwrap_or(Vector::x());
    svg.open_titled(&words(objects, joint));
    if Symbol::of(joint) == Symbol::Pin {
        for index in joint.between {
            svg.line(at, view.map(poses[index].position), Style::stroke(colour, 1.2));
        }
    }
    Symbol::of(joint).draw(svg, at, along, gap, colour);
    svg.close();
}

/// Returns the closest points of the two objects, one on each; for flush faces, their midpoints.
fn nearest(objects: &[Object], joint: &Joint, poses: &[Pose]) -> (Vector, Vector) {
    let [first, second] = joint.between;
    let footprint = |index: usize| objects[index].shape.footprint();
    let (a, b) = ((&footprint(first), &poses[first]), (&footprint(second), &poses[second]));
    let (points, _) = contact_points(a, b, f64::INFINITY);
    let flat = |points: [ContactPoint; 2]| (points[1].gap - points[0].gap).abs() < FLAT;
    match points {
        [Some(one), Some(two)] if flat([one, two]) => {
            (0.5 * (one.on_first + two.on_first), 0.5 * (one.on_second + two.on_second))
        }
        [Some(one), _] => (one.on_first, one.on_second),
        _ => (poses[first].position, poses[second].position),
    }
}

/// Describes the joint for a tooltip.
fn words(objects: &[Object], joint: &Joint) -> String {
    let [first, second] = joint.between.map(|index| &objects[index].name);
    let (kind, unit, scale) = match joint.kind {
        JointKind::Fixed => ("fixed", "", 1.0),
        JointKind::Revolute { .. } => ("revolute", "\u{b0}", 1f64.to_degrees()),
        JointKind::Prismatic { .. } => ("prismatic", " mm", 1e3),
    };
    let limits = joint.limits().map_or(String::new(), |Span { low, high }| {
        format!(", {:.0} to {:.0}{unit}", low * scale, high * scale)
    });
    format!("{first} and {second}: {kind}{limits}")
}
