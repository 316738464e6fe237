//! Layout of the table of a random task. Every number is rounded in the units of task files, so
//! that a saved task is readable and identical bit by bit.

use std::f64::consts::TAU;

use pushplan::internals::geometry::{Footprint, Pose, Shape, Vector, clearance, swept_clearance};
use pushplan::internals::{
    scene::{Joint, JointKind, Obstacle, Ranges, Robot, Scene, State},
    task::{Demand, Goal, Task},
};
use pushplan_learn::dataset::{Crowd, Solids, random_scene};
use rand::Rng;
use rand_pcg::Pcg64;

use super::cluster::cluster;
use super::everyday::everyday_task;
use super::kind::TaskKind;
use super::one_push::{moderate, pushes};

/// Tolerance of the goals, metres, as in most shipped tasks.
pub(super) const TOLERANCE: f64 = 0.02;

/// Tolerance of headings, degrees.
const HEADING_TOLERANCE_DEG: f64 = 10.0;

/// Gap above which neighbours are not joined, metres.
const JOINED_GAP: f64 = 0.03;

/// Largest ratio of masses of joined objects; task files allow ten.
const JOINED_MASSES: f64 = 6.0;

/// Distance of an obstacle from every object at its start and from the goal object at its goal,
/// metres.
pub(super) const ROOM: f64 = 0.01;

/// Draws a task of a kind with its goals at the starts of their objects. Returns `None` if the draw
/// does not fit.
pub(super) fn open_task(rng: &mut Pcg64, kind: TaskKind, ordinal: usize) -> Option<Task> {
    if TaskKind::EVERYDAY.contains(&kind) {
        return everyday_task(rng, kind, ordinal);
    }
    let rules = kind.rules();
    let scene = match kind {
        TaskKind::Pair => pair(rng, ordinal),
        TaskKind::Cluster => cluster(rng, &Ranges { mass_ratio: JOINED_MASSES, ..moderate() }),
        TaskKind::Heading => one(rng, Solids::Cuboids),
        _ if ordinal.is_multiple_of(2) => one(rng, Solids::Cylinders),
        _ => one(rng, Solids::Cuboids),
    };
    let goal_object = rng.random_range(0..scene.objects.len());
    let (distance, angle) =
        (rng.random_range(rules.places.low..rules.places.high), rng.random_range(-1.2..1.2f64));
    let place = distance * Vector::new(angle.cos(), angle.sin());
    let scene = moved(scene, place, goal_object);
    let start = scene.objects[goal_object].pose;
    let mut goal = Goal::new(goal_object, start.position.into(), TOLERANCE);
    if kind == TaskKind::Heading {
        goal = goal
            .facing(start.heading, HEADING_TOLERANCE_DEG.to_radians())
            .looking_like(&scene.objects[goal_object].shape);
    }
    let name = format!("{kind}-{ordinal:04}");
    let task = Task::new(name, scene, Robot::reaching(0.1, rules.reach), goal);
    Some(task.pushing(pushes(rules.max_count)).described(kind.title()))
}

/// Sets every goal to the final pose of its object.
pub(super) fn set_goals(task: &mut Task, ends: &State) {
    let start = task.scene.start();
    for goal in &mut task.goals {
        let end = round_pose(&seen(goal, ends));
        let way = end.position - seen(goal, &start).position;
        for demand in &mut goal.demands {
            match demand {
                Demand::Area(own) => {
                    let at = own.area.pose.position + way;
                    own.area.pose.position = at.map(|x| round(x, 1e4));
                }
                Demand::Place(place) => place.position = end.position,
                Demand::Heading(facing) => facing.heading = end.heading,
                _ => {}
            }
        }
    }
}

/// Returns the pose of a goal's object relative to the goal's reference object.
pub(super) fn seen(goal: &Goal, state: &State) -> Pose {
    let own = state.poses[goal.object];
    goal.relative().map_or(own, |other| state.poses[other].inverse() * own)
}

