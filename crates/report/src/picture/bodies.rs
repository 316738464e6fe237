//! Objects, obstacles, the goal and the robot's reach.

use std::f64::consts::TAU;

use crate::svg::{Anchor, Font, Style, Svg};
use pushplan::geometry::{Pose, Shape, Vector, wrap_angle};
use pushplan::{
    scene::{Annulus, Object, Scene},
    task::{Mark, ShownGoal, Swing},
};

use super::{legend::Sample, palette, view::View};

/// Smallest displacement of an object that is drawn as moved, metres, unless it turns by
/// [`STILL_TURN`]. A second outline would only blur the first.
const STILL: f64 = 5e-4;
/// Smallest rotation that is drawn, radians, about half a degree.
const STILL_TURN: f64 = 0.01;
/// Largest angle between the points of a drawn arc, radians.
const ARC_STEP: f64 = 0.05;

/// Draws the annulus within reach of the end effector, with the robot's base in its centre.
pub fn reach(svg: &mut Svg, view: &View, annulus: &Annulus) {
    let base = view.map(annulus.centre);
    let [near, far] = annulus.radii.map(|radius| view.length(radius));
    svg.circle(base, far, palette::REACH_AREA);
    svg.circle(base, far, palette::REACH_RIM);
    svg.circle(base, near, Style::fill("#fbfcfd"));
    svg.circle(base, near, palette::REACH_RIM);
    svg.circle(base, 4.0, Style::fill(palette::INK));
    let font = Font::new(11.0, palette::FAINT_INK).anchored(Anchor::Middle).halo();
    svg.text(base + Vector::new(0.0, 18.0), "robot", font);
}

/// Draws the areas in which a goal's object may end at rest, or which it must touch.
pub fn goal_area(svg: &mut Svg, view: &View, goal: &ShownGoal) {
    for mark in &goal.marks {
        match mark {
            Mark::Outside(_) => {}
            Mark::Band { pieces, from, to } => {
                // Lines about the outline with round corners cover exactly these distances.
                let wide = Style::stroke(palette::GOAL, (2.0 * view.length(*to)).max(3.0));
                outlines(svg, view, pieces, wide.opacity(palette::GOAL_BAND));
                if *from > 0.0 {
                    outlines(svg, view, pieces, Style::stroke("#ffffff", 2.0 * view.length(*from)));
                }
            }
            _ => area(svg, view, mark, palette::GOAL_AREA),
        }
    }
}

fn outlines(svg: &mut Svg, view: &View, pieces: &[Vec<Vector>], style: Style) {
    for piece in pieces {
        let corners: Vec<Vector> = piece.iter().map(|corner| view.map(*corner)).collect();
        svg.polygon(&corners, style);
    }
}

/// Draws the rims of the goal areas, a cross at the wanted position, and all other marks.
pub fn goal(svg: &mut Svg, view: &View, goal: &ShownGoal) {
    let centre = view.map(goal.centre);
    let dashed = palette::GOAL_RIM.dashed("6 3");
    for mark in &goal.marks {
        let outside = matches!(mark, Mark::Outside(_));
        area(svg, view, mark, if outside { dashed } else { palette::GOAL_RIM });
    }
    let arm = 7.0;
    let arms = [Vector::new(arm, 0.0), Vector::new(0.0, arm)];
    for side in arms.into_iter().filter(|_| goal.placed) {
        svg.line(centre - side, centre + side, palette::GOAL_RIM);
    }
    let radius = goal.marks.iter().find_map(|mark| match mark {
        Mark::Disc { radius, .. } => Some(view.length(*radius)),
        _ => None,
    });
    for mark in &goal.marks {
        match mark {
            Mark::Headings { tolerance, swing: Some(swing), .. } => {
                arc(svg, view, swing, *tolerance);
            }
            Mark::Headings { heading, tolerance, symmetry, .. } => {
                // The wedge must be visible beyond a small tolerance circle.
                let length = radius.unwrap_or(0.0).max(34.0) + 10.0;
                wedges(svg, (centre, length), (*heading, *tolerance, *symmetry));
            }
            Mark::Distance([from, to]) => {
                svg.line(view.map(*from), view.map(*to), palette::GOAL_MISS);
            }
            Mark::Edge([from, to]) => svg.line(view.map(*from), view.map(*to), palette::GOAL_RIM),
            _ => {}
        }
    }
}

