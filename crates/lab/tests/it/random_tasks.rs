//! The suite of random tasks: solvable by construction, of the stated kinds, and unchanged by a
//! file.

use std::collections::{BTreeMap, BTreeSet};

use pushplan::asset::ToolLibrary;
use pushplan::geometry::{Footprint, Pose, swept_clearance, wrap_angle};
use pushplan::task::Demand;
use pushplan::verify::{Verifier, VerifySettings};
use pushplan::{
    scene::{Engine, Object, Situation},
    task::Task,
};
use pushplan_bench::store::Shard;
use pushplan_lab::bench::{RandomSuite, SuiteTask, TaskKind};

#[test]
fn the_plan_that_made_a_task_solves_it_and_the_task_is_of_its_kind() {
    are_solved_by_their_plans(&TaskKind::ALL, 4, is_of_its_kind);
}

#[test]
fn the_plan_that_made_an_everyday_task_solves_it_and_the_task_is_of_its_kind() {
    are_solved_by_their_plans(&TaskKind::EVERYDAY, 2, is_everyday);
}

/// Draws `each` tasks of every kind and executes the plans behind them.
fn are_solved_by_their_plans(kinds: &[TaskKind], each: usize, is_of_its_kind: fn(&SuiteTask)) {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let suite = RandomSuite::new(&library, 7, kinds);
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let mut counts: BTreeMap<TaskKind, usize> = BTreeMap::new();
    for index in 0..each * kinds.len() {
        let made = suite.task(index).expect("a task");
        let task = &made.task;
        let (plan, tools) = made.made.as_ref().expect("the plan that made it");
        let verdict = verifier.nominal(task, &Situation::stated(&task.scene), tools, plan);
        assert!(verdict.passed, "{}: its own plan does not solve it", task.name);
        let planar = &verdict.evidence[0];
        assert_eq!(planar.engine, Engine::Planar);
        // The goal is the final pose in the 2-D engine, rounded to tenths of a millimetre.
        assert!(planar.outcome.error() < 1e-4, "{}: {}", task.name, planar.outcome.error());
        assert!(plan.pushes().len() <= task.pushes.max_count);
        assert!(plan.pushes().iter().all(|push| task.robot.reaches(push.end())));
        is_of_its_kind(&made);
        *counts.entry(made.kind).or_default() += 1;
    }
    assert!(counts.len() == kinds.len() && counts.values().all(|count| *count == each));
}

fn is_everyday(made: &SuiteTask) {
    let SuiteTask { kind, task, made } = made;
    let (scene, goal) = (&task.scene, &task.goals[0]);
    let things = scene.things().count();
    let plan = &made.as_ref().expect("the plan that made it").0;
    let sliding = scene.joints.iter().filter(|joint| !scene.is_seam(joint)).count();
    let aside = |count: usize| {
        let own = &scene.objects[goal.object];
        let thin = Footprint::Disc { radius: own.shape.footprint().inner_radius() };
        let end = Pose { position: goal.place(&scene.start()), ..own.pose };
        let blocks = |one: &Object| {
            let still = (&one.shape.footprint(), &one.pose);
            swept_clearance(&thin, &own.pose, &end, still, 0.01) <= 0.01
        };
        things == count + 1 && scene.objects[1..].iter().all(blocks)
    };
    let fits = match kind {
        TaskKind::Door => scene.mounts.len() == 1 && goal.heading().is_some() && !goal.has_place(),
        TaskKind::Drawer => scene.mounts.len() + sliding == 1 && goal.has_place(),
        TaskKind::Compound => scene.is_compound(0) && goal.heading().is_some(),
        TaskKind::Turn => goal.heading().is_some() && !goal.has_place(),
        TaskKind::Region => {
            matches!(goal.demands[..], [Demand::Area(_)]) && !goal.reached(&scene.start())
        }
        TaskKind::Relative => goal.relative() == Some(1) && things == 2,
        TaskKind::TwoGoals => task.goals.len() == 2,
        TaskKind::ThreeGoals => task.goals.len() == 3,
        TaskKind::TwoTools => plan.tools().len() == 2,
        TaskKind::OneAside => aside(1),
        TaskKind::TwoAside => aside(2),
        TaskKind::ThreeAside => aside(3),
        _ => false,
    };
    assert!(fits, "{} is no task of its kind: {task:?}", task.name);
}

