//! URDF, the robot description format of ROS.
//!
//! Collision shapes are read, visual shapes are not. Links below `world`, and links without a
//! parent, stand in the world with all joints at zero. URDF itself has no friction. It is read from
//! the extensions of simulators: `<contact><lateral_friction>` of a link (Bullet), `<gazebo
//! reference="...">`, and Drake's properties of a collision.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use nalgebra::{Isometry3, Matrix3, Point3, Translation3, Vector3};
use roxmltree::Node;

use super::attributes;
use super::diagnostic::Effect;
use super::mesh::{Counted, Mesh, load};
use super::model::{Body, Material, Model, Motion, Outline, Solid};
use super::rubbing::{Gazebo, drake, friction, gazebo};
use super::turns;
use super::xml::{Source, element, elements};
use crate::Language;
use crate::foreign::urdf::{self as foreign, Geometry, Origin, end, limit};
use crate::foreign::{Files, Refused};

/// Name of the link that represents the world.
const WORLD: &str = Body::WORLD;

/// Elements that do not affect the result of pushes, such as the drives of joints.
const HARMLESS: [&str; 3] = ["material", "transmission", "ros2_control"];

/// Link, with the joint that attaches it.
struct Link<'a> {
    node: Node<'a, 'a>,
    joint: Option<Node<'a, 'a>>,
}

/// Reads a `robot` element; returns `None` with faults if it cannot be read.
pub(super) fn model<'a>(
    source: &mut Source<'a>,
    root: Node<'a, 'a>,
    files: &Files,
) -> Option<Model> {
    source.judge(Language::Urdf, "robot", root, |name| root.attribute_node(name));
    let name = root.attribute("name").unwrap_or_default().to_owned();
    let mut model = Model { name, bodies: vec![Body::world()], ..Model::default() };
    let mut links: Vec<(&str, Link<'a>)> = Vec::new();
    for node in elements(root).filter(|node| node.has_tag_name("link")) {
        let name = node.attribute("name").unwrap_or_default();
        if name.is_empty() || links.iter().any(|(other, _)| *other == name) {
            let message = format!("two links are called `{name}`, or one has no name");
            source.fault(node, message, "give each link a unique name");
            return None;
        }
        links.push((name, Link { node, joint: None }));
    }
    for node in elements(root) {
        let own = node.tag_name().namespace().is_none();
        match node.tag_name().name() {
            "link" if own => {}
            "joint" if own => hang(source, node, &mut links)?,
            // Properties of links in simulators are read with the links.
            "gazebo" => {}
            tag if HARMLESS.contains(&tag) => {
                source.judge(Language::Urdf, tag, node, |name| node.attribute_node(name))
            }
            _ if node.tag_name().namespace().is_some_and(|space| space.contains("xacro")) => {
                source.fault(node, "this is a xacro macro", "expand it: `xacro FILE > robot.urdf`");
            }
            tag if node.tag_name().namespace().is_some() => {
                let place = source.place(node);
                source.ledger.note(
                    place,
                    format!("<{tag}> is an extension of another program and is ignored"),
                );
            }
            tag => source.fault(node, format!("<{tag}> is not supported"), "remove it"),
        }
    }
    let gazebo = gazebo(source, root);
    // A file without any collision is drawn only; its visual shapes stand for them.
    let solid = root.descendants().any(|node| node.has_tag_name("collision"));
    let shape = if solid { "collision" } else { "visual" };
    // Parents precede their children; links that remain when nothing more can be attached form a
    // circle.
    let mut indices: HashMap<&str, usize> = HashMap::from([(WORLD, 0)]);
    let mut waiting: Vec<usize> = (0..links.len()).collect();
    loop {
        let before = waiting.len();
        waiting.retain(|index| {
            let (name, link) = &links[*index];
            let parent = match link.joint {
                Some(joint) => match indices.get(end(joint, "parent")) {
                    Some(parent) => *parent,
                    None => return true,
                },
                None => 0,
            };
            let body = take(source, &mut model, (name, link), parent, (&gazebo, files, shape));
            if let Some(body) = body {
                indices.insert(name, model.bodies.len());
                model.bodies.push(body);
            }
            false
        });
        if waiting.len() == before {
            break;
        }
    }
    if let Some(index) = waiting.first() {
        source.fault(
            links[*index].1.node,
            "the joints of this link form a loop",
            "remove one of them",
        );
    }
    Some(model)
}

/// Records the joint that attaches a link; returns `None` with a fault if the joint is invalid.
fn hang<'a>(
    source: &mut Source<'a>,
    joint: Node<'a, 'a>,
    links: &mut [(&'a str, Link<'a>)],
) -> Option<()> {
    let (parent, child) = (end(joint, "parent"), end(joint, "child"));
    let known = |name: &str| name == WORLD || links.iter().any(|(known, _)| *known == name);
    for name in [parent, child] {
        if !known(name) {
            let message = format!("there is no link `{name}`");
            source.fault(
                joint,
                message,
                "`<parent link>` and `<child link>` must name links of the file",
            );
            return None;
        }
    }
    let found = links.iter_mut().find(|(name, _)| *name == child);
    match found {
        Some((_, link)) if link.joint.is_none() && child != WORLD => link.joint = Some(joint),
        _ => {
            let message = format!("the link `{child}` is the child of two joints");
            source.fault(joint, message, "a link can have only one parent, and `world` has none");
            return None;
        }
    }
    Some(())
}

