//! Contact points: where two footprints touch, or would touch first.
//!
//! Two flat faces meet in a line, whose ends carry the contact; so up to two points are
//! returned, as a contact solver would keep them. Written here rather than taken from parry
//! because the graph needs both points also at a distance, with the same numbers in either
//! argument order, and a batch of them for every step of every rollout.

use super::{Footprint, Pose, Turn, Vector};

/// Points of one pair that lie closer together than this are one contact, metres.
const SAME_POINT: f64 = 1e-3;

/// What the normal of a contact follows when its bodies move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Follows {
    /// A face of the first body.
    First,
    /// A face of the second body.
    Second,
    /// A face of both: they lie flush, end to end.
    Both,
    /// The line between two points that belong to the bodies: centres of discs, or corners.
    /// World frame, metres.
    Between(Vector, Vector),
    /// Nothing: two corners, whose line may point anywhere a moment later.
    Nothing,
}

/// A point where two bodies are close.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint {
    /// The point on the first body, world frame, metres.
    pub on_first: Vector,
    /// The point on the second body, world frame, metres.
    pub on_second: Vector,
    /// Unit normal, pointing from the second body into the first.
    pub normal: Vector,
    /// Distance along the normal, metres; negative where the bodies overlap.
    pub gap: f64,
    /// What the normal turns with.
    pub follows: Follows,
}

impl ContactPoint {
    /// The same contact seen from the other body.
    pub fn flipped(self) -> Self {
        Self {
            on_first: self.on_second,
            on_second: self.on_first,
            normal: -self.normal,
            gap: self.gap,
            follows: match self.follows {
                Follows::First => Follows::Second,
                Follows::Second => Follows::First,
                Follows::Between(first, second) => Follows::Between(second, first),
                other => other,
            },
        }
    }
}

/// The one or two contact points of two posed footprints whose gap is at most `reach` metres,
/// closest first; none if the bodies are farther apart.
///
/// Two points are only ever returned for two rectangles: the closest pair of a corner of one
/// and the boundary of the other, and the next such pair at another place.
pub fn contact_points(
    first: (&Footprint, &Pose),
    second: (&Footprint, &Pose),
    reach: f64,
) -> ([Option<ContactPoint>; 2], usize) {
    let apart = (first.1.position - second.1.position).norm();
    if apart > first.0.bounding_radius() + second.0.bounding_radius() + reach {
        return ([None, None], 0);
    }
    match (*first.0, *second.0) {
        (Footprint::Disc { radius: a }, Footprint::Disc { radius: b }) => {
            single(disc_disc(first.1.position, a, second.1.position, b), reach)
        }
        (Footprint::Disc { radius }, Footprint::Rectangle { half }) => {
            single(disc_rectangle(first.1.position, radius, second.1, half), reach)
        }
        (Footprint::Rectangle { half }, Footprint::Disc { radius }) => {
            single(disc_rectangle(second.1.position, radius, first.1, half).flipped(), reach)
        }
        (Footprint::Rectangle { half: a }, Footprint::Rectangle { half: b }) => {
            rectangle_rectangle(first.1, a, second.1, b, reach)
        }
    }
}

fn single(point: ContactPoint, reach: f64) -> ([Option<ContactPoint>; 2], usize) {
    if point.gap <= reach { ([Some(point), None], 1) } else { ([None, None], 0) }
}

fn disc_disc(a: Vector, radius_a: f64, b: Vector, radius_b: f64) -> ContactPoint {
    let between = a - b;
    let distance = between.norm();
    // Concentric discs have no normal; any will do.
    let normal = if distance > 1e-12 { between / distance } else { Vector::x() };
    ContactPoint {
        on_first: a - normal * radius_a,
        on_second: b + normal * radius_b,
        normal,
        gap: distance - radius_a - radius_b,
        follows: Follows::Between(a, b),
    }
}

fn disc_rectangle(centre: Vector, radius: f64, pose: &Pose, half: Vector) -> ContactPoint {
    let turn = pose.turn();
    let local = turn.back(centre - pose.position);
    let (boundary, normal, distance) = nearest_on_rectangle(local, half);
    let on_second = pose.position + turn.of(boundary);
    let follows =
        if is_corner(normal) { Follows::Between(centre, on_second) } else { Follows::Second };
    let normal = turn.of(normal);
    ContactPoint {
        on_first: centre - normal * radius,
        on_second,
        normal,
        gap: distance - radius,
        follows,
    }
}

/// The boundary point of a rectangle nearest to `point`, the outward normal there towards the
/// point, and the signed distance (negative inside). All in the rectangle's frame.
fn nearest_on_rectangle(point: Vector, half: Vector) -> (Vector, Vector, f64) {
    let clamped = Vector::new(point.x.clamp(-half.x, half.x), point.y.clamp(-half.y, half.y));
    let outside = point - clamped;
    let distance = outside.norm();
    if distance > 1e-12 {
        return (clamped, outside / distance, distance);
    }
    let depth_x = half.x - point.x.abs();
    let depth_y = half.y - point.y.abs();
    if depth_x <= depth_y {
        let side = if point.x < 0.0 { -1.0 } else { 1.0 };
        (Vector::new(side * half.x, point.y), Vector::new(side, 0.0), -depth_x)
    } else {
        let side = if point.y < 0.0 { -1.0 } else { 1.0 };
        (Vector::new(point.x, side * half.y), Vector::new(0.0, side), -depth_y)
    }
}

