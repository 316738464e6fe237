//! A picture of a lever-up: from above, and from the side along the edge, with ghosts of plate and
//! blade from the start to rest.

use crate::geometry::{Pose3, Vector, Vector3, cross};
use crate::report::svg::{Font, Style, Svg};
use crate::scene::{Goal, LeverFrame, LeverMotion, LeverScene, LeverUp, lever_frame};

use super::palette;
use super::view::{Bounds, View};

/// Free space beside and above the plots, pixels.
const LEFT: f64 = 52.0;
const RIGHT: f64 = 16.0;
const BELOW: f64 = 40.0;

/// Largest and smallest plot, pixels, and what is free around what it shows, metres.
const LARGEST: Vector = Vector::new(760.0, 420.0);
const SMALLEST: Vector = Vector::new(560.0, 160.0);
const MARGIN: f64 = 0.02;

/// Ghosts between the start and rest.
const GHOSTS: usize = 7;

/// Metres of motion that a turn by one radian counts as.
const TURN: f64 = 0.05;

/// A lever-up as it was replayed.
pub struct LeverPicture<'a> {
    /// Above everything.
    pub title: String,
    /// Below it, a line each.
    pub notes: Vec<String>,
    /// Where.
    pub scene: &'a LeverScene,
    /// What.
    pub lever: &'a LeverUp,
    /// What for.
    pub goal: &'a Goal,
    /// What happened.
    pub motion: &'a LeverMotion,
}

/// A solid as its corners in space.
type Corners = Vec<Vector3>;

