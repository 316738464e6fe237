//! A plan: a sequence of steps, each complete in itself.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::geometry::Pose;

use super::{LeverMotion, LeverUp, Motion, Push, PushForm, Stroke, ToolMotion};
use crate::scene::Tool;

/// A push with its tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PushStep {
    /// Name of the tool.
    pub tool: String,
    /// Rotation of the end effector about z against world +x, radians.
    pub grip_yaw: f64,
    /// Start of the push: from above, or at the end of the previous push.
    pub form: PushForm,
    /// Height of the tool's underside above the table, metres.
    pub lift: f64,
    /// Motion of the end effector.
    #[serde(flatten)]
    pub push: Push,
}

impl PushStep {
    /// Returns `true` if the tool is already in the hand after `other`.
    fn goes_on(&self, other: &Self) -> bool {
        let turned = self.form == PushForm::Chained && self.grip_yaw != other.grip_yaw;
        self.tool == other.tool && self.form == other.form && self.lift == other.lift && !turned
    }
}

/// A lever-up with its tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverStep {
    /// Name of the tool.
    pub tool: String,
    /// Motion of the blade.
    #[serde(flatten)]
    pub lever: LeverUp,
    /// Expected pose of the object after earlier steps, to which the blade goes without
    /// observation; `None` for its pose in the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expected: Option<Pose>,
}

/// A step of a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Step {
    /// A push.
    Push(PushStep),
    /// A lever-up.
    LeverUp(LeverStep),
}

impl Step {
    /// Returns the name of its tool.
    pub fn tool(&self) -> &str {
        match self {
            Step::Push(step) => &step.tool,
            Step::LeverUp(step) => &step.tool,
        }
    }
}

/// The steps of a plan, in order; a plan without steps is valid.
///
/// ```
/// use pushplan::{Plan, Push, PushForm, Step, Vector};
///
/// let push = Push { start: Vector::new(0.4, 0.0), direction: 0.0, length: 0.2, speed: 0.1 };
/// let plan = Plan::pushing("stick", 0.0, PushForm::Placed, 0.002, [push, push]);
/// assert!(plan.steps.iter().all(|step| matches!(step, Step::Push(_)) && step.tool() == "stick"));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// Steps, in order.
    pub steps: Vec<Step>,
}

impl Plan {
    /// Creates pushes with one tool and one grip.
    pub fn pushing(
        tool: impl Into<String>,
        grip_yaw: f64,
        form: PushForm,
        lift: f64,
        pushes: impl IntoIterator<Item = Push>,
    ) -> Self {
        let tool = tool.into();
        let step = |push| Step::Push(PushStep { tool: tool.clone(), grip_yaw, form, lift, push });
        Self { steps: pushes.into_iter().map(step).collect() }
    }

    /// Creates a single lever-up of an object at its pose in the scene.
    pub fn levering(tool: impl Into<String>, lever: LeverUp) -> Self {
        let step = LeverStep { tool: tool.into(), lever, expected: None };
        Self { steps: vec![Step::LeverUp(step)] }
    }

    /// Appends another plan.
    #[must_use]
    pub fn then(mut self, other: Self) -> Self {
        self.steps.extend(other.steps);
        self
    }

    /// Returns its first `count` steps.
    #[must_use]
    pub fn first(&self, count: usize) -> Self {
        Self { steps: self.steps[..count.min(self.steps.len())].to_vec() }
    }

    /// Returns `true` if it has no steps.
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// Returns the steps that push.
    pub fn push_steps(&self) -> impl Iterator<Item = &PushStep> {
        self.steps.iter().filter_map(|step| match step {
            Step::Push(step) => Some(step),
            Step::LeverUp(_) => None,
        })
    }

    /// Returns the steps that lever.
    pub fn lever_steps(&self) -> impl Iterator<Item = &LeverStep> {
        self.steps.iter().filter_map(|step| match step {
            Step::Push(_) => None,
            Step::LeverUp(step) => Some(step),
        })
    }

