//! The tools of a scene, and the hand that holds them.

use crate::geometry::{Footprint, Pose, Shape};
use crate::scene::{Carried, Robot, SHOWN_HAND, ToolMotion};

use super::mjcf::solid;
use super::seamless::seamless;
use super::xml::{Xml, numbers};

/// So heavy that nothing moves it, kg.
const TOOL_MASS: f64 = 1e5;

/// What a tool is held by, and whether it is lifted off as it would be.
#[derive(Clone, Copy)]
pub(super) struct Lifts<'a> {
    pub robot: Option<&'a Robot>,
    pub retreats: bool,
}

/// A tool, with the first motion that is made with it, and how its solids are called.
pub(super) struct Taken<'a> {
    pub motion: &'a ToolMotion,
    /// Its body's name.
    body: String,
    /// Before the names of its solids.
    pub prefix: String,
}

/// The tools of motions, each once, in the order in which they are taken.
pub(super) fn taken(motions: &[ToolMotion]) -> Vec<Taken<'_>> {
    let mut taken: Vec<Taken> = Vec::new();
    for motion in motions {
        if !taken.iter().any(|known| known.motion.tool.name == motion.tool.name) {
            let (body, prefix) = match taken.len() {
                0 => ("tool".to_owned(), "tool/".to_owned()),
                k => (format!("tool {}", k + 1), format!("tool/{}/", k + 1)),
            };
            taken.push(Taken { motion, body, prefix });
        }
    }
    taken
}

pub(super) fn tool(xml: &mut Xml, taken: &Taken, turns: bool, Lifts { robot, retreats }: Lifts) {
    let Taken { motion, body, prefix } = taken;
    let hand = robot.and_then(|robot| robot.carried(&motion.tool, motion.lift)[0]);
    let start = motion.strokes.first().map(|stroke| stroke.from).unwrap_or_default();
    let at = start.position;
    xml.open("body", &[("name", body.clone()), ("pos", numbers(&[at.x, at.y, 0.0]))]);
    let mass = numbers(&[TOOL_MASS]);
    let inertia = numbers(&[TOOL_MASS; 3]);
    xml.leaf("inertial", &[("pos", "0 0 0".into()), ("mass", mass), ("diaginertia", inertia)]);
    let slides = [("x", "slide", "1 0 0", at.x), ("y", "slide", "0 1 0", at.y)];
    let hinge = ("heading", "hinge", "0 0 1", start.heading);
    let lift = ("z", "slide", "0 0 1", 0.0);
    let more = [turns.then_some(hinge), retreats.then_some(lift)].into_iter().flatten();
    for (name, kind, axis, here) in slides.into_iter().chain(more) {
        // `ref` makes the joint's position the tool's on the table.
        let attributes = [
            ("name", format!("{body} {name}")),
            ("type", kind.into()),
            ("axis", axis.into()),
            ("ref", numbers(&[here])),
        ];
        xml.leaf("joint", &attributes);
    }
    let turned = Pose { heading: start.heading, ..Pose::default() };
    for (name, shape, pose) in seamless(motion.tool.outline()) {
        let height = motion.lift + shape.height() / 2.0;
        let material = (0.0, motion.tool.friction);
        solid(xml, format!("{prefix}{name}"), &shape, &(turned * pose), height, material);
    }
    // It touches nothing: where it would, no plan goes.
    if let Some(Carried { footprint: Footprint::Disc { radius }, pose, span: [from, _] }) = hand {
        let shape = Shape::Cylinder { radius, height: SHOWN_HAND };
        let middle = from + 0.5 * SHOWN_HAND;
        solid(xml, format!("{prefix}hand"), &shape, &(turned * pose), middle, (0.0, 0.0));
    }
    xml.close();
}
