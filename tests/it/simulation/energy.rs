//! Kinetic energy comes from the tool alone.

use pushplan::geometry::{Pose, Vector};
use pushplan::{
    outcome::Record,
    scene::{Obstacle, Scene, State, Velocity},
    task::Job,
};

use crate::fixtures::{brick, can, engines, push};

fn kinetic(scene: &Scene, state: &State) -> f64 {
    let energy = scene.objects.iter().zip(&state.velocities).map(|(object, velocity)| {
        let rho = object.shape.footprint().gyration_radius();
        0.5 * object.mass * (velocity.linear.norm_squared() + (rho * velocity.angular).powi(2))
    });
    energy.sum()
}

#[test]
fn colliding_objects_never_gain_energy_while_the_tool_is_away() {
    let mut other = brick();
    other.pose = Pose::new(0.11, 0.02, 0.5);
    let mut third = can();
    third.name = "third".into();
    third.pose = Pose::new(0.22, -0.02, 0.0);
    third.mass = 0.1;
    let mut scene = Scene::new([can(), other, third]);
    scene.obstacles.push(Obstacle {
        name: "wall".into(),
        size: [0.02, 0.4, 0.1],
        pose: Pose::new(0.29, 0.0, 0.0),
        z: 0.0,
        friction: 0.5,
    });
    let start = State {
        velocities: vec![
            Velocity { linear: Vector::new(1.0, 0.1), angular: 5.0 },
            Velocity { linear: Vector::new(-0.3, 0.0), angular: -8.0 },
            Velocity::default(),
        ],
        ..scene.start()
    };
    // Frames of 10 ms, so that a collision cannot hide in one.
    let motion = push(Vector::new(-3.0, 0.0), 0.0, 0.6, 1.0);
    for simulator in engines() {
        let trajectory = simulator.run(
            &scene,
            &Job { start: start.clone(), ..Job::stated(&scene, motion.clone()) },
            Record::Frames,
        );
        let energies: Vec<f64> =
            trajectory.frames.iter().map(|frame| kinetic(&scene, &frame.state)).collect();
        assert!(trajectory.contacts.len() >= 2, "{:?}", trajectory.contacts);
        for (k, pair) in energies.windows(2).enumerate() {
            // 1 uJ is the energy of a gram at 4.5 cm/s: the noise of resting contacts stays below
            // it.
            assert!(
                pair[1] <= pair[0] + 1e-6,
                "{:?}: frame {k}: {} J becomes {} J",
                simulator.engine(),
                pair[0],
                pair[1]
            );
        }
        assert!(energies[energies.len() - 1] < 1e-6);
    }
}
