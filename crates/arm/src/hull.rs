//! Convex 3-D solids: a few points, and a radius around their convex hull.
//!
//! A ball has one point, a capsule two, a box eight. A mesh keeps the corners that determine its
//! outline, and the radius covers the error. Distances are computed by the GJK algorithm of parry.

use parry3d_f64::math::{Pose as ParryPose, Vector as ParryVector};
use parry3d_f64::query::details::distance_support_map_support_map;
use parry3d_f64::shape::SupportMap;
use serde::{Deserialize, Serialize};

use pushplan::geometry::{Footprint, Matrix3, Pose3, Vector3};

/// Numbers of evenly distributed directions, for keeping corners of a mesh and for measuring the
/// error.
const KEPT: usize = 48;
const SEEN: usize = 400;

/// Corners nearer than this are merged, metres.
const GRAIN: f64 = 0.002;

/// Number of sides of the prism that approximates a cylinder.
const SIDES: usize = 16;

/// Points within a radius of the convex hull of a point set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hull {
    /// Points, metres; at least one.
    pub points: Vec<Vector3>,
    /// Radius around the convex hull, metres.
    pub radius: f64,
}

/// Placed hull in the world.
#[derive(Clone, Debug)]
pub struct PlacedHull {
    points: Vec<ParryVector>,
    radius: f64,
    middle: ParryVector,
    /// Distance from the middle to the farthest point of the solid, metres.
    bound: f64,
}

impl Hull {
    /// Returns a hull that contains all points, with at most 48 corners; `None` without points.
    pub fn around(points: &[Vector3]) -> Option<Self> {
        let grain = |v: &Vector3| [v.x, v.y, v.z].map(|x| (x / GRAIN).round() as i64);
        let mut corners: Vec<Vector3> = points.to_vec();
        corners.sort_by_key(grain);
        corners.dedup_by_key(|v| grain(v));
        let kept = extremes(&corners, KEPT);
        let core = Self { points: kept, radius: 0.0 };
        if core.points.is_empty() {
            return None;
        }
        let placed = core.placed(&Pose3::default());
        let out = extremes(&corners, SEEN).into_iter().map(|corner| {
            let corner = Self { points: vec![corner], radius: 0.0 }.placed(&Pose3::default());
            placed.gap(&corner, f64::INFINITY)
        });
        let radius = out.fold(0.0, f64::max);
        // Merging of corners may have moved the surface by this much.
        let grain = if points.len() > corners.len() { GRAIN } else { 0.0 };
        Some(Self { radius: radius + grain, ..core })
    }

    /// Returns a box of these half extents at a pose.
    pub fn cuboid(half: Vector3, pose: &Pose3) -> Self {
        let corner = |k: usize| {
            let sign = |bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
            pose.point(half.component_mul(&Vector3::new(sign(0), sign(1), sign(2))))
        };
        Self { points: (0..8).map(corner).collect(), radius: 0.0 }
    }

    /// Returns the prism on a footprint between two heights, metres; a disc becomes the
    /// circumscribed polygon.
    pub fn prism(footprint: &Footprint, [low, high]: [f64; 2], pose: &Pose3) -> Self {
        let corners: Vec<[f64; 2]> = match footprint {
            Footprint::Disc { radius } => {
                let step = std::f64::consts::TAU / SIDES as f64;
                let out = radius / (0.5 * step).cos();
                let at = |k| [out * (k as f64 * step).cos(), out * (k as f64 * step).sin()];
                (0..SIDES).map(at).collect()
            }
            Footprint::Rectangle { half } => {
                vec![[half.x, half.y], [-half.x, half.y], [-half.x, -half.y], [half.x, -half.y]]
            }
            Footprint::Polygon(polygon) => {
                polygon.corners().iter().map(|corner| [corner.x, corner.y]).collect()
            }
        };
        let at = |z: f64| corners.iter().map(move |[x, y]| pose.point(Vector3::new(*x, *y, z)));
        Self { points: at(low).chain(at(high)).collect(), radius: 0.0 }
    }

