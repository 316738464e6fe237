//! The tool's outline as solids that an engine may look at one by one.
//!
//! The pieces of an outline overlap, and faces of one may end in line with a face of another,
//! where a body that slides along is caught by the corner. Our engines take such contacts away;
//! elsewhere the face that cannot be touched is moved back into the piece that covers it.

use pushplan::geometry::{Footprint, Pose, Shape, Vector};
use pushplan::scene::Piece;

/// How far a covered face is moved back, metres: more than engines look ahead.
const BACK: f64 = 0.01;

/// What rounding may hide, metres.
const SLACK: f64 = 1e-6;

/// The pieces, each with a shape and a pose in the tool frame that leave no seams.
pub(super) fn seamless(pieces: &[Piece]) -> Vec<(&str, Shape, Pose)> {
    pieces
        .iter()
        .map(|piece| {
            let (shape, pose) = trimmed(piece, pieces);
            (piece.name.as_str(), shape, pose)
        })
        .collect()
}

fn trimmed(piece: &Piece, pieces: &[Piece]) -> (Shape, Pose) {
    let (Shape::Cuboid { size }, Some(rim)) = (piece.shape, &piece.rim) else {
        return (piece.shape, piece.pose);
    };
    let half = Vector::new(size[0], size[1]) / 2.0;
    let (mut low, mut high) = (-half, half);
    for (side, stretches) in rim.sides.iter().enumerate() {
        let (axis, outwards) = (side % 2, side < 2);
        if !stretches.is_empty() || size[axis] <= 2.0 * BACK {
            continue;
        }
        let (mut from, mut to) = (-half, half);
        if outwards {
            from[axis] = half[axis] - BACK;
        } else {
            to[axis] = BACK - half[axis];
        }
        let covers = |other: &&Piece| *other != piece && holds(other, &piece.pose, from, to);
        if pieces.iter().any(|other| covers(&other)) {
            if outwards {
                high[axis] -= BACK;
            } else {
                low[axis] += BACK;
            }
        }
    }
    let (extent, middle) = (high - low, (low + high) / 2.0);
    let pose = Pose { position: piece.pose.point(middle), ..piece.pose };
    (Shape::Cuboid { size: [extent.x, extent.y, size[2]] }, pose)
}

/// Whether a piece holds all of a rectangle between two corners in the frame at `pose`.
fn holds(piece: &Piece, pose: &Pose, from: Vector, to: Vector) -> bool {
    let Footprint::Rectangle { half } = piece.footprint() else { return false };
    [from, to, Vector::new(from.x, to.y), Vector::new(to.x, from.y)].into_iter().all(|corner| {
        let local = piece.pose.local_point(pose.point(corner));
        local.x.abs() <= half.x + SLACK && local.y.abs() <= half.y + SLACK
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use pushplan::scene::{Part, Tool};

    #[test]
    fn the_handle_of_a_hook_ends_inside_its_bar() {
        let handle = Part::cuboid("handle", [0.4, 0.03, 0.05], Pose::new(0.2, 0.0, 0.0));
        let bar = Part::cuboid("bar", [0.03, 0.2, 0.05], Pose::new(0.415, 0.085, 0.0));
        let tool = Tool::new("hook", [handle, bar]).expect("one piece");
        let found = seamless(tool.outline());
        assert_eq!(found.len(), 2);
        let size = |name: &str| match found.iter().find(|solid| solid.0 == name) {
            Some((_, Shape::Cuboid { size }, pose)) => (*size, pose.position),
            other => panic!("{other:?}"),
        };
        // Joined they are an L: the end is the bar's, the back the handle's.
        let ((handle, at), (bar, middle)) = (size("handle"), size("bar"));
        let spans = [at.x - handle[0] / 2.0, at.x + handle[0] / 2.0];
        assert!(spans[0].abs() < 1e-9 && (spans[1] - 0.42).abs() < 1e-9, "{spans:?}");
        let spans = [middle.y - bar[1] / 2.0, middle.y + bar[1] / 2.0];
        assert!((spans[0] + 0.005).abs() < 1e-9 && (spans[1] - 0.185).abs() < 1e-9, "{spans:?}");
    }
}
