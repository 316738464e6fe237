//! Predictions of joints in a belief: repeated stops at limits, and possible outcomes.

use pushplan::effect::Prior;
use pushplan::geometry::{Pose, Vector};
use pushplan::{
    scene::{Engine, JointKind, Span},
    task::{Noise, Push, ToolMotion},
};
use pushplan_act::belief::{Belief, BeliefSettings, NO_STOP};

use crate::belief::{cylinders, pair, recorded};
use crate::believing::{EXACT, believed};

/// A joint that stopped is predicted to stop there again; its range to the other side stays
/// unknown.
#[test]
fn where_joints_stop_is_found_once_they_stopped_there() {
    let hinge = JointKind::Revolute { at: Vector::new(0.5, 0.037), limits: None };
    let slide = JointKind::Prismatic { axis: Vector::new(0.6, 0.8), limits: None };
    let slight = Noise { position: 1e-3, heading: 0.5f64.to_radians() };
    let cases = [
        (cylinders(Some(hinge)), 0.2, NO_STOP[0], vec![EXACT, slight]),
        // This pair presses only lightly against its stop, so it needs accurate observations.
        (pair(Some(slide)), 0.03, NO_STOP[1], vec![EXACT]),
    ];
    // At the far end of the second object, so that it rotates about the hinge.
    let push = Push { start: Vector::new(0.44, 0.086), direction: 0.0, length: 0.25, speed: 0.1 };
    for ((scene, motion), most, free, noises) in cases {
        let motion = ToolMotion::pushes(motion.tool, 0.0, 0.0, &[push], false);
        let stops = |limits: Option<Span>, noise, engine| {
            let mut scene = scene.clone();
            match &mut scene.joints[0].kind {
                JointKind::Revolute { limits: of, .. }
                | JointKind::Prismatic { limits: of, .. } => *of = limits,
                JointKind::Fixed => panic!("fixed"),
            }
            let recording = recorded(&scene, &motion, engine);
            believed(&recording, noise, 3).map().joints[0].limits()
        };
        let (mut seen, all) = (0, noises.len() * Engine::ALL.len());
        for (noise, engine) in noises.into_iter().flat_map(|n| Engine::ALL.map(|e| (n, e))) {
            assert_eq!(stops(None, EXACT, engine), None);
            let Some(found) = stops(Some(Span::new(-most, most)), noise, engine) else { continue };
            seen += 1;
            let (near, far) = match found.low > -free {
                true => (-found.low, found.high),
                false => (found.high, -found.low),
            };
            assert_eq!(far, free, "{found:?}");
            assert!(near < 0.1 * most + 5.0 * noise.position, "{noise:?}: {found:?}");
        }
        // Small differences decide whether the second object presses hard enough for a detectable
        // stop.
        let least = if most == 0.2 { all } else { 1 };
        assert!(seen >= least, "{seen} of {all} stops of {most}");
    }
}

/// Half of the near pairs are not joined. Before any observation the other object is therefore
/// predicted to stay; once the two are known to be one body, it is predicted to move along.
#[test]
fn predictions_are_medians_of_the_possible_outcomes() {
    let (scene, motion) = pair(Some(JointKind::Fixed));
    let model = Prior::default();
    let before = Belief::new(&scene, motion.tool.clone(), 0.0, BeliefSettings::new(EXACT));
    let start = scene.start().poses;
    let still = ToolMotion { strokes: Vec::new(), ..motion.clone() };
    assert_eq!(before.foresee(&model, &still), start);
    let away = Push { start: Vector::new(0.44, 0.01), direction: -0.6, length: 0.2, speed: 0.1 };
    let away = ToolMotion::pushes(motion.tool.clone(), 0.0, 0.0, &[away], false);
    let foreseen = before.foresee(&model, &away);
    assert_eq!(foreseen, before.foresee(&model, &away));
    assert!((foreseen[0].position - start[0].position).norm() > 0.05);
    assert_eq!(foreseen[1].position, start[1].position);

    let known = believed(&recorded(&scene, &motion, Engine::Planar), EXACT, 0);
    let end = known.situation().start.poses;
    let back = Push {
        start: Vector::new(1.2, end[0].position.y),
        direction: std::f64::consts::PI,
        length: 0.7,
        speed: 0.1,
    };
    let motion = ToolMotion::pushes(motion.tool, 0.0, 0.0, &[back], false);
    let foreseen = known.foresee(&model, &motion);
    let apart = |poses: &[Pose]| (poses[1].position - poses[0].position).norm();
    assert!((foreseen[0].position - end[0].position).norm() > 0.1);
    assert!((apart(&foreseen) - apart(&end)).abs() < 2e-3);
}
