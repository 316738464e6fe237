//! Tests of the travel of lifted tools.

use std::sync::Arc;

use crate::geometry::{Pose, Vector};
use crate::scene::{Object, Obstacle, Part, Region, Robot, Scene, Tool};
use crate::task::{Goal, Plan, Push, PushForm, Task};

use super::{BlockedLeg, TravelLeg};

/// A push of 0.1 m along y from a start, metres.
fn push(x: f64, y: f64) -> Push {
    let direction = std::f64::consts::FRAC_PI_2;
    Push { start: Vector::new(x, y), direction, length: 0.1, speed: 0.1 }
}

fn bar(name: &str) -> Arc<Tool> {
    let bar = Part::cuboid("bar", [0.04, 0.04, 0.05], Pose::default());
    Arc::new(Tool::new(name, [bar]).expect("one piece"))
}

fn task(obstacles: Vec<Obstacle>) -> Task {
    let mut scene = Scene::new([Object::cylinder("can", 0.03, 0.1).at(0.8, 0.2, 0.0)]);
    scene.obstacles = obstacles;
    Task::new("t", scene, Robot::reaching(0.2, 1.0), Goal::new(0, [0.8, 0.3], 0.02))
}

fn legs(task: &Task, pushes: &[Push]) -> Result<Vec<TravelLeg>, BlockedLeg> {
    let plan = Plan::pushing("bar", 0.0, PushForm::Placed, 0.002, pushes.to_vec());
    task.legs(&task.scene, &[bar("bar")], &plan, &[])
}

fn wall(height: f64, width: f64) -> Obstacle {
    Obstacle::cuboid("wall", [0.02, width, height]).at(0.6, 0.0, 0.0)
}

#[test]
fn a_lifted_tool_goes_over_what_is_low_and_around_what_is_tall() {
    let ends = |leg: &TravelLeg| (leg.from, leg.to, leg.around.clone());
    let over = legs(&task(vec![wall(0.2, 0.4)]), &[push(0.8, 0.0)]).expect("over");
    let straight: Vec<_> = over.iter().map(ends).collect();
    assert_eq!(straight, [(None, Some(0), None), (Some(0), None, None)]);
    assert!((over[0].length() - 0.6).abs() < 1e-12);
    let around = legs(&task(vec![wall(0.5, 0.4)]), &[push(0.8, 0.0)]).expect("around");
    assert_eq!(around[0].around.as_deref(), Some("wall"));
    // The path leads around an end of the wall, at the distance of the hand's radius.
    assert!(around[0].path.iter().any(|at| at.y.abs() > 0.25), "{around:?}");
    assert!(around[0].length() > 0.65 && around[0].length() < 1.2);
}

#[test]
fn what_encloses_the_object_or_the_robot_leaves_no_path() {
    // The wall extends over the whole reach, and the column is behind it.
    let blocked = |from, to| BlockedLeg { from, to, obstacle: "wall".into() };
    let across = legs(&task(vec![wall(0.5, 2.4)]), &[push(0.8, 0.0)]);
    assert_eq!(across, Err(blocked(None, Some(0))));
    // A raised wall blocks as well, one that ends below the travel height does not.
    let raised = legs(&task(vec![wall(0.5, 2.4).raised(0.5)]), &[push(0.8, 0.0)]);
    assert_eq!(raised, Err(blocked(None, Some(0))));
    assert!(legs(&task(vec![wall(0.25, 2.4)]), &[push(0.8, 0.0)]).is_ok());
    // The second push is on the other side.
    let second = legs(&task(vec![wall(0.5, 2.4)]), &[push(0.4, 0.0), push(0.8, 0.0)]);
    assert_eq!(second, Err(blocked(Some(0), Some(1))));
}

