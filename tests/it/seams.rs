//! Flush parts of a tool act as one body: an object that slides along a row of parts moves as along
//! one cuboid.
//!
//! Engines and contact solvers treat each solid separately. A box whose flat side touches a row of
//! parts sinks in by micrometres, so the corner of the next part seems to obstruct it. Before tools
//! had outlines, 30 % of the pushes below ended with more than 3 mm error.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use pushplan::effect::{EffectModel, EffectModels, Network, Prior, Simulated};
use pushplan::geometry::{Pose, Vector};
use pushplan::sim::Simulator;
use pushplan::{
    outcome::Record,
    scene::{Object, Part, Scene, Situation, Tool},
    task::{Job, Stroke, ToolMotion},
};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Maximum difference between parts and one cuboid, metres.
const SAME: f64 = 1e-4;

/// Maximum difference in 3-D, where the box rocks on its feet: tiny differences decide which feet
/// carry the load, and thereby its rotation. The largest observed difference is 0.45 mm.
const SAME_TIPPING: f64 = 5e-4;

/// Maximum difference of the network, for which the cuboid alone is a smaller tool.
const SAME_EXTENT: f64 = 2e-3;

/// Number of draws for each face and model.
const DRAWS: usize = 40;

/// Face of a tool, and a tool of one cuboid with the same face.
struct Face {
    name: &'static str,
    parts: Vec<Part>,
    alone: Part,
    /// Outward direction of the face, radians in the tool frame.
    looks: f64,
    /// Middle of the face in the tool frame, metres.
    middle: Vector,
    /// Maximum distance of the box's start from the middle, metres.
    room: f64,
}

fn cuboid(x: f64, y: f64, width: f64, height: f64) -> Part {
    Part::cuboid(format!("{x} {y}"), [width, height, 0.05], Pose::new(x, y, 0.0))
}

fn row(count: usize) -> Vec<Part> {
    (0..count).map(|k| cuboid(0.12 + 0.14 * k as f64, 0.0, 0.14, 0.08)).collect()
}

fn hook() -> Vec<Part> {
    let bar = Part::cuboid("bar", [0.16, 0.08, 0.05], Pose::new(0.43, 0.12, FRAC_PI_2));
    row(3).into_iter().chain([bar]).collect()
}

fn rake() -> Vec<Part> {
    vec![
        cuboid(0.225, 0.0, 0.43, 0.03),
        cuboid(0.455, 0.0, 0.03, 0.24),
        cuboid(0.42, 0.105, 0.04, 0.03),
        cuboid(0.42, -0.105, 0.04, 0.03),
    ]
}

fn faces() -> Vec<Face> {
    let halved = |count: usize| -> Vec<Part> {
        let width = 0.42 / count as f64;
        (0..count).map(|k| cuboid(0.05 + (k as f64 + 0.5) * width, 0.0, width, 0.08)).collect()
    };
    let side = |name, parts, alone| Face {
        name,
        parts,
        alone,
        looks: FRAC_PI_2,
        middle: Vector::new(0.26, 0.04),
        room: 0.10,
    };
    let whole = cuboid(0.26, 0.0, 0.42, 0.08);
    vec![
        side("row of three", row(3), whole.clone()),
        side("row of six", halved(6), whole.clone()),
        side("stick", row(4), cuboid(0.33, 0.0, 0.56, 0.08)),
        Face {
            name: "end of the hook",
            parts: hook(),
            alone: cuboid(0.43, 0.08, 0.08, 0.24),
            looks: 0.0,
            middle: Vector::new(0.47, 0.08),
            room: 0.06,
        },
        Face {
            name: "back of the hook",
            parts: hook(),
            alone: whole,
            looks: -FRAC_PI_2,
            middle: Vector::new(0.30, -0.04),
            room: 0.10,
        },
        Face {
            name: "end of the rake",
            parts: rake(),
            alone: cuboid(0.455, 0.0, 0.03, 0.24),
            looks: 0.0,
            middle: Vector::new(0.47, 0.0),
            room: 0.06,
        },
    ]
}

fn tool(parts: Vec<Part>) -> Arc<Tool> {
    Arc::new(Tool::new("tool", parts).expect("one piece"))
}

/// Returns a box beside a face, and a motion of the tool that makes it slide along the face.
fn slide(face: &Face, parts: Vec<Part>, random: &mut Pcg64) -> (Scene, Job) {
    let size = [random.random_range(0.05..0.09), random.random_range(0.05..0.09), 0.08];
    let aside = random.random_range(-face.room..face.room);
    // Away from the side on which the box starts, so that it slides over the middle.
    let lean = -aside.signum() * random.random_range(30f64..57.0).to_radians();
    let turn = random.random_range(-17f64..17.0).to_radians();
    let flush = random.random_bool(0.5);
    let outwards = Pose { position: face.middle, heading: face.looks };
    let tool_pose = Pose::new(0.3, -0.2, random.random_range(-3.0..3.0));
    let turn = if flush { 0.0 } else { turn };
    let half: f64 = turn.cos() * size[0] / 2.0 + turn.sin().abs() * size[1] / 2.0;
    let at = tool_pose * outwards * Pose::new(half + 1e-3, aside, turn);
    let object = Object {
        mass: random.random_range(0.2..1.0),
        friction: 0.4,
        pose: at,
        ..Object::cuboid("box", size)
    };
    let scene = Scene { table_friction: 0.5, objects: vec![object], ..Scene::default() };
    // The tool moves against the slide: along the face towards the box's side.
    let way = (tool_pose * outwards).vector(Vector::new(lean.cos(), -lean.sin()));
    let to = Pose { position: tool_pose.position + 0.15 * way, ..tool_pose };
    let stroke = Stroke { from: tool_pose, to, duration: 1.5, settle: true };
    let motion = ToolMotion { tool: tool(parts), lift: 0.002, strokes: vec![stroke] };
    let job = Job::new(&Situation::stated(&scene), motion);
    (scene, job)
}

fn moves_as_along_one_cuboid(model: &dyn EffectModel, same: f64) {
    for face in faces() {
        let mut slid = 0;
        for draw in 0..DRAWS {
            let end = |parts: Vec<Part>| {
                let (scene, job) = slide(&face, parts, &mut Pcg64::seed_from_u64(draw as u64));
                let trajectory = model.rollout(&scene, &[job], Record::Outcome).remove(0);
                let start = scene.objects[0].pose;
                (start, trajectory.outcome().poses[0])
            };
            let (start, joined) = end(face.parts.clone());
            let (_, alone) = end(vec![face.alone.clone()]);
            let apart = (joined.position - alone.position).norm();
            let name = model.spec();
            assert!(apart <= same, "{name}, {}, draw {draw}: {:.2} mm", face.name, 1e3 * apart);
            slid += usize::from((alone.position - start.position).norm() > 0.03);
        }
        assert!(slid > DRAWS / 2, "{}: only {slid} were pushed", face.name);
    }
}

#[test]
fn in_the_planar_engine() {
    moves_as_along_one_cuboid(&Simulated::new(Simulator::planar()), SAME);
}

#[test]
fn in_the_3d_engine() {
    moves_as_along_one_cuboid(&Simulated::new(Simulator::spatial()), SAME_TIPPING);
}

#[test]
fn by_the_prior() {
    moves_as_along_one_cuboid(&Prior::default(), SAME);
}

#[test]
fn by_the_network() {
    let weights = EffectModels::weights().expect("the shipped weights");
    moves_as_along_one_cuboid(&Network::new(weights), SAME_EXTENT);
}
