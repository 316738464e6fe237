//! Lever-ups among the jobs of an effect model: predicted, or declined with a typed answer.

use std::sync::Arc;

use crate::effect::Trust;
use crate::geometry::Pose3;
use crate::outcome::{
    Frame, LEVER_FRAMES, LeverTrajectory, LeverWarning, Lift, Record, Trajectory, Warning,
};
use crate::scene::{LeverScene, ModelSpec, Scene, State};
use crate::task::{Job, LeverJob, LeverMotion, Motion, lever_frame};

/// Returns the lever-up of a job; `None` for a motion in the plane, for an object that lies elsewhere
/// than in the scene, and for a tool without a blade.
fn lever_job(scene: &Scene, job: &Job) -> Option<LeverJob> {
    let Motion::Lever(LeverMotion { lever, expected: None, .. }) = &job.motion else { return None };
    if job.start.space.is_some() || !job.motion.fits(scene) {
        return None;
    }
    let scene = Arc::new(LeverScene::with(scene, job.motion.tool()));
    Some(LeverJob { scene, lever: *lever })
}

/// Returns the trust of a model that takes the lever-ups that it `knows` and no other motion.
pub(super) fn trust(scene: &Scene, job: &Job, knows: impl Fn(&LeverJob) -> bool) -> Trust {
    match lever_job(scene, job).filter(knows) {
        Some(_) => Trust::Mine { error: None, warnings: Vec::new() },
        None => Trust::NotMine,
    }
}

/// Predicts jobs with a model of lever-ups; other motions are declined.
pub(super) fn rollout(
    by: &ModelSpec,
    (scene, jobs): (&Scene, &[Job]),
    record: Record,
    predict: impl Fn(&[LeverJob]) -> Vec<LeverTrajectory>,
) -> Vec<Trajectory> {
    let levers: Vec<Option<LeverJob>> = jobs.iter().map(|job| lever_job(scene, job)).collect();
    let known: Vec<LeverJob> = levers.iter().flatten().cloned().collect();
    let mut courses = predict(&known).into_iter();
    let each = |(job, lever): (&Job, &Option<LeverJob>)| {
        let predicted = lever.as_ref().and_then(|lever| Some((lever, courses.next()?)));
        match predicted {
            Some((lever, course)) => trajectory(by.clone(), lever, course, record),
            None => Trajectory::declined(by, job),
        }
    };
    jobs.iter().zip(&levers).map(each).collect()
}

/// Returns a predicted lever-up as a trajectory of the whole scene, in which no other object moves.
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
