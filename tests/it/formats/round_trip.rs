//! Scenes written by `pushplan export`, read again.

use std::sync::Arc;

use pushplan::asset::PlanFile;
use pushplan::{JointKind, Pose, Shape, ToolLibrary, Vector};
use pushplan::{
    scene::{Robot, Scene, Tool},
    task::{Demand, Goal, Plan, Push, PushForm, Task},
};
use pushplan_export::mjcf;
use pushplan_import::{Imported, ImportedScene, Wanted, objects, parse, tool};

/// Returns a plan of one push with a shipped tool.
fn plan(task: Task, tool: &Tool) -> PlanFile {
    let push = Push { start: Vector::new(0.3, 0.0), direction: 0.0, length: 0.1, speed: 0.1 };
    let (name, form) = (tool.name.clone(), PushForm::Placed);
    let plan = Plan::pushing(name, 0.0, form, 0.002, [push]);
    let tool = Arc::new(tool.clone());
    PlanFile::new(task, vec![tool], plan)
}

fn tasks() -> Vec<Task> {
    let folder = std::path::Path::new(crate::ROOT).join("tasks");
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let files = paths.filter(|path| path.extension().is_some_and(|end| end == "yaml"));
    files.map(|path| Task::load(path).unwrap_or_else(|faults| panic!("{faults}"))).collect()
}

fn near(a: f64, b: f64, what: &str) {
    assert!((a - b).abs() <= 1e-9, "{what}: {a} and {b}");
}

fn same_pose(a: &Pose, b: &Pose, what: &str) {
    assert!((a.position - b.position).norm() <= 1e-9, "{what}: {a:?} and {b:?}");
    near(pushplan::geometry::wrap_angle(a.heading - b.heading), 0.0, what);
}

fn same_shape(a: &Shape, b: &Shape, what: &str) {
    near(a.height(), b.height(), what);
    match (a, b) {
        (Shape::Cuboid { size: a }, Shape::Cuboid { size: b }) => {
            (0..3).for_each(|axis| near(a[axis], b[axis], what));
        }
        (Shape::Cylinder { radius: a, .. }, Shape::Cylinder { radius: b, .. }) => {
            near(*a, *b, what)
        }
        (Shape::Prism { base: a, .. }, Shape::Prism { base: b, .. }) => {
            assert_eq!(a.corners().len(), b.corners().len(), "{what}");
            for corner in a.corners() {
                let found = b.corners().iter().any(|other| (other - corner).norm() <= 1e-9);
                assert!(found, "{what}: {a:?} and {b:?}");
            }
        }
        _ => panic!("{what}: {a:?} and {b:?}"),
    }
}

fn same_scene(a: &Scene, b: &Scene, what: &str) {
    near(a.table_friction, b.table_friction, what);
    // The robot's base depends on the task, so it is not compared.
    let [a_obstacles, b_obstacles] = [a, b].map(|scene| {
        let stated = scene.obstacles.iter().filter(|one| one.name != Robot::BASE);
        stated.collect::<Vec<_>>()
    });
    assert_eq!(
        (a.objects.len(), a_obstacles.len()),
        (b.objects.len(), b_obstacles.len()),
        "{what}"
    );
    for object in &a.objects {
        let what = format!("{what}, {}", object.name);
        let other = b.objects.iter().find(|other| other.name == object.name);
        let other = other.unwrap_or_else(|| panic!("{what} is missing"));
        same_shape(&object.shape, &other.shape, &what);
        same_pose(&object.pose, &other.pose, &what);
        near(object.mass, other.mass, &what);
        near(object.friction, other.friction, &what);
        assert_eq!(object.color, other.color, "{what}");
        // The corners of a prism may begin at another corner.
        let feet: Vec<(Vector, f64)> = other.feet().each().collect();
        assert_eq!(object.feet().count, feet.len(), "{what}");
        for (foot, load) in object.feet().each() {
            let same = |(at, other): &(Vector, f64)| {
                (at - foot).norm() <= 1e-6 && (other - load).abs() <= 1e-9
            };
            assert!(feet.iter().any(same), "{what}: {foot} carries {load}");
        }
    }
    for (obstacle, other) in a_obstacles.into_iter().zip(b_obstacles) {
        let what = format!("{what}, {}", obstacle.name);
        assert_eq!(obstacle.name, other.name);
        same_shape(&obstacle.shape(), &other.shape(), &what);
        same_pose(&obstacle.pose, &other.pose, &what);
        near(obstacle.friction, other.friction, &what);
    }
    let kind = |scene: &Scene| {
        let mut kinds: Vec<String> = scene
            .joints
            .iter()
            .map(|joint| {
                let mut names = joint.between.map(|index| scene.objects[index].name.clone());
                names.sort();
                let kind = match joint.kind {
                    JointKind::Fixed => "fixed".to_owned(),
                    JointKind::Revolute { at, .. } => format!("revolute {:.6} {:.6}", at.x, at.y),
                    JointKind::Prismatic { axis, .. } => {
                        format!("prismatic {:.6}", (axis.y / axis.x).abs())
                    }
                };
                format!("{names:?} {kind}")
            })
            .collect();
        kinds.sort();
        kinds
    };
    assert_eq!(kind(a), kind(b), "{what}");
    assert_eq!(a.frictions.len(), b.frictions.len(), "{what}: {:?}", b.frictions);
}

