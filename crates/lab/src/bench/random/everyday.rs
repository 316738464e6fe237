//! Everyday tasks: compound objects, goals of every kind, obstructed goals.

use pushplan::internals::geometry::{
    ConvexPolygon, Pose, Shape, Vector, clearance, swept_clearance,
};
use pushplan::internals::{
    scene::{Object, Obstacle, Robot, Scene},
    task::{Goal, Task, ToolChoice},
};
use rand::Rng;
use rand_pcg::Pcg64;

use super::furniture::{door, drawer};
use super::kind::TaskKind;
use super::layout::{ROOM, TOLERANCE, inscribed, round, round_pose};
use super::one_push::pushes;

/// Distance between objects that are moved separately, metres.
const APART: f64 = 0.22;

/// Number of places that are tried for an object.
const PLACES: usize = 200;

/// Name of the wall behind an obstructed goal.
const WALL: &str = "wall";

/// Tolerance of headings, radians.
const TURN: f64 = 10.0 * std::f64::consts::PI / 180.0;

/// Draws a task of a kind with its goals at the starts of their objects. Returns `None` if the draw
/// does not fit.
pub(super) fn everyday_task(rng: &mut Pcg64, kind: TaskKind, ordinal: usize) -> Option<Task> {
    let rules = kind.rules();
    let mut robot = Robot::reaching(0.1, rules.reach);
    let mut tools = ToolChoice::All;
    let (scene, goals) = match kind {
        TaskKind::Door => door(rng),
        TaskKind::Drawer => drawer(rng),
        TaskKind::Compound => {
            let scene = compound(rng);
            let goal = place(&scene, 0, TOLERANCE).facing(scene.objects[0].pose.heading, TURN);
            (scene, vec![goal])
        }
        TaskKind::Turn => {
            let scene = if rng.random() { compound(rng) } else { solids(rng, 1)? };
            let round = scene.objects.len() == 1 && scene.objects[0].shape.is_cylinder();
            let goal = Goal::of(0).facing(scene.objects[0].pose.heading, 0.5 * TURN);
            (!round).then_some((scene, vec![goal]))?
        }
        TaskKind::Region => {
            let scene = solids(rng, 1)?;
            let goal = region(rng, &scene)?;
            (scene, vec![goal])
        }
        TaskKind::Relative => {
            let scene = solids(rng, 2)?;
            let goal = place(&scene, 0, 0.015).relative_to(1);
            (scene, vec![goal])
        }
        TaskKind::TwoGoals | TaskKind::ThreeGoals => {
            let count = if kind == TaskKind::TwoGoals { 2 } else { 3 };
            let scene = solids(rng, count)?;
            let goals = (0..count).map(|k| place(&scene, k, TOLERANCE)).collect();
            (scene, goals)
        }
        TaskKind::TwoTools => {
            robot = Robot::reaching(0.3, rules.reach);
            tools = ToolChoice::Named(["finger", "l-hook"].map(str::to_owned).to_vec());
            let scene = rails(rng);
            let goals = [0, 1].map(|k| place(&scene, k, TOLERANCE)).to_vec();
            (scene, goals)
        }
        _ => blocked(rng, kind.aside())?,
    };
    let mut goals = goals.into_iter();
    let task = Task::new(format!("{kind}-{ordinal:04}"), scene, robot, goals.next()?);
    let task = goals.fold(task, Task::and);
    let task = Task { tools, ..task.pushing(pushes(rules.max_count)) };
    Some(task.described(kind.title()))
}

/// Returns `true` if all intended obstructions of the goal's object are effective at the start, and
/// the first of them cannot be pushed ahead to the wall.
pub(super) fn all_in_the_way(task: &Task, kind: TaskKind, end: &Pose) -> bool {
    if kind.aside() == 0 {
        return true;
    }
    let Scene { objects, obstacles, .. } = &task.scene;
    let own = &objects[task.goals[0].object];
    let thin = inscribed(&own.shape);
    let blocks = |crate_: &Object| {
        let still = (&crate_.shape.footprint(), &crate_.pose);
        swept_clearance(&thin, &own.pose, end, still, ROOM) <= 0.0
    };
    let narrow = 2.0 * objects[1].shape.footprint().inner_radius();
    let leaves_room = |wall: &Obstacle| {
        clearance((&thin, end), (&wall.shape().footprint(), &wall.pose), narrow) >= narrow
    };
    let wall = obstacles.iter().find(|one| one.name == WALL);
    objects[1..].iter().all(blocks) && wall.is_some_and(|wall| !leaves_room(wall))
}

/// Returns the task as read back from its own file; `None` if the file is refused.
pub(super) fn as_filed(task: &Task) -> Option<Task> {
    Task::parse(&task.to_yaml().ok()?, &task.name).ok()
}

/// Draws a multiple of a thousandth in a range.
pub(super) fn drawn(rng: &mut Pcg64, [low, high]: [f64; 2]) -> f64 {
    round(rng.random_range(low..high), 1e3)
}

