//! Extremes of one object, its tool and its push.

use std::f64::consts::TAU;
use std::sync::Arc;

use rand::Rng;

use pushplan::{
    geometry::{Pose, Shape, Vector},
    scene::{Object, Part, Scene, Tool},
};
use pushplan_lab::bench::Case;

use super::{
    base::{Draw, Solid, Way, shifted, wound},
    cell::{Cell, Kind},
};

/// Number of pushes of the cells that take minutes of simulated time each.
const FEW: usize = 6;

const NEVER_STOPS: &str = "without friction no object stops";

impl Solid {
    fn kind(self) -> Kind {
        match self {
            Solid::Cylinder => Kind::Cylinder,
            Solid::Cuboid => Kind::Cuboid,
        }
    }
}

/// Draws pushes on an object that `change` has made extreme, at a random heading.
fn on(draw: &Draw, solid: Solid, way: &Way, change: impl Fn(&mut Object)) -> Vec<Case> {
    draw.pushes(way, |rng| {
        let mut object = solid.object();
        object.pose.heading = rng.random_range(0.0..TAU);
        change(&mut object);
        Scene::new([object])
    })
}

/// Draws the ordinary pushes of `solid`.
pub fn ordinary(draw: &Draw, solid: Solid) -> Vec<Case> {
    on(draw, solid, &Way::default(), |_| {})
}

/// Returns all cells of one object.
pub fn cells(draw: &Draw) -> Vec<Cell> {
    let mut cells = Vec::new();
    for solid in Solid::BOTH {
        bodies(draw, solid, &mut cells);
        pushes(draw, solid, &mut cells);
        places(draw, solid, &mut cells);
        tools(draw, solid, &mut cells);
        corners(draw, solid, &mut cells);
    }
    cells
}

fn bodies(draw: &Draw, solid: Solid, cells: &mut Vec<Cell>) {
    let kind = solid.kind();
    let way = Way::default();
    let mut add = |factor, value: String, cases| {
        cells.push(Cell::new(factor, value, kind, cases));
    };
    for (size, name) in [
        (0.005, "5 mm"),
        (0.01, "1 cm"),
        (0.02, "2 cm"),
        (0.03, "3 cm"),
        (0.2, "20 cm"),
        (0.3, "30 cm"),
        (0.5, "50 cm"),
        (1.0, "1 m"),
    ] {
        let cases = on(draw, solid, &way, |object| object.shape = solid.sized(size).shape);
        add("size", name.into(), cases);
    }
    for mass in [0.001, 1000.0] {
        add("mass", format!("{mass} kg"), on(draw, solid, &way, |object| object.mass = mass));
    }
    if let Solid::Cuboid = solid {
        for aspect in [3.0, 6.0, 10.0, 30.0, 100.0] {
            let shape = Shape::Cuboid { size: [0.2, 0.2 / aspect, 0.1] };
            let cases = on(draw, solid, &way, |object| object.shape = shape);
            add("aspect ratio", format!("1:{aspect}"), cases);
        }
    }
    for friction in [0.0, 0.01, 0.05, 0.1, 1.0, 1.5] {
        let all = on(draw, solid, &way, |object| object.friction = friction);
        let mut all: Vec<Case> = all;
        for case in &mut all {
            case.scene.table_friction = friction;
            case.motion.tool = Arc::new(Tool::clone(&case.motion.tool).friction(friction));
        }
        let cell = Cell::new("friction of all", friction.to_string(), kind, all);
        cells.push(if friction == 0.0 { cell.doubted(NEVER_STOPS) } else { cell });
    }
    for friction in [0.0, 1.5] {
        let mut cases = ordinary(draw, solid);
        for case in &mut cases {
            case.motion.tool = Arc::new(Tool::clone(&case.motion.tool).friction(friction));
        }
        cells.push(Cell::new("friction of the tool", friction.to_string(), kind, cases));
    }
}

fn pushes(draw: &Draw, solid: Solid, cells: &mut Vec<Cell>) {
    let kind = solid.kind();
    for (speed, name) in [
        (0.001, "1 mm/s"),
        (0.01, "1 cm/s"),
        (0.03, "3 cm/s"),
        (0.3, "0.3 m/s"),
        (0.5, "0.5 m/s"),
        (1.0, "1 m/s"),
        (2.0, "2 m/s"),
    ] {
        let draw = if speed < 0.01 { &draw.with(FEW) } else { draw };
        let cases = on(draw, solid, &Way { speed, ..Way::default() }, |_| {});
        cells.push(Cell::new("speed", name, kind, cases));
    }
    for (gap, name) in [(0.0001, "0.1 mm"), (0.5, "50 cm")] {
        let way = Way { gap, travel: 0.2 + gap, ..Way::default() };
        cells.push(Cell::new("gap at the start", name, kind, on(draw, solid, &way, |_| {})));
    }
    for (travel, name) in [(0.001, "1 mm"), (0.01, "1 cm"), (2.0, "2 m")] {
        let way = Way { travel, gap: 0.0001, ..Way::default() };
        cells.push(Cell::new("travel", name, kind, on(draw, solid, &way, |_| {})));
    }
    for (depth, name) in [(0.0005, "0.5 mm"), (0.005, "5 mm"), (0.03, "3 cm")] {
        let mut cases = ordinary(draw, solid);
        for stroke in cases.iter_mut().flat_map(|case| &mut case.motion.strokes) {
            let ahead = (stroke.to.position - stroke.from.position).normalize();
            stroke.from.position += ahead * (Way::default().gap + depth);
        }
        cells.push(Cell::new("tool set down into the object", name, kind, cases));
    }
    for (turn, name) in [
        (2.0, "2\u{b0}"),
        (5.0, "5\u{b0}"),
        (10.0, "10\u{b0}"),
        (20.0, "20\u{b0}"),
        (90.0, "90\u{b0}"),
    ] {
        let mut cases = ordinary(draw, solid);
        for stroke in cases.iter_mut().flat_map(|case| &mut case.motion.strokes) {
            stroke.to.heading += f64::to_radians(turn);
        }
        cells.push(Cell::new("turn of the tool in a push", name, kind, cases));
    }
}

