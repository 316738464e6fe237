//! Constraints of a task beyond its goal: regions to keep out of, and objects that may fall.

use pushplan::asset::ToolLibrary;
use pushplan::solve::{Effort, PlanStatus, Planner, Solution};
use pushplan::{
    outcome::{ObjectRules, Warning},
    scene::{Engine, Region},
    task::Task,
};

fn task(text: &str) -> Task {
    Task::parse(text, "task.yaml").unwrap_or_else(|faults| panic!("{faults}"))
}

fn solved(task: &Task) -> Solution {
    let planner = Planner::for_effort(Effort::Draft).expect("its models").build();
    planner.solve(task, &ToolLibrary::embedded().expect("the shipped tools")).expect("a sound task")
}

/// Can that needs only a straight push ahead.
const CAN: &str = "
scene:
  objects: [{name: can, shape: {cylinder: {radius: 0.03, height: 0.08}}, mass: 0.4, friction: 0.4, position: [0.45, 0]}]
robot: {reach: {min: 0.05, max: 0.95}}
tools: [finger, stick]
pushes: {directions: 8, length: 0.3}
goal: {object: can, position: [0.7, 0], tolerance: 0.02}
";

/// Returns the task with regions to keep out of.
fn keeping_out(regions: &str) -> Task {
    task(&format!("{CAN}keep_out: [{regions}]\n"))
}

/// Returns the largest distance of the goal's object from the straight path to its goal, metres,
/// and the numbers of frames in which it or the tool is in `region`.
fn followed(solution: &Solution, region: &Region) -> (f64, usize, usize) {
    let best = solution.best().expect("a plan");
    let verdict = best.verdict.as_ref().expect("replays");
    let (mut aside, mut object, mut tool) = (0.0f64, 0, 0);
    for engine in Engine::ALL {
        let trajectory = verdict.nominal(engine).and_then(|one| one.trajectory.as_ref());
        for frame in &trajectory.expect("a nominal replay").frames {
            let pose = frame.state.poses[0];
            aside = aside.max(pose.position.y.abs());
            let can = pushplan::geometry::Footprint::Disc { radius: 0.03 };
            object += usize::from(region.holds(&can, &pose, 0.0));
            let parts = best.tool().parts().iter().enumerate();
            let mut inside = parts.map(|(k, part)| {
                region.holds(&part.footprint(), &best.tool().part_pose(k, &frame.tool), 0.0)
            });
            tool += usize::from(inside.any(|inside| inside));
        }
    }
    (aside, object, tool)
}

#[test]
fn keep_out_areas_are_bypassed_by_the_named_bodies() {
    let free = solved(&task(CAN));
    assert_eq!(free.status, PlanStatus::Solved);
    let circle = |who: &str| {
        format!(
            "{{name: spill, area: {{circle: {{radius: 0.04}}}}, position: [0.575, 0], for: [{who}]}}"
        )
    };
    let around = keeping_out(&circle("objects").replace("0.575, 0]", "0.575, 0.05]"));
    let region = &around.scene.keep_out[0];
    let (aside, object, _) = followed(&free, region);
    assert!(aside < 0.02 && object > 0, "it would go straight through: {aside}");

    let found = solved(&around);
    assert_eq!(found.status, PlanStatus::Solved);
    let (aside, object, _) = followed(&found, region);
    assert!(aside > 0.02 && object == 0, "{aside}, {object} frames inside");

    // Beside the end of the tool's path.
    let there = "[0.62, 0.03], for: [tool]";
    let tool = circle("tool").replace("[0.575, 0], for: [tool]", there);
    let tool = keeping_out(&tool.replace("radius: 0.04", "radius: 0.02"));
    let region = &tool.scene.keep_out[0];
    assert!(followed(&free, region).2 > 0);
    let found = solved(&tool);
    assert_eq!(found.status, PlanStatus::Solved);
    assert_eq!(followed(&found, region).2, 0);

    // If the hand must keep its distance, the finger is too short.
    let free = solved(&task(&CAN.replace("[finger, stick]", "[finger]")));
    let hand = keeping_out(&circle("hand").replace("radius: 0.04", "radius: 0.3"));
    let found = solved(&hand);
    assert_eq!(found.status, PlanStatus::Solved);
    let nearest = |solution: &Solution| {
        let pushes = solution.best().expect("a plan").plan.pushes();
        let middle = pushplan::geometry::Vector::new(0.575, 0.0);
        let ends = pushes.iter().flat_map(|push| [push.start, push.end()]);
        ends.map(|at| (at - middle).norm()).fold(f64::INFINITY, f64::min)
    };
    assert!(nearest(&free) < 0.35 && nearest(&found) >= 0.35, "{}", nearest(&found));
}

