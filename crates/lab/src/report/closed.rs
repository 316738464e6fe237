//! Runs of tasks with unknown scenes: benefit of the closed loop.

use pushplan_act::act::End;
use pushplan_act::judge::{mean, percentile};
use pushplan_bench::store::{Finished, RunManifest};
use pushplan_report::{Align, Document, NONE, Section, Table, millimetres, progress_note, seconds};
use serde_json::json;

use crate::bench::{ClosedRecord, Left, TaskKind};

/// A run of the suite: its manifest and its results.
pub type ClosedRun = (RunManifest, Vec<Finished<ClosedRecord>>);

/// Returns the runs of the suite in every form. Several runs on the same tasks are also compared on
/// the tasks with probes.
pub fn closed_document(runs: &[ClosedRun]) -> Document {
    let (count, seed) = runs.first().map_or((0, 0), |(run, tasks)| (tasks.len(), run.seed));
    let mut notes = vec![
        "Random tasks with hidden joints, masses, friction coefficients and supports; observations \
         have 1 mm and 0.5 degrees of noise. *Reached* refers to the true pose at rest. *Planned \
         once* executes one plan, made with the guessed values, without observations. *All known* \
         makes this plan with the true values; only the noise remains."
            .to_owned(),
    ];
    notes.extend(runs.iter().filter_map(|(run, tasks)| progress_note(run, tasks.len())));
    let mut sections: Vec<Section> = runs
        .iter()
        .map(|(run, tasks)| Section {
            title: if runs.len() > 1 { name(run) } else { String::new() },
            table: summary(tasks),
            ..Section::default()
        })
        .collect();
    if runs.len() > 1 {
        sections.push(compared(runs));
    }
    Document {
        title: format!("{count} random tasks of seed {seed} with hidden properties"),
        notes,
        sections,
        rows: rows(runs),
        json: json!({"runs": runs.iter().map(|(run, tasks)| json!({
            "run": run,
            "tasks": tasks.iter().map(|task| json!({
                "index": task.index, "record": task.record, "seconds": task.seconds,
            })).collect::<Vec<_>>(),
        })).collect::<Vec<_>>()}),
    }
}

/// Returns the name of a run among others on the same tasks.
fn name(run: &RunManifest) -> String {
    let settings = &run.settings["run"];
    let word = |key: &str| settings[key].as_str().unwrap_or_default().to_owned();
    match settings["max_probes"].as_u64() {
        Some(0) => "no probes".to_owned(),
        _ => format!("probes by {}", word("probe_rule")),
    }
}

/// Compares the loops on the tasks in which any of them makes a probe.
fn compared(runs: &[ClosedRun]) -> Section {
    let probes = |index: usize| {
        let mut tasks = runs.iter().flat_map(|(_, tasks)| tasks);
        tasks.any(|task| task.index == index && task.record.probes > 0)
    };
    let mut table = Table::new([
        ("probes", Align::Left),
        ("tasks", Align::Right),
        ("reached", Align::Right),
        ("with one push", Align::Right),
        ("two", Align::Right),
        ("three", Align::Right),
        ("pushes, mean", Align::Right),
        ("error, median", Align::Right),
    ]);
    for (run, tasks) in runs {
        let of: Vec<&ClosedRecord> =
            tasks.iter().filter(|task| probes(task.index)).map(|task| &task.record).collect();
        let share = |is: &dyn Fn(&ClosedRecord) -> bool| {
            let count = of.iter().filter(|record| is(record)).count();
            format!("{:.1} %", 100.0 * count as f64 / of.len().max(1) as f64)
        };
        let pushes: Vec<f64> = of.iter().map(|record| record.pushes as f64).collect();
        let mut errors: Vec<f64> = of.iter().map(|record| record.closed.error).collect();
        errors.sort_by(f64::total_cmp);
        let within = |most: usize| {
            share(&|record: &ClosedRecord| record.closed.reached && record.pushes <= most)
        };
        table.row([
            name(run),
            of.len().to_string(),
            share(&|record| record.closed.reached),
            within(1),
            within(2),
            within(3),
            format!("{:.2}", mean(&pushes)),
            if errors.is_empty() {
                NONE.to_owned()
            } else {
                millimetres(percentile(&errors, 50.0))
            },
        ]);
    }
    Section {
        title: "Tasks with exploratory pushes in any run; they count as pushes".to_owned(),
        table,
        ..Section::default()
    }
}

