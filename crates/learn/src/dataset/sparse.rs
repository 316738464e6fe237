//! Scattered objects and the strokes of the hand through them.

use pushplan::internals::geometry::{
    Footprint, Pose, Vector, clearance, perpendicular, travel_to_contact,
};
use pushplan::internals::{
    outcome::Frame,
    scene::{JOINABLE, Object, Ranges, Scene, Span, State},
    task::{Stroke, ToolMotion},
};
use rand::Rng;
use rand_pcg::Pcg64;

use super::crowd::{crowd, object_count};
use super::curriculum::Block;
use super::distributions::{heading, log_uniform, uniform};
use super::hand::{HAND_RADIUS, HandPlay};
use super::joints::join_neighbours;
use super::tabletop::anywhere;

/// Share of objects placed near another one instead of separately; without neighbours there are no
/// joints.
const NEIGHBOURS: f64 = 0.70;

/// Range of the gap between such neighbours, metres, log-uniform.
const NEIGHBOUR_GAP: Span = Span::new(2e-4, 0.03);

/// Share of such cuboids that are parallel to their neighbour.
const ALIGNED: f64 = 0.5;

/// Maximum number of attempts to place an object near another before it is placed separately.
const NEIGHBOUR_TRIES: usize = 10;

/// Minimum distance of separate objects from earlier ones, metres.
const APART: f64 = 0.04;

/// Side of the square over which objects are scattered, metres, for one object. Its area grows with
/// their number.
const SIDE: f64 = 0.33;

/// Range of the gap between hand and target at the start of a stroke, metres.
const GAP: (f64, f64) = (0.004, 0.06);

/// Maximum lateral offset of a stroke relative to the largest offset with contact.
const OFF_CENTRE: f64 = 0.8;

/// Maximum number of attempts to aim a stroke before the scene is rejected. After `TRIES_UNTOUCHED`
/// of them, targets may have been touched before.
const TRIES: usize = 60;
const TRIES_UNTOUCHED: usize = 45;

/// Length of a long line beyond the farthest object, metres.
const BEYOND: f64 = 0.15;

/// Draws scattered objects and seven or eight strokes, each aimed at an untouched object.
pub(super) fn sparse(
    rng: &mut Pcg64,
    ranges: &Ranges,
    block: &Block,
) -> Option<(Scene, ToolMotion, Vec<Frame>)> {
    let scene = scattered(rng, ranges, block);
    let mut play = HandPlay::new(rng, &scene, ranges);
    let speed = log_uniform(rng, ranges.speed);
    let count = rng.random_range(ranges.pushes.low as usize..=ranges.pushes.high as usize);
    for _ in 0..count {
        let stroke = aimed(rng, &scene, &play, ranges.travel.high, speed)?;
        play = play.play(stroke)?;
    }
    let (motion, frames) = play.finish();
    Some((scene, motion, frames))
}

/// Draws scattered objects and one long line through them.
pub(super) fn sparse_line(
    rng: &mut Pcg64,
    ranges: &Ranges,
    block: &Block,
) -> Option<(Scene, ToolMotion, Vec<Frame>)> {
    let scene = scattered(rng, ranges, block);
    let play = HandPlay::new(rng, &scene, ranges);
    let speed = log_uniform(rng, ranges.speed);
    let state = scene.start();
    let target = rng.random_range(0..scene.objects.len());
    let direction = heading(rng);
    let along = Vector::new(direction.cos(), direction.sin());
    let (near, far) = span(&scene, &state, along);
    let aside = perpendicular(along);
    let wide = reach(&scene.objects[target], &state, target, aside) + HAND_RADIUS;
    let lateral = 0.5 * uniform(rng, -wide, wide);
    let behind = near - HAND_RADIUS - uniform(rng, GAP.0, GAP.1);
    let from = along * behind + aside * (state.poses[target].position.dot(&aside) + lateral);
    let travel = (far - behind + BEYOND).clamp(ranges.travel.low, ranges.travel.high);
    let stroke = play.stroke(&state, from, along * travel, speed)?;
    let (motion, frames) = play.play(stroke)?.finish();
    Some((scene, motion, frames))
}

