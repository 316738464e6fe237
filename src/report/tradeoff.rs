//! The trade of speed for accuracy as tables and charts.

use crate::bench::{PlanRow, PredictorRow, SuiteErrors, SuiteKind, TradeOffReport};
use crate::judge::Summary;

use super::{
    chart::{Axis, Chart, Mark, Series},
    number::{fine_millimetres, seconds},
    table::{Align, NONE, Table},
};

/// Families of levels: name, and how the names of their models begin.
const FAMILIES: [(&str, &[&str]); 5] = [
    ("network", &["network"]),
    ("prior alone", &["prior"]),
    ("planar simulation", &["planar"]),
    ("3-D simulation", &["3d"]),
    ("without physics", &["projection", "follow", "still"]),
];

/// What stands in the last column for a level on the front.
const FRONT: &str = "yes";

/// What was measured, in a line or two.
pub fn tradeoff_line(report: &TradeOffReport) -> String {
    let counts = &report.counts;
    format!(
        "{} held-out pushes of each kind, {} tasks of seed {}; processor time of one thread, which \
         reaches {:.0} GFLOP/s in matrix products; the median round of {} is {:.0} % slower than \
         the fastest, which counts",
        counts.pushes,
        counts.tasks,
        counts.seed,
        report.gigaflops,
        counts.rounds,
        1e2 * report.push_noise
    )
}

/// Errors and cost of every predictor; the first row is the truth against itself.
pub fn tradeoff_predictors(report: &TradeOffReport) -> Table {
    let mut table = Table::new([
        ("predictor", Align::Left),
        ("mean", Align::Right),
        ("median", Align::Right),
        ("p95", Align::Right),
        ("touching, mean", Align::Right),
        ("median", Align::Right),
        ("p95", Align::Right),
        ("mean against 3-D", Align::Right),
        ("a push", Align::Right),
        ("alone", Align::Right),
        ("front", Align::Left),
    ]);
    let spread = error_cells(&report.spread);
    let mut row = |name: &str, errors: [String; 7], costs: [String; 2], front: &str| {
        let [a, b, c, d, e, f, g] = errors;
        let [push, alone] = costs;
        table.row([name.to_owned(), a, b, c, d, e, f, g, push, alone, front.to_owned()]);
    };
    row("planar, start off by 0.1 mm", spread, [NONE; 2].map(str::to_owned), "");
    for level in &report.predictors {
        let costs = [Some(level.seconds), level.seconds_alone].map(time);
        row(
            &level.model,
            error_cells(&level.suites),
            costs,
            if level.on_front { FRONT } else { "" },
        );
    }
    table
}

/// Cost of a push by number of objects, beside the planar engine's.
pub fn tradeoff_objects(report: &TradeOffReport) -> Table {
    let mut table = Table::new([
        ("objects", Align::Right),
        ("predictor", Align::Left),
        ("a push", Align::Right),
        ("planar at 1/240 takes", Align::Right),
    ]);
    for cost in &report.objects {
        table.row([
            cost.objects.to_string(),
            cost.model.clone(),
            seconds(cost.seconds),
            format!("{:.2} times", cost.planar_ratio),
        ]);
    }
    table
}

/// Success and cost of every level of planning, cheapest first.
pub fn tradeoff_plans(report: &TradeOffReport) -> Table {
    let mut table = Table::new([
        ("level", Align::Left),
        ("reached, predicted", Align::Right),
        ("reached, planar", Align::Right),
        ("solved, 3-D", Align::Right),
        ("error in 3-D, mean", Align::Right),
        ("median", Align::Right),
        ("p95", Align::Right),
        ("rollouts", Align::Right),
        ("verified", Align::Right),
        ("a task", Align::Right),
        ("verification", Align::Right),
        ("front", Align::Left),
    ]);
    let mut rows: Vec<&PlanRow> = report.plans.iter().collect();
    rows.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    for row in rows {
        table.row([
            row.level.name.clone(),
            percent(row.predicted),
            percent(row.planar),
            percent(row.success),
            pick(&row.error, |errors| errors.mean),
            pick(&row.error, |errors| errors.median),
            pick(&row.error, |errors| errors.p95),
            format!("{:.0}", row.rollouts),
            format!("{:.1}", row.verified),
            seconds(row.seconds),
            seconds(row.verification),
            if row.on_front { FRONT.to_owned() } else { String::new() },
        ]);
    }
    table
}

