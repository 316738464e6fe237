//! What a tool does, as numbers that a script reads.

use crate::scene::{COAST_FRAME, MAX_COAST_FRAMES, Object, REST_SPEED, Scene, ToolMotion};

use super::xml::{Xml, numbers};

/// How far a tool that is lifted is above the tallest object, metres.
const ABOVE: f64 = 0.01;

/// What the tool does.
pub(super) fn strokes(xml: &mut Xml, motion: &ToolMotion) {
    xml.comment(
        "Where the tool begins and ends (x, y, x, y), how long it takes, whether it then waits; \
         where it turns, its headings there.",
    );
    let turns = turns(motion);
    for (index, stroke) in motion.strokes.iter().enumerate() {
        let (from, to) = (stroke.from.position, stroke.to.position);
        let settle = if stroke.settle { 1.0 } else { 0.0 };
        let mut values = vec![from.x, from.y, to.x, to.y, stroke.duration, settle];
        if turns {
            values.extend([stroke.from.heading, stroke.to.heading]);
        }
        numeric(xml, &format!("push {}", index + 1), &values);
    }
    xml.comment("Rest is slower than this; it is looked for this often, and this many times.");
    numeric(xml, "rest", &[REST_SPEED, COAST_FRAME, MAX_COAST_FRAMES as f64]);
}

/// How far the tool goes back before it is lifted, and how high it then goes.
pub(super) fn retreats(xml: &mut Xml, scene: &Scene, motion: &ToolMotion) {
    xml.comment("How far it goes back then, the way it came, before it is lifted, and how high.");
    for index in 0..motion.strokes.len() {
        if let Some(back) = motion.retreat(scene, index) {
            numeric(
                xml,
                &format!("retreat {}", index + 1),
                &[1e-9 * (1e9 * back.travel()).round()],
            );
        }
    }
    let heights = scene.objects.iter().map(Object::top);
    numeric(xml, "rise", &[heights.fold(0.0, f64::max) + ABOVE]);
}

/// Whether the tool has more than one heading. All strokes of a plan have one.
pub(super) fn turns(motion: &ToolMotion) -> bool {
    let heading = motion.strokes.first().map_or(0.0, |stroke| stroke.from.heading);
    motion.strokes.iter().any(|s| s.from.heading != heading || s.to.heading != heading)
}

/// Named numbers.
pub(super) fn numeric(xml: &mut Xml, name: &str, values: &[f64]) {
    xml.leaf("numeric", &[("name", name.into()), ("data", numbers(values))]);
}
