//! A job gives identical bits, independent of the thread and of the other jobs.

use pushplan::effect::{EffectModel, Job, Simulated};
use pushplan::geometry::Vector;
use pushplan::{
    outcome::Record,
    scene::{JointKind, Scene},
};

use crate::fixtures::{brick, can, engines, push, row};

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let mut objects = vec![can(), brick()];
    objects[1].pose.position = Vector::new(0.09, 0.02);
    let revolute = |at| JointKind::Revolute { at, limits: None };
    let mut joined = row(6, &can(), 0.102, revolute);
    joined.joints[1].kind = JointKind::Fixed;
    joined.joints[3].kind = JointKind::Prismatic { axis: Vector::x(), limits: None };
    for scene in [Scene::new(objects), joined] {
        assert_same_bits(&scene);
    }
}

fn assert_same_bits(scene: &Scene) {
    let jobs: Vec<Job> = (0..12)
        .map(|k| {
            Job::stated(scene, push(Vector::new(-0.06, -0.05 + 0.01 * k as f64), 0.0, 0.15, 0.1))
        })
        .collect();
    for simulator in engines() {
        let model = Simulated::new(simulator);
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.expect("a pool").install(|| model.rollout(scene, &jobs, Record::Frames))
        };
        let (one, two) = (run(1), run(2));
        for (k, (a, b)) in one.iter().zip(&two).enumerate() {
            for (frame, (x, y)) in a.frames.iter().zip(&b.frames).enumerate() {
                assert_eq!(x, y, "{}: job {k} differs first in frame {frame}", model.spec());
            }
            assert_eq!(a, b);
        }
    }
}