/// Returns a goal at the pose of an object.
fn place(scene: &Scene, object: usize, tolerance: f64) -> Goal {
    Goal::new(object, scene.objects[object].pose.position.into(), tolerance)
}

/// Draws a goal in a region around the first object, slightly off its middle.
fn region(rng: &mut Pcg64, scene: &Scene) -> Option<Goal> {
    let height = 1.0;
    let shape = match rng.random_range(0..3u8) {
        0 => Shape::Cylinder { radius: drawn(rng, [0.05, 0.08]), height },
        1 => Shape::Cuboid { size: [drawn(rng, [0.1, 0.2]), drawn(rng, [0.08, 0.15]), height] },
        _ => {
            let half = drawn(rng, [0.07, 0.1]);
            let corners = [[-half, -0.06], [half, -0.06], [0.0, 0.1]].map(Vector::from);
            let base = ConvexPolygon::new(&corners).ok()?;
            Shape::Prism { base, height }
        }
    };
    let aside = Vector::new(drawn(rng, [-0.03, 0.03]), drawn(rng, [-0.02, 0.02]));
    let position = scene.objects[0].pose.position + aside;
    let heading = rng.random_range(-1.5..1.5);
    Some(Goal::within(0, shape, round_pose(&Pose { position, heading })))
}

/// Draws a can or a box.
fn solid(rng: &mut Pcg64, number: usize) -> Object {
    let height = drawn(rng, [0.04, 0.1]);
    let shape = match rng.random() {
        true => Shape::Cylinder { radius: drawn(rng, [0.025, 0.05]), height },
        false => {
            Shape::Cuboid { size: [drawn(rng, [0.05, 0.12]), drawn(rng, [0.05, 0.1]), height] }
        }
    };
    pushed_by_hand(rng, Object::new(format!("thing-{}", number + 1), shape))
}

/// Returns the object with a random mass and friction value of everyday objects.
fn pushed_by_hand(rng: &mut Pcg64, object: Object) -> Object {
    object.mass(drawn(rng, [0.15, 1.0])).friction(drawn(rng, [0.3, 0.6]))
}

/// Draws this many cans and boxes, well apart.
fn solids(rng: &mut Pcg64, count: usize) -> Option<Scene> {
    let mut objects: Vec<Object> = Vec::new();
    for k in 0..count {
        let object = solid(rng, k);
        let pose = (0..PLACES).map(|_| on_the_table(rng)).find(|pose| {
            let off = |other: &Object| (pose.position - other.pose.position).norm();
            objects.iter().all(|other| off(other) >= APART)
        })?;
        objects.push(Object { pose, ..object });
    }
    Some(Scene::new(objects))
}

/// Draws a pose in front of the robot.
fn on_the_table(rng: &mut Pcg64) -> Pose {
    let position = Vector::new(drawn(rng, [0.42, 0.62]), drawn(rng, [-0.22, 0.22]));
    round_pose(&Pose { position, heading: rng.random_range(-3.1..3.1) })
}

/// Draws a mug, a T, an L, a dumb-bell or a tray with two rims.
fn compound(rng: &mut Pcg64) -> Scene {
    let height = drawn(rng, [0.04, 0.1]);
    let cuboid = |x: f64, y: f64, z: f64| Shape::Cuboid { size: [x, y, z] };
    let at = |x: f64, y: f64| Pose::new(round(x, 1e4), round(y, 1e4), 0.0);
    let (shape, parts) = match rng.random_range(0..5u8) {
        0 => {
            let (radius, length) = (drawn(rng, [0.03, 0.045]), drawn(rng, [0.02, 0.04]));
            let handle = cuboid(length, 0.015, height);
            let shape = Shape::Cylinder { radius, height };
            (shape, vec![("handle", handle, at(radius + length / 2.0 - 0.003, 0.0))])
        }
        letter @ 1..=2 => {
            let (long, wide) = (drawn(rng, [0.1, 0.16]), drawn(rng, [0.025, 0.04]));
            let leg = drawn(rng, [0.05, 0.1]);
            let aside = if letter == 1 { 0.0 } else { (long - wide) / 2.0 };
            let part = cuboid(wide, leg, height);
            (cuboid(long, wide, height), vec![("leg", part, at(aside, -(wide + leg) / 2.0))])
        }
        3 => {
            let (radius, length) = (drawn(rng, [0.025, 0.04]), drawn(rng, [0.06, 0.1]));
            let shape = Shape::Cylinder { radius, height };
            let bar = ("bar", cuboid(length, 0.02, height), at(radius + length / 2.0 - 0.004, 0.0));
            (shape, vec![bar, ("end", shape, at(2.0 * radius + length - 0.008, 0.0))])
        }
        _ => {
            let (long, wide) = (drawn(rng, [0.1, 0.16]), drawn(rng, [0.08, 0.12]));
            let rim = |name, side: f64| {
                (name, cuboid(0.015, wide, 0.05), at(side * (long - 0.015) / 2.0, 0.0))
            };
            (cuboid(long, wide, 0.02), vec![rim("rim-1", -1.0), rim("rim-2", 1.0)])
        }
    };
    let whole = pushed_by_hand(rng, Object::new("thing", shape));
    with_solids(Scene::new([Object { pose: on_the_table(rng), ..whole }]), &parts)
}

