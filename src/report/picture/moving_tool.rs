//! The tool of a moving picture: it comes down, pushes, goes up, over and down again.

use crate::geometry::{Pose, Vector};
use crate::report::keyframes::{Key, short};
use crate::scene::ToolMotion;

use super::{
    palette,
    stage::{SEEN, Stage, clockwise, shift, turn},
    strokes,
    timeline::LIFT,
};

/// How much larger a tool looks that is lifted towards the viewer.
const LIFTED: f64 = 1.05;

/// The tool along its motion.
pub fn tool(stage: &mut Stage, motion: &ToolMotion) {
    let (places, lift) = keys(stage, motion);
    let Some(&(_, end)) = places.last() else { return };
    let (mut shifts, mut turns) = (Vec::new(), Vec::new());
    for &(at, grip) in &places {
        let place = stage.view.map(grip.position);
        shifts.push(Key { at, value: [place.x, place.y] });
        turns.push(Key { at, value: [clockwise(&grip)] });
    }
    stage.loops.animate("tool", &shifts, [SEEN; 2], shift);
    stage.loops.animate("yaw", &turns, [SEEN], turn);
    stage.loops.animate("lift", &lift, [0.01, 0.001], |[shown, size]| {
        format!("opacity:{};transform:scale({})", short(shown, 2), short(size, 3))
    });
    let place = stage.view.map(end.position);
    stage.svg.open_moved("tool", place, 0.0);
    stage.svg.open_moved("yaw", Vector::zeros(), clockwise(&end));
    stage.svg.open_shown("lift", palette::TOOL_LIFTED);
    let (own, centred) = (motion.tool.grip.inverse(), stage.view.centred());
    strokes::silhouette(&mut stage.svg, &centred, &motion.tool, &own, palette::TOOL_AT_WORK);
    strokes::hold(&mut stage.svg, &centred, &motion.tool, &own);
    stage.close(3);
}

/// Each push's arrow while it is made.
pub fn arrows(stage: &mut Stage, motion: &ToolMotion) {
    for (k, span) in stage.timeline.strokes.clone().iter().enumerate() {
        stage.open_between(&format!("a{k}"), span.start - LIFT, span.end, false);
        let view = stage.view;
        strokes::arrow(&mut stage.svg, &view, motion, k);
        stage.close(1);
    }
}

/// Poses of the end effector by time; opacity and size of the tool.
fn keys(stage: &Stage, motion: &ToolMotion) -> (Vec<(f64, Pose)>, Vec<Key<2>>) {
    let up = [palette::TOOL_LIFTED, LIFTED];
    let mut places: Vec<(f64, Pose)> = Vec::new();
    let mut lift = vec![Key { at: 0.0, value: [0.0, LIFTED] }];
    for (span, stroke) in stage.timeline.strokes.iter().zip(&motion.strokes) {
        let (from, to) = (stroke.from * motion.tool.grip, stroke.to * motion.tool.grip);
        match places.last().copied() {
            Some((before, pose)) if span.lowered => {
                let (above, over) = (before + LIFT, span.start - LIFT);
                lift.push(Key { at: before, value: [1.0, 1.0] });
                lift.extend([above, over].map(|at| Key { at, value: up }));
                places.extend([(above, pose), (over, from)]);
            }
            Some(_) => {}
            None => lift.push(Key { at: span.start - LIFT, value: [0.0, LIFTED] }),
        }
        if span.lowered {
            lift.push(Key { at: span.start, value: [1.0, 1.0] });
        }
        let stop = span.start + stroke.duration / stage.timeline.rate;
        places.extend([(span.start, from), (stop.min(span.end), to), (span.end, to)]);
    }
    if let Some(&(end, _)) = places.last() {
        lift.push(Key { at: end, value: [1.0, 1.0] });
        lift.push(Key { at: end + LIFT, value: up });
    }
    (places, lift)
}
