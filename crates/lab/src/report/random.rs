//! The suite of random tasks: one table by kind and method, charts, rows for CSV.

use pushplan::internals::solve::PlanStatus;
use pushplan_act::judge::{mean, percentile};
use pushplan_bench::store::{Finished, RunManifest, Seconds};
use pushplan_bench::{End, SolvedTask};
use pushplan_report::{
    Align, BarChart, Bars, Document, Figure, NONE, SOLVED_COLUMNS, Section, Table, error_chart,
    flat, millimetres, progress_note, seconds, solved_cells,
};
use serde_json::json;

use crate::bench::{RandomRecord, TaskKind};

/// A run of the suite: its manifest and its results.
pub type RandomRun = (RunManifest, Vec<Finished<RandomRecord>>);

/// Outcomes of the tasks by a method.
struct Method<'a> {
    name: String,
    tasks: Vec<Row<'a>>,
}

/// A task by a method.
struct Row<'a> {
    kind: TaskKind,
    predicted: Option<f64>,
    planar: Option<End>,
    spatial: Option<End>,
    solved: Option<(&'a SolvedTask, &'a Seconds)>,
}

/// Compares runs of the suite on the same tasks, each a method, with doing nothing and a random
/// plan of one push.
pub fn random_document(runs: &[RandomRun]) -> Document {
    let mut methods: Vec<Method> = runs.iter().map(planner).collect();
    if let Some((_, tasks)) = runs.iter().max_by_key(|(_, tasks)| tasks.len()) {
        methods.push(Method {
            name: "random push".to_owned(),
            tasks: tasks.iter().map(random).collect(),
        });
        methods.push(Method {
            name: "do nothing".to_owned(),
            tasks: tasks.iter().map(nothing).collect(),
        });
    }
    let kinds: Vec<TaskKind> = TaskKind::each()
        .filter(|kind| methods.iter().any(|m| m.tasks.iter().any(|row| row.kind == *kind)))
        .collect();
    let count = runs.iter().map(|(_, tasks)| tasks.len()).max().unwrap_or(0);
    let seed = runs.first().map_or(0, |(run, _)| run.seed);
    let solvable = match kinds.contains(&TaskKind::Gap) {
        true => "Tasks of the kind gap are unsolvable, all others are solvable",
        false => "Every task is solvable",
    };
    let mut notes = vec![format!(
        "*Solved* means that the plan passes verification: in both engines, the object rests \
         within the tolerance, nothing jams or topples, and enough perturbed replays succeed; \
         *fragile* lacks only the last criterion. {solvable}, because the goals are the final \
         poses of a random allowed plan in both engines. Errors are final distances from the \
         goal, of the nearest plan if the task is not solved; times are planning times."
    )];
    notes.extend(runs.iter().filter_map(|(run, tasks)| progress_note(run, tasks.len())));
    let errors: Vec<(String, Vec<f64>)> = methods
        .iter()
        .map(|method| {
            let ends = method.tasks.iter().filter_map(|row| row.spatial);
            (method.name.clone(), ends.map(|end| end.error).collect())
        })
        .collect();
    let figures = vec![
        success_chart(&methods, &kinds),
        error_chart("Final errors in 3-D, all kinds", &errors),
    ];
    Document {
        title: format!("{count} random tasks of seed {seed}"),
        notes,
        sections: vec![
            Section {
                title: "By kind and method".to_owned(),
                table: summary(&methods, &kinds),
                figures,
                ..Section::default()
            },
            Section {
                title: "Cost of planning".to_owned(),
                table: effort(&methods, &kinds),
                ..Section::default()
            },
        ],
        rows: rows(runs),
        json: json!({"runs": runs.iter().map(|(run, tasks)| json!({
            "run": run, "tasks": tasks.iter().map(flat).collect::<Vec<_>>(),
        })).collect::<Vec<_>>()}),
    }
}

