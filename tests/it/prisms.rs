//! Objects on convex polygons, consistent in the analytic model and in the 2-D and 3-D engines.

use std::path::Path;
use std::sync::Arc;

use pushplan::asset::ToolLibrary;
use pushplan::effect::Prior;
use pushplan::geometry::{ConvexPolygon, Pose, Vector, wrap_angle};
use pushplan::solve::{Effort, PlanStatus, Planner};
use pushplan::{
    scene::{Object, Obstacle, Part, Scene, Support, Tool},
    task::{Push, Task, ToolMotion},
};

use crate::fixtures::{end, models, push};

fn polygon(corners: &[[f64; 2]]) -> ConvexPolygon {
    let corners: Vec<Vector> = corners.iter().map(|[x, y]| Vector::new(*x, *y)).collect();
    ConvexPolygon::new(&corners).expect("convex")
}

fn triangle() -> Object {
    Object::prism("triangle", polygon(&[[0.0, 0.0], [0.09, 0.0], [0.0, 0.06]]), 0.05)
}

fn hexagon() -> Object {
    let angle = |k: u32| std::f64::consts::FRAC_PI_3 * f64::from(k);
    let corners: Vec<[f64; 2]> =
        (0..6).map(|k| [0.04 * angle(k).cos(), 0.04 * angle(k).sin()]).collect();
    Object::prism("hexagon", polygon(&corners), 0.05)
}

/// Returns a rectangle of 10 x 6 cm with a weight at one end.
fn loaded() -> Object {
    let corners = [[0.0, 0.0], [0.10, 0.0], [0.10, 0.06], [0.0, 0.06]];
    let corners = corners.map(|[x, y]| Vector::new(x, y));
    let base = ConvexPolygon::balanced(&corners, Vector::new(0.065, 0.03)).expect("inside");
    Object::prism("loaded", base, 0.05)
}

fn square() -> ConvexPolygon {
    polygon(&[[0.0, 0.0], [0.07, 0.0], [0.07, 0.07], [0.0, 0.07]])
}

/// Returns a push of 15 cm along x by a narrow finger, `aside` metres off the origin.
fn finger(aside: f64) -> ToolMotion {
    let part = Part::cuboid("finger", [0.02, 0.02, 0.05], Pose::default());
    let tool = Arc::new(Tool::new("finger", [part]).expect("one piece"));
    let push = Push { start: Vector::new(-0.12, aside), direction: 0.0, length: 0.15, speed: 0.1 };
    ToolMotion::pushes(tool, 0.002, 0.0, &[push], true)
}

#[test]
fn a_square_written_as_a_prism_moves_as_the_cuboid_does() {
    let own = Object::prism("square", square(), 0.05).standing_on(Support::Spread(0.7));
    let other = Object::cuboid("square", [0.07, 0.07, 0.05]).standing_on(Support::Spread(0.7));
    let post = Obstacle::cuboid("post", [0.04, 0.04, 0.1]).at(0.12, 0.07, 0.4);
    for (name, model) in models() {
        for (aside, heading) in [(0.0, 0.0), (0.012, 0.3), (-0.02, 0.7)] {
            let ends = [&own, &other].map(|object| {
                let neighbour = Object::cylinder("can", 0.03, 0.05).at(0.075, -0.02, 0.0);
                let scene = Scene::new([object.clone().at(0.0, 0.0, heading), neighbour])
                    .with_obstacle(post.clone());
                end(&*model, &scene, &finger(aside))
            });
            for (a, b) in ends[0].poses.iter().zip(&ends[1].poses) {
                let apart = (a.position - b.position).norm();
                // If bodies tip, the engine determines the height of contact on a face.
                let (within, askew) = if name == "spatial" { (3e-3, 0.05) } else { (1e-3, 0.02) };
                assert!(apart < within, "{name} {aside} {heading}: {apart}");
                let turned = wrap_angle(a.heading - b.heading).abs();
                assert!(turned < askew, "{name} {aside} {heading}: {turned}");
            }
            assert!(ends[0].poses[0].position.norm() > 0.04, "{name}");
        }
    }
}

#[test]
fn shipped_tasks_with_prisms_are_solved() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let planner = Planner::for_effort(Effort::Standard).expect("shipped weights").build();
    for name in ["triangle-turned", "hexagon-any-side"] {
        let path = Path::new(crate::ROOT).join(format!("tasks/{name}.yaml"));
        let task = Task::load(path).expect("a shipped task");
        let solution = planner.solve(&task, &library).expect("a sound task");
        assert_eq!(solution.status, PlanStatus::Solved, "{name}");
        assert_eq!(solution.warnings, [], "{name}");
    }
}

