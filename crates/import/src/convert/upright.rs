//! Representation of solids as upright prisms or cylinders: covered area and height range.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Point3, Vector3};

use crate::diagnostic::Ledger;
use crate::model::{Outline, Solid};
use pushplan::geometry::{ConvexPolygon, MAX_CORNERS, Pose, Vector, centroid, cross, planar_hull};

use super::shadow::{area, shadow};

/// Maximum inclination of an upright solid, radians, because files round rotations.
const LEAN: f64 = 1e-3;

/// Maximum deviation of the top and bottom corners of a prism, metres.
const PRISM: f64 = 2e-4;

/// Minimum height of a solid that can be pushed, metres.
pub(super) const THIN: f64 = 1e-3;

/// Height above the lowest point within which points of a mesh touch the table, metres; at least a
/// hundredth of its height.
const LEVEL: f64 = 3e-4;

/// Distance from the line between its neighbours below which a corner is left out, metres.
pub(super) const STRAIGHT: f64 = 1e-6;

/// Number of points that approximate a circle.
const AROUND: usize = 48;

/// Area that an upright solid covers on the table, in its own frame, metres.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Base {
    /// Rectangle of these full extents about the origin.
    Rectangle([f64; 2]),
    /// Disc of this radius about the origin.
    Disc(f64),
    /// Convex polygon, counter-clockwise.
    Polygon(Vec<Vector>),
}

/// Upright prism or cylinder.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Upright {
    /// Covered area.
    pub base: Base,
    /// Pose of the covered area in the world.
    pub pose: Pose,
    /// Height of the underside, metres.
    pub low: f64,
    /// Height from underside to top, metres.
    pub height: f64,
    /// Deviation from the original solid, if any.
    pub rough: Option<Rough>,
}

/// Deviation of a solid from the prism or cylinder that encloses it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rough {
    /// Maximum distance of the outlines, metres.
    pub off: f64,
    /// Share of the prism that the solid fills.
    pub fill: f64,
    /// Corners of the contact area, in the frame of the base, metres; empty if unknown.
    pub stands: Vec<Vector>,
    /// Corners of the covered area in the world, metres.
    pub outline: Vec<Vector>,
}

