//! Reach of a blade and the room around a plate.

use std::f64::consts::PI;

use crate::geometry::{Pose3, Solid, Vector, Vector3, cross, perpendicular};
use crate::{
    outcome::LeverFault,
    scene::{Blade, Plate, Region, Slab, Tool},
    task::{LeverRules, LeverUp, Task},
};

/// Depth to which the blade may penetrate fixed bodies, metres, because it slides along floors.
const SLACK: f64 = 1e-4;

/// Maximum motion of the blade's farthest point between two checks, metres.
const LOOK: f64 = 0.006;

/// Maximum depth of the tip as a share of the distance below the plate: beyond the tip, part of the
/// plate must remain to lift.
const DEEPEST: f64 = 0.8;

/// Surroundings of a plate that is levered.
pub struct LeverRoom<'a> {
    task: &'a Task,
    plate: Plate,
    blade: Blade,
    /// Solids that the blade must not meet, with names.
    bodies: Vec<(String, Solid)>,
    /// Solids that only the hand must not meet, with names.
    beside: Vec<(String, Solid)>,
    /// Height above which there is no body, metres.
    top: f64,
}

impl<'a> LeverRoom<'a> {
    /// Creates the room around the object that a task levers, for the blade of a tool. A tool
    /// without a blade has an empty one.
    pub fn new(task: &'a Task, tool: &Tool) -> Self {
        let scene = &task.scene;
        let blocks = scene
            .obstacles
            .iter()
            .map(|block| (block.name.clone(), block.solid(), block.z + block.size[2]));
        let levered = task.levered().object;
        let others = scene.plates().enumerate().filter(|(k, _)| *k != levered);
        let others = others.flat_map(|(_, plate)| {
            let top = |slab: &Slab| plate.z + (slab.bottom + slab.height);
            let solids = plate.slabs.iter().zip(plate.solids());
            let all = solids.map(|(slab, solid)| (plate.name.clone(), solid, top(slab)));
            all.collect::<Vec<_>>()
        });
        let (beside, hand): (Vec<&Region>, Vec<&Region>) = {
            let all = task.scene.keep_out.iter().filter(|region| region.tool || region.hand);
            all.partition(|region| region.tool)
        };
        let column = |region: &&Region| (region.name.clone(), region.column());
        let regions = beside.iter().map(column).map(|(name, column)| (name, column, f64::INFINITY));
        let all: Vec<(String, Solid, f64)> = blocks.chain(others).chain(regions).collect();
        let top = all.iter().map(|(.., top)| *top).fold(0.0, f64::max);
        let bodies = all.into_iter().map(|(name, solid, _)| (name, solid)).collect();
        let (plate, blade) = (task.plate(), tool.blade().unwrap_or_default());
        Self { task, plate, blade, bodies, beside: hand.iter().map(column).collect(), top }
    }

    /// Returns the reason why a lever-up cannot be made; `None` if it can.
    pub fn fault(&self, lever: &LeverUp) -> Option<LeverFault> {
        let plate = &self.plate;
        let corners = plate.corners();
        let from = corners[lever.place.edge];
        let side = corners[(lever.place.edge + 1) % corners.len()] - from;
        let along = lever.place.fraction * side.norm();
        if along.min(side.norm() - along) < LeverRules::CORNER - 1e-9 {
            return Some(LeverFault::NearCorner);
        }
        if self.blade.thickness > plate.clearance + 1e-9 {
            return Some(LeverFault::TooThick);
        }
        if lever.depth > DEEPEST * self.way_below(corners, from + side * lever.place.fraction, side)
        {
            return Some(LeverFault::TooDeep);
        }
        // An axis above the blade would press its tip down.
        let over = (0.0..lever.depth + 1e-3).contains(&lever.pivot);
        if over || ![lever.pivot, lever.angle, lever.depth].iter().all(|v| v.is_finite()) {
            return Some(LeverFault::NoSupport);
        }
        if lever.duration() > LeverUp::LONGEST {
            return Some(LeverFault::TooLong);
        }
        self.way(lever)
    }

    /// Returns the distance below the plate from a point of an edge straight inward, metres.
    fn way_below(&self, corners: &[Vector], from: Vector, side: Vector) -> f64 {
        let inward = perpendicular(side).normalize();
        let sides = (0..corners.len()).map(|k| {
            let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
            let along = b - a;
            let towards = cross(along, inward);
            // Only sides through which the path leaves count.
            if towards < -1e-9 * along.norm() { cross(along, a - from) / towards } else { f64::MAX }
        });
        sides.fold(f64::MAX, f64::min)
    }

    /// Returns the first fault during the approach, the rotation or the retreat.
    fn way(&self, lever: &LeverUp) -> Option<LeverFault> {
        let blade = &self.blade;
        let at = |time: f64| lever.blade_on(&self.plate, blade, time);
        let (lying, end) = (at(0.0), at(lever.turn_time()));
        let shaft = |pose: &Pose3, back: f64| {
            let mut pose = *pose;
            pose.position -= pose.rotation * Vector3::x() * back;
            pose
        };
        let reached = |pose: &Pose3| {
            let grip = pose.point(Vector3::new(-0.5 * blade.length, 0.0, 0.0));
            self.task.robot.reaches(grip.xy())
        };
        if [&lying, &end].iter().any(|pose| !reached(pose) || !reached(&shaft(pose, lever.retreat)))
        {
            return Some(LeverFault::OutOfReach);
        }
        for pose in [&lying, &end] {
            let swept = blade.swept(pose, lever.retreat);
            let fault = self.meets(&swept).or_else(|| self.held(pose, lever.retreat));
            if fault.is_some() {
                return fault;
            }
        }
        let farthest =
            (lever.pivot - lever.depth).abs().max((lever.pivot - lever.depth + blade.length).abs());
        let looks = (lever.angle * farthest / LOOK).ceil().clamp(1.0, 500.0) as usize;
        for k in 1..looks {
            let pose = at(lever.turn_time() * k as f64 / looks as f64);
            if !reached(&pose) {
                return Some(LeverFault::OutOfReach);
            }
            let solid = blade.swept(&pose, 0.0);
            // An arc in front of the blade rises up to a quarter rotation.
            let rises = lever.pivot > 0.0 && lever.angle <= 0.5 * PI;
            if rises && solid.lowest() > self.top {
                break;
            }
            if let Some(fault) = self.meets(&solid).or_else(|| self.held(&pose, 0.0)) {
                return Some(fault);
            }
        }
        None
    }

    /// Returns a fault if the fingers that hold the blade at `pose`, and draw it back by `back`
    /// metres, meet a body.
    fn held(&self, pose: &Pose3, back: f64) -> Option<LeverFault> {
        self.task.robot.hand?;
        let fingers = self.blade.fingers(pose, back);
        let mut all = self.bodies.iter().chain(&self.beside);
        let met = all.find(|(_, solid)| solid.depth(&fingers) > SLACK)?;
        Some(LeverFault::HandMeets { body: met.0.clone() })
    }

    fn meets(&self, blade: &Solid) -> Option<LeverFault> {
        if blade.lowest() < -SLACK {
            return Some(LeverFault::BelowTable);
        }
        let met = self.bodies.iter().find(|(_, solid)| solid.depth(blade) > SLACK)?;
        Some(LeverFault::Meets { body: met.0.clone() })
    }
}
