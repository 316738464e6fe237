//! Plan files.

use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::asset::diagnostic::Faults;
use crate::asset::read_text;
use crate::asset::table_fit::Whole;
use crate::{
    outcome::{Outcome, Verdict},
    scene::{JointTrajectory, ModelSpec, TableFit, Tool},
    task::{Plan, Task},
};

use super::read::{self, Opened};
use super::{PLAN_FILE, PLAN_VERSION, emit};

/// Plan with everything needed to execute it, and with its predicted and verified outcome.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanFile {
    /// Task that the plan solves.
    pub task: Task,
    /// Tools that the plan uses, each once.
    pub tools: Vec<Arc<Tool>>,
    /// Steps of the plan.
    pub plan: Plan,
    /// Effect model that predicted the outcome.
    pub model: Option<ModelSpec>,
    /// Table fit used by that model.
    pub fit: Option<TableFit>,
    /// Outcome predicted by that model.
    pub predicted: Option<Outcome>,
    /// Verdict of the simulation.
    pub verdict: Option<Verdict>,
    /// Joint trajectory of the task's arm.
    pub joints: Option<JointTrajectory>,
}

impl PlanFile {
    /// Creates a plan file without prediction and verdict.
    pub fn new(task: Task, tools: Vec<Arc<Tool>>, plan: Plan) -> Self {
        Self {
            task,
            tools,
            plan,
            model: None,
            fit: None,
            predicted: None,
            verdict: None,
            joints: None,
        }
    }

    /// Reads a plan file.
    ///
    /// # Errors
    /// Returns all faults of the file, each with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let (file, text) = read_text(path.as_ref())?;
        Self::parse(&text, &file)
    }

    /// Parses the text of a plan file; `file` is its name in faults.
    ///
    /// # Errors
    /// Returns all faults of the text, each with its place.
    pub fn parse(text: &str, file: &str) -> Result<Self, Faults> {
        let text = &without_earlier_ends(text);
        let mut opened = Opened::new(file, text, &PLAN_FILE)?;
        opened.ledger.sound()?;
        let own: Own = opened.typed()?;
        opened.check_plan(&own.plan);
        if let Some(outcome) = &own.predicted {
            let node = opened.root.get("predicted").cloned();
            opened.check_outcome(node.as_ref(), outcome);
        }
        if let Some(verdict) = &own.verdict {
            let replays = opened.root.get("verdict").and_then(|v| v.get("evidence")).cloned();
            let nodes = replays.iter().flat_map(|list| list.items());
            for (node, evidence) in nodes.zip(&verdict.evidence) {
                opened.check_outcome(node.get("outcome"), &evidence.outcome);
            }
        }
        opened.check_joints(own.joints.as_ref());
        let fit = own.fit.filter(|value| !value.is_null());
        let fit = fit.map(|value| TableFit::parse(&value.to_string(), file)).transpose()?;
        let tools = opened.tools;
        let file = opened.task.map(|task| Self {
            task,
            tools,
            plan: own.plan,
            model: own.model,
            fit,
            predicted: own.predicted,
            verdict: own.verdict,
            joints: own.joints,
        });
        opened.ledger.finish(file)
    }

    /// Writes the file; a partial file is never left behind.
    ///
    /// # Errors
    /// Returns an error if the path cannot be written, or the content could not be read back, for
    /// example because a number is not finite.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Faults> {
        read::write(path.as_ref(), self, Self::parse)
    }
}

/// Keys deserialised with serde; the strict check has already read the others.
#[derive(Deserialize)]
struct Own {
    plan: Plan,
    model: Option<ModelSpec>,
    fit: Option<serde_json::Value>,
    predicted: Option<Outcome>,
    verdict: Option<Verdict>,
    joints: Option<JointTrajectory>,
}

impl Serialize for PlanFile {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Written<'a> {
            schema_version: u32,
            kind: &'static str,
            plan: &'a Plan,
            model: &'a Option<ModelSpec>,
            #[serde(skip_serializing_if = "Option::is_none")]
            fit: Option<Whole>,
            predicted: &'a Option<Outcome>,
            verdict: &'a Option<Verdict>,
            #[serde(skip_serializing_if = "Option::is_none")]
            joints: &'a Option<JointTrajectory>,
            tools: Vec<serde_json::Value>,
            task: serde_json::Value,
        }
        Written {
            schema_version: PLAN_VERSION,
            kind: "plan",
            plan: &self.plan,
            model: &self.model,
            fit: self.fit.as_ref().map(Whole::of),
            predicted: &self.predicted,
            verdict: &self.verdict,
            joints: &self.joints,
            tools: self.tools.iter().map(|tool| emit::tool(tool)).collect(),
            task: emit::task(&self.task),
        }
        .serialize(serializer)
    }
}

/// Removes the prediction and the verdict of a plan file in the earlier form, which stated the
/// error of a single goal; `verify` recomputes them. Blanks replace the removed text, so that other
/// positions stay valid.
fn without_earlier_ends(text: &str) -> Cow<'_, str> {
    let is_end =
        |rest: &str| ["\"predicted\"", "\"verdict\""].iter().any(|key| rest.starts_with(key));
    if text.contains("\"goals\"") || !text.char_indices().any(|(at, _)| is_end(&text[at..])) {
        return text.into();
    }
    let mut kept = String::with_capacity(text.len());
    let (mut depth, mut quoted, mut escaped, mut blank) = (0usize, false, false, false);
    // Position of the last comma between two top-level keys, until the next key starts.
    let mut comma: Option<usize> = None;
    for (at, c) in text.char_indices() {
        match c {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => {
                // The first key of the file is its kind, so every other key follows a comma.
                if let Some(at) = comma.filter(|_| !quoted && is_end(&text[at..])) {
                    blank = true;
                    kept.replace_range(at..=at, " ");
                }
                comma = None;
                quoted = !quoted;
            }
            _ if quoted => {}
            '{' | '[' => depth += 1,
            '}' | ']' => {
                depth = depth.saturating_sub(1);
                blank &= depth > 0;
            }
            ',' if depth == 1 => (blank, comma) = (false, Some(kept.len())),
            _ => {}
        }
        kept.push(if blank && !c.is_whitespace() { ' ' } else { c });
    }
    kept.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn omitted_keys_leave_other_keys_in_place() {
        let text = "{\"kind\": \"plan\",\n\"predicted\": {\"a\\\"}\": [1, 2]},\n \
                    \"plan\": {\"verdict\": 3},\n\"verdict\": \"ä,\"}";
        let kept = without_earlier_ends(text);
        let found: serde_json::Value = serde_json::from_str(&kept).expect("it is JSON as before");
        assert_eq!(found, serde_json::json!({"kind": "plan", "plan": {"verdict": 3}}));
        let places = |text: &str| text.lines().map(|line| line.chars().count()).collect::<Vec<_>>();
        assert_eq!(places(&kept), places(text));
        assert_eq!(
            without_earlier_ends("{\"goals\": 1, \"verdict\": 2}"),
            "{\"goals\": 1, \"verdict\": 2}"
        );
    }
}
