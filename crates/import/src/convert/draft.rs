//! Conversion of a solid to an object, and of the points or area it rests on.

use nalgebra::Point3;

use crate::diagnostic::Ledger;
use crate::mesh::Mesh;
use crate::model::{Outline, Solid};
use pushplan::geometry::{
    ConvexPolygon, MAX_CORNERS, PolygonError, Pose, Shape, Vector, cross, planar_hull,
};
use pushplan::scene::{Object, Support};

use super::feet::support;
use super::occupancy::{Occupancy, seen};
use super::shadow::{apart, area, fewer, reach};
use super::upright::{Base, Rough, STRAIGHT, Upright};
use super::weighed::Weighed;

/// Distance from the middle below which a centre of mass counts as centred, metres. For rough
/// outlines, [`ROUGHLY`] applies in addition, relative to their size.
const OFF_CENTRE: f64 = 1e-6;
const ROUGHLY: f64 = 0.02;

/// Relative difference from pushplan's assumptions that deserves a note: height of the centre of
/// mass above or below the middle (relative to the height), or moment of inertia.
const WORTH_A_NOTE: f64 = 0.1;

/// Deviation of a part's sides that deserves a note, metres.
pub(super) const SEEN: f64 = 1e-4;

/// Fill ratio above which a mesh counts as equal to its enclosing prism.
const FULL: f64 = 0.9;

/// Height of feet above the lowest point that is accepted, metres.
const FEET: f64 = 1e-4;

/// Ratio of contact area to covered area below which the underside may be round; a can on its side
/// has an eighth.
const STRIP: f64 = 0.25;

/// Ratio of contact area to covered area below which the object does not rest on its whole outline.
const NARROW: f64 = 0.9;

/// Maximum length of an object on a table, metres.
const LONGEST: f64 = 2.0;

/// Solid, or several merged solids, with the spheres it stands on.
pub(super) struct Standing<'a> {
    /// Upright prism or cylinder that represents the solid.
    pub upright: Upright,
    /// Solid in the file; for merged solids, the first.
    pub solid: &'a Solid,
    /// Spheres that serve as support points.
    pub feet: Vec<&'a Solid>,
    /// Whether the object rests on this solid alone, so that its contact area is the support.
    pub alone: bool,
    /// Whether the solid is a whole object.
    pub whole: bool,
}

/// Creates an object from a solid and its support points; also returns the height of its lowest
/// point.
pub(super) fn draft(
    name: &str,
    standing: &Standing<'_>,
    (mass, centre, moment): Weighed,
    friction: f64,
    ledger: &mut Ledger,
) -> Option<(Object, f64)> {
    let Standing { upright, solid, feet, alone, whole } = standing;
    let radius = |foot: &Solid| match foot.outline {
        Outline::Sphere(radius) => radius,
        _ => 0.0,
    };
    let reach = |foot: &&Solid| foot.pose.translation.z - radius(foot);
    let low = feet.iter().map(reach).fold(upright.low, f64::min);
    if let Some(foot) = feet.iter().find(|foot| reach(foot) > low + FEET) {
        let message = format!("a sphere of `{name}` does not reach its lowest point");
        ledger.fault(foot.place, message, "spheres must be the support points of a body");
        return None;
    }
    // The height of an object on feet includes the feet; otherwise the height keeps its exact
    // digits.
    let height = if low < upright.low { upright.top() - low } else { upright.height };
    let middle = upright.middle();
    let seen = |point: Point3<f64>| upright.pose.local_point(Vector::new(point.x, point.y));
    let centre = centre.map(|centre| (seen(centre), centre.z));
    let off = centre.map_or(Vector::zeros(), |(centre, _)| centre - middle);
    let at = if off.norm() > OFF_CENTRE { middle + off } else { middle };
    let outline = upright.outline();
    let reach = outline.iter().map(|corner| (corner - outline[0]).norm()).fold(0.0, f64::max);
    let longest = reach.max(height);
    if longest > LONGEST && matches!(solid.outline, Outline::Mesh(_)) {
        let message =
            format!("`{name}` is {longest:.1} m long, which is too large for an object on a table");
        let advice = if longest > 100.0 * LONGEST {
            "its mesh is in millimetres: set its `scale` to 0.001 0.001 0.001"
        } else {
            "set a smaller `scale` of its mesh, such as 0.01 0.01 0.01; lengths are metres"
        };
        ledger.fault(solid.place, message, advice);
        return None;
    }
    let shape = shape(name, standing, (middle, at), height, ledger)?;
    let footprint = shape.footprint();
    if let Some((_, z)) = centre {
        let above = z - (low + height / 2.0);
        if above.abs() > WORTH_A_NOTE * height {
            let side = if above > 0.0 { "above" } else { "below" };
            let by = 1e3 * above.abs();
            let note = format!(
                "the centre of mass of `{name}` is {by:.1} mm {side} the middle; pushplan assumes \
                 the middle"
            );
            ledger.note(solid.place, note);
        }
    }
    if let Some(stated) = moment {
        let ours = mass * footprint.gyration_radius().powi(2);
        if (stated - ours).abs() > WORTH_A_NOTE * ours {
            let note = format!(
                "`{name}` states {:.2} times the moment of inertia about the vertical of a uniform \
                 solid; pushplan assumes the uniform solid",
                stated / ours
            );
            ledger.note(solid.place, note);
        }
    }
    let pose = Pose { position: upright.pose.point(at), heading: upright.pose.heading };
    let points = feet.iter().map(|foot| {
        let at = foot.pose.translation;
        pose.local_point(Vector::new(at.x, at.y))
    });
    let points: Vec<Vector> = points.collect();
    let support = match &upright.rough {
        Some(rough) if points.is_empty() => {
            if *alone && *whole {
                roughly(name, (upright, *solid, true), rough, ledger);
            }
            match alone {
                true => standing_on(name, standing, rough, at, ledger),
                false => Support::Even,
            }
        }
        _ => {
            let Some(support) = support(&points, &footprint) else {
                let message = format!("`{name}` stands on {} spheres", feet.len());
                ledger.fault(solid.place, message, "give it three to eight support points");
                return None;
            };
            support
        }
    };
    let color = solid.material.color;
    Some((Object { support, mass, friction, pose, color, ..Object::new(name, shape) }, low))
}

