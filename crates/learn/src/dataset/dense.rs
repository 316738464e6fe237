//! Nearly touching objects in a grid, with one stroke of the hand into it.

use std::f64::consts::FRAC_PI_2;

use pushplan::internals::geometry::{Pose, Vector, perpendicular, travel_to_contact};
use pushplan::internals::{
    outcome::Frame,
    scene::{Ranges, Scene},
    task::ToolMotion,
};
use rand::Rng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

use super::crowd::{crowd, object_count};
use super::curriculum::Block;
use super::distributions::{log_uniform, uniform};
use super::hand::{HAND_RADIUS, HandPlay};
use super::joints::join_neighbours;
use super::sparse::span;
use super::tabletop::anywhere;

/// Range of the gap between neighbours, metres. Most gaps are small because the position within the
/// range is a product of two draws.
const GAP: (f64, f64) = (1e-4, 0.010);

/// Share of cells placed less neatly: up to a centimetre further out and rotated.
const JITTERED: f64 = 0.25;

/// Maximum rotation of neat and jittered cells relative to the grid, radians.
const TURN: (f64, f64) = (0.05, 0.25);

/// Range of the gap between hand and grid at the start, metres.
const STAND_OFF: (f64, f64) = (0.005, 0.05);

/// Draws a grid of objects and one stroke into it from one of its four sides.
pub(super) fn dense(
    rng: &mut Pcg64,
    ranges: &Ranges,
    block: &Block,
) -> Option<(Scene, ToolMotion, Vec<Frame>)> {
    let mut scene = grid(rng, ranges, block);
    let side = FRAC_PI_2 * f64::from(rng.random_range(0..4u8));
    let along = Vector::new(side.cos(), side.sin());
    let aside = perpendicular(along);
    let start = scene.start();
    let (near, _) = span(&scene, &start, along);
    let (low, high) = span(&scene, &start, aside);
    // Strokes cover the whole face, down to grazing contacts with an outer object.
    let margin = 0.5 * HAND_RADIUS;
    let lateral = uniform(rng, low - margin, high + margin);
    let behind = near - HAND_RADIUS - uniform(rng, STAND_OFF.0, STAND_OFF.1);
    let from = along * behind + aside * lateral;

    // The stroke is moved with the scene.
    let before = scene.objects[0].pose;
    scene = anywhere(rng, scene);
    let motion = scene.objects[0].pose * before.inverse();
    join_neighbours(rng, &mut scene, block);
    let play = HandPlay::new(rng, &scene, ranges);
    let travel = motion.vector(along) * ranges.travel.high;
    let speed = log_uniform(rng, ranges.speed);
    let stroke = play.stroke(&scene.start(), motion.point(from), travel, speed)?;
    let (motion, frames) = play.play(stroke)?.finish();
    Some((scene, motion, frames))
}

/// Places objects in the cells of a grid along x and y.
///
/// The middle object is first. Each other object approaches it along the line of its cell until it
/// almost touches.
pub(super) fn grid(rng: &mut Pcg64, ranges: &Ranges, block: &Block) -> Scene {
    let count = object_count(rng, ranges);
    let mut cells = cells(rng, count).into_iter();
    crowd(rng, ranges, block, count, |rng, objects, footprint| {
        let cell = cells.next().unwrap_or_default();
        let jittered = rng.random_bool(JITTERED);
        let most = if jittered { TURN.1 } else { TURN.0 };
        let quarter = FRAC_PI_2 * f64::from(rng.random_range(0..4u8));
        let turn = quarter + uniform(rng, -most, most);
        let gap = GAP.0 + (GAP.1 - GAP.0) * rng.random::<f64>() * rng.random::<f64>();
        let further = if jittered { uniform(rng, 0.0, GAP.1) } else { 0.0 };
        if cell == Vector::zeros() {
            return Pose::new(0.0, 0.0, turn);
        }
        let aim = if jittered { uniform(rng, -0.15, 0.15) } else { 0.0 };
        let out = Pose::new(0.0, 0.0, aim).vector(cell.normalize());
        // The object starts beyond all others and moves straight towards them until the first
        // contact.
        let far = Pose { position: out * (cell.norm() + 1.0), heading: turn };
        let travels = objects.iter().filter_map(|object| {
            let still = (&object.shape.footprint(), &object.pose);
            travel_to_contact((footprint, &far), -out, still)
        });
        let travel = travels.reduce(f64::min).unwrap_or(0.0);
        Pose { position: far.position - out * (travel - gap - further), heading: turn }
    })
}

/// Returns the cells of a grid that is as square as `count` allows, relative to the middle cell and
/// nearest to it first. The last row may be incomplete.
fn cells(rng: &mut Pcg64, count: usize) -> Vec<Vector> {
    let columns = (count as f64).sqrt().ceil() as usize;
    let rows = count.div_ceil(columns);
    let mut last: Vec<usize> = (0..columns).collect();
    last.shuffle(rng);
    let flipped = rng.random::<bool>();
    let middle = ((columns - 1) / 2, rows.saturating_sub(1) / 2);
    let mut cells: Vec<Vector> = (0..count)
        .map(|k| {
            let row = k / columns;
            let column = if row + 1 == rows { last[k % columns] } else { k % columns };
            let (x, y) = (column as f64 - middle.0 as f64, row as f64 - middle.1 as f64);
            if flipped { Vector::new(y, x) } else { Vector::new(x, y) }
        })
        .collect();
    cells.sort_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
    cells
}