fn places(draw: &Draw, solid: Solid, cells: &mut Vec<Cell>) {
    let kind = solid.kind();
    let ordinary = ordinary(draw, solid);
    for (far, name) in [(10.0, "10 m"), (1000.0, "1 km"), (1e6, "1000 km")] {
        let shift = Vector::new(0.8, -0.6) * far;
        let cases = ordinary.iter().map(|case| shifted(case.clone(), shift)).collect();
        cells.push(Cell::new("distance from the origin", name, kind, cases));
    }
    for turns in [1e3, 1e6] {
        let cases = ordinary.iter().map(|case| wound(case.clone(), turns * TAU)).collect();
        cells.push(Cell::new("turns of every heading", turns.to_string(), kind, cases));
    }
    // A wide face that the object cannot leave at once, for up to 10,000 frames.
    let way = Way { travel: 100.0, speed: 0.3, tool: Some(bar([0.02, 0.5])), ..Way::default() };
    let cases = on(&draw.with(FEW), solid, &way, |_| {});
    cells.push(Cell::new("frames in a rollout", "10000", kind, cases));
}

fn tools(draw: &Draw, solid: Solid, cells: &mut Vec<Cell>) {
    let kind = solid.kind();
    let mut add = |value: &str, tool: Arc<Tool>| {
        let way = Way { tool: Some(tool), ..Way::default() };
        cells.push(Cell::new("tool", value, kind, on(draw, solid, &way, |_| {})));
    };
    add("1 mm by 20 cm", bar([0.001, 0.2]));
    add("2 m by 2 m", bar([2.0, 2.0]));
    add("5 mm by 5 mm", bar([0.005, 0.005]));
    for (radius, name) in [(0.001, "disc of 1 mm"), (0.3, "disc of 30 cm")] {
        let shape = Shape::Cylinder { radius, height: 0.05 };
        add(name, tool(vec![Part::new("disc", shape, Pose::default())]));
    }
    let teeth = (0..32).map(|k| {
        let pose = Pose::new(0.0, 0.02 * f64::from(k), 0.0);
        Part::cuboid(format!("tooth-{k}"), [0.05, 0.02, 0.05], pose)
    });
    add("32 parts in a row", tool(teeth.collect()));
}

/// Adds cells with several factors, each just outside or at the end of the training range.
fn corners(draw: &Draw, solid: Solid, cells: &mut Vec<Cell>) {
    let kind = solid.kind();
    let mut add = |value: &str, size: f64, friction: f64, speed: f64| {
        let way = Way { speed, ..Way::default() };
        let mut cases = on(draw, solid, &way, |object| {
            object.shape = solid.sized(size).shape;
            object.friction = friction;
        });
        for case in &mut cases {
            case.scene.table_friction = friction;
        }
        cells.push(Cell::new("corner", value, kind, cases));
    };
    add("smallest trained, fastest, smoothest", 0.045, 0.1, 0.3);
    add("largest trained, slowest, roughest", 0.16, 1.0, 0.03);
    for (speed, friction) in
        [(0.3, 0.5), (0.3, 0.3), (0.3, 0.2), (0.3, 0.15), (0.3, 0.1), (0.2, 0.1), (0.15, 0.1)]
    {
        add(&format!("{speed} m/s, friction {friction}"), 0.1, friction, speed);
    }
    add("1 cm, 1 m/s, friction 0.05", 0.01, 0.05, 1.0);
    add("1 m, 2 m/s, friction 1.5", 1.0, 1.5, 2.0);
}

/// Returns a tool of a cuboid with these horizontal extents (metres).
fn bar([x, y]: [f64; 2]) -> Arc<Tool> {
    tool(vec![Part::cuboid("bar", [x, y, 0.05], Pose::default())])
}

fn tool(parts: Vec<Part>) -> Arc<Tool> {
    // The parts above are side by side, so no joint has to be found.
    let joints: Vec<[usize; 2]> = (1..parts.len()).map(|k| [k - 1, k]).collect();
    Arc::new(Tool::joined("extreme", parts, &joints).expect("one piece"))
}
