//! The trade-off between speed and accuracy as tables and charts.

use pushplan_act::judge::Summary;
use pushplan_report::Align::{Left, Right};
use pushplan_report::{
    Axis, Chart, Document, Figure, Mark, NONE, Section, Series, Table, fine_millimetres, seconds,
};
use serde_json::json;

use crate::bench::{PlanRow, PredictorRow, SuiteErrors, SuiteKind, TradeOffReport, prior_instead};
use crate::report::length;

/// Families of levels: name, and prefixes of the names of their models. The first match counts.
const FAMILIES: [(&str, &[&str]); 5] = [
    ("network", &["network"]),
    ("analytic model", &["prior"]),
    ("2-D simulation", &["planar"]),
    ("3-D simulation", &["3d"]),
    ("without physics", &["projection", "follow", "still"]),
];

/// Returns every level of the ladder: errors and cost of predictors, robustness and cost of
/// planning.
pub fn tradeoff_document(report: &TradeOffReport) -> Document {
    let section =
        |title: &str, table| Section { title: title.to_owned(), table, ..Section::default() };
    let push = Figure::chart("tradeoff-push", push_chart(report));
    let task = Figure::chart("tradeoff-task", task_chart(report));
    Document {
        title: "Speed against accuracy".to_owned(),
        notes: vec![measured(report), LEGEND.to_owned()],
        sections: vec![
            Section { figures: vec![push], ..section("Predictors", predictor_table(report)) },
            section("Cost of a push by number of objects", object_table(report)),
            Section { figures: vec![task], ..section("Planning levels", plan_table(report)) },
            Section { lines: prior_alone(report), ..section("Efforts", effort_table(report)) },
        ],
        json: json!(report),
        ..Document::default()
    }
}

/// Explanation of the columns.
const LEGEND: &str = "*A push* is processor time per push in batches of 64, which share common \
    work; *alone* is without sharing. *Works* is the share of perturbed replays, with other \
    support models, starts and frictions, that reach the goal, in the engine with the lower \
    share. *Solved* is the verdict of the planner at this level, from its own replays.";

/// Returns the measurement conditions, in a line or two.
fn measured(report: &TradeOffReport) -> String {
    let counts = &report.counts;
    format!(
        "Measured by `pushplan-lab tradeoff`: {} held-out pushes of each kind, {} tasks of seed \
         {}. Processor time is on one thread, which reaches {:.0} GFLOP/s in matrix products. The \
         fastest of {} rounds counts; the median round is {:.0} % slower",
        counts.pushes,
        counts.tasks,
        counts.seed,
        report.gigaflops,
        counts.rounds,
        1e2 * report.push_noise
    )
}

/// Returns errors and cost of every predictor; the first row compares the ground truth with itself.
fn predictor_table(report: &TradeOffReport) -> Table {
    let truth = ("planar, start shifted by 0.1 mm".to_owned(), &report.spread, None);
    let levels = report.predictors.iter();
    let levels = levels.map(|level| (level.model.to_string(), &level.suites, Some(level)));
    let one = |suites: &[SuiteErrors], value: fn(&Summary) -> f64| {
        error(suites, SuiteKind::Single, value)
    };
    let many = |suites: &[SuiteErrors], value: fn(&Summary) -> f64| {
        error(suites, SuiteKind::Touching, value)
    };
    Table::of(
        std::iter::once(truth).chain(levels),
        &[
            ("predictor", Left, &|(name, _, _)| name.clone()),
            ("mean", Right, &|(_, suites, _)| one(suites, |e| e.mean)),
            ("median", Right, &|(_, suites, _)| one(suites, |e| e.median)),
            ("p95", Right, &|(_, suites, _)| one(suites, |e| e.p95)),
            ("touching, mean", Right, &|(_, suites, _)| many(suites, |e| e.mean)),
            ("median", Right, &|(_, suites, _)| many(suites, |e| e.median)),
            ("p95", Right, &|(_, suites, _)| many(suites, |e| e.p95)),
            ("mean against 3-D", Right, &|(_, suites, _)| against_spatial(suites)),
            ("a push", Right, &|(_, _, level)| time(level.map(|level| level.seconds))),
            ("alone", Right, &|(_, _, level)| time(level.and_then(|level| level.seconds_alone))),
            ("front", Left, &|(_, _, level)| front(level.is_some_and(|level| level.on_front))),
        ],
    )
}

