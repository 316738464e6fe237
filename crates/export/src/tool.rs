//! MJCF of the tools of a scene: bodies with prescribed positions.

use pushplan::geometry::{Footprint, Pose, Shape};
use pushplan::{
    scene::{Carried, SHOWN_HAND, Tool},
    task::ToolMotion,
};

use super::mjcf::solid;
use super::seamless::seamless;
use super::xml::{Xml, numbers};

/// Mass of a tool, kg, large enough that contacts do not move it.
const MASS: f64 = 1e5;

/// A tool with its first motion and its names.
pub(super) struct Taken<'a> {
    pub motion: &'a ToolMotion,
    /// Name of its body.
    body: String,
    /// Prefix of the names of its solids.
    pub prefix: String,
}

/// Returns the tools of the motions, without repetition, in order of use.
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

/// Writes a tool with slide joints, a hinge if any tool rotates (`turns`), and a lift joint if it
/// `rises`. The `hand` is only visual.
pub(super) fn tool(xml: &mut Xml, taken: &Taken, turns: bool, hand: Option<Carried>, rises: bool) {
    let Taken { motion, body, prefix } = taken;
    let start = motion.strokes.first().map(|stroke| stroke.from).unwrap_or_default();
    let at = start.position;
    xml.open("body", &[("name", body.clone()), ("pos", numbers(&[at.x, at.y, 0.0]))]);
    let mass = numbers(&[MASS]);
    let inertia = numbers(&[MASS; 3]);
    xml.leaf("inertial", &[("pos", "0 0 0".into()), ("mass", mass), ("diaginertia", inertia)]);
    let slides = [("x", "slide", "1 0 0", at.x), ("y", "slide", "0 1 0", at.y)];
    let hinge = ("heading", "hinge", "0 0 1", start.heading);
    let lift = ("z", "slide", "0 0 1", 0.0);
    let more = [turns.then_some(hinge), rises.then_some(lift)].into_iter().flatten();
    for (name, kind, axis, here) in slides.into_iter().chain(more) {
        // With `ref`, the joint's position equals the tool's position on the table.
        let attributes = [
            ("name", format!("{body} {name}")),
            ("type", kind.into()),
            ("axis", axis.into()),
            ("ref", numbers(&[here])),
        ];
        xml.leaf("joint", &attributes);
    }
    let turned = Pose { heading: start.heading, ..Pose::default() };
    pieces(xml, (prefix, &motion.tool), &turned, motion.lift, 0.0);
    // The hand collides with nothing, because plans exclude such contacts.
    if let Some(Carried { footprint: Footprint::Disc { radius }, pose, span: [from, _] }) = hand {
        let shape = Shape::Cylinder { radius, height: SHOWN_HAND };
        let middle = from + 0.5 * SHOWN_HAND;
        solid(xml, format!("{prefix}hand"), &shape, &(turned * pose), middle, (0.0, 0.0));
    }
    xml.close();
}

/// Writes the solids of a tool with a name prefix, at a pose in its body, with undersides at a
/// height, metres, and of a density, kg/m^3.
pub(super) fn pieces(
    xml: &mut Xml,
    (prefix, tool): (&str, &Tool),
    at: &Pose,
    underside: f64,
    density: f64,
) {
    for (name, shape, pose) in seamless(tool.outline()) {
        let height = underside + shape.height() / 2.0;
        let material = (density * shape.footprint().area() * shape.height(), tool.friction);
        solid(xml, format!("{prefix}{name}"), &shape, &(*at * pose), height, material);
    }
}
