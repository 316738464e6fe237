//! The extremes as a Markdown page.

use pushplan_act::judge::Summary;
use pushplan_report::{Align, NONE, Table, millimetres};

use super::Extremes;
use super::cell::{Cell, Kind};
use super::judged::{Judged, Verdict, Yardstick};
use super::tasks::TaskCell;

/// Returns all tables in Markdown, each below its title.
pub fn page(extremes: &Extremes) -> String {
    let tables = [
        ("Ordinary pushes", yardstick_table(&extremes.yardsticks)),
        ("Cells by extreme", extreme_table(&extremes.cells)),
        ("All cells", cell_table(&extremes.cells)),
        ("Tasks", task_table(&extremes.tasks)),
    ];
    let tables = tables.map(|(title, table)| format!("{title}:\n\n{}", table.to_markdown()));
    format!("{}.\n\n{}", line(extremes), tables.join("\n"))
}

/// Returns all cells as lines of a file.
pub fn csv(extremes: &Extremes) -> String {
    cell_table(&extremes.cells).to_csv()
}

/// Returns extreme, value and objects of a cell as they begin its line in [`csv`].
pub fn beginning(cell: &Cell) -> String {
    let mut table = Table::new(["extreme", "value", "on"].map(|name| (name, Align::Left)));
    table.row(named(cell));
    table.to_csv().lines().nth(1).unwrap_or_default().to_owned()
}

/// Extreme, value and objects of a cell; the sign is of cells whose truth is doubted.
fn named(cell: &Cell) -> [String; 3] {
    let doubt = if cell.doubt.is_some() { " \u{2020}" } else { "" };
    [cell.factor.to_owned(), format!("{}{doubt}", cell.value), on(cell.kind).to_owned()]
}

fn line(extremes: &Extremes) -> String {
    let Extremes { model, seed, pushes, .. } = extremes;
    let defects = match extremes.defects() {
        0 => "no defects".to_owned(),
        1 => "1 defect".to_owned(),
        count => format!("{count} defects"),
    };
    let cells = extremes.cells.len() + extremes.tasks.len();
    format!("{model}: {cells} cells, {pushes} pushes each of seed {seed}; {defects}")
}

fn yardstick_table(yardsticks: &[Yardstick]) -> Table {
    let mut table = Table::new([
        ("ordinary pushes", Align::Left),
        ("pushes", Align::Right),
        ("motion", Align::Right),
        ("mean", Align::Right),
        ("p95", Align::Right),
        ("wrong", Align::Right),
    ]);
    for stick in yardsticks {
        let title = match stick.kind {
            Kind::Cylinder => "cylinder",
            Kind::Cuboid => "cuboid",
            Kind::Several => "three touching",
            Kind::Jointed => "three joined",
        };
        table.row([
            title.to_owned(),
            stick.error.count.to_string(),
            short(stick.motion.mean),
            short(stick.error.mean),
            short(stick.error.p95),
            format!("{:.1} %", 100.0 * stick.wrong),
        ]);
    }
    table
}

/// Numbers of cells with each verdict, by extreme.
fn extreme_table(cells: &[(Cell, Judged)]) -> Table {
    let names = VERDICTS.map(|verdict| (title(verdict), Align::Right));
    let columns = [("extreme", Align::Left)].into_iter().chain(names);
    let mut table = Table::new(columns);
    let mut extremes: Vec<&str> = Vec::new();
    for (cell, _) in cells {
        if !extremes.contains(&cell.factor) {
            extremes.push(cell.factor);
        }
    }
    for extreme in extremes {
        let own = || cells.iter().filter(|(cell, _)| cell.factor == extreme);
        let count = |verdict| own().filter(|(_, judged)| judged.verdict == verdict).count();
        let counts = VERDICTS.map(|verdict| count(verdict).to_string());
        table.row([extreme.to_owned()].into_iter().chain(counts));
    }
    table
}

