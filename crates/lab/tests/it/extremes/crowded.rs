//! Extremes of several objects: numbers, mass ratios, chains of joints, overlaps, walls.

use std::f64::consts::TAU;

use rand::Rng;

use pushplan::{
    geometry::{Pose, Vector},
    scene::{JointKind, Object, Obstacle, Scene, Span},
};
use pushplan_lab::bench::Case;
use pushplan_learn::dataset::{Crowd, Preset, Solids, random_scene};

use super::{
    base::{Draw, Solid, Way, shifted, wound},
    cell::{Cell, Kind},
};

/// Gap between the cans of a row, metres.
const ROW_GAP: f64 = 0.01;

const SINKING: &str = "bodies of very different mass sink into each other, or need stiff contacts";
const THROWN: &str = "the engine throws overlapping bodies apart";
const CRUSHED: &str = "no body can move: the engine presses the object into tool or wall";

/// Draws a given number of touching objects from the training ranges.
pub fn touching(draw: &Draw, count: usize) -> Vec<Case> {
    let crowd = Crowd { count, solids: Solids::Any, touching: 0.8, polygons: 0.0 };
    draw.pushes(&Way::default(), |rng| random_scene(rng, &Preset::Tools.ranges(), crowd))
}

/// Returns a row of cans, each joined to the next.
pub fn row(draw: &Draw, count: usize, kind: fn(Vector) -> JointKind) -> Vec<Case> {
    draw.pushes(&Way::default(), |rng| turned(rng, row_scene(count, kind)))
}

/// Returns a joint about a free axis at the point between two neighbours.
pub fn hinge(at: Vector) -> JointKind {
    JointKind::Revolute { at, limits: None }
}

fn slide(_: Vector) -> JointKind {
    JointKind::Prismatic { axis: Vector::x(), limits: Some(Span::new(-0.05, 0.05)) }
}

fn rigid(_: Vector) -> JointKind {
    JointKind::Fixed
}

/// Returns all cells of several objects.
pub fn cells(draw: &Draw) -> Vec<Cell> {
    let mut cells = Vec::new();
    let several = Kind::Several;
    for count in [2, 5, 8, 12, 20, 30] {
        let cases = touching(draw, count);
        cells.push(Cell::new("number of objects", count.to_string(), several, cases));
    }
    let far = Vector::new(800.0, -600.0);
    let cases = touching(draw, 3).into_iter().map(|case| shifted(case, far)).collect();
    cells.push(Cell::new("distance from the origin", "1 km", several, cases));
    mass_ratios(draw, &mut cells);
    overlaps(draw, &mut cells);
    walls(draw, &mut cells);
    chains(draw, &mut cells);
    cells
}

/// Adds cells of two objects in a row, with the tool on either side.
fn mass_ratios(draw: &Draw, cells: &mut Vec<Cell>) {
    for ratio in [3.0, 10.0, 30.0, 100.0, 1000.0] {
        let cases = draw.pushes(&Way::default(), |rng| {
            let mut scene = pair(rng, 0.0);
            scene.objects[1].mass = 0.1;
            scene.objects[0].mass = 0.1 * ratio;
            scene
        });
        let cell = Cell::new("ratio of masses", format!("1:{ratio}"), Kind::Several, cases);
        cells.push(if ratio > 10.0 { cell.doubted(SINKING) } else { cell });
    }
    // A light object between heavy ones, which task files do not allow.
    let cases = draw.pushes(&Way::default(), |rng| {
        let mut scene = row_scene(5, rigid);
        scene.joints.clear();
        for (k, object) in scene.objects.iter_mut().enumerate() {
            object.pose.position.x *= 0.1 / (0.1 + ROW_GAP);
            object.mass = if k % 2 == 0 { 10.0 } else { 0.01 };
        }
        turned(rng, scene)
    });
    let cell = Cell::new("ratio of masses", "10 kg, 10 g in turn", Kind::Several, cases);
    cells.push(cell.doubted(SINKING));
}

fn overlaps(draw: &Draw, cells: &mut Vec<Cell>) {
    for (depth, name) in [
        (0.0001, "0.1 mm"),
        (0.001, "1 mm"),
        (0.005, "5 mm"),
        (0.02, "2 cm"),
        (0.1, "one in the other"),
    ] {
        let cases = draw.pushes(&Way::default(), |rng| pair(rng, depth));
        let cell = Cell::new("objects overlap at the start", name, Kind::Several, cases);
        cells.push(if depth > 0.02 { cell.doubted(THROWN) } else { cell });
    }
}

