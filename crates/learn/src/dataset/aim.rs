//! Aiming of a push: start poses from which the tool meets an object after a short gap.

use std::f64::consts::{FRAC_PI_2, TAU};

use pushplan::internals::geometry::{
    Footprint, Pose, Vector, clearance, perpendicular, travel_to_contact,
};
use pushplan::internals::{
    scene::{Object, Scene, State, Tool},
    task::Stroke,
};
use rand::Rng;
use rand_pcg::Pcg64;

use super::distributions::{heading, uniform, weighted};

/// Minimum distance to all other bodies when the tool is set down, metres.
pub const SET_DOWN: f64 = 1e-4;

/// Probabilities of the lateral aim: at the face of a part, anywhere over the tool's outline
/// (including edges and near misses), and beside an edge (inner corners and grazing contacts).
const LATERAL: [f64; 3] = [0.5, 0.2, 0.3];

/// Share of near misses that are kept: a model must recognise a miss but learns little from it.
const NEAR_MISSES: f64 = 0.15;

/// Parameters of a push except its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim {
    /// Heading of the motion, radians.
    pub direction: f64,
    /// Heading of the tool frame, radians.
    pub heading: f64,
    /// Gap between tool and object at the start, along the motion, metres.
    pub gap: f64,
    /// Travel, metres.
    pub travel: f64,
    /// Speed, m/s.
    pub speed: f64,
}

/// Returns a stroke that meets a random object of `state` with a random piece of the tool.
///
/// The start is free of all objects and obstacles. Returns `None` if the attempt is not free.
pub fn aimed_stroke(
    rng: &mut Pcg64,
    tool: &Tool,
    scene: &Scene,
    state: &State,
    aim: &Aim,
) -> Option<Stroke> {
    let along = Vector::new(aim.direction.cos(), aim.direction.sin());
    let aside = perpendicular(along);
    let target = rng.random_range(0..scene.objects.len());
    let footprint = scene.objects[target].shape.footprint();
    let pose = state.poses[target];
    let reach = |direction: Vector| footprint.extent(pose.local_vector(direction));

    // Outline of the tool at its heading, with its frame at the origin.
    let turned = Pose::new(0.0, 0.0, aim.heading);
    let span = |index: usize, direction: Vector| {
        let part = tool.part_pose(index, &turned);
        let centre = part.position.dot(&direction);
        let half = tool.parts()[index].footprint().extent(part.local_vector(direction));
        (centre - half, centre + half)
    };
    let part = rng.random_range(0..tool.parts().len());
    let (low, high) = span(part, aside);
    let wide = reach(aside);
    let lateral = match weighted(rng, &LATERAL) {
        0 => uniform(rng, low - 0.9 * wide, high + 0.9 * wide),
        1 => {
            let spans = (0..tool.parts().len()).map(|index| span(index, aside));
            let (low, high) = spans.fold((low, high), |(a, b), (c, d)| (a.min(c), b.max(d)));
            uniform(rng, low - 1.02 * wide, high + 1.02 * wide)
        }
        _ => {
            let off = wide + uniform(rng, -0.005, 0.015);
            if rng.random::<bool>() { low - off } else { high + off }
        }
    };
    let front =
        (0..tool.parts().len()).map(|index| span(index, along).1).fold(f64::NEG_INFINITY, f64::max);
    let behind = pose.position.dot(&along) - reach(along) - front - SET_DOWN;
    let place = |shift: f64| Pose {
        position: along * (behind + shift) + aside * (pose.position.dot(&aside) - lateral),
        heading: aim.heading,
    };
    let met = tool_travel(tool, &place(0.0), along, (&footprint, &pose));
    if met.is_none() && !rng.random_bool(NEAR_MISSES) {
        return None;
    }
    let from = place(met.unwrap_or(0.0) - aim.gap);
    let free = scene.objects.iter().zip(&state.poses).all(|(object, pose)| {
        tool_clearance(tool, &from, (&object.shape.footprint(), pose)) >= SET_DOWN
    }) && scene.obstacles.iter().all(|obstacle| {
        tool_clearance(tool, &from, (&obstacle.shape().footprint(), &obstacle.pose)) >= SET_DOWN
    });
    free.then(|| Stroke {
        from,
        to: Pose { position: from.position + along * aim.travel, heading: aim.heading },
        duration: aim.travel / aim.speed,
        settle: true,
    })
}

/// Draws a push direction, radians: along a line through two objects, perpendicular to an object's
/// face, or uniform.
pub fn random_direction(rng: &mut Pcg64, objects: &[Object], state: &State) -> f64 {
    let object = rng.random_range(0..objects.len());
    match weighted(rng, &[0.35, 0.25, 0.40]) {
        0 if objects.len() > 1 => {
            let other = (object + rng.random_range(1..objects.len())) % objects.len();
            let line = state.poses[other].position - state.poses[object].position;
            line.y.atan2(line.x) + uniform(rng, -0.4, 0.4)
        }
        1 if !objects[object].shape.is_cylinder() => {
            state.poses[object].heading + FRAC_PI_2 * f64::from(rng.random_range(0..4u8))
        }
        _ => uniform(rng, 0.0, TAU),
    }
}

/// Draws a heading of the tool for a push in `direction`, radians: perpendicular or parallel to it
/// in two thirds of the cases, as with principal directions and grips.
pub fn random_heading(rng: &mut Pcg64, direction: f64) -> f64 {
    if rng.random_bool(0.65) {
        direction + FRAC_PI_2 * f64::from(rng.random_range(0..4u8))
    } else {
        heading(rng)
    }
}

/// Returns the travel of the tool along the unit vector `direction` until a part touches, metres.
pub(super) fn tool_travel(
    tool: &Tool,
    pose: &Pose,
    direction: Vector,
    other: (&Footprint, &Pose),
) -> Option<f64> {
    let travels = (0..tool.parts().len()).filter_map(|index| {
        let part = tool.part_pose(index, pose);
        travel_to_contact((&tool.parts()[index].footprint(), &part), direction, other)
    });
    travels.reduce(f64::min)
}

/// Returns the minimum distance between the tool at `pose` and a footprint, metres, capped at 1 cm.
pub(super) fn tool_clearance(tool: &Tool, pose: &Pose, other: (&Footprint, &Pose)) -> f64 {
    let gaps = (0..tool.parts().len()).map(|index| {
        clearance((&tool.parts()[index].footprint(), &tool.part_pose(index, pose)), other, 0.01)
    });
    gaps.fold(0.01, f64::min)
}