impl Upright {
    /// Converts a solid that stands upright; returns `None` and reports a fault if it leans or
    /// cannot be expressed.
    pub fn of(solid: &Solid, what: &str, ledger: &mut Ledger) -> Option<Self> {
        match &solid.outline {
            Outline::Box(half) => match standing_box(&solid.pose, *half) {
                Some(found) => Some(found),
                None => leans(solid, what, ledger),
            },
            Outline::Cylinder { radius, half } => {
                let axis = solid.pose.rotation * Vector3::z();
                if axis.z.abs() <= LEAN {
                    ledger.fault(solid.place, format!("{what} lies on its side"), ROLLS);
                    return None;
                }
                if axis.xy().norm() > LEAN {
                    return leans(solid, what, ledger);
                }
                let (pose, z) = (flat(&solid.pose), solid.pose.translation.z);
                let base = Base::Disc(*radius);
                Some(Self { base, pose, low: z - half, height: 2.0 * half, rough: None })
            }
            Outline::Mesh(mesh) => match prism(&solid.pose, &mesh.points) {
                Ok(found) => Some(found),
                Err(_) => Self::any(solid, what, ledger),
            },
            Outline::Sphere(_) | Outline::Ellipsoid(_) | Outline::Capsule { .. } => {
                let kind = match solid.outline {
                    Outline::Sphere(_) => "a sphere",
                    Outline::Ellipsoid(_) => "an ellipsoid",
                    _ => "a capsule",
                };
                ledger.fault(solid.place, format!("{what} is {kind}, which rolls"), PRIMITIVES);
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

    /// Converts a solid in any orientation to the enclosing upright prism or cylinder, for solids
    /// that support each other. Returns `None` and reports a fault if the solid cannot be
    /// expressed.
    pub fn any(solid: &Solid, what: &str, ledger: &mut Ledger) -> Option<Self> {
        let is_upright = match &solid.outline {
            Outline::Box(half) => standing_box(&solid.pose, *half).is_some(),
            Outline::Cylinder { .. } => (solid.pose.rotation * Vector3::z()).xy().norm() <= LEAN,
            Outline::Mesh(mesh) => prism(&solid.pose, &mesh.points).is_ok(),
            Outline::Plane(_) | Outline::Other(_) => true,
            _ => false,
        };
        if is_upright {
            return Self::of(solid, what, ledger);
        }
        let points = cloud(&solid.outline);
        let placed: Vec<Point3<f64>> = points.iter().map(|point| solid.pose * point).collect();
        let volume = volume(solid);
        let found = Self::over(&placed, volume, matches!(solid.outline, Outline::Mesh(_)));
        if found.is_none() {
            let advice = "check its scale; lengths are metres";
            ledger.fault(solid.place, format!("{what} is flat or too small to be pushed"), advice);
        }
        found
    }

    /// Returns the upright prism or cylinder over points in the world; `None` if they are flat.
    pub fn over(points: &[Point3<f64>], volume: Option<f64>, rests: bool) -> Option<Self> {
        let heights = || points.iter().map(|point| point.z);
        let low = heights().fold(f64::INFINITY, f64::min);
        let height = heights().fold(f64::NEG_INFINITY, f64::max) - low;
        let seen: Vec<Vector> = points.iter().map(|point| Vector::new(point.x, point.y)).collect();
        let (base, at, off) = shadow(&seen)?;
        if height < THIN {
            return None;
        }
        // In the frame of the base, whose origin is the centre of a disc.
        let under = points.iter().filter(|point| point.z - low <= LEVEL.max(0.01 * height));
        let under: Vec<Vector> = under.map(|point| Vector::new(point.x, point.y) - at).collect();
        let pose = Pose { position: at, heading: 0.0 };
        let mut found = Self { base, pose, low, height, rough: None };
        let fill = volume.map_or(1.0, |volume| volume / (found.area() * height)).min(1.0);
        let stands = if rests { planar_hull(&under, STRAIGHT) } else { Vec::new() };
        let outline = planar_hull(&seen, 0.0);
        found.rough = Some(Rough { off, fill, stands, outline });
        Some(found)
    }

    /// Returns the height of the top above the origin, metres.
    pub fn top(&self) -> f64 {
        self.low + self.height
    }

    /// Returns the area of the base, square metres.
    pub fn area(&self) -> f64 {
        match &self.base {
            Base::Rectangle([x, y]) => x * y,
            Base::Disc(radius) => PI * radius * radius,
            Base::Polygon(corners) => area(corners),
        }
    }

    /// Returns the corners of the area that the original solid covers in the world, metres.
    pub fn outline(&self) -> Vec<Vector> {
        self.rough.as_ref().map_or_else(|| self.corners(), |rough| rough.outline.clone())
    }

    /// Returns the corners of the base in the world, metres; a disc is approximated by points on
    /// it.
    pub fn corners(&self) -> Vec<Vector> {
        let corners = match &self.base {
            Base::Rectangle([x, y]) => {
                [[-x, -y], [*x, -y], [*x, *y], [-x, *y]].map(|end| Vector::from(end) / 2.0).to_vec()
            }
            Base::Disc(radius) => {
                let angles = (0..AROUND).map(|k| 2.0 * PI * k as f64 / AROUND as f64);
                angles.map(|angle| *radius * Vector::new(angle.cos(), angle.sin())).collect()
            }
            Base::Polygon(corners) => corners.clone(),
        };
        corners.into_iter().map(|corner| self.pose.point(corner)).collect()
    }

    /// Returns the centroid of the base in its frame, metres.
    pub fn middle(&self) -> Vector {
        match &self.base {
            Base::Polygon(corners) => centroid(corners),
            _ => Vector::zeros(),
        }
    }

    /// Returns `true` if the base contains a point of the table plane, given in the world.
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

/// Returns the volume of a solid in any orientation, m^3; `None` if it is unknown.
pub(super) fn volume(solid: &Solid) -> Option<f64> {
    match &solid.outline {
        Outline::Box([x, y, z]) => Some(8.0 * x * y * z),
        Outline::Cylinder { radius, half } => Some(2.0 * PI * radius * radius * half),
        Outline::Sphere(radius) => Some(4.0 / 3.0 * PI * radius.powi(3)),
        Outline::Capsule { radius, half } => {
            Some(PI * radius * radius * (2.0 * half + 4.0 / 3.0 * radius))
        }
        Outline::Ellipsoid([x, y, z]) => Some(4.0 / 3.0 * PI * x * y * z),
        Outline::Plane(_) => Some(0.0),
        Outline::Mesh(mesh) => Some(mesh.volume),
        Outline::Other(_) => None,
    }
}

/// Returns points whose convex hull approximates the outline, in its own frame; for round outlines
/// the points lie on the surface.
pub(super) fn cloud(outline: &Outline) -> Vec<Point3<f64>> {
    let ball = |radii: [f64; 3], shift: f64| {
        (0..=AROUND / 2).flat_map(move |row| {
            (0..AROUND).map(move |k| {
                let (up, around) =
                    (PI * row as f64 / (AROUND / 2) as f64, 2.0 * PI * k as f64 / AROUND as f64);
                let [x, y, z] = radii;
                let z = z * up.cos();
                let z = z + if z < 0.0 { -shift } else { shift };
                Point3::new(x * up.sin() * around.cos(), y * up.sin() * around.sin(), z)
            })
        })
    };
    match outline {
        Outline::Box([x, y, z]) => {
            let side = |bit: u32, half: &f64| if bit == 0 { -half } else { *half };
            let corner = |k: u32| Point3::new(side(k & 1, x), side(k & 2, y), side(k & 4, z));
            (0..8).map(corner).collect()
        }
        Outline::Cylinder { radius, half } => (0..AROUND)
            .flat_map(|k| {
                let angle = 2.0 * PI * k as f64 / AROUND as f64;
                let [x, y] = [radius * angle.cos(), radius * angle.sin()];
                [Point3::new(x, y, -half), Point3::new(x, y, *half)]
            })
            .collect(),
        Outline::Sphere(radius) => ball([*radius; 3], 0.0).collect(),
        Outline::Capsule { radius, half } => ball([*radius; 3], *half).collect(),
        Outline::Ellipsoid(radii) => ball(*radii, 0.0).collect(),
        Outline::Mesh(mesh) => mesh.points.clone(),
        Outline::Plane(_) | Outline::Other(_) => Vec::new(),
    }
}

/// Advice for solids that rest on a round side.
const ROLLS: &str = "its rolling distance cannot be predicted: stand it upright, or replace it by \
    a box if it cannot roll or does not move";

/// Advice for shapes that cannot be expressed.
pub(super) const PRIMITIVES: &str =
    "replace it by a box, an upright cylinder or a mesh (STL, OBJ), or disable its collision";

fn leans<T>(solid: &Solid, what: &str, ledger: &mut Ledger) -> Option<T> {
    let advice = "pushplan's solids stand upright: rotate it by multiples of 90 degrees";
    ledger.fault(solid.place, format!("{what} is tilted"), advice);
    None
}

/// Returns the pose of an upright frame seen from above; for a leaning frame, without its rotation.
pub(super) fn flat(pose: &Isometry3<f64>) -> Pose {
    let ([x, y], ahead) = ([pose.translation.x, pose.translation.y], pose.rotation * Vector3::x());
    let upright = ahead.z.abs() < LEAN;
    Pose::new(x, y, if upright { ahead.y.atan2(ahead.x) } else { 0.0 })
}

/// Returns a box that stands on any of its faces.
fn standing_box(pose: &Isometry3<f64>, half: [f64; 3]) -> Option<Upright> {
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| pose.rotation * axis);
    let up = (0..3).find(|k| axes[*k].xy().norm() <= LEAN)?;
    // The heading is the direction of the box's own x axis, unless that axis is vertical.
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
        rough: None,
    })
}

/// Returns the upright prism with these corners, or the reason why they do not form one.
fn prism(pose: &Isometry3<f64>, points: &[Point3<f64>]) -> Result<Upright, String> {
    let frame = flat(pose);
    let placed: Vec<Point3<f64>> = points.iter().map(|point| pose * point).collect();
    let heights = || placed.iter().map(|point| point.z);
    let low = heights().fold(f64::INFINITY, f64::min);
    let high = heights().fold(f64::NEG_INFINITY, f64::max);
    let seen = |point: &Point3<f64>| frame.local_point(Vector::new(point.x, point.y));
    let corners = planar_hull(&placed.iter().map(seen).collect::<Vec<_>>(), STRAIGHT);
    if corners.len() < 3 || high - low < PRISM {
        return Err("it is flat".to_owned());
    }
    if corners.len() > MAX_CORNERS {
        return Err("it has too many corners".to_owned());
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
            return Err(format!("its {end} lacks corners of its outline{by}"));
        }
    }
    // Otherwise, corners that are too near are merged, with a note.
    ConvexPolygon::new(&corners).map_err(|error| error.to_string())?;
    Ok(Upright { base: Base::Polygon(corners), pose: frame, low, height: high - low, rough: None })
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
        assert!(narrow.unwrap_err().contains("its top lacks corners of its outline by 6.0 mm"));
    }
}
