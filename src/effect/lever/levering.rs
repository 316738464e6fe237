//! A model of pushes and one of lever-ups as one effect model: each gets the motions that it knows.

use std::sync::Arc;

use crate::effect::{EffectModel, Trust};
use crate::geometry::Pose3;
use crate::{
    outcome::{
        Frame, LEVER_FRAMES, LeverTrajectory, LeverWarning, Lift, Record, Trajectory, Warning,
    },
    scene::{LeverScene, ModelSpec, Scene, State},
    task::{Job, LeverJob, LeverMotion, Motion, lever_frame},
};

use super::{LeverModel, LeverTrust};

/// A model of pushes that takes lever-ups as well.
#[derive(Clone)]
pub struct Levering {
    pushes: Arc<dyn EffectModel>,
    levers: Arc<dyn LeverModel>,
}

/// A lever-up as models of lever-ups take it: none of a motion in the plane, of an object that lies
/// elsewhere than in the scene, or with a tool without a blade.
fn lever_job(scene: &Scene, job: &Job) -> Option<LeverJob> {
    let Motion::Lever(LeverMotion { lever, expected: None, .. }) = &job.motion else { return None };
    if job.start.space.is_some() || !job.motion.fits(scene) {
        return None;
    }
    let scene = Arc::new(LeverScene::with(scene, job.motion.tool()));
    Some(LeverJob { scene, lever: *lever })
}

impl Levering {
    /// `pushes` for what stays in the plane, `levers` for lever-ups.
    pub fn new(pushes: Arc<dyn EffectModel>, levers: Arc<dyn LeverModel>) -> Self {
        Self { pushes, levers }
    }

    /// The job, if it is one for the model of lever-ups.
    fn own(&self, scene: &Scene, job: &Job) -> Option<LeverJob> {
        let job = lever_job(scene, job)?;
        (self.levers.trust(&job) != LeverTrust::NotMine).then_some(job)
    }
}

impl EffectModel for Levering {
    fn spec(&self) -> &ModelSpec {
        self.pushes.spec()
    }

    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        match (job.in_space(), self.own(scene, job)) {
            (false, _) => self.pushes.trust(scene, job),
            (true, Some(_)) => Trust::Mine { error: None, warnings: Vec::new() },
            (true, None) => Trust::NotMine,
        }
    }

    fn takes(&self, scene: &Scene, job: &Job) -> bool {
        match job.in_space() {
            false => self.pushes.takes(scene, job),
            true => self.own(scene, job).is_some(),
        }
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        if jobs.iter().all(|job| !job.in_space()) {
            return self.pushes.rollout(scene, jobs, record);
        }
        let levers: Vec<Option<LeverJob>> = jobs.iter().map(|job| lever_job(scene, job)).collect();
        let told: Vec<LeverJob> = levers.iter().flatten().cloned().collect();
        let mut rolled = self.levers.rollout(&told).into_iter();
        let pushed: Vec<Job> = jobs.iter().filter(|job| !job.in_space()).cloned().collect();
        let mut pushed = self.pushes.rollout(scene, &pushed, record).into_iter();
        let each = |(job, lever): (&Job, Option<LeverJob>)| {
            let found = match (&lever, job.in_space()) {
                (Some(lever), _) => rolled.next().map(|course| self.told(lever, course, record)),
                (None, false) => pushed.next(),
                (None, true) => None,
            };
            found.unwrap_or_else(|| declined(self.spec(), job))
        };
        jobs.iter().zip(levers).map(each).collect()
    }
}

impl Levering {
    /// What a model of lever-ups says, as a trajectory.
    fn told(&self, job: &LeverJob, course: LeverTrajectory, record: Record) -> Trajectory {
        trajectory(self.levers.spec(), job, course, record)
    }
}

/// No prediction, as nobody knows such motions.
fn declined(by: &ModelSpec, job: &Job) -> Trajectory {
    let mut declined = Trajectory::standing(by.clone(), Default::default(), job.start.clone());
    declined.warnings.push(Warning::Declined { model: by.clone() });
    declined
}

/// What `by` says of the levered object, as a trajectory of the whole scene, in which nothing else
/// moves.
fn trajectory(
    by: ModelSpec,
    job: &LeverJob,
    course: LeverTrajectory,
    record: Record,
) -> Trajectory {
    let LeverJob { scene, lever } = job;
    let start: Vec<Pose3> = scene.plates.iter().map(|plate| plate.start()).collect();
    let state = |pose: Pose3| {
        let mut poses = start.clone();
        poses[lever.plate] = pose;
        State::in_space(poses)
    };
    let frame = |time: f64, pose: Pose3| {
        let blade = lever.blade(scene, time);
        Frame { time, stroke: 0, tool: blade.from_above(), state: state(pose), blade: Some(blade) }
    };
    let plate = &scene.plates[lever.plate];
    let at = lever_frame(plate.corners(), lever.place).position;
    let end = course.lift.last().copied().unwrap_or(course.rest);
    let lift = Lift {
        object: lever.plate,
        raised: end.point([at.x, at.y, 0.0].into()).z - plate.z,
        held: course.held.last().copied().unwrap_or(false),
        tilt: end.tilt(),
    };
    let mut found = Trajectory { lifts: vec![lift], ..Trajectory::new(by) };
    if record == Record::Frames {
        let share = |k: usize| lever.turn_time() * k as f64 / LEVER_FRAMES as f64;
        found.frames.push(frame(0.0, start[lever.plate]));
        let turn = course.lift.iter().enumerate().map(|(k, pose)| frame(share(k + 1), *pose));
        found.frames.extend(turn);
    }
    found.frames.push(frame(lever.duration(), course.rest));
    found.warnings.extend(course.warnings.iter().map(|warning| match warning {
        LeverWarning::Slipped => Warning::Slipped { object: plate.name.clone() },
        LeverWarning::Moving => Warning::NotAtRest { waited: 0.0 },
        LeverWarning::Jammed => Warning::Strained,
    }));
    found
}