/// Adds cells of an object before a wall, pushed towards it.
fn walls(draw: &Draw, cells: &mut Vec<Cell>) {
    for (gap, name) in
        [(0.19, "just reached"), (0.15, "after 15 cm of 20"), (0.05, "after 5 cm of 20")]
    {
        for solid in Solid::BOTH {
            let mut cases = draw.pushes(&Way::default(), |rng| {
                let mut object = solid.object();
                object.pose.heading = rng.random_range(0.0..TAU);
                Scene::new([object])
            });
            for case in &mut cases {
                wall(case, gap);
            }
            let kind = match solid {
                Solid::Cylinder => Kind::Cylinder,
                Solid::Cuboid => Kind::Cuboid,
            };
            let cell = Cell::new("a wall ahead", name, kind, cases);
            cells.push(if gap < 0.18 { cell.doubted_if_crushed(CRUSHED) } else { cell });
        }
    }
}

/// Adds a wide wall perpendicular to the push, `gap` metres ahead of the object.
fn wall(case: &mut Case, gap: f64) {
    let Some(stroke) = case.motion.strokes.first() else { return };
    let ahead = (stroke.to.position - stroke.from.position).normalize();
    let object = &case.scene.objects[0];
    let reach = object.shape.footprint().extent(object.pose.local_vector(ahead));
    let centre = object.pose.position + ahead * (reach + gap + 0.02);
    case.scene.obstacles.push(Obstacle {
        name: "wall".into(),
        size: [0.04, 3.0, 0.2],
        pose: Pose { position: centre, heading: ahead.y.atan2(ahead.x) },
        z: 0.0,
        friction: 0.5,
    });
}

fn chains(draw: &Draw, cells: &mut Vec<Cell>) {
    let jointed = Kind::Jointed;
    for joints in [1, 5, 8, 11, 12] {
        let cases = row(draw, joints + 1, hinge);
        cells.push(Cell::new("revolute joints in a row", joints.to_string(), jointed, cases));
    }
    for joints in [5, 12] {
        let cases = row(draw, joints + 1, slide);
        cells.push(Cell::new("prismatic joints in a row", joints.to_string(), jointed, cases));
    }
    for joints in [5, 12] {
        let cases = row(draw, joints + 1, rigid);
        cells.push(Cell::new("fixed joints in a row", joints.to_string(), jointed, cases));
    }
    let far = Vector::new(800.0, -600.0);
    let cases = row(draw, 3, hinge).into_iter().map(|case| shifted(case, far)).collect();
    cells.push(Cell::new("distance from the origin", "1 km", jointed, cases));
    let cases = row(draw, 3, hinge).into_iter().map(|case| wound(case, 1000.0 * TAU)).collect();
    cells.push(Cell::new("turns of every heading", "1000", jointed, cases));
}

fn row_scene(count: usize, kind: fn(Vector) -> JointKind) -> Scene {
    let pitch = 0.1 + ROW_GAP;
    let object = |k: usize| Object {
        name: format!("can-{k}"),
        pose: Pose::new(pitch * k as f64, 0.0, 0.0),
        ..Solid::Cylinder.object()
    };
    let pins = (1..count).map(|k| (k, kind(Vector::new(pitch * (k as f64 - 0.5), 0.0))));
    pins.fold(Scene::new((0..count).map(object)), |scene, (k, kind)| {
        scene.with_joint([k - 1, k], kind)
    })
}

/// Returns a can and a brick that touch, or overlap by `depth` metres.
fn pair(rng: &mut rand_pcg::Pcg64, depth: f64) -> Scene {
    let (mut can, mut brick) = (Solid::Cylinder.object(), Solid::Cuboid.object());
    (can.name, brick.name) = ("can".into(), "brick".into());
    brick.pose.position.x = 0.10 - depth;
    turned(rng, Scene::new([can, brick]))
}

/// Returns the scene rotated by a random angle about the origin.
fn turned(rng: &mut rand_pcg::Pcg64, mut scene: Scene) -> Scene {
    let turn = Pose::new(0.0, 0.0, rng.random_range(0.0..TAU));
    for object in &mut scene.objects {
        object.pose = turn * object.pose;
    }
    for joint in &mut scene.joints {
        match &mut joint.kind {
            JointKind::Fixed => {}
            JointKind::Revolute { at, .. } => *at = turn.point(*at),
            JointKind::Prismatic { axis, .. } => *axis = turn.vector(*axis),
        }
    }
    scene
}
