//! Search for the poses at which an arm can hold a tool over the table.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use super::model::Arm;
use super::places::Places;
use pushplan::geometry::{Pose, Pose3, Vector, Vector3};
use pushplan::scene::Scene;

use super::inverse::{NEAR, inverse, near, postures};
use super::kinematics::{dexterity, frames, level};
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

/// Number of bearings that are tried for an arm that does not turn all around, and of rotations of
/// the tool for each.
const BEARINGS: usize = 8;
const FEW_TURNS: usize = 4;

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
    let axis = vertical_axis(arm);
    let centre = axis.map_or(arm.base.position.xy(), |(centre, _)| centre);
    let rows = |turns: usize, bearing: f64| -> Vec<Vec<bool>> {
        let turn = |turn: usize| turn as f64 * TAU / turns as f64;
        let turns = (0..turns).into_par_iter();
        turns.map(|k| row(&room, (height, turn(k)), (centre, bearing), rings)).collect()
    };
    let any = |rows: &[Vec<bool>], ring: usize| rows.iter().any(|row| row[ring]);
    let bearings = (0..BEARINGS).map(|k| k as f64 * TAU / BEARINGS as f64);
    let all_around = axis.is_some_and(|(_, wide)| wide);
    let tried: Vec<(f64, Vec<Vec<bool>>)> = match all_around {
        true => vec![(0.0, rows(TURNS, 0.0))],
        false => bearings.map(|bearing| (bearing, rows(FEW_TURNS, bearing))).collect(),
    };
    let count = |rows: &[Vec<bool>]| rows.iter().flatten().filter(|free| **free).count();
    let (bearing, best) = tried.iter().rev().max_by_key(|(_, rows)| count(rows))?;
    let free = match axis {
        Some(_) if all_around => best.clone(),
        Some(_) => rows(TURNS, *bearing),
        None => Vec::new(),
    };
    // The annulus of an arm without vertical axis covers all bearings.
    let found: Vec<Vec<bool>> = match axis {
        Some(_) => free.clone(),
        None => tried.iter().flat_map(|(_, rows)| rows.clone()).collect(),
    };
    let first = (0..rings).find(|ring| any(&found, *ring))?;
    let last = (0..rings).rev().find(|ring| any(&found, *ring))?;
    let free = (0..rings).flat_map(|ring| free.iter().map(move |row| row[ring])).collect();
    let ring = [first as f64 * STEP, last as f64 * STEP];
    (first < last).then_some(Places { ring, step: STEP, turns: TURNS, free, centre })
}

/// Returns the feasibility at each distance from a centre at a bearing, for one rotation of the
/// tool relative to this bearing.
fn row(
    room: &Room,
    (height, turn): (f64, f64),
    (centre, bearing): (Vector, f64),
    rings: usize,
) -> Vec<bool> {
    let arm = room.arm;
    let sound = |posture: &Vec<f64>| {
        dexterity(arm, &frames(arm, posture)) >= DEXTERITY
            && room.met(&room.stance(posture), &[], None).is_none()
    };
    let ahead = Vector::new(bearing.cos(), bearing.sin());
    let held = |ring: usize, before: Option<&Vec<f64>>| {
        let position = centre + ring as f64 * STEP * ahead;
        let at = Pose { position, heading: bearing + turn };
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

/// Returns the vertical axis about which an arm turns, and whether it turns nearly all around, so
/// that results at one bearing also hold for others. Only lifts may precede this joint.
fn vertical_axis(arm: &Arm) -> Option<(Vector, bool)> {
    let lifts = arm.joints.iter().take_while(|joint| joint.slides).count();
    let frames = frames(arm, &arm.home);
    let axis = |k: usize| frames[k + 1].rotation * arm.joints[k].axis;
    let upright = |k: usize| axis(k).xy().norm() < 1e-3;
    let first = arm.joints.get(lifts).filter(|_| (0..=lifts).all(upright))?;
    let wide = first.limits.is_none_or(|[low, high]| low <= -0.75 * PI && high >= 0.75 * PI);
    // A range of less than half a turn makes sides differ.
    let turns = first.limits.is_none_or(|[low, high]| high - low >= PI);
    turns.then(|| (frames[lifts + 1].position.xy(), wide))
}

/// Returns a collision-free configuration with a tool in the middle of the annulus, at the travel
/// height, metres, or as high as possible. It is ahead of the base if possible. An arm whose joints
/// all move horizontally is at the height of pushes. Returns `None` if there is none.
pub fn usual_home(arm: &Arm, [lift, travel]: [f64; 2]) -> Option<Vec<f64>> {
    let scene = Scene::default();
    let room = Room::new(arm, &scene, None);
    let [near_by, far] = arm.places.ring;
    let turns = |count: usize| (0..count).map(move |k| k as f64 * TAU / count as f64);
    let mut tried =
        turns(BEARINGS).flat_map(|bearing| turns(FEW_TURNS).map(move |turn| (bearing, turn)));
    tried.find_map(|(bearing, turn)| {
        let ahead = Vector::new(bearing.cos(), bearing.sin());
        let position = arm.places.centre + 0.5 * (near_by + far) * ahead;
        let at = Pose { position, heading: turn };
        if !arm.places.allow(position, turn) {
            return None;
        }
        let heights = [1.0, 0.75, 0.5, 0.25, 0.1].map(|share| share * travel);
        let is_level = level(arm, &frames(arm, &arm.home), lift).is_some();
        let heights = if is_level { &[lift][..] } else { &heights[..] };
        heights.iter().find_map(|height| {
            let target = Pose3::upright(at, *height) * arm.flange_of_tool();
            let free = |posture: &Vec<f64>| {
                dexterity(arm, &frames(arm, posture)) >= DEXTERITY
                    && room.met(&room.stance(posture), &[], None).is_none()
            };
            postures(arm, &target, std::slice::from_ref(&arm.home)).into_iter().find(free)
        })
    })
}
