//! Export of a plan as a MuJoCo scene (MJCF), with pushes and goal.
//!
//! The scene contains the same physics as our 3-D engine: gravity, the table, obstacles, and
//! objects with masses, joints and support points. Friction of every pair is the mean of two
//! values, and no force stops the tool.
//!
//! The tool is held by two slide joints (and a hinge if it rotates), whose positions *and*
//! velocities the script sets before every step. A `mocap` body would have no velocity, so that a
//! pushed object would rub against it as if it were at rest. A box pushed 10 degrees off its normal
//! then slips by 35 mm of 200 instead of sticking.
//!
//! MuJoCo's friction is convex: an object that slides at v is pushed off the surface by mu b v,
//! with b = 2 / (d timeconst) of the friction constraint. Against this acts (1 - d) / d of the
//! load, shared by its points. With the default impedance (d = 0.9) every slide is a sequence of
//! hops, and sticking contacts at the tool slip. [`CONTACT`] keeps the second term above the first
//! up to 0.5 m/s.
//!
//! Free slides then end within 0.1 mm of v^2 / (2 mu g), and 20 cm pushes within 0.6 mm of
//! Coulomb's law, flush or oblique (`tests/it/export/mujoco.rs`). Half the step moved the ends of
//! eight shipped plans by at most 0.3 mm.

use pushplan::asset::PlanFile;
use pushplan::geometry::{Pose, Shape};
use pushplan::{
    outcome::step_states,
    scene::{Feet, GRAVITY, JointTrajectory, Object, Scene, TableTop, Tool},
    task::{Task, ToolMotion, TravelLeg},
};
use pushplan_arm::Arm;

use super::ExportError;
use super::arm;
use super::forest::{Node, forest};
use super::hinges;
use super::mesh;
use super::pairs;
use super::regions;
use super::seamless::seamless;
use super::space::plan_mjcf;
use super::strokes::{numeric, retreats, strokes, travel, turns};
use super::tool::{Taken, taken, tool};
use super::wanted::wanted;
use super::xml::{Xml, numbers};

/// Script that executes any number of scenes written by [`mjcf()`] and prints their results. It
/// needs Python 3.11 and the package `mujoco`, tested with 3.3 and 4.0.
pub const REPLAY_SCRIPT: &str = pushplan_page::REPLAY;

/// Script that executes scenes written by [`motion_mjcf()`], one after another, and prints all
/// poses at the end of every frame. It imports [`REPLAY_SCRIPT`], stored next to it as `replay.py`.
pub const FRAMES_SCRIPT: &str = pushplan_page::FRAMES;

/// Time step, seconds.
const STEP: f64 = 2.5e-4;

/// Ratio of friction impedance to normal impedance; sticking contacts then creep by micrometres per
/// second.
const FRICTION_HARDNESS: f64 = 1e5;

/// Contact compliance, see the module documentation. The time constant of the load is 4 ms (16
/// steps), because several points of a body add up, and with 4 steps some are unstable. The time
/// constant of friction is 200 ms (with d = 0.03, b = 333/s).
const CONTACT: [(&str, &str); 4] = [
    ("condim", "3"),
    ("solref", "0.004 1"),
    ("solimp", "0.03 0.03 0.001"),
    ("solreffriction", "0.2 1"),
];

/// Radius of an object's support points, metres. The object's solid itself does not touch the
/// table, because MuJoCo would support it at corners.
const FOOT: f64 = 1e-3;

/// Thickness of a finite table, metres: nothing gets below it.
const TABLE_DEPTH: f64 = 0.5;

/// Clearance of a cuboid or prism above the table, metres. It touches the table only if it tips
/// beyond its feet. On a finite table, so does a cylinder, which the edge may have to support. On
/// an unlimited one it never touches, because MuJoCo's contact of cylinder and plane topples
/// standing cylinders.
const CLEAR: f64 = 5e-4;

