//! Second opinion of MuJoCo on plans: the script of the export plays their scenes.

use serde::Deserialize;

use pushplan::asset::PlanFile;
use pushplan::outcome::Verdict;
use pushplan_export::{LEVER_SCRIPT, REPLAY_SCRIPT, mjcf};
use pushplan_report::{SecondOpinion, TimedReplay};

use super::super::{error::CliError, interrupt};
use super::python::{Python, Scripts, Written};

/// Name of the scene in its folder.
const SCENE: &str = "plan.xml";

/// Line of JSON that the scripts write for a scene.
#[derive(Debug, Deserialize)]
struct Line {
    mujoco: String,
    failure: Option<String>,
    error: Option<f64>,
    heading_error: Option<f64>,
    difference: Option<f64>,
    runs: Vec<TimedReplay>,
}

/// Replays a plan in MuJoCo, and judges it together with the rule violations of `verdict`. `stops`
/// ends the replay early.
///
/// # Errors
/// Returns [`CliError::File`] if the plan cannot be exported, [`CliError::Interrupted`] after a
/// signal, and [`CliError::Unexpected`] if the script fails.
pub fn second_opinion(
    python: &Python,
    (name, file): (&str, &PlanFile),
    verdict: &Verdict,
    stops: &dyn Fn() -> bool,
) -> Result<SecondOpinion, CliError> {
    if verdict.evidence.is_empty() {
        return Ok(unplayed("the plan cannot be replayed"));
    }
    // The scene contains the end of our 3-D replay, for comparison.
    let file = PlanFile { verdict: Some(verdict.clone()), ..file.clone() };
    let in_space = file.task.in_space() || file.plan.levers();
    let (script, text, arguments) = match in_space {
        true => ("lever.py", LEVER_SCRIPT, &[SCENE][..]),
        false => ("replay.py", REPLAY_SCRIPT, &["--jobs", "1", SCENE][..]),
    };
    let scene = mjcf(&file).map_err(|error| CliError::File(format!("{name}: {error}")))?;
    let scripts = Scripts::with(script, text)?;
    scripts.add(SCENE, &scene)?;
    let played = python.run(&scripts, arguments, stops);
    if interrupt::requested() {
        return Err(CliError::Interrupted("interrupted".to_owned()));
    }
    let (_, Written { output, complaint }) =
        played.map_err(|error| CliError::unexpected("cannot replay in MuJoCo", &error))?;
    match output.lines().find_map(|line| serde_json::from_str::<Line>(line).ok()) {
        Some(line) => Ok(judged(line, verdict)),
        None if stops() => Ok(unplayed("not replayed within the time limit")),
        None => Err(CliError::unexpected(&format!("{name}: MuJoCo's replay failed"), &complaint)),
    }
}

/// Returns the opinion of a line.
fn judged(line: Line, verdict: &Verdict) -> SecondOpinion {
    let Line { mujoco, failure, error, heading_error, difference, runs } = line;
    SecondOpinion {
        engine: format!("MuJoCo {mujoco}"),
        passed: failure.is_none() && verdict.forbidden.is_empty(),
        failure,
        error,
        heading_error,
        difference,
        runs,
    }
}

/// Returns the opinion on a plan without a replay.
fn unplayed(reason: &str) -> SecondOpinion {
    SecondOpinion {
        engine: "MuJoCo".to_owned(),
        passed: false,
        failure: Some(reason.to_owned()),
        error: None,
        heading_error: None,
        difference: None,
        runs: Vec::new(),
    }
}
