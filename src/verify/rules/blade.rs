//! Rules for the blade in a replay: where its object lies, and the objects that blade and fingers
//! meet.
//!
//! The engine simulates the blade from below the edge on, without its approach and without the
//! fingers.

use crate::geometry::{Pose3, Solid, wrap_angle};
use crate::outcome::{Frame, LeverFault};
use crate::scene::{Blade, Plate, Robot, Scene, State};
use crate::task::LeverStep;

use super::lever::{SCRATCH, expected_plate};

/// Largest distance of an object from the pose to which the blade goes, metres, and the lever arm
/// that weights rotations. The planner takes the pose from a replay.
const DISPLACED: f64 = 0.005;
const ARM: f64 = 0.1;

/// Tilt from which on the heading of an object, seen from above, has no meaning, radians.
const TILTED: f64 = 0.1;

/// Returns the first fault of a lever-up, step `index` of its plan, in the frames of a replay.
pub(super) fn met(
    (robot, scene): (&Robot, &Scene),
    blade: &Blade,
    (index, step): (usize, &LeverStep),
    frames: &[Frame],
) -> Option<LeverFault> {
    let begin = frames.iter().position(|frame| frame.stroke == index)?;
    let (plate, lever) = (expected_plate(scene, step), &step.lever);
    // The last frame of the previous step shows the objects at rest.
    let before = &frames[begin.saturating_sub(1)].state;
    if is_displaced(&plate, lever.plate, before) {
        return Some(LeverFault::Displaced);
    }
    let others = Others::new(scene, lever.plate);
    let lying = lever.blade_on(&plate, blade, 0.0);
    if let Some(body) = others.met(before, &blade.swept(&lying, lever.retreat)) {
        return Some(LeverFault::Meets { body });
    }
    robot.hand?;
    let coming = others.met(before, &blade.fingers(&lying, lever.retreat));
    let own = frames[begin..].iter().take_while(|frame| frame.stroke == index);
    let mut going = own.filter_map(|frame| Some((frame.blade.as_ref()?, &frame.state)));
    let met = |(pose, state)| others.met(state, &blade.fingers(pose, 0.0));
    coming.or_else(|| going.find_map(met)).map(|body| LeverFault::HandMeets { body })
}

/// Returns `true` if the object does not lie where the plan expects it.
fn is_displaced(expected: &Plate, object: usize, state: &State) -> bool {
    let Some(found) = state.poses.get(object) else { return false };
    let tilt = state.space.as_ref().and_then(|space| space.get(object)).map_or(0.0, Pose3::tilt);
    let turn = wrap_angle(found.heading - expected.pose.heading).abs();
    let turn = if tilt < TILTED { ARM * turn } else { 0.0 };
    (found.position - expected.pose.position).norm() + turn > DISPLACED
}

/// The objects beside the levered one.
struct Others<'a> {
    scene: &'a Scene,
    /// Objects with their indices, and their places among the 3-D poses of a state.
    plates: Vec<(usize, usize, Plate)>,
}

impl<'a> Others<'a> {
    fn new(scene: &'a Scene, levered: usize) -> Self {
        let all = scene.things().map(|(k, _)| k).enumerate().filter(|(_, k)| *k != levered);
        let plates = all.map(|(place, k)| (k, place, Plate::of(scene, k))).collect();
        Self { scene, plates }
    }

    /// Returns the name of the first object that a solid meets.
    fn met(&self, state: &State, solid: &Solid) -> Option<String> {
        let at = |place: usize, k: usize, plate: &Plate| {
            let space = state.space.as_ref().and_then(|space| space.get(place)).copied();
            space.unwrap_or_else(|| Pose3::upright(state.poses[k], plate.z))
        };
        let mut there = self.plates.iter().filter(|(k, ..)| !self.scene.has_left(*k, state));
        let meets = |(k, place, plate): &&(usize, usize, Plate)| {
            let solids = plate.solids_at(&at(*place, *k, plate));
            solids.iter().any(|own| own.depth(solid) > SCRATCH)
        };
        there.find(meets).map(|(.., plate)| plate.name.clone())
    }
}
