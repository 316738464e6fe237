//! Export of 3-D motions as a MuJoCo scene (MJCF): lever-ups, and pushes before or after them.
//!
//! Objects are bodies of meshes and boxes on the same feet as in our engine; the table is a cuboid.
//! Blades and tools are heavy, gravity-compensated free bodies whose pose *and* velocity the script
//! sets before every step, because a `mocap` body has no velocity. Until their step they wait far
//! away. Friction is the mean of the two values of a pair.

use std::sync::Arc;

use pushplan::asset::PlanFile;
use pushplan::geometry::{Footprint, Pose, Pose3, Shape, Vector, Vector3};
use pushplan::{
    outcome::LEVER_FRAMES,
    scene::{Blade, Body, GRAVITY, Part, Physics, Plate, Tool},
    task::{LeverJob, LeverMotion, Motion, Task},
};

use super::error::ExportError;
use super::forest::{Node, forest};
use super::solids::{Meets, Stage, body, slab_name};
use super::wanted::checks;
use super::xml::{Xml, numbers};

/// Script that executes scenes written by [`lever_mjcf()`], or by [`mjcf()`](super::mjcf()) for 3-D
/// plans, and prints their results.
pub const LEVER_SCRIPT: &str = pushplan_page::LEVER;

/// Time step, seconds. Sliding bodies in MuJoCo are pushed off slightly, less with shorter steps
/// and harder contacts. With twice this step and softer contacts, plates slide 3 mm, with this step
/// 1.5 mm, and hardly in our engine.
const STEP: f64 = 2.5e-4;

/// Contact compliance. It is set on the pairs themselves, because defaults of geoms do not apply to
/// them.
const CONTACT: [(&str, &str); 3] =
    [("condim", "3"), ("solref", "0.002 1"), ("solimp", "0.9 0.95 0.001")];

/// Ratio of friction impedance to normal impedance.
const FRICTION_HARDNESS: f64 = 10.0;

/// Mass of a prescribed body, kg, large enough that contacts do not move it.
const HAND_MASS: f64 = 1e4;

/// Waiting distance of a blade or a tool before its step, beyond the table, metres.
const AWAY: f64 = 50.0;

/// Returns the scene of a lever-up as MJCF. Names are `plate/NAME`, `block/NAME`, `blade/0` and
/// `table`; the section `custom` contains the motion of the blade.
pub fn lever_mjcf(job: &LeverJob) -> String {
    let tool = Arc::new(Tool::with_blade("blade", job.scene.blade));
    let motion = Motion::Lever(LeverMotion::new(tool, job.lever, None));
    let stage = Stage {
        plates: job.scene.plates.clone(),
        obstacles: &job.scene.blocks,
        table_friction: job.scene.table_friction,
        scene: None,
    };
    written("lever-up", &stage, (&[motion], &[]), (job.lever.plate, None))
}

/// Returns the scene of a plan in which an object leaves the plane, with its steps and goals.
///
/// # Errors
/// Returns [`ExportError::Tools`] or [`ExportError::JointLoop`].
pub(super) fn plan_mjcf(file: &PlanFile) -> Result<String, ExportError> {
    let motions = file.plan.motions(&file.tools).ok_or(ExportError::Tools)?;
    let scene = &file.task.scene;
    let stage = Stage {
        plates: scene.plates().collect(),
        obstacles: &scene.obstacles,
        table_friction: scene.table_friction,
        scene: Some((scene, Physics::stated(scene))),
    };
    let watched = file.task.levered().object;
    let trees = forest(scene)?;
    Ok(written(&file.task.name, &stage, (&motions, &trees), (watched, Some(&file.task))))
}

