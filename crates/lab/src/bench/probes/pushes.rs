//! Random pushes of a round hand into a crowd.

use std::f64::consts::TAU;

use pushplan::internals::geometry::{Pose, Vector, perpendicular, travel_to_contact};
use pushplan::internals::{
    scene::{Scene, State},
    task::{Stroke, ToolMotion},
};
use pushplan_act::act::Probe;
use rand::Rng;
use rand_pcg::Pcg64;

/// Gap between the hand and the object that it touches first, metres.
const STAND_OFF: f64 = 0.01;

/// Speed of the hand, m/s.
const SPEED: f64 = 0.1;

/// Distance from which hands approach, metres.
const FAR: f64 = 2.0;

/// Draws a push of this length (metres) by the tool of `hand`. The tool touches the object first on
/// a straight path from outside, in any direction and with any offset.
pub fn random_push(
    rng: &mut Pcg64,
    (scene, state): (&Scene, &State),
    hand: &ToolMotion,
    length: f64,
) -> Probe {
    let footprint = hand.tool.parts()[0].shape.footprint();
    loop {
        let aimed = rng.random_range(0..scene.objects.len());
        let angle = rng.random_range(0.0..TAU);
        let along = Vector::new(angle.cos(), angle.sin());
        let wide =
            footprint.bounding_radius() + scene.objects[aimed].shape.footprint().inner_radius();
        let offset = wide * rng.random_range(-0.9..0.9);
        let far = state.poses[aimed].position - FAR * along + offset * perpendicular(along);
        let far = Pose { position: far, heading: 0.0 };
        let meets =
            scene.objects.iter().zip(&state.poses).enumerate().filter_map(|(k, (object, pose))| {
                let still = (&object.shape.footprint(), pose);
                travel_to_contact((&footprint, &far), along, still).map(|travel| (travel, k))
            });
        let Some((travel, object)) = meets.min_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
        let at = |travel: f64| Pose { position: far.position + travel * along, heading: 0.0 };
        let stroke = Stroke {
            from: at(travel - STAND_OFF),
            to: at(travel - STAND_OFF + length),
            duration: length / SPEED,
            settle: true,
        };
        return Probe { object, motion: ToolMotion { strokes: vec![stroke], ..hand.clone() } };
    }
}