#[test]
fn loose_posts_and_keep_out_regions_are_avoided_where_they_are() {
    let mut fenced = task(Vec::new());
    let post = |k: usize| {
        let y = -1.0 + 0.08 * k as f64;
        Object::cylinder(format!("post-{k}"), 0.02, 0.6).at(0.6, y, 0.0)
    };
    fenced.scene.objects.extend((0..26).map(post));
    let found = legs(&fenced, &[push(0.8, 0.0)]).expect_err("a closed fence");
    assert!(found.obstacle.starts_with("post-"), "{found:?}");
    // The fence opens where two posts have been pushed aside.
    let mut states = vec![fenced.scene.start()];
    states[0].poses[13].position.x = 0.9;
    states[0].poses[14].position.x = 0.9;
    let plan = Plan::pushing("bar", 0.0, PushForm::Placed, 0.002, [push(0.8, -0.2)]);
    assert!(fenced.legs(&fenced.scene, &[bar("bar")], &plan, &states).is_ok());
    let mut strip = task(Vec::new());
    let region = |hand: bool| Region {
        name: "strip".into(),
        shape: crate::geometry::Shape::Cuboid { size: [0.02, 2.4, 0.1] },
        pose: Pose::new(0.6, 0.0, 0.0),
        objects: true,
        tool: hand,
        hand,
    };
    strip.scene.keep_out = vec![region(true)];
    assert!(legs(&strip, &[push(0.8, 0.0)]).is_err());
    strip.scene.keep_out = vec![region(false)];
    assert!(legs(&strip, &[push(0.8, 0.0)]).is_ok());
}

#[test]
fn tools_change_at_home_and_do_not_rotate_through_walls() {
    let open = task(Vec::new());
    let other = Plan::pushing("other", 0.0, PushForm::Placed, 0.002, [push(0.5, 0.0)]);
    let plan = Plan::pushing("bar", 0.0, PushForm::Placed, 0.002, [push(0.8, 0.0)]).then(other);
    let made = open.legs(&open.scene, &[bar("bar"), bar("other")], &plan, &[]).expect("open");
    let ends: Vec<_> = made.iter().map(|leg| (leg.from, leg.to)).collect();
    assert_eq!(ends, [(None, Some(0)), (Some(0), None), (None, Some(1)), (Some(1), None)]);
    assert!(made.iter().all(|leg| leg.path.len() == 2));
    // A long tool beside a tall post cannot rotate there; it goes home in between.
    let long = Part::cuboid("rod", [0.6, 0.02, 0.05], Pose::new(0.3, 0.0, 0.0));
    let long = Arc::new(Tool::new("rod", [long]).expect("one piece"));
    let posted = task(vec![Obstacle::cuboid("post", [0.02, 0.02, 0.5]).at(0.5, 0.55, 0.0)]);
    let yaw = std::f64::consts::FRAC_PI_2;
    let first = Plan::pushing("rod", 0.0, PushForm::Placed, 0.002, [push(0.3, 0.1)]);
    let then = Plan::pushing("rod", yaw, PushForm::Placed, 0.002, [push(0.3, 0.05)]);
    let made = posted.legs(&posted.scene, &[long], &first.then(then), &[]).expect("free");
    assert_eq!(made.len(), 4, "{made:?}");
}

#[test]
fn the_column_is_bypassed_and_a_tool_that_does_not_fit_at_home_is_held_beside_it() {
    let behind = legs(&task(Vec::new()), &[push(-0.6, 0.0)]).expect("around the column");
    assert_eq!(behind[0].around.as_deref(), Some(Robot::BASE));
    let near = |leg: &TravelLeg| leg.path.iter().map(|at| at.norm()).fold(f64::INFINITY, f64::min);
    assert!(near(&behind[0]) > 0.2 - 1e-9, "{behind:?}");
    // At home the rod would extend through the wall.
    let long = Part::cuboid("rod", [0.6, 0.02, 0.05], Pose::new(0.3, 0.0, 0.0));
    let long = [Arc::new(Tool::new("rod", [long]).expect("one piece"))];
    let walled = task(vec![wall(0.5, 0.6)]);
    let plan = Plan::pushing("rod", 0.0, PushForm::Placed, 0.002, [push(-0.3, 0.4)]);
    let made = walled.legs(&walled.scene, &long, &plan, &[]).expect("free");
    assert!((made[0].path[0] - walled.robot.home).norm() > 0.1, "{made:?}");
}