/// Returns the shape of a solid whose centre of mass is `at`; reports a fault if there is none.
fn shape(
    name: &str,
    Standing { upright, solid, .. }: &Standing<'_>,
    (middle, at): (Vector, Vector),
    height: f64,
    ledger: &mut Ledger,
) -> Option<Shape> {
    let off = (at - middle).norm();
    let polygon = |corners: &[Vector], ledger: &mut Ledger| {
        let base = balanced(name, solid, corners, (at, off), ledger)?;
        Some(Shape::Prism { base, height })
    };
    match &upright.base {
        Base::Rectangle([x, y]) if at == middle => Some(Shape::Cuboid { size: [*x, *y, height] }),
        Base::Rectangle([x, y]) => {
            let ends = [[-x, -y], [*x, -y], [*x, *y], [-x, *y]];
            polygon(&ends.map(|end| Vector::from(end) / 2.0), ledger)
        }
        Base::Disc(radius) if off <= OFF_CENTRE.max(ROUGHLY * radius) => {
            if off > OFF_CENTRE && upright.rough.is_none() {
                let by = 1e3 * off;
                let note = format!(
                    "the centre of mass of `{name}` is {by:.2} mm off its axis; it was moved to \
                     the axis"
                );
                ledger.note(solid.place, note);
            }
            Some(Shape::Cylinder { radius: *radius, height })
        }
        Base::Disc(radius) => {
            // A polygon of equal area: its corners lie outside the disc, its sides inside.
            let corners = MAX_CORNERS as f64;
            let half = std::f64::consts::PI / corners;
            let reach = radius * (half / (half.sin() * half.cos())).sqrt();
            let ring = (0..MAX_CORNERS).map(|k| {
                let angle = (2.0 * k as f64 + 1.0) * half;
                reach * Vector::new(angle.cos(), angle.sin())
            });
            let note = format!(
                "the centre of mass of `{name}` is {:.1} mm off its axis; the cylinder is replaced \
                 by a prism of {corners} corners, which deviates by up to {:.1} mm",
                1e3 * off,
                1e3 * (radius - reach * half.cos()).max(reach - radius)
            );
            ledger.note(solid.place, note);
            polygon(&ring.collect::<Vec<_>>(), ledger)
        }
        Base::Polygon(corners) => polygon(corners, ledger),
    }
}

