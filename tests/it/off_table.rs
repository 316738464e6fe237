//! Goals off the table: objects that are pushed over an edge and fall.

use pushplan::asset::ToolLibrary;
use pushplan::solve::{PlanStatus, Solution};
use pushplan::{EffectModel, Job, Obstacle, Push, Simulated, Simulator, ToolMotion, Vector};
use pushplan::{
    outcome::{Record, Warning},
    scene::{Engine, Rate, Situation, Span, State},
    task::{Demand, Edge, Fall, Task},
};

use crate::judged::{file, solved, works_in_mujoco};

/// Returns the fall of the first goal.
fn fall(task: &Task) -> &Fall {
    let [Demand::Fall(fall)] = &task.goals[0].demands[..] else { panic!("a fall") };
    fall
}

/// Returns a task with a box and a can on a table that ends 40 cm to either side; `goal` is the
/// task's.
fn task(goal: &str) -> Task {
    let text = format!(
        "
scene:
  table: {{size: [0.8, 0.8], position: [0.55, 0.0], friction: 0.4}}
  objects:
    - {{name: box, shape: {{cuboid: {{size: [0.08, 0.06, 0.08]}}}}, mass: 0.5, friction: 0.4,
       position: [0.65, 0.25], yaw_deg: 20}}
    - {{name: can, shape: {{cylinder: {{radius: 0.04, height: 0.1}}}}, mass: 0.4, friction: 0.4, position: [0.75, -0.25]}}
robot: {{reach: {{min: 0.1, max: 1.0}}}}
tools: [stick, l-hook]
goal: {goal}
"
    );
    Task::parse(&text, "fall.yaml").unwrap_or_else(|faults| panic!("{faults}"))
}

#[test]
fn things_are_pushed_over_the_edge_that_is_asked_for() {
    for (goal, off) in [
        ("{object: box, off_table: left}", vec![0]),
        ("{object: can, off_table: far}", vec![1]),
        ("{object: box, off_table: {edge: left, between: [0.70, 0.86]}}", vec![0]),
        ("[{object: box, off_table: any}, {object: can, off_table: any}]", vec![0, 1]),
    ] {
        let task = task(goal);
        assert!(!task.reached(&task.scene.start()), "{goal}");
        let solution = solved(&task);
        assert_eq!(solution.status, PlanStatus::Solved, "{goal}");
        let verdict = solution.plans[0].verdict.as_ref().expect("replayed");
        let top = task.scene.table_top.expect("it ends");
        for engine in Engine::ALL {
            let nominal = verdict.nominal(engine).expect("replayed");
            let gone = |k: &usize| !top.holds(nominal.outcome.state.poses[*k].position);
            assert_eq!([0, 1].into_iter().filter(gone).collect::<Vec<_>>(), off, "{goal}");
            if let Some(span) = fall(&task).between {
                assert!(span.contains(nominal.outcome.state.poses[0].position.x), "{goal}");
            }
            // A wanted fall causes no warning.
            assert!(!nominal.warnings.iter().any(|one| matches!(one, Warning::Fell { .. })));
        }
        works_in_mujoco(&file(&task, &solution));
    }
}

/// Returns the end of the box after a push of this length to the left, in this engine.
fn pushed(task: &Task, engine: Engine, length: f64) -> (State, Vec<Warning>) {
    let library = ToolLibrary::embedded().expect("tools");
    let stick = library.get("stick").expect("a stick");
    // The stick reaches 0.61 m beyond the grip, and comes down two centimetres from the box.
    let push = Push {
        start: Vector::new(0.65, 0.25 - 0.05 - 0.61),
        direction: std::f64::consts::FRAC_PI_2,
        length,
        speed: 0.1,
    };
    let motion =
        ToolMotion::pushes(stick.clone(), 0.002, std::f64::consts::FRAC_PI_2, &[push], true);
    let job = Job::new(&Situation::stated(&task.scene), motion);
    let model = Simulated::new(Simulator::new(engine, Rate::DEFAULT));
    let trajectory = model.rollout(&task.scene, &[job], Record::Outcome).remove(0);
    (trajectory.outcome().clone(), trajectory.warnings.clone())
}

/// The 3-D table has an edge: an object pushed beyond it tips and falls, an object short of it
/// stands.
#[test]
fn three_dimensions_decide_whether_it_falls() {
    let mut task = task("{object: box, off_table: left}");
    task.scene.objects[0].pose.heading = 0.0;
    let fell =
        |warnings: &[Warning]| warnings.iter().any(|one| matches!(one, Warning::Fell { .. }));
    for (y, falls) in [(0.38, false), (0.395, false), (0.405, true), (0.43, true)] {
        let length = y - 0.25 + 0.02;
        let (flat, warned) = pushed(&task, Engine::Planar, length);
        assert!((flat.poses[0].position.y - y).abs() < 4e-3, "{}", flat.poses[0].position.y);
        assert_eq!(task.reached(&flat), falls, "{y}");
        assert_eq!(fell(&warned), falls);
        let (solid, warned) = pushed(&task, Engine::Spatial, length);
        assert_eq!(task.reached(&solid), falls, "{y}: {}", solid.poses[0].position.y);
        assert_eq!(fell(&warned), falls);
        assert!(warned.iter().all(|warning| !warning.forbids_success()), "{warned:?}");
    }
}

