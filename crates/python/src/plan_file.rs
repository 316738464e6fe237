//! Plans of solutions and of files, and plans built from given pushes.

use std::sync::Arc;

use pushplan::files::PlanFile;
use pushplan::outcomes::{VerifySettings, rule_violations};
use pushplan::planning::{ActionError, ManualPush, manual_plan};
use pushplan::{RankedPlan, Situation, TableFit, Task, Tool, Verdict, Verifier, Warning};
use pushplan_report::TaskSource;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::plan::PyPlan;
use crate::task::PyTask;
use crate::{errors, work};

impl PyPlan {
    /// Creates a plan from a ranked plan of a solution.
    pub fn ranked(
        (task, source): (&Task, &TaskSource),
        fit: Option<&TableFit>,
        ranked: &RankedPlan,
    ) -> Self {
        let file = PlanFile {
            task: task.clone(),
            tools: ranked.tools.clone(),
            plan: ranked.plan.clone(),
            model: Some(ranked.predicted.by.clone()),
            fit: fit.cloned(),
            predicted: Some(ranked.outcome.clone()),
            verdict: ranked.verdict.clone(),
            joints: ranked.joints.clone(),
        };
        let trajectory = Some(ranked.predicted.clone());
        Self { file, source: source.clone(), trajectory, violations: Vec::new() }
    }

    /// Creates a plan from a file, without a prediction.
    pub fn read(file: PlanFile) -> Self {
        let source = TaskSource::File(format!("{}.yaml", file.task.name));
        let PlanFile { task, tools, plan, .. } = &file;
        let rules = rule_violations(task, &task.scene, tools, plan);
        let violations = rules.iter().map(Warning::to_string).collect();
        Self { file, source, trajectory: None, violations }
    }

    /// Creates a plan of given pushes with one of `yaws`, radians.
    pub fn pushing(
        py: Python<'_>,
        task: &PyTask,
        tool: Arc<Tool>,
        yaws: &[f64],
        pushes: &[ManualPush],
    ) -> PyResult<Self> {
        let stated = &task.task;
        let situation = Situation::stated(&stated.scene);
        let plan = || manual_plan(stated, &situation, &tool, yaws, pushes);
        // Only the pushes after the first are simulated.
        let asked = if pushes.len() > 1 { work::run(py, 0, |_| plan())? } else { plan() };
        let names = || stated.scene.things().map(|(_, object)| object.name.as_str());
        let asked = asked.map_err(|error| match error {
            ActionError::NoObject { .. } => {
                let names: Vec<&str> = names().collect();
                errors::action(py, &format!("{error}; use one of {}", names.join(", ")))
            }
            error => errors::action(py, &error.to_string()),
        })?;
        let rules =
            rule_violations(stated, &stated.scene, std::slice::from_ref(&tool), &asked.plan);
        let forms = rules.iter().filter(|rule| {
            matches!(rule, Warning::ForbiddenPush { .. } | Warning::TooManyPushes { .. })
        });
        let margins =
            asked.violations.iter().map(|(push, rule)| format!("push {}: {rule}", push + 1));
        let violations: Vec<String> = margins.chain(forms.map(Warning::to_string)).collect();
        let file = PlanFile::new(Task::clone(stated), vec![tool], asked.plan);
        Ok(Self { file, source: task.source(), trajectory: None, violations })
    }

    /// Replays the unperturbed plan in both engines.
    pub fn replayed(&self) -> Verdict {
        let PlanFile { task, tools, plan, .. } = &self.file;
        let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
        verifier.nominal(task, &Situation::stated(&task.scene), tools, plan)
    }

    /// Returns the content of the plan's file.
    pub fn json(&self) -> PyResult<serde_json::Value> {
        serde_json::to_value(&self.file).map_err(|error| PyRuntimeError::new_err(error.to_string()))
    }
}
