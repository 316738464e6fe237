//! Conversion of a plan of pushes to a joint trajectory.
//!
//! Every push consists of straight lines of the flange: down, along the push, back by the tool's
//! retreat, and up. Between pushes the joints move without collisions, see `free`.
//!
//! The start configuration of a push is searched for near the current one first, then everywhere;
//! the first from which the whole push is feasible is used. After the last push the arm returns
//! home, the start of the next plan, if possible.

use std::sync::Arc;

use super::hull::PlacedHull;
use super::model::Arm;
use pushplan::geometry::Pose3;
use pushplan::scene::{ArmFault, JointTrajectory, Scene, State, Tool};
use pushplan::task::{Followed, Plan, PushForm, PushStep, Stroke, Task};

use super::free::{first_turn, way};
use super::inverse::postures;
use super::kinematics::{frames, level};
use super::path::{flange_at, line, unwound};
use super::room::Room;
use super::timing::Pieces;

/// Minimum height by which a tool is lifted, metres, if the arm cannot reach the travel height of
/// the task. The tool then goes around taller bodies.
const LEAST: f64 = 0.01;

/// Maximum number of start configurations tried for a push.
const POSTURES: usize = 10;

/// Maximum number of start configurations to which a path is searched for.
const SEARCHES: usize = 3;

/// Computes the joint trajectory with which `arm` executes the pushes of a plan. `states` are the
/// states before the first push and after each, as far as they are known.
///
/// # Errors
/// Returns the first push that the arm cannot execute, and the reason.
pub fn follow(
    task: &Task,
    (arm, scene): (&Arm, &Scene),
    tool: &Arc<Tool>,
    plan: &Plan,
    states: &[State],
) -> Followed {
    let room = Room::new(arm, scene, Some(tool));
    let motion = plan.motion(tool);
    let mount = arm.flange_of_tool();
    let mut pieces = Pieces::new(arm);
    let mut pushes = Vec::new();
    let steps: Vec<&PushStep> = plan.push_steps().collect();
    for (k, (step, stroke)) in steps.iter().zip(&motion.strokes).enumerate() {
        let at = |pose: &pushplan::geometry::Pose, height: f64| {
            Pose3::upright(*pose * tool.grip, height) * mount
        };
        let state = |k: usize| states.get(k).or(states.last());
        let objects = |k: usize| state(k).map(|state| room.objects(state)).unwrap_or_default();
        let push = Push {
            room: &room,
            set_down: step.form == PushForm::Placed || k == 0,
            ends: [at(&stroke.from, step.lift), at(&stroke.to, step.lift)],
            back: motion.retreat(scene, k).map(|back: Stroke| at(&back.to, step.lift)),
            rise: (task.robot.travel - step.lift).max(0.0),
            before: objects(k),
            after: objects(k + 1),
        };
        let made = push.make(&mut pieces, step).map_err(|fault| (k, fault))?;
        pushes.push(made);
    }
    if motion.strokes.last().is_some_and(|stroke| stroke.settle) {
        let last = states.get(steps.len()).or(states.last());
        let objects = last.map(|state| room.objects(state)).unwrap_or_default();
        let home = way(&room, [pieces.now(), &arm.home], &objects, true).unwrap_or_default();
        for through in &home {
            pieces.swing(through).map_err(|fault| (steps.len().saturating_sub(1), fault))?;
        }
    }
    let joints = arm.joints.iter().map(|joint| joint.name.clone()).collect();
    Ok(JointTrajectory { joints, points: pieces.points, pushes })
}