fn is_of_its_kind(made: &SuiteTask) {
    let SuiteTask { kind, task, .. } = made;
    let (goal, object) = (&task.goals[0], &task.scene.objects[task.goals[0].object]);
    let start = object.pose.position;
    let way = goal.position().unwrap() - start;
    assert!(way.norm() > 2.0 * goal.tolerance(), "{}: doing nothing nearly does", task.name);
    let outwards = way.dot(&start.normalize()) / way.norm();
    assert_eq!(goal.heading().is_some(), *kind == TaskKind::Heading, "{}", task.name);
    let walls = task.scene.obstacles.iter().filter(|one| !one.is_robot());
    assert_eq!(walls.count(), usize::from(*kind == TaskKind::Obstacle));
    assert_eq!(task.scene.joints.len(), usize::from(*kind == TaskKind::Pair));
    let fits = match kind {
        TaskKind::Reach => {
            start.norm() > task.robot.reach_max
                && goal.position().unwrap().norm() > start.norm() - 1e-3
        }
        TaskKind::Pull => outwards < -0.86,
        TaskKind::Sweep => outwards.abs() < 0.51 && way.norm() > 0.119,
        TaskKind::Obstacle => {
            let wall = &task.scene.obstacles[0];
            let radius = object.shape.footprint().inner_radius();
            let mut end = object.pose;
            end.position = goal.position().unwrap();
            let still = (&wall.shape().footprint(), &wall.pose);
            swept_clearance(&Footprint::Disc { radius }, &object.pose, &end, still, 0.01) <= 0.0
        }
        TaskKind::Heading => {
            let heading = goal.heading().expect("a heading").heading;
            wrap_angle(heading - object.pose.heading).abs() > 14.9_f64.to_radians()
                && !object.shape.is_cylinder()
        }
        TaskKind::Pair => task.scene.objects.len() == 2,
        _ => false,
    };
    assert!(fits, "{} is no task of its kind: {task:?}", task.name);
}

#[test]
fn a_saved_task_is_the_same_task_to_the_bit() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    for kind in TaskKind::ALL.into_iter().chain(TaskKind::EVERYDAY) {
        let suite = RandomSuite::new(&library, 3, &[kind]);
        for index in 0..if TaskKind::EVERYDAY.contains(&kind) { 1 } else { 3 } {
            let task = suite.task(index).expect("a task").task;
            let text = task.to_yaml().expect("a file");
            let read = Task::parse(&text, "saved.yaml")
                .unwrap_or_else(|faults| panic!("{faults}\n{text}"));
            assert_eq!(read, task, "{text}");
        }
    }
}

#[test]
fn a_kind_alone_gives_the_tasks_that_it_gives_among_all() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let kinds = [TaskKind::Pull, TaskKind::Sweep];
    let both = RandomSuite::new(&library, 11, &kinds);
    let alone = RandomSuite::new(&library, 11, &kinds[..1]);
    let task = |suite: &RandomSuite, index| suite.task(index).expect("a task").task;
    // The order rotates from round to round: pull, sweep; sweep, pull.
    for (index, among) in [(0, 0), (1, 3)] {
        assert_eq!(task(&alone, index), task(&both, among));
    }
    assert_ne!(task(&alone, 0).scene, task(&alone, 1).scene);
    assert_ne!(task(&RandomSuite::new(&library, 12, &kinds[..1]), 0).scene, task(&alone, 0).scene);
}

#[test]
fn every_shard_measures_every_kind() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let suite = RandomSuite::new(&library, 7, &[TaskKind::Sweep, TaskKind::Reach]);
    let shard = Shard::new(2, 2).expect("a shard");
    let kinds: BTreeSet<TaskKind> =
        shard.indices(4).map(|index| suite.task(index).expect("a task").kind).collect();
    assert_eq!(kinds.len(), 2);
}

#[test]
fn tools_that_make_no_task_are_an_answer_and_no_endless_search() {
    let suite = RandomSuite::new(&ToolLibrary::default(), 7, &[TaskKind::Pull]);
    let error = suite.task(0).expect_err("no tools").to_string();
    assert_eq!(error, "no task of the kind `pull` can be generated with these tools");
}
