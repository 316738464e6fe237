//! Page data of the table, its bodies, and the tools.

use serde_json::Value as Json;

use crate::plan_text::goal_line;
use pushplan::geometry::{Footprint, Shape, Vector};
use pushplan::{
    scene::{self, Annulus, Blade, Carried, Plate, Robot, SHOWN_HAND, Scene, Slab},
    task::{self, Mark, Plan, ShownGoal, Task},
};

use super::data::{Arc, Area, Band, Body, Goal, Outline, Stage, Tool, fine, length, point, pose};

/// Returns scene, reach and goals of a task.
pub fn stage(task: &Task) -> Stage {
    let shown = task.shown_goals();
    let goal = |goal: &ShownGoal| drawn(goal, task);
    let Annulus { centre, radii } = task.annulus();
    Stage {
        reach: radii.map(length).to_vec(),
        base: Some(point(centre)).filter(|base| *base != [0, 0]),
        goals: shown.iter().map(goal).collect(),
        ..table(&task.scene)
    }
}

/// Converts the marks of a goal for the page.
fn drawn(shown: &ShownGoal, task: &Task) -> Goal {
    let mut goal = Goal {
        objects: shown.objects.clone(),
        at: point(shown.centre),
        unplaced: !shown.placed,
        tolerance: 0,
        areas: Vec::new(),
        bands: Vec::new(),
        covers: Vec::new(),
        edges: Vec::new(),
        arc: None,
        heading: None,
        middle: None,
        alike: 1,
        words: goal_line(task),
    };
    for mark in &shown.marks {
        match mark {
            // 3-D plans have another measured quantity than the distance.
            Mark::Disc { radius, .. } if !task.in_space() => goal.tolerance = length(*radius),
            Mark::Area(area) => goal.areas.push(region(area, false)),
            Mark::Outside(area) => goal.areas.push(region(area, true)),
            Mark::Band { pieces, from, to } => goal.bands.push(Band {
                pieces: pieces.iter().map(|piece| points(piece)).collect(),
                from: length(*from),
                to: length(*to),
            }),
            Mark::Outline { pieces, .. } => {
                goal.covers.extend(pieces.iter().map(|piece| points(piece)));
            }
            Mark::Edge(ends) => goal.edges.push(ends.map(point)),
            Mark::Headings { heading, tolerance, limit_middle, symmetry, swing } => {
                goal.heading = Some([fine(*heading), fine(*tolerance)]);
                goal.arc = swing.map(|swing| Arc {
                    centre: point(swing.hinge),
                    radius: length(swing.radius),
                    from: fine(swing.from),
                    to: fine(swing.to),
                    tolerance: fine(*tolerance),
                });
                goal.middle = limit_middle.map(fine);
                goal.alike = *symmetry;
            }
            _ => {}
        }
    }
    goal
}

fn points(corners: &[Vector]) -> Vec<[i64; 2]> {
    corners.iter().map(|corner| point(*corner)).collect()
}

fn region(area: &task::Area, leave: bool) -> Area {
    Area { shape: outline(&area.shape), at: pose(&area.pose), leave }
}

/// Returns scene, reach and goals of a task as JSON, for drawing outside the page.
pub fn task_stage(task: &Task) -> Json {
    // Serialization cannot fail because the data has no maps with unusual keys.
    serde_json::to_value(stage(task)).unwrap_or_default()
}

/// Returns the bodies on a table, without goals.
pub fn table(scene: &Scene) -> Stage {
    // In a 3-D state the solids of a compound object move as one; in a planar state each has its
    // own pose.
    let in_space = scene.in_space();
    let solids = scene.objects.iter().enumerate();
    let objects = solids.filter(|(_, object)| !(in_space && object.is_part()));
    let objects = objects.map(|(k, object)| Body {
        name: object.name.clone(),
        shape: outline(&object.shape),
        height: length(object.shape.height()),
        under: length(object.span()[0]),
        base: false,
        whole: (object.is_part() && !in_space).then(|| scene.thing(k)),
        more: match in_space {
            true => Plate::of(scene, k).slabs[1..].iter().map(slab).collect(),
            false => Vec::new(),
        },
        at: pose(&object.pose),
    });
    let obstacles = scene.obstacles.iter().map(|obstacle| Body {
        name: obstacle.name.clone(),
        shape: outline(&obstacle.shape()),
        height: length(obstacle.size[2]),
        under: length(obstacle.z),
        base: obstacle.name.starts_with(Robot::BASE),
        whole: None,
        more: Vec::new(),
        at: pose(&obstacle.pose),
    });
    let regions = scene.keep_out.iter().map(|region| Body {
        name: format!("{}: {}", region.name, region.words()),
        shape: outline(&region.shape),
        height: 0,
        under: 0,
        base: false,
        whole: None,
        more: Vec::new(),
        at: pose(&region.pose),
    });
    Stage {
        objects: objects.collect(),
        obstacles: obstacles.collect(),
        regions: regions.collect(),
        table: scene.table_top.map(|top| [point(top.middle), top.size.map(length)]),
        reach: Vec::new(),
        base: None,
        goals: Vec::new(),
    }
}

/// Converts a tool for drawing, with its file.
pub fn tool(tool: &scene::Tool, file: Json) -> Tool {
    let parts = tool.parts().iter().map(|part| Body {
        name: part.name.clone(),
        shape: outline(&part.shape),
        height: length(part.shape.height()),
        under: 0,
        base: false,
        whole: None,
        more: Vec::new(),
        at: pose(&part.pose),
    });
    let mut parts: Vec<Body> = parts.collect();
    parts.extend(tool.blade().map(|Blade { length: long, width, thickness, .. }| Body {
        // The blade's frame is at its centre.
        name: "blade".to_owned(),
        shape: outline(&Shape::Cuboid { size: [long, width, thickness] }),
        height: length(thickness),
        under: length(-0.5 * thickness),
        base: false,
        whole: None,
        more: Vec::new(),
        at: [0; 3],
    }));
    Tool { name: tool.name.clone(), parts, grip: pose(&tool.grip), file }
}

/// Returns the hand that holds a tool, about its grip; `None` for levering.
pub fn hand(task: &Task, tool: &scene::Tool, plan: &Plan) -> Option<Body> {
    if task.in_space() || plan.levers() {
        return None;
    }
    let Carried { footprint: Footprint::Disc { radius }, pose: at, span: [from, _] } =
        task.robot.carried(tool, plan.lift())[0]?
    else {
        return None;
    };
    Some(Body {
        name: "hand".to_owned(),
        shape: Outline::Disc(length(radius)),
        height: length(SHOWN_HAND),
        under: length(from - plan.lift()),
        base: false,
        whole: None,
        more: Vec::new(),
        at: pose(&at),
    })
}

/// Converts a solid that is fixed to an object.
fn slab(slab: &Slab) -> Body {
    Body {
        name: String::new(),
        shape: Outline::Polygon(slab.corners.iter().map(|corner| point(*corner)).collect()),
        height: length(slab.height),
        under: length(slab.bottom),
        base: false,
        whole: None,
        more: Vec::new(),
        at: [0; 3],
    }
}

fn outline(shape: &Shape) -> Outline {
    match shape.footprint() {
        Footprint::Disc { radius } => Outline::Disc(length(radius)),
        Footprint::Rectangle { half } => {
            let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
            let corner = |(x, y): (f64, f64)| point(Vector::new(x * half.x, y * half.y));
            Outline::Polygon(corners.map(corner).to_vec())
        }
        Footprint::Polygon(polygon) => {
            Outline::Polygon(polygon.corners().iter().map(|corner| point(*corner)).collect())
        }
    }
}
