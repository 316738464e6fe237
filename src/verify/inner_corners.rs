//! Inner corners of bent tools, filled as by a weld or a rounding.
//!
//! A round object that rolls from one part of a tool to another depends on the radius of the corner
//! between them, which tool files do not state.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::geometry::{Footprint, Pose, Vector, cross};
use crate::scene::{JOIN_GAP, Part, Tool};

/// Length of both sides of a filled corner, metres.
const FILLET: f64 = 2e-3;

/// Distance from a corner at which the material around it is sampled, metres.
const AROUND: f64 = 1e-3;

/// Number of directions in which the material around a corner is sampled.
const DIRECTIONS: usize = 48;

/// Returns the tool with every inner corner between two cuboid parts filled by a cuboid across it.
pub(super) fn filled(tool: &Arc<Tool>) -> Arc<Tool> {
    let parts = tool.parts();
    let mut all = parts.to_vec();
    let mut joints = tool.joints().to_vec();
    let mut corners: Vec<Vector> = Vec::new();
    for a in 0..parts.len() {
        for b in a + 1..parts.len() {
            for corner in crossings(&parts[a], &parts[b]) {
                let known = corners.iter().any(|known| (known - corner).norm() < AROUND);
                if let Some((pose, size)) = across(parts, corner).filter(|_| !known) {
                    let height = parts[a].shape.height().min(parts[b].shape.height());
                    let name = format!("inner corner {}", corners.len() + 1);
                    joints.push([a, all.len()]);
                    all.push(Part::cuboid(name, [size.x, size.y, height], pose));
                    corners.push(corner);
                }
            }
        }
    }
    if corners.is_empty() {
        return Arc::clone(tool);
    }
    let found = Tool::assembled(tool.name.clone(), all, joints).held_at(tool.grip);
    Arc::new(found.friction(tool.friction).described(tool.description.clone()))
}

/// Returns the points in which the sides of two cuboid parts meet.
fn crossings(a: &Part, b: &Part) -> Vec<Vector> {
    let mut found = Vec::new();
    let (a, b) = (sides(a), sides(b));
    for [p, to] in &a {
        for [q, end] in &b {
            let (along, other) = (to - p, end - q);
            let (first, second) = (along.norm(), other.norm());
            let sine = cross(along, other) / (first * second);
            if sine.abs() < 0.1 {
                continue;
            }
            let [s, t] =
                [cross(q - p, other), cross(q - p, along)].map(|c| c / cross(along, other));
            let within = |share: f64, length: f64| {
                share * length > -JOIN_GAP && (share - 1.0) * length < JOIN_GAP
            };
            if within(s, first) && within(t, second) {
                found.push(p + s * along);
            }
        }
    }
    found
}

/// Returns the sides of a cuboid part in the tool frame; none of another part.
fn sides(part: &Part) -> Vec<[Vector; 2]> {
    let Footprint::Rectangle { half } = part.footprint() else { return Vec::new() };
    let signs = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
    let at = |k: usize| {
        let [x, y] = signs[k % 4];
        part.pose.point(Vector::new(x * half.x, y * half.y))
    };
    (0..4).map(|k| [at(k), at(k + 1)]).collect()
}

/// Returns pose and size of a cuboid across a corner with less than half of its surroundings
/// outside of the tool; `None` for any other point.
fn across(parts: &[Part], corner: Vector) -> Option<(Pose, Vector)> {
    let directions = (0..DIRECTIONS).map(|k| {
        let angle = (k as f64 + 0.5) * TAU / DIRECTIONS as f64;
        Vector::new(angle.cos(), angle.sin())
    });
    let outside: Vec<Vector> = directions
        .filter(|direction| {
            let point = corner + AROUND * direction;
            !parts.iter().any(|part| holds(part, point))
        })
        .collect();
    let open = outside.len() as f64 / DIRECTIONS as f64;
    // Sampling makes a straight face look slightly open or closed.
    if !(0.1..0.45).contains(&open) {
        return None;
    }
    let outwards = outside.iter().sum::<Vector>();
    let (sin, cos) = (0.25 * TAU * 2.0 * open).sin_cos();
    let pose = Pose { position: corner, heading: outwards.y.atan2(outwards.x) };
    Some((pose, 2.0 * FILLET * Vector::new(cos, sin)))
}

/// Returns `true` if a part covers a point of the tool frame or nearly touches it.
fn holds(part: &Part, point: Vector) -> bool {
    let local = part.pose.local_point(point);
    match part.footprint() {
        Footprint::Rectangle { half } => {
            local.x.abs() <= half.x + JOIN_GAP && local.y.abs() <= half.y + JOIN_GAP
        }
        other => local.norm() <= other.bounding_radius(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tool(parts: impl IntoIterator<Item = Part>) -> Arc<Tool> {
        Arc::new(Tool::new("tool", parts).expect("one piece").friction(0.3))
    }

    #[test]
    fn the_inner_corner_of_a_hook_is_filled_and_a_straight_stick_is_left() {
        let handle = || Part::cuboid("handle", [0.4, 0.03, 0.05], Pose::new(0.2, 0.0, 0.0));
        let bar = Part::cuboid("bar", [0.03, 0.2, 0.04], Pose::new(0.415, 0.085, 0.0));
        let hook = tool([handle(), bar]);
        let found = filled(&hook);
        let [_, _, fillet] = found.parts() else { panic!("{:?}", found.parts()) };
        assert!((fillet.pose.position - Vector::new(0.4, 0.015)).norm() < 1e-9);
        assert!((fillet.pose.heading - 0.75 * std::f64::consts::PI).abs() < 1e-9);
        assert_eq!((fillet.shape.height(), found.friction), (0.04, 0.3));
        // A point in the angle is filled up to the diagonal of its two sides.
        let inside = |leg: f64| holds(fillet, Vector::new(0.4 - leg, 0.015 + leg));
        assert!(inside(0.45 * FILLET) && !inside(0.6 * FILLET));
        let more = Part::cuboid("more", [0.2, 0.03, 0.05], Pose::new(0.5, 0.0, 0.0));
        let stick = tool([handle(), more]);
        assert!(Arc::ptr_eq(&filled(&stick), &stick));
    }
}
