//! The tool travels exactly along the motion, and pushes the objects in its path.

use pushplan::geometry::Vector;
use pushplan::{
    outcome::{Contact, Record},
    scene::{Body, Scene},
    task::Job,
};

use crate::fixtures::{can, engines, push};

#[test]
fn a_can_ends_one_slide_before_the_face_that_pushed_it() {
    let scene = Scene::new([can()]);
    for simulator in engines() {
        for speed in [0.03, 0.1, 0.3] {
            let motion = push(Vector::new(-0.0655, 0.0), 0.0, 0.2, speed);
            let trajectory =
                simulator.run(&scene, &Job::stated(&scene, motion.clone()), Record::Frames);
            let moving = &trajectory.frames[20];
            assert_eq!(moving.tool.position, Vector::new(-0.0655 + 0.2, 0.0));
            assert!((moving.time - 0.2 / speed).abs() < 1e-9);
            let face = 0.1345;
            let gap = moving.state.poses[0].position.x - 0.05 - face;
            assert!(gap.abs() < 3e-4, "{:?} {speed}: gap {gap}", simulator.engine());
            let slid = trajectory.outcome().poses[0].position.x - 0.05 - face;
            let expected = speed * speed / (2.0 * 0.45 * 9.81);
            assert!((slid - expected).abs() < 1e-3, "{speed}: {slid} for {expected}");
            let first = Contact { frame: 2, object: 0, with: Body::Part(0) };
            assert_eq!(trajectory.contacts, vec![first]);
        }
    }
}
