//! Detection of wrong units by sizes and positions that are impossible on a table.

use crate::asset::node::Node;
use crate::asset::strict::Ledger;

/// Maximum plausible width of an object, metres.
const WIDEST: f64 = 1.5;

/// Maximum distance of a body from the origin, metres; the range of coordinates.
const FARTHEST: f64 = 10.0;

/// Largest number that is taken for a width in centimetres; larger numbers are taken for
/// millimetres. Objects are 5 to 40 cm wide. The limit for positions below follows from distances
/// of 0.2 to 2 m. Both must be below their limit, because small objects are 20 to 40 mm wide.
const WIDTH_IN_CENTIMETRES: f64 = 40.0;
const REACH_IN_CENTIMETRES: f64 = 200.0;

/// Reports lengths that look like centimetres or millimetres. Returns `true` if it found such
/// lengths, because every other rule about lengths would only repeat the fault.
pub(super) fn check(root: &Node, ledger: &mut Ledger) -> bool {
    let objects = root.get("scene").and_then(|scene| scene.get("objects"));
    let mut widths: Vec<(f64, &Node)> =
        objects.map(Node::items).unwrap_or_default().iter().filter_map(width).collect();
    widths.sort_by(|a, b| a.0.total_cmp(&b.0));
    // The median is used, so that a single mistake is reported as a size out of range.
    let width = widths.get(widths.len() / 2);
    let frames = root.get("frames").map(Node::items).unwrap_or_default();
    let poses = frames.iter().flat_map(|frame| {
        let objects = frame.get("objects").map(Node::items).unwrap_or_default();
        frame.get("pusher").into_iter().chain(objects)
    });
    let farthest = poses
        .flat_map(|pose| pose.items().iter().take(2))
        .filter_map(|node| Some((node.number()?.abs(), node)))
        .filter(|(reach, _)| reach.is_finite())
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let is_near = farthest.is_none_or(|(reach, _)| reach <= REACH_IN_CENTIMETRES);
    let centimetres = is_near && width.is_none_or(|(width, _)| *width <= WIDTH_IN_CENTIMETRES);
    if let Some((width, node)) = width.filter(|(width, _)| *width > WIDEST) {
        note(node, &format!("an object {width} m wide"), centimetres, ledger);
        return true;
    }
    if let Some((reach, node)) = farthest.filter(|(reach, _)| *reach > FARTHEST) {
        let found = format!("a position {reach} m from the origin");
        note(node, &found, centimetres, ledger);
        return true;
    }
    false
}

/// Returns the horizontal extent of an object, in the unit of the file, and the node that states
/// it.
fn width(object: &Node) -> Option<(f64, &Node)> {
    let shape = object.get("shape")?;
    if let Some(radius) = shape.get("cylinder").and_then(|cylinder| cylinder.get("radius")) {
        return Some((2.0 * radius.number()?, radius)).filter(|(width, _)| width.is_finite());
    }
    if let Some(corners) = shape.get("prism").and_then(|prism| prism.get("corners")) {
        let of = |k: usize| corners.items().iter().filter_map(move |c| c.items().get(k)?.number());
        let width = |k| of(k).fold(0.0, f64::max) - of(k).fold(0.0, f64::min);
        return Some((width(0).max(width(1)), corners)).filter(|(width, _)| width.is_finite());
    }
    let sides = shape.get("cuboid")?.get("size")?.items().iter().take(2);
    sides
        .filter_map(|side| Some((side.number()?, side)))
        .filter(|(side, _)| side.is_finite())
        .max_by(|a, b| a.0.total_cmp(&b.0))
}

fn note(node: &Node, found: &str, centimetres: bool, ledger: &mut Ledger) {
    let (unit, factor) = if centimetres { ("centimetres", 100) } else { ("millimetres", 1000) };
    let advice = format!("lengths are in metres: divide all of them by {factor}");
    ledger.fault(node, format!("{found}: is this in {unit}?"), advice);
}
