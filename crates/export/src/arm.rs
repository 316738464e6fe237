//! MJCF of the arm of a scene: bodies on servo-driven joints, with the tool in its hand.
//!
//! A plan file contains link poses and collision solids, but no masses and no motor strength.
//! Solids have the density [`DENSITY`], and gravity is compensated as by arm controllers. Every
//! joint has a position servo and a velocity servo, which follow the planned references. The
//! tracking error therefore results from external forces.

use pushplan::geometry::{Pose, Pose3, Vector3};
use pushplan::scene::{JointTrajectory, Scene, Tool};
use pushplan_arm::{Arm, ArmBody, Hull, above};

use super::pairs::Pair;
use super::space::placed;
use super::strokes::numeric;
use super::tool::pieces;
use super::xml::{Xml, numbers};

/// Density of links, kg/m^3: the 18 litres within a Panda's hulls weigh 18 kg.
const DENSITY: f64 = 1000.0;

/// Density of tools, kg/m^3, as of wood: the stick weighs a kilogram.
const TOOL_DENSITY: f64 = 500.0;

/// Radius of the visible rod between flange and tool, metres.
const MOUNT: f64 = 0.012;

/// Mass of a link without solids, kg.
const BARE: f64 = 0.1;

/// Armature of joints, kg m^2 or kg: the inertia of rotors behind their gears.
const ROTOR: f64 = 0.1;

/// Stiffness and damping of revolute joints, Nm/rad and Nm s/rad. A load of 20 N at 60 cm bends a
/// joint by 0.07 degrees, and the damping is two thirds of critical for a stretched Panda.
const TURNING: [f64; 2] = [1e4, 300.0];

/// Stiffness and damping of prismatic joints, N/m and N s/m.
const SLIDING: [f64; 2] = [1e5, 3e3];

/// Friction value of links, which files do not contain: the default of obstacles.
const FRICTION: f64 = 0.5;

/// Thickness below which a hull has no volume in MuJoCo, metres.
const FLAT: f64 = 1e-3;

/// Writes the joint trajectory: a row for each point.
pub(super) fn way(xml: &mut Xml, path: &JointTrajectory) {
    xml.comment("Joint trajectory: for each point the time, positions, velocities, accelerations.");
    for (k, point) in path.points.iter().enumerate() {
        let mut row = vec![point.time];
        row.extend(point.positions.iter().chain(&point.velocities).chain(&point.accelerations));
        numeric(xml, &format!("joints {}", k + 1), &row);
    }
    xml.comment("Points at which pushes begin and end, counted from 1.");
    let ends = path.pushes.iter().flatten().map(|point| *point as f64 + 1.0);
    numeric(xml, "pushes of joints", &ends.collect::<Vec<_>>());
}

/// Writes the meshes of links.
pub(super) fn meshes(xml: &mut Xml, arm: &Arm) {
    xml.open("asset", &[]);
    for body in arm.links() {
        for (name, hull) in solids(body) {
            if let Solid::Mesh { points, .. } = solid(hull) {
                let points: Vec<f64> =
                    points.iter().flat_map(|point| [point.x, point.y, point.z]).collect();
                xml.leaf("mesh", &[("name", name), ("vertex", numbers(&points))]);
            }
        }
    }
    xml.close();
}

/// Writes the arm at zero joint positions, and the tool.
pub(super) fn bodies(xml: &mut Xml, arm: &Arm, tool: &Tool) {
    for (k, body) in arm.bodies.iter().enumerate() {
        let joint = k.checked_sub(1).map(|k| &arm.joints[k]);
        open(xml, format!("arm/{}", body.name), joint.map_or(&arm.base, |joint| &joint.origin));
        if let Some(joint) = joint {
            let mut attributes = vec![
                ("name", format!("arm/{}", joint.name)),
                ("type", if joint.slides { "slide" } else { "hinge" }.to_owned()),
                ("axis", numbers(joint.axis.as_slice())),
                ("armature", numbers(&[ROTOR])),
            ];
            attributes.extend(joint.limits.map(|limits| ("range", numbers(&limits))));
            xml.leaf("joint", &attributes);
        }
        if body.solids.is_empty() {
            let inertia = numbers(&[ROTOR * BARE; 3]);
            let inertial =
                [("pos", "0 0 0".into()), ("mass", numbers(&[BARE])), ("diaginertia", inertia)];
            xml.leaf("inertial", &inertial);
        }
        // Links beside the arm are fixed to its base.
        let beside = arm.beside.iter().filter(|_| k == 0);
        for (name, hull) in [body].into_iter().chain(beside).flat_map(solids) {
            geom(xml, name, hull);
        }
    }
    let seen = arm.flange * arm.flange_of_tool().inverse();
    open(xml, "tool".into(), &(seen * Pose3::upright(tool.grip.inverse(), 0.0)));
    pieces(xml, ("tool/", tool), &Pose::default(), 0.0, TOOL_DENSITY);
    if arm.mount.length > FLAT {
        // The rod is only visual.
        let Pose { position: at, .. } = tool.grip;
        let ends = [at.x, at.y, 0.0, at.x, at.y, arm.mount.length];
        let rod = [
            ("name", "tool/mount".into()),
            ("type", "capsule".into()),
            ("fromto", numbers(&ends)),
            ("size", numbers(&[MOUNT])),
            ("mass", "0".into()),
        ];
        xml.leaf("geom", &rod);
    }
    for _ in 0..arm.bodies.len() + 1 {
        xml.close();
    }
}