/// Returns the scene with these solids fixed to its first object, whose mass is spread over all by
/// volume.
pub(super) fn with_solids(mut scene: Scene, parts: &[(&str, Shape, Pose)]) -> Scene {
    let whole = scene.objects[0].clone();
    let volume = |shape: &Shape| shape.footprint().area() * shape.height();
    let further: f64 = parts.iter().map(|(_, shape, _)| volume(shape)).sum();
    let all = volume(&whole.shape) + further;
    let mass = |shape: &Shape| whole.mass * (volume(shape) / all);
    scene.objects[0].mass = mass(&whole.shape);
    parts.iter().fold(scene, |scene, (name, shape, place)| {
        let name = format!("{}/{name}", whole.name);
        let part = Object::new(name, *shape).mass(mass(shape)).friction(whole.friction);
        scene.with_part(0, part, *place)
    })
}

/// Draws a can beyond the hand's reach, which a hook must pull nearer, and a puck between two rails
/// that are too narrow for the hook.
fn rails(rng: &mut Pcg64) -> Scene {
    let side = if rng.random() { 1.0 } else { -1.0 };
    let can = Shape::Cylinder { radius: drawn(rng, [0.03, 0.045]), height: 0.1 };
    let radius = drawn(rng, [0.02, 0.03]);
    let puck = Shape::Cylinder { radius, height: 0.06 };
    let far = Vector::new(drawn(rng, [0.82, 0.9]), side * drawn(rng, [0.12, 0.2]));
    let near = Vector::new(drawn(rng, [0.37, 0.4]), -side * drawn(rng, [0.17, 0.22]));
    let apart = radius + drawn(rng, [0.008, 0.012]) + 0.015;
    let can = pushed_by_hand(rng, Object::new("can", can)).at(far.x, far.y, 0.0);
    let puck = pushed_by_hand(rng, Object::new("puck", puck)).at(near.x, near.y, 0.0);
    let rail = |name, aside: f64| {
        Obstacle::cuboid(name, [0.3, 0.03, 0.06]).at(0.42, round(near.y + aside, 1e4), 0.0)
    };
    Scene::new([can, puck])
        .with_obstacle(rail("rail-1", apart))
        .with_obstacle(rail("rail-2", -apart))
}

/// Draws a can, its goal before a wall, one crate at the goal and others on the way.
fn blocked(rng: &mut Pcg64, crates: usize) -> Option<(Scene, Vec<Goal>)> {
    let goal = Vector::new(drawn(rng, [0.75, 0.86]), drawn(rng, [-0.15, 0.15]));
    let radius = drawn(rng, [0.03, 0.04]);
    let start =
        Vector::new(drawn(rng, [0.44, 0.56]), round(goal.y + drawn(rng, [-0.12, 0.12]), 1e3));
    let can = Object::new("can", Shape::Cylinder { radius, height: 0.1 });
    let mut objects = vec![pushed_by_hand(rng, can).at(start.x, start.y, 0.0)];
    let wall = Obstacle::cuboid(WALL, [0.02, 0.34, 0.1]).at(round(goal.x + 0.09, 1e3), goal.y, 0.0);
    for k in 0..crates {
        let narrow = if k == 0 { 0.055 } else { 0.04 };
        let size = [drawn(rng, [narrow, 0.08]), drawn(rng, [narrow, 0.08]), 0.08];
        let shape = Shape::Cuboid { size };
        let around = shape.footprint().bounding_radius();
        let crate_ = Object::new(format!("crate-{}", k + 1), shape).mass(drawn(rng, [0.2, 0.8]));
        let place = (0..PLACES).find_map(|_| {
            let share = if k == 0 { 1.0 } else { rng.random_range(0.25..0.8) };
            let aside = Vector::new(drawn(rng, [-0.01, 0.01]), drawn(rng, [-0.05, 0.05]));
            let at = (start + share * (goal - start) + aside).map(|x| round(x, 1e3));
            let clear = |other: &Object| {
                let room = around + other.shape.footprint().bounding_radius() + ROOM;
                (at - other.pose.position).norm() > room
            };
            let before = at.x + 0.5 * size[0] < wall.pose.position.x - 0.01 - ROOM;
            (before && objects.iter().all(clear)).then_some(at)
        })?;
        objects.push(crate_.at(place.x, place.y, 0.0));
    }
    Some((Scene::new(objects).with_obstacle(wall), vec![Goal::new(0, goal.into(), TOLERANCE)]))
}
