//! Solids that stand upright: what they cover on the table, and from where to where they reach.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Point3, Vector3};

use crate::geometry::{Pose, Vector, centroid, cross};
use crate::import::fault::Ledger;
use crate::import::model::{Outline, Solid};

use super::hull::hull;

/// A solid that leans less than this is upright, radians: files round their turns.
const LEAN: f64 = 1e-3;

/// Top and bottom of a prism differ by no more than this, metres.
const PRISM: f64 = 2e-4;

/// What an upright solid covers on the table, in its own frame, metres.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Base {
    /// A rectangle of these full extents about the origin.
    Rectangle([f64; 2]),
    /// A disc of this radius about the origin.
    Disc(f64),
    /// A convex polygon, counter-clockwise.
    Polygon(Vec<Vector>),
}

/// An upright solid.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Upright {
    /// What it covers.
    pub base: Base,
    /// The frame of that in the world.
    pub pose: Pose,
    /// Height of its underside, metres.
    pub low: f64,
    /// From there to its top, metres.
    pub height: f64,
}

impl Upright {
    /// The solid standing upright; `None`, with a fault, if it does not or cannot be expressed.
    pub fn of(solid: &Solid, what: &str, ledger: &mut Ledger) -> Option<Self> {
        match &solid.outline {
            Outline::Box(half) => match standing_box(&solid.pose, *half) {
                Some(found) => Some(found),
                None => leans(solid, what, ledger),
            },
            Outline::Cylinder { radius, half } => {
                let axis = solid.pose.rotation * Vector3::z();
                if axis.xy().norm() > LEAN {
                    return leans(solid, what, ledger);
                }
                let (pose, z) = (flat(&solid.pose), solid.pose.translation.z);
                let base = Base::Disc(*radius);
                Some(Self { base, pose, low: z - half, height: 2.0 * half })
            }
            Outline::Hull(points) => {
                let found = prism(&solid.pose, points);
                if let Err(why) = &found {
                    let message = format!("the mesh of {what} is not an upright prism: {why}");
                    ledger.fault(solid.place, message, PRIMITIVES);
                }
                found.ok()
            }
            Outline::Sphere(_) => {
                ledger.fault(solid.place, format!("{what} is a sphere, and rolls"), PRIMITIVES);
                None
            }
            Outline::Plane(_) => {
                let message = format!("{what} is a plane, which only the world can have");
                ledger.fault(solid.place, message, PRIMITIVES);
                None
            }
            Outline::Other(kind) => {
                ledger.fault(solid.place, format!("{what} is {kind}"), PRIMITIVES);
                None
            }
        }
    }

    /// Height of its top above the origin, metres.
    pub fn top(&self) -> f64 {
        self.low + self.height
    }

    /// Area of the base, square metres.
    fn area(&self) -> f64 {
        match &self.base {
            Base::Rectangle([x, y]) => x * y,
            Base::Disc(radius) => PI * radius * radius,
            Base::Polygon(corners) => {
                let next = corners.iter().cycle().skip(1);
                corners.iter().zip(next).map(|(a, b)| cross(*a, *b)).sum::<f64>() / 2.0
            }
        }
    }

    /// Where an even weight has its middle, in the frame of the base, metres.
    pub fn middle(&self) -> Vector {
        match &self.base {
            Base::Polygon(corners) => centroid(corners),
            _ => Vector::zeros(),
        }
    }

    /// Whether a point of the world's plane is over it.
    pub fn covers(&self, point: Vector) -> bool {
        let local = self.pose.local_point(point);
        match &self.base {
            Base::Rectangle([x, y]) => 2.0 * local.x.abs() <= *x && 2.0 * local.y.abs() <= *y,
            Base::Disc(radius) => local.norm() <= *radius,
            Base::Polygon(corners) => {
                let next = corners.iter().cycle().skip(1);
                corners.iter().zip(next).all(|(a, b)| cross(b - a, local - a) >= 0.0)
            }
        }
    }
}

/// Volume of a solid, m^3, wherever it stands; none if it has none that could be told.
pub(super) fn volume(solid: &Solid) -> Option<f64> {
    match &solid.outline {
        Outline::Box([x, y, z]) => Some(8.0 * x * y * z),
        Outline::Cylinder { radius, half } => Some(2.0 * PI * radius * radius * half),
        Outline::Sphere(radius) => Some(4.0 / 3.0 * PI * radius.powi(3)),
        Outline::Plane(_) => Some(0.0),
        Outline::Hull(points) => {
            let upright = prism(&solid.pose, points).ok()?;
            Some(upright.area() * upright.height)
        }
        Outline::Other(_) => None,
    }
}

/// What to do with a shape that cannot be expressed.
const PRIMITIVES: &str = "put boxes, upright cylinders or upright prisms (meshes whose vertices are \
    corners of top and bottom) in its place, or let it touch nothing";

fn leans<T>(solid: &Solid, what: &str, ledger: &mut Ledger) -> Option<T> {
    let advice = "pushplan's solids stand upright: turn it by multiples of 90 degrees";
    ledger.fault(solid.place, format!("{what} leans"), advice);
    None
}