/// Returns the contact pairs of the arm and its tool, except the pairs of tool and objects.
pub(super) fn pairs(arm: &Arm, scene: &Scene, tool: &Tool) -> Vec<Pair> {
    let mut pairs = Vec::new();
    let mut add = |(a, one): (String, f64), (b, other): (String, f64), margin: f64| {
        pairs.push(Pair { geoms: [a, b], friction: 0.5 * (one + other), margin });
    };
    let links: Vec<_> = arm.links().map(|body| solids(body).collect::<Vec<_>>()).collect();
    for [a, b] in &arm.pairs {
        for (one, first) in &links[*a] {
            for (other, second) in &links[*b] {
                let margin = margin(first) + margin(second);
                add((one.clone(), FRICTION), (other.clone(), FRICTION), margin);
            }
        }
    }
    let table = ("table".to_owned(), scene.table_friction);
    let objects = scene.objects.iter().map(|one| (format!("object/{}", one.name), one.friction));
    let obstacles = scene.obstacles.iter().filter(|one| !one.is_robot());
    let obstacles: Vec<_> =
        obstacles.map(|one| (format!("obstacle/{}", one.name), one.friction)).collect();
    let objects: Vec<_> = objects.collect();
    let above = above(arm);
    for (k, (name, hull)) in
        links.iter().enumerate().flat_map(|(k, link)| link.iter().map(move |solid| (k, solid)))
    {
        let moves = (1..arm.bodies.len()).contains(&k);
        let table = (moves && k >= above).then_some(&table);
        let fixed = obstacles.iter().filter(|_| moves).chain(table);
        for other in fixed.chain(&objects) {
            add((name.clone(), FRICTION), other.clone(), margin(hull));
        }
    }
    for piece in tool.outline() {
        for other in obstacles.iter().chain([&table]) {
            add((format!("tool/{}", piece.name), tool.friction), other.clone(), 0.0);
        }
    }
    pairs
}

/// Writes two servos for each joint: the first follows the position, the second the velocity.
pub(super) fn servos(xml: &mut Xml, arm: &Arm) {
    xml.comment("One position servo and one velocity servo per joint.");
    xml.open("actuator", &[]);
    for joint in &arm.joints {
        let [stiffness, damping] = if joint.slides { SLIDING } else { TURNING };
        let name = format!("arm/{}", joint.name);
        let servo = |of: &str| [("name", format!("{name}/{of}")), ("joint", name.clone())];
        let [a, b] = servo("position");
        xml.leaf("position", &[a, b, ("kp", numbers(&[stiffness]))]);
        let [a, b] = servo("speed");
        xml.leaf("velocity", &[a, b, ("kv", numbers(&[damping]))]);
    }
    xml.close();
}

fn open(xml: &mut Xml, name: String, pose: &Pose3) {
    let mut attributes = vec![("name", name), ("gravcomp", "1".into())];
    attributes.extend(placed(pose));
    xml.open("body", &attributes);
}

/// Returns the solids of a link with their names.
fn solids(body: &ArmBody) -> impl Iterator<Item = (String, &Hull)> {
    body.solids.iter().enumerate().map(|(k, hull)| (format!("arm/{}/{}", body.name, k + 1), hull))
}

/// MuJoCo primitive for a hull.
enum Solid {
    Sphere(Vector3, f64),
    Capsule([Vector3; 2], f64),
    /// Corners, and a margin around their hull.
    Mesh {
        points: Vec<Vector3>,
        margin: f64,
    },
}

fn solid(hull: &Hull) -> Solid {
    let radius = hull.radius;
    match hull.points[..] {
        [middle] if radius > 0.0 => Solid::Sphere(middle, radius),
        [from, to] if radius > 0.0 => Solid::Capsule([from, to], radius),
        _ if hull.thickness() >= FLAT => {
            Solid::Mesh { points: hull.points.clone(), margin: radius }
        }
        _ => {
            let around = |point: &Vector3| {
                let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
                let point = *point;
                axes.into_iter().flat_map(move |axis| {
                    [-1.0, 1.0].map(|side| point + axis * side * radius.max(FLAT))
                })
            };
            Solid::Mesh { points: hull.points.iter().flat_map(around).collect(), margin: 0.0 }
        }
    }
}

fn margin(hull: &Hull) -> f64 {
    match solid(hull) {
        Solid::Mesh { margin, .. } => margin,
        _ => 0.0,
    }
}

fn geom(xml: &mut Xml, name: String, hull: &Hull) {
    let mut attributes = vec![("name", name.clone()), ("density", numbers(&[DENSITY]))];
    attributes.extend(match solid(hull) {
        Solid::Sphere(middle, radius) => vec![
            ("type", "sphere".into()),
            ("pos", numbers(middle.as_slice())),
            ("size", numbers(&[radius])),
        ],
        Solid::Capsule([from, to], radius) => vec![
            ("type", "capsule".into()),
            ("fromto", numbers(&[from.x, from.y, from.z, to.x, to.y, to.z])),
            ("size", numbers(&[radius])),
        ],
        Solid::Mesh { .. } => vec![("type", "mesh".into()), ("mesh", name)],
    });
    xml.leaf("geom", &attributes);
}
