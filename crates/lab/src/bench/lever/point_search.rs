//! Inference of the lever point of a plate from its first motion (Tekden 2020, chapter 5).
//!
//! The search needs no training. Places on the outline are tried in a model of lever-ups, ever more
//! finely around the best one, so that the result always lies on the outline.

use std::f64::consts::TAU;

use pushplan::internals::geometry::{Pose3, Vector, Vector3};
use pushplan::internals::{
    outcome::LeverTrajectory,
    task::{LeverJob, LeverUp, Place},
};
use pushplan_learn::lever_model::LeverModel;

/// Spacing of the first places, metres.
const SPACING: f64 = 0.01;

/// Number of places that each round tries on either side of the best one, between its neighbours.
const BESIDE: i32 = 3;

/// Number of rounds after the first: places are then 0.16 mm apart.
const ROUNDS: usize = 3;

/// Candidate places on an outline, ranked by observed frames.
pub struct LeverSearch<'a> {
    model: &'a dyn LeverModel,
    job: &'a LeverJob,
    /// Lengths of the places along the outline, metres, with places and predictions.
    known: Vec<(f64, Place, LeverTrajectory)>,
    /// Distance of neighbouring places, metres.
    spacing: f64,
}

/// A lever point inferred from the first frames.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverPoint {
    /// Position of the blade.
    pub place: Place,
    /// Root mean square distance of corners between observation and prediction, metres.
    pub misfit: f64,
    /// Prediction of the model, from the first frame on.
    pub predicted: LeverTrajectory,
}

impl<'a> LeverSearch<'a> {
    /// Creates the search for the plate of `job`, whose own place is ignored; the rest of its
    /// motion is known.
    pub fn new(model: &'a dyn LeverModel, job: &'a LeverJob) -> Self {
        let outline = length(job.scene.plates[job.lever.plate].corners());
        let count = (outline / SPACING).ceil().max(1.0);
        let spacing = outline / count;
        let lengths: Vec<f64> = (0..count as usize).map(|k| k as f64 * spacing).collect();
        Self { model, job, known: roll(model, job, &lengths), spacing }
    }

    /// Returns the place whose predicted motion is closest to the first frames `seen`. Returns
    /// `None` if there are no frames.
    pub fn infer(&self, seen: &[Pose3]) -> Option<LeverPoint> {
        if seen.is_empty() {
            return None;
        }
        let corners = self.job.scene.plates[self.job.lever.plate].corners();
        let nearest = |known: &[(f64, Place, LeverTrajectory)]| {
            let off = |predicted: &LeverTrajectory| misfit(corners, seen, &predicted.lift);
            let all =
                known.iter().map(|(at, place, predicted)| (*at, *place, off(predicted), predicted));
            let best = all.min_by(|a, b| a.2.total_cmp(&b.2));
            best.map(|(at, place, misfit, predicted)| {
                (at, LeverPoint { place, misfit, predicted: predicted.clone() })
            })
        };
        let (mut at, mut best) = nearest(&self.known)?;
        let mut spacing = self.spacing;
        for _ in 0..ROUNDS {
            spacing /= f64::from(BESIDE + 1);
            let beside = (-BESIDE..=BESIDE).filter(|k| *k != 0);
            let lengths: Vec<f64> = beside.map(|k| at + f64::from(k) * spacing).collect();
            if let Some((place, found)) = nearest(&roll(self.model, self.job, &lengths))
                && found.misfit < best.misfit
            {
                (at, best) = (place, found);
            }
        }
        Some(best)
    }
}

impl LeverPoint {
    /// Returns the error against the job's own place: the angle between both as seen from the
    /// centre of mass, radians, 0 to pi.
    pub fn off(&self, job: &LeverJob) -> f64 {
        let plate = &job.scene.plates[job.lever.plate];
        let centre = plate.weight().centre;
        let [own, found] = [job.lever.place, self.place].map(|place| {
            let from = plate.corners()[place.edge];
            let to = plate.corners()[(place.edge + 1) % plate.corners().len()];
            let at = from + (to - from) * place.fraction - Vector::new(centre.x, centre.y);
            at.y.atan2(at.x)
        });
        let apart = (own - found).rem_euclid(TAU);
        apart.min(TAU - apart)
    }

    /// Returns the frames after those in `seen`: the prediction, displaced and rotated by its error
    /// in the last frame of `seen`.
    pub fn rest(&self, job: &LeverJob, seen: &[Pose3]) -> Vec<Pose3> {
        let after = self.predicted.lift.iter().skip(seen.len());
        let Some((seen, predicted)) =
            seen.last().zip(self.predicted.lift.get(seen.len().wrapping_sub(1)))
        else {
            return after.copied().collect();
        };
        let centre = job.scene.plates[job.lever.plate].weight().centre;
        let shift = seen.point(centre) - predicted.point(centre);
        let turn = seen.rotation * predicted.rotation.inverse();
        let moved = |pose: &Pose3| {
            let rotation = turn * pose.rotation;
            Pose3 { position: pose.point(centre) + shift - rotation * centre, rotation }
        };
        after.map(moved).collect()
    }
}