impl LeverPicture<'_> {
    /// The picture as an SVG document.
    pub fn to_svg(&self) -> String {
        let ghosts = self.ghosts();
        let above = |p: &Vector3| p.xy();
        let frame = self.lever.frame(self.scene).inverse();
        let floor = self.scene.plates[self.lever.plate].z;
        let beside = move |p: &Vector3| {
            let local = frame.point(*p);
            Vector::new(local.x, local.z + floor)
        };
        let mut top = self.view(&ghosts, &above);
        let mut side = self.view(&ghosts, &beside);
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
        self.plot(&mut svg, &top, ("from above", "x, m", "y, m"), &ghosts, &above);
        self.goal_above(&mut svg, &top);
        let names = ("from the side, the blade coming from the left", "inward, m", "z, m");
        self.plot(&mut svg, &side, names, &ghosts, &beside);
        self.goal_beside(&mut svg, &side);
        svg.finish()
    }

    /// Start, some frames between, and rest: evenly by how far the plate moved.
    fn ghosts(&self) -> Vec<&LeverFrame> {
        let frames = &self.motion.frames;
        let plate = self.lever.plate;
        let mut ways = vec![0.0];
        for pair in frames.windows(2) {
            let (a, b) = (&pair[0].plates[plate], &pair[1].plates[plate]);
            let step = (b.position - a.position).norm() + TURN * a.angle_to(b);
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

    fn view(&self, ghosts: &[&LeverFrame], to: &dyn Fn(&Vector3) -> Vector) -> View {
        let mut bounds = Bounds::empty();
        for block in &self.scene.blocks {
            let pose = Pose3::upright(block.pose, block.z + 0.5 * block.size[2]);
            cuboid(block.size, &pose).iter().for_each(|p| bounds.add(to(p), 0.0));
        }
        for frame in ghosts {
            for (k, pose) in frame.plates.iter().enumerate() {
                self.slabs(k, pose).iter().flatten().for_each(|p| bounds.add(to(p), 0.0));
            }
            self.blade(frame).iter().for_each(|p| bounds.add(to(p), 0.0));
        }
        View::fit_into(bounds, Vector::new(LEFT, 0.0), [SMALLEST, LARGEST], MARGIN)
    }

    fn plot(
        &self,
        svg: &mut Svg,
        view: &View,
        (name, x, y): (&'static str, &str, &str),
        ghosts: &[&LeverFrame],
        to: &dyn Fn(&Vector3) -> Vector,
    ) {
        svg.text(view.corner - Vector::new(0.0, 8.0), name, palette::NOTE);
        svg.rect(view.corner, view.size, 0.0, palette::PLOT);
        view.grid_named(svg, x, y);
        svg.open_clipped(if y == "z, m" { "side" } else { "top" }, view.corner, view.size);
        if y == "z, m" {
            let ends = [-10.0, 10.0].map(|x| view.map(Vector::new(x, 0.0)));
            svg.line(ends[0], ends[1], Style::stroke(palette::FAINT_INK, 1.6));
        }
        let mut shape = |corners: &Corners, style: Style| {
            let points: Vec<Vector> = corners.iter().map(to).collect();
            let around: Vec<Vector> = hull(points).into_iter().map(|p| view.map(p)).collect();
            svg.polygon(&around, style);
        };
        for block in &self.scene.blocks {
            let pose = Pose3::upright(block.pose, block.z + 0.5 * block.size[2]);
            shape(&cuboid(block.size, &pose), palette::OBSTACLE.opacity(0.7));
        }
        let last = ghosts.len().saturating_sub(1);
        for (g, frame) in ghosts.iter().enumerate() {
            let faded = if g == last { 0.95 } else { 0.18 + 0.3 * g as f64 / GHOSTS as f64 };
            if g != last {
                let style = Style::fill(palette::TOOL_FILL).outlined(palette::TOOL, 1.0);
                shape(&self.blade(frame), style.opacity(faded + 0.15));
            }
            for (k, pose) in frame.plates.iter().enumerate() {
                let own = k == self.lever.plate;
                if !own && g != last {
                    continue;
                }
                let style = if own { palette::GOAL_OBJECT } else { palette::OTHER_OBJECT };
                for slab in self.slabs(k, pose) {
                    shape(&slab, style.opacity(faded));
                }
            }
        }
        view.scale_bar(svg);
        svg.close();
    }

    /// The obstacle that must be left, and where to.
    fn goal_above(&self, svg: &mut Svg, view: &View) {
        svg.open_clipped("goal-above", view.corner, view.size);
        if let Some(block) = self.goal.outside.map(|block| &self.scene.blocks[block]) {
            let [x, y] = [0.5 * block.size[0], 0.5 * block.size[1]];
            let corners = [[-x, -y], [x, -y], [x, y], [-x, y]];
            let corners = corners.map(|[x, y]| view.map(block.pose.point(Vector::new(x, y))));
            svg.polygon(&corners, palette::GOAL_RIM.dashed("6 3"));
        }
        if self.goal.has_place() {
            let (at, tolerance) = (self.goal.position, self.goal.tolerance);
            svg.circle(view.map(at), view.length(tolerance), palette::GOAL_AREA);
            svg.circle(view.map(at), view.length(tolerance), palette::GOAL_RIM);
        }
        // The lever point, and the way that the blade goes.
        let plate = &self.scene.plates[self.lever.plate];
        let frame = plate.pose * lever_frame(plate.corners(), self.lever.place);
        let back = frame.point(Vector::new(-0.03, 0.0));
        let tip = frame.point(Vector::new(self.lever.depth, 0.0));
        svg.arrow(view.map(back), view.map(tip), 8.0, palette::TOOL, 2.0);
        let rest = self.motion.frames.last().map(|frame| frame.plates[self.lever.plate]);
        if let Some(rest) = rest {
            svg.circle(view.map(rest.position.xy()), 3.5, Style::fill(palette::INK));
        }
        svg.close();
    }

    /// How high the edge must come.
    fn goal_beside(&self, svg: &mut Svg, view: &View) {
        let Some(height) = self.goal.raised else { return };
        let z = self.scene.plates[self.lever.plate].z + height;
        svg.open_clipped("goal-beside", view.corner, view.size);
        let ends = [-10.0, 10.0].map(|x| view.map(Vector::new(x, z)));
        svg.line(ends[0], ends[1], palette::GOAL_RIM.dashed("6 3"));
        svg.close();
    }

    fn slabs(&self, plate: usize, pose: &Pose3) -> Vec<Corners> {
        let slab = |slab: &crate::scene::Slab| {
            let at =
                |z: f64| slab.corners.iter().map(move |c| pose.point(Vector3::new(c.x, c.y, z)));
            at(slab.bottom).chain(at(slab.bottom + slab.height)).collect()
        };
        self.scene.plates[plate].slabs.iter().map(slab).collect()
    }

    fn blade(&self, frame: &LeverFrame) -> Corners {
        let blade = &self.scene.blade;
        cuboid([blade.length, blade.width, blade.thickness], &frame.blade)
    }
}

fn cuboid([x, y, z]: [f64; 3], pose: &Pose3) -> Corners {
    let half = Vector3::new(0.5 * x, 0.5 * y, 0.5 * z);
    let sign = |k: usize, bit: usize| if k & bit == 0 { -1.0 } else { 1.0 };
    let corner = |k: usize| {
        pose.point(Vector3::new(sign(k, 1) * half.x, sign(k, 2) * half.y, sign(k, 4) * half.z))
    };
    (0..8).map(corner).collect()
}

/// The corners of the convex hull of points, in order (Andrew's monotone chain).
fn hull(mut points: Vec<Vector>) -> Vec<Vector> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut around: Vec<Vector> = Vec::new();
    for pass in 0..2 {
        let kept = around.len();
        let mut add = |p: Vector| {
            while around.len() >= kept + 2 {
                let [a, b] = [around[around.len() - 2], around[around.len() - 1]];
                if cross(b - a, p - b) > 0.0 {
                    break;
                }
                around.pop();
            }
            around.push(p);
        };
        match pass {
            0 => points.iter().for_each(|p| add(*p)),
            _ => points.iter().rev().for_each(|p| add(*p)),
        }
        around.pop();
    }
    around
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_leaves_out_what_is_inside() {
        let point = |[x, y]: [f64; 2]| Vector::new(x, y);
        let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.5], [2.0, 2.0], [0.0, 2.0], [1.0, 0.0]];
        let around = hull(points.map(point).to_vec());
        assert_eq!(around, [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(point));
    }
}