/// Draws a mark that covers an area.
fn area(svg: &mut Svg, view: &View, mark: &Mark, style: Style) {
    match mark {
        Mark::Disc { centre, radius } => {
            svg.circle(view.map(*centre), view.length(*radius), style);
        }
        Mark::Area(area) | Mark::Outside(area) => {
            view.footprint(svg, &area.shape.footprint(), &area.pose, style);
        }
        Mark::Outline { pieces, .. } => outlines(svg, view, pieces, style),
        _ => {}
    }
}

/// Draws a wedge for each accepted heading, and an arrow along the wanted one.
fn wedges(
    svg: &mut Svg,
    (centre, length): (Vector, f64),
    (heading, tolerance, symmetry): (f64, f64, usize),
) {
    let at = |angle: f64| centre + Vector::new(angle.cos(), -angle.sin()) * length;
    for turn in (0..symmetry).map(|k| TAU * k as f64 / symmetry as f64) {
        let wedge: Vec<Vector> = std::iter::once(centre)
            .chain((0..=12).map(|k| at(heading + turn + tolerance * (k as f64 / 6.0 - 1.0))))
            .collect();
        svg.polygon(&wedge, Style::fill(palette::GOAL).opacity(0.22));
    }
    svg.arrow(centre, at(heading), 8.0, palette::GOAL, 1.6);
}

/// Draws the accepted angles of a hinged object as a sector about its hinge, and the way of its far
/// end as an arrow.
fn arc(svg: &mut Svg, view: &View, swing: &Swing, tolerance: f64) {
    let at =
        |angle: f64| view.map(swing.hinge + swing.radius * Vector::new(angle.cos(), angle.sin()));
    let along = |from: f64, to: f64| -> Vec<Vector> {
        let count = ((to - from).abs() / ARC_STEP).ceil().max(1.0) as usize;
        (0..=count).map(|k| at(from + (to - from) * k as f64 / count as f64)).collect()
    };
    let hinge = view.map(swing.hinge);
    let accepted = along(swing.to - tolerance, swing.to + tolerance);
    let sector: Vec<Vector> = std::iter::once(hinge).chain(accepted).collect();
    svg.polygon(&sector, Style::fill(palette::GOAL).opacity(0.22));
    let way = along(swing.from, swing.to);
    svg.polyline(&way, palette::GOAL_RIM.dashed("6 3"));
    if let [.., before, end] = way[..] {
        svg.arrow(before, end, 8.0, palette::GOAL, 1.6);
    }
    svg.circle(hinge, 4.0, palette::GOAL_RIM);
}

/// Draws lines from the end of a goal's object to the missed positions.
pub fn miss(svg: &mut Svg, view: &View, goal: &ShownGoal, end: Vector) {
    for to in goal.marks.iter().filter_map(|mark| mark.missed(end)) {
        svg.line(view.map(end), view.map(to), palette::GOAL_MISS);
    }
}

/// Draws the obstacles on the table and the keep-out regions.
pub fn fixed(svg: &mut Svg, view: &View, scene: &Scene) {
    for region in &scene.keep_out {
        svg.open_titled(&format!("{}: {}", region.name, region.words()));
        view.footprint(svg, &region.footprint(), &region.pose, palette::KEEP_OUT);
        svg.close();
    }
    scene.obstacles.iter().filter(|obstacle| obstacle.z == 0.0).for_each(|obstacle| {
        svg.open_titled(&obstacle.name);
        view.footprint(svg, &obstacle.shape().footprint(), &obstacle.pose, palette::OBSTACLE);
        svg.close();
    });
}

/// Draws the obstacles above the table, over the bodies that pass below them.
pub fn overhead(svg: &mut Svg, view: &View, scene: &Scene) {
    scene.obstacles.iter().filter(|obstacle| obstacle.z > 0.0).for_each(|obstacle| {
        svg.open_titled(&format!("{}, {:.3} m above the table", obstacle.name, obstacle.z));
        view.footprint(svg, &obstacle.shape().footprint(), &obstacle.pose, palette::OVERHEAD);
        svg.close();
    });
}

