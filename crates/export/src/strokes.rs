//! Tool motions, as numbers for a script.

use pushplan::geometry::{Pose, Vector};
use pushplan::{
    scene::{Object, REST_SPEED, Scene},
    task::{COAST_FRAME, MAX_COAST_FRAMES, Task, ToolMotion, TravelLeg},
};

use super::xml::{Xml, numbers};

/// Clearance of a lifted tool above the tallest object, metres.
const ABOVE: f64 = 0.01;

/// Writes the strokes of the tool.
pub(super) fn strokes(xml: &mut Xml, motions: &[ToolMotion]) {
    xml.comment(
        "Start and end of the tool (x, y, x, y), duration, and whether it then waits; if it \
         rotates, its headings at both.",
    );
    let turns = turns(motions);
    let strokes = motions.iter().flat_map(|motion| &motion.strokes);
    for (index, stroke) in strokes.enumerate() {
        let (from, to) = (stroke.from.position, stroke.to.position);
        let settle = if stroke.settle { 1.0 } else { 0.0 };
        let mut values = vec![from.x, from.y, to.x, to.y, stroke.duration, settle];
        if turns {
            values.extend([stroke.from.heading, stroke.to.heading]);
        }
        numeric(xml, &format!("push {}", index + 1), &values);
    }
    xml.comment(
        "Speed below which an object rests, period of this check, and maximum number of checks.",
    );
    numeric(xml, "rest", &[REST_SPEED, COAST_FRAME, MAX_COAST_FRAMES as f64]);
}

/// Writes the retreat of the tool before it is lifted, and its lifting height.
pub(super) fn retreats(xml: &mut Xml, scene: &Scene, motions: &[ToolMotion]) {
    xml.comment("Distance of the retreat before the tool is lifted, and lifting height.");
    let each = motions.iter().flat_map(|motion| {
        (0..motion.strokes.len()).map(move |stroke| motion.retreat(scene, stroke))
    });
    for (index, back) in each.enumerate() {
        if let Some(back) = back {
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

/// Writes the travel of the lifted tools, and its height above the strokes.
pub(super) fn travel(
    xml: &mut Xml,
    task: &Task,
    (legs, motions): (&[TravelLeg], &[ToolMotion]),
    number: impl Fn(&str) -> f64,
) {
    let Some(first) = motions.first() else { return };
    xml.comment(
        "Travel height above the strokes, and whether tools rotate. Legs of the travel: step and \
         tool (from 1), heading, whether it begins and ends at a step, and positions of the tool. \
         Poses in which tools are lifted before they rotate.",
    );
    let turned = if turns(motions) { 1.0 } else { 0.0 };
    numeric(xml, "travel", &[(task.robot.travel - first.lift).max(0.0), turned]);
    for (k, leg) in legs.iter().enumerate() {
        let Some(motion) = motions.iter().find(|one| one.tool.name == leg.tool) else { continue };
        let tool = |position, heading| motion.tool.pose(Pose { position, heading });
        let [lifted, yaw] = leg.yaws;
        let step = leg.to.or(leg.from.map(|from| from + 1)).unwrap_or(0) + 1;
        let flag = |end: Option<usize>| if end.is_some() { 1.0 } else { 0.0 };
        let heading = tool(Vector::zeros(), yaw).heading;
        let mut values =
            vec![step as f64, number(&leg.tool), heading, flag(leg.from), flag(leg.to)];
        for corner in &leg.path {
            let position = tool(*corner, yaw).position;
            values.extend([position.x, position.y]);
        }
        numeric(xml, &format!("leg {}", k + 1), &values);
        if let Some(start) = leg.path.first().filter(|_| lifted != yaw) {
            let Pose { position, heading } = tool(*start, lifted);
            numeric(xml, &format!("turn {}", k + 1), &[position.x, position.y, heading]);
        }
    }
}

/// Returns `true` if any tool has more than one heading.
pub(super) fn turns(motions: &[ToolMotion]) -> bool {
    motions.iter().any(|motion| {
        let heading = motion.strokes.first().map_or(0.0, |stroke| stroke.from.heading);
        let all = motions.iter().filter(|other| other.tool.name == motion.tool.name);
        let mut strokes = all.flat_map(|motion| &motion.strokes);
        strokes.any(|s| s.from.heading != heading || s.to.heading != heading)
    })
}

/// Writes named numbers.
pub(super) fn numeric(xml: &mut Xml, name: &str, values: &[f64]) {
    xml.leaf("numeric", &[("name", name.into()), ("data", numbers(values))]);
}
