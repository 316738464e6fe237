//! Report on parameters fitted to recordings: estimates, their uncertainty, and a posterior plot.

use serde_json::json;

use pushplan::geometry::Vector;
use pushplan::scene::TableFit;
use pushplan_act::fit::{Estimate, Fit, Posterior, SupportError};

use super::chart::{CORNER, FAINT_INK, INK, SIZE};
use super::document::{Document, Figure, Section};
use super::number::{fine_millimetres, millimetres};
use super::svg::{Anchor, Font, Style, Svg};
use super::table::{
    Align::{Left, Right},
    Table,
};

/// Colour of the most probable cell in the plot.
const DARK: &str = "#0072b2";

/// Smallest probability that is drawn, relative to the most probable cell.
const FAINTEST: f64 = 0.004;

/// Returns a report on the fit, its remaining errors, and lines to paste into a file. `objects` are
/// the names of the fitted objects, which share all values.
pub fn fit_document(fit: &Fit, objects: &[&str]) -> Document {
    let rows = [("spread", &fit.spread), ("friction with the pusher", &fit.friction)];
    let numbers = Table::of(
        rows,
        &[
            ("", Left, &|(name, _)| (*name).to_owned()),
            ("most likely", Right, &|(_, it)| format!("{:.3}", it.best)),
            ("mean", Right, &|(_, it)| format!("{:.3}", it.mean)),
            ("std. deviation", Right, &|(_, it)| format!("{:.3}", it.deviation)),
            ("90 % interval", Right, &|(_, it)| {
                format!("{:.3} to {:.3}", it.interval.low, it.interval.high)
            }),
            ("evidence", Left, &|(_, it)| identification(it).to_owned()),
        ],
    );
    let share = |error: &SupportError| {
        format!("{:.1} %", 1e2 * error.mean / fit.motion.max(f64::MIN_POSITIVE))
    };
    let errors = Table::of(
        [("as fitted", &fit.best), ("even", &fit.even), ("corners", &fit.corners)],
        &[
            ("support", Left, &|(name, _)| (*name).to_owned()),
            ("friction", Right, &|(_, error)| format!("{:.2}", error.friction)),
            ("mean error", Right, &|(_, error)| fine_millimetres(error.mean)),
            ("median", Right, &|(_, error)| fine_millimetres(error.median)),
            ("of motion", Right, &|(_, error)| share(error)),
        ],
    );
    let identified = fit.identified_spread().is_some();
    let friction = if identified { fit.friction.mean } else { fit.stated.friction };
    let mut lines = vec![match identified {
        true => format!("The friction {friction:.2} holds together with this spread."),
        false => format!(
            "The recordings do not identify a spread, so the friction {friction:.2} is the one for \
             the supports as stated."
        ),
    }];
    lines.extend(identified.then(|| format!("support: {{spread: {:.2}}}", fit.spread.mean)));
    lines.push("frictions:".into());
    lines.extend(
        objects
            .iter()
            .map(|object| format!("  - {{between: [{object}, tool], coefficient: {friction:.2}}}")),
    );
    let noise = match fit.settings.noise {
        Some(_) => "stated",
        None => "estimated",
    };
    let title = format!(
        "{}: {} recordings, {} objects move by {} on average; noise of {} ({noise})",
        fit.by,
        fit.recordings,
        fit.moved,
        millimetres(fit.motion),
        fine_millimetres(fit.noise),
    );
    let picture = Figure::svg("posterior", picture(&fit.fine));
    Document {
        title,
        sections: vec![
            Section { table: numbers, figures: vec![picture], ..Section::default() },
            Section {
                title: "Errors, each with its best-fitting friction".into(),
                table: errors,
                ..Section::default()
            },
            Section {
                title: "For an object of a task or recording, and for its scene".into(),
                lines,
                ..Section::default()
            },
        ],
        json: json!({"fit": fit, "friction": friction}),
        ..Document::default()
    }
}

/// Returns a section on the network parameters that were learned with this fit.
pub fn table_fit_section(fit: &TableFit) -> Section {
    let changed = fit.head.iter().any(|value| *value != 0.0);
    let head = match changed {
        true => format!(
            "{} parameters learned from {} pushes, with a prior standard deviation of {:.2}.",
            fit.head.len(),
            fit.pushes,
            fit.spread.prior
        ),
        false => "No parameters learned: held-out pushes are not predicted better.".to_owned(),
    };
    let support = match fit.support {
        Some(spread) => format!("support spread {spread:.2}"),
        None => "support as stated".to_owned(),
    };
    let friction = match fit.friction {
        Some(friction) => format!("friction with the tool {friction:.2}"),
        None => "friction as stated".to_owned(),
    };
    let noise = format!("noise of {}", fine_millimetres(fit.noise));
    Section {
        title: "The network on this table".into(),
        lines: vec![head, format!("With the network: {support}, {friction}, {noise}.")],
        ..Section::default()
    }
}

fn identification(estimate: &Estimate) -> &'static str {
    match (estimate.identified, estimate.at_the_end) {
        (true, false) => "clear",
        (true, true) => "clear, but the best value is the end of the range",
        (false, _) => "weak: the posterior is nearly as wide as the range",
    }
}

/// Draws the posterior as shaded cells: spread from left to right, friction upwards.
fn picture(posterior: &Posterior) -> String {
    let grid = posterior.grid;
    let title = "Posterior of spread and friction";
    let mut svg = Svg::new(CORNER.x + SIZE.x + 24.0, CORNER.y + SIZE.y + 52.0, title);
    svg.text(Vector::new(CORNER.x, 26.0), title, Font::new(16.0, INK).bold());
    svg.rect(CORNER, SIZE, 0.0, Style::fill("#fbfcfd").outlined("#dee2e6", 1.0));
    let (columns, rows) = (grid.spread.count, grid.friction.count);
    let cell = Vector::new(SIZE.x / columns as f64, SIZE.y / rows as f64);
    let most = posterior.probabilities[posterior.best()];
    for column in 0..columns {
        for row in 0..rows {
            let share = posterior.probabilities[grid.index(column, row)] / most;
            if share > FAINTEST {
                let place = Vector::new(column as f64 * cell.x, SIZE.y - (row + 1) as f64 * cell.y);
                svg.rect(CORNER + place, cell, 0.0, Style::fill(DARK).opacity(share));
            }
        }
    }
    let font = Font::new(11.0, FAINT_INK);
    let marks = 5;
    for mark in 0..marks {
        let of = |count: usize| mark * (count - 1) / (marks - 1);
        let (column, row) = (of(columns), of(rows));
        let bottom = CORNER + Vector::new((column as f64 + 0.5) * cell.x, SIZE.y + 16.0);
        let label = format!("{:.2}", grid.spread.at(column));
        svg.text(bottom, &label, font.anchored(Anchor::Middle));
        let left = CORNER + Vector::new(-8.0, SIZE.y - (row as f64 + 0.5) * cell.y + 4.0);
        svg.text(left, &format!("{:.2}", grid.friction.at(row)), font.anchored(Anchor::End));
    }
    let below = CORNER + Vector::new(SIZE.x / 2.0, SIZE.y + 38.0);
    svg.text(below, "spread, share of the corners' distance", font.anchored(Anchor::Middle));
    let beside = Vector::new(20.0, CORNER.y + SIZE.y / 2.0);
    svg.turned_text(beside, -90.0, "friction with the pusher", font.anchored(Anchor::Middle));
    svg.finish()
}