/// Converts a link to a body, with its faults; returns `None` for the world.
fn take<'a>(
    source: &mut Source<'a>,
    model: &mut Model,
    (name, link): (&str, &Link<'a>),
    parent: usize,
    (gazebo, files, shape): (&HashMap<String, Gazebo>, &Files, &'static str),
) -> Option<Body> {
    let (before, noted) = (source.ledger.count(), source.ledger.notes());
    judged(source, link.node, shape);
    let above = model.bodies[parent].pose;
    let (pose, motion) = match link.joint {
        Some(node) => {
            let pose = above * origin(source, node).unwrap_or_default();
            let unknown = || Motion::Other("a joint that cannot be imported".to_owned());
            (pose, motion(source, node, pose).unwrap_or_else(unknown))
        }
        // An unattached link is free, as in Bullet and MuJoCo.
        None => (above, Motion::Free),
    };
    let own = gazebo.get(name);
    if let Some(own) = own {
        source.ledger.take(&own.faults);
    }
    let friction = match friction(source, link.node) {
        Some(stated) => stated,
        None => own.and_then(|own| own.friction),
    };
    let solids = solids(source, link.node, &pose, friction, (files, shape));
    if name == WORLD {
        model.bodies[0].solids.extend(solids);
        return None;
    }
    Some(Body {
        name: name.to_owned(),
        place: source.place(link.node),
        parent: Some(parent),
        motion,
        pose,
        solids,
        inertial: inertial(source, link.node, &pose),
        faults: source.ledger.since(before),
        notes: source.ledger.notes_since(noted),
        ..Body::world()
    })
}

/// Checks the attributes of an element and of the elements in it, without shapes that are not read.
fn judged<'a>(source: &mut Source<'a>, node: Node<'a, 'a>, shape: &str) {
    let tag = node.tag_name().name();
    if node.tag_name().namespace().is_some() || tag == "visual" && shape != "visual" {
        return;
    }
    if attributes::rows(Language::Urdf, tag).is_empty() {
        let place = source.place(node);
        source.ledger.note_as(Effect::Slight, place, format!("<{tag}> is unknown and ignored"));
        return;
    }
    source.judge(Language::Urdf, tag, node, |name| node.attribute_node(name));
    for inner in elements(node) {
        judged(source, inner, shape);
    }
}

fn motion<'a>(
    source: &mut Source<'a>,
    joint: Node<'a, 'a>,
    pose: Isometry3<f64>,
) -> Option<Motion> {
    // Fixed and floating joints have neither axis nor limits, even if stated.
    match joint.attribute("type").unwrap_or_default() {
        "fixed" => return Some(Motion::Fixed),
        "floating" => return Some(Motion::Free),
        _ => judged(source, joint, ""),
    }
    let axis = pose * source.sound(foreign::axis(joint))?;
    if let Some(mimic) = element(joint, "mimic") {
        let leader = mimic.attribute("joint").unwrap_or_default();
        let message = format!("this joint follows `{leader}` (<mimic>), which is not supported");
        source.fault(mimic, message, "remove <mimic> if the joint may move by itself");
    }
    let mut limits = || {
        let mut limit =
            |name: &str| source.sound(limit(joint, name)).map(Option::unwrap_or_default);
        Some(Some([limit("lower")?, limit("upper")?]))
    };
    Some(match joint.attribute("type").unwrap_or_default() {
        "revolute" => Motion::Hinge { axis, at: pose.translation.vector.into(), limits: limits()? },
        "continuous" => Motion::Hinge { axis, at: pose.translation.vector.into(), limits: None },
        "prismatic" => Motion::Slide { axis, limits: limits()? },
        // A planar joint moves in the plane normal to its axis.
        "planar" if axis.xy().norm() < 1e-3 => Motion::Free,
        "planar" => Motion::Other("a planar joint that is not level".to_owned()),
        other => {
            let message = format!("`{other}` is not a joint type");
            let advice = "write fixed, floating, revolute, continuous or prismatic";
            source.fault(joint, message, advice);
            return None;
        }
    })
}