#[test]
fn pushed_through_its_centre_of_mass_an_object_goes_straight() {
    // An arrow head that moves backwards: its straight side is across the push.
    let arrow = || Object::prism("arrow", polygon(&[[0.0, 0.0], [0.09, 0.04], [0.0, 0.08]]), 0.05);
    for (name, model) in models() {
        for object in [arrow(), hexagon().at(0.0, 0.0, 0.5f64.to_radians()), loaded()] {
            let straight = object.name != "hexagon";
            let scene = Scene::new([object]);
            for motion in [finger(0.0), push(Vector::new(-0.12, 0.0), 0.0, 0.15, 0.1)] {
                let pose = end(&*model, &scene, &motion).poses[0];
                assert!(pose.position.x > 0.03, "{name} {pose:?}");
                if straight {
                    assert!(pose.position.y.abs() < 1e-3, "{name} {pose:?}");
                    assert!(pose.heading.abs() < 0.02, "{name} {pose:?}");
                }
            }
        }
    }
}

#[test]
fn the_plane_agrees_with_3d_and_the_prior_with_both() {
    let (mut upright, mut prior) = (Vec::new(), Vec::new());
    for object in [triangle(), hexagon(), loaded()] {
        for support in [Support::Even, Support::Corners] {
            for (aside, heading) in [(-0.015, 0.4), (-0.005, 2.0), (0.01, 3.7)] {
                let object = object.clone().standing_on(support.clone()).at(0.0, 0.0, heading);
                let scene = Scene::new([object]);
                let [a, b, c, _] =
                    models().map(|(_, model)| end(&*model, &scene, &finger(aside)).poses[0]);
                assert!(b.position.norm() > 0.03, "{b:?}");
                upright.push((c.position - b.position).norm());
                prior.push((a.position - b.position).norm());
            }
        }
    }
    let mean = |apart: &[f64]| apart.iter().sum::<f64>() / apart.len() as f64;
    assert!(mean(&upright) < 1.5e-3, "{}: {upright:?}", mean(&upright));
    assert!(mean(&prior) < 5e-3, "{}: {prior:?}", mean(&prior));
}

#[test]
fn the_prior_sees_neither_the_worlds_axes_nor_their_handedness_nor_the_first_corner() {
    let flip = |v: Vector| Vector::new(v.x, -v.y);
    let mirrored = |pose: &Pose| Pose { position: flip(pose.position), heading: -pose.heading };
    let prior = Prior::default();
    for (object, aside) in [(triangle(), 0.01), (hexagon(), -0.02), (loaded(), 0.02)] {
        let object = object.at(0.0, 0.0, 0.7);
        let neighbour = triangle().at(0.10, 0.02, 2.0);
        let scene = Scene::new([object, neighbour]);
        let here = end(&prior, &scene, &finger(aside));

        let by = Pose::new(0.3, -0.2, 0.7);
        let mut turned = scene.clone();
        turned.objects.iter_mut().for_each(|object| object.pose = by * object.pose);
        let mut motion = finger(aside);
        for stroke in &mut motion.strokes {
            (stroke.from, stroke.to) = (by * stroke.from, by * stroke.to);
        }
        let there = end(&prior, &turned, &motion);
        for (a, b) in here.poses.iter().zip(&there.poses) {
            assert!(((by * *a).position - b.position).norm() < 1e-8, "{a:?} {b:?}");
        }

        let mut other = scene.clone();
        for object in &mut other.objects {
            let base = match object.shape {
                pushplan::Shape::Prism { base, .. } => base,
                _ => unreachable!("all are prisms"),
            };
            let mut corners: Vec<Vector> = base.corners().iter().copied().map(flip).collect();
            corners.rotate_left(1);
            let base = ConvexPolygon::balanced(&corners, Vector::zeros()).expect("convex");
            object.shape = pushplan::Shape::Prism { base, height: 0.05 };
            object.pose = mirrored(&object.pose);
        }
        let there = end(&prior, &other, &finger(-aside));
        for (a, b) in here.poses.iter().zip(&there.poses) {
            assert!((mirrored(a).position - b.position).norm() < 1e-8, "{a:?} {b:?}");
        }
        assert!(here.poses[0].position.norm() > 0.03);
    }
}
