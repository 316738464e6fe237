//! The foot of an arm: obstacles around the root link and the links fixed to it.

use pushplan::geometry::Vector3;
use pushplan::scene::{Obstacle, Robot};

use super::model::Arm;

/// Returns the boxes around the solids of the root link, and of links that do not move with the
/// arm, as far as they are above the table.
pub(super) fn foot(arm: &Arm) -> Vec<Obstacle> {
    let Some(root) = arm.bodies.first() else { return Vec::new() };
    let beside = arm.beside.iter().flat_map(|body| &body.solids);
    let boxes = root.solids.iter().chain(beside).filter_map(|solid| {
        let radius = Vector3::repeat(solid.radius);
        let corners = solid.points.iter().map(|point| arm.base.point(*point));
        let (low, high) = corners.fold(
            (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)),
            |(low, high), corner| (low.inf(&corner), high.sup(&corner)),
        );
        let (mut low, high) = (low - radius, high + radius);
        low.z = low.z.max(0.0);
        let size = high - low;
        (size.min() > 0.0).then(|| {
            let middle = low + 0.5 * size;
            let block = Obstacle::cuboid("", size.into());
            block.at(middle.x, middle.y, 0.0).raised(low.z)
        })
    });
    let name = |(k, one): (usize, Obstacle)| {
        let name = if k == 0 { Robot::BASE.into() } else { format!("{} {}", Robot::BASE, k + 1) };
        Obstacle { name, ..one }
    };
    boxes.enumerate().map(name).collect()
}
