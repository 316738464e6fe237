//! The side over which a levered plate tips.

use crate::geometry::{SupportEdge, Vector, support_edge};

use super::{LeverJob, Place, lever_frame};
use crate::scene::Plate;

/// Largest difference of inward distances of corners that count as equally high, metres.
const LEVEL: f64 = 1e-9;

impl Plate {
    /// Returns a place on its outline, plate frame, metres.
    pub fn point(&self, place: Place) -> Vector {
        let corners = self.corners();
        let from = corners[place.edge];
        from + (corners[(place.edge + 1) % corners.len()] - from) * place.fraction
    }

    /// Returns the side of its outline over which it tips when it is levered at `place`; `None` if
    /// the outline has no area. The centre of mass is above the frame's origin.
    pub fn support(&self, place: Place) -> Option<SupportEdge> {
        support_edge(self.corners(), self.point(place), Vector::zeros())
    }

    /// Returns the distance of the support's line from `place`, metres. With the blade's axis
    /// there, [`LeverUp::pivot`](super::LeverUp::pivot), blade and edge rise on arcs of one radius.
    /// The plate then hardly slides on the blade, and its tilt equals the rotation of the blade.
    pub fn auto_pivot(&self, place: Place) -> Option<f64> {
        self.support(place).map(|support| support.distance).filter(|distance| *distance > 0.0)
    }
}

impl LeverJob {
    /// Returns the side whose corners are lowest while the plate is up, by the index of its first
    /// corner; `None` if the outline has no area.
    ///
    /// The rays from both ends of the blade's width through the centre of mass usually leave by one
    /// side, on which the plate then stands. Otherwise the weight is above the corner between two
    /// sides, and the plate stands on that corner and on the whole width of the blade. It then tips
    /// along the levered edge, and of the two neighbouring corners the one farther inward is lower.
    pub fn support(&self) -> Option<usize> {
        let plate = &self.scene.plates[self.lever.plate];
        let (corners, count) = (plate.corners(), plate.corners().len());
        let frame = lever_frame(corners, self.lever.place);
        let half = 0.5 * self.scene.blade.width;
        let from = |y: f64| {
            let point = frame.point(Vector::new(0.0, y));
            support_edge(corners, point, Vector::zeros()).map(|support| support.edge)
        };
        let (left, right) = (from(half)?, from(-half)?);
        let inward = |corner: usize| frame.local_point(corners[corner % count]).x;
        if left == right {
            return Some(left);
        }
        // The ray from the left passes through the earlier side, counter-clockwise.
        let [one, other] = [inward(left), inward(right + 1)];
        if (left + 1) % count == right && (one - other).abs() > LEVEL {
            return Some(if one > other { left } else { right });
        }
        // Remaining cases: both are the ends of the levered edge of a triangle, or the blade is
        // wider than a whole side.
        plate.support(self.lever.place).map(|support| support.edge)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::geometry::Pose;
    use crate::{
        scene::{Blade, LeverScene, Slab},
        task::LeverUp,
    };

    /// A kite whose far corner is opposite to the lever point, slightly aside of the ray.
    fn job(width: f64, aside: f64) -> LeverJob {
        let corners = [[-0.08, -0.05], [0.05, -0.06], [0.09, aside], [0.03, 0.07], [-0.08, 0.05]];
        let plate = Plate {
            name: "plate".to_owned(),
            slabs: vec![Slab {
                corners: corners.map(|[x, y]| Vector::new(x, y)).to_vec(),
                bottom: 0.0,
                height: 0.004,
            }],
            mass: 0.1,
            friction: 0.4,
            clearance: 0.006,
            pose: Pose::default(),
            z: 0.006,
        };
        let blade = Blade { length: 0.12, width, thickness: 0.002, friction: 0.4 };
        let (plates, blocks) = (vec![plate], Vec::new());
        let scene = LeverScene { plates, blocks, table_friction: 0.4, blade };
        let lever = LeverUp {
            plate: 0,
            place: Place { edge: 4, fraction: 0.5 },
            depth: 0.01,
            pivot: 0.16,
            angle: 1.0,
            speed: 0.1,
            hold: 0.2,
            retreat: 0.1,
        };
        LeverJob { scene: Arc::new(scene), lever }
    }

    #[test]
    fn a_corner_opposite_the_blade_carries_the_plate_with_the_whole_width() {
        // Levered in the middle of x = -0.08, with the centre of mass at the origin: the ray runs
        // along x.
        for aside in [-0.001, 0.001] {
            let narrow = job(1e-4, aside).support();
            assert_eq!(narrow, Some(if aside > 0.0 { 1 } else { 2 }));
            // The corner at x = 0.05 is farther from the blade than the corner at 0.03, so it is
            // lower.
            assert_eq!(job(0.006, aside).support(), Some(1));
        }
        // Far enough aside, the result is the result without a width.
        assert_eq!(job(0.006, -0.01).support(), Some(2));
    }
}
