//! Recordings cut from an ongoing push: bodies move in their first frame, and the file states their
//! velocities.

use pushplan::effect::{EffectModel, EffectModels, Job, Network, Prior};
use pushplan::geometry::{Pose, Vector};
use pushplan::progress::NoProgress;
use pushplan::recording::Recording;
use pushplan::{
    outcome::Record,
    scene::{JointKind, Object, Scene, Span, State, Velocity},
    task::{Push, Stroke, ToolMotion},
};
use pushplan_act::belief::{Belief, BeliefSettings};
use pushplan_act::fit::{FitSettings, fit};
use pushplan_act::judge::{Comparison, Trial};

use crate::believing::EXACT;
use crate::fixtures::{hand, models};

/// Returns a box that is pushed fast and off-centre, and a hinged pair of cans that it meets, on a
/// slippery table.
fn pushed() -> (Scene, ToolMotion) {
    let can = |name: &str, y| Object::cylinder(name, 0.04, 0.08).friction(0.15).at(0.36, y, 0.0);
    let boxed = Object::cuboid("box", [0.08, 0.12, 0.06]).friction(0.15).at(0.15, 0.02, 0.2);
    let hinge = JointKind::Revolute { at: Vector::new(0.36, 0.05), limits: None };
    let scene = Scene::new([boxed, can("a", 0.0), can("b", 0.1)]).on_table(0.15);
    let push = Push { start: Vector::new(0.02, 0.0), direction: 0.0, length: 0.22, speed: 0.5 };
    let motion = ToolMotion::pushes(hand(), 0.002, 0.0, &[push], true);
    (scene.with_joint([1, 2], hinge), motion)
}

/// Returns the recording of a motion by a model, from frame `first` on.
fn cut(model: &dyn EffectModel, (scene, motion): &(Scene, ToolMotion), first: usize) -> Recording {
    let job = Job::stated(scene, motion.clone());
    let frames = model.rollout(scene, &[job], Record::Frames).remove(0).frames;
    let mut recording = Recording::of_frames("cut", scene, motion, &frames);
    recording.frames.drain(..first);
    let begin = recording.frames[0].time;
    recording.frames.iter_mut().for_each(|frame| frame.time -= begin);
    let State { poses, velocities, .. } = &frames[first].state;
    for joint in &mut recording.scene.joints {
        let JointKind::Revolute { at, .. } = &mut joint.kind else { panic!("{joint:?}") };
        let a = joint.between[0];
        *at = poses[a].point(scene.objects[a].pose.local_point(*at));
    }
    for (object, pose) in recording.scene.objects.iter_mut().zip(poses) {
        object.pose = *pose;
    }
    recording.velocities.clone_from(velocities);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("cut.recording.json");
    recording.write(&path).expect("a writable folder");
    Recording::load(&path).expect("the written file is readable")
}

/// Returns the recording with zero velocities in the first frame.
fn rested(recording: &Recording) -> Recording {
    let velocities = vec![Velocity::default(); recording.velocities.len()];
    Recording { velocities, ..recording.clone() }
}

/// Returns the largest final position error of any object, metres.
fn off(model: &dyn EffectModel, recording: &Recording) -> f64 {
    let trial = Trial::of_recording(recording);
    let ends = Comparison::of(model, &trial).end();
    ends.iter().map(|end| end.position).fold(0.0, f64::max)
}

#[test]
fn a_push_that_is_cut_ends_where_the_whole_one_does() {
    let pushed = pushed();
    let network = Network::new(EffectModels::weights().expect("the shipped weights"));
    let mut all: Vec<(&str, Box<dyn EffectModel>)> = models().into_iter().collect();
    all.push(("network", Box::new(network)));
    for (name, model) in &all {
        // During the push, and three times after it. In 3-D engines bodies tilt during a push,
        // which a recording does not contain.
        let pushing = matches!(*name, "prior" | "planar" | "network").then_some(10);
        for first in [20, 22, 24].into_iter().chain(pushing) {
            let recording = cut(&**model, &pushed, first);
            let (moving, resting) = (off(&**model, &recording), off(&**model, &rested(&recording)));
            // The network's corrections are not fed back into contacts, so that the rest of a push
            // from a corrected pose is another one.
            let most = if *name == "network" { 0.4 * resting } else { 5e-4 };
            assert!(moving < most && resting > 2e-3, "{name} {first}: {moving} {resting}");
        }
    }
}

#[test]
fn a_fit_begins_with_the_velocities() {
    let pushed = pushed();
    let [_, (_, planar), ..] = models();
    let moving = cut(&*planar, &pushed, 20);
    let resting = rested(&moving);
    let settings = FitSettings { values: 5, ..FitSettings::default() };
    let [with, without] = [&moving, &resting].map(|recording| {
        let trials = [Trial::of_recording(recording)];
        fit(&*planar, &trials, &settings, &NoProgress).expect("something moves").best.mean
    });
    assert!(with < 2e-3 && without > 1e-2, "{with} {without}");
}

#[test]
fn a_belief_begins_with_the_velocities() {
    // A can slides into a heavier one with nothing else near; a belief that starts at rest would
    // see no contact.
    let can = |name: &str, x| Object::cylinder(name, 0.04, 0.08).friction(0.15).at(x, 0.0, 0.0);
    let scene = Scene::new([can("a", 0.3).mass(0.3), can("b", 0.42).mass(1.2)]).on_table(0.15);
    let stand =
        Stroke { from: Pose::default(), to: Pose::default(), duration: 0.05, settle: false };
    let motion = ToolMotion { tool: hand(), lift: 0.002, strokes: vec![stand; 12] };
    let mut job = Job::stated(&scene, motion.clone());
    job.start.velocities[0].linear.x = 0.7;
    let [_, (_, planar), ..] = models();
    let frames = planar.rollout(&scene, &[job], Record::Frames).remove(0).frames;
    let moving = Recording::of_frames("slides", &scene, &motion, &frames);
    assert_eq!(moving.velocities[0].linear.x, 0.7);
    let ranges = [Span::new(0.2, 0.4), Span::new(0.9, 1.5)];
    let [with, without] = [&moving, &rested(&moving)].map(|recording| {
        let mut belief = Belief::new(&recording.scene, hand(), 0.002, BeliefSettings::new(EXACT))
            .moving(&recording.velocities)
            .with_mass_ranges(&ranges);
        for observation in recording.observations() {
            belief.update(&Prior::default(), observation);
        }
        belief.finish(&Prior::default());
        belief.mass_shares().expect("asked for").objects
    });
    eprintln!("{with:?} {without:?}");
    let heavier = with[1].as_ref().expect("it was touched");
    assert!(heavier[1] > 0.8, "{with:?}");
    assert_ne!(with, without);
}
