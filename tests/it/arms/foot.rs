//! The foot of an arm: its root link, the links fixed to it, and a second arm at rest.

use pushplan::solve::{Effort, PlanStatus, Planner};
use pushplan::task::Task;

use super::{ROBOT, URDF, at, folder, solve, write};
use crate::program::run;

/// A second arm beside the first, on a movable joint.
const SECOND: &str = r#"<link name="other"><collision><geometry><box size="0.1 0.1 0.3"/></geometry>
    <origin xyz="0 0 0.15"/></collision></link>
  <joint name="other" type="revolute"><parent link="foot"/><child link="other"/>
    <origin xyz="0 0.4 0"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1"/></joint>
</robot>"#;

#[test]
fn the_root_link_and_a_second_arm_are_obstacles() {
    let folder = folder(ROBOT);
    let wide = URDF
        .replace("<cylinder radius=\"0.06\" length=\"0.1\"/>", "<box size=\"0.4 0.3 0.1\"/>")
        .replace("<origin xyz=\"0 0 0.05\"/>", "<origin xyz=\"0.1 0 0.05\"/>")
        .replace("</robot>", SECOND);
    write(folder.path(), "six.urdf", &wide);
    let task = Task::load(folder.path().join("push.yaml")).expect("sound");
    let own: Vec<_> = task.scene.obstacles.iter().filter(|one| one.is_robot()).collect();
    assert_eq!(own.len(), 2, "{own:?}");
    let found = |size: [f64; 3], x: f64, y: f64| {
        own.iter().any(|one| {
            let near = (one.pose.position.x - x).hypot(one.pose.position.y - y) < 1e-9;
            near && one.size.iter().zip(size).all(|(a, b)| (a - b).abs() < 1e-9)
        })
    };
    assert!(found([0.4, 0.3, 0.1], 0.1, 0.0) && found([0.1, 0.1, 0.3], 0.0, 0.4), "{own:?}");
    // The second arm is a body of the exported scene, against objects and the arm itself.
    assert_eq!(solve(folder.path()).status.code(), Some(0));
    let (plan, out) = (at(folder.path(), "out/push.plan.json"), at(folder.path(), "mjcf"));
    assert_eq!(run(&["export", &plan, "--out", &out]).status.code(), Some(0));
    let scene = std::fs::read_to_string(folder.path().join("mjcf/push.xml")).expect("a scene");
    for other in ["object/can", "arm/lower/1"] {
        let pair = [
            format!("\"arm/other/1\" geom2=\"{other}"),
            format!("\"{other}\" geom2=\"arm/other/1"),
        ];
        assert!(pair.iter().any(|pair| scene.contains(&**pair)), "{other}");
    }
}

#[test]
fn no_object_is_pulled_into_the_foot() {
    let folder = folder(ROBOT);
    let wide = URDF
        .replace("<cylinder radius=\"0.06\" length=\"0.1\"/>", "<box size=\"0.4 0.3 0.1\"/>")
        .replace("<origin xyz=\"0 0 0.05\"/>", "<origin xyz=\"0.1 0 0.05\"/>");
    write(folder.path(), "six.urdf", &wide);
    let text = "scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.04, height: 0.1}}, mass: 0.4, friction: 0.4, position: [0.42, 0.08]}
robot: {urdf: six.urdf, flange: tool0, tool_mount: {length: 0.1}}
tools: [l-hook]
pushes: {length: 0.1, max_count: 1}
goal: {object: can, position: [0.31, 0.08], tolerance: 0.01}
";
    write(folder.path(), "push.yaml", text);
    let task = Task::load(folder.path().join("push.yaml")).expect("sound");
    let library = pushplan::asset::ToolLibrary::embedded().expect("the shipped tools");
    let planner = Planner::for_effort(Effort::Draft).expect("its models").build();
    let status = planner.solve(&task, &library).expect("a sound task").status;
    assert_ne!(status, PlanStatus::Solved);
}
