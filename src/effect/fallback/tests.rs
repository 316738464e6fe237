//! Tests of `fallback`.

use crate::effect::{CrowdLimit, Prior};
use crate::geometry::{Pose, Vector};
use crate::{
    scene::{Object, Part, Quantity, Tool},
    task::{Push, ToolMotion},
};

use super::*;

/// A row of three cans, and one far from them; a push into the row, and a push of the single can.
fn row() -> (Scene, [Job; 2]) {
    let can = |x: f64, y: f64| Object {
        mass: 0.5,
        friction: 0.4,
        pose: Pose::new(x, y, 0.0),
        ..Object::cylinder(format!("{x} {y}"), 0.03, 0.1)
    };
    let objects = vec![can(0.1, 0.0), can(0.165, 0.0), can(0.23, 0.0), can(0.1, 0.5)];
    let scene = Scene { table_friction: 0.4, objects, ..Scene::default() };
    let bar = Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::default());
    let tool = Arc::new(Tool::new("bar", [bar]).expect("one piece").friction(0.3));
    let job = |y: f64| {
        let push = Push { start: Vector::new(0.0, y), direction: 0.0, length: 0.15, speed: 0.1 };
        Job::stated(&scene, ToolMotion::pushes(tool.clone(), 0.002, 0.0, &[push], true))
    };
    let jobs = [job(0.0), job(0.5)];
    (scene, jobs)
}

#[test]
fn pushes_into_a_crowd_are_simulated_and_those_beside_it_are_not() {
    let (scene, jobs) = row();
    let (prior, planar) = (Prior::default(), Simulator::planar());
    let roll = |model: &dyn EffectModel| model.rollout(&scene, &jobs, Record::Outcome);
    let [own, engine] = [roll(&prior), roll(&Simulated::new(planar))];
    assert!(own != engine);
    let to = |most: u16| {
        let few = Arc::new(CrowdLimit::new(prior.clone(), most));
        Fallback::new(few).or(Arc::new(Simulated::new(planar)))
    };
    let model = to(2);
    assert_eq!(model.spec().to_string(), "prior,up-to=2|planar");
    let mixed = roll(&model);
    assert_eq!([&mixed[0], &mixed[1]], [&engine[0], &own[1]]);
    assert_eq!(mixed.iter().map(|one| one.by.to_string()).collect::<Vec<_>>(), ["planar", "prior"]);
    // The 2-D engine as a substitute is exact; the analytic model is not.
    let errors = [0, 1].map(|k| model.trust(&scene, &jobs[k]).error().map(|error| error.p95));
    assert!(errors[0] == Some(0.0) && errors[1].is_some_and(|p95| p95 > 0.0), "{errors:?}");
    assert_eq!(roll(&to(3)), own);
    assert_eq!(roll(&to(0)), engine);
}

#[test]
fn routing_asks_for_the_start_of_the_job_and_not_of_the_scene() {
    let (scene, jobs) = row();
    let model = Fallback::new(Arc::new(CrowdLimit::new(Prior::default(), 2)))
        .or(Arc::new(Simulated::new(Simulator::planar())));
    // Without the row the push reaches only one can.
    let mut job = jobs[0].clone();
    for k in [1, 2] {
        job.start.poses[k].position.x += 5.0;
    }
    assert_eq!(model.trust(&scene, &jobs[0]).error(), Some(Quantiles { median: 0.0, p95: 0.0 }));
    assert!(model.trust(&scene, &job).error().is_some_and(|error| error.p95 > 0.0));
    let by = model.rollout(&scene, &[job], Record::Outcome)[0].by.to_string();
    assert_eq!(by, "prior");
}

#[test]
fn jobs_of_no_model_are_reported_simulated_or_refused() {
    let (scene, jobs) = row();
    let alone = |out_of_range| {
        let model = CrowdLimit::new(Prior::default(), 2);
        assert_eq!(model.trust(&scene, &jobs[0]), Trust::NotMine);
        Fallback::new(Arc::new(model)).out_of_range(out_of_range)
    };
    let declined = |warning: &Warning| matches!(warning, Warning::Declined { .. });
    assert!(alone(OutOfRange::Warn).trust(&scene, &jobs[0]).warnings().iter().all(declined));
    let roll =
        |out_of_range| alone(out_of_range).rollout(&scene, &jobs[..1], Record::Outcome).remove(0);
    assert_eq!(roll(OutOfRange::Warn).by.to_string(), "prior");
    assert_eq!(roll(OutOfRange::Simulate).by.to_string(), "planar");
    assert_eq!(roll(OutOfRange::Refuse).outcome(), &jobs[0].start);
}

#[test]
fn trust_is_asked_under_the_physics_of_the_job() {
    let (scene, jobs) = row();
    let prior = Prior::default();
    assert_eq!(prior.trust(&scene, &jobs[1]).warnings(), []);
    let mut heavy = jobs[1].clone();
    Arc::make_mut(&mut heavy.physics).masses[3] = 20.0;
    let found = prior.trust(&scene, &heavy).warnings();
    let quantity = |warning: &Warning| match warning {
        Warning::OutsideRange { quantity, .. } => Some(*quantity),
        _ => None,
    };
    assert_eq!(found.iter().map(quantity).collect::<Vec<_>>(), [Some(Quantity::Mass)]);
}
