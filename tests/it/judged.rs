//! Tasks solved with the draft effort, with plans checked in MuJoCo.

use std::process::Command;

use pushplan::asset::{PlanFile, ToolLibrary};
use pushplan::solve::{Effort, Planner, Solution};
use pushplan::task::Task;
use pushplan_export::{LEVER_SCRIPT, REPLAY_SCRIPT, mjcf};
use serde_json::Value as Json;

use crate::mujoco_python::python;

pub fn solved(task: &Task) -> Solution {
    let planner = Planner::for_effort(Effort::Draft).expect("its models").build();
    planner.solve(task, &ToolLibrary::embedded().expect("the shipped tools")).expect("a sound task")
}

pub fn file(task: &Task, solution: &Solution) -> PlanFile {
    let best = &solution.plans[0];
    PlanFile {
        predicted: Some(best.outcome.clone()),
        verdict: best.verdict.clone(),
        ..PlanFile::new(task.clone(), best.tools.clone(), best.plan.clone())
    }
}

/// Asserts that the plan works in MuJoCo, if available.
pub fn works_in_mujoco(file: &PlanFile) {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let [script, scene] = ["replay.py", "plan.xml"].map(|name| folder.path().join(name));
    std::fs::write(&script, REPLAY_SCRIPT).expect("written");
    std::fs::write(&scene, mjcf(file).expect("a scene")).expect("written");
    let output = Command::new(python).args([&script, &scene]).output().expect("Python");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
}

/// Returns whether MuJoCo finds all goals reached by a plan that leaves the plane; `None` without
/// MuJoCo.
pub fn is_reached_in_mujoco(file: &PlanFile) -> Option<bool> {
    let python = python()?;
    let folder = tempfile::tempdir().expect("a folder");
    let [script, scene] = ["lever.py", "plan.xml"].map(|name| folder.path().join(name));
    std::fs::write(&script, LEVER_SCRIPT).expect("written");
    std::fs::write(&scene, mjcf(file).expect("a scene")).expect("written");
    let output = Command::new(python).args([&script, &scene]).output().expect("Python");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let found: Json = serde_json::from_slice(&output.stdout).expect("a line of JSON");
    Some(found["reached"] == true)
}
