//! Legs of a plan's travel: from home, between steps, through home at a change of tools, and back.

use std::sync::Arc;

use crate::geometry::{Vector, Vector3};
use crate::scene::{Plate, Scene, State, Tool};
use crate::task::{Plan, PushForm, Step, Task, ToolMotion};

use super::detour::{ReachablePositions, Resolution, home};
use super::space::{Space, is_open};

/// Travel of a lifted tool at the travel height of its robot.
#[derive(Clone, Debug, PartialEq)]
pub struct TravelLeg {
    /// Index of the step after which it begins; `None` for home.
    pub from: Option<usize>,
    /// Index of the step to which it leads; `None` for home.
    pub to: Option<usize>,
    /// Name of the tool.
    pub tool: String,
    /// Rotations of the end effector while it is lifted, and on the path, radians. It rotates at
    /// the start of the path.
    pub yaws: [f64; 2],
    /// Positions of the end effector: start, corners and end, metres.
    pub path: Vec<Vector>,
    /// Name of the body around which it leads, if it is not straight.
    pub around: Option<String>,
}

impl TravelLeg {
    /// Returns the length of its path, metres.
    pub fn length(&self) -> f64 {
        self.path.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
    }
}

/// A leg for which there is no path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BlockedLeg {
    /// Index of the step after which it begins; `None` for home.
    pub from: Option<usize>,
    /// Index of the step to which it leads; `None` for home.
    pub to: Option<usize>,
    /// Name of the first body on the straight path.
    pub obstacle: String,
}

/// Positions of the end effector at which a step begins and ends, with its tool.
struct Stance<'a> {
    tool: &'a Arc<Tool>,
    /// Rotations of the end effector at the start and at the end, radians.
    yaws: [f64; 2],
    start: Vector,
    end: Vector,
}

/// End of a leg: home, or a step and the position of the end effector there.
type End = Option<(usize, Vector)>;

impl<'a> Stance<'a> {
    /// Creates the stance of a step; `None` if its tool is not among `tools`.
    fn of(scene: &Scene, tools: &'a [Arc<Tool>], step: &Step) -> Option<Self> {
        let tool = tools.iter().find(|tool| tool.name == step.tool())?;
        match step {
            Step::Push(step) => {
                let pushes = [step.push];
                let motion =
                    ToolMotion::pushes(Arc::clone(tool), step.lift, step.grip_yaw, &pushes, true);
                let back = motion.retreat(scene, 0);
                let end = back.map_or(step.push.end(), |back| (back.to * tool.grip).position);
                Some(Self { tool, yaws: [step.grip_yaw; 2], start: step.push.start, end })
            }
            Step::LeverUp(step) => {
                let (mut plate, blade) = (Plate::of(scene, step.lever.plate), tool.blade()?);
                plate.pose = step.expected.unwrap_or(plate.pose);
                let at = |time: f64, back: f64| {
                    let pose = step.lever.blade_on(&plate, &blade, time);
                    let grip = pose.point(Vector3::new(-0.5 * blade.length - back, 0.0, 0.0));
                    let ahead = pose.rotation * Vector3::x();
                    (grip.xy(), ahead.y.atan2(ahead.x))
                };
                let (start, first) = at(0.0, step.lever.retreat);
                let (end, last) = at(step.lever.duration(), 0.0);
                Some(Self { tool, yaws: [first, last], start, end })
            }
        }
    }
}

impl Task {
    /// Returns the maximum number of changes to another tool in a plan: 0 with an arm, because the
    /// task does not state where an arm fetches tools.
    pub fn tool_changes(&self) -> usize {
        let stated = self.pushes.tool_changes.unwrap_or(usize::MAX);
        if self.arm.is_some() { 0 } else { stated }
    }

    /// Returns the travel of the lifted tools of a plan, in order; the robot begins and ends at
    /// home, and changes tools there. `states` are the states before the first step and after each
    /// step, as far as they are known.
    ///
    /// An arm has its own joint motions between steps, so that the result is then empty.
    ///
    /// # Errors
    /// Returns the first leg for which there is no path.
    pub fn legs(
        &self,
        scene: &Scene,
        tools: &[Arc<Tool>],
        plan: &Plan,
        states: &[State],
    ) -> Result<Vec<TravelLeg>, BlockedLeg> {
        let stances = plan.steps.iter().map(|step| Stance::of(scene, tools, step));
        let stances: Option<Vec<Stance>> = stances.collect();
        let (Some(stances), None) = (stances, &self.arm) else { return Ok(Vec::new()) };
        let mut legs = Vec::new();
        for k in 0..=stances.len() {
            let before = k.checked_sub(1).and_then(|k| stances.get(k));
            let next = stances.get(k);
            if !self.is_lifted(plan, k) {
                continue;
            }
            let state = states.get(k).or(states.last());
            let state = state.cloned().unwrap_or_else(|| scene.start());
            let travel = Travel { task: self, scene, state: &state, step: k };
            travel.add(&mut legs, before, next)?;
        }
        Ok(legs)
    }

