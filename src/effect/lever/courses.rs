//! Lever-ups among the jobs of an effect model: predicted, or declined with a typed answer.

use std::sync::Arc;

use crate::effect::Trust;
use crate::geometry::Pose3;
use crate::outcome::{
    Frame, LEVER_FRAMES, LeverTrajectory, LeverWarning, Lift, ObjectRules, Record, Trajectory,
    Warning,
};
use crate::scene::{Joint, LeverScene, ModelSpec, PairFriction, Plate, Scene, Support, Surface};
use crate::task::{Job, LeverJob, LeverMotion, LeverUp, Motion, lever_frame};

/// Radius in which neighbours of a levered object matter, relative to the distance of its farthest
/// corner: the distance that an object reaches if it turns over its far corner.
const TURNED: f64 = 3.0;

/// Returns the lever-up of a job, with its object first, followed by the objects that it may come
/// near. Returns `None` for a motion in the plane, for an object that is not where the scene states
/// it, and for a tool without a blade.
fn lever_job(scene: &Scene, job: &Job) -> Option<LeverJob> {
    let Motion::Lever(LeverMotion { lever, expected: None, .. }) = &job.motion else { return None };
    if job.start.space.is_some() || !job.motion.fits(scene) || !is_plain(scene, lever.plate, job) {
        return None;
    }
    let mut around = LeverScene::with(scene, job.motion.tool());
    let own = around.plates.swap_remove(lever.plate);
    let far = own.corners().iter().map(|corner| corner.norm()).fold(0.0, f64::max);
    let is_near = |other: &Plate| {
        let middle = (other.pose.position - own.pose.position).norm();
        let corners = other.slabs.iter().flat_map(|slab| &slab.corners);
        middle - corners.map(|corner| corner.norm()).fold(0.0, f64::max) < TURNED * far
    };
    around.plates.retain(is_near);
    around.plates.insert(0, own);
    Some(LeverJob { scene: Arc::new(around), lever: LeverUp { plate: 0, ..*lever } })
}

/// Returns `true` if an object is free, has one density and friction, rests on its corners or its
/// underside, and has no pair-specific friction.
fn is_plain(scene: &Scene, object: usize, job: &Job) -> bool {
    let solids: Vec<usize> = scene.parts_of(object).chain([object]).collect();
    let even = |k: &usize| {
        let own = &scene.objects[*k];
        own.support == Support::Even && own.friction == scene.objects[object].friction
    };
    let rubs = |pair: &PairFriction| {
        solids.contains(&pair.object)
            || matches!(pair.with, Surface::Object(other) if solids.contains(&other))
    };
    let joined =
        |joint: &Joint| !scene.is_seam(joint) && joint.between.iter().any(|k| solids.contains(k));
    let plate = Plate::of(scene, object);
    let own = std::iter::once(object).chain(scene.parts_of(object));
    let masses: Vec<f64> = own.map(|k| job.physics.masses[k]).collect();
    solids.iter().all(even)
        && scene.mount(object).is_none()
        && !job.physics.pairs.iter().any(rubs)
        && !job.physics.joints.iter().any(joined)
        && plate.weight_of(&masses) == plate.weight()
}

/// Returns the trust in a model that accepts the lever-ups that it `knows` and no other motion.
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
        match (predicted, &job.motion) {
            (Some((own, course)), Motion::Lever(motion)) => {
                trajectory(by.clone(), (scene, &motion.lever, own), course, record)
            }
            _ => Trajectory::declined(by, job),
        }
    };
    jobs.iter().zip(&levers).map(each).collect()
}

/// Converts a predicted lever-up into a trajectory of the whole scene, in which no other object
/// moves.
fn trajectory(
    by: ModelSpec,
    (scene, lever, job): (&Scene, &LeverUp, &LeverJob),
    course: LeverTrajectory,
    record: Record,
) -> Trajectory {
    let start: Vec<Pose3> = scene.plates().map(|plate| plate.start()).collect();
    let state = |pose: Pose3| {
        let mut poses = start.clone();
        poses[lever.plate] = pose;
        scene.resting_in_space(poses)
    };
    let frame = |time: f64, pose: Pose3| {
        let blade = job.lever.blade(&job.scene, time);
        Frame { time, stroke: 0, tool: blade.from_above(), state: state(pose), blade: Some(blade) }
    };
    let plate = &job.scene.plates[job.lever.plate];
    let at = lever_frame(plate.corners(), lever.place).position;
    let end = course.lift.last().copied().unwrap_or(course.rest);
    let lift = Lift {
        object: lever.plate,
        raised: Lift::height(&start[lever.plate], &end, at),
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
    let states = found.frames.iter().map(|frame| &frame.state);
    found.warnings.extend(ObjectRules::of(scene).first_broken(states));
    found
}