fn written(
    name: &str,
    stage: &Stage,
    (motions, trees): (&[Motion], &[Node]),
    (watched, task): (usize, Option<&Task>),
) -> String {
    let mut xml = Xml::default();
    xml.open("mujoco", &[("model", name.into())]);
    xml.comment("Written by pushplan. Metres, kilograms, seconds, radians. Play it with lever.py.");
    settings(&mut xml);
    xml.open("custom", &[]);
    for (k, motion) in motions.iter().enumerate() {
        step(&mut xml, stage, k, motion);
    }
    numeric(&mut xml, &format!("levered plate/{}", stage.plates[watched].name), &[1.0]);
    if let Some(task) = task {
        checks(&mut xml, task);
        for object in task.scene.objects.iter().filter(|object| object.may_fall) {
            numeric(&mut xml, &format!("may fall of plate/{}", object.name), &[1.0]);
        }
    }
    xml.close();
    xml.open("asset", &[]);
    meshes(&mut xml, &stage.plates);
    for (k, motion) in motions.iter().enumerate() {
        tool_meshes(&mut xml, k, motion);
    }
    xml.close();
    xml.open("worldbody", &[]);
    let others = fixed(&mut xml, stage);
    let mut plates: Vec<Vec<Meets>> = vec![Vec::new(); stage.plates.len()];
    match stage.scene {
        Some(_) => trees
            .iter()
            .for_each(|tree| body(&mut xml, stage, (tree.object, Some(tree)), &mut plates)),
        None => (0..stage.plates.len()).for_each(|k| body(&mut xml, stage, (k, None), &mut plates)),
    }
    let hands: Vec<Meets> =
        motions.iter().enumerate().flat_map(|(k, motion)| hand(&mut xml, k, motion)).collect();
    xml.close();
    xml.open("contact", &[]);
    for (k, solids) in plates.iter().enumerate() {
        let mounted = stage.scene.as_ref().is_some_and(|(scene, _)| scene.mount(k).is_some());
        let others = others.iter().filter(|one| !(mounted && one.2.is_none()));
        let later = (k + 1..plates.len()).filter(|other| !stage.is_rigid(k, *other));
        let later = later.flat_map(|other| &plates[other]);
        let all: Vec<&Meets> = others.chain(&hands).chain(later).collect();
        for one in solids {
            all.iter().for_each(|other| pair(&mut xml, stage, (one, other)));
        }
    }
    xml.finish()
}

fn settings(xml: &mut Xml) {
    xml.leaf("compiler", &[("angle", "radian".into()), ("autolimits", "true".into())]);
    let option = [
        ("timestep", numbers(&[STEP])),
        ("gravity", numbers(&[0.0, 0.0, -GRAVITY])),
        ("cone", "elliptic".into()),
        ("impratio", numbers(&[FRICTION_HARDNESS])),
    ];
    xml.open("option", &option);
    xml.leaf("flag", &[("multiccd", "enable".into())]);
    xml.close();
    xml.open("default", &[]);
    xml.comment("Only the pairs listed at the end collide.");
    xml.leaf("geom", &[("contype", "0".into()), ("conaffinity", "0".into())]);
    xml.leaf("pair", &CONTACT.map(|(key, value)| (key, value.to_owned())));
    xml.close();
}

/// Writes the table and the obstacles, and returns their solids.
fn fixed(xml: &mut Xml, stage: &Stage) -> Vec<Meets> {
    let mut others: Vec<Meets> = vec![("table".to_owned(), stage.table_friction, None)];
    let top = stage.scene.as_ref().and_then(|(scene, _)| scene.table_top);
    let (size, middle) = top.map_or(([4.0; 2], Vector::zeros()), |top| (top.size, top.middle));
    let position = Vector3::new(middle.x, middle.y, -0.25);
    let lying = Pose3 { position, ..Pose3::default() };
    cuboid(xml, "table", [size[0], size[1], 0.5], &lying);
    for (k, block) in stage.obstacles.iter().enumerate() {
        let name = format!("block/{}", block.name);
        let middle = Pose3::upright(block.pose, block.z + 0.5 * block.size[2]);
        cuboid(xml, &name, block.size, &middle);
        others.push((name, block.friction, Some(Body::Obstacle(k))));
    }
    others
}

/// Writes the motion of step `k`.
fn step(xml: &mut Xml, stage: &Stage, k: usize, motion: &Motion) {
    match motion {
        Motion::Lever(motion) => {
            let (lever, mut seen) = (&motion.lever, stage.plates[motion.lever.plate].clone());
            if let Some(expected) = motion.expected {
                seen.pose = expected;
            }
            let plate = format!("plate/{}", seen.name);
            xml.leaf("text", &[("name", format!("plate {k}")), ("data", plate)]);
            let frame = lever.frame_on(&seen);
            let [x, y, z, w] = frame.quaternion();
            let at = frame.position;
            let blade = motion.tool().blade().unwrap_or_default();
            numeric(xml, &format!("frame {k}"), &[at.x, at.y, at.z, w, x, y, z]);
            numeric(xml, &format!("blade {k}"), &[blade.length, blade.thickness]);
            let values = [
                lever.depth,
                lever.pivot,
                lever.angle,
                lever.turn_time(),
                lever.hold,
                lever.retreat,
                lever.speed,
                LEVER_FRAMES as f64,
            ];
            numeric(xml, &format!("lever {k}"), &values);
        }
        Motion::Slide(motion) => {
            let mut values = vec![motion.lift];
            for stroke in &motion.strokes {
                let of = |pose: &Pose| [pose.position.x, pose.position.y, pose.heading];
                values.extend(of(&stroke.from));
                values.extend(of(&stroke.to));
                values.extend([stroke.duration, f64::from(u8::from(stroke.settle))]);
            }
            numeric(xml, &format!("pushes {k}"), &values);
        }
    }
}