/// Returns the cost of a push by number of objects, relative to the 2-D engine.
fn object_table(report: &TradeOffReport) -> Table {
    Table::of(
        &report.objects,
        &[
            ("objects", Right, &|cost| cost.objects.to_string()),
            ("predictor", Left, &|cost| cost.model.to_string()),
            ("a push", Right, &|cost| seconds(cost.seconds)),
            ("planar at 1/240 takes", Right, &|cost| format!("{:.2} times", cost.planar_ratio)),
        ],
    )
}

/// Returns robustness and cost of every level of planning, cheapest first.
fn plan_table(report: &TradeOffReport) -> Table {
    let mut rows: Vec<&PlanRow> = report.plans.iter().collect();
    rows.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    Table::of(
        rows,
        &[
            ("level", Left, &|row| row.level.name.clone()),
            ("reached, predicted", Right, &|row| percent(row.predicted)),
            ("reached, planar", Right, &|row| percent(row.planar)),
            ("solved", Right, &|row| percent(row.success)),
            ("works", Right, &|row| percent(row.robustness)),
            ("error in 3-D, mean", Right, &|row| length(&row.error, |errors| errors.mean)),
            ("median", Right, &|row| length(&row.error, |errors| errors.median)),
            ("p95", Right, &|row| length(&row.error, |errors| errors.p95)),
            ("rollouts", Right, &|row| format!("{:.0}", row.rollouts)),
            ("verified", Right, &|row| format!("{:.1}", row.verified)),
            ("a task", Right, &|row| seconds(row.seconds)),
            ("verification", Right, &|row| seconds(row.verification)),
            ("front", Left, &|row| front(row.on_front)),
        ],
    )
}

/// Returns the level, cost and result of each effort.
fn effort_table(report: &TradeOffReport) -> Table {
    let rows = report.efforts.iter().filter_map(|(effort, choice)| {
        let row = report.plans.iter().find(|row| row.level.name == choice.name)?;
        Some((effort, row))
    });
    Table::of(
        rows,
        &[
            ("effort", Left, &|(effort, _)| format!("`{effort}`")),
            ("level", Left, &|(_, row)| row.level.name.clone()),
            ("solved", Right, &|(_, row)| percent(row.success)),
            ("works", Right, &|(_, row)| percent(row.robustness)),
            ("error in 3-D, median", Right, &|(_, row)| length(&row.error, |e| e.median)),
            ("p95", Right, &|(_, row)| length(&row.error, |e| e.p95)),
            ("processor time a task", Right, &|(_, row)| seconds(row.seconds)),
        ],
    )
}

/// Returns the efforts that a level with the analytic model alone matches, and its relative cost.
fn prior_alone(report: &TradeOffReport) -> Vec<String> {
    let chosen = report.efforts.iter().filter_map(|(effort, choice)| {
        let row = report.plans.iter().find(|row| row.level.name == choice.name)?;
        Some((effort, row))
    });
    let line = |(effort, row): (_, &PlanRow)| {
        let other = prior_instead(&report.plans, row, report.noise);
        other.map_or_else(
            || format!("No level with only `prior` is cheaper than `{effort}` and as robust."),
            |other| {
                format!(
                    "A level with only `prior` is cheaper than `{effort}` and as robust: {:.2} \
                     times its cost, {} instead of {} works ({}).",
                    other.seconds / row.seconds,
                    percent(other.robustness),
                    percent(row.robustness),
                    other.level.name,
                )
            },
        )
    };
    chosen.map(line).collect()
}