fn scattered(rng: &mut Pcg64, ranges: &Ranges, block: &Block) -> Scene {
    let count = object_count(rng, ranges);
    let mut side = SIDE * (count as f64).sqrt();
    let scene = crowd(rng, ranges, block, count, |rng, objects, footprint| {
        if !objects.is_empty()
            && rng.random_bool(NEIGHBOURS)
            && let Some(pose) =
                (0..NEIGHBOUR_TRIES).find_map(|_| neighbour(rng, objects, footprint))
        {
            return pose;
        }
        loop {
            let (x, y) = (uniform(rng, 0.0, side), uniform(rng, 0.0, side));
            let pose = Pose::new(x, y, heading(rng));
            let free = objects.iter().all(|object| {
                let other = (&object.shape.footprint(), &object.pose);
                clearance((footprint, &pose), other, APART) >= APART
            });
            if free {
                return pose;
            }
            // The area grows, so that this loop ends.
            side *= 1.02;
        }
    });
    let mut scene = anywhere(rng, scene);
    join_neighbours(rng, &mut scene, block);
    scene
}

/// Draws a pose near one of `objects`; `None` if it would overlap another.
fn neighbour(rng: &mut Pcg64, objects: &[Object], footprint: &Footprint) -> Option<Pose> {
    let anchor = &objects[rng.random_range(0..objects.len())];
    let around = (&anchor.shape.footprint(), &anchor.pose);
    let side = heading(rng);
    let turn = if rng.random_bool(ALIGNED) { anchor.pose.heading } else { heading(rng) };
    let away = Vector::new(side.cos(), side.sin());
    let far = around.0.bounding_radius() + footprint.bounding_radius() + JOINABLE;
    let mut pose = Pose { position: anchor.pose.position + away * far, heading: turn };
    let travel = travel_to_contact((footprint, &pose), -away, around)?;
    pose.position -= away * (travel - log_uniform(rng, NEIGHBOUR_GAP));
    let free = objects.iter().all(|object| {
        let other = (&object.shape.footprint(), &object.pose);
        clearance((footprint, &pose), other, NEIGHBOUR_GAP.high) > NEIGHBOUR_GAP.low / 2.0
    });
    free.then_some(pose)
}

/// Draws a stroke that meets an object, preferably an untouched one.
pub(super) fn aimed(
    rng: &mut Pcg64,
    scene: &Scene,
    play: &HandPlay<'_>,
    travel: f64,
    speed: f64,
) -> Option<Stroke> {
    let state = play.state();
    let all: Vec<usize> = (0..scene.objects.len()).collect();
    let untouched: Vec<usize> = all.iter().copied().filter(|&k| !play.touched()[k]).collect();
    (0..TRIES).find_map(|attempt| {
        let fresh = attempt < TRIES_UNTOUCHED && !untouched.is_empty();
        let targets = if fresh { &untouched } else { &all };
        let target = targets[rng.random_range(0..targets.len())];
        let (object, pose) = (&scene.objects[target], &state.poses[target]);
        let direction = heading(rng);
        let along = Vector::new(direction.cos(), direction.sin());
        let aside = perpendicular(along);
        let wide = reach(object, &state, target, aside) + HAND_RADIUS;
        let lateral = OFF_CENTRE * uniform(rng, -wide, wide);
        let back = reach(object, &state, target, along) + HAND_RADIUS;
        let behind =
            Pose { position: pose.position + aside * lateral - along * back, heading: 0.0 };
        let hand = Footprint::Disc { radius: HAND_RADIUS };
        let met = travel_to_contact((&hand, &behind), along, (&object.shape.footprint(), pose))?;
        let from = behind.position + along * (met - uniform(rng, GAP.0, GAP.1));
        play.stroke(&state, from, along * travel, speed)
    })
}

/// Returns the half width of object `index` along the unit vector `direction`, metres.
fn reach(object: &Object, state: &State, index: usize, direction: Vector) -> f64 {
    object.shape.footprint().extent(state.poses[index].local_vector(direction))
}

/// Returns the extent of all objects along the unit vector `direction`, metres.
pub(super) fn span(scene: &Scene, state: &State, direction: Vector) -> (f64, f64) {
    let ends = scene.objects.iter().enumerate().map(|(index, object)| {
        let (middle, half) =
            (state.poses[index].position.dot(&direction), reach(object, state, index, direction));
        (middle - half, middle + half)
    });
    ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), (c, d)| (a.min(c), b.max(d)))
}
