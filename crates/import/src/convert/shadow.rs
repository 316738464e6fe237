//! Projection of a body of any form onto the table: a disc or a polygon with few corners.

use std::f64::consts::{PI, TAU};

use pushplan::geometry::{ConvexPolygon, MAX_CORNERS, Pose, Vector, centroid, cross, planar_hull};

use super::upright::Base;

/// Minimum height of a corner above its neighbours' line to be kept, metres.
const WORTH: f64 = 2e-4;

/// Minimum distance of corners (metres) and minimum angle at a corner (radians), slightly above the
/// requirements of polygons.
const NEAREST: f64 = 1.1e-3;
const STRAIGHTEST: f64 = 0.018;

/// Area below which an outline counts as a line, square metres.
pub(super) const FLAT: f64 = 1e-7;

/// Number of directions in which outlines are compared.
const DIRECTIONS: usize = 360;

/// Returns the area of a polygon, square metres.
pub(super) fn area(corners: &[Vector]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| cross(*a, *b)).sum::<f64>() / 2.0
}

/// Returns the disc or polygon nearest to the convex hull of points, its position and the maximum
/// deviation of its outline, metres; `None` if the points are collinear.
pub(super) fn shadow(points: &[Vector]) -> Option<(Base, Vector, f64)> {
    let outline = planar_hull(points, 0.0);
    let size = area(&outline);
    if outline.len() < 3 || size < FLAT {
        return None;
    }
    let corners = sound(&outline);
    let polygon = apart(&outline, |direction| reach(&corners, direction));
    let (middle, radius) = (centroid(&outline), (size / PI).sqrt());
    let disc = apart(&outline, |direction| middle.dot(&direction) + radius);
    if polygon > WORTH && disc < polygon {
        return Some((Base::Disc(radius), middle, disc));
    }
    Some((Base::Polygon(corners), Vector::zeros(), polygon))
}

/// Returns the corners of a polygon near an outline: a rectangle around it if it is thin.
fn sound(outline: &[Vector]) -> Vec<Vector> {
    let (size, pose) = around(outline);
    let corners = fewer(outline);
    if size.iter().all(|side| *side > 2.0 * NEAREST) && ConvexPolygon::new(&corners).is_ok() {
        return corners;
    }
    let [x, y] = size.map(|side| side.max(NEAREST) / 2.0);
    [[-x, -y], [x, -y], [x, y], [-x, y]].map(|end| pose.point(Vector::from(end))).to_vec()
}

/// Returns the sides (metres) and pose of the smallest rectangle around convex corners; it shares a
/// side with their outline.
pub(super) fn around(corners: &[Vector]) -> ([f64; 2], Pose) {
    let boxed = |heading: f64| {
        let frame = Pose { position: Vector::zeros(), heading };
        let local = || corners.iter().map(|corner| frame.local_point(*corner));
        let low = local().fold(Vector::repeat(f64::INFINITY), |least, point| least.inf(&point));
        let high = local().fold(Vector::repeat(f64::NEG_INFINITY), |most, point| most.sup(&point));
        let position = frame.point((low + high) / 2.0);
        ([high.x - low.x, high.y - low.y], Pose { position, heading })
    };
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let all = sides.map(|(a, b)| boxed((b.y - a.y).atan2(b.x - a.x)));
    all.min_by(|(a, _), (b, _)| (a[0] * a[1]).total_cmp(&(b[0] * b[1])))
        .unwrap_or_else(|| boxed(0.0))
}