/// Writes the blade or the tool of step `k`, and returns its solids.
fn hand(xml: &mut Xml, k: usize, motion: &Motion) -> Vec<Meets> {
    let tool = motion.tool();
    let what = if motion.is_lever() { "blade" } else { "tool" };
    let name = format!("{what}/{k}");
    // Gravity is compensated because the solver would see blade and plate fall together, and let
    // the plate creep down the blade at some millimetres per second.
    let mut attributes = vec![("name", name.clone()), ("gravcomp", "1".to_owned())];
    let away = Vector3::new(AWAY + k as f64, 0.0, 0.0);
    attributes.extend(placed(&Pose3 { position: away, ..Pose3::default() }));
    xml.open("body", &attributes);
    xml.leaf("freejoint", &[]);
    let inertia = numbers(&[HAND_MASS; 3]);
    let mass = numbers(&[HAND_MASS]);
    xml.leaf("inertial", &[("pos", "0 0 0".into()), ("mass", mass), ("diaginertia", inertia)]);
    let mut solids = Vec::new();
    if let (true, Some(Blade { length, width, thickness, .. })) = (motion.is_lever(), tool.blade())
    {
        cuboid(xml, &name, [length, width, thickness], &Pose3::default());
        solids.push((name, tool.friction, Some(Body::Part(0))));
    } else {
        for (p, part) in tool.parts().iter().enumerate() {
            let name = format!("{name}/part-{}", p + 1);
            tool_part(xml, &name, part);
            solids.push((name, tool.friction, Some(Body::Part(p))));
        }
    }
    xml.close();
    solids
}

/// Writes a part of a tool in the tool frame, with its underside at height zero.
fn tool_part(xml: &mut Xml, name: &str, part: &Part) {
    let height = part.shape.height();
    let middle = Pose3::upright(part.pose, 0.5 * height);
    let (kind, size) = match part.shape {
        Shape::Cuboid { size } => return cuboid(xml, name, size, &middle),
        Shape::Cylinder { radius, .. } => ("cylinder", numbers(&[radius, 0.5 * height])),
        Shape::Prism { .. } => ("mesh", String::new()),
    };
    let mut attributes =
        vec![("name", name.to_owned()), ("type", kind.to_owned()), ("mass", "0".to_owned())];
    match kind {
        "mesh" => attributes.push(("mesh", name.to_owned())),
        _ => attributes.push(("size", size)),
    }
    attributes.extend(placed(&middle));
    xml.leaf("geom", &attributes);
}

/// Writes the outlines of a tool's prisms as meshes, about their middles.
fn tool_meshes(xml: &mut Xml, k: usize, motion: &Motion) {
    for (p, part) in motion.tool().parts().iter().enumerate() {
        if let Footprint::Polygon(polygon) = part.footprint() {
            let name = format!("tool/{k}/part-{}", p + 1);
            let half = 0.5 * part.shape.height();
            mesh(xml, name, polygon.corners(), [-half, half]);
        }
    }
}

fn mesh(xml: &mut Xml, name: String, corners: &[Vector], span: [f64; 2]) {
    let ring = |z: f64| corners.iter().flat_map(move |corner| [corner.x, corner.y, z]);
    let vertices: Vec<f64> = span.into_iter().flat_map(ring).collect();
    xml.leaf("mesh", &[("name", name), ("vertex", numbers(&vertices))]);
}

fn pair(xml: &mut Xml, stage: &Stage, (one, other): (&Meets, &Meets)) {
    let friction = stage.friction(one, other);
    let friction = numbers(&[friction, friction]);
    let geoms = [("geom1", one.0.clone()), ("geom2", other.0.clone()), ("friction", friction)];
    xml.leaf("pair", &geoms);
}

/// Writes the outlines of slabs as meshes.
fn meshes(xml: &mut Xml, plates: &[Plate]) {
    for plate in plates {
        for (k, slab) in plate.slabs.iter().enumerate() {
            let span = [slab.bottom, slab.bottom + slab.height];
            mesh(xml, slab_name(plate, k), &slab.corners, span);
        }
    }
}

pub(super) fn cuboid(xml: &mut Xml, name: &str, size: [f64; 3], pose: &Pose3) {
    let mut attributes = vec![
        ("name", name.to_owned()),
        ("type", "box".into()),
        ("size", numbers(&size.map(|extent| 0.5 * extent))),
        ("mass", "0".into()),
    ];
    attributes.extend(placed(pose));
    xml.leaf("geom", &attributes);
}

pub(super) fn placed(pose: &Pose3) -> [(&'static str, String); 2] {
    let [x, y, z, w] = pose.quaternion();
    [("pos", numbers(pose.position.as_slice())), ("quat", numbers(&[w, x, y, z]))]
}

fn numeric(xml: &mut Xml, name: &str, values: &[f64]) {
    xml.leaf("numeric", &[("name", name.into()), ("data", numbers(values))]);
}
