//! Features of a plate's shape, with a fixed count.

use crate::geometry::Vector;
use crate::{scene::LeverFeatures, task::LeverJob};

use super::LeverView;

/// Number of outline points in a shape context.
const POINTS: usize = 500;

/// Outer end of the outermost ring, log(1 + r) in mean distances of the corners.
const FARTHEST: f64 = 2.2;

/// Unit of lengths, metres: the size of a plate.
const LENGTH: f64 = 0.1;

/// Returns the features of a job's plate in `view`: lengths in tenths of a metre, shares from 0 to
/// 1.
pub fn lever_features(features: LeverFeatures, job: &LeverJob, view: &LeverView) -> Vec<f32> {
    match features {
        LeverFeatures::Nothing => Vec::new(),
        LeverFeatures::ShapeContext => shape_context(&outline(job, view)),
        LeverFeatures::Corners => corners(job, view),
        LeverFeatures::Support => support(job, view),
        LeverFeatures::Shape => [corners(job, view), support(job, view)].concat(),
    }
}

/// Returns the features of the lever-up itself: depth, pivot, angle, thickness, friction with table
/// and blade.
pub fn lever_action(job: &LeverJob) -> [f32; LeverFeatures::ACTION] {
    let LeverJob { scene, lever } = job;
    let plate = &scene.plates[lever.plate];
    let mean = |other: f64| 0.5 * (plate.friction + other);
    [
        lever.depth / 0.02,
        lever.pivot / LENGTH,
        lever.angle,
        plate.slabs[0].height / 0.01,
        mean(scene.table_friction),
        mean(scene.blade.friction),
    ]
    .map(|value| value as f32)
}

/// Returns the corners in the view, counter-clockwise from the end of the levered edge, metres.
fn outline(job: &LeverJob, view: &LeverView) -> Vec<Vector> {
    let corners = job.scene.plates[job.lever.plate].corners();
    let (count, edge) = (corners.len(), job.lever.place.edge);
    let nth = |k: usize| if view.is_mirrored() { edge + count - k } else { edge + 1 + k };
    (0..count).map(|k| view.point(job, corners[nth(k) % count])).collect()
}

fn corners(job: &LeverJob, view: &LeverView) -> Vec<f32> {
    let outline = outline(job, view);
    let (count, most) = (outline.len(), LeverFeatures::CORNERS);
    // Missing corners are replaced by the last one, at which the levered edge begins.
    let nth = |k: usize| if count > most { k * count / most } else { k.min(count - 1) };
    let mut values: Vec<f32> = (0..most).flat_map(|k| pair(outline[nth(k)])).collect();
    values.extend(pair(view.point(job, Vector::zeros())));
    values
}

fn support(job: &LeverJob, view: &LeverView) -> Vec<f32> {
    let plate = &job.scene.plates[job.lever.plate];
    let centre = pair(view.point(job, Vector::zeros()));
    let Some(support) = plate.support(job.lever.place) else {
        return [centre; 4].concat()[..7].into();
    };
    let corners = plate.corners();
    let ends = [support.edge, (support.edge + 1) % corners.len()];
    let mut ends = ends.map(|corner| pair(view.point(job, corners[corner])));
    let mut fraction = support.fraction;
    if view.is_mirrored() {
        ends.swap(0, 1);
        fraction = 1.0 - fraction;
    }
    let [a, b] = ends;
    [&a[..], &b[..], &centre[..], &[fraction as f32]].concat()
}

fn pair(at: Vector) -> [f32; 2] {
    [(at.x / LENGTH) as f32, (at.y / LENGTH) as f32]
}

/// Returns the shares of [`POINTS`] points at even distances along an outline in rings and wedges
/// about the origin, times the number of bins. The shape context of Belongie, Malik and Puzicha
/// 2002, here over the inward half-plane.
fn shape_context(outline: &[Vector]) -> Vec<f32> {
    let [rings, wedges] = LeverFeatures::BINS;
    let mut counts = vec![0.0; rings * wedges];
    let size = outline.iter().map(|c| c.norm()).sum::<f64>() / outline.len().max(1) as f64;
    let next = |k: usize| outline[(k + 1) % outline.len()];
    let whole: f64 = outline.iter().enumerate().map(|(k, at)| (next(k) - at).norm()).sum();
    let (mut side, mut passed) = (0, 0.0);
    for point in 0..POINTS {
        let along = whole * (point as f64 + 0.5) / POINTS as f64;
        let length = |k: usize| (next(k) - outline[k]).norm();
        while side + 1 < outline.len() && passed + length(side) < along {
            passed += length(side);
            side += 1;
        }
        let share = (along - passed) / length(side).max(1e-12);
        let at = outline[side] + (next(side) - outline[side]) * share;
        let ring = (at.norm() / size).ln_1p() / FARTHEST.ln_1p() * rings as f64;
        let turn = at.y.atan2(at.x) / std::f64::consts::PI + 0.5;
        let bin = |value: f64, count: usize| (value.max(0.0) as usize).min(count - 1);
        let at = bin(ring, rings) * wedges + bin(turn * wedges as f64, wedges);
        counts[at] += (rings * wedges) as f32 / POINTS as f32;
    }
    counts
}