/// Returns the base of a prism whose centre of mass is `at`, at a distance from the middle; reports
/// a fault if there is none.
fn balanced(
    name: &str,
    solid: &Solid,
    corners: &[Vector],
    (at, off): (Vector, f64),
    ledger: &mut Ledger,
) -> Option<ConvexPolygon> {
    let made = match ConvexPolygon::balanced(corners, at) {
        // Corners that are too near, or almost on a line, are left out.
        Err(error) if error != PolygonError::Unbalanced => {
            ConvexPolygon::balanced(&fewer(corners), at)
        }
        made => made,
    };
    match &made {
        Err(PolygonError::Unbalanced) => {
            let by = 1e3 * off;
            let message = format!(
                "the centre of mass of `{name}` is {by:.1} mm from the middle, outside its outline"
            );
            let advice = "correct the position in its <inertial> (`origin` in URDF, `pos` in \
                          MJCF), or remove <inertial> and give --density";
            ledger.fault(solid.place, message, advice);
        }
        Err(error) => {
            let message = format!("`{name}` is not a prism that pushplan supports: {error}");
            ledger.fault(solid.place, message, "replace it by a box or a cylinder");
        }
        Ok(_) => {}
    }
    made.ok()
}

/// Reports the deviation of a mesh from the prism or cylinder that represents it.
pub(super) fn roughly(
    name: &str,
    (upright, solid, alone): (&Upright, &Solid, bool),
    rough: &Rough,
    ledger: &mut Ledger,
) {
    // For parts, small deviations are not reported.
    if !alone && rough.off < SEEN {
        return;
    }
    let what = match &upright.base {
        Base::Polygon(corners) => format!("a prism of {} corners", corners.len()),
        _ => "an upright cylinder".to_owned(),
    };
    let mut note = format!(
        "`{name}` is replaced by {what} around its outline, {:.0} mm high, whose sides deviate by \
         up to {:.1} mm",
        1e3 * upright.height,
        1e3 * rough.off
    );
    if rough.fill < FULL && alone {
        note += &format!("; it fills {:.0} % of it", 100.0 * rough.fill);
    }
    ledger.note(solid.place, note);
}

/// Returns the note on the difference between the surfaces of a body and the outlines of the solids
/// that represent it.
pub(super) fn compared(name: &str, surfaces: &[&Mesh], outlines: &[Vec<Vector>]) -> String {
    let triangles: Vec<Vec<Vector>> = surfaces.iter().flat_map(|mesh| seen(mesh)).collect();
    let [more, less] = Occupancy::differences(&triangles, outlines);
    let hull = planar_hull(&triangles.concat(), 0.0);
    let solids = outlines.concat();
    let off = apart(&hull, |direction| reach(&solids, direction));
    format!(
        "`{name}` is replaced by {} solids, which cover {:.1} % more of the table and {:.1} % less \
         than its mesh; its outline is up to {:.1} mm off",
        outlines.len(),
        100.0 * more,
        100.0 * less,
        1e3 * off
    )
}

/// Returns the support of a mesh: its contact area, if smaller than its outline.
fn standing_on(
    name: &str,
    Standing { upright, solid, .. }: &Standing<'_>,
    rough: &Rough,
    at: Vector,
    ledger: &mut Ledger,
) -> Support {
    if rough.stands.is_empty() || area(&rough.stands) > NARROW * upright.area() {
        return Support::Even;
    }
    let corners = fewer(&planar_hull(&rough.stands, STRAIGHT));
    let inside = |corners: &[Vector]| {
        let next = corners.iter().cycle().skip(1);
        corners.len() > 2
            && corners.iter().zip(next).all(|(a, b)| cross(b - a, at - a) > 1e-3 * (b - a).norm())
    };
    if !inside(&corners) {
        let note = format!(
            "`{name}` would not stand at the pose in the file, because its centre of mass is not \
             above its lowest points. Its whole outline is used as support"
        );
        ledger.note(solid.place, note);
        return Support::Even;
    }
    if area(&corners) < STRIP * upright.area() {
        let share = 100.0 * area(&corners) / upright.area();
        let note = format!(
            "the support of `{name}` is {share:.0} % of its outline; pushplan assumes that it does \
             not roll"
        );
        ledger.note(solid.place, note);
    }
    // Relative to the centre of mass, and slightly inward, so that all points are under the object.
    Support::Points(corners.into_iter().map(|corner| 0.995 * (corner - at)).collect())
}
