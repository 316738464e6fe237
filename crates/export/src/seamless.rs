//! Outline of the tool as separate solids without seams.
//!
//! The pieces of an outline overlap, and a face of one may be aligned with a face of another. A
//! body that slides along would then be caught by the corner. Our engines remove such contacts; for
//! others, the covered face is moved back into the piece that covers it.

use pushplan::geometry::{Footprint, Pose, Shape, Vector};
use pushplan::scene::Piece;

/// Distance by which a covered face is moved back, metres: deeper than soft contacts, and within
/// the tolerance of the sizes. At the outer corner of two pieces both faces are covered, so that
/// a square of this size is missing there. With 1 cm, cans rolled into the notch and jammed.
const BACK: f64 = 1e-3;

/// Tolerance for rounding, metres.
const SLACK: f64 = 1e-6;

/// Returns the pieces, with shapes and poses in the tool frame that leave no seams.
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

/// Returns `true` if a piece contains a rectangle between two corners in the frame at `pose`.
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
        // Joined, the parts are an L: the end belongs to the bar, the back to the handle.
        let ((handle, at), (bar, middle)) = (size("handle"), size("bar"));
        let spans = [at.x - handle[0] / 2.0, at.x + handle[0] / 2.0];
        assert!(spans[0].abs() < 1e-9 && (spans[1] - 0.429).abs() < 1e-9, "{spans:?}");
        let spans = [middle.y - bar[1] / 2.0, middle.y + bar[1] / 2.0];
        assert!((spans[0] + 0.014).abs() < 1e-9 && (spans[1] - 0.185).abs() < 1e-9, "{spans:?}");
    }
}
