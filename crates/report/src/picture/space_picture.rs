//! Picture of a motion that leaves the plane: views from above, and from the side along the levered
//! edge. It shows ghosts from the start to rest, or an animation.

use std::sync::Arc;

use crate::svg::{Font, Style, Svg};
use pushplan::geometry::{Footprint, Pose3, Vector, Vector3, planar_hull};
use pushplan::{
    outcome::{Frame, Trajectory},
    scene::{Blade, Part, Plate, Scene, Slab, Tool},
    task::{Goal, LeverStep, Mark, Plan, ShownGoal, Step, lever_frame},
};

use super::view::{Bounds, View};
use super::{bodies, palette};

/// Free space beside and below the plots, pixels.
const LEFT: f64 = 52.0;
const RIGHT: f64 = 16.0;
const BELOW: f64 = 40.0;

/// Largest and smallest plot, pixels, and margin around its content, metres.
const LARGEST: Vector = Vector::new(760.0, 420.0);
const SMALLEST: Vector = Vector::new(560.0, 160.0);
const MARGIN: f64 = 0.02;

/// Number of ghosts between the start and rest.
const GHOSTS: usize = 7;

/// Displacement equivalent to a rotation by one radian, metres.
const TURN: f64 = 0.05;

/// Number of corners of a polygon that approximates a circle.
const ROUND: usize = 16;

/// Maximum number of frames of an animation, and number of frames of its final pause.
const PICTURES: usize = 90;
const PAUSE: usize = 12;

/// Content of a 3-D picture: a replayed plan.
pub struct SpacePicture<'a> {
    /// Title.
    pub title: String,
    /// Lines below the title.
    pub notes: Vec<String>,
    /// Scene.
    pub scene: &'a Scene,
    /// Plan.
    pub plan: &'a Plan,
    /// Tools of the plan.
    pub tools: &'a [Arc<Tool>],
    /// Goal of the plan.
    pub goal: &'a Goal,
    /// 3-D trajectory.
    pub trajectory: &'a Trajectory,
}

/// Corners of a 3-D solid.
type Corners = Vec<Vector3>;

/// Projection of space onto a plane.
type Seen<'a> = &'a dyn Fn(&Vector3) -> Vector;

