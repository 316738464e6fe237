//! Tree of bodies.

use nalgebra::{Isometry3, Point3, Vector3};
use roxmltree::Node;

use crate::Language;
use crate::model::{Body, Model, Motion};
use crate::turns;
use crate::xml::{Source, elements};

use super::defaults::Lookup;
use super::geoms::Context;

/// Elements of a body that affect neither contact nor motion.
const UNSEEN: [&str; 3] = ["site", "camera", "light"];

/// Context of an element: parent body, pose and default class.
#[derive(Clone, Copy)]
struct Within<'a> {
    body: usize,
    pose: Isometry3<f64>,
    class: Option<&'a str>,
    /// Number of bodies and frames around it.
    depth: usize,
    /// Number of copies of it.
    copies: usize,
}

/// Maximum number of copies of an element.
const MOST: usize = 5000;

/// Maximum nesting depth of bodies and frames: more than any robot has joints, and safe for the
/// stack.
const DEEPEST: usize = 200;

/// Reads a `worldbody` element.
pub(super) fn world<'a>(
    source: &mut Source<'a>,
    context: &Context<'a>,
    node: Node<'a, 'a>,
    model: &mut Model,
) {
    let class = node.attribute("childclass");
    inside(
        source,
        context,
        node,
        Within { body: 0, pose: Isometry3::identity(), class, depth: 0, copies: 1 },
        model,
    );
}

/// Reads the content of a body or frame.
fn inside<'a>(
    source: &mut Source<'a>,
    context: &Context<'a>,
    node: Node<'a, 'a>,
    within: Within<'a>,
    model: &mut Model,
) {
    if within.depth > DEEPEST {
        let message = format!("more than {DEEPEST} levels of bodies and frames");
        source.fault(node, message, "is this the right file?");
        return;
    }
    for child in elements(node) {
        let (before, noted) = (source.ledger.count(), source.ledger.notes());
        let tag = child.tag_name().name();
        let element = Lookup { node: child, class: within.class };
        match tag {
            "geom" => {
                let solid = context.solid(source, element, &within.pose);
                model.bodies[within.body].solids.extend(solid);
            }
            "body" => body(source, context, child, within, model),
            "frame" => {
                source.judge(Language::Mjcf, tag, child, |name| child.attribute_node(name));
                context.defaults.check(source, child, "childclass");
                let Some(pose) = context.pose(source, element) else { continue };
                model.bodies[within.body].faults.extend(source.ledger.since(before));
                let class = child.attribute("childclass").or(within.class);
                let (pose, depth) = (within.pose * pose, within.depth + 1);
                inside(source, context, child, Within { pose, class, depth, ..within }, model);
            }
            "replicate" => replicate(source, context, child, within, model),
            "inertial" => inertial(source, context, element, within, model),
            "joint" | "freejoint" => {
                let motion = joint(source, context, element, within);
                let named = child.attribute("name").map(str::to_owned);
                model.joints.extend(named.map(|name| (name, within.body)));
                let body = &mut model.bodies[within.body];
                if let (Some(motion), Some(_)) = (motion, body.parent) {
                    body.motion = body.motion.clone().and(motion);
                }
            }
            "attach" => context.models.attach(source, child, (within.body, &within.pose), model),
            tag if UNSEEN.contains(&tag) => {}
            _ => {
                let message = format!("<{tag}> is not supported");
                source.fault(child, message, BODIES);
            }
        }
        // Faults of a body matter only if the body is imported.
        model.bodies[within.body].faults.extend(source.ledger.since(before));
        model.bodies[within.body].notes.extend(source.ledger.notes_since(noted));
    }
}

