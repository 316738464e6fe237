//! A plan: steps in order, each complete in itself.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::geometry::Pose;

use super::{LeverMotion, LeverUp, Motion, Push, PushForm, Stroke, ToolMotion};
use crate::scene::Tool;

/// A push with the tool that makes it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PushStep {
    /// Name of the tool.
    pub tool: String,
    /// Turn of the end effector about z against world +x, radians.
    pub grip_yaw: f64,
    /// Whether the tool comes from above, or goes on where the last push ended.
    pub form: PushForm,
    /// Height of the tool's underside above the table, metres.
    pub lift: f64,
    /// What the end effector does.
    #[serde(flatten)]
    pub push: Push,
}

impl PushStep {
    /// Whether the tool is already in the hand after `other`.
    fn goes_on(&self, other: &Self) -> bool {
        let turned = self.form == PushForm::Chained && self.grip_yaw != other.grip_yaw;
        self.tool == other.tool && self.form == other.form && self.lift == other.lift && !turned
    }
}

/// A lever-up with the tool that makes it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverStep {
    /// Name of the tool.
    pub tool: String,
    /// What the blade does.
    #[serde(flatten)]
    pub lever: LeverUp,
    /// Where the object is expected by then, if earlier steps have moved it: the blade goes there
    /// without looking. Else it is where the scene has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expected: Option<Pose>,
}

/// One step of a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Step {
    /// A push.
    Push(PushStep),
    /// A lever-up.
    LeverUp(LeverStep),
}

impl Step {
    /// Name of its tool.
    pub fn tool(&self) -> &str {
        match self {
            Step::Push(step) => &step.tool,
            Step::LeverUp(step) => &step.tool,
        }
    }
}

/// What to do, step by step; nothing at all is a plan too.
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
    /// In order.
    pub steps: Vec<Step>,
}

impl Plan {
    /// These pushes with one tool, held in one way.
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

    /// One lever-up of an object where the scene has it.
    pub fn levering(tool: impl Into<String>, lever: LeverUp) -> Self {
        let step = LeverStep { tool: tool.into(), lever, expected: None };
        Self { steps: vec![Step::LeverUp(step)] }
    }

    /// The plan followed by another one.
    #[must_use]
    pub fn then(mut self, other: Self) -> Self {
        self.steps.extend(other.steps);
        self
    }

    /// Its first `count` steps.
    #[must_use]
    pub fn first(&self, count: usize) -> Self {
        Self { steps: self.steps[..count.min(self.steps.len())].to_vec() }
    }

    /// Whether there is nothing to do.
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// The steps that push.
    pub fn push_steps(&self) -> impl Iterator<Item = &PushStep> {
        self.steps.iter().filter_map(|step| match step {
            Step::Push(step) => Some(step),
            Step::LeverUp(_) => None,
        })
    }

    /// The steps that lever.
    pub fn lever_steps(&self) -> impl Iterator<Item = &LeverStep> {
        self.steps.iter().filter_map(|step| match step {
            Step::Push(_) => None,
            Step::LeverUp(step) => Some(step),
        })
    }

    /// All pushes, whichever tool makes them.
    pub fn pushes(&self) -> Vec<Push> {
        self.push_steps().map(|step| step.push).collect()
    }

    /// Whether it levers anything.
    pub fn levers(&self) -> bool {
        self.lever_steps().next().is_some()
    }

    /// Name of the first tool; of a plan without steps empty.
    pub fn tool(&self) -> &str {
        self.steps.first().map_or("", Step::tool)
    }

    /// Turn of the end effector in the first push, radians.
    pub fn grip_yaw(&self) -> f64 {
        self.push_steps().next().map_or(0.0, |step| step.grip_yaw)
    }

    /// How the first push starts.
    pub fn form(&self) -> PushForm {
        self.push_steps().next().map_or(PushForm::Placed, |step| step.form)
    }

    /// Height of the tool's underside above the table in the first push, metres.
    pub fn lift(&self) -> f64 {
        self.push_steps().next().map_or(0.0, |step| step.lift)
    }

    /// Names of its tools, each once, in the order in which they are used.
    pub fn tools(&self) -> Vec<&str> {
        let mut tools: Vec<&str> = Vec::new();
        for tool in self.steps.iter().map(Step::tool) {
            if !tools.contains(&tool) {
                tools.push(tool);
            }
        }
        tools
    }

    /// What the tool does when all pushes of the plan are made with `tool`, the one that they name.
    pub fn motion(&self, tool: &Arc<Tool>) -> ToolMotion {
        let steps: Vec<&PushStep> = self.push_steps().collect();
        run(tool, &steps)
    }

    /// What its tools do where nothing is levered, one motion for pushes in a row with one tool; where
    /// nothing is done the first tool stands still. None where one of its tools is not among `tools`, or has
    /// a blade.
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

    /// What its tools do, one motion for each lever-up and for pushes in a row with one tool. None
    /// where one of its tools is not among `tools`, or a lever-up has one without a blade.
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

/// Pushes in a row with one tool.
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