fn summary(tasks: &[Finished<ClosedRecord>]) -> Table {
    let mut table = Table::new([
        ("kind", Align::Left),
        ("tasks", Align::Right),
        ("reached, closed loop", Align::Right),
        ("planned once", Align::Right),
        ("planned once, all known", Align::Right),
        ("error, median", Align::Right),
        ("p95", Align::Right),
        ("pushes, mean", Align::Right),
        ("probes, mean", Align::Right),
        ("given up", Align::Right),
        ("time, median", Align::Right),
    ]);
    let kinds: Vec<TaskKind> = TaskKind::each()
        .filter(|kind| tasks.iter().any(|task| task.record.kind == *kind))
        .collect();
    let all = (kinds.len() > 1).then_some(None);
    for group in kinds.into_iter().map(Some).chain(all) {
        let of: Vec<&Finished<ClosedRecord>> =
            tasks.iter().filter(|task| group.is_none_or(|kind| task.record.kind == kind)).collect();
        let share = |left: &dyn Fn(&ClosedRecord) -> bool| {
            let count = of.iter().filter(|task| left(&task.record)).count();
            format!("{:.1} %", 100.0 * count as f64 / of.len().max(1) as f64)
        };
        let sorted = |value: &dyn Fn(&Finished<ClosedRecord>) -> Option<f64>| {
            let mut list: Vec<f64> = of.iter().filter_map(|task| value(task)).collect();
            list.sort_by(f64::total_cmp);
            list
        };
        let errors = sorted(&|task| Some(task.record.closed.error));
        let times = sorted(&|task| task.seconds.get("closed").copied());
        let at = |list: &[f64], share: f64, show: &dyn Fn(f64) -> String| match list {
            [] => NONE.to_owned(),
            list => show(percentile(list, share)),
        };
        let counts = |value: &dyn Fn(&ClosedRecord) -> usize| {
            let list: Vec<f64> = of.iter().map(|task| value(&task.record) as f64).collect();
            format!("{:.2}", mean(&list))
        };
        table.row([
            group.map_or("all", TaskKind::name).to_owned(),
            of.len().to_string(),
            share(&|record| record.closed.reached),
            share(&|record| record.once.reached),
            share(&|record| record.known.reached),
            at(&errors, 50.0, &millimetres),
            at(&errors, 95.0, &millimetres),
            counts(&|record| record.pushes),
            counts(&|record| record.probes),
            share(&|record| record.end != Some(End::Reached)),
            at(&times, 50.0, &seconds),
        ]);
    }
    table
}

fn rows(runs: &[ClosedRun]) -> Table {
    let mut table = Table::new([
        ("run", Align::Left),
        ("index", Align::Right),
        ("kind", Align::Left),
        ("end", Align::Left),
        ("pushes", Align::Right),
        ("probes", Align::Right),
        ("closed_reached", Align::Left),
        ("closed_m", Align::Right),
        ("once_reached", Align::Left),
        ("once_m", Align::Right),
        ("known_reached", Align::Left),
        ("known_m", Align::Right),
    ]);
    let tasks = runs.iter().flat_map(|(run, tasks)| tasks.iter().map(move |task| (run, task)));
    for (run, Finished { index, record, .. }) in tasks {
        let end = match record.end {
            Some(End::Reached) => "reached",
            Some(End::BudgetExhausted) => "used up",
            Some(End::NoImprovingPush) => "no push",
            Some(End::RuleBroken) => "rule broken",
            None => "broken off",
        };
        let mut cells = vec![
            name(run),
            index.to_string(),
            record.kind.to_string(),
            end.to_owned(),
            record.pushes.to_string(),
            record.probes.to_string(),
        ];
        for Left { reached, error } in [record.closed, record.once, record.known] {
            cells.extend([reached.to_string(), error.to_string()]);
        }
        table.row(cells);
    }
    table
}