#[test]
fn regions_of_every_outline_are_written_and_read() {
    let text = "
  {name: a, area: {rectangle: {size: [0.1, 0.2]}}, position: [0.2, 0.4], yaw_deg: 30},
  {name: b, area: {polygon: {corners: [[0.6, 0.3], [0.8, 0.3], [0.7, 0.5]]}}, for: [hand, tool]},
  {name: c, area: {circle: {radius: 0.1}}, position: [0.2, -0.4], for: [tool]}";
    let stated = keeping_out(text);
    let written = stated.to_yaml().expect("a file");
    let read = Task::parse(&written, "task.yaml").expect("the written task");
    assert_eq!(read.scene.keep_out.len(), 3);
    for (one, other) in stated.scene.keep_out.iter().zip(&read.scene.keep_out) {
        let moved = (one.pose.position - other.pose.position).norm();
        assert!(moved < 1e-12 && (one.pose.heading - other.pose.heading).abs() < 1e-12);
        assert_eq!(
            (&one.name, one.objects, one.tool, one.hand),
            (&other.name, other.objects, other.tool, other.hand)
        );
    }
    let fault = |regions: &str| {
        let text = format!("{CAN}keep_out: [{regions}]\n");
        Task::parse(&text, "task.yaml").expect_err("a fault").to_string()
    };
    let there = fault("{name: a, area: {circle: {radius: 0.1}}, position: [0.5, 0]}");
    assert!(there.contains("`can` stands in the keep-out region `a`"), "{there}");
    let named = fault("{name: can, area: {circle: {radius: 0.1}}, position: [0.9, 0]}");
    assert!(named.contains("can"), "{named}");
    let bent =
        "{name: a, area: {polygon: {corners: [[0, 0], [1, 0], [0.2, 0.2], [0, 1]]}}, for: [tool]}";
    assert!(fault(bent).contains("convex"), "{}", fault(bent));
}

/// Box with a long cap across in front of it, which is pushed over the table's end.
const CAP: &str = "
scene:
  table: {size: [0.5, 1], position: [0.45, 0]}
  objects:
    - {name: box, shape: {cuboid: {size: [0.06, 0.06, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.5, 0]}
    - {name: cap, shape: {cuboid: {size: [0.03, 0.14, 0.03]}}, mass: 0.05, friction: 0.4, position: [0.62, 0]}
robot: {reach: {min: 0.05, max: 0.95}, hand: none}
tools: [finger, paddle]
pushes: {directions: [0], length: 0.2, max_count: 1}
goal: {object: box, position: [0.67, 0], tolerance: 0.01}
";

#[test]
fn objects_that_may_fall_are_pushed_off_and_reported() {
    let kept = solved(&task(CAP));
    assert!(!matches!(kept.status, PlanStatus::Solved | PlanStatus::Fragile));
    let text = CAP.replace("position: [0.62, 0]}", "position: [0.62, 0], may_fall: true}");
    let free = task(&text);
    let found = solved(&free);
    assert_eq!(found.status, PlanStatus::Solved);
    let verdict = found.best().and_then(|best| best.verdict.as_ref()).expect("replays");
    for engine in Engine::ALL {
        let nominal = verdict.nominal(engine).expect("a nominal replay");
        assert!(nominal.warnings.contains(&Warning::Fell { object: "cap".into() }), "{engine:?}");
    }
    assert_eq!(Task::parse(&free.to_yaml().expect("a file"), "task.yaml"), Ok(free));
    let goal = text.replace("position: [0.5, 0]}", "position: [0.5, 0], may_fall: true}");
    let fault = Task::parse(&goal, "task.yaml").expect_err("a fault").to_string();
    assert!(fault.contains("`box` has a goal on the table but may fall"), "{fault}");
}

/// Can behind a turnstile, which a straight push would turn.
const FAN: &str = "
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.03, height: 0.07}}, mass: 0.4, friction: 0.4, position: [0.45, 0.1]}
    - {name: fan, shape: {cuboid: {size: [0.03, 0.26, 0.07]}}, mass: 0.3, friction: 0.1, position: [0.58, 0]}
  joints: [{between: [fan, world], kind: revolute, at: [0.58, 0]}]
robot: {reach: {min: 0.05, max: 0.95}}
tools: [finger, stick]
pushes: {max_count: 2, length: 0.3, directions: 8}
goal: {object: can, position: [0.68, 0.09], tolerance: 0.02}
";

#[test]
fn what_is_kept_is_not_turned_at_any_time() {
    let free = solved(&task(FAN));
    assert_eq!(free.status, PlanStatus::Solved);
    let kept = task(&format!("{FAN}keep: {{objects: [fan]}}\n"));
    let rules = ObjectRules::of(&kept.scene);
    let broken = |solution: &Solution| {
        let verdict = solution.best().and_then(|best| best.verdict.as_ref()).expect("replays");
        Engine::ALL.into_iter().find_map(|engine| {
            let trajectory = verdict.nominal(engine)?.trajectory.as_ref()?;
            rules.first_broken(trajectory.frames.iter().map(|frame| &frame.state))
        })
    };
    assert!(broken(&free).is_some(), "without the rule it is turned");
    let found = solved(&kept);
    let accepted = matches!(found.status, PlanStatus::Solved | PlanStatus::Fragile);
    assert!(!accepted || broken(&found).is_none());
}