#[test]
fn every_shipped_task_comes_back_with_its_sizes_masses_frictions_and_places() {
    let library = ToolLibrary::embedded().unwrap();
    let stick = library.get("stick").unwrap();
    let tasks = tasks();
    assert!(tasks.len() > 10);
    // The importer makes separate objects of the solids of a compound object. It supports neither
    // joints to the world nor goals other than positions and headings.
    let simple = |task: &Task| {
        let scene = &task.scene;
        let placed = |goal: &Goal| {
            matches!(goal.demands[..], [Demand::Place(_)] | [Demand::Place(_), Demand::Heading(_)])
                && goal.relative().is_none()
        };
        scene.mounts.is_empty() && scene.seams().next().is_none() && task.goals.iter().all(placed)
    };
    let tasks: Vec<Task> = tasks.into_iter().filter(simple).collect();
    assert!(tasks.len() > 10);
    for mut task in tasks {
        task.scene.objects[0].color = Some([0.2, 0.4, 0.6]);
        let text = mjcf(&plan(task.clone(), stick)).unwrap();
        let (model, _) = parse(&text, "scene.xml").unwrap_or_else(|faults| panic!("{faults}"));
        assert_eq!(model.notes, []);
        let made = objects(&model, "scene.xml", &Wanted::default());
        let Imported { value, .. } =
            made.unwrap_or_else(|faults| panic!("{}: {faults}", task.name));
        let ImportedScene { task: found, has_goal } = value;
        // MJCF cannot express the extents of a table or the height of a push.
        same_scene(&task.scene, &found.scene, &task.name);
        assert!(has_goal && found.name == task.name);
        assert_eq!(task.goals.len(), found.goals.len());
        for (wanted, goal) in task.goals.iter().zip(&found.goals) {
            let names = [(&task, wanted), (&found, goal)]
                .map(|(task, goal)| &task.scene.objects[goal.object].name);
            assert_eq!(names[0], names[1]);
            let [at, found] = [wanted, goal].map(|goal| goal.position().unwrap());
            near((at - found).norm(), 0.0, "goal");
            near(wanted.tolerance(), goal.tolerance(), "tolerance");
            let [alike, kept] = [wanted, goal].map(|goal| goal.heading().map(|own| own.symmetry));
            assert_eq!(alike, kept, "{}", task.name);
        }
    }
}

#[test]
fn goals_return_as_positions_and_headings_or_are_reported_as_omitted() {
    let library = ToolLibrary::embedded().unwrap();
    let stick = library.get("stick").unwrap();
    let back = |goal: &str| {
        let text = format!(
            "scene:
  table: {{size: [0.8, 0.8], position: [0.6, 0.0]}}
  objects:
    - {{name: a, shape: {{cuboid: {{size: [0.08, 0.05, 0.06]}}}}, mass: 0.4, friction: 0.4, position: [0.5, 0.0]}}
    - {{name: b, shape: {{cuboid: {{size: [0.06, 0.06, 0.06]}}}}, mass: 0.4, friction: 0.4, position: [0.5, 0.2]}}
robot: {{reach: {{min: 0.2, max: 0.9}}}}
tools: all
goal: {{object: a, {goal}}}
"
        );
        let task = Task::parse(&text, "task.yaml").unwrap();
        let text = mjcf(&plan(task.clone(), stick)).unwrap();
        let (model, _) = parse(&text, "scene.xml").unwrap();
        let made = objects(&model, "scene.xml", &Wanted::default()).unwrap().value;
        let notes: Vec<String> = model.notes.into_iter().map(|note| note.message).collect();
        (task.goals, made.has_goal.then_some(made.task.goals), notes)
    };
    for goal in
        ["position: [0.6, 0.1], tolerance: 0.02", "heading_deg: 90, heading_tolerance_deg: 5"]
    {
        let (written, found, notes) = back(goal);
        assert_eq!((found, notes.len()), (Some(written), 0), "{goal}");
    }
    for (goal, what) in [
        ("gap: {to: b, max: 0.01}", "from b"),
        ("gap: {to: b, max: 0.01}, heading_deg: 90, heading_tolerance_deg: 5", "from b"),
        ("region: {area: {circle: {radius: 0.05}}, position: [0.6, 0.1]}", "in a circle"),
        ("coverage: {share: 0.9, position: [0.6, 0.1], heading_deg: 90}", "covering"),
        ("off_table: far", "off the table"),
        ("position: [0.1, 0.0], tolerance: 0.02, relative_to: b", "in the frame of b"),
    ] {
        let (_, found, notes) = back(goal);
        assert_eq!(found, None, "{goal}");
        let [note] = &notes[..] else { panic!("{goal}: {notes:?}") };
        assert!(
            note.contains("the goal of `object/a` is ignored") && note.contains(what),
            "{note}"
        );
    }
}