/// Returns a chart of error against cost of a push, with the front.
fn push_chart(report: &TradeOffReport) -> Chart {
    // The ground truth has no error against itself; its accuracy is its own spread.
    let floor = errors_of(&report.spread, SuiteKind::Single).map_or(0.0, |errors| errors.mean);
    let place = |row: &PredictorRow| {
        let mean = errors_of(&row.suites, SuiteKind::Single).map_or(f64::NAN, |errors| errors.mean);
        [1e6 * row.seconds, 1e3 * mean.max(floor)]
    };
    let points = report.predictors.iter().map(|row| Dot {
        model: row.model.clone(),
        label: row.model.clone(),
        at: place(row),
        front: row.on_front,
    });
    chart(
        "Speed against accuracy of one push",
        Axis::log("processor time of a push, \u{b5}s"),
        Axis::log("mean error against the 2-D engine, mm"),
        &points.collect::<Vec<Dot>>(),
        true,
    )
}

/// Returns a chart of robustness against cost of a task, with the front; efforts are labelled.
fn task_chart(report: &TradeOffReport) -> Chart {
    let points = report.plans.iter().map(|row| {
        let chosen = report.efforts.iter().filter(|(_, choice)| choice.name == row.level.name);
        let efforts: Vec<String> = chosen.map(|(effort, _)| effort.to_string()).collect();
        Dot {
            model: row.level.model.to_string(),
            label: efforts.join(", "),
            at: [row.seconds, 1e2 * row.robustness],
            front: row.on_front,
        }
    });
    chart(
        "Speed against robustness of plans",
        Axis::log("processor time of a task, s"),
        Axis::linear("perturbed replays that reach the goal, %"),
        &points.collect::<Vec<Dot>>(),
        false,
    )
}

/// A level in a chart.
struct Dot {
    model: String,
    label: String,
    at: [f64; 2],
    front: bool,
}

fn chart(title: &str, x: Axis, y: Axis, dots: &[Dot], label_all: bool) -> Chart {
    let mut front: Vec<[f64; 2]> = dots.iter().filter(|dot| dot.front).map(|dot| dot.at).collect();
    front.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut series = vec![Series {
        name: "front".to_owned(),
        points: front,
        mark: Mark::Line,
        labels: Vec::new(),
    }];
    let family = |dot: &Dot| {
        let begins = |beginning: &&str| dot.model.starts_with(beginning);
        FAMILIES.iter().position(|(_, beginnings)| beginnings.iter().any(begins))
    };
    for (k, (name, _)) in FAMILIES.into_iter().enumerate() {
        let members: Vec<&Dot> = dots.iter().filter(|dot| family(dot) == Some(k)).collect();
        let labels = members
            .iter()
            .enumerate()
            .filter(|(_, dot)| !dot.label.is_empty() && (dot.front || !label_all))
            .map(|(k, dot)| (k, dot.label.clone()));
        series.push(Series {
            name: name.to_owned(),
            labels: labels.collect(),
            points: members.iter().map(|dot| dot.at).collect(),
            mark: Mark::Dots,
        });
    }
    Chart { title: title.to_owned(), x, y, series }
}

fn errors_of(suites: &[SuiteErrors], kind: SuiteKind) -> Option<&Summary> {
    suites.iter().find(|errors| errors.suite == kind)?.position.as_ref()
}

fn error(suites: &[SuiteErrors], kind: SuiteKind, value: fn(&Summary) -> f64) -> String {
    errors_of(suites, kind).map_or(NONE.to_owned(), |errors| fine_millimetres(value(errors)))
}

fn against_spatial(suites: &[SuiteErrors]) -> String {
    let single = suites.iter().find(|errors| errors.suite == SuiteKind::Single);
    let errors = single.and_then(|errors| errors.position_3d.as_ref());
    errors.map_or(NONE.to_owned(), |errors| fine_millimetres(errors.mean))
}

/// Returns the entry of the last column for a level.
fn front(on_front: bool) -> String {
    if on_front { "yes".to_owned() } else { String::new() }
}

fn time(value: Option<f64>) -> String {
    value.map_or(NONE.to_owned(), seconds)
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 1e2 * share)
}
