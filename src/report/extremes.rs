//! The extremes as tables, and as the Markdown page that stands beside the model card.

use crate::bench::{
    ExtremeCell, ExtremeKind, ExtremeYardstick, ExtremesReport, ProgrammeCell, Summary, TaskCell,
};

use super::number::millimetres;
use super::table::{Align, Table};

const NONE: &str = "\u{2013}";

/// How cells are judged, in words.
pub const EXTREMES_RULE: &str = "\
Every cell is a set of pushes that have one extreme in common; everything else is a 10 cm object of
400 g and friction 0.4 on a table of 0.5, or two or three of them, pushed 20 cm at 0.1 m/s by the
shipped tools in turn. The error of a push is that of the object that is farthest off: its centre's
distance from where the planar engine leaves it and, for a cuboid, its turn times its mean radius,
added as squares. A push is wrong if its error exceeds 3 times the 95th percentile of ordinary
pushes of its kind, 5 % of the true motion, and 3 times what the truth itself changes by when its
time step is halved or its start shifted by 0.1 mm; if only the last is not met it is undecided.
Ordinary pushes break the rule now and then, too (last column of the first table), so a cell is
wrong when more than a tenth of its pushes are. Flagged is a push that the model warned of, before
the rollout or during it. A cell is a DEFECT if more than a tenth of its pushes are wrong and not
flagged, if an answer is not finite, or if an object ends farther away than the tool could send it.
Where the engine itself is known to be wrong (\u{2020}) every push must be flagged; in front of a wall
that is where the object truly touches both tool and wall.
";

/// What the cells are measured by.
pub fn yardstick_table(yardsticks: &[ExtremeYardstick]) -> Table {
    let mut table = Table::new([
        ("ordinary pushes", Align::Left),
        ("pushes", Align::Right),
        ("motion", Align::Right),
        ("mean", Align::Right),
        ("p95", Align::Right),
        ("wrong", Align::Right),
    ]);
    for stick in yardsticks {
        table.row([
            stick.kind.title().to_owned(),
            stick.error.count.to_string(),
            short(stick.motion.mean),
            short(stick.error.mean),
            short(stick.error.p95),
            format!("{:.1} %", 100.0 * stick.wrong),
        ]);
    }
    table
}

/// The rollouts, one row a cell.
pub fn extremes_table(cells: &[ExtremeCell]) -> Table {
    let mut table = Table::new([
        ("extreme", Align::Left),
        ("value", Align::Left),
        ("on", Align::Left),
        ("motion", Align::Right),
        ("error, mean", Align::Right),
        ("p95", Align::Right),
        ("truth's own, mean", Align::Right),
        ("wrong", Align::Right),
        ("undecided", Align::Right),
        ("flagged", Align::Right),
        ("of", Align::Right),
        ("verdict", Align::Left),
        ("warnings", Align::Left),
    ]);
    for cell in cells {
        let of = |summary: &Option<Summary>, value: fn(&Summary) -> f64| {
            summary.as_ref().map_or(NONE.to_owned(), |summary| short(value(summary)))
        };
        let mut verdict = cell.verdict.title().to_owned();
        if cell.finite < cell.pushes {
            verdict += &format!(", {} not finite", cell.pushes - cell.finite);
        } else if cell.bounded < cell.pushes {
            verdict += &format!(", {} thrown", cell.pushes - cell.bounded);
        }
        let doubt = if cell.doubt.is_some() { " \u{2020}" } else { "" };
        table.row([
            cell.factor.clone(),
            format!("{}{doubt}", cell.value),
            on(cell.kind).to_owned(),
            of(&cell.motion, |summary| summary.mean),
            of(&cell.error, |summary| summary.mean),
            of(&cell.error, |summary| summary.p95),
            of(&cell.own, |summary| summary.mean),
            cell.wrong.to_string(),
            cell.undecided.to_string(),
            cell.flagged.to_string(),
            cell.pushes.to_string(),
            verdict,
            cell.warnings.join("; "),
        ]);
    }
    table
}

/// The quadratic programmes.
pub fn programme_table(cells: &[ProgrammeCell]) -> Table {
    let mut table = Table::new([
        ("quadratic programme", Align::Left),
        ("status", Align::Left),
        ("violation", Align::Right),
        ("above the minimum", Align::Right),
        ("verdict", Align::Left),
    ]);
    for cell in cells {
        let number =
            |value: Option<f64>| value.map_or(NONE.to_owned(), |value| format!("{value:.0e}"));
        table.row([
            cell.name.clone(),
            words(&format!("{:?}", cell.status)),
            number(cell.violation),
            number(cell.excess),
            sound(cell.sound),
        ]);
    }
    table
}

/// The tasks.
pub fn extreme_task_table(cells: &[TaskCell]) -> Table {
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
            cell.name.clone(),
            status.unwrap_or_else(|| "refused".to_owned()),
            cell.pushes.map_or(NONE.to_owned(), |pushes| pushes.to_string()),
            cell.error.map_or(NONE.to_owned(), short),
            cell.rollouts.to_string(),
            sound(cell.sound),
        ]);
    }
    table
}

/// One line: how many cells, how many defects.
pub fn extremes_line(report: &ExtremesReport) -> String {
    let cells = report.cells.len() + report.programmes.len() + report.tasks.len();
    let defects = report.defects();
    format!(
        "{}: {cells} cells, {} pushes each of seed {}; {}",
        report.model,
        report.pushes,
        report.seed,
        match defects {
            0 => "no defects".to_owned(),
            1 => "1 defect".to_owned(),
            _ => format!("{defects} defects"),
        }
    )
}

/// The page beside the model card; `command` made it.
pub fn extremes_page(report: &ExtremesReport, command: &str) -> String {
    let mut doubts: Vec<&str> = report.cells.iter().filter_map(|c| c.doubt.as_deref()).collect();
    doubts.sort_unstable();
    doubts.dedup();
    let doubts: String = doubts.iter().map(|doubt| format!("- \u{2020} {doubt}\n")).collect();
    format!(
        "# At the extremes\n\n{}.\n\n```sh\n{command}\n```\n\n{EXTREMES_RULE}\n{}\n{}\n{doubts}\n\
         ## Quadratic programmes\n\nOne solver for all of them, as in refinement; the minimum is \
         that of coordinate descent.\n\n{}\n## Tasks\n\nA random solvable task made extreme, at \
         draft effort.\n\n{}",
        extremes_line(report),
        yardstick_table(&report.yardsticks).to_markdown(),
        extremes_table(&report.cells).to_markdown(),
        programme_table(&report.programmes).to_markdown(),
        extreme_task_table(&report.tasks).to_markdown(),
    )
}

fn on(kind: ExtremeKind) -> &'static str {
    match kind {
        ExtremeKind::Several => "several",
        ExtremeKind::Jointed => "joined",
        single => single.title(),
    }
}

fn sound(sound: bool) -> String {
    if sound { "sound" } else { "DEFECT" }.to_owned()
}

/// `NoPlan` as `no plan`.
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

/// A length from micrometres to whatever.
fn short(metres: f64) -> String {
    if metres >= 10.0 {
        format!("{metres:.3e} m")
    } else if metres < 0.00995 {
        format!("{:.2} mm", metres * 1e3)
    } else {
        millimetres(metres)
    }
}