impl SpacePicture<'_> {
    /// Returns the picture as an SVG document.
    pub fn to_svg(&self) -> String {
        self.drawn(&self.ghosts(), None)
    }

    /// Returns the picture as an animated, self-contained SVG document in an endless loop.
    pub fn to_moving_svg(&self) -> String {
        let frames: Vec<&Frame> = self.trajectory.frames.iter().collect();
        let step = frames.len().div_ceil(PICTURES).max(1);
        let mut shown: Vec<&Frame> = frames.iter().copied().step_by(step).collect();
        shown.extend(std::iter::repeat_n(frames.last().copied(), PAUSE).flatten());
        let time = shown.last().map_or(1.0, |last| last.time.max(0.1));
        let moving = shown.len().saturating_sub(PAUSE).max(1);
        let seconds = time * shown.len() as f64 / moving as f64;
        self.drawn(&shown, Some(seconds))
    }

    fn drawn(&self, frames: &[&Frame], moving: Option<f64>) -> String {
        let above = |p: &Vector3| p.xy();
        // Without a lever-up, the side view is from the front.
        let (frame, floor) = self.levered().unwrap_or_default();
        let frame = frame.inverse();
        let beside = move |p: &Vector3| {
            let local = frame.point(*p);
            Vector::new(local.x, local.z + floor)
        };
        let mut top = self.view(frames, &above);
        let mut side = self.view(frames, &beside);
        let width = top.size.x.max(side.size.x);
        let notes: Vec<String> =
            self.notes.iter().flat_map(|note| palette::NOTE.wrap(note, width)).collect();
        top.corner.y = 62.0 + 18.0 * notes.len() as f64;
        side.corner.y = top.corner.y + top.size.y + BELOW + 16.0;
        let height = side.corner.y + side.size.y + BELOW;
        let mut svg = Svg::new(LEFT + width + RIGHT, height, &self.title);
        svg.define(palette::HATCH);
        svg.text(Vector::new(LEFT, 27.0), &self.title, Font::new(16.0, palette::INK).bold());
        for (k, note) in notes.iter().enumerate() {
            svg.text(Vector::new(LEFT, 46.0 + 18.0 * k as f64), note, palette::NOTE);
        }
        self.plot(&mut svg, &top, ("from above", "x, m", "y, m"), (frames, moving), &above);
        self.goal_above(&mut svg, &top);
        let names = ("from the side; the blade enters from the left", "inward, m", "z, m");
        self.plot(&mut svg, &side, names, (frames, moving), &beside);
        self.goal_beside(&mut svg, &side);
        svg.finish()
    }

    /// Returns the frame of the first lever-up, and the height of the object at that time, metres.
    fn levered(&self) -> Option<(Pose3, f64)> {
        let (step, plate) = self.first()?;
        Some((step.lever.frame_on(&plate), plate.z))
    }

    /// Returns the first lever-up, and its object at the planned pose.
    fn first(&self) -> Option<(&LeverStep, Plate)> {
        let step = self.plan.lever_steps().next()?;
        let mut plate = Plate::of(self.scene, step.lever.plate);
        plate.pose = step.expected.unwrap_or(plate.pose);
        Some((step, plate))
    }

    /// Returns the start, some frames between, and rest, at equal distances of the object's motion.
    fn ghosts(&self) -> Vec<&Frame> {
        let frames = &self.trajectory.frames;
        let mut ways = vec![0.0];
        for pair in frames.windows(2) {
            let [a, b] = [&pair[0], &pair[1]].map(|frame| self.pose(self.goal.object, frame));
            let step = (b.position - a.position).norm() + TURN * a.angle_to(&b);
            ways.push(ways[ways.len() - 1] + step);
        }
        let whole = ways[ways.len() - 1];
        let mut chosen: Vec<usize> = (0..=GHOSTS)
            .map(|k| {
                let wanted = whole * k as f64 / GHOSTS as f64;
                ways.partition_point(|way| *way < wanted - 1e-12)
            })
            .collect();
        chosen.push(frames.len().saturating_sub(1));
        chosen.dedup();
        chosen.into_iter().filter_map(|k| frames.get(k)).collect()
    }

    /// Returns the pose of an object in a frame.
    fn pose(&self, object: usize, frame: &Frame) -> Pose3 {
        let state = &frame.state;
        let seen = || state.poses.get(object).map(|pose| (pose, &self.scene.objects[object]));
        match &state.space {
            Some(space) => space.get(object).copied().unwrap_or_default(),
            None => seen().map_or(Pose3::default(), |(pose, own)| Pose3::upright(*pose, own.z)),
        }
    }

    fn view(&self, frames: &[&Frame], to: Seen) -> View {
        let mut bounds = Bounds::empty();
        for obstacle in &self.scene.obstacles {
            let pose = Pose3::upright(obstacle.pose, obstacle.z + 0.5 * obstacle.size[2]);
            cuboid(obstacle.size, &pose).iter().for_each(|p| bounds.add(to(p), 0.0));
        }
        for frame in frames {
            for k in 0..self.scene.things().count() {
                self.slabs(k, frame).iter().flatten().for_each(|p| bounds.add(to(p), 0.0));
            }
            self.tool(frame).iter().flatten().for_each(|p| bounds.add(to(p), 0.0));
        }
        View::fit_into(bounds, Vector::new(LEFT, 0.0), [SMALLEST, LARGEST], MARGIN)
    }

    fn plot(
        &self,
        svg: &mut Svg,
        view: &View,
        (name, x, y): (&'static str, &str, &str),
        (frames, moving): (&[&Frame], Option<f64>),
        to: Seen,
    ) {
        svg.text(view.corner - Vector::new(0.0, 8.0), name, palette::NOTE);
        svg.rect(view.corner, view.size, 0.0, palette::PLOT);
        view.grid_named(svg, x, y);
        svg.open_clipped(if y == "z, m" { "side" } else { "top" }, view.corner, view.size);
        if y == "z, m" {
            let ends = [-10.0, 10.0].map(|x| view.map(Vector::new(x, 0.0)));
            svg.line(ends[0], ends[1], Style::stroke(palette::FAINT_INK, 1.6));
        }
        let outline = |corners: &Corners| -> Vec<Vector> {
            let points: Vec<Vector> = corners.iter().map(to).collect();
            planar_hull(&points, 0.0).into_iter().map(|p| view.map(p)).collect()
        };
        for obstacle in &self.scene.obstacles {
            let pose = Pose3::upright(obstacle.pose, obstacle.z + 0.5 * obstacle.size[2]);
            let around = outline(&cuboid(obstacle.size, &pose));
            svg.polygon(&around, palette::OBSTACLE.opacity(0.7));
        }
        let tool_style = Style::fill(palette::TOOL_FILL).outlined(palette::TOOL, 1.0);
        let style = |object: usize| match object == self.goal.object {
            true => palette::GOAL_OBJECT,
            false => palette::OTHER_OBJECT,
        };
        if let Some(seconds) = moving {
            // The tool is drawn below the bodies that it carries.
            let parts = frames.iter().map(|frame| self.tool(frame).len()).max().unwrap_or(0);
            for part in 0..parts {
                let ways: Vec<Vec<Vector>> = frames
                    .iter()
                    .map(|frame| self.tool(frame).get(part).map(outline).unwrap_or_default())
                    .collect();
                svg.moving_polygon(&ways, seconds, tool_style.opacity(0.8));
            }
            for object in 0..self.scene.things().count() {
                let slabs = 1 + self.scene.parts_of(object).count();
                for slab in 0..slabs {
                    let ways: Vec<Vec<Vector>> =
                        frames.iter().map(|f| outline(&self.slabs(object, f)[slab])).collect();
                    svg.moving_polygon(&ways, seconds, style(object).opacity(0.9));
                }
            }
            view.scale_bar(svg);
            return svg.close();
        }
        let last = frames.len().saturating_sub(1);
        for (g, frame) in frames.iter().enumerate() {
            let faded = if g == last { 0.95 } else { 0.18 + 0.3 * g as f64 / GHOSTS as f64 };
            if g != last {
                for part in self.tool(frame) {
                    svg.polygon(&outline(&part), tool_style.opacity(faded + 0.15));
                }
            }
            for k in 0..self.scene.things().count() {
                if k != self.goal.object && g != last {
                    continue;
                }
                for slab in self.slabs(k, frame) {
                    svg.polygon(&outline(&slab), style(k).opacity(faded));
                }
            }
        }
        view.scale_bar(svg);
        svg.close();
    }

    /// Draws the obstacle that must be left, and the goal position.
    fn goal_above(&self, svg: &mut Svg, view: &View) {
        svg.open_clipped("goal-above", view.corner, view.size);
        let goal = self.goal.shown(self.scene);
        let placed = |mark: &Mark| matches!(mark, Mark::Outside(_) | Mark::Disc { .. });
        let marks = goal.marks.iter().filter(|mark| placed(mark)).cloned().collect();
        let goal = ShownGoal { marks, ..goal };
        bodies::goal_area(svg, view, &goal);
        bodies::goal(svg, view, &goal);
        // The arrow shows the lever point and the path of the blade.
        if let Some((step, plate)) = self.first() {
            let frame = plate.pose * lever_frame(plate.corners(), step.lever.place);
            let back = frame.point(Vector::new(-0.03, 0.0));
            let tip = frame.point(Vector::new(step.lever.depth, 0.0));
            svg.arrow(view.map(back), view.map(tip), 8.0, palette::TOOL, 2.0);
        }
        if let Some(last) = self.trajectory.frames.last() {
            let rest = self.pose(self.goal.object, last).position.xy();
            svg.circle(view.map(rest), 3.5, Style::fill(palette::INK));
        }
        svg.close();
    }

    /// Draws the height that the edge must reach.
    fn goal_beside(&self, svg: &mut Svg, view: &View) {
        let marks = self.goal.shown(self.scene).marks.into_iter();
        let height = |mark| if let Mark::Height(z) = mark { Some(z) } else { None };
        let Some(z) = marks.filter_map(height).next() else { return };
        svg.open_clipped("goal-beside", view.corner, view.size);
        let ends = [-10.0, 10.0].map(|x| view.map(Vector::new(x, z)));
        svg.line(ends[0], ends[1], palette::GOAL_RIM.dashed("6 3"));
        svg.close();
    }

    fn slabs(&self, object: usize, frame: &Frame) -> Vec<Corners> {
        let pose = self.pose(object, frame);
        let plate = Plate::of(self.scene, object);
        let solid =
            |slab: &Slab| prism(&slab.corners, [slab.bottom, slab.bottom + slab.height], &pose);
        plate.slabs.iter().map(solid).collect()
    }

    /// Returns the moving parts of the active tool.
    fn tool(&self, frame: &Frame) -> Vec<Corners> {
        let Some(step) = self.plan.steps.get(frame.stroke) else { return Vec::new() };
        let Some(tool) = self.tools.iter().find(|tool| tool.name == step.tool()) else {
            return Vec::new();
        };
        match (step, frame.blade) {
            (Step::LeverUp(_), Some(pose)) => {
                let Blade { length, width, thickness, .. } = tool.blade().unwrap_or_default();
                vec![cuboid([length, width, thickness], &pose)]
            }
            (Step::LeverUp(_), None) => Vec::new(),
            (Step::Push(step), _) => {
                let part = |part: &Part| {
                    let pose = Pose3::upright(frame.tool * part.pose, step.lift);
                    prism(&around(&part.footprint()), [0.0, part.shape.height()], &pose)
                };
                tool.parts().iter().map(part).collect()
            }
        }
    }
}

