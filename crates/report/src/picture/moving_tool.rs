//! The tool of an animation: it is lowered, pushes, is lifted, moves over and is lowered again.

use crate::keyframes::{Key, short};
use pushplan::geometry::{Pose, Vector};
use pushplan::scene::Tool;

use super::{
    palette,
    stage::{SEEN, Stage, clockwise, shift, turn},
    strokes::{self, Made},
    timeline::LIFT,
};

/// Scale of a lifted tool, which is nearer to the viewer.
const LIFTED: f64 = 1.05;

/// Draws the tools along their motions.
pub fn tools(stage: &mut Stage, made: &[Made]) {
    let mut shown: Vec<&Tool> = Vec::new();
    for (tool, _) in made {
        if !shown.iter().any(|known| known.name == tool.name) {
            one(stage, made, tool, shown.len());
            shown.push(tool);
        }
    }
}

/// Draws the tool of number `index` along its motion.
fn one(stage: &mut Stage, made: &[Made], tool: &Tool, index: usize) {
    let (places, lift) = keys(stage, made, tool);
    let class = |name: &str| match index {
        0 => name.to_owned(),
        _ => format!("{name}{index}"),
    };
    let Some(&(_, end)) = places.last() else { return };
    let (mut shifts, mut turns) = (Vec::new(), Vec::new());
    for &(at, grip) in &places {
        let place = stage.view.map(grip.position);
        shifts.push(Key { at, value: [place.x, place.y] });
        turns.push(Key { at, value: [clockwise(&grip)] });
    }
    stage.loops.animate(&class("tool"), &shifts, [SEEN; 2], shift);
    stage.loops.animate(&class("yaw"), &turns, [SEEN], turn);
    stage.loops.animate(&class("lift"), &lift, [0.01, 0.001], |[shown, size]| {
        format!("opacity:{};transform:scale({})", short(shown, 2), short(size, 3))
    });
    let place = stage.view.map(end.position);
    stage.svg.open_moved(&class("tool"), place, 0.0);
    stage.svg.open_moved(&class("yaw"), Vector::zeros(), clockwise(&end));
    stage.svg.open_shown(&class("lift"), palette::TOOL_LIFTED);
    let (own, centred) = (tool.grip.inverse(), stage.view.centred());
    strokes::silhouette(&mut stage.svg, &centred, tool, &own, palette::TOOL_AT_WORK);
    strokes::hold(&mut stage.svg, &centred, tool, &own);
    stage.close(3);
}

/// Draws the arrow of each push during the push.
pub fn arrows(stage: &mut Stage, made: &[Made]) {
    for (k, (span, made)) in stage.timeline.strokes.clone().iter().zip(made).enumerate() {
        stage.open_between(&format!("a{k}"), span.start - LIFT, span.end, false);
        let view = stage.view;
        strokes::arrow(&mut stage.svg, &view, made);
        stage.close(1);
    }
}

/// Returns the poses over time of the end effector that holds `tool`, and the tool's opacity and
/// scale.
fn keys(stage: &Stage, made: &[Made], tool: &Tool) -> (Vec<(f64, Pose)>, Vec<Key<2>>) {
    let (up, gone) = ([palette::TOOL_LIFTED, LIFTED], [0.0, LIFTED]);
    let mut places: Vec<(f64, Pose)> = Vec::new();
    let mut lift = vec![Key { at: 0.0, value: gone }];
    let mut held = false;
    for (span, (of, stroke)) in stage.timeline.strokes.iter().zip(made) {
        if of.name != tool.name {
            // Another tool is picked up.
            if let (true, Some(&(before, _))) = (held, places.last()) {
                lift.push(Key { at: before, value: [1.0, 1.0] });
                lift.push(Key { at: before + LIFT, value: gone });
            }
            held = false;
            continue;
        }
        let (from, to) = (stroke.from * tool.grip, stroke.to * tool.grip);
        match places.last().copied() {
            Some((before, pose)) if span.lowered && held => {
                let (above, over) = (before + LIFT, span.start - LIFT);
                lift.push(Key { at: before, value: [1.0, 1.0] });
                lift.extend([above, over].map(|at| Key { at, value: up }));
                places.extend([(above, pose), (over, from)]);
            }
            Some(_) if held => {}
            last => {
                lift.push(Key { at: span.start - LIFT, value: gone });
                places.extend(last.map(|_| (span.start - LIFT, from)));
            }
        }
        held = true;
        if span.lowered {
            lift.push(Key { at: span.start, value: [1.0, 1.0] });
        }
        let stop = span.start + stroke.duration / stage.timeline.rate;
        places.extend([(span.start, from), (stop.min(span.end), to), (span.end, to)]);
    }
    if let (true, Some(&(end, _))) = (held, places.last()) {
        lift.push(Key { at: end, value: [1.0, 1.0] });
        lift.push(Key { at: end + LIFT, value: up });
    }
    (places, lift)
}