    /// Returns `true` if the tool is lifted before step `k` of a plan.
    fn is_lifted(&self, plan: &Plan, k: usize) -> bool {
        let before = k.checked_sub(1).and_then(|k| plan.steps.get(k));
        match (before, plan.steps.get(k)) {
            // The first chained push begins at home, where the tool is lowered.
            (None, Some(Step::Push(step))) => step.form == PushForm::Placed,
            (Some(Step::Push(_)), Some(Step::Push(step))) => step.form == PushForm::Placed,
            (None, None) => false,
            _ => true,
        }
    }

    /// Returns the positions to which `tool`, held at `yaw` (radians), can travel from home, by a
    /// rough test that errs on the free side. Without a `state` no object obstructs the tool.
    ///
    /// Returns `None` if only the robot's own column is higher than the travel height.
    pub fn places<'a>(
        &'a self,
        scene: &'a Scene,
        state: Option<&State>,
        (tool, yaw): (&Tool, f64),
    ) -> Option<ReachablePositions<'a>> {
        if self.arm.is_some() || is_open(self, scene) {
            return None;
        }
        let space = || Space::new(self, (scene, state), tool, yaw);
        Some(ReachablePositions::from_home(space(), || space().of_hand(), Resolution::ROUGH))
    }
}

/// Travel before a step, with the objects in one state.
struct Travel<'a> {
    task: &'a Task,
    scene: &'a Scene,
    state: &'a State,
    step: usize,
}

impl Travel<'_> {
    fn space(&self, tool: &Tool, yaw: f64) -> Space<'_> {
        Space::new(self.task, (self.scene, Some(self.state)), tool, yaw)
    }

    /// Appends the legs from the end of a step to the start of the next. A tool that changes, or
    /// cannot rotate to its next yaw, goes by way of home.
    fn add(
        &self,
        legs: &mut Vec<TravelLeg>,
        before: Option<&Stance>,
        next: Option<&Stance>,
    ) -> Result<(), BlockedLeg> {
        let last = before.map(|before| (self.step - 1, before.end));
        let first = next.map(|next| (self.step, next.start));
        if let (Some(before), Some(next)) = (before, next)
            && before.tool.name == next.tool.name
        {
            let [from, to] = [before.yaws[1], next.yaws[0]];
            if from == to || self.space(next.tool, to).turns(before.end, from) {
                legs.push(self.leg((next.tool, [from, to]), [last, first])?);
                return Ok(());
            }
        }
        if let Some(before) = before {
            legs.push(self.leg((before.tool, [before.yaws[1]; 2]), [last, None])?);
        }
        if let Some(next) = next {
            legs.push(self.leg((next.tool, [next.yaws[0]; 2]), [None, first])?);
        }
        Ok(())
    }

    fn leg(
        &self,
        (tool, yaws): (&Tool, [f64; 2]),
        ends: [End; 2],
    ) -> Result<TravelLeg, BlockedLeg> {
        let space = self.space(tool, yaws[1]);
        let [from, to] = ends.map(|end| end.map(|(step, _)| step));
        let at = |home: Vector| ends.map(|end| end.map_or(home, |(_, position)| position));
        let leg = |path, around: Option<&str>| TravelLeg {
            from,
            to,
            tool: tool.name.clone(),
            yaws,
            path,
            around: around.map(str::to_owned),
        };
        let straight = at(home(&self.task.robot));
        if space.met(straight).is_none() {
            return Ok(leg(straight.to_vec(), None));
        }
        let mut met = None;
        for resolution in Resolution::PATHS {
            let space = || self.space(tool, yaws[1]);
            let places = ReachablePositions::from_home(space(), || space().of_hand(), resolution);
            match places.path(at(places.home())) {
                Ok((path, around)) => return Ok(leg(path, around)),
                Err(what) => met = Some(what.to_owned()),
            }
        }
        Err(BlockedLeg { from, to, obstacle: met.unwrap_or_default() })
    }
}