/// An object that leans on a support beyond the edge has not fallen.
#[test]
fn an_object_held_up_beyond_the_edge_has_not_fallen() {
    let mut task = task("{object: box, off_table: left}");
    task.scene.objects[0].pose.heading = 0.0;
    // The gap is 5 mm narrower than the box.
    let wall = Obstacle::cuboid("wall", [0.3, 0.02, 0.3]).at(0.65, 0.465, 0.0);
    task.scene.obstacles.push(wall);
    let hangs = |one: &Warning| matches!(one, Warning::Hangs { object } if object == "box");
    for (wall, fails) in [(true, true), (false, false)] {
        if !wall {
            task.scene.obstacles.pop();
        }
        let (end, warned) = pushed(&task, Engine::Spatial, 0.415 - 0.25 + 0.02);
        assert!(task.reached(&end), "its centre is beyond the edge");
        assert_eq!(warned.iter().any(hangs), fails, "{warned:?}");
    }
}

/// Any other object that goes over an edge is still a fault.
#[test]
fn nothing_else_may_fall() {
    let mut task = task("{object: can, off_table: left}");
    let (_, warned) = pushed(&task, Engine::Spatial, 0.25);
    let off = |one: &Warning| matches!(one, Warning::OffTable { object } if object == "box");
    assert!(warned.iter().any(off), "{warned:?}");
    task.scene.objects[0].may_fall = true;
    let (_, warned) = pushed(&task, Engine::Spatial, 0.25);
    assert!(!warned.iter().any(off), "{warned:?}");
}

/// Returns the distance of the can from the far edge at the end of the nominal 3-D replay, metres.
fn inside(solution: &Solution) -> f64 {
    let verdict = solution.plans[0].verdict.as_ref().expect("replayed");
    let end = &verdict.nominal(Engine::Spatial).expect("replayed").outcome.state;
    0.95 - end.poses[1].position.x
}

/// Three millimetres from the edge are within the uncertainty: the plan is fragile if the goal
/// allows nothing else, and otherwise the can ends farther inside.
#[test]
fn objects_end_safely_inside_the_edge_where_the_goal_allows_it() {
    let goal = |tolerance: f64| {
        task(&format!("{{object: can, position: [0.947, -0.25], tolerance: {tolerance}}}"))
    };
    let close = solved(&goal(0.002));
    assert_eq!(close.status, PlanStatus::Fragile);
    assert!(inside(&close) < 0.006, "{}", inside(&close));
    let near = |one: &Warning| matches!(one, Warning::NearEdge { object, .. } if object == "can");
    assert!(close.warnings.iter().any(near), "{:?}", close.warnings);
    let free = solved(&goal(0.02));
    assert_eq!(free.status, PlanStatus::Solved);
    assert!(inside(&free) > 0.006, "{}", inside(&free));
    assert!(!free.warnings.iter().any(near), "{:?}", free.warnings);
}

#[test]
fn it_is_read_as_it_is_written_and_a_plan_file_keeps_it() {
    for (word, over) in [
        ("any", None),
        ("far", Some(Edge::Far)),
        ("near", Some(Edge::Near)),
        ("left", Some(Edge::Left)),
        ("right", Some(Edge::Right)),
    ] {
        let task = task(&format!("{{object: box, off_table: {word}}}"));
        assert_eq!(fall(&task).over, over);
        assert!(task.scene.objects[0].may_fall && !task.scene.objects[1].may_fall);
        let again = Task::parse(&task.to_yaml().expect("as text"), "fall.yaml").expect("sound");
        assert_eq!(again, task);
        let json = serde_json::to_string(&task).expect("as JSON");
        assert_eq!(serde_json::from_str::<Task>(&json).expect("the same"), task);
    }
    let task = task("{object: box, off_table: {edge: far, between: [-0.1, 0.25]}}");
    let fall = fall(&task);
    assert_eq!((fall.over, fall.between), (Some(Edge::Far), Some(Span::new(-0.1, 0.25))));
    let again = Task::parse(&task.to_yaml().expect("as text"), "fall.yaml").expect("sound");
    assert_eq!(again, task);
}

#[test]
fn a_part_of_an_edge_lies_on_the_table() {
    let text = task("{object: box, off_table: left}").to_yaml().expect("as text");
    let part = "off_table: {edge: left, between: [1.0, 1.2]}";
    let faults =
        Task::parse(&text.replace("off_table: left", part), "fall.yaml").expect_err("off it");
    assert!(
        faults.to_string().contains("the left edge ranges only from 0.150 to 0.950"),
        "{faults}"
    );
}