/// Simplifies an outline to at most the number of corners that a polygon may have, with equal area;
/// corners of little effect are removed.
pub(super) fn fewer(outline: &[Vector]) -> Vec<Vector> {
    // Of thousands of corners, only the extreme ones in some hundred directions are kept, because
    // the loop below takes quadratic time.
    let mut corners = match outline.len() > 2 * DIRECTIONS {
        false => outline.to_vec(),
        true => {
            let mut kept: Vec<usize> =
                directions().filter_map(|towards| farthest(outline, towards)).collect();
            kept.sort_unstable();
            kept.dedup();
            kept.into_iter().map(|k| outline[k]).collect()
        }
    };
    loop {
        let count = corners.len();
        if count <= 3 {
            break;
        }
        let at = |k: usize| corners[k % count];
        // Height of a corner above the line between its neighbours.
        let height = |k: usize| {
            let (before, own, after) = (at(k + count - 1), at(k), at(k + 1));
            let base = after - before;
            cross(base, own - before).abs() / base.norm().max(1e-12)
        };
        let flat = |k: usize| {
            let (before, after) = (at(k) - at(k + count - 1), at(k + 1) - at(k));
            let turn = cross(before, after).atan2(before.dot(&after));
            after.norm() < NEAREST || before.norm() < NEAREST || turn < STRAIGHTEST
        };
        let least = |a: &usize, b: &usize| height(*a).total_cmp(&height(*b));
        let Some(lowest) = (0..count).min_by(least) else { break };
        let bad = (0..count).filter(|k| flat(*k)).min_by(least);
        match bad {
            Some(bad) => corners.remove(bad),
            None if count > MAX_CORNERS || height(lowest) < WORTH => corners.remove(lowest),
            None => break,
        };
    }
    if corners.len() < outline.len() {
        let middle = centroid(&corners);
        let share = (area(outline) / area(&corners)).sqrt();
        if share.is_finite() {
            corners.iter_mut().for_each(|corner| *corner = middle + (*corner - middle) * share);
        }
    }
    corners
}

pub(super) fn reach(corners: &[Vector], direction: Vector) -> f64 {
    corners.iter().map(|corner| corner.dot(&direction)).fold(f64::NEG_INFINITY, f64::max)
}

fn directions() -> impl Iterator<Item = Vector> {
    (0..DIRECTIONS).map(|k| {
        let angle = TAU * k as f64 / DIRECTIONS as f64;
        Vector::new(angle.cos(), angle.sin())
    })
}

/// Returns the index of the extreme corner in a direction.
fn farthest(corners: &[Vector], towards: Vector) -> Option<usize> {
    let reach = |k: &usize| corners[*k].dot(&towards);
    (0..corners.len()).max_by(|a, b| reach(a).total_cmp(&reach(b)))
}

/// Returns the distance of two convex outlines: the maximum difference of their support functions.
pub(super) fn apart(outline: &[Vector], other: impl Fn(Vector) -> f64) -> f64 {
    directions().map(|towards| (reach(outline, towards) - other(towards)).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(count: usize, radius: f64, stretched: f64) -> Vec<Vector> {
        let at = |k: usize| {
            let angle = TAU * k as f64 / count as f64;
            Vector::new(stretched * radius * angle.cos(), radius * angle.sin())
        };
        (0..count).map(at).collect()
    }

    #[test]
    fn rings_become_discs_and_ovals_polygons_of_eight_corners() {
        let (base, at, off) = shadow(&ring(48, 0.04, 1.0)).expect("a shadow");
        let Base::Disc(radius) = base else { panic!("{base:?}") };
        assert!((radius - 0.04).abs() < 2e-4 && at.norm() < 1e-9 && off < 2e-4);
        let (base, _, off) = shadow(&ring(48, 0.04, 1.5)).expect("a shadow");
        let Base::Polygon(corners) = base else { panic!("{base:?}") };
        assert!(corners.len() == MAX_CORNERS && (1e-4..5e-3).contains(&off), "{off}");
        assert!((area(&corners) / area(&ring(48, 0.04, 1.5)) - 1.0).abs() < 1e-9);
        assert_eq!(shadow(&[Vector::zeros(), Vector::new(0.1, 0.1), Vector::new(0.2, 0.2)]), None);
    }

    #[test]
    fn few_corners_stay_where_they_are() {
        let square = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.05], [0.0, 0.05]].map(Vector::from);
        assert_eq!(shadow(&square), Some((Base::Polygon(square.to_vec()), Vector::zeros(), 0.0)));
    }
}