/// Reads the content of a `replicate` element as often as it states, each time at a further pose
/// and with a number after every name.
fn replicate<'a>(
    source: &mut Source<'a>,
    context: &Context<'a>,
    node: Node<'a, 'a>,
    within: Within<'a>,
    model: &mut Model,
) {
    source.judge(Language::Mjcf, "replicate", node, |name| node.attribute_node(name));
    let list = |source: &mut Source<'a>, name: &str| match node.attribute_node(name) {
        Some(three) => source.numbers::<3>(three),
        None => Some([0.0; 3]),
    };
    let (offset, euler) = (list(source, "offset"), list(source, "euler"));
    let count = node.attribute("count").and_then(|count| count.trim().parse::<usize>().ok());
    let (Some(count), Some(offset), Some(euler)) = (count, offset, euler) else {
        source.fault(node, "this replicate states no whole `count`", "write one, such as `4`");
        return;
    };
    let copies = within.copies.saturating_mul(count.max(1));
    if copies > MOST {
        source.fault(node, format!("this makes more than {MOST} copies"), "use a lower `count`");
        return;
    }
    let turn =
        turns::euler(euler.map(|angle| context.compiler.angle(angle)), context.compiler.letters);
    let step = Isometry3::from_parts(offset.into(), turn);
    let class = node.attribute("childclass").or(within.class);
    let (mut own, depth) = (Isometry3::identity(), within.depth + 1);
    let width = count.saturating_sub(1).to_string().len();
    let separator = node.attribute("sep").unwrap_or_default();
    for number in 0..count {
        let first =
            (model.bodies.len(), model.bodies[within.body].solids.len(), model.joints.len());
        let pose = within.pose * own;
        inside(source, context, node, Within { pose, class, depth, copies, ..within }, model);
        let added = |name: &mut String| {
            if !name.is_empty() {
                *name += &format!("{separator}{number:0width$}");
            }
        };
        model.bodies[within.body].solids[first.1..].iter_mut().for_each(|s| added(&mut s.name));
        model.joints[first.2..].iter_mut().for_each(|(name, _)| added(name));
        for body in &mut model.bodies[first.0..] {
            added(&mut body.name);
            body.solids.iter_mut().for_each(|solid| added(&mut solid.name));
        }
        own *= step;
    }
}

/// Advice for elements that cannot be read.
pub(super) const BODIES: &str = "remove it, or write bodies with geoms instead";

fn body<'a>(
    source: &mut Source<'a>,
    context: &Context<'a>,
    node: Node<'a, 'a>,
    within: Within<'a>,
    model: &mut Model,
) {
    // The arm of an exported plan.
    if model.ours && node.attribute("name").is_some_and(|name| name.starts_with("arm/")) {
        source.ledger.note(source.place(node), "the arm that holds the tool is ignored");
        let is_tool = |node: &Node<'_, '_>| node.attribute("name") == Some(Model::TOOL);
        if let Some(tool) = node.descendants().find(is_tool) {
            held(source, context, tool, within, model);
        }
        return;
    }
    let before = source.ledger.count();
    source.judge(Language::Mjcf, "body", node, |name| node.attribute_node(name));
    context.defaults.check(source, node, "childclass");
    let class = node.attribute("childclass").or(within.class);
    let Some(pose) = context.pose(source, Lookup { node, class }) else {
        model.bodies[within.body].faults.extend(source.ledger.since(before));
        return;
    };
    let index = model.bodies.len();
    let name = node.attribute("name").map_or_else(|| format!("body-{index}"), str::to_owned);
    let mocap = node.attribute("mocap") == Some("true");
    model.bodies.push(Body {
        name,
        place: source.place(node),
        parent: Some(within.body),
        motion: match mocap {
            true => Motion::Other("a program (`mocap`)".to_owned()),
            false => Motion::Fixed,
        },
        pose: within.pose * pose,
        faults: source.ledger.since(before),
        ..Body::world()
    });
    let pose = within.pose * pose;
    let depth = within.depth + 1;
    inside(source, context, node, Within { body: index, pose, class, depth, ..within }, model);
    // Whether a stated inertia is used depends on the compiler's settings.
    match (context.compiler.from_geoms, &model.bodies[index].inertial) {
        (Some(true), _) => model.bodies[index].inertial = None,
        (Some(false), None) => {
            source.fault(node, "this body states no mass", "add <inertial>");
            model.bodies[index].faults.extend(source.ledger.since(before));
        }
        _ => {}
    }
}

