//! Detection of sampled tools that equal a shipped one. Shipped tools are reserved for the unseen
//! test.

use std::f64::consts::FRAC_PI_2;
use std::sync::LazyLock;

use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::geometry::{Pose, Shape, Vector};
use pushplan::internals::scene::{Part, Tool};

/// Tolerance of part centres and half sides, metres.
const SAME: f64 = 2e-3;

/// Returns `true` if `tool` has the parts of a shipped tool.
pub fn is_shipped(tool: &Tool) -> bool {
    // A test reads the embedded files. With broken files there are no shipped tools to exclude from
    // training.
    static SHIPPED: LazyLock<ToolLibrary> =
        LazyLock::new(|| ToolLibrary::embedded().unwrap_or_default());
    SHIPPED.iter().any(|shipped| same_parts(shipped, tool))
}

/// Returns `true` if two tools have equal parts, independent of their frames, the order of parts
/// and reflection.
fn same_parts(a: &Tool, b: &Tool) -> bool {
    if a.parts().len() != b.parts().len() {
        return false;
    }
    let Some(first) = a.parts().first() else { return true };
    [false, true].into_iter().any(|mirrored| {
        let target: Vec<Part> = b.parts().iter().map(|p| mirror(p, mirrored)).collect();
        // Motion of the first part of `a` onto a part of `b`, for each quarter turn under which a
        // rectangle may be symmetric.
        target.iter().any(|onto| {
            (0..4).any(|quarter| {
                let turn = Pose::new(0.0, 0.0, FRAC_PI_2 * f64::from(quarter));
                let motion = onto.pose * turn * first.pose.inverse();
                matches_all(a, &motion, &target)
            })
        })
    })
}

fn mirror(part: &Part, mirrored: bool) -> Part {
    let mut part = part.clone();
    if mirrored {
        part.pose.position.y = -part.pose.position.y;
        part.pose.heading = -part.pose.heading;
    }
    part
}

fn matches_all(a: &Tool, motion: &Pose, target: &[Part]) -> bool {
    let mut free: Vec<&Part> = target.iter().collect();
    a.parts().iter().all(|part| {
        let found = free.iter().position(|other| same_place(part, &(*motion * part.pose), other));
        found.map(|index| free.swap_remove(index)).is_some()
    })
}

/// Returns `true` if `part` at `pose` covers the area of `other`.
fn same_place(part: &Part, pose: &Pose, other: &Part) -> bool {
    let together = (pose.position - other.pose.position).norm() < SAME;
    let (size, other_size) = match (part.shape, other.shape) {
        (Shape::Cuboid { size }, Shape::Cuboid { size: other }) => (size, other),
        (Shape::Cylinder { radius: a, .. }, Shape::Cylinder { radius: b, .. }) => {
            return together && (a - b).abs() < SAME;
        }
        _ => return false,
    };
    let axes = |size: &[f64; 3], pose: &Pose| {
        [Vector::new(size[0] / 2.0, 0.0), Vector::new(0.0, size[1] / 2.0)].map(|v| pose.vector(v))
    };
    let ours = axes(&size, pose);
    let theirs = axes(&other_size, &other.pose);
    let same = |u: Vector, v: Vector| (u - v).norm() < SAME || (u + v).norm() < SAME;
    together
        && (same(ours[0], theirs[0]) && same(ours[1], theirs[1])
            || same(ours[0], theirs[1]) && same(ours[1], theirs[0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hook(mirrored: bool) -> Vec<Part> {
        let side = if mirrored { -1.0 } else { 1.0 };
        let part = |size, pose| Part::cuboid("", size, pose);
        vec![
            part([0.14, 0.08, 0.05], Pose::new(0.12, 0.0, 0.0)),
            part([0.16, 0.08, 0.05], Pose::new(0.15, 0.12 * side, FRAC_PI_2)),
        ]
    }

    fn same(a: Vec<Part>, b: Vec<Part>) -> bool {
        let tool = |parts| Tool::assembled("", parts, vec![[0, 1]]);
        same_parts(&tool(a), &tool(b))
    }

    #[test]
    fn turned_shifted_reordered_and_mirrored_tools_are_the_same() {
        let mut moved = hook(true);
        moved.reverse();
        for part in &mut moved {
            part.pose = Pose::new(0.3, -1.0, 0.7) * part.pose;
            if let Shape::Cuboid { size } = &mut part.shape {
                size.swap(0, 1);
            }
            part.pose.heading += FRAC_PI_2;
        }
        assert!(same(hook(false), moved.clone()) && same(moved, hook(false)));
    }

    #[test]
    fn another_size_or_place_is_another_tool() {
        let mut longer = hook(false);
        longer[1].shape = Shape::Cuboid { size: [0.17, 0.08, 0.05] };
        assert!(!same(hook(false), longer));
        let mut shifted = hook(false);
        shifted[1].pose.position.x += 0.01;
        assert!(!same(hook(false), shifted));
    }
}
