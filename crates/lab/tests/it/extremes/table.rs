//! The extremes as a Markdown page.

use pushplan_act::judge::Summary;
use pushplan_report::{Align, NONE, Table, millimetres};

use super::Extremes;
use super::cell::{Cell, Kind};
use super::judged::{Judged, Verdict, Yardstick};
use super::tasks::TaskCell;

/// Rule by which cells are judged.
const RULE: &str = "\
A cell is a set of pushes with one extreme in common. Otherwise, one to three 10 cm objects (400 g,
friction 0.4, table friction 0.5) are pushed 20 cm at 0.1 m/s by the shipped tools in turn. The
error of a push is the maximum over its objects. It combines as squares the distance of the centre
from its position in the 2-D engine and, for a cuboid, the rotation error times its mean radius. A
push is wrong if its error exceeds three limits: 3 times the 95th percentile of ordinary pushes of
its kind, 5 % of the true motion, and 3 times the spread of the ground truth. This spread is its
change if the time step is halved or the start shifted by 0.1 mm. If the error exceeds only the
first two limits, the push is undecided. Some ordinary pushes are wrong, too (last column of the
first table), so a cell is wrong if more than a tenth of its pushes are. A push is flagged if the
model warned before or during the rollout. A cell is a DEFECT in three cases: more than a tenth of
its pushes are wrong and not flagged, a prediction is not finite, or an object ends farther away
than the tool could send it. If the engine itself is known to be wrong (\u{2020}), every push must
be flagged; in front of a wall, this holds if the object truly touches both tool and wall.
";

/// Returns the page, with the `command` that writes it.
pub fn page(extremes: &Extremes, command: &str) -> String {
    let mut doubts: Vec<&str> =
        extremes.cells.iter().filter_map(|(cell, _)| Some(cell.doubt?.why)).collect();
    doubts.sort_unstable();
    doubts.dedup();
    let doubts: String = doubts.iter().map(|doubt| format!("- \u{2020} {doubt}\n")).collect();
    format!(
        "# At the extremes\n\n{}.\n\n```sh\n{command}\n```\n\n{RULE}\n{}\n{}\n{doubts}\n\
         ## Tasks\n\nEach row is a random solvable task with an extreme value, at draft \
         effort.\n\n{}",
        line(extremes),
        yardstick_table(&extremes.yardsticks).to_markdown(),
        cell_table(&extremes.cells).to_markdown(),
        task_table(&extremes.tasks).to_markdown(),
    )
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
    ]);
    for (cell, judged) in cells {
        let of = |summary: &Option<Summary>, value: fn(&Summary) -> f64| {
            summary.as_ref().map_or(NONE.to_owned(), |summary| short(value(summary)))
        };
        let doubt = if cell.doubt.is_some() { " \u{2020}" } else { "" };
        table.row([
            cell.factor.to_owned(),
            format!("{}{doubt}", cell.value),
            on(cell.kind).to_owned(),
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

fn verdict(judged: &Judged) -> String {
    let title = match judged.verdict {
        Verdict::Right => "right",
        Verdict::RightFlagged => "right, flagged",
        Verdict::WrongFlagged => "wrong, flagged",
        Verdict::Undecided => "no ground truth, flagged",
        Verdict::Defect => "DEFECT",
    };
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
