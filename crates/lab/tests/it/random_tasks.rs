//! The suite of random tasks: solvable as made, of the kinds they claim to be, the same in a file.

use std::collections::BTreeSet;

use pushplan::asset::ToolLibrary;
use pushplan::geometry::{Footprint, swept_clearance, wrap_angle};
use pushplan::scene::{Engine, Robot, Situation, Task};
use pushplan::store::Shard;
use pushplan::verify::{Verifier, VerifySettings};
use pushplan_lab::bench::{RandomSuite, SuiteTask, TaskKind};

/// Tasks of each kind.
const EACH: usize = 4;

#[test]
fn the_plan_that_made_a_task_solves_it_and_the_task_is_of_its_kind() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let suite = RandomSuite::new(&library, 7, &[]);
    let verifier = Verifier::new(VerifySettings { disturbed: 0, seed: 0 });
    let mut counts = [0; TaskKind::ALL.len()];
    for index in 0..EACH * counts.len() {
        let made = suite.task(index).expect("a task");
        let task = &made.task;
        let (plan, tool) = made.made.as_ref().expect("the plan that made it");
        let verdict = verifier.nominal(
            task,
            &Situation::stated(&task.scene),
            std::slice::from_ref(tool),
            plan,
        );
        assert!(verdict.passed, "{}: its own plan does not solve it", task.name);
        let planar = &verdict.evidence[0];
        assert_eq!(planar.engine, Engine::Planar);
        // The goal is where the planar engine ends, rounded to tenths of a millimetre.
        assert!(planar.outcome.error < 1e-4, "{}: {}", task.name, planar.outcome.error);
        assert!(plan.pushes().len() <= task.pushes.max_count);
        assert!(plan.pushes().iter().all(|push| task.robot.reaches(push.end())));
        is_of_its_kind(&made);
        counts[made.kind as usize] += 1;
    }
    assert_eq!(counts, [EACH; TaskKind::ALL.len()], "the kinds do not take turns evenly");
}

fn is_of_its_kind(made: &SuiteTask) {
    let SuiteTask { kind, task, .. } = made;
    let (goal, object) = (&task.goal, &task.scene.objects[task.goal.object]);
    let start = object.pose.position;
    let way = goal.position - start;
    assert!(way.norm() > 2.0 * goal.tolerance, "{}: doing nothing nearly does", task.name);
    let outwards = way.dot(&start.normalize()) / way.norm();
    assert_eq!(goal.heading.is_some(), *kind == TaskKind::Heading, "{}", task.name);
    let walls = task.scene.obstacles.iter().filter(|one| one.name != Robot::BASE);
    assert_eq!(walls.count(), usize::from(*kind == TaskKind::Obstacle));
    assert_eq!(task.scene.joints.len(), usize::from(*kind == TaskKind::Pair));
    let fits = match kind {
        TaskKind::Reach => {
            start.norm() > task.robot.reach_max && goal.position.norm() > start.norm() - 1e-3
        }
        TaskKind::Pull => outwards < -0.86,
        TaskKind::Sweep => outwards.abs() < 0.51 && way.norm() > 0.119,
        TaskKind::Obstacle => {
            let wall = &task.scene.obstacles[0];
            let radius = object.shape.footprint().inner_radius();
            let mut end = object.pose;
            end.position = goal.position;
            let still = (&wall.shape().footprint(), &wall.pose);
            swept_clearance(&Footprint::Disc { radius }, &object.pose, &end, still, 0.01) <= 0.0
        }
        TaskKind::Heading => {
            let (heading, _) = goal.heading.expect("a heading");
            wrap_angle(heading - object.pose.heading).abs() > 14.9_f64.to_radians()
                && !object.shape.is_cylinder()
        }
        TaskKind::Pair => task.scene.objects.len() == 2,
        TaskKind::Gap => false,
        TaskKind::Cluster => task.scene.objects.len() == 4,
    };
    assert!(fits, "{} is no task of its kind: {task:?}", task.name);
}

#[test]
fn a_saved_task_is_the_same_task_to_the_bit() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    for kind in TaskKind::ALL {
        let suite = RandomSuite::new(&library, 3, &[kind]);
        for index in 0..3 {
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
    // The order turns from round to round: pull, sweep; sweep, pull.
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
    assert_eq!(error, "no task of the kind `pull` could be made with these tools");
}
