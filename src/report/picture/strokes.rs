//! The tool at both ends of every stroke, the end effector's way, and the objects' ways.

use crate::geometry::{Footprint, Pose, Vector, contact_points};
use crate::report::svg::{Anchor, Font, Style, Svg};
use crate::scene::{Tool, ToolMotion, Trajectory};

use super::{palette, view::View};

/// The tool at the start (faint) and end (strong) of every stroke.
pub fn tool(svg: &mut Svg, view: &View, motion: &ToolMotion) {
    let tool = &motion.tool;
    // All starts below all ends, so that no end is dimmed.
    for (k, stroke) in motion.strokes.iter().enumerate() {
        // A chained stroke starts where the last one ended, which is drawn already.
        if k == 0 || motion.strokes[k - 1].settle {
            silhouette(svg, view, tool, &stroke.from, palette::TOOL_BEFORE);
        }
    }
    for (k, stroke) in motion.strokes.iter().enumerate() {
        svg.open_titled(&format!("{} after push {}", tool.name, k + 1));
        silhouette(svg, view, tool, &stroke.to, palette::TOOL_AFTER);
        hold(svg, view, tool, &stroke.to);
        svg.close();
    }
}

/// Numbered arrows along the end effector's way, with the grip at every end.
pub fn pushes(svg: &mut Svg, view: &View, motion: &ToolMotion) {
    // All numbers over all arrows.
    (0..motion.strokes.len()).for_each(|k| arrow(svg, view, motion, k));
    (0..motion.strokes.len()).for_each(|k| number(svg, view, motion, k));
}

/// The way of the end effector in push `k`.
pub fn arrow(svg: &mut Svg, view: &View, motion: &ToolMotion, k: usize) {
    let stroke = &motion.strokes[k];
    let [from, to] = [&stroke.from, &stroke.to].map(|pose| grip(view, motion, pose));
    svg.arrow(from, to, 12.0, palette::INK, 2.2);
}

/// The number of push `k` at its start.
pub fn number(svg: &mut Svg, view: &View, motion: &ToolMotion, k: usize) {
    let at = grip(view, motion, &motion.strokes[k].from);
    svg.circle(at, 9.0, Style::fill(palette::INK).outlined("#ffffff", 1.5));
    let font = Font::new(11.5, "#ffffff").bold().anchored(Anchor::Middle);
    svg.text(at + Vector::new(0.0, 4.0), &(k + 1).to_string(), font);
}

fn grip(view: &View, motion: &ToolMotion, tool: &Pose) -> Vector {
    view.map((*tool * motion.tool.grip).position)
}

/// The way of object `index`, with a dot at its end.
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

/// The parts as one piece: wide outlines first, fills over them, so that only the outer rim of
/// the outlines is left.
pub fn silhouette(svg: &mut Svg, view: &View, tool: &Tool, pose: &Pose, opacity: f64) {
    svg.open_faded(opacity);
    // The fill's own thin rim closes the hairlines between parts.
    let fill = Style::fill(palette::TOOL_FILL).outlined(palette::TOOL_FILL, 0.6);
    for style in [Style::stroke(palette::TOOL, 3.2), fill] {
        for (k, part) in tool.parts().iter().enumerate() {
            view.footprint(svg, &part.footprint(), &tool.part_pose(k, pose), style);
        }
    }
    svg.close();
}

/// A line from the end effector to the nearest part, for tools held away from their parts.
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