/// What each effort stands for, costs and gives.
pub fn tradeoff_efforts(report: &TradeOffReport) -> Table {
    let mut table = Table::new([
        ("effort", Align::Left),
        ("level", Align::Left),
        ("solved, 3-D", Align::Right),
        ("error in 3-D, median", Align::Right),
        ("p95", Align::Right),
        ("processor time a task", Align::Right),
    ]);
    for (effort, choice) in &report.efforts {
        let Some(row) = report.plans.iter().find(|row| row.level.name == choice.name) else {
            continue;
        };
        table.row([
            format!("`{effort}`"),
            choice.name.clone(),
            percent(row.success),
            pick(&row.error, |errors| errors.median),
            pick(&row.error, |errors| errors.p95),
            seconds(row.seconds),
        ]);
    }
    table
}

/// Error against cost of a push, with the front.
pub fn tradeoff_push_chart(report: &TradeOffReport) -> Chart {
    // The truth has no error against itself; what it is good for is its own spread.
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
        Axis::log("mean error against the planar truth, mm"),
        &points.collect::<Vec<Dot>>(),
        true,
    )
}

/// Failures against cost of a task, with the front; the efforts carry their names.
pub fn tradeoff_task_chart(report: &TradeOffReport) -> Chart {
    let points = report.plans.iter().map(|row| {
        let chosen = report.efforts.iter().filter(|(_, choice)| choice.name == row.level.name);
        let efforts: Vec<String> = chosen.map(|(effort, _)| effort.to_string()).collect();
        Dot {
            model: row.level.model.to_string(),
            label: efforts.join(", "),
            at: [row.seconds, 1e2 * row.success],
            front: row.on_front,
        }
    });
    chart(
        "Speed against success of planning",
        Axis::log("processor time of a task, s"),
        Axis::linear("tasks solved in 3-D, %"),
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
    for (name, beginnings) in FAMILIES {
        let members: Vec<&Dot> = dots
            .iter()
            .filter(|dot| beginnings.iter().any(|beginning| dot.model.starts_with(beginning)))
            .collect();
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

/// Mean, median and p95 of one object and of touching ones; the mean of one against 3-D.
fn error_cells(suites: &[SuiteErrors]) -> [String; 7] {
    let cell = |kind: SuiteKind, value: fn(&Summary) -> f64| {
        errors_of(suites, kind).map_or(NONE.to_owned(), |errors| fine_millimetres(value(errors)))
    };
    let against = suites.iter().find(|errors| errors.suite == SuiteKind::Single);
    let against = against.and_then(|errors| errors.position_3d.as_ref());
    let [single, touching] = [SuiteKind::Single, SuiteKind::Touching]
        .map(|kind| [cell(kind, |e| e.mean), cell(kind, |e| e.median), cell(kind, |e| e.p95)]);
    let [a, b, c] = single;
    let [d, e, f] = touching;
    [a, b, c, d, e, f, against.map_or(NONE.to_owned(), |errors| fine_millimetres(errors.mean))]
}

fn pick(summary: &Option<Summary>, value: impl Fn(&Summary) -> f64) -> String {
    summary.as_ref().map_or(NONE.to_owned(), |summary| fine_millimetres(value(summary)))
}

fn time(value: Option<f64>) -> String {
    value.map_or(NONE.to_owned(), seconds)
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 1e2 * share)
}