    /// Returns the extent of the points along their axis of least variance, metres.
    pub fn thickness(&self) -> f64 {
        let middle = self.points.iter().sum::<Vector3>() / self.points.len().max(1) as f64;
        let off = self.points.iter().map(|point| point - middle);
        let spread: Matrix3 = off.map(|off| off * off.transpose()).sum();
        let axes = spread.symmetric_eigen();
        let across = axes.eigenvectors.column(axes.eigenvalues.imin());
        let along = self.points.iter().map(|point| point.dot(&across));
        let [low, high] = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
            [low.min(at), high.max(at)]
        });
        (high - low).max(0.0)
    }

    /// Returns the hull in the world, with its frame at `pose`.
    pub fn placed(&self, pose: &Pose3) -> PlacedHull {
        let to = |v: &Vector3| {
            let v = pose.point(*v);
            ParryVector::new(v.x, v.y, v.z)
        };
        let points: Vec<ParryVector> = self.points.iter().map(to).collect();
        let zero = ParryVector::new(0.0, 0.0, 0.0);
        let middle =
            points.iter().fold(zero, |sum, point| sum + *point) / points.len().max(1) as f64;
        let far = points.iter().map(|point| (*point - middle).length()).fold(0.0, f64::max);
        PlacedHull { points, radius: self.radius, middle, bound: far + self.radius }
    }
}

impl PlacedHull {
    /// Returns the distance to another hull, metres; zero or less for contact. Beyond `reach`
    /// metres, the result is only a lower bound that exceeds `reach`.
    pub fn gap(&self, other: &Self, reach: f64) -> f64 {
        let apart = (self.middle - other.middle).length() - self.bound - other.bound;
        if apart > reach {
            return apart;
        }
        let between = distance_support_map_support_map(&ParryPose::IDENTITY, self, other);
        between - self.radius - other.radius
    }

    /// Returns the height of the lowest point, metres.
    pub fn lowest(&self) -> f64 {
        self.points.iter().map(|point| point.z).fold(f64::INFINITY, f64::min) - self.radius
    }
}

impl SupportMap for PlacedHull {
    fn local_support_point(&self, dir: ParryVector) -> ParryVector {
        let (mut best, mut most) = (self.middle, f64::NEG_INFINITY);
        for point in &self.points {
            let along = point.dot(dir);
            if along > most {
                (best, most) = (*point, along);
            }
        }
        best
    }
}

/// Returns the extreme points in `count` directions on a spiral around a sphere, without
/// duplicates.
fn extremes(points: &[Vector3], count: usize) -> Vec<Vector3> {
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let mut found: Vec<usize> = (0..count)
        .filter_map(|k| {
            let z = 1.0 - (2.0 * k as f64 + 1.0) / count as f64;
            let (out, turn) = ((1.0 - z * z).sqrt(), golden * k as f64);
            let direction = Vector3::new(out * turn.cos(), out * turn.sin(), z);
            let along = |k: &usize| points[*k].dot(&direction);
            (0..points.len()).max_by(|a, b| along(a).total_cmp(&along(b)))
        })
        .collect();
    found.sort_unstable();
    found.dedup();
    found.into_iter().map(|k| points[k]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_those_of_balls_boxes_and_what_is_rounded() {
        let ball = Hull { points: vec![Vector3::zeros()], radius: 0.1 };
        let cube = Hull::cuboid(Vector3::repeat(0.1), &Pose3::default());
        let at = |x: f64| Pose3 { position: Vector3::new(x, 0.0, 0.0), ..Pose3::default() };
        let gap =
            |a: &Hull, b: &Hull, x: f64| a.placed(&Pose3::default()).gap(&b.placed(&at(x)), 1.0);
        assert!((gap(&ball, &ball, 0.5) - 0.3).abs() < 1e-9);
        assert!((gap(&ball, &cube, 0.5) - 0.3).abs() < 1e-9);
        assert!((gap(&cube, &cube, 0.5) - 0.3).abs() < 1e-9);
        assert!(gap(&cube, &cube, 0.15) <= 0.0 && gap(&ball, &cube, 0.19) < 0.0);
        assert!((cube.placed(&at(0.0)).lowest() + 0.1).abs() < 1e-12);
        assert!((cube.thickness() - 0.2).abs() < 1e-9 && ball.thickness() == 0.0);
    }

    #[test]
    fn a_reduced_mesh_leaves_no_corner_out_and_adds_little() {
        let mut points = Vec::new();
        for (a, b) in (0..60).flat_map(|a| (0..30).map(move |b| (a, b))) {
            let (turn, up) = (f64::from(a) * 0.105, f64::from(b) * 0.1047);
            let out = 0.06 * up.sin();
            points.push(Vector3::new(out * turn.cos(), out * turn.sin(), 0.2 * up.cos()));
        }
        let hull = Hull::around(&points).expect("points");
        assert!(hull.points.len() <= KEPT && hull.radius < 0.012, "{}", hull.radius);
        let placed = hull.placed(&Pose3::default());
        let outside = |point: &&Vector3| {
            let one = Hull { points: vec![**point], radius: 0.0 }.placed(&Pose3::default());
            placed.gap(&one, 1.0) > 1e-6
        };
        assert_eq!(points.iter().find(outside), None);
        assert!(Hull::around(&[]).is_none());
    }
}
