//! The tool at both ends of every stroke, and the paths of the end effector and the objects.

use crate::svg::{Anchor, Font, Style, Svg};
use pushplan::geometry::{Footprint, Pose, Vector, contact_points};
use pushplan::{
    outcome::Trajectory,
    scene::Tool,
    task::{Stroke, ToolMotion},
};

use super::{palette, view::View};

/// Stroke and its tool.
pub type Made<'a> = (&'a Tool, &'a Stroke);

/// Returns all strokes of the motions, in order.
pub fn all(motions: &[ToolMotion]) -> Vec<Made<'_>> {
    let mut made = Vec::new();
    for motion in motions {
        made.extend(motion.strokes.iter().map(|stroke| (&*motion.tool, stroke)));
    }
    made
}

/// Returns the names of the tools, without repetition.
pub fn tools(motions: &[ToolMotion]) -> String {
    let mut names: Vec<&str> = motions.iter().map(|motion| motion.tool.name.as_str()).collect();
    names.dedup();
    names.join(", ")
}

/// Draws the tool at the start (faint) and end (strong) of every stroke.
pub fn tool(svg: &mut Svg, view: &View, strokes: &[Made]) {
    // All starts are drawn below all ends, so that no end is dimmed.
    for (k, (tool, stroke)) in strokes.iter().enumerate() {
        // A chained stroke starts at the end of the last one, which is drawn already.
        if k == 0 || strokes[k - 1].1.settle {
            silhouette(svg, view, tool, &stroke.from, palette::TOOL_BEFORE);
        }
    }
    for (k, (tool, stroke)) in strokes.iter().enumerate() {
        svg.open_titled(&format!("{} after push {}", tool.name, k + 1));
        silhouette(svg, view, tool, &stroke.to, palette::TOOL_AFTER);
        hold(svg, view, tool, &stroke.to);
        svg.close();
    }
}

/// Draws numbered arrows along the end effector's path, with the grip at every end.
pub fn pushes(svg: &mut Svg, view: &View, strokes: &[Made]) {
    // All numbers are drawn over all arrows.
    strokes.iter().for_each(|made| arrow(svg, view, made));
    strokes.iter().enumerate().for_each(|(k, made)| number(svg, view, made, k));
}

/// Draws the path of the end effector in a push.
pub fn arrow(svg: &mut Svg, view: &View, (tool, stroke): &Made) {
    let [from, to] = [&stroke.from, &stroke.to].map(|pose| grip(view, tool, pose));
    svg.arrow(from, to, 12.0, palette::INK, 2.2);
}

/// Draws the number of push `k` at its start.
fn number(svg: &mut Svg, view: &View, (tool, stroke): &Made, k: usize) {
    let at = grip(view, tool, &stroke.from);
    svg.circle(at, 9.0, Style::fill(palette::INK).outlined("#ffffff", 1.5));
    let font = Font::new(11.5, "#ffffff").bold().anchored(Anchor::Middle);
    svg.text(at + Vector::new(0.0, 4.0), &(k + 1).to_string(), font);
}

fn grip(view: &View, tool: &Tool, at: &Pose) -> Vector {
    view.map((*at * tool.grip).position)
}

/// Draws the path of object `index`, with a dot at its end.
pub fn path(svg: &mut Svg, view: &View, trajectory: &Trajectory, index: usize, style: Style) {
    let points: Vec<Vector> = trajectory
        .frames
        .iter()
        .filter_map(|frame| frame.state.poses.get(index))
        .filter(|pose| pose.is_finite())
        .map(|pose| view.map(pose.position))
        .collect();
    svg.polyline(&points, style);
}

/// Draws the parts as one piece: wide outlines first, then fills, so that only the outer rim of the
/// outlines remains.
pub fn silhouette(svg: &mut Svg, view: &View, tool: &Tool, pose: &Pose, opacity: f64) {
    svg.open_faded(opacity);
    // The thin rim of the fill closes the hairlines between parts.
    let fill = Style::fill(palette::TOOL_FILL).outlined(palette::TOOL_FILL, 0.6);
    for style in [Style::stroke(palette::TOOL, 3.2), fill] {
        for (k, part) in tool.parts().iter().enumerate() {
            view.footprint(svg, &part.footprint(), &tool.part_pose(k, pose), style);
        }
    }
    svg.close();
}

/// Draws a line from the end effector to the nearest part, for tools held away from their parts.
pub fn hold(svg: &mut Svg, view: &View, tool: &Tool, pose: &Pose) {
    let grip = *pose * tool.grip;
    let point = Footprint::Disc { radius: 0.0 };
    let nearest = (0..tool.parts().len())
        .filter_map(|k| {
            let part = (&tool.parts()[k].footprint(), &tool.part_pose(k, pose));
            contact_points((&point, &grip), part, f64::MAX).0[0]
        })
        .min_by(|a, b| a.gap.total_cmp(&b.gap));
    if let Some(nearest) = nearest.filter(|nearest| nearest.gap > 0.0) {
        svg.line(view.map(grip.position), view.map(nearest.on_second), palette::TOOL_HOLD);
    }
    svg.circle(view.map(grip.position), 4.5, Style::fill("#ffffff").outlined(palette::TOOL, 2.0));
}