/// Returns the corners of a solid's footprint.
fn around(footprint: &Footprint) -> Vec<Vector> {
    match footprint {
        Footprint::Disc { radius } => (0..ROUND)
            .map(|k| std::f64::consts::TAU * k as f64 / ROUND as f64)
            .map(|angle| *radius * Vector::new(angle.cos(), angle.sin()))
            .collect(),
        Footprint::Rectangle { half } => [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]| Vector::new(x * half.x, y * half.y))
            .to_vec(),
        Footprint::Polygon(polygon) => polygon.corners().to_vec(),
    }
}

fn prism(corners: &[Vector], span: [f64; 2], pose: &Pose3) -> Corners {
    let at = |z: f64| corners.iter().map(move |c| pose.point(Vector3::new(c.x, c.y, z)));
    span.into_iter().flat_map(at).collect()
}

fn cuboid([x, y, z]: [f64; 3], pose: &Pose3) -> Corners {
    let half = Vector3::new(0.5 * x, 0.5 * y, 0.5 * z);
    let sign = |k: usize, bit: usize| if k & bit == 0 { -1.0 } else { 1.0 };
    let corner = |k: usize| {
        pose.point(Vector3::new(sign(k, 1) * half.x, sign(k, 2) * half.y, sign(k, 4) * half.z))
    };
    (0..8).map(corner).collect()
}
