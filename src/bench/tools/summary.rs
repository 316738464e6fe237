//! Errors and successes over all tasks, for every method and tool pose.

use serde::{Deserialize, Serialize};

use super::{
    super::statistics::Summary,
    record::{Executed, Method, ToolRecord, ToolTrial},
    setup::{COARSE, FINE, ReferenceSetup},
};

/// How one engine ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EngineErrors {
    /// Distances from the goal, metres.
    pub errors: Option<Summary>,
    /// Tasks that ended within 5 cm.
    pub fine: usize,
    /// Tasks that ended within 10 cm.
    pub coarse: usize,
    /// Plans tried a task until one ended within 5 cm, where plans are tried.
    pub attempts: Option<f64>,
}

/// One method over all tasks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToolRow {
    /// Who chose.
    pub method: Method,
    /// The tool pose that it had to take; nothing where it could choose among all.
    pub pose: Option<String>,
    /// Number of tasks.
    pub tasks: usize,
    /// Predicted distances from the goal, metres.
    pub predicted: Option<Summary>,
    /// In the planar engine.
    pub planar: EngineErrors,
    /// In the 3-D engine.
    pub spatial: EngineErrors,
    /// Pushes of a plan, on average.
    pub pushes: f64,
    /// Travel of the tool in a plan, metres, on average.
    pub travel: f64,
}

/// The rows of all methods: all tool poses first, then each alone.
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
    ToolRow {
        method,
        pose,
        tasks: trials.len(),
        predicted: Summary::of(&predicted),
        planar: engine(trials.iter().map(|trial| &trial.planar)),
        spatial: engine(trials.iter().map(|trial| &trial.spatial)),
        pushes: mean(&|trial| trial.pushes as f64),
        travel: mean(&|trial| trial.travel),
    }
}

fn engine<'a>(executed: impl Iterator<Item = &'a Executed> + Clone) -> EngineErrors {
    let errors: Vec<f64> = executed.clone().map(|one| one.error).collect();
    let within = |limit| executed.clone().filter(|one| one.sound && one.error <= limit).count();
    let attempts: Vec<f64> =
        executed.clone().filter_map(|one| one.attempts).map(|n| n as f64).collect();
    EngineErrors {
        errors: Summary::of(&errors),
        fine: within(FINE),
        coarse: within(COARSE),
        attempts: (!attempts.is_empty())
            .then(|| attempts.iter().sum::<f64>() / attempts.len() as f64),
    }
}