/// Predicts the lever-ups at these lengths along the outline, metres.
fn roll(
    model: &dyn LeverModel,
    job: &LeverJob,
    lengths: &[f64],
) -> Vec<(f64, Place, LeverTrajectory)> {
    let corners = job.scene.plates[job.lever.plate].corners();
    let at = |length: &f64| LeverJob {
        scene: job.scene.clone(),
        lever: LeverUp { place: place(corners, *length), ..job.lever },
    };
    let jobs: Vec<LeverJob> = lengths.iter().map(at).collect();
    let predicted = model.rollout(&jobs);
    let places = jobs.iter().map(|job| job.lever.place);
    lengths
        .iter()
        .zip(places)
        .zip(predicted)
        .map(|((at, place), predicted)| (*at, place, predicted))
        .collect()
}

/// Returns the root mean square distance of corners between poses of the frame, metres.
fn misfit(corners: &[Vector], seen: &[Pose3], predicted: &[Pose3]) -> f64 {
    let apart = |(seen, predicted): (&Pose3, &Pose3)| -> f64 {
        let corner = |at: &Vector| {
            let at = Vector3::new(at.x, at.y, 0.0);
            (seen.point(at) - predicted.point(at)).norm_squared()
        };
        corners.iter().map(corner).sum()
    };
    let frames = seen.len().min(predicted.len());
    let sum: f64 = seen.iter().zip(predicted).map(apart).sum();
    (sum / (frames * corners.len()).max(1) as f64).sqrt()
}

/// Returns the place at this length along the outline, from the first corner on, metres. The length
/// may exceed the outline.
fn place(corners: &[Vector], along: f64) -> Place {
    let mut left = along.rem_euclid(length(corners));
    for edge in 0..corners.len() {
        let side = (corners[(edge + 1) % corners.len()] - corners[edge]).norm();
        if left < side {
            return Place { edge, fraction: left / side };
        }
        left -= side;
    }
    Place { edge: 0, fraction: 0.0 }
}

/// Returns the length of the outline, metres.
fn length(corners: &[Vector]) -> f64 {
    let side = |k: usize| (corners[(k + 1) % corners.len()] - corners[k]).norm();
    (0..corners.len()).map(side).sum()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use pushplan::internals::effect::LeverPrior;
    use pushplan::internals::geometry::Pose;
    use pushplan::internals::scene::{Blade, LeverScene, Plate, Slab};

    /// Returns a plate without mirror symmetry, levered somewhere along its second edge.
    fn job() -> LeverJob {
        let corners = [[0.0, 0.0], [0.12, 0.0], [0.10, 0.09], [0.02, 0.12]];
        let corners = corners.map(|[x, y]| Vector::new(x, y)).to_vec();
        let plate = Plate {
            name: "plate".to_owned(),
            slabs: vec![Slab { corners, bottom: 0.0, height: 0.01 }],
            mass: 0.1,
            friction: 0.4,
            clearance: 0.006,
            pose: Pose::new(0.5, 0.1, 0.3),
            z: 0.006,
        }
        .balanced();
        let blade = Blade { length: 0.12, width: 0.006, thickness: 0.002, friction: 0.3 };
        let scene =
            LeverScene { plates: vec![plate], blocks: Vec::new(), table_friction: 0.6, blade };
        let lever = LeverUp {
            plate: 0,
            place: Place { edge: 1, fraction: 0.37 },
            depth: 0.015,
            pivot: 0.12,
            angle: 0.8,
            speed: LeverUp::SPEED,
            hold: LeverUp::HOLD,
            retreat: LeverUp::RETREAT,
        };
        LeverJob { scene: Arc::new(scene), lever }
    }

    #[test]
    fn a_point_drawn_by_the_model_is_found_from_one_frame() {
        let (job, model) = (job(), LeverPrior::default());
        let shown = model.rollout(std::slice::from_ref(&job)).remove(0);
        let elsewhere = LeverUp { place: Place { edge: 3, fraction: 0.5 }, ..job.lever };
        let asked = LeverJob { scene: job.scene.clone(), lever: elsewhere };
        let search = LeverSearch::new(&model, &asked);
        let found = search.infer(&shown.lift[..1]).expect("a frame");
        assert!(found.off(&job) < 0.01, "{} rad, {found:?}", found.off(&job));
        assert!(found.off(&asked) > 1.0);
        assert!(search.infer(&[]).is_none());
    }

    #[test]
    fn the_rest_goes_on_from_what_is_seen() {
        let (job, model) = (job(), LeverPrior::default());
        let predicted = model.rollout(std::slice::from_ref(&job)).remove(0);
        let place = job.lever.place;
        let point = LeverPoint { place, misfit: 0.0, predicted: predicted.clone() };
        // All observed poses are slightly rotated and displaced.
        let aside = Pose3::from_quaternion(Vector3::new(0.01, -0.02, 0.03), [0.1, 0.0, 0.05, 1.0]);
        let seen: Vec<Pose3> = predicted.lift[..4].iter().map(|pose| aside * *pose).collect();
        let rest = point.rest(&job, &seen);
        assert_eq!(rest.len(), predicted.lift.len() - 4);
        let turned = rest[0].angle_to(&(aside * predicted.lift[4]));
        assert!(turned < 1e-9, "{turned}");
        // An observation equal to the prediction changes nothing.
        let same = point.rest(&job, &predicted.lift[..4]);
        let off = (same[3].position - predicted.lift[7].position).norm();
        assert!(off < 1e-12, "{off} m");
    }
}
