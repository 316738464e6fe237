//! The reference tool benchmark as tables, charts and rows for CSV.

use serde_json::json;

use pushplan_act::judge::Summary;
use pushplan_bench::store::{Finished, RunManifest};
use pushplan_bench::{
    EngineErrors, Layout, Method, PROCESSOR, ReferenceSetup, ToolRecord, ToolRow, ToolTrial,
    summarise,
};

use super::document::{Document, Section};
use super::number::{millimetres, seconds};
use super::solved::{error_chart, flat, progress_note};
use super::table::{Align, NONE, Table};

/// Explanatory notes, a paragraph each.
const NOTES: [&str; 3] = [
    "First choice: the sequence of pushes from the home position with the best prediction. \
     Sequences may stop every 5 mm, and not pushing is one of them. Oracle: the best of all \
     sequences by replay in the 2-D engine. Planned: the plan of `pushplan solve` for the same \
     goal and tool poses. Its pushes start anywhere in contact, in eight directions. They are \
     searched, refined and replayed in 3-D until one ends within 5 cm (tried: replays per task).",
    "When the tool stops, it stays in place while the cylinder glides to rest, in all models and \
     engines. The tool has no hand that could touch the cylinder.",
    "For a single tool pose, all tasks count, including unsolvable ones. For sequences, these \
     include tasks in which the cylinder obstructs the tool's home. Times are per task, including \
     its share of the rollouts that several tasks use. Processor times need --threads 1.",
];

/// Methods shown for each tool pose alone.
const ALONE: [Method; 3] = [Method::Oracle, Method::First, Method::Planned];

/// Column names of a trial in CSV; lengths in metres.
const COLUMNS: [(&str, Align); 15] = [
    ("index", Align::Right),
    ("start", Align::Right),
    ("goal_x_m", Align::Right),
    ("goal_y_m", Align::Right),
    ("tools", Align::Left),
    ("choice", Align::Left),
    ("taken", Align::Left),
    ("pushes", Align::Right),
    ("travel_m", Align::Right),
    ("predicted_m", Align::Right),
    ("planar_m", Align::Right),
    ("spatial_m", Align::Right),
    ("planar_sound", Align::Left),
    ("spatial_sound", Align::Left),
    ("tried", Align::Right),
];

/// Returns a report on the benchmark.
pub fn tools_document(run: &RunManifest, tasks: &[Finished<ToolRecord>]) -> Document {
    let setup = ReferenceSetup::new(Layout::Grid);
    let records: Vec<&ToolRecord> = tasks.iter().map(|task| &task.record).collect();
    let summary = summarise(&setup, &records);
    let (alone, together): (Vec<&ToolRow>, Vec<&ToolRow>) =
        summary.iter().partition(|row| row.pose.is_some());
    let alone: Vec<&ToolRow> =
        alone.into_iter().filter(|row| ALONE.contains(&row.method)).collect();
    let mut rows = Table::new(COLUMNS);
    for task in tasks {
        for trial in &task.record.trials {
            rows.row(cells(&setup, task.index, &task.record, trial));
        }
    }
    let form = match (run.settings["form"].as_str(), run.settings["layout"].as_str()) {
        (Some("single"), _) => format!("of single pushes, seed {}", run.seed),
        (_, layout) => format!("on the {} layout", layout.unwrap_or("unknown")),
    };
    Document {
        title: format!("{} tasks {form}, {}", tasks.len(), run.model),
        notes: progress_note(run, tasks.len())
            .into_iter()
            .chain(NOTES.map(str::to_owned))
            .chain(run.settings["planner"].as_str().map(|planner| format!("Planner: {planner}.")))
            .collect(),
        sections: vec![
            Section {
                title: "All tool poses together".into(),
                table: row_table(&together, "choice", |row| title(row.method).to_owned()),
                figures: vec![error_chart("Final errors in 3-D", &errors(&records))],
                ..Section::default()
            },
            Section {
                title: "Each tool pose alone".into(),
                table: row_table(&alone, "tool, choice", |row| {
                    let pose = row.pose.as_deref().unwrap_or_default();
                    format!("{pose}, {}", title(row.method))
                }),
                ..Section::default()
            },
            Section {
                title: "Wall and processor time per task with all tool poses".into(),
                table: time_table(tasks),
                ..Section::default()
            },
        ],
        rows,
        json: json!({
            "run": run,
            "summary": summary,
            "tasks": tasks.iter().map(flat).collect::<Vec<_>>(),
        }),
    }
}