struct Push<'a> {
    room: &'a Room<'a>,
    /// Whether the tool is lowered from above.
    set_down: bool,
    ends: [Pose3; 2],
    /// Pose of the retreat before lifting, if the tool is lifted.
    back: Option<Pose3>,
    /// Lifting height, metres.
    rise: f64,
    before: Vec<(&'a str, PlacedHull)>,
    after: Vec<(&'a str, PlacedHull)>,
}

/// Lines of a push as joint positions.
struct Lines {
    /// Descent to the start of the push.
    down: Vec<Vec<f64>>,
    /// Joint motion to the start of the descent.
    way: Vec<Vec<f64>>,
    push: Vec<Vec<f64>>,
    back: Vec<Vec<f64>>,
    up: Vec<Vec<f64>>,
}

impl Push<'_> {
    /// Appends the push and returns the indices of its first and last point.
    fn make(&self, pieces: &mut Pieces, step: &PushStep) -> Result<[usize; 2], ArmFault> {
        let arm = self.room.arm;
        let now = pieces.now().to_vec();
        let lines = match self.set_down {
            true => self.begun(&now)?,
            false => self.lines(&now, &now, false)?,
        };
        for through in &lines.way {
            pieces.swing(through)?;
        }
        let length = |a: &Pose3, b: &Pose3| (b.position - a.position).norm();
        let ends = |line: &[Vec<f64>]| match (line.first(), line.last()) {
            (Some(a), Some(b)) => length(&flange_at(arm, a), &flange_at(arm, b)),
            _ => 0.0,
        };
        pieces.gently(&lines.down, ends(&lines.down))?;
        let begin = pieces.points.len() - 1;
        pieces.push(&lines.push, length(&self.ends[0], &self.ends[1]), step.push.speed)?;
        let end = pieces.points.len() - 1;
        pieces.gently(&lines.back, ends(&lines.back))?;
        pieces.gently(&lines.up, ends(&lines.up))?;
        Ok([begin, end])
    }

    /// Computes the lines from a feasible start configuration.
    fn begun(&self, now: &[f64]) -> Result<Lines, ArmFault> {
        let arm = self.room.arm;
        let seeds = [now.to_vec(), facing(arm, &arm.home, &self.ends[0])];
        let mut fault = None;
        let mut tried: Vec<Vec<f64>> = Vec::new();
        let mut blocked = Vec::new();
        // Configurations near the current one usually suffice.
        for all in [false, true] {
            let found = match all {
                false => super::inverse::near(arm, &self.ends[0], &seeds),
                true => postures(arm, &self.ends[0], &seeds),
            };
            for posture in found.into_iter().take(POSTURES) {
                let posture = unwound(arm, &posture, now);
                if tried.contains(&posture) {
                    continue;
                }
                match self.lines(&posture, now, false) {
                    Ok(lines) => return Ok(lines),
                    Err(found) => {
                        if let ArmFault::NoWay { .. } = found {
                            blocked.push(posture.clone());
                        }
                        fault = fault.or(Some(found));
                    }
                }
                tried.push(posture);
            }
        }
        // A search takes much longer than a check of simple paths.
        for posture in blocked.iter().take(SEARCHES) {
            if let Ok(lines) = self.lines(posture, now, true) {
                return Ok(lines);
            }
        }
        Err(fault.unwrap_or(ArmFault::Unreachable))
    }

    /// Computes the lines from the given start configuration, with a search for the way to it only
    /// if asked for.
    fn lines(&self, posture: &[f64], now: &[f64], search: bool) -> Result<Lines, ArmFault> {
        let arm = self.room.arm;
        let (push, fault) = line(arm, [&self.ends[0], &self.ends[1]], posture);
        fault.map_or(Ok(()), Err)?;
        let half = push.len() / 2;
        self.clear(&push[..=half], &self.before)?;
        self.clear(&push[half..], &self.after)?;
        let last = push.last().cloned().unwrap_or_default();
        let mut lines =
            Lines { down: Vec::new(), way: Vec::new(), push, back: Vec::new(), up: Vec::new() };
        if self.set_down {
            let mut up = self.risen(&self.ends[0], posture, &self.before)?;
            up.reverse();
            lines.way = way(self.room, [now, &up[0]], &self.before, search)?;
            lines.down = up;
        }
        if let Some(back) = &self.back {
            let (points, fault) = line(arm, [&self.ends[1], back], &last);
            fault.map_or(Ok(()), Err)?;
            let from = points.last().cloned().unwrap_or(last);
            lines.back = points;
            lines.up = self.risen(back, &from, &self.after)?;
        }
        Ok(lines)
    }

    /// Computes a vertical line upwards, as far as reachable. An arm whose joints all move
    /// horizontally stays where it is.
    fn risen(
        &self,
        from: &Pose3,
        posture: &[f64],
        objects: &[(&str, PlacedHull)],
    ) -> Result<Vec<Vec<f64>>, ArmFault> {
        let arm = self.room.arm;
        if level(arm, &frames(arm, posture), 0.0).is_some() {
            return Ok(vec![posture.to_vec()]);
        }
        let mut to = *from;
        to.position.z += self.rise.max(LEAST);
        let (points, fault) = line(self.room.arm, [from, &to], posture);
        let reached = points
            .last()
            .map_or(0.0, |last| flange_at(self.room.arm, last).position.z - from.position.z);
        if let Some(fault) = fault.filter(|_| reached < LEAST) {
            return Err(fault);
        }
        self.clear(&points, objects)?;
        Ok(points)
    }

    /// Checks that the arm without its tool is collision-free.
    fn clear(&self, points: &[Vec<f64>], objects: &[(&str, PlacedHull)]) -> Result<(), ArmFault> {
        for point in points {
            if let Some(between) = self.room.met(&self.room.stance(point), objects, None) {
                return Err(ArmFault::Collides { between });
            }
        }
        Ok(())
    }
}

/// Returns a configuration with the first joint rotated so that the flange faces a target.
fn facing(arm: &Arm, posture: &[f64], target: &Pose3) -> Vec<f64> {
    let mut turned = posture.to_vec();
    let from = |pose: &Pose3| pose.position - arm.base.position;
    let angle = |pose: &Pose3| from(pose).y.atan2(from(pose).x);
    turned[first_turn(arm)] +=
        pushplan::geometry::wrap_angle(angle(target) - angle(&flange_at(arm, posture)));
    turned
}