/// Returns the scene of `file`'s task with its tool and the plan's pushes, as MJCF. For a plan with
/// an arm the scene contains the arm and its joint trajectory.
///
/// Names are `object/NAME`, `obstacle/NAME`, `region/NAME`, `arm/LINK` and `tool/PARTS`; flush
/// parts are one solid. The section `custom` contains the pushes, the goal, our rules and the end
/// of our own 3-D replay (if the file has one).
///
/// # Errors
/// Returns [`ExportError::JointLoop`] or [`ExportError::Tools`].
pub fn mjcf(file: &PlanFile) -> Result<String, ExportError> {
    if file.task.in_space() || file.plan.levers() {
        return plan_mjcf(file);
    }
    let motions = file.plan.slides(&file.tools).ok_or(ExportError::Tools)?;
    let holder = match (file.task.arm.as_deref().and_then(|arm| arm.downcast()), &file.joints) {
        (Some(arm), Some(path)) => Holder::Arm(arm, path),
        _ => Holder::Lifting(&file.task, legs(file)),
    };
    written(&file.task.name, &file.task.scene, (&motions, holder), |xml| wanted(xml, file))
}

/// Returns the scene with the tool and its strokes, as MJCF, without a goal: for training data.
/// Here the tool may rotate during a stroke.
///
/// # Errors
/// Returns [`ExportError::JointLoop`].
pub fn motion_mjcf(name: &str, scene: &Scene, motion: &ToolMotion) -> Result<String, ExportError> {
    written(name, scene, (std::slice::from_ref(motion), Holder::Table), |_| ())
}

/// Holder of the tools.
enum Holder<'a> {
    /// Holder that never leaves the table.
    Table,
    /// Hand that lifts the tools as a robot would, and their travel.
    Lifting(&'a Task, Vec<TravelLeg>),
    /// Arm with its joint trajectory; it has one tool.
    Arm(&'a Arm, &'a JointTrajectory),
}