/// The pose of an upright frame seen from above, and that of a leaning one without its turn.
pub(super) fn flat(pose: &Isometry3<f64>) -> Pose {
    let ([x, y], ahead) = ([pose.translation.x, pose.translation.y], pose.rotation * Vector3::x());
    let upright = ahead.z.abs() < LEAN;
    Pose::new(x, y, if upright { ahead.y.atan2(ahead.x) } else { 0.0 })
}

/// A box that stands on any of its faces.
fn standing_box(pose: &Isometry3<f64>, half: [f64; 3]) -> Option<Upright> {
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| pose.rotation * axis);
    let up = (0..3).find(|k| axes[*k].xy().norm() <= LEAN)?;
    // The box's own x ahead, unless that is what stands up.
    let [ahead, aside] = match up {
        2 => [0, 1],
        1 => [0, 2],
        _ => [1, 2],
    };
    let heading = axes[ahead].y.atan2(axes[ahead].x);
    let z = pose.translation.z;
    Some(Upright {
        base: Base::Rectangle([2.0 * half[ahead], 2.0 * half[aside]]),
        pose: Pose::new(pose.translation.x, pose.translation.y, heading),
        low: z - half[up],
        height: 2.0 * half[up],
    })
}

/// The upright prism whose corners these points are, or why they do not make one.
fn prism(pose: &Isometry3<f64>, points: &[Point3<f64>]) -> Result<Upright, String> {
    let frame = flat(pose);
    let placed: Vec<Point3<f64>> = points.iter().map(|point| pose * point).collect();
    let heights = || placed.iter().map(|point| point.z);
    let low = heights().fold(f64::INFINITY, f64::min);
    let high = heights().fold(f64::NEG_INFINITY, f64::max);
    let seen = |point: &Point3<f64>| frame.local_point(Vector::new(point.x, point.y));
    let corners = hull(&placed.iter().map(seen).collect::<Vec<_>>());
    if corners.len() < 3 || high - low < PRISM {
        return Err("it is flat".to_owned());
    }
    for (end, z) in [("bottom", low), ("top", high)] {
        let level: Vec<Vector> =
            placed.iter().filter(|point| (point.z - z).abs() <= PRISM).map(seen).collect();
        let off = corners.iter().map(|corner| {
            level.iter().map(|point| (point - corner).norm()).fold(f64::INFINITY, f64::min)
        });
        let worst = off.fold(0.0, f64::max);
        if worst > PRISM {
            let by = if worst.is_finite() {
                format!(" by {:.1} mm", 1e3 * worst)
            } else {
                String::new()
            };
            return Err(format!("its {end} misses corners of its outline{by}"));
        }
    }
    Ok(Upright { base: Base::Polygon(corners), pose: frame, low, height: high - low })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use nalgebra::{Translation3, UnitQuaternion};

    use super::*;

    fn placed(roll: f64, pitch: f64, yaw: f64) -> Isometry3<f64> {
        let turn = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        Isometry3::from_parts(Translation3::new(0.3, -0.1, 0.5), turn)
    }

    #[test]
    fn a_box_stands_on_any_face_with_its_extents_along_the_right_axes() {
        let half = [0.01, 0.02, 0.03];
        let size = |pose: &Isometry3<f64>| {
            let found = standing_box(pose, half).expect("it stands");
            let Base::Rectangle(size) = found.base else { panic!("{found:?}") };
            (size.map(|extent| (1e6 * extent).round()), (1e6 * found.height).round())
        };
        assert_eq!(size(&placed(0.0, 0.0, 0.4)), ([2e4, 4e4], 6e4));
        assert_eq!(size(&placed(FRAC_PI_2, 0.0, 0.4)), ([2e4, 6e4], 4e4));
        assert_eq!(size(&placed(0.0, FRAC_PI_2, 0.4)), ([4e4, 6e4], 2e4));
        assert_eq!(standing_box(&placed(0.2, 0.0, 0.0), half), None);
        let turned = standing_box(&placed(0.0, 0.0, 0.4), half).map(|found| found.pose.heading);
        assert!((turned.unwrap() - 0.4).abs() < 1e-12);
    }

    #[test]
    fn a_prism_has_the_same_corners_above_and_below() {
        let triangle = [[0.0, 0.0], [0.06, 0.0], [0.0, 0.04]];
        let ring = |z: f64, share: f64| {
            triangle.map(|[x, y]| Point3::new(share * x, share * y, z)).to_vec()
        };
        let pose = placed(0.0, 0.0, 0.0);
        let whole = prism(&pose, &[ring(0.0, 1.0), ring(0.05, 1.0)].concat()).expect("a prism");
        assert!((whole.area() - 0.0012).abs() < 1e-12 && (whole.top() - 0.55).abs() < 1e-12);
        let narrow = prism(&pose, &[ring(0.0, 1.0), ring(0.05, 0.9)].concat());
        assert!(narrow.unwrap_err().contains("its top misses corners of its outline by 6.0 mm"));
    }
}
