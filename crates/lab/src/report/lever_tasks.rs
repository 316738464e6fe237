//! Generated levering tasks: success, robustness and cost.

use pushplan::internals::solve::PlanStatus;
use pushplan_act::judge::{mean, percentile};
use pushplan_bench::store::{Finished, RunManifest};
use pushplan_report::{Align, Document, Section, Table, flat, progress_note, seconds};
use serde_json::json;

use crate::bench::LeverRecord;

/// Returns the results of a run.
pub fn lever_tasks_document(run: &RunManifest, tasks: &[Finished<LeverRecord>]) -> Document {
    let count = tasks.len().max(1) as f64;
    let share = |has: &dyn Fn(&LeverRecord) -> bool| {
        let found = tasks.iter().filter(|task| has(&task.record)).count();
        format!("{:.1} %", 100.0 * found as f64 / count)
    };
    let mean_of = |of: &dyn Fn(&LeverRecord) -> f64| {
        mean(&tasks.iter().map(|task| of(&task.record)).collect::<Vec<_>>())
    };
    let mut spent: Vec<f64> =
        tasks.iter().filter_map(|task| task.seconds.get("total").copied()).collect();
    spent.sort_by(f64::total_cmp);
    let further = mean_of(&|record| record.further);
    let candidates = mean_of(&|record| record.candidates as f64);
    let rows = [
        ("a random lever-up takes the board out", share(&|record| record.random)),
        ("nominal replay works", share(&|record| record.works)),
        ("solved", share(&|record| record.status == PlanStatus::Solved)),
        ("additional perturbed replays that reach the goal", format!("{:.1} %", 100.0 * further)),
        ("candidates per task", format!("{candidates:.0}")),
        ("time per task, median", seconds(percentile(&spent, 50.0))),
        ("time per task, 95th percentile", seconds(percentile(&spent, 95.0))),
    ];
    let table = Table::of(
        rows,
        &[
            ("", Align::Left, &|(what, _)| (*what).to_owned()),
            ("", Align::Right, &|(_, value)| value.clone()),
        ],
    );
    let mut notes = vec![
        "The goal is to take a board out of the pocket of a drive. Each task has another drive, \
         with a notch at a random place in a wall. *Solved*: the nominal replay reaches the goal, \
         and so do three quarters of the perturbed replays (0.5 mm, 1 degree, 10 % friction). The \
         additional replays have other perturbations than the replays of the planner. Without a \
         working plan they count as failed."
            .to_owned(),
    ];
    notes.extend(progress_note(run, tasks.len()));
    Document {
        title: format!("{} generated levering tasks of seed {}", tasks.len(), run.seed),
        notes,
        sections: vec![Section { table, ..Section::default() }],
        rows: Table::of(
            tasks,
            &[
                ("task", Align::Right, &|task| (task.index + 1).to_string()),
                ("works", Align::Left, &|task| task.record.works.to_string()),
                ("solved", Align::Left, &|task| {
                    (task.record.status == PlanStatus::Solved).to_string()
                }),
                ("further", Align::Right, &|task| task.record.further.to_string()),
                ("promising", Align::Right, &|task| task.record.promising.to_string()),
            ],
        ),
        json: json!({"run": run, "tasks": tasks.iter().map(flat).collect::<Vec<_>>()}),
    }
}