/// Draws the names of the obstacles and keep-out regions.
pub fn names_of_fixed(svg: &mut Svg, view: &View, scene: &Scene) {
    for obstacle in &scene.obstacles {
        name(svg, view, &obstacle.name, &obstacle.shape(), &obstacle.pose);
    }
    for region in &scene.keep_out {
        name(svg, view, &region.name, &region.shape, &region.pose);
    }
}

/// Returns the legend entries of obstacles and keep-out regions.
pub fn legend_of_fixed(scene: &Scene) -> impl Iterator<Item = (Sample, String)> {
    let standing = scene.obstacles.iter().any(|obstacle| obstacle.z == 0.0);
    let above = scene.obstacles.iter().any(|obstacle| obstacle.z > 0.0);
    let entries = [
        (standing, palette::OBSTACLE, "obstacle"),
        (above, palette::OVERHEAD, "obstacle above the table"),
        (!scene.keep_out.is_empty(), palette::KEEP_OUT, "keep-out region"),
    ];
    let there = entries.into_iter().filter(|(there, ..)| *there);
    there.map(|(_, style, words)| (Sample::Area(style), words.to_owned()))
}

/// Draws an object at its start.
pub fn object(svg: &mut Svg, view: &View, object: &Object, is_goal: bool) {
    let style = if is_goal { palette::GOAL_OBJECT } else { palette::OTHER_OBJECT };
    svg.open_titled(&format!("{}: {:.3} kg", object.name, object.mass));
    view.footprint(svg, &object.shape.footprint(), &object.pose, style);
    let mark = if is_goal { "#1c6fbf" } else { "#868e96" };
    heading_mark(svg, view, &object.shape, &object.pose, Style::stroke(mark, 1.6));
    svg.close();
}

/// Returns `true` if an object that ended at `end` visibly moved.
pub fn moved(object: &Object, end: &Pose) -> bool {
    let turned = wrap_angle(end.heading - object.pose.heading).abs() > STILL_TURN
        && !object.shape.is_cylinder();
    let shifted = (end.position - object.pose.position).norm() > STILL;
    (shifted || turned) && end.is_finite()
}

/// Draws an object at its end.
pub fn final_object(svg: &mut Svg, view: &View, object: &Object, pose: &Pose, style: Style) {
    view.footprint(svg, &object.shape.footprint(), pose, style);
    heading_mark(svg, view, &object.shape, pose, style);
}

/// Draws a name in the middle of a body if it fits there, otherwise above it.
pub fn name(svg: &mut Svg, view: &View, name: &str, shape: &Shape, pose: &Pose) {
    let font = Font::new(12.0, palette::INK).bold().anchored(Anchor::Middle).halo();
    let centre = view.map(pose.position);
    let half = Vector::new((-pose.heading).cos(), (-pose.heading).sin());
    let extent = |direction| view.length(shape.footprint().extent(direction));
    // Half extents of the body along the axes of the page.
    let across = extent(Vector::new(half.x, half.y));
    let up = extent(Vector::new(-half.y, half.x));
    let fits = font.width(name) < 2.0 * across - 6.0 && up > 9.0;
    let rise = if fits { -4.0 } else { up + 6.0 };
    svg.text(centre - Vector::new(0.0, rise), name, font);
}

/// Draws a line from the centre of an object to its outline ahead; a cylinder has no front.
fn heading_mark(svg: &mut Svg, view: &View, shape: &Shape, pose: &Pose, style: Style) {
    let ahead = match shape {
        Shape::Cylinder { .. } => return,
        Shape::Cuboid { size } => size[0] / 2.0,
        Shape::Prism { base, .. } => {
            let ways = base.faces().filter(|(_, normal)| normal.x > 0.0);
            ways.map(|(corner, normal)| corner.dot(&normal) / normal.x).fold(f64::MAX, f64::min)
        }
    };
    let front = pose.point(Vector::new(ahead, 0.0));
    svg.line(view.map(pose.position), view.map(front), style);
}

#[cfg(test)]
mod tests {
    use insta::assert_snapshot;

