//! Where a plate is levered, from how it begins to move (Tekden 2020, chapter 5).
//!
//! Nothing is learned: every place on the outline is tried in a model of lever-ups, ever more finely
//! about the best one, so that what is found lies on the outline.

use std::f64::consts::TAU;

use pushplan::internals::geometry::{Pose3, Vector, Vector3};
use pushplan::internals::{
    outcome::LeverTrajectory,
    task::{LeverJob, LeverUp, Place},
};
use pushplan_learn::lever_model::LeverModel;

/// Spacing of the first places, metres.
const SPACING: f64 = 0.01;

/// Places that each round tries on either side of the best one, between its neighbours.
const BESIDE: i32 = 3;

/// Rounds after the first: places are then 0.16 mm apart.
const ROUNDS: usize = 3;

/// Every place on an outline, to be told apart as frames come in.
pub struct LeverSearch<'a> {
    model: &'a dyn LeverModel,
    job: &'a LeverJob,
    /// Places at these lengths along the outline, metres, and what the model says of them.
    known: Vec<(f64, Place, LeverTrajectory)>,
    /// Their distance, metres.
    spacing: f64,
}

/// What the first frames say.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverPoint {
    /// Where the blade is.
    pub place: Place,
    /// Root mean square distance of the corners between what is seen and what the model says, metres.
    pub misfit: f64,
    /// What the model says of it, from the first frame on.
    pub told: LeverTrajectory,
}

impl<'a> LeverSearch<'a> {
    /// Of the plate of `job`, whose own place is not looked at; the rest of its motion is known.
    pub fn new(model: &'a dyn LeverModel, job: &'a LeverJob) -> Self {
        let outline = length(job.scene.plates[job.lever.plate].corners());
        let count = (outline / SPACING).ceil().max(1.0);
        let spacing = outline / count;
        let lengths: Vec<f64> = (0..count as usize).map(|k| k as f64 * spacing).collect();
        Self { model, job, known: roll(model, job, &lengths), spacing }
    }

    /// The place from which the model moves the plate most nearly as it is `seen`, frame by frame
    /// from the first. `None` if nothing is seen.
    pub fn infer(&self, seen: &[Pose3]) -> Option<LeverPoint> {
        if seen.is_empty() {
            return None;
        }
        let corners = self.job.scene.plates[self.job.lever.plate].corners();
        let nearest = |known: &[(f64, Place, LeverTrajectory)]| {
            let off = |told: &LeverTrajectory| misfit(corners, seen, &told.lift);
            let all = known.iter().map(|(at, place, told)| (*at, *place, off(told), told));
            let best = all.min_by(|a, b| a.2.total_cmp(&b.2));
            best.map(|(at, place, misfit, told)| {
                (at, LeverPoint { place, misfit, told: told.clone() })
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
    /// How far it is from the job's own place: the angle between both as seen from the centre of
    /// mass, radians, 0 to pi.
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

    /// The frames after those `seen`: what the model says from here on, moved and turned by as much
    /// as it is off in the last seen frame.
    pub fn rest(&self, job: &LeverJob, seen: &[Pose3]) -> Vec<Pose3> {
        let after = self.told.lift.iter().skip(seen.len());
        let Some((seen, told)) = seen.last().zip(self.told.lift.get(seen.len().wrapping_sub(1)))
        else {
            return after.copied().collect();
        };
        let centre = job.scene.plates[job.lever.plate].weight().centre;
        let shift = seen.point(centre) - told.point(centre);
        let turn = seen.rotation * told.rotation.inverse();
        let moved = |pose: &Pose3| {
            let rotation = turn * pose.rotation;
            Pose3 { position: pose.point(centre) + shift - rotation * centre, rotation }
        };
        after.map(moved).collect()
    }
}

/// What the model says of the places at these lengths along the outline, metres.
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
    let told = model.rollout(&jobs);
    let places = jobs.iter().map(|job| job.lever.place);
    lengths.iter().zip(places).zip(told).map(|((at, place), told)| (*at, place, told)).collect()
}

/// Root mean square distance of corners between poses of the frame, metres.
fn misfit(corners: &[Vector], seen: &[Pose3], told: &[Pose3]) -> f64 {
    let apart = |(seen, told): (&Pose3, &Pose3)| -> f64 {
        let corner = |at: &Vector| {
            let at = Vector3::new(at.x, at.y, 0.0);
            (seen.point(at) - told.point(at)).norm_squared()
        };
        corners.iter().map(corner).sum()
    };
    let frames = seen.len().min(told.len());
    let sum: f64 = seen.iter().zip(told).map(apart).sum();
    (sum / (frames * corners.len()).max(1) as f64).sqrt()
}

/// The place at this length along the outline, from the first corner on, around as often as needed,
/// metres.
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

/// Length of the outline, metres.
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

    /// A plate that is no mirror image of itself, levered somewhere along its second edge.
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
    fn what_the_model_itself_shows_is_found_at_its_place_by_one_frame() {
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
        let told = model.rollout(std::slice::from_ref(&job)).remove(0);
        let place = job.lever.place;
        let point = LeverPoint { place, misfit: 0.0, told: told.clone() };
        // Everything seen a little turned and aside.
        let aside = Pose3::from_quaternion(Vector3::new(0.01, -0.02, 0.03), [0.1, 0.0, 0.05, 1.0]);
        let seen: Vec<Pose3> = told.lift[..4].iter().map(|pose| aside * *pose).collect();
        let rest = point.rest(&job, &seen);
        assert_eq!(rest.len(), told.lift.len() - 4);
        let turned = rest[0].angle_to(&(aside * told.lift[4]));
        assert!(turned < 1e-9, "{turned}");
        // Where what is seen is what is told, nothing changes.
        let same = point.rest(&job, &told.lift[..4]);
        let off = (same[3].position - told.lift[7].position).norm();
        assert!(off < 1e-12, "{off} m");
    }
}