    /// Returns all pushes of all tools.
    pub fn pushes(&self) -> Vec<Push> {
        self.push_steps().map(|step| step.push).collect()
    }

    /// Returns `true` if it levers anything.
    pub fn levers(&self) -> bool {
        self.lever_steps().next().is_some()
    }

    /// Returns the name of the first tool; empty for a plan without steps.
    pub fn tool(&self) -> &str {
        self.steps.first().map_or("", Step::tool)
    }

    /// Returns the rotation of the end effector in the first push, radians.
    pub fn grip_yaw(&self) -> f64 {
        self.push_steps().next().map_or(0.0, |step| step.grip_yaw)
    }

    /// Returns the start of the first push.
    pub fn form(&self) -> PushForm {
        self.push_steps().next().map_or(PushForm::Placed, |step| step.form)
    }

    /// Returns the height of the tool's underside above the table in the first push, metres.
    pub fn lift(&self) -> f64 {
        self.push_steps().next().map_or(0.0, |step| step.lift)
    }

    /// Returns the names of its tools, each once, in the order of their use.
    pub fn tools(&self) -> Vec<&str> {
        let mut tools: Vec<&str> = Vec::new();
        for tool in self.steps.iter().map(Step::tool) {
            if !tools.contains(&tool) {
                tools.push(tool);
            }
        }
        tools
    }

    /// Returns the motion of `tool` when all pushes of the plan are made with it.
    pub fn motion(&self, tool: &Arc<Tool>) -> ToolMotion {
        let steps: Vec<&PushStep> = self.push_steps().collect();
        run(tool, &steps)
    }

    /// Returns the motions of its tools, one for consecutive pushes with one tool. A plan without
    /// steps gives a motion without strokes of the first tool.
    ///
    /// Returns `None` if the plan levers, if a tool is not among `tools`, or if a tool that pushes
    /// has a blade.
    pub fn slides(&self, tools: &[Arc<Tool>]) -> Option<Vec<ToolMotion>> {
        if self.is_empty() {
            return Some(vec![run(tools.first()?, &[])]);
        }
        let slide = |motion| match motion {
            Motion::Slide(motion) if motion.tool.pushes() => Some(motion),
            _ => None,
        };
        self.motions(tools)?.into_iter().map(slide).collect()
    }

    /// Returns the motions of its tools, one for each lever-up and one for consecutive pushes with
    /// one tool. Returns `None` if a tool is not among `tools`, or if a lever-up has a tool without
    /// a blade.
    pub fn motions(&self, tools: &[Arc<Tool>]) -> Option<Vec<Motion>> {
        let find = |name: &str| tools.iter().find(|tool| tool.name == name);
        let (mut motions, mut left) = (Vec::new(), &self.steps[..]);
        while let Some(step) = left.first() {
            let tool = find(step.tool())?;
            match step {
                Step::LeverUp(step) => {
                    tool.blade()?;
                    let (tool, expected) = (Arc::clone(tool), step.expected);
                    motions.push(Motion::Lever(LeverMotion::new(tool, step.lever, expected)));
                    left = &left[1..];
                }
                Step::Push(first) => {
                    let row = left.iter().map_while(|step| match step {
                        Step::Push(step) if step.goes_on(first) => Some(step),
                        _ => None,
                    });
                    let row: Vec<&PushStep> = row.collect();
                    motions.push(Motion::Slide(run(tool, &row)));
                    left = &left[row.len()..];
                }
            }
        }
        Some(motions)
    }
}

/// Returns the motion of consecutive pushes with one tool.
fn run(tool: &Arc<Tool>, steps: &[&PushStep]) -> ToolMotion {
    let lift = steps.first().map_or(0.0, |step| step.lift);
    let stroke = |(k, step): (usize, &&PushStep)| {
        let settle = step.form == PushForm::Placed || k + 1 == steps.len();
        Stroke::push(tool, step.grip_yaw, &step.push, settle)
    };
    let strokes = steps.iter().enumerate().map(stroke).collect();
    ToolMotion { tool: Arc::clone(tool), lift, strokes }
}

#[cfg(test)]
mod tests;