fn planner((run, tasks): &RandomRun) -> Method<'_> {
    let effort = run.settings["effort"].as_str().filter(|effort| *effort != "standard");
    let name = match effort {
        Some(effort) => format!("{}, {effort}", run.model),
        None => run.model.clone(),
    };
    let tasks = tasks.iter().map(|task| Row {
        kind: task.record.kind,
        predicted: task.record.solved.predicted.map(|end| end.error),
        planar: task.record.solved.planar,
        spatial: task.record.solved.spatial,
        solved: Some((&task.record.solved, &task.seconds)),
    });
    Method { name, tasks: tasks.collect() }
}

fn random(task: &Finished<RandomRecord>) -> Row<'_> {
    let RandomRecord { kind, random, .. } = &task.record;
    let ends = random.as_ref();
    Row {
        kind: *kind,
        predicted: None,
        planar: ends.map(|choice| choice.planar),
        spatial: ends.map(|choice| choice.spatial),
        solved: None,
    }
}

fn nothing(task: &Finished<RandomRecord>) -> Row<'_> {
    let RandomRecord { kind, nothing, .. } = task.record;
    Row { kind, predicted: None, planar: Some(nothing), spatial: Some(nothing), solved: None }
}

/// Returns the kinds, then their union if there are several.
fn groups(kinds: &[TaskKind]) -> Vec<Option<TaskKind>> {
    let all = (kinds.len() > 1).then_some(None);
    kinds.iter().copied().map(Some).chain(all).collect()
}

fn members<'a>(method: &'a Method, group: Option<TaskKind>) -> Vec<&'a Row<'a>> {
    method.tasks.iter().filter(|row| group.is_none_or(|kind| row.kind == kind)).collect()
}

fn group_name(group: Option<TaskKind>) -> &'static str {
    group.map_or("all", TaskKind::name)
}

fn summary(methods: &[Method], kinds: &[TaskKind]) -> Table {
    let mut table = Table::new([
        ("kind", Align::Left),
        ("method", Align::Left),
        ("tasks", Align::Right),
        ("solved", Align::Right),
        ("within, 2-D", Align::Right),
        ("within, 3-D", Align::Right),
        ("predicted, mean", Align::Right),
        ("2-D, mean", Align::Right),
        ("3-D, mean", Align::Right),
        ("3-D, median", Align::Right),
        ("3-D, p95", Align::Right),
    ]);
    for group in groups(kinds) {
        for method in methods {
            let rows = members(method, group);
            if rows.is_empty() {
                continue;
            }
            let share = |count: usize| format!("{:.1} %", 100.0 * count as f64 / rows.len() as f64);
            let reached = |end: &dyn Fn(&Row) -> Option<End>| {
                share(rows.iter().filter(|row| end(row).is_some_and(|end| end.reached)).count())
            };
            let solved = rows.iter().filter_map(|row| row.solved);
            let solved = solved.filter(|(task, _)| task.status == PlanStatus::Solved).count();
            let planner = rows.iter().any(|row| row.solved.is_some());
            let errors = |error: &dyn Fn(&Row) -> Option<f64>| -> Vec<f64> {
                let mut list: Vec<f64> = rows.iter().filter_map(|row| error(row)).collect();
                list.sort_by(f64::total_cmp);
                list
            };
            let spatial = errors(&|row| Some(row.spatial?.error));
            let length = |list: &[f64], of: &dyn Fn(&[f64]) -> f64| match list {
                [] => NONE.to_owned(),
                list => millimetres(of(list)),
            };
            table.row([
                group_name(group).to_owned(),
                method.name.clone(),
                rows.len().to_string(),
                if planner { share(solved) } else { NONE.to_owned() },
                reached(&|row| row.planar),
                reached(&|row| row.spatial),
                length(&errors(&|row| row.predicted), &mean),
                length(&errors(&|row| Some(row.planar?.error)), &mean),
                length(&spatial, &mean),
                length(&spatial, &|list| percentile(list, 50.0)),
                length(&spatial, &|list| percentile(list, 95.0)),
            ]);
        }
    }
    table
}

