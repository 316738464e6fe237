//! The support model of an object determines its rotation, equally in both engines.

use std::sync::Arc;

use pushplan::geometry::{Pose, Vector, wrap_angle};
use pushplan::sim::Simulator;
use pushplan::{
    outcome::Record,
    scene::{Object, Part, Scene, Support, Tool},
    task::{Job, Push, ToolMotion},
};

use crate::fixtures::{brick, can};

/// Returns the final pose of an object at the origin that a narrow finger pushes by 15 cm, `aside`
/// metres beside its centre.
fn pushed(simulator: &Simulator, object: Object, aside: f64) -> Pose {
    pushed_at(simulator, object, aside, None)
}

fn pushed_at(simulator: &Simulator, object: Object, aside: f64, push_height: Option<f64>) -> Pose {
    let part = Part::cuboid("finger", [0.02, 0.02, 0.05], Pose::default());
    let tool = Arc::new(Tool::new("finger", [part]).expect("one piece"));
    let push = Push { start: Vector::new(-0.09, aside), direction: 0.0, length: 0.15, speed: 0.1 };
    let motion = ToolMotion::pushes(tool, 0.002, 0.0, &[push], true);
    let scene = Scene { push_height, ..Scene::new([object]) };
    let trajectory = simulator.run(&scene, &Job::stated(&scene, motion), Record::Outcome);
    trajectory.outcome().poses[0]
}

fn supports() -> [Support; 4] {
    let tripod = [(0.03, 0.0), (-0.02, 0.02), (-0.02, -0.015)];
    [
        Support::Even,
        Support::Corners,
        Support::Spread(0.75),
        Support::Points(tripod.map(|(x, y)| Vector::new(x, y)).to_vec()),
    ]
}

#[test]
fn the_same_points_lead_to_the_same_end_in_the_plane_and_in_3d_where_nothing_tips() {
    let mut apart = Vec::new();
    for support in supports() {
        for object in [can(), brick()] {
            for aside in [-0.02, -0.008, 0.013] {
                let object = object.clone().standing_on(support.clone());
                let [a, b] = [Simulator::planar(), Simulator::upright()]
                    .map(|simulator| pushed(&simulator, object.clone(), aside));
                assert!(a.position.norm() > 0.05, "{support:?} {aside}: {a:?}");
                apart.push((a.position - b.position).norm());
            }
        }
    }
    let mean = apart.iter().sum::<f64>() / apart.len() as f64;
    assert!(mean < 1.5e-3, "{mean}: {apart:?}");
}

#[test]
fn a_box_turns_the_less_the_farther_out_it_rests() {
    for simulator in [Simulator::planar(), Simulator::spatial(), Simulator::upright()] {
        let turns = [Support::Spread(0.3), Support::Even, Support::Corners].map(|support| {
            wrap_angle(pushed(&simulator, brick().standing_on(support), 0.012).heading).abs()
        });
        assert!(turns[0] > turns[1] && turns[1] > 1.1 * turns[2], "{turns:?}");
    }
}

/// A push R at height z must not tip an object of weight m g, so its load shifts by z R / (m g)
/// ahead. This reduces its rotation in an off-centre push.
#[test]
fn the_higher_a_push_the_less_it_turns_alike_in_the_plane_and_upright_in_3d() {
    let object = brick().standing_on(Support::Corners);
    let turn = |simulator: &Simulator, share: f64| {
        pushed_at(simulator, object.clone(), 0.012, Some(share)).heading.abs()
    };
    let [planar, upright] = [Simulator::planar(), Simulator::upright()]
        .map(|simulator| [0.0, 0.5, 1.0].map(|share| turn(&simulator, share)));
    for [low, middle, high] in [planar, upright] {
        assert!(low > 1.02 * middle && middle > 1.02 * high, "{planar:?} {upright:?}");
    }
    for (a, b) in planar.iter().zip(upright) {
        assert!((a - b).abs() < 0.01, "{planar:?} {upright:?}");
    }
}