/// Draws a wall across the straight path of the goal object, opposite `corner`, the side on which
/// the object passes. The wall is clear of all start poses and of the goal object's final pose.
/// Returns `None` if the draw does not fit.
pub(super) fn wall(
    rng: &mut Pcg64,
    scene: &Scene,
    object: usize,
    corner: Vector,
    end: &Pose,
) -> Option<Obstacle> {
    let start = scene.objects[object].pose;
    let way = end.position - start.position;
    let middle = start.position + way * rng.random_range(0.4..0.6);
    let along = (middle - corner).try_normalize(1e-9)?;
    let length = rng.random_range(0.08..0.24);
    let thickness = rng.random_range(0.02..0.05);
    let thin = inscribed(&scene.objects[object].shape);
    // The end next to the corner stands in the straight path, the rest beyond it.
    let near = rng.random_range(-0.9..0.9) * thin.bounding_radius();
    let middle = middle + along * (near + 0.5 * length);
    let heading = along.y.atan2(along.x) + rng.random_range(-0.3..0.3);
    let wall = Obstacle {
        name: "wall".to_owned(),
        size: [round(length, 1e3), round(thickness, 1e3), 0.1],
        pose: round_pose(&Pose { position: middle, heading }),
        z: 0.0,
        friction: 0.5,
    };
    let solid = wall.shape().footprint();
    let still = (&solid, &wall.pose);
    let ends = [(object, end)];
    let starts = scene.objects.iter().enumerate().map(|(k, object)| (k, &object.pose));
    let clear = starts.chain(ends).all(|(k, pose)| {
        let footprint = scene.objects[k].shape.footprint();
        clearance((&footprint, pose), still, 2.0 * ROOM) >= ROOM
    });
    let blocked = swept_clearance(&thin, &start, end, still, ROOM) <= 0.0;
    (clear && blocked).then_some(wall)
}

/// Returns the largest disc in the goal object: where it does not pass, the object does not pass at
/// any rotation.
pub(super) fn inscribed(shape: &Shape) -> Footprint {
    Footprint::Disc { radius: shape.footprint().inner_radius() }
}

fn one(rng: &mut Pcg64, solids: Solids) -> Scene {
    random_scene(rng, &moderate(), Crowd { count: 1, solids, touching: 0.0, polygons: 0.0 })
}

/// Draws two objects with a joint, whose kind alternates.
fn pair(rng: &mut Pcg64, ordinal: usize) -> Scene {
    let ranges = Ranges { mass_ratio: JOINED_MASSES, ..moderate() };
    loop {
        let crowd = Crowd { count: 2, solids: Solids::Any, touching: 0.0, polygons: 0.0 };
        let mut scene = random_scene(rng, &ranges, crowd);
        let [first, second] = [&scene.objects[0], &scene.objects[1]];
        let (a, b) = (first.shape.footprint(), second.shape.footprint());
        if clearance((&a, &first.pose), (&b, &second.pose), 2.0 * JOINED_GAP) > JOINED_GAP {
            continue;
        }
        let line = second.pose.position - first.pose.position;
        let kind = match ordinal % 3 {
            0 => JointKind::Fixed,
            1 => {
                // Midway between the two rims on the line of centres.
                let [near, far] = [(a, first.pose), (b, second.pose)].map(|(footprint, pose)| {
                    footprint.extent(pose.local_vector(line / line.norm()))
                });
                let share = (0.5 * (line.norm() + near - far) / line.norm()).clamp(0.0, 1.0);
                JointKind::Revolute { at: first.pose.position + line * share, limits: None }
            }
            _ => JointKind::Prismatic { axis: line / line.norm(), limits: None },
        };
        scene.joints.push(Joint::new([0, 1], kind));
        return scene;
    }
}

/// Returns the scene with every number rounded, moved so that object `index` stands at `place`.
fn moved(mut scene: Scene, place: Vector, index: usize) -> Scene {
    let turn = scene.objects[index].pose.heading;
    let from = Pose { position: scene.objects[index].pose.position, heading: 0.0 };
    let to = Pose { position: place, heading: 0.0 };
    let motion = to * from.inverse();
    scene.table_friction = round(scene.table_friction, 1e3);
    for (k, object) in scene.objects.iter_mut().enumerate() {
        object.mass = round(object.mass, 1e3);
        object.friction = round(object.friction, 1e3);
        object.shape = match object.shape {
            Shape::Cylinder { radius, height } => {
                Shape::Cylinder { radius: round(radius, 1e4), height: round(height, 1e4) }
            }
            Shape::Cuboid { size } => Shape::Cuboid { size: size.map(|side| round(side, 1e4)) },
            prism => prism,
        };
        let heading = if k == index { turn } else { object.pose.heading };
        object.pose = round_pose(&Pose { heading, ..motion * object.pose });
    }
    for joint in &mut scene.joints {
        if let JointKind::Revolute { at, .. } = &mut joint.kind {
            *at = motion.point(*at).map(|x| round(x, 1e4));
        }
    }
    scene
}

/// Rounds to tenths of a millimetre and of a degree.
pub(super) fn round_pose(pose: &Pose) -> Pose {
    let turn = pose.heading.rem_euclid(TAU).to_degrees();
    // Task files and pictures use -180 to 180 degrees.
    let turn = if turn > 180.0 { turn - 360.0 } else { turn };
    Pose { position: pose.position.map(|x| round(x, 1e4)), heading: round(turn, 10.0).to_radians() }
}

/// Returns the nearest multiple of 1 / `parts`.
pub(super) fn round(value: f64, parts: f64) -> f64 {
    (value * parts).round() / parts
}
