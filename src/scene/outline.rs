//! The parts of a tool that can be touched, without the seams between them.

use std::f64::consts::FRAC_PI_2;

use crate::geometry::{Extent, Footprint, Pose, Rim, Shape, Vector, outline};

use super::Part;

/// Largest deviation from a quarter turn of parts whose sides count as parallel, radians; angles
/// written in degrees are rounded.
const SAME_AXES: f64 = 1e-6;

/// Largest height difference of parts that count as equally high, metres.
const SAME_HEIGHT: f64 = 1e-6;

/// A solid of the tool's outline.
///
/// Cuboids of one height with parallel sides are merged into one body. That body is divided into
/// the fewest and largest cuboids that contain each of its faces whole. A row of parts is thus one
/// cuboid, and the end of an L is one face. Any other part is a piece of its own. Engines, analytic
/// model and network represent the tool by its pieces; each is a node of the graph.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Names of the parts that it contains or overlaps.
    pub name: String,
    /// Solid, upright.
    pub shape: Shape,
    /// Pose of the centre in the tool frame.
    pub pose: Pose,
    /// Part of its boundary that bodies can touch; `None` for all of it.
    pub rim: Option<Rim>,
}

impl Piece {
    /// Returns its outline on the table.
    pub fn footprint(&self) -> Footprint {
        self.shape.footprint()
    }

    fn of(part: &Part) -> Self {
        Self { name: part.name.clone(), shape: part.shape, pose: part.pose, rim: None }
    }
}

/// Returns the pieces of a tool with these parts.
pub(super) fn pieces(parts: &[Part]) -> Vec<Piece> {
    let mut pieces = Vec::with_capacity(parts.len());
    let mut done = vec![false; parts.len()];
    for first in 0..parts.len() {
        if done[first] {
            continue;
        }
        let mut alike = Vec::new();
        for (part, done) in parts.iter().zip(&mut done).skip(first) {
            if alike.is_empty() || !*done && are_alike(&parts[first], part) {
                *done = true;
                alike.push(part);
            }
        }
        match alike[..] {
            [only] => pieces.push(Piece::of(only)),
            _ => pieces.extend(merged(&alike)),
        }
    }
    number(&mut pieces);
    pieces
}

/// Appends numbers to equal names of pieces, because engine files identify bodies by name. Equal
/// names occur if one part overlaps several pieces.
fn number(pieces: &mut [Piece]) {
    for k in 1..pieces.len() {
        let (before, own) = pieces.split_at_mut(k);
        let name = own[0].name.clone();
        let own = &mut own[0].name;
        let mut count = 1;
        while before.iter().any(|other| other.name == *own) {
            count += 1;
            *own = format!("{name} ({count})");
        }
    }
}

/// Returns `true` if both are cuboids of one height with parallel sides.
fn are_alike(a: &Part, b: &Part) -> bool {
    let (Shape::Cuboid { size: first }, Shape::Cuboid { size: second }) = (a.shape, b.shape) else {
        return false;
    };
    let turns = (b.pose.heading - a.pose.heading) / FRAC_PI_2;
    (turns - turns.round()).abs() * FRAC_PI_2 <= SAME_AXES
        && (first[2] - second[2]).abs() <= SAME_HEIGHT
}

/// Returns the pieces of cuboids that are alike.
fn merged(parts: &[&Part]) -> Vec<Piece> {
    let axes = Pose { position: Vector::zeros(), heading: parts[0].pose.heading };
    let height = parts[0].shape.height();
    let extents: Vec<Extent> = parts.iter().map(|part| extent(part, &axes)).collect();
    let found = outline(&extents);
    let piece = |extent: Extent, rim: Rim| {
        let [from, to] = extent.map(|[x, y]| Vector::new(x, y));
        let (size, centre) = (to - from, (from + to) / 2.0);
        Piece {
            name: name(parts, &extents, extent),
            shape: Shape::Cuboid { size: [size.x, size.y, height] },
            pose: Pose { position: axes.point(centre), ..axes },
            rim: Some(rim),
        }
    };
    match &found[..] {
        // A single rectangle has no seams.
        [only] => vec![Piece { rim: None, ..piece(only.extent, Rim::default()) }],
        _ => found.into_iter().map(|found| piece(found.extent, found.rim)).collect(),
    }
}

/// Returns the extent of a cuboid part along `axes`.
fn extent(part: &Part, axes: &Pose) -> Extent {
    let centre = axes.local_point(part.pose.position);
    let turned = ((part.pose.heading - axes.heading) / FRAC_PI_2).round().rem_euclid(2.0) == 1.0;
    let half = match part.footprint() {
        Footprint::Rectangle { half } if turned => Vector::new(half.y, half.x),
        Footprint::Rectangle { half } => half,
        other => Vector::repeat(other.bounding_radius()),
    };
    let (low, high) = (centre - half, centre + half);
    [[low.x, low.y], [high.x, high.y]]
}

fn name(parts: &[&Part], extents: &[Extent], piece: Extent) -> String {
    /// Tolerance for rounding and for gaps that count as contact, metres.
    const SLACK: f64 = 2e-4;
    let among = |is_in: &dyn Fn(&Extent, usize) -> bool| -> Vec<&str> {
        let within = |extent: &Extent| (0..2).all(|axis| is_in(extent, axis));
        let named = parts.iter().zip(extents).filter(|(_, extent)| within(extent));
        named.map(|(part, _)| part.name.as_str()).collect()
    };
    let whole = among(&|extent, axis| {
        piece[0][axis] <= extent[0][axis] + SLACK && extent[1][axis] <= piece[1][axis] + SLACK
    });
    if !whole.is_empty() {
        return whole.join("+");
    }
    let shared = among(&|extent, axis| {
        piece[0][axis] + SLACK < extent[1][axis] && extent[0][axis] + SLACK < piece[1][axis]
    });
    shared.join("+")
}

#[cfg(test)]
mod tests;