fn title(method: Method) -> &'static str {
    match method {
        Method::Nothing => "no push",
        Method::Random => "random",
        Method::Oracle => "oracle",
        Method::Planar => "first choice, 2-D engine",
        Method::First => "first choice",
        Method::Planned => "planned",
    }
}

fn row_table(rows: &[&ToolRow], first: &str, name: impl Fn(&ToolRow) -> String) -> Table {
    let mut table = Table::new([
        (first, Align::Left),
        ("predicted", Align::Right),
        ("2-D", Align::Right),
        ("\u{2264} 5 cm", Align::Right),
        ("\u{2264} 10 cm", Align::Right),
        ("3-D", Align::Right),
        ("largest", Align::Right),
        ("\u{2264} 5 cm", Align::Right),
        ("\u{2264} 10 cm", Align::Right),
        ("pushes", Align::Right),
        ("tried", Align::Right),
    ]);
    for row in rows {
        let mean = |errors: &Option<Summary>| {
            errors.as_ref().map_or(NONE.to_owned(), |errors| millimetres(errors.mean))
        };
        let share = |count: usize| format!("{:.1} %", 100.0 * count as f64 / row.tasks as f64);
        let EngineErrors { errors, fine, coarse } = &row.spatial;
        table.row([
            name(row),
            mean(&row.predicted),
            mean(&row.planar.errors),
            share(row.planar.fine),
            share(row.planar.coarse),
            mean(errors),
            errors.as_ref().map_or(NONE.to_owned(), |errors| millimetres(errors.max)),
            share(*fine),
            share(*coarse),
            format!("{:.2}", row.pushes),
            row.attempts.map_or(NONE.to_owned(), |attempts| format!("{attempts:.2}")),
        ]);
    }
    table
}

fn time_table(tasks: &[Finished<ToolRecord>]) -> Table {
    let mut table = Table::new([
        ("choice", Align::Left),
        ("mean", Align::Right),
        ("median", Align::Right),
        ("largest", Align::Right),
        ("processor, one thread", Align::Right),
    ]);
    let times = |key: &str| -> Option<Summary> {
        let times = tasks.iter().filter_map(|task| task.seconds.get(key).copied());
        Summary::of(&times.collect::<Vec<f64>>())
    };
    for (method, key) in ToolRecord::TIMED {
        let Some(wall) = times(key) else { continue };
        let processor = times(&format!("{key}{PROCESSOR}"));
        let numbers = [wall.mean, wall.median, wall.max].map(seconds);
        let processor = processor.map_or(NONE.to_owned(), |times| seconds(times.mean));
        table.row(std::iter::once(title(method).to_owned()).chain(numbers).chain([processor]));
    }
    table
}

/// Returns the final 3-D errors with all tool poses, method by method.
fn errors(records: &[&ToolRecord]) -> Vec<(String, Vec<f64>)> {
    Method::ALL
        .into_iter()
        .map(|method| {
            let trials = records.iter().flat_map(|record| &record.trials);
            let own = trials.filter(|trial| trial.method == method && trial.pose.is_none());
            (title(method).to_owned(), own.map(|trial| trial.spatial.error).collect())
        })
        .collect()
}

fn cells(
    setup: &ReferenceSetup,
    index: usize,
    record: &ToolRecord,
    trial: &ToolTrial,
) -> Vec<String> {
    let pose = |pose: Option<usize>, none: &str| {
        pose.map_or(none.to_owned(), |pose| setup.poses[pose].name.clone())
    };
    vec![
        index.to_string(),
        record.start.to_string(),
        record.goal[0].to_string(),
        record.goal[1].to_string(),
        pose(trial.pose, "all"),
        title(trial.method).to_owned(),
        pose(trial.taken, ""),
        trial.pushes.to_string(),
        trial.travel.to_string(),
        trial.predicted.map_or(String::new(), |error| error.to_string()),
        trial.planar.error.to_string(),
        trial.spatial.error.to_string(),
        trial.planar.sound.to_string(),
        trial.spatial.sound.to_string(),
        trial.attempts.map_or(String::new(), |count| count.to_string()),
    ]
}
