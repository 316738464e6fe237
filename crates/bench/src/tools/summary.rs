//! Errors and successes over all tasks, for every method and tool pose.

use serde::{Deserialize, Serialize};

use pushplan_act::judge::{self, Summary};

use super::{
    record::{Executed, Method, ToolRecord, ToolTrial},
    setup::{COARSE, FINE, ReferenceSetup},
};

/// Results in one engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EngineErrors {
    /// Distances from the goal, metres.
    pub errors: Option<Summary>,
    /// Number of tasks that ended within 5 cm.
    pub fine: usize,
    /// Number of tasks that ended within 10 cm.
    pub coarse: usize,
}

/// Results of one method over all tasks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToolRow {
    /// Method of the choice.
    pub method: Method,
    /// Prescribed tool pose; `None` for a free choice.
    pub pose: Option<String>,
    /// Number of tasks.
    pub tasks: usize,
    /// Predicted distances from the goal, metres.
    pub predicted: Option<Summary>,
    /// Results in the 2-D engine.
    pub planar: EngineErrors,
    /// Results in the 3-D engine.
    pub spatial: EngineErrors,
    /// Mean number of pushes of a plan.
    pub pushes: f64,
    /// Mean travel of the tool in a plan, metres.
    pub travel: f64,
    /// Mean number of plans replayed per task, if any are.
    pub attempts: Option<f64>,
}

/// Returns the rows of all methods: all tool poses first, then each alone.
pub fn summarise(setup: &ReferenceSetup, records: &[&ToolRecord]) -> Vec<ToolRow> {
    let poses = std::iter::once(None).chain((0..setup.poses.len()).map(Some));
    poses
        .flat_map(|pose| Method::ALL.into_iter().map(move |method| (pose, method)))
        .filter_map(|(pose, method)| {
            let trials: Vec<&ToolTrial> = records
                .iter()
                .flat_map(|record| &record.trials)
                .filter(|trial| trial.method == method && trial.pose == pose)
                .collect();
            let name = pose.map(|pose| setup.poses[pose].name.clone());
            (!trials.is_empty()).then(|| row(method, name, &trials))
        })
        .collect()
}

fn row(method: Method, pose: Option<String>, trials: &[&ToolTrial]) -> ToolRow {
    let mean = |value: &dyn Fn(&ToolTrial) -> f64| {
        trials.iter().map(|trial| value(trial)).sum::<f64>() / trials.len() as f64
    };
    let predicted: Vec<f64> = trials.iter().filter_map(|trial| trial.predicted).collect();
    let attempts: Vec<f64> =
        trials.iter().filter_map(|trial| trial.attempts).map(|count| count as f64).collect();
    ToolRow {
        method,
        pose,
        tasks: trials.len(),
        predicted: Summary::of(&predicted),
        planar: engine(trials.iter().map(|trial| &trial.planar)),
        spatial: engine(trials.iter().map(|trial| &trial.spatial)),
        pushes: mean(&|trial| trial.pushes as f64),
        travel: mean(&|trial| trial.travel),
        attempts: (!attempts.is_empty()).then(|| judge::mean(&attempts)),
    }
}

fn engine<'a>(executed: impl Iterator<Item = &'a Executed> + Clone) -> EngineErrors {
    let errors: Vec<f64> = executed.clone().map(|one| one.error).collect();
    let within = |limit| executed.clone().filter(|one| one.sound && one.error <= limit).count();
    EngineErrors { errors: Summary::of(&errors), fine: within(FINE), coarse: within(COARSE) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a record with one choice of one method, which ends `error` metres from the goal.
    fn record(error: f64, sound: bool, attempts: Option<usize>) -> ToolRecord {
        let executed = Executed { error, sound };
        let trial = ToolTrial {
            method: Method::First,
            pose: None,
            taken: Some(2),
            predicted: Some(0.5 * error),
            planar: executed,
            spatial: executed,
            pushes: 3,
            travel: 0.5,
            attempts,
        };
        ToolRecord { start: 0, goal: [0.0, 0.0], trials: vec![trial] }
    }

    #[test]
    fn a_toppled_object_is_no_success_and_still_an_error() {
        let records = [
            record(0.01, true, Some(1)),
            record(0.05, true, Some(3)),
            record(0.09, true, None),
            record(0.02, false, None),
            record(0.13, true, None),
        ];
        let setup = ReferenceSetup::new(super::super::setup::Layout::Grid);
        let rows = summarise(&setup, &records.iter().collect::<Vec<_>>());
        assert_eq!(rows.len(), 1);
        let row = &rows[0];
        assert_eq!((row.method, row.pose.as_deref(), row.tasks), (Method::First, None, 5));
        assert_eq!((row.planar.fine, row.planar.coarse), (2, 3));
        assert_eq!(row.attempts, Some(2.0));
        let mean = |summary: &Option<Summary>| summary.as_ref().map(|summary| summary.mean);
        assert!((mean(&row.spatial.errors).unwrap_or(0.0) - 0.06).abs() < 1e-12);
        assert!((mean(&row.predicted).unwrap_or(0.0) - 0.03).abs() < 1e-12);
        assert!((row.pushes - 3.0).abs() < 1e-12 && (row.travel - 0.5).abs() < 1e-12);
    }
}