/// Reads the tool that the arm of an exported plan holds; it is upright in its own frame at any
/// pose.
fn held<'a>(
    source: &mut Source<'a>,
    context: &Context<'a>,
    node: Node<'a, 'a>,
    within: Within<'a>,
    model: &mut Model,
) {
    let index = model.bodies.len();
    model.bodies.push(Body {
        name: Model::TOOL.to_owned(),
        place: source.place(node),
        parent: Some(0),
        motion: Motion::Other("an arm".to_owned()),
        ..Body::world()
    });
    let within = Within { body: index, pose: Isometry3::identity(), ..within };
    inside(source, context, node, within, model);
}

fn inertial<'a>(
    source: &mut Source<'a>,
    context: &Context<'a>,
    element: Lookup<'a, '_>,
    within: Within<'a>,
    model: &mut Model,
) {
    let node = element.node;
    source.judge(Language::Mjcf, "inertial", node, |name| node.attribute_node(name));
    let Some(mass) = source.attribute(node, "mass") else {
        source.fault(node, "<inertial> states no mass", "add `mass`");
        return;
    };
    let moments = match ["diaginertia", "fullinertia"].map(|name| node.attribute_node(name)) {
        [Some(three), _] => source.numbers(three).map(|[x, y, z]| [x, y, z, 0.0, 0.0, 0.0]),
        [None, Some(six)] => source.numbers(six),
        [None, None] => Some([0.0; 6]),
    };
    let pose = context.pose(source, element);
    if let (Some(mass), Some(moments), Some(pose)) = (source.number(mass), moments, pose) {
        let pose = within.pose * pose;
        let [xx, yy, zz, xy, xz, yz] = moments;
        let up = pose.rotation.inverse() * Vector3::z();
        let tensor = nalgebra::Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let about = Some(up.dot(&(tensor * up))).filter(|moment| *moment > 0.0);
        let middle = Point3::from(pose.translation.vector);
        model.bodies[within.body].inertial = Some((mass, middle, about));
    }
}

/// Returns the motion that a joint allows.
fn joint<'a>(
    source: &mut Source<'a>,
    context: &Context<'a>,
    element: Lookup<'a, '_>,
    within: Within<'a>,
) -> Option<Motion> {
    let node = element.node;
    let find = |name: &str| context.defaults.find(element, name);
    if node.tag_name().name() == "freejoint" {
        source.judge(Language::Mjcf, "freejoint", node, |name| node.attribute_node(name));
        return Some(Motion::Free);
    }
    context.defaults.check(source, node, "class");
    let number = |source: &mut Source<'a>, name: &str| match find(name) {
        Some(value) => source.list(value).map(|list| list.first().copied().unwrap_or_default()),
        None => Some(0.0),
    };
    let kind = find("type").map_or("hinge", |kind| kind.value());
    source.judge(Language::Mjcf, "joint", node, find);
    if kind == "free" {
        return Some(Motion::Free);
    }
    let (start, at) = (number(source, "ref")?, find("pos"));
    let axis = match find("axis") {
        Some(axis) => source.numbers::<3>(axis)?,
        None => [0.0, 0.0, 1.0],
    };
    let Some(axis) = Vector3::from(axis).try_normalize(1e-12) else {
        source.fault(
            node,
            "the axis of this joint has length zero",
            "write an axis such as `0 0 1`",
        );
        return None;
    };
    let axis = within.pose * axis;
    let limited = match find("limited").map_or("auto", |limited| limited.value()) {
        "auto" => context.compiler.limited && find("range").is_some(),
        limited => limited == "true",
    };
    let range = match find("range").filter(|_| limited) {
        Some(range) => Some(source.limits(range)?),
        None => None,
    };
    match kind {
        "hinge" => {
            let at = match at {
                Some(at) => source.numbers::<3>(at)?,
                None => [0.0; 3],
            };
            let limits = range.map(|range| range.map(|end| context.compiler.angle(end - start)));
            let at = within.pose * Point3::from(at);
            Some(Motion::Hinge { axis, at, limits })
        }
        "slide" => {
            Some(Motion::Slide { axis, limits: range.map(|ends| ends.map(|end| end - start)) })
        }
        _ => Some(Motion::Other(format!("a {kind} joint"))),
    }
}
