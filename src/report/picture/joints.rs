//! Joints: a bar for a fixed one, a pin for a revolute one, a slot for a prismatic one.

use crate::geometry::{Pose, Vector, contact_points, perpendicular};
use crate::report::svg::{Style, Svg};
use crate::scene::{Joint, JointKind, Object, Span};

use super::view::View;

/// How a kind of joint is drawn, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    /// A thick short bar across the gap.
    Bar,
    /// A pin where the axis stands.
    Pin,
    /// Two rails along the axis.
    Slot,
}

impl Symbol {
    /// Every symbol with what it stands for.
    pub const ALL: [(Symbol, &'static str); 3] = [
        (Symbol::Bar, "fixed joint"),
        (Symbol::Pin, "revolute joint"),
        (Symbol::Slot, "prismatic joint"),
    ];

    /// The symbol of a joint.
    pub fn of(joint: &Joint) -> Self {
        match joint.kind {
            JointKind::Fixed => Symbol::Bar,
            JointKind::Revolute { .. } => Symbol::Pin,
            JointKind::Prismatic { .. } => Symbol::Slot,
        }
    }

    /// Draws the symbol at a place of the page, along a unit vector of the page.
    pub fn draw(self, svg: &mut Svg, at: Vector, along: Vector, colour: &'static str) {
        let rim = "#ffffff";
        match self {
            Symbol::Bar => {
                svg.line(at - along * 9.0, at + along * 9.0, Style::stroke(rim, 8.0));
                svg.line(at - along * 8.0, at + along * 8.0, Style::stroke(colour, 5.0));
            }
            Symbol::Pin => {
                svg.circle(at, 5.5, Style::fill(rim).outlined(colour, 2.0));
                svg.circle(at, 1.8, Style::fill(colour));
            }
            Symbol::Slot => {
                let side = perpendicular(along) * 3.5;
                svg.line(at - along * 13.0, at + along * 13.0, Style::stroke(rim, 10.0));
                for side in [side, -side] {
                    let (from, to) = (at + side - along * 13.0, at + side + along * 13.0);
                    svg.line(from, to, Style::stroke(colour, 2.0));
                }
            }
        }
    }
}

/// A joint with its objects at `poses`.
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
    let gap = middle(objects, joint, poses);
    let (place, along) = match joint.kind {
        JointKind::Fixed => (gap, poses[second].position - poses[first].position),
        JointKind::Revolute { .. } => (own.position, Vector::x()),
        JointKind::Prismatic { .. } => (gap, own.vector(Vector::x())),
    };
    let at = view.map(place);
    // The page's y points down.
    let along = Vector::new(along.x, -along.y).try_normalize(1e-9).unwrap_or(Vector::x());
    svg.open_titled(&words(objects, joint));
    if Symbol::of(joint) == Symbol::Pin {
        for index in joint.between {
            svg.line(at, view.map(poses[index].position), Style::stroke(colour, 1.2));
        }
    }
    Symbol::of(joint).draw(svg, at, along, colour);
    svg.close();
}

/// Midway between the closest points of the two objects.
fn middle(objects: &[Object], joint: &Joint, poses: &[Pose]) -> Vector {
    let [first, second] = joint.between;
    let footprint = |index: usize| objects[index].shape.footprint();
    let (a, b) = ((&footprint(first), &poses[first]), (&footprint(second), &poses[second]));
    let middle = 0.5 * (poses[first].position + poses[second].position);
    contact_points(a, b, f64::INFINITY).0[0].map_or(middle, |c| 0.5 * (c.on_first + c.on_second))
}

/// What the joint is, for a reader who points at it.
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
