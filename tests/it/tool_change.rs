//! Plans that change the tool or the grip between pushes.

use std::sync::Arc;

use pushplan::verify::{Verifier, VerifySettings};
use pushplan::{
    Effort, Job, Object, Part, Plan, PlanStatus, Planner, Pose, Push, PushForm, Scene, Simulator,
    Situation, Solution, Task, Tool, ToolLibrary, ToolMotion, Vector,
};
use pushplan::{
    outcome::{Record, Warning, in_turn},
    scene::Engine,
};

const TWO: &str = include_str!("../../tasks/two-tools.yaml");

/// Stick that fits between the rails only along them, and pulls the can back when held across.
const TURNED: &str = "
scene:
  table: {friction: 0.4}
  objects:
    - {name: can, shape: {cylinder: {radius: 0.04, height: 0.10}}, mass: 0.3, friction: 0.4, position: [0.62, 0.22]}
    - {name: puck, shape: {cylinder: {radius: 0.025, height: 0.06}}, mass: 0.2, friction: 0.4, position: [0.76, -0.25]}
  obstacles:
    - {name: rail-1, size: [0.40, 0.03, 0.06], position: [0.72, -0.175]}
    - {name: rail-2, size: [0.40, 0.03, 0.06], position: [0.72, -0.325]}
robot: {reach: {min: 0.1, max: 0.9}}
tools: [stick]
pushes: {max_count: 2}
goal:
  - {object: can, position: [0.45, 0.22], tolerance: 0.025}
  - {object: puck, position: [0.90, -0.25], tolerance: 0.025}
";

fn solve(yaml: &str) -> (Task, Solution) {
    let task = Task::parse(yaml, "task.yaml").expect("sound");
    let planner = Planner::for_effort(Effort::Draft).expect("sound weights").build();
    let solution = planner.solve(&task, &ToolLibrary::embedded().expect("sound")).expect("sound");
    (task, solution)
}

#[test]
fn two_tools_solve_tasks_that_no_single_tool_solves() {
    let (task, solution) = solve(TWO);
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = &solution.plans[0];
    let mut tools = best.plan.tools();
    tools.sort_unstable();
    assert_eq!(tools, ["finger", "l-hook"]);
    assert_eq!(best.tools.iter().map(|tool| &tool.name).collect::<Vec<_>>(), best.plan.tools());
    let verdict = best.verdict.as_ref().expect("replayed");
    for engine in Engine::ALL {
        let nominal = verdict.nominal(engine).expect("replayed");
        assert!(task.goals.iter().all(|goal| goal.reached(&nominal.outcome.state)), "{engine:?}");
        let frames = &nominal.trajectory.as_ref().expect("recorded").frames;
        assert_eq!(frames.last().map(|frame| frame.stroke), Some(1));
        assert!(frames.windows(2).all(|pair| pair[0].time < pair[1].time));
    }
    // Its prediction covers both tools.
    assert!(task.goals.iter().all(|goal| goal.reached(&best.outcome.state)));

    // Without tool changes, one of the goals is not met, and this plan breaks a rule.
    let (strict, alone) = solve(&TWO.replace("max_count: 2", "max_count: 2, tool_changes: 0"));
    assert_eq!(alone.status, PlanStatus::Partial);
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let situation = Situation::stated(&strict.scene);
    let verdict = verifier.nominal(&strict, &situation, &best.tools, &best.plan);
    assert_eq!(verdict.forbidden, [Warning::TooManyToolChanges { changes: 1, allowed: 0 }]);
    // The plan also cannot be replayed without one of its tools.
    let verdict = verifier.nominal(&task, &situation, &best.tools[..1], &best.plan);
    let other = best.tools[1].name.clone();
    assert_eq!(verdict.forbidden, [Warning::ForbiddenTool { tool: other }]);
}

