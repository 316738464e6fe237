//! Search for the poses at which an arm can hold a tool over the table.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use super::model::Arm;
use super::places::Places;
use pushplan::geometry::{Pose, Pose3, Vector, Vector3};
use pushplan::scene::Scene;

use super::inverse::{NEAR, inverse, near, postures};
use super::kinematics::{dexterity, frames};
use super::path::DEXTERITY;
use super::room::Room;

/// Step and maximum of the sampled distances from the base, metres.
const STEP: f64 = 0.025;
const FARTHEST: f64 = 3.0;

/// Number of sampled tool rotations per distance.
const TURNS: usize = 36;

/// Number of starts from arbitrary configurations if no neighbour provides one.
const STARTS: usize = 3;

/// Stride of sampled rings until a feasible one is found.
const SPARSE: usize = 3;

/// Number of consecutive failed rings that end the search.
const FAILED: usize = 3;

/// Inner and outer radius of the annulus in which an arm can hold a tool, metres.
pub type Ring = [f64; 2];

/// Finds the poses at which an arm can hold a tool, with its underside at a height, metres, without
/// self-collision or collision with the table. Returns `None` if there are none.
pub fn find_places(arm: &Arm, height: f64) -> Option<Places> {
    let scene = Scene::default();
    let room = Room::new(arm, &scene, None);
    let long = |from: Vector3| from.norm();
    let length: f64 = arm.joints.iter().map(|joint| long(joint.origin.position)).sum::<f64>()
        + long(arm.flange.position);
    let slides = arm.joints.iter().filter(|joint| joint.slides);
    let stroke = slides.filter_map(|joint| joint.limits).map(|[low, high]| high - low).sum::<f64>();
    let rings = ((length + stroke).min(FARTHEST) / STEP).ceil() as usize + 1;
    let rows: Vec<Vec<bool>> = (0..TURNS)
        .into_par_iter()
        .map(|turn| row(&room, height, turn as f64 * TAU / TURNS as f64, rings))
        .collect();
    let any = |ring: &usize| rows.iter().any(|row| row[*ring]);
    let (first, last) = ((0..rings).find(any)?, (0..rings).rev().find(any)?);
    let free = match turns_about_the_base(arm) {
        true => (0..rings).flat_map(|ring| rows.iter().map(move |row| row[ring])).collect(),
        false => Vec::new(),
    };
    let ring = [first as f64 * STEP, last as f64 * STEP];
    (first < last).then_some(Places { ring, step: STEP, turns: TURNS, free })
}

/// Returns the feasibility at each distance ahead of the base, for one rotation of the tool.
fn row(room: &Room, height: f64, turn: f64, rings: usize) -> Vec<bool> {
    let arm = room.arm;
    let sound = |posture: &Vec<f64>| {
        dexterity(arm, &frames(arm, posture)) >= DEXTERITY
            && room.met(&room.stance(posture), &[], false).is_none()
    };
    let held = |ring: usize, before: Option<&Vec<f64>>| {
        let at = Pose { position: Vector::new(ring as f64 * STEP, 0.0), heading: turn };
        let target = Pose3::upright(at, height) * arm.flange_of_tool();
        let next = before.and_then(|seed| inverse(arm, &target, seed, NEAR));
        next.filter(&sound).or_else(|| {
            let mut seeds = vec![arm.home.clone()];
            seeds.extend((0..STARTS).map(|index| super::inverse::start(arm, index)));
            near(arm, &target, &seeds).into_iter().find(&sound)
        })
    };
    let mut row = vec![false; rings];
    // Starts at the first feasible ring near the middle and proceeds in both directions until
    // several rings in a row fail.
    let middle = (0..rings / 2).step_by(SPARSE).flat_map(|k| [rings / 2 - k, rings / 2 + k]);
    let first =
        middle.filter(|ring| *ring < rings).find_map(|ring| Some((ring, held(ring, None)?)));
    let Some((first, posture)) = first else { return row };
    row[first] = true;
    let outwards: Vec<usize> = (first + 1..rings).collect();
    let inwards: Vec<usize> = (0..first).rev().collect();
    for way in [outwards, inwards] {
        let (mut before, mut failed) = (Some(posture.clone()), 0);
        for ring in way {
            before = held(ring, before.as_ref());
            row[ring] = before.is_some();
            failed = if row[ring] { 0 } else { failed + 1 };
            if failed == FAILED {
                break;
            }
        }
    }
    row
}

/// Returns `true` if the first joint rotates about the vertical through the origin, nearly all
/// around. Results ahead of the base then also hold for its sides.
fn turns_about_the_base(arm: &Arm) -> bool {
    let Some(first) = arm.joints.first() else { return false };
    let frame = arm.base * first.origin;
    let axis = frame.rotation * first.axis;
    let wide = first.limits.is_none_or(|[low, high]| low <= -0.75 * PI && high >= 0.75 * PI);
    !first.slides && wide && axis.xy().norm() < 1e-3 && frame.position.xy().norm() < 1e-3
}

/// Returns a collision-free configuration with a tool over the middle of the ring, at the travel
/// height, metres, or as high as possible. Returns `None` if there is none.
pub fn usual_home(arm: &Arm, [near_by, far]: Ring, travel: f64) -> Option<Vec<f64>> {
    let scene = Scene::default();
    let room = Room::new(arm, &scene, None);
    let at = Pose { position: Vector::new(0.5 * (near_by + far), 0.0), heading: 0.0 };
    [1.0, 0.75, 0.5, 0.25].iter().find_map(|share| {
        let target = Pose3::upright(at, share * travel) * arm.flange_of_tool();
        let free = |posture: &Vec<f64>| {
            dexterity(arm, &frames(arm, posture)) >= DEXTERITY
                && room.met(&room.stance(posture), &[], false).is_none()
        };
        postures(arm, &target, std::slice::from_ref(&arm.home)).into_iter().find(free)
    })
}