fn cell_table(cells: &[(Cell, Judged)]) -> Table {
    let mut table = Table::new([
        ("extreme", Align::Left),
        ("value", Align::Left),
        ("on", Align::Left),
        ("motion", Align::Right),
        ("error, mean", Align::Right),
        ("p95", Align::Right),
        ("ground-truth spread, mean", Align::Right),
        ("wrong", Align::Right),
        ("undecided", Align::Right),
        ("flagged", Align::Right),
        ("of", Align::Right),
        ("verdict", Align::Left),
        ("warnings", Align::Left),
        ("doubt", Align::Left),
    ]);
    for (cell, judged) in cells {
        let of = |summary: &Option<Summary>, value: fn(&Summary) -> f64| {
            summary.as_ref().map_or(NONE.to_owned(), |summary| short(value(summary)))
        };
        let [factor, value, on] = named(cell);
        table.row([
            factor,
            value,
            on,
            of(&judged.motion, |summary| summary.mean),
            of(&judged.error, |summary| summary.mean),
            of(&judged.error, |summary| summary.p95),
            of(&judged.own, |summary| summary.mean),
            judged.wrong.to_string(),
            judged.undecided.to_string(),
            judged.flagged.to_string(),
            judged.pushes.to_string(),
            verdict(judged),
            judged.warnings.join("; "),
            cell.doubt.map_or_else(String::new, |doubt| doubt.why.to_owned()),
        ]);
    }
    table
}

fn task_table(cells: &[TaskCell]) -> Table {
    let mut table = Table::new([
        ("task", Align::Left),
        ("status", Align::Left),
        ("pushes", Align::Right),
        ("predicted error", Align::Right),
        ("rollouts", Align::Right),
        ("verdict", Align::Left),
    ]);
    for cell in cells {
        let status = cell.status.map(|status| words(&format!("{status:?}")));
        table.row([
            cell.name.to_owned(),
            status.unwrap_or_else(|| "refused".to_owned()),
            cell.pushes.map_or(NONE.to_owned(), |pushes| pushes.to_string()),
            cell.error.map_or(NONE.to_owned(), short),
            cell.rollouts.to_string(),
            if cell.sound { "sound" } else { "DEFECT" }.to_owned(),
        ]);
    }
    table
}

fn on(kind: Kind) -> &'static str {
    match kind {
        Kind::Cylinder => "cylinder",
        Kind::Cuboid => "cuboid",
        Kind::Several => "several",
        Kind::Jointed => "joined",
    }
}

/// Verdicts in the order of columns.
const VERDICTS: [Verdict; 5] = [
    Verdict::Right,
    Verdict::RightFlagged,
    Verdict::WrongFlagged,
    Verdict::Undecided,
    Verdict::Defect,
];

fn title(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Right => "right",
        Verdict::RightFlagged => "right, flagged",
        Verdict::WrongFlagged => "wrong, flagged",
        Verdict::Undecided => "no ground truth, flagged",
        Verdict::Defect => "DEFECT",
    }
}

fn verdict(judged: &Judged) -> String {
    let title = title(judged.verdict);
    if judged.finite < judged.pushes {
        format!("{title}, {} not finite", judged.pushes - judged.finite)
    } else if judged.bounded < judged.pushes {
        format!("{title}, {} thrown", judged.pushes - judged.bounded)
    } else {
        title.to_owned()
    }
}

/// Converts `NoPlan` to `no plan`.
fn words(name: &str) -> String {
    let mut words = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !words.is_empty() {
            words.push(' ');
        }
        words.extend(letter.to_lowercase());
    }
    words
}

/// Formats a length from micrometres upwards.
fn short(metres: f64) -> String {
    if metres >= 10.0 {
        format!("{metres:.3e} m")
    } else if metres < 0.00995 {
        format!("{:.2} mm", metres * 1e3)
    } else {
        millimetres(metres)
    }
}
