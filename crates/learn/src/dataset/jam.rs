//! Detection of jams.
//!
//! A jam is an object squeezed between the tool and an obstacle. Rigid-body engines have no
//! solution for it and planners avoid it, so strokes end before it.

use pushplan::internals::geometry::{Footprint, Pose, contact_points, swept_clearance};
use pushplan::internals::{
    outcome::Frame,
    scene::{Scene, Tool},
    task::{Stroke, ToolMotion},
};

/// Overlap above which bodies are jammed, metres. Contacts under ordinary load overlap by a tenth
/// of it.
const JAMMED: f64 = 1e-3;

/// Returns the last stroke, ended one frame before a jam; `None` without a jam.
pub(super) fn shortened_before_jam(
    scene: &Scene,
    motion: &ToolMotion,
    frames: &[Frame],
) -> Option<Stroke> {
    let index = motion.strokes.len().checked_sub(1)?;
    let stroke = motion.strokes[index];
    let first = frames.iter().position(|frame| frame.stroke == index)?;
    let jammed =
        frames.iter().skip(first).position(|frame| is_jammed(scene, &motion.tool, frame))?;
    // Frame 0 of a recording is the start; frame 0 of a later stroke is the end of its first frame.
    let done = if index == 0 { jammed } else { jammed + 1 };
    let kept = done.min(stroke.frames()).saturating_sub(1) as f64 / stroke.frames() as f64;
    Some(Stroke {
        to: stroke.from.towards(&stroke.to, kept),
        duration: stroke.duration * kept,
        ..stroke
    })
}

/// Returns `true` if the tool's path meets an obstacle.
pub(super) fn crosses_obstacle(scene: &Scene, tool: &Tool, stroke: &Stroke) -> bool {
    scene.obstacles.iter().any(|obstacle| {
        let still = (&obstacle.shape().footprint(), &obstacle.pose);
        tool.parts().iter().any(|part| {
            let (from, to) = (stroke.from * part.pose, stroke.to * part.pose);
            swept_clearance(&part.footprint(), &from, &to, still, 1e-3) < 1e-3
        })
    })
}

fn is_jammed(scene: &Scene, tool: &Tool, frame: &Frame) -> bool {
    let overlaps = |first: (&Footprint, &Pose), second: (&Footprint, &Pose)| {
        let (points, _) = contact_points(first, second, 0.0);
        points.iter().flatten().any(|point| point.gap < -JAMMED)
    };
    scene.objects.iter().zip(&frame.state.poses).any(|(object, pose)| {
        let body = (&object.shape.footprint(), pose);
        let into_tool = tool
            .parts()
            .iter()
            .any(|part| overlaps(body, (&part.footprint(), &(frame.tool * part.pose))));
        into_tool
            || scene
                .obstacles
                .iter()
                .any(|obstacle| overlaps(body, (&obstacle.shape().footprint(), &obstacle.pose)))
    })
}