fn effort(methods: &[Method], kinds: &[TaskKind]) -> Table {
    let mut table = Table::new([
        ("kind", Align::Left),
        ("method", Align::Left),
        ("no plan", Align::Right),
        ("failed verification", Align::Right),
        ("fragile", Align::Right),
        ("pushes", Align::Right),
        ("attempts", Align::Right),
        ("rollouts", Align::Right),
        ("search", Align::Right),
        ("refinement", Align::Right),
        ("verification", Align::Right),
        ("time", Align::Right),
        ("time, p95", Align::Right),
    ]);
    for group in groups(kinds) {
        for method in methods {
            let rows = members(method, group);
            let tasks: Vec<(&SolvedTask, &Seconds)> =
                rows.iter().filter_map(|row| row.solved).collect();
            if tasks.is_empty() {
                continue;
            }
            let ended = |status| tasks.iter().filter(|(t, _)| t.status == status).count();
            let average = |of: &dyn Fn(&SolvedTask) -> f64| {
                format!("{:.1}", mean(&tasks.iter().map(|(task, _)| of(task)).collect::<Vec<_>>()))
            };
            let times = |stage: &str| -> Vec<f64> {
                let known = tasks.iter().filter_map(|(_, times)| times.get(stage).copied());
                let mut list: Vec<f64> = known.collect();
                list.sort_by(f64::total_cmp);
                list
            };
            let time = |list: &[f64], of: &dyn Fn(&[f64]) -> f64| match list {
                [] => NONE.to_owned(),
                list => seconds(of(list)),
            };
            let total = times("total");
            table.row([
                group_name(group).to_owned(),
                method.name.clone(),
                ended(PlanStatus::NoPlan).to_string(),
                ended(PlanStatus::FailedVerification).to_string(),
                ended(PlanStatus::Fragile).to_string(),
                average(&|task| task.plan.as_ref().map_or(0.0, |plan| plan.pushes().len() as f64)),
                average(&|task| task.attempts as f64),
                average(&|task| task.rollouts as f64),
                time(&times("search"), &mean),
                time(&times("refinement"), &mean),
                time(&times("verification"), &mean),
                time(&total, &mean),
                time(&total, &|list| percentile(list, 95.0)),
            ]);
        }
    }
    table
}

fn success_chart(methods: &[Method], kinds: &[TaskKind]) -> Figure {
    let groups = groups(kinds);
    let bars = methods.iter().map(|method| Bars {
        name: method.name.clone(),
        shares: groups
            .iter()
            .map(|group| {
                let rows = members(method, *group);
                let reached = rows.iter().filter(|row| row.spatial.is_some_and(|end| end.reached));
                (!rows.is_empty()).then(|| reached.count() as f64 / rows.len() as f64)
            })
            .collect(),
    });
    let chart = BarChart {
        title: "Tasks that end within the tolerance in 3-D".to_owned(),
        label: "share of tasks".to_owned(),
        groups: groups.iter().map(|group| group_name(*group).to_owned()).collect(),
        bars: bars.collect(),
    };
    Figure::bars("success", chart)
}

fn rows(runs: &[RandomRun]) -> Table {
    let first = [("model", Align::Left), ("effort", Align::Left), ("kind", Align::Left)];
    let last = [
        ("made_with", Align::Left),
        ("made_pushes", Align::Right),
        ("nothing_m", Align::Right),
        ("random_planar_m", Align::Right),
        ("random_spatial_m", Align::Right),
    ];
    let mut table = Table::new(first.into_iter().chain(SOLVED_COLUMNS).chain(last));
    for (run, tasks) in runs {
        let effort = run.settings["effort"].as_str().unwrap_or_default();
        for Finished { index, record, seconds } in tasks {
            let random = |end: &dyn Fn(&crate::bench::Choice) -> End| {
                let choice = record.random.as_ref();
                choice.map_or(String::new(), |choice| end(choice).error.to_string())
            };
            let mut cells =
                vec![run.model.clone(), effort.to_owned(), record.kind.name().to_owned()];
            cells.extend(solved_cells(*index, &record.solved, seconds));
            cells.extend([
                record.maker.as_ref().map_or(String::new(), |maker| maker.tool.clone()),
                record.maker.as_ref().map_or(String::new(), |maker| maker.pushes.to_string()),
                record.nothing.error.to_string(),
                random(&|choice| choice.planar),
                random(&|choice| choice.spatial),
            ]);
            table.row(cells);
        }
    }
    table
}
