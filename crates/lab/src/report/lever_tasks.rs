//! Generated lever tasks: success, robustness and cost.

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
        ("a lever-up at random takes the board out", share(&|record| record.random)),
        ("works as written", share(&|record| record.works)),
        ("solved", share(&|record| record.status == PlanStatus::Solved)),
        ("further disturbed replays that reach the goal", format!("{:.1} %", 100.0 * further)),
        ("candidates a task", format!("{candidates:.0}")),
        ("time a task, median", seconds(percentile(&spent, 50.0))),
        ("time a task, 95th percentile", seconds(percentile(&spent, 95.0))),
    ];
    let table = Table::of(
        rows,
        &[
            ("", Align::Left, &|(what, _)| (*what).to_owned()),
            ("", Align::Right, &|(_, value)| value.clone()),
        ],
    );
    let mut notes = vec![
        "A board is to come out of the pocket of a drive, each task with another drive and a notch \
         somewhere in a wall. Solved means that the replay as written reaches the goal and so do \
         three quarters of those with 0.5 mm and 1 degree of error and 10 % of other friction. \
         Further replays have other draws than those of the planner; without a plan that works \
         they count as missed."
            .to_owned(),
    ];
    notes.extend(progress_note(run, tasks.len()));
    Document {
        title: format!("{} generated tasks of levering of seed {}", tasks.len(), run.seed),
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