#[test]
fn limits_of_joints_come_back_whichever_of_the_two_hangs_on_the_other() {
    let task = "
scene:
  objects:
    - {name: a, shape: {cuboid: {size: [0.06, 0.06, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.50, 0.0], yaw_deg: 90}
    - {name: b, shape: {cuboid: {size: [0.06, 0.06, 0.10]}}, mass: 0.6, friction: 0.3, position: [0.57, 0.0]}
    - {name: c, shape: {cuboid: {size: [0.06, 0.06, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.64, 0.0]}
  joints:
    - {between: [b, a], kind: revolute, at: [0.535, 0.0], limits_deg: [-20, 30]}
    - {between: [c, b], kind: prismatic, axis: [1, 0], limits: [-0.005, 0.04]}
robot: {reach: {max: 0.9}}
tools: all
goal: {object: a, position: [0.60, 0.0], tolerance: 0.02}
";
    let task = Task::parse(task, "task.yaml").unwrap();
    let library = ToolLibrary::embedded().unwrap();
    let text = mjcf(&plan(task.clone(), library.get("stick").unwrap())).unwrap();
    let (model, ..) = parse(&text, "scene.xml").unwrap();
    let found = objects(&model, "scene.xml", &Wanted::default()).unwrap().value.task.scene;
    for joint in &task.scene.joints {
        let same = |other: &&pushplan::Joint| {
            let mut pairs = [joint.between, other.between];
            pairs.iter_mut().for_each(|pair| pair.sort());
            pairs[0] == pairs[1]
        };
        let other = found.joints.iter().find(same).expect("the joint");
        let (limits, theirs) = (joint.limits().unwrap(), other.limits().unwrap());
        // Seen from the other object, rotation and translation change their sign.
        let swapped = joint.between != other.between;
        let along = match (joint.kind, other.kind) {
            (JointKind::Prismatic { axis: a, .. }, JointKind::Prismatic { axis: b, .. }) => {
                a.dot(&b)
            }
            _ => 1.0,
        };
        let turned = swapped != (along < 0.0);
        let [low, high] =
            if turned { [-theirs.high, -theirs.low] } else { [theirs.low, theirs.high] };
        near(limits.low, low, "low");
        near(limits.high, high, "high");
    }
}

#[test]
fn every_shipped_tool_comes_back_as_wide_as_it_was() {
    let library = ToolLibrary::embedded().unwrap();
    let task = tasks().remove(0);
    for shipped in library.iter() {
        let text = mjcf(&plan(task.clone(), shipped)).unwrap();
        let (model, ..) = parse(&text, "scene.xml").unwrap();
        let found = tool(&model, "scene.xml", &Wanted::default());
        let Imported { value, .. } =
            found.unwrap_or_else(|faults| panic!("{}: {faults}", shipped.name));
        near(value.friction, shipped.friction, &shipped.name);
        for k in 0..72 {
            let angle = f64::to_radians(5.0 * f64::from(k));
            let direction = Vector::new(angle.cos(), angle.sin());
            let reach = |tool: &Tool| {
                let reaches = tool.outline().iter().map(|part| {
                    let along = part.pose.local_vector(direction);
                    let own = match part.shape {
                        Shape::Cylinder { radius, .. } => radius,
                        Shape::Cuboid { size: [x, y, _] } => {
                            (x * along.x.abs() + y * along.y.abs()) / 2.0
                        }
                        Shape::Prism { base, .. } => base.extent(along),
                    };
                    part.pose.position.dot(&direction) + own
                });
                reaches.fold(f64::NEG_INFINITY, f64::max)
            };
            let (found, stated) = (reach(&value), reach(shipped));
            let what = format!("{} towards {angle}: {found} and {stated}", shipped.name);
            // Where two pieces overlap at an outer corner, the export shortens both by 10 mm, which
            // removes the tip.
            assert!((-0.0071..1e-9).contains(&(found - stated)), "{what}");
        }
    }
}