/// Returns the pose stated by the `origin` of an element.
fn origin<'a>(source: &mut Source<'a>, node: Node<'a, 'a>) -> Option<Isometry3<f64>> {
    let Origin { xyz, rpy } = source.sound(foreign::origin(node))?;
    let turn = turns::euler(rpy, ['X', 'Y', 'Z']);
    Some(Isometry3::from_parts(Translation3::from(xyz), turn))
}

fn solids<'a>(
    source: &mut Source<'a>,
    link: Node<'a, 'a>,
    pose: &Isometry3<f64>,
    friction: Option<f64>,
    (files, shape): (&Files, &'static str),
) -> Vec<Solid> {
    let mut found = Vec::new();
    let shapes = |kind: &'static str| elements(link).filter(move |node| node.has_tag_name(kind));
    for collision in shapes(shape) {
        let own = origin(source, collision);
        let (Some(own), Some(outline)) = (own, outline(source, collision, files)) else { continue };
        let friction = drake(source, collision).or(friction);
        found.push(Solid {
            name: collision.attribute("name").unwrap_or_default().to_owned(),
            place: source.place(collision),
            outline,
            pose: pose * own,
            material: Material::of_body(friction),
            touches: shape == "collision",
        });
    }
    if found.is_empty()
        && let Some(seen) = shapes("visual").next()
    {
        let place = source.place(seen);
        let note = "this link is only visual: it has <visual> but no <collision>, and is passed";
        source.ledger.note(place, note);
    }
    found
}

fn outline<'a>(source: &mut Source<'a>, collision: Node<'a, 'a>, files: &Files) -> Option<Outline> {
    Some(match source.sound(foreign::geometry(collision))? {
        Geometry::Solid(Outline::Other(tag)) => Outline::Other(format!("a {tag}")),
        Geometry::Solid(outline) => outline,
        Geometry::Mesh { file, scale } => mesh(source.mesh(collision, (files, ""), &file), scale),
    })
}

/// Returns the outline of a mesh file.
fn mesh(file: Result<PathBuf, Refused>, scale: [f64; 3]) -> Outline {
    let (points, mut faces) = match file.and_then(|path| load(&path)) {
        Ok(raw) => raw,
        Err(refused) => {
            let what = format!("{} ({})", refused.message, refused.advice);
            return Outline::Other(format!("a mesh that cannot be read: {what}"));
        }
    };
    // Mirroring turns a mesh inside out.
    if scale.iter().product::<f64>() < 0.0 {
        faces.iter_mut().for_each(|face| face.swap(1, 2));
    }
    let point = |point: &Point3<f64>| Point3::from([0, 1, 2].map(|k| point[k] * scale[k]));
    let points: Vec<Point3<f64>> = points.iter().map(point).collect();
    let enclosed = Mesh::new(points.clone(), faces.clone(), Counted::Enclosed);
    let closed = enclosed.filter(|mesh| mesh.is_closed() && mesh.volume > 0.0);
    match closed.or_else(|| Mesh::new(points, faces, Counted::Hull)) {
        Some(mesh) => Outline::Mesh(Arc::new(mesh)),
        None => Outline::Other("a mesh that is flat or contains invalid numbers".to_owned()),
    }
}

/// Returns mass, centre of mass in the world and moment of inertia about the vertical.
fn inertial<'a>(
    source: &mut Source<'a>,
    link: Node<'a, 'a>,
    pose: &Isometry3<f64>,
) -> Option<(f64, Point3<f64>, Option<f64>)> {
    let node = element(link, "inertial")?;
    let Some(mass) = element(node, "mass").and_then(|mass| mass.attribute_node("value")) else {
        let place = source.place(node);
        source.ledger.note(place, "<inertial> states no mass and is ignored");
        return None;
    };
    let mass = source.number(mass)?;
    let frame = pose * origin(source, node)?;
    let mut moment = |name: &str| {
        let stated = element(node, "inertia").and_then(|inertia| inertia.attribute_node(name));
        stated.map_or(Some(0.0), |stated| source.number(stated))
    };
    let [xx, xy, xz, yy, yz, zz] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"].map(&mut moment);
    let tensor = Matrix3::new(xx?, xy?, xz?, xy?, yy?, yz?, xz?, yz?, zz?);
    let up = frame.rotation.inverse() * Vector3::z();
    let about = Some(up.dot(&(tensor * up))).filter(|moment| *moment > 0.0);
    Some((mass, frame.translation.vector.into(), about))
}
