//! Random tools of cuboids glued face to face.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use pushplan::internals::geometry::{Footprint, Pose, Shape, Vector, clearance};
use pushplan::internals::scene::{Part, Ranges, Tool};
use rand::Rng;
use rand_pcg::Pcg64;

use super::distributions::{log_uniform, sign, uniform, weighted};
use super::tabletop::random_friction;

/// Probabilities of one to five parts.
const PART_COUNTS: [f64; 5] = [0.20, 0.25, 0.20, 0.20, 0.15];

/// Share of parts with the size of their parent part, as in long handles.
const SAME_SIZE: f64 = 0.35;

/// Share of parts rotated by 45 degrees relative to their parent part.
const DIAGONAL: f64 = 0.2;

/// Minimum contact width of two glued faces relative to the narrower face.
const LEAST_OVERLAP: f64 = 0.4;

/// Vertical extent of the parts, metres.
const THICKNESS: (f64, f64) = (0.01, 0.06);

/// Maximum number of attempts to add a part.
const TRIES: usize = 20;

/// Draws a tool of one to five cuboids, each glued flush to a face of an earlier one.
///
/// Parts rotated by 45 degrees are sunk into their parent by a corner. The grip is the origin of
/// the tool frame.
pub fn random_tool(rng: &mut Pcg64, ranges: &Ranges) -> Tool {
    let count = 1 + weighted(rng, &PART_COUNTS);
    let thickness = uniform(rng, THICKNESS.0, THICKNESS.1);
    let size = random_size(rng, ranges, thickness);
    let mut parts =
        vec![Part::cuboid("part-1", size, Pose::new(uniform(rng, -0.05, 0.20), 0.0, 0.0))];
    let mut joints = Vec::new();
    for _ in 1..count {
        if let Some((parent, size, pose)) =
            (0..TRIES).find_map(|_| glue(rng, ranges, thickness, &parts))
        {
            joints.push([parent, parts.len()]);
            parts.push(Part::cuboid(format!("part-{}", parts.len() + 1), size, pose));
        }
    }
    let friction = random_friction(rng, ranges);
    Tool::assembled("assembly", parts, joints)
        .described("Random cuboids glued face to face.")
        .friction(friction)
}

fn random_size(rng: &mut Pcg64, ranges: &Ranges, thickness: f64) -> [f64; 3] {
    let length = log_uniform(rng, ranges.part_length);
    let width = log_uniform(rng, ranges.part_width).min(length);
    if rng.random::<bool>() { [length, width, thickness] } else { [width, length, thickness] }
}

/// Draws a further part: its parent, size and pose; `None` if it would overlap another part.
fn glue(
    rng: &mut Pcg64,
    ranges: &Ranges,
    thickness: f64,
    parts: &[Part],
) -> Option<(usize, [f64; 3], Pose)> {
    let newest = parts.len() - 1;
    let parent = if rng.random_bool(0.6) { newest } else { rng.random_range(0..parts.len()) };
    let base = &parts[parent];
    let size = match base.shape {
        Shape::Cuboid { size } if rng.random_bool(SAME_SIZE) => size,
        _ => random_size(rng, ranges, thickness),
    };
    // All vectors below are in the parent's frame; `outward` is the normal of the chosen face.
    let face = Pose::new(0.0, 0.0, FRAC_PI_2 * f64::from(rng.random_range(0..4u8)));
    let outward = face.vector(Vector::x());
    let along = face.vector(Vector::y());
    let (depth, breadth) = (base.footprint().extent(outward), base.footprint().extent(along));
    let half = Vector::new(size[0] / 2.0, size[1] / 2.0);
    let child = Footprint::Rectangle { half };
    let centre = if rng.random_bool(DIAGONAL) {
        let turned = Pose::new(0.0, 0.0, face.heading + sign(rng) * FRAC_PI_4);
        // The corner that points into the parent is sunk until its cross-section is wide enough.
        let corner = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
            .map(|(x, y)| turned.vector(Vector::new(x * half.x, y * half.y)))
            .into_iter()
            .min_by(|p, q| p.dot(&outward).total_cmp(&q.dot(&outward)))?;
        let sunk = 0.6 * half.x.min(half.y).min(breadth).min(depth);
        let reach = breadth - sunk;
        let at = outward * (depth - sunk) + along * uniform(rng, -reach, reach);
        Pose { position: at - corner, heading: turned.heading }
    } else {
        let turned =
            Pose::new(0.0, 0.0, face.heading + FRAC_PI_2 * f64::from(rng.random_range(0..4u8)));
        let out = depth + child.extent(turned.local_vector(outward));
        let wide = child.extent(turned.local_vector(along));
        let most = breadth + wide - 2.0 * LEAST_OVERLAP * breadth.min(wide);
        let aside = match weighted(rng, &[0.35, 0.35, 0.30]) {
            0 => 0.0,
            1 => sign(rng) * (breadth - wide),
            _ => uniform(rng, -most, most),
        };
        Pose { position: outward * out + along * aside, heading: turned.heading }
    };
    let pose = base.pose * centre;
    let smaller = child.grown(-1e-4);
    let free = parts.iter().enumerate().all(|(index, other)| {
        index == parent
            || clearance((&smaller, &pose), (&other.footprint(), &other.pose), 1e-3) > 0.0
    });
    free.then_some((parent, size, pose))
}
