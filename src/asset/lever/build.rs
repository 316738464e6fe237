//! From a checked tree to a [`Task`] of levering.

use std::collections::BTreeMap;
use std::path::Path;

use crate::asset::node::Node;
use crate::asset::take::{angle, name_of, number_or, pose, triple, vector};
use crate::asset::task::{
    height_of as height, named_tools, obstacle_of, pushes_of, reach_of, unknown_of,
};
use crate::asset::text::apart_by_name;
use crate::geometry::{Pose, Vector, centroid, cross};
use crate::{
    scene::{Object, Obstacle, Plate, Robot, Scene, Slab},
    task::{Goal, LeverRules, Pivot, PushRules, Task},
};

/// A centre of mass that is nearer to the origin of its frame is there, metres: sums of corners
/// that were written about it do not come to zero exactly.
const CENTRED: f64 = 1e-9;

/// The task, or `None` if anything needed is missing or was faulty.
pub(super) fn lever_task(root: &Node, file: &str) -> Option<Task> {
    let stem = || Path::new(file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let scene = root.get("scene")?;
    let items = |key| scene.get(key).map(Node::items).unwrap_or_default().iter();
    let object = |node| plate(node)?.object();
    let objects: Vec<Object> = items("objects").map(object).collect::<Option<_>>()?;
    let obstacles: Vec<Obstacle> = items("obstacles").map(obstacle_of).collect::<Option<_>>()?;
    let friction = match scene.get("table") {
        Some(table) => number_or(table, "friction", Scene::FRICTION)?,
        None => Scene::FRICTION,
    };
    let scene = Scene { obstacles, ..Scene::new(objects).on_table(friction) };
    Some(Task {
        name: name_of(root).map_or_else(|| apart_by_name(&stem()), str::to_owned),
        description: root.get("description").and_then(Node::text).unwrap_or_default().into(),
        goals: vec![goal(root.get("goal")?, &scene)?],
        scene,
        unknown: unknown_of(root)?,
        robot: Robot { base: 0.0, ..reach_of(root.get("robot")?)? },
        arm: None,
        tools: named_tools(root.get("tools")?),
        tool_costs: BTreeMap::new(),
        levers: Some(match root.get("levers") {
            Some(node) => levers(node)?,
            None => LeverRules::default(),
        }),
        pushes: match root.get("pushes") {
            Some(node) => pushes_of(node)?,
            None => PushRules::none(),
        },
        robustness: number_or(root, "robustness", Task::ROBUSTNESS)?,
    })
}

/// A plate with its frame below its centre of mass.
pub(super) fn plate(node: &Node) -> Option<Plate> {
    let (base, origin) = solid(node.get("shape")?)?;
    let top = base.height;
    let mut slabs = vec![base];
    for part in node.get("parts").map(Node::items).unwrap_or_default() {
        let (mut slab, own) = solid(part.get("shape")?)?;
        let turn = Pose { position: Vector::zeros(), heading: angle(part, "yaw_deg", 0.0)? };
        let place = part.get("position")?;
        let shift = vector(place)? - origin;
        slab.bottom = height(place, top)?;
        for corner in &mut slab.corners {
            *corner = turn.vector(*corner - own) + shift;
        }
        slabs.push(slab);
    }
    slabs[0].corners.iter_mut().for_each(|corner| *corner -= origin);
    let stated = |key| node.get(key).map(Node::number);
    let (clearance, z) = match (stated("clearance"), stated("z")) {
        (Some(clearance), Some(z)) => (clearance?, z?),
        (Some(both), None) | (None, Some(both)) => (both?, both?),
        (None, None) => return None,
    };
    let plate = Plate {
        name: name_of(node)?.into(),
        slabs,
        mass: node.get("mass")?.number()?,
        friction: node.get("friction")?.number()?,
        clearance,
        pose: pose(node)?,
        z,
    };
    let off = plate.weight().centre.xy().norm();
    Some(if off > CENTRED { plate.balanced() } else { plate })
}

/// A solid in the frame that its corners are written in, and the point of it that a position
/// speaks of.
fn solid(shape: &Node) -> Option<(Slab, Vector)> {
    if let Some(prism) = shape.get("prism") {
        let corners = prism.get("corners")?.items().iter().map(vector);
        let mut corners: Vec<Vector> = corners.collect::<Option<_>>()?;
        if corners.len() < 3 {
            return None;
        }
        let area: f64 =
            (0..corners.len()).map(|k| cross(corners[k], corners[(k + 1) % corners.len()])).sum();
        // Counter-clockwise, the first corner staying the first.
        if area < 0.0 {
            corners[1..].reverse();
        }
        let origin = match prism.get("origin") {
            Some(origin) => vector(origin)?,
            None => centroid(&corners),
        };
        let height = prism.get("height")?.number()?;
        return Some((Slab { corners, bottom: 0.0, height }, origin));
    }
    let [x, y, height] = triple(shape.get("cuboid")?, "size")?;
    let (x, y) = (0.5 * x, 0.5 * y);
    let corners = [[-x, -y], [x, -y], [x, y], [-x, y]].map(|[x, y]| Vector::new(x, y));
    Some((Slab { corners: corners.to_vec(), bottom: 0.0, height }, Vector::zeros()))
}

fn levers(node: &Node) -> Option<LeverRules> {
    let usual = LeverRules::default();
    let pair = |key: &str| match node.get(key).map(Node::items) {
        Some([low, high]) => Some(Some([low.number()?, high.number()?])),
        Some(_) => None,
        None => Some(None),
    };
    Some(LeverRules {
        depth: pair("depth")?.unwrap_or(usual.depth),
        angle: pair("angle_deg")?.map_or(usual.angle, |pair| pair.map(f64::to_radians)),
        pivots: match node.get("pivot") {
            None => usual.pivots,
            Some(list) if !list.items().is_empty() => {
                list.items().iter().map(pivot).collect::<Option<_>>()?
            }
            Some(one) => vec![pivot(one)?],
        },
        speed: number_or(node, "speed", usual.speed)?,
        hold: number_or(node, "hold", usual.hold)?,
        retreat: number_or(node, "retreat", usual.retreat)?,
    })
}

fn pivot(node: &Node) -> Option<Pivot> {
    match node.text() {
        Some(_) => Some(Pivot::Auto),
        None => node.number().map(Pivot::At),
    }
}

fn goal(node: &Node, scene: &Scene) -> Option<Goal> {
    let object = scene.object(node.get("object")?.text()?)?;
    let outside = match node.get("outside") {
        Some(name) => {
            let name = name.text()?;
            Some(scene.obstacles.iter().position(|obstacle| obstacle.name == name)?)
        }
        None => None,
    };
    let place = match (node.get("position"), node.get("tolerance")) {
        (Some(at), Some(tolerance)) => Goal::new(object, vector(at)?.into(), tolerance.number()?),
        (None, None) => Goal::of(object),
        _ => return None,
    };
    Some(Goal {
        outside,
        raised: match node.get("raised") {
            Some(height) => Some(height.number()?),
            None => None,
        },
        flipped: match node.get("flipped") {
            Some(flipped) => Some(flipped.switch()?),
            None => None,
        },
        ..place
    })
}