    use super::super::view::Bounds;
    use super::*;
    use pushplan::geometry::ConvexPolygon;
    use pushplan::scene::JointKind;
    use pushplan::task::{Demand, Facing, Goal};

    #[test]
    fn a_prism_has_its_corners_and_a_mark_ahead_and_a_goal_a_wedge_for_each_heading() {
        let corners = [[0.0, 0.0], [0.09, 0.0], [0.0, 0.06]].map(|[x, y]| Vector::new(x, y));
        let base = ConvexPolygon::new(&corners).expect("convex");
        let wedge = Object::prism("wedge", base, 0.05).at(0.03, 0.02, 0.0);
        let view = View::fit(Bounds { low: corners[0], high: corners[1] }, Vector::zeros());
        let mut svg = Svg::new(100.0, 100.0, "a prism");
        object(&mut svg, &view, &wedge, true);
        assert_snapshot!(svg.finish(), @r##"
        <svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100" width="100" height="100" font-family="Inter, 'Segoe UI', 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif" role="img">
        <title>a prism</title>
        <rect width="100" height="100" rx="8" fill="#ffffff"/>
        <g><title>wedge: 0.400 kg</title>
        <polygon points="215.79,215.79 604.21,215.79 215.79,-43.16" stroke-linejoin="round" stroke-linecap="round" fill="#74b3f0" stroke="#1c6fbf" stroke-width="1.6"/>
        <line x1="345.26" y1="129.47" x2="474.74" y2="129.47" fill="none" stroke="#1c6fbf" stroke-width="1.6"/>
        </g>
        </svg>
        "##);

        let square = Shape::Cuboid { size: [0.08, 0.08, 0.05] };
        let facing = Goal::new(0, [0.03, 0.02], 0.02).facing(0.2, 0.1);
        let scene = Scene::new([Object::new("box", square)]);
        let wedges = |wanted: &Goal| {
            let mut svg = Svg::new(100.0, 100.0, "a goal");
            goal(&mut svg, &view, &wanted.shown(&scene));
            svg.finish().matches(r#"opacity="0.22""#).count()
        };
        assert_eq!((wedges(&facing), wedges(&facing.looking_like(&square))), (1, 4));
    }

    #[test]
    fn the_goal_of_a_door_is_a_sector_about_its_hinge_with_the_way_of_its_far_end() {
        // A door of 0.3 m along x, hinged at its left end, that opens by a quarter turn.
        let door = Object::cuboid("door", [0.3, 0.02, 0.1]).at(0.65, 0.0, 0.0);
        let hinge = Vector::new(0.5, 0.0);
        let kind = JointKind::Revolute { at: hinge, limits: None };
        let scene = Scene::new([door]).with_mount(0, kind);
        let [low, high] = [[0.4, -0.1], [0.9, 0.4]].map(|[x, y]| Vector::new(x, y));
        let view = View::fit(Bounds { low, high }, Vector::zeros());
        let facing = Facing::new(std::f64::consts::FRAC_PI_2, 0.1);
        let wanted = Goal::of(0).with(Demand::Heading(facing));
        let mut svg = Svg::new(100.0, 100.0, "a goal");
        goal(&mut svg, &view, &wanted.shown(&scene));
        let svg = svg.finish();
        let [at, end] = [hinge, hinge + Vector::new(0.0, 0.3f64.hypot(0.01))].map(|p| view.map(p));
        let number = |value: f64| {
            format!("{value:.2}").trim_end_matches('0').trim_end_matches('.').to_owned()
        };
        let [hinge, end] = [at, end].map(|p| [number(p.x), number(p.y)]);
        let circle = format!(r#"<circle cx="{}" cy="{}" r="4""#, hinge[0], hinge[1]);
        assert!(svg.contains(&circle), "{svg}");
        // The sector begins at the hinge, and the way ends at the far end's wanted position.
        let sector = format!(r#"<polygon points="{} "#, hinge.join(","));
        assert!(svg.contains(&sector), "{svg}");
        let way = svg.split("<polyline points=\"").nth(1).and_then(|rest| rest.split('"').next());
        let last = way.and_then(|points| points.split(' ').next_back());
        assert_eq!(last, Some(&*end.join(",")), "{svg}");
    }
}
