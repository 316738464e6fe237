//! Doors on hinges and drawers on slides.

use pushplan::internals::geometry::{Pose, Shape, Vector};
use pushplan::internals::{
    scene::{JointKind, Object, Obstacle, Scene, Span},
    task::Goal,
};
use rand::Rng;
use rand_pcg::Pcg64;

use super::everyday::{drawn, with_solids};
use super::layout::round;

/// Tolerance of doors, radians.
const AJAR: f64 = 5.0 * std::f64::consts::PI / 180.0;

/// Tolerance of drawers, metres.
const OUT: f64 = 0.015;

/// Share of drawers whose cabinet is free to move.
const FREE: f64 = 0.25;

/// Draws a door that stands ajar before its cabinet, and a goal for its rotation.
pub(super) fn door(rng: &mut Pcg64) -> (Scene, Vec<Goal>) {
    let width = drawn(rng, [0.20, 0.34]);
    let (front, middle) = (drawn(rng, [0.59, 0.72]), drawn(rng, [-0.15, 0.15]));
    // Side of the cabinet's middle opposite the hinge.
    let side = if rng.random() { 1.0 } else { -1.0 };
    let ajar = round(rng.random_range(20.0..45.0), 10.0);
    // Rotation from shut, along the cabinet, towards the robot.
    let heading = f64::to_radians(side * (90.0 + ajar));
    let mut limits = [-side * (ajar - 1.0), side * (105.0 - ajar)].map(f64::to_radians);
    limits.sort_by(f64::total_cmp);
    let at = Vector::new(front, round(middle - side * width / 2.0, 1e4));
    let centre = at + 0.5 * width * Vector::new(heading.cos(), heading.sin());
    let [x, y] = centre.map(|x| round(x, 1e6)).into();
    let door = Object::cuboid("door", [width, 0.02, 0.15])
        .mass(drawn(rng, [0.8, 3.0]))
        .friction(drawn(rng, [0.1, 0.4]))
        .at(x, y, heading);
    let hinge = JointKind::Revolute { at, limits: Some(Span::new(limits[0], limits[1])) };
    let size = [0.2, round(width + 0.06, 1e3), 0.15];
    let cabinet = Obstacle::cuboid("cabinet", size).at(round(front + 0.13, 1e3), middle, 0.0);
    let scene = Scene::new([door]).with_mount(0, hinge).with_obstacle(cabinet);
    (scene, vec![Goal::of(0).facing(heading, AJAR)])
}

/// Draws a drawer with a bar on a post, shut or pulled out, and a goal for its displacement.
pub(super) fn drawer(rng: &mut Pcg64) -> (Scene, Vec<Goal>) {
    let (width, depth) = (drawn(rng, [0.14, 0.26]), drawn(rng, [0.15, 0.22]));
    let (x, y) = (drawn(rng, [0.66, 0.74]), drawn(rng, [-0.2, 0.2]));
    let (shut, free) = (rng.random_bool(0.7), rng.random_bool(FREE));
    let cuboid = |x: f64, y: f64| Shape::Cuboid { size: [x, y, 0.1] };
    let before = |by: f64| Pose::new(round(-depth / 2.0 - by, 1e4), 0.0, 0.0);
    let parts = [
        ("post", cuboid(0.10, 0.02), before(0.05)),
        ("bar", cuboid(0.02, round(0.8 * width, 1e3)), before(0.11)),
    ];
    let limits = if shut { Span::new(0.0, round(0.8 * depth, 1e3)) } else { Span::new(-0.1, 0.05) };
    let slide = JointKind::Prismatic { axis: -Vector::x(), limits: Some(limits) };
    // A drawer that must be pushed in has room behind it.
    let back = x + depth / 2.0 + if shut { 0.01 } else { 0.12 };
    let heavy = drawn(rng, [10.0, 30.0]);
    let mass = match free {
        true => round(heavy / rng.random_range(8.0..18.0), 1e2),
        false => drawn(rng, [0.5, 2.5]),
    };
    let drawer = Object::new("drawer", cuboid(depth, width)).mass(mass);
    let drawer = drawer.friction(drawn(rng, [0.1, 0.3])).at(x, y, 0.0);
    let goal = Goal::new(0, [x, y], OUT);
    if free {
        let cabinet = Object::cuboid("cabinet", [0.16, 0.2, 0.1]).mass(heavy).friction(0.6);
        let scene = Scene::new([drawer, cabinet.at(round(back + 0.08, 1e3), y, 0.0)]);
        let scene = with_solids(scene.with_joint([1, 0], slide), &parts);
        return (scene, vec![goal.relative_to(1)]);
    }
    let mut scene = with_solids(Scene::new([drawer]), &parts);
    let front = x - depth / 2.0 + 0.01;
    for (name, side) in [("left", 1.0), ("right", -1.0)] {
        let aside = round(y + side * (width / 2.0 + 0.015), 1e4);
        let wall = Obstacle::cuboid(name, [round(back - front, 1e4), 0.02, 0.12]);
        scene = scene.with_obstacle(wall.at(round((front + back) / 2.0, 1e4), aside, 0.0));
    }
    (scene.with_mount(0, slide), vec![goal])
}