/// Whether a unit normal, in a rectangle's frame, is that of a corner and of none of its faces.
/// One that is within 3 degrees of a face's counts as that, so that rounding cannot decide it
/// where faces end at the same place.
fn is_corner(normal: Vector) -> bool {
    normal.x.abs().min(normal.y.abs()) > 0.05
}

fn rectangle_rectangle(
    a: &Pose,
    half_a: Vector,
    b: &Pose,
    half_b: Vector,
    reach: f64,
) -> ([Option<ContactPoint>; 2], usize) {
    // The relative pose once, so that eight corners cost no further sine.
    let turn = a.turn();
    let (b_from_a, b_turn) = (turn.back(b.position - a.position), Turn::by(b.heading - a.heading));
    let to_a = |p: Vector| b_from_a + b_turn.of(p);
    let to_b = |p: Vector| b_turn.back(p - b_from_a);

    const CORNERS: [(f64, f64); 4] = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    // Candidates in the frame of `a`: (on a, on b, normal from b into a, gap, what it follows).
    let nothing = Follows::Nothing;
    let zero = Vector::zeros();
    let mut found = [(zero, zero, zero, f64::INFINITY, nothing); 8];
    for (k, (x, y)) in CORNERS.into_iter().enumerate() {
        let corner = Vector::new(x * half_a.x, y * half_a.y);
        let (boundary, normal, distance) = nearest_on_rectangle(to_b(corner), half_b);
        let follows = if is_corner(normal) { nothing } else { Follows::Second };
        found[k] = (corner, to_a(boundary), b_turn.of(normal), distance, follows);
        let corner = to_a(Vector::new(x * half_b.x, y * half_b.y));
        let (boundary, normal, distance) = nearest_on_rectangle(corner, half_a);
        let follows = if is_corner(normal) { nothing } else { Follows::First };
        found[4 + k] = (boundary, corner, -normal, distance, follows);
    }
    let Some(best) = found.iter().min_by(|p, q| p.3.total_cmp(&q.3)).copied() else {
        return ([None, None], 0);
    };
    if best.3 > reach {
        return ([None, None], 0);
    }
    let next = found
        .iter()
        .filter(|p| (p.0 - best.0).norm() > SAME_POINT && (p.1 - best.1).norm() > SAME_POINT)
        .min_by(|p, q| p.3.total_cmp(&q.3))
        .filter(|p| p.3 <= reach)
        .copied();
    // Corners of both on one place: neither face alone leads.
    let led = |p: (Vector, Vector, Vector, f64, Follows)| {
        let meets = |q: &&(Vector, Vector, Vector, f64, Follows)| {
            (p.0 - q.0).norm() < SAME_POINT && (p.1 - q.1).norm() < SAME_POINT
        };
        match p.4 {
            Follows::First | Follows::Second
                if found.iter().filter(meets).any(|q| q.4 != p.4 && q.4 != nothing) =>
            {
                Follows::Both
            }
            alone => alone,
        }
    };
    let world = |p: (Vector, Vector, Vector, f64, Follows)| ContactPoint {
        on_first: a.position + turn.of(p.0),
        on_second: a.position + turn.of(p.1),
        normal: turn.of(p.2),
        gap: p.3,
        follows: led(p),
    };
    ([Some(world(best)), next.map(world)], 1 + usize::from(next.is_some()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flush_faces_touch_at_both_ends_of_the_shared_edge() {
        let wide = Footprint::Rectangle { half: Vector::new(0.01, 0.10) };
        let small = Footprint::Rectangle { half: Vector::new(0.03, 0.03) };
        let (points, count) =
            contact_points((&small, &Pose::new(0.05, 0.02, 0.0)), (&wide, &Pose::default()), 0.02);
        assert_eq!(count, 2);
        let mut ends: Vec<f64> = points.iter().flatten().map(|p| p.on_first.y).collect();
        ends.sort_by(f64::total_cmp);
        assert!((ends[0] + 0.01).abs() < 1e-12 && (ends[1] - 0.05).abs() < 1e-12);
        for p in points.iter().flatten() {
            assert!((p.gap - 0.01).abs() < 1e-12);
            assert!((p.normal - Vector::x()).norm() < 1e-12);
        }
    }

    #[test]
    fn both_argument_orders_agree_for_every_pair_of_shapes() {
        let shapes = [
            Footprint::Disc { radius: 0.04 },
            Footprint::Rectangle { half: Vector::new(0.05, 0.02) },
            Footprint::Rectangle { half: Vector::new(0.01, 0.07) },
        ];
        let (p, q) = (Pose::new(0.1, 0.02, 0.4), Pose::new(-0.01, 0.0, 2.2));
        for a in &shapes {
            for b in &shapes {
                let (forward, n) = contact_points((a, &p), (b, &q), 1.0);
                let (backward, m) = contact_points((b, &q), (a, &p), 1.0);
                assert_eq!(n, m);
                for (f, g) in forward.iter().flatten().zip(backward.iter().flatten()) {
                    let g = g.flipped();
                    assert!((f.gap - g.gap).abs() < 1e-12, "{a:?} {b:?}");
                    assert!((f.normal - g.normal).norm() < 1e-12);
                }
            }
        }
    }
}