/// Writes the scene, with the elements added by `wanted`.
fn written(
    name: &str,
    scene: &Scene,
    (motions, holder): (&[ToolMotion], Holder<'_>),
    wanted: impl FnOnce(&mut Xml),
) -> Result<String, ExportError> {
    let trees = forest(scene)?;
    let mut xml = Xml::default();
    xml.open("mujoco", &[("model", name.to_owned())]);
    xml.comment(
        "Written by pushplan. Metres, kilograms, seconds, radians. Play it with replay.py.",
    );
    let tools = taken(motions);
    let solids = solids(scene, &tools);
    settings(&mut xml, mesh::are_among(&solids));
    xml.open("custom", &[]);
    wanted(&mut xml);
    strokes(&mut xml, motions);
    let number = |name: &str| {
        let own = |one: &Taken| one.motion.tool.name == name;
        tools.iter().position(own).unwrap_or(0) as f64 + 1.0
    };
    if tools.len() > 1 {
        let of = |motion: &ToolMotion| vec![number(&motion.tool.name); motion.strokes.len()];
        xml.comment("Tool of each push.");
        numeric(&mut xml, "tools", &motions.iter().flat_map(of).collect::<Vec<_>>());
    }
    match &holder {
        Holder::Table => (),
        Holder::Lifting(task, legs) => {
            retreats(&mut xml, scene, motions);
            travel(&mut xml, task, (legs, motions), number);
        }
        Holder::Arm(_, path) => arm::way(&mut xml, path),
    }
    xml.close();
    mesh::meshes(&mut xml, &solids);
    if let Holder::Arm(arm, _) = &holder {
        arm::meshes(&mut xml, arm);
    }
    xml.open("worldbody", &[]);
    let friction = numbers(&[scene.table_friction]);
    let mut table = vec![("name", "table".into())];
    match scene.table_top {
        None => table.extend([("type", "plane".into()), ("size", "0 0 1".into())]),
        Some(TableTop { size: [x, y], middle }) => table.extend([
            ("type", "box".into()),
            ("size", numbers(&[0.5 * x, 0.5 * y, 0.5 * TABLE_DEPTH])),
            ("pos", numbers(&[middle.x, middle.y, -0.5 * TABLE_DEPTH])),
        ]),
    }
    table.push(("friction", friction));
    xml.leaf("geom", &table);
    for obstacle in &scene.obstacles {
        let name = format!("obstacle/{}", obstacle.name);
        let height = obstacle.z + obstacle.size[2] / 2.0;
        let material = (0.0, obstacle.friction);
        solid(&mut xml, name, &obstacle.shape(), &obstacle.pose, height, material);
    }
    regions::geoms(&mut xml, scene);
    for tree in &trees {
        body(&mut xml, scene, tree);
    }
    let turns = turns(motions);
    for (k, one) in tools.iter().enumerate() {
        match &holder {
            Holder::Arm(arm, _) if k == 0 => arm::bodies(&mut xml, arm, &one.motion.tool),
            Holder::Arm(..) => {}
            Holder::Lifting(task, _) => {
                let hand = task.robot.carried(&one.motion.tool, one.motion.lift)[0];
                tool(&mut xml, one, turns, hand, true);
            }
            Holder::Table => tool(&mut xml, one, turns, None, false),
        }
    }
    xml.close();
    xml.comment("Friction is the mean of the two values; all other pairs do not collide.");
    xml.open("contact", &[]);
    let named: Vec<(&str, &Tool)> =
        tools.iter().map(|one| (one.prefix.as_str(), &*one.motion.tool)).collect();
    for pair in pairs::pairs(scene, &named) {
        pair.write(&mut xml);
    }
    if let (Holder::Arm(arm, _), Some(one)) = (&holder, tools.first()) {
        for pair in arm::pairs(arm, scene, &one.motion.tool) {
            pair.write(&mut xml);
        }
        xml.close();
        arm::servos(&mut xml, arm);
    }
    Ok(xml.finish())
}

/// Returns the travel of the lifted tools of a plan, with the objects where its 3-D replay, if any,
/// has them.
fn legs(file: &PlanFile) -> Vec<TravelLeg> {
    let evidence = file.verdict.as_ref().map_or(&[][..], |verdict| &verdict.evidence);
    let scene = &file.task.scene;
    let states = step_states(&scene.start(), file.plan.steps.len(), evidence);
    file.task.legs(scene, &file.tools, &file.plan, &states).unwrap_or_default()
}

pub(super) fn object_name(object: &Object) -> String {
    format!("object/{}", object.name)
}

/// Returns the name of foot `index` of an object.
pub(super) fn foot_name(object: &Object, index: usize) -> String {
    format!("object/{}/foot-{}", object.name, index + 1)
}

fn settings(xml: &mut Xml, meshes: bool) {
    xml.leaf("compiler", &[("angle", "radian".into()), ("autolimits", "true".into())]);
    let option = [
        ("timestep", numbers(&[STEP])),
        ("gravity", numbers(&[0.0, 0.0, -GRAVITY])),
        ("cone", "elliptic".into()),
        ("impratio", numbers(&[FRICTION_HARDNESS])),
    ];
    xml.open("option", &option);
    if meshes {
        xml.comment(
            "With a single contact point, a prism pushed by a flush face would slip sideways, by 3 \
             %.",
        );
        xml.leaf("flag", &[("multiccd", "enable".into())]);
    } else {
        xml.comment(
            "Several contact points of a cylinder at a tool's corner would take the next face's \
             normal.",
        );
        xml.leaf("flag", &[("multiccd", "disable".into())]);
    }
    xml.close();
    xml.open("default", &[]);
    xml.comment(
        "Only the pairs listed at the end collide; otherwise MuJoCo would use the larger of the \
         two friction values.",
    );
    xml.leaf("geom", &[("contype", "0".into()), ("conaffinity", "0".into())]);
    xml.leaf("pair", &CONTACT.map(|(key, value)| (key, value.to_owned())));
    xml.leaf("joint", &[("solreflimit", "0.004 1".into())]);
    xml.open("default", &[("class", "foot".into())]);
    let foot = [("type", "sphere".into()), ("size", numbers(&[FOOT])), ("mass", "0".into())];
    xml.leaf("geom", &foot);
    xml.close();
    xml.close();
}

/// Writes an object and everything attached to it.
fn body(xml: &mut Xml, scene: &Scene, node: &Node<'_>) {
    let object = &scene.objects[node.object];
    let middle = object.middle();
    let (pose, height) = match node.parent {
        None => (object.pose, middle),
        Some((parent, _)) => {
            let parent = &scene.objects[parent];
            (parent.pose.inverse() * object.pose, middle - parent.middle())
        }
    };
    let name = object_name(object);
    let mut attributes = vec![("name", name.clone())];
    attributes.extend(placed(&pose, height));
    xml.open("body", &attributes);
    match node.parent {
        None => match scene.mounts.iter().find(|mount| mount.object == node.object) {
            Some(mount) => hinges::mount(xml, scene, mount),
            None => xml.leaf("freejoint", &[]),
        },
        Some((_, link)) => hinges::joint(xml, scene, node.object, link),
    }
    let (shape, rise) = clear(scene, object);
    if let Shape::Prism { base, height } = &shape {
        mesh::inertial(xml, base, *height, rise, object.mass);
    }
    let material = (object.mass, object.friction);
    let mut geom = solid_keys(name, &shape, &Pose::default(), rise, material);
    if let Some([red, green, blue]) = scene.objects[scene.thing(node.object)].color {
        geom.push(("rgba", numbers(&[red, green, blue, 1.0])));
    }
    xml.leaf("geom", &geom);
    let feet = feet(scene, node.object);
    let stands = scene.mount(node.object).is_none();
    for (index, (at, _)) in feet.each().enumerate().filter(|_| stands) {
        let at = numbers(&[at.x, at.y, FOOT - middle]);
        let name = foot_name(object, index);
        xml.leaf("geom", &[("class", "foot".into()), ("name", name), ("pos", at)]);
    }
    for child in &node.children {
        body(xml, scene, child);
    }
    xml.close();
}

/// Returns the support points of an object. MuJoCo loads all contacts of a body alike, so each
/// solid of a compound object gets a suitable number of points.
pub(super) fn feet(scene: &Scene, index: usize) -> Feet {
    let feet = scene.feet(index, &scene.objects[index].support);
    if !scene.is_compound(index) {
        return feet;
    }
    let masses: Vec<f64> = scene.objects.iter().map(|object| object.mass).collect();
    scene.contacts(index, &feet, &masses)
}

/// Returns the part of an object that is clear of the table, and the upward shift of its middle,
/// metres.
fn clear(scene: &Scene, object: &Object) -> (Shape, f64) {
    match object.shape {
        above if object.is_raised() => (above, 0.0),
        Shape::Cuboid { size: [x, y, z] } => {
            (Shape::Cuboid { size: [x, y, z - CLEAR] }, CLEAR / 2.0)
        }
        Shape::Prism { base, height } => {
            (Shape::Prism { base, height: height - CLEAR }, CLEAR / 2.0)
        }
        Shape::Cylinder { radius, height } if scene.table_top.is_some() => {
            (Shape::Cylinder { radius, height: height - CLEAR }, CLEAR / 2.0)
        }
        round => (round, 0.0),
    }
}

/// Returns the solids of objects and tools with their names.
fn solids(scene: &Scene, tools: &[Taken]) -> Vec<(String, Shape)> {
    let objects = scene.objects.iter();
    let objects = objects.map(|object| (object_name(object), clear(scene, object).0));
    let tools = tools.iter().flat_map(|Taken { motion, prefix, .. }| {
        let tool = seamless(motion.tool.outline()).into_iter();
        tool.map(move |(name, shape, _)| (format!("{prefix}{name}"), shape))
    });
    objects.chain(tools).chain(regions::solids(scene)).collect()
}

/// Writes a solid with a mass and a friction value. The value is informative, because friction is
/// defined by pairs.
pub(super) fn solid(
    xml: &mut Xml,
    name: String,
    shape: &Shape,
    pose: &Pose,
    height: f64,
    material: (f64, f64),
) {
    xml.leaf("geom", &solid_keys(name, shape, pose, height, material));
}

/// Returns the attributes of a solid's geom.
fn solid_keys(
    name: String,
    shape: &Shape,
    pose: &Pose,
    height: f64,
    (mass, friction): (f64, f64),
) -> Vec<(&'static str, String)> {
    let (kind, (key, value)) = match *shape {
        Shape::Cylinder { radius, height } => {
            ("cylinder", ("size", numbers(&[radius, height / 2.0])))
        }
        Shape::Cuboid { size } => ("box", ("size", numbers(&size.map(|extent| extent / 2.0)))),
        Shape::Prism { .. } => ("mesh", ("mesh", name.clone())),
    };
    let mut attributes = vec![("name", name), ("type", kind.into()), (key, value)];
    attributes.extend(placed(pose, height));
    attributes.push(("mass", numbers(&[mass])));
    attributes.push(("friction", numbers(&[friction])));
    attributes
}

fn placed(pose: &Pose, height: f64) -> [(&'static str, String); 2] {
    let position = numbers(&[pose.position.x, pose.position.y, height]);
    [("pos", position), ("euler", numbers(&[0.0, 0.0, pose.heading]))]
}
