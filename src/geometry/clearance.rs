//! Clearances between posed footprints and along straight motions, computed by parry.

use parry2d_f64::{
    math::{Pose as Isometry, Vector as ParryVector},
    query::{ClosestPoints, closest_points},
    shape::{Ball, ConvexPolygon as Hull, Cuboid, Shape as ParryShape},
};

use super::flat::CORNERS;
use super::{Footprint, Pose, Vector};

/// Returns the distance between two posed footprints, metres: zero if they touch or overlap, capped
/// at `reach`.
///
/// Uses parry's `closest_points`, because in the pinned version `distance` of two cuboids is wrong
/// in one argument order (parry issue 431).
pub fn clearance(first: (&Footprint, &Pose), second: (&Footprint, &Pose), reach: f64) -> f64 {
    let apart = (first.1.position - second.1.position).norm();
    if apart >= first.0.bounding_radius() + second.0.bounding_radius() + reach {
        return reach;
    }
    between(&*shape(first.0), first.1, &*shape(second.0), second.1, reach)
}

/// Returns the minimum distance, metres, between a footprint that moves straight from `from` to
/// `to` without rotation and a static one; capped at `reach`.
pub fn swept_clearance(
    moving: &Footprint,
    from: &Pose,
    to: &Pose,
    still: (&Footprint, &Pose),
    reach: f64,
) -> f64 {
    let travel = from.local_vector(to.position - from.position);
    if travel.norm() < 1e-9 {
        return clearance((moving, from), still, reach);
    }
    match *moving {
        // A disc sweeps a capsule: the gap to its axis minus the radius.
        Footprint::Disc { radius } => {
            let axis = parry2d_f64::shape::Segment::new(vector(Vector::zeros()), vector(travel));
            let gap = between(&axis, from, &*shape(still.0), still.1, reach + radius);
            (gap - radius).clamp(0.0, reach)
        }
        Footprint::Rectangle { half } => {
            let corners = CORNERS.map(|(x, y)| Vector::new(x * half.x, y * half.y));
            swept_corners((moving, &corners), (from, to, travel), still, reach)
        }
        Footprint::Polygon(polygon) => {
            swept_corners((moving, polygon.corners()), (from, to, travel), still, reach)
        }
    }
}

fn swept_corners(
    (moving, corners): (&Footprint, &[Vector]),
    (from, to, travel): (&Pose, &Pose, Vector),
    still: (&Footprint, &Pose),
    reach: f64,
) -> f64 {
    let ends: Vec<ParryVector> =
        corners.iter().flat_map(|corner| [vector(*corner), vector(corner + travel)]).collect();
    match Hull::from_convex_hull(&ends) {
        Some(hull) => between(&hull, from, &*shape(still.0), still.1, reach),
        // The hull only fails for a sliver, for which both ends suffice.
        None => clearance((moving, from), still, reach).min(clearance((moving, to), still, reach)),
    }
}

fn between(
    a: &dyn ParryShape,
    pose_a: &Pose,
    b: &dyn ParryShape,
    pose_b: &Pose,
    reach: f64,
) -> f64 {
    match closest_points(&isometry(pose_a), a, &isometry(pose_b), b, reach) {
        Ok(ClosestPoints::Intersecting) => 0.0,
        Ok(ClosestPoints::WithinMargin(p, q)) => (p - q).length().min(reach),
        Ok(ClosestPoints::Disjoint) => reach,
        // Every pair built here is supported by parry. For any other, zero refuses a placement
        // rather than allowing a collision.
        Err(_) => 0.0,
    }
}

fn shape(footprint: &Footprint) -> Box<dyn ParryShape> {
    match *footprint {
        Footprint::Disc { radius } => Box::new(Ball::new(radius)),
        Footprint::Rectangle { half } => Box::new(Cuboid::new(vector(half))),
        Footprint::Polygon(polygon) => {
            let corners = polygon.corners().iter().copied().map(vector).collect();
            match Hull::from_convex_polyline_unmodified(corners) {
                Some(hull) => Box::new(hull),
                // Three or more corners always have one.
                None => Box::new(Ball::new(polygon.bounding_radius())),
            }
        }
    }
}

fn vector(v: Vector) -> ParryVector {
    ParryVector::new(v.x, v.y)
}

fn isometry(pose: &Pose) -> Isometry {
    Isometry::new(vector(pose.position), pose.heading)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_in_both_orders_match_the_closed_form() {
        let a = Footprint::Rectangle { half: Vector::new(0.05, 0.02) };
        let b = Footprint::Rectangle { half: Vector::new(0.01, 0.04) };
        let (p, q) = (Pose::new(0.0, 0.0, 0.0), Pose::new(0.10, 0.09, 0.0));
        let expected = (0.04f64).hypot(0.03);
        for (first, second) in [((&a, &p), (&b, &q)), ((&b, &q), (&a, &p))] {
            assert!((clearance(first, second, 1.0) - expected).abs() < 1e-9);
        }
    }

    #[test]
    fn a_sweep_meets_what_only_its_middle_passes() {
        let moving = Footprint::Rectangle { half: Vector::new(0.01, 0.01) };
        let post = Footprint::Disc { radius: 0.02 };
        let (from, to) = (Pose::default(), Pose::new(0.4, 0.0, 0.0));
        let beside = Pose::new(0.2, 0.05, 0.0);
        let gap = swept_clearance(&moving, &from, &to, (&post, &beside), 1.0);
        assert!((gap - 0.02).abs() < 1e-9);
        assert_eq!(
            swept_clearance(&moving, &from, &to, (&post, &Pose::new(0.2, 0.0, 0.0)), 1.0),
            0.0
        );
    }
}