#[test]
fn a_tool_is_turned_between_pushes_where_one_grip_does_not_do() {
    let (_, solution) = solve(&TURNED.replace("max_count: 2", "max_count: 2, tool_changes: 0"));
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = &solution.plans[0];
    assert_eq!(best.tools.len(), 1);
    let yaws: Vec<f64> = best.plan.push_steps().map(|step| step.grip_yaw).collect();
    assert!(yaws.len() == 2 && yaws[0] != yaws[1], "{yaws:?}");
    // It is one motion of one tool.
    assert_eq!(best.plan.slides(&best.tools).map(|motions| motions.len()), Some(1));
    let (_, stiff) = solve(&TURNED.replace("max_count: 2", "max_count: 2, grip_yaws_deg: [90]"));
    assert_eq!(stiff.status, PlanStatus::Partial);
}

/// Two pushes with one tool give the same result in one motion and in two.
#[test]
fn motions_in_turn_are_what_one_motion_of_all_is() {
    let scene = Scene::new([Object::cuboid("box", [0.08, 0.06, 0.06]).at(0.5, 0.01, 0.3)]);
    let bar = Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::default());
    let tool = Arc::new(Tool::new("bar", [bar]).expect("one piece"));
    let push = |x: f64, y: f64, direction: f64| Push {
        start: Vector::new(x, y),
        direction,
        length: 0.12,
        speed: 0.1,
    };
    let pushes = [push(0.43, 0.0, 0.0), push(0.6, -0.12, 1.4)];
    let all = ToolMotion::pushes(tool.clone(), 0.002, 0.0, &pushes, true);
    let each = pushes.map(|push| ToolMotion::pushes(tool.clone(), 0.002, 0.0, &[push], true));
    for simulator in [Simulator::planar(), Simulator::spatial()] {
        for record in [Record::Outcome, Record::Frames] {
            let one = simulator.run(&scene, &Job::stated(&scene, all.clone()), record);
            let jobs = each.clone().map(|motion| Job::stated(&scene, motion)).to_vec();
            let run =
                |jobs: &[Job]| jobs.iter().map(|job| simulator.run(&scene, job, record)).collect();
            let turns = in_turn(&[jobs], record, run).remove(0);
            let (a, b) = (one.outcome().poses[0], turns.outcome().poses[0]);
            assert!((a.position - b.position).norm() < 1e-4, "{a:?} {b:?}");
            assert!((a.heading - b.heading).abs() < 2e-3);
            assert_eq!(one.frames.len(), turns.frames.len());
            for (a, b) in one.frames.iter().zip(&turns.frames) {
                assert_eq!(a.stroke, b.stroke);
                assert!((a.time - b.time).abs() < 1e-9, "{} {}", a.time, b.time);
            }
            // Each motion records its first contacts.
            assert!(one.contacts.iter().all(|contact| turns.contacts.contains(contact)));
        }
    }
}

#[test]
fn a_plan_of_several_tools_is_read_as_it_is_written() {
    let push = Push { start: Vector::new(0.4, 0.0), direction: 0.0, length: 0.2, speed: 0.1 };
    let one = |tool, yaw| Plan::pushing(tool, yaw, PushForm::Placed, 0.002, [push]);
    let plan = one("stick", 0.0).then(one("finger", 0.0)).then(one("stick", 1.0));
    let text = serde_json::to_string(&plan).expect("as JSON");
    assert_eq!(serde_json::from_str::<Plan>(&text).expect("the same"), plan);
    let library = ToolLibrary::embedded().expect("sound");
    let tools = ["finger", "stick"].map(|name| Arc::clone(library.get(name).expect("shipped")));
    let motions = plan.slides(&tools).expect("all are here");
    let names: Vec<&str> = motions.iter().map(|motion| motion.tool.name.as_str()).collect();
    assert_eq!(names, ["stick", "finger", "stick"]);
    assert!(plan.slides(&tools[..1]).is_none());
    let yaml = Task::parse(TWO, "two-tools.yaml").expect("sound").to_yaml().expect("as text");
    assert_eq!(Task::parse(&yaml, "two-tools.yaml").expect("sound").pushes.tool_changes, None);
}
