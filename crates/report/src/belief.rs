//! Belief after a recording: which objects are joined, since when, and how the belief changed.

use serde_json::json;

use pushplan::scene::{JOINABLE, Joint, JointKind, Span};
use pushplan_act::belief::{Belief, JointType, MassShares, NO_STOP};

use super::chart::{Axis, Chart, Mark, Series};
use super::document::{Document, Drawing, Figure, Section};
use super::number::{degrees, millimetres};
use super::plan_text::point;
use super::table::{
    Align::{Left, Right},
    NONE, Table,
};

/// Half width of the central 90 % interval of a normal distribution, in standard deviations.
const NINE_IN_TEN: f64 = 1.645;

/// Returns a report on the belief about the objects called `names` after the recording `title`.
/// `ranges` are the candidate mass ranges, kg; empty if masses were not inferred.
pub fn belief_document(title: &str, belief: &Belief, names: &[&str], ranges: &[Span]) -> Document {
    let now = belief.situation();
    let probabilities = belief.probabilities();
    let name = |[a, b]: [usize; 2]| format!("{} and {}", names[a], names[b]);
    let joint = |between: [usize; 2]| now.physics.joints.iter().find(|j| j.between == between);
    let rows: Vec<(usize, [usize; 2])> = belief.pairs().enumerate().collect();
    let probability = |k: usize| move |shares: &[f64; 4]| format!("{:.1} %", 1e2 * shares[k]);
    let mut table = Table::new([
        ("objects", Left),
        ("none", Right),
        ("fixed", Right),
        ("revolute", Right),
        ("prismatic", Right),
        ("assumed joint", Left),
        ("axis at the end", Left),
        ("since observation", Right),
    ]);
    for (p, between) in &rows {
        let shares = &probabilities[*p];
        let taken = joint(*between);
        let mut cells = vec![name(*between)];
        cells.extend((0..4).map(|k| probability(k)(shares)));
        cells.push(JointType::of(taken).to_string());
        cells.push(taken.map_or(NONE.to_owned(), place));
        cells.push(since(belief, *p).map_or(NONE.to_owned(), |seen| seen.to_string()));
        table.row(cells);
    }
    let observations = belief.history().last().map_or(0, |step| step.observations);
    let pairs = match rows.len() {
        1 => "1 pair is".to_owned(),
        count => format!("{count} pairs are"),
    };
    let title = format!("{title}: {observations} observations; {pairs} close enough to be joined");
    let note = nothing_to_infer(names.len(), rows.len());
    let mut sections = vec![match &note {
        Some(note) => Section { lines: vec![note.clone()], ..Section::default() },
        None => Section { table, figures: vec![over_time(belief, &name)], ..Section::default() },
    }];
    let masses = belief.mass_shares();
    if let Some(masses) = &masses {
        sections.extend(mass_sections(masses, names, ranges));
    }
    let mut json = json!({
        "objects": names,
        "pairs": rows.iter().map(|(_, between)| between).collect::<Vec<_>>(),
        "types": JointType::ALL,
        "probabilities": probabilities,
        "joints": now.physics.joints,
        "history": belief.history(),
        "note": note,
    });
    if let Some(masses) = masses {
        json["masses"] = json!({
            "ranges": ranges.iter().map(|range| [range.low, range.high]).collect::<Vec<_>>(),
            "objects": masses.objects,
            "ratios": masses.ratios,
        });
    }
    Document { title, sections, json, ..Document::default() }
}

/// Returns a note if a recording with these numbers of objects and of near pairs holds no joint to
/// infer.
fn nothing_to_infer(objects: usize, pairs: usize) -> Option<String> {
    let why = match objects {
        _ if pairs > 0 => return None,
        1 => "the recording has a single object".to_owned(),
        _ => format!("no two objects start within {} of each other", millimetres(JOINABLE)),
    };
    Some(format!("no joints to infer: {why}; `pushplan fit` finds support and friction"))
}

/// Returns the probabilities of mass ranges, and the mass ratios of objects that touched.
fn mass_sections(masses: &MassShares, names: &[&str], ranges: &[Span]) -> Vec<Section> {
    let titles: Vec<String> =
        ranges.iter().map(|range| format!("{} to {} kg", range.low, range.high)).collect();
    let mut columns = vec![("object", Left)];
    columns.extend(titles.iter().map(|title| (title.as_str(), Right)));
    columns.push(("known", Left));
    let mut table = Table::new(columns);
    for (name, shares) in names.iter().zip(&masses.objects) {
        let mut cells = vec![(*name).to_owned()];
        let shares_of = |share: &f64| format!("{:.1} %", 1e2 * share);
        cells.extend(
            (0..ranges.len())
                .map(|k| shares.as_ref().map_or(NONE.to_owned(), |shares| shares_of(&shares[k]))),
        );
        let known = if shares.is_some() { "by contacts" } else { "no: no contact" };
        cells.push(known.to_owned());
        table.row(cells);
    }
    let mut sections = vec![Section { title: "Masses".into(), table, ..Section::default() }];
    if !masses.ratios.is_empty() {
        let mut table =
            Table::new([("objects", Left), ("mass ratio", Right), ("90 % interval", Right)]);
        for ratio in &masses.ratios {
            let [a, b] = ratio.between.map(|k| names[k]);
            let [mean, sd] = ratio.log;
            let [low, high] = [-NINE_IN_TEN, NINE_IN_TEN].map(|far| (mean + far * sd).exp());
            let cells = [
                format!("{a} to {b}"),
                format!("{:.2}", mean.exp()),
                format!("{low:.2} to {high:.2}"),
            ];
            table.row(cells);
        }
        sections.push(Section { title: "Mass ratios".into(), table, ..Section::default() });
    }
    sections
}

/// Formats the position of a joint at the last observed poses.
fn place(joint: &Joint) -> String {
    match joint.kind {
        JointKind::Fixed => NONE.to_owned(),
        JointKind::Revolute { at, limits } => {
            let left = stops(limits, NO_STOP[0], degrees);
            format!("at {}{left}", point(at))
        }
        JointKind::Prismatic { axis, limits } => {
            let left = stops(limits, NO_STOP[1], |far| format!("{} mm", (1e3 * far).round() + 0.0));
            format!("along {}{left}", degrees(axis.y.atan2(axis.x)))
        }
    }
}

/// Formats the remaining travel of a joint on each side with an observed limit.
fn stops(limits: Option<Span>, free: f64, unit: impl Fn(f64) -> String) -> String {
    let Some(limits) = limits else { return String::new() };
    let sides = [limits.low, limits.high].into_iter().filter(|far| far.abs() < free);
    let sides: Vec<String> = sides.map(unit).collect();
    format!(", remaining travel {}", sides.join(" and "))
}

/// Returns the index of the most probable joint type.
fn likeliest(shares: &[f64; 4]) -> usize {
    (0..4).max_by(|&a, &b| shares[a].total_cmp(&shares[b])).unwrap_or(0)
}

/// Returns the observation since which the most probable type of a pair is unchanged; `None` if
/// neither object moved.
fn since(belief: &Belief, pair: usize) -> Option<usize> {
    let history = belief.history();
    history.iter().find(|step| step.evidence[pair].is_some())?;
    let last = likeliest(&history.last()?.probabilities[pair]);
    let same = history.iter().rev().take_while(|step| likeliest(&step.probabilities[pair]) == last);
    same.last().map(|step| step.observations)
}

/// Plots, for every pair, the probability over time of its final most probable type.
fn over_time(belief: &Belief, name: &dyn Fn([usize; 2]) -> String) -> Figure {
    let probabilities = belief.probabilities();
    let series = belief.pairs().enumerate().map(|(p, between)| {
        let last = likeliest(&probabilities[p]);
        let points = belief
            .history()
            .iter()
            .map(|step| [step.observations as f64, 1e2 * step.probabilities[p][last]]);
        Series {
            name: format!("{}: {}", name(between), JointType::ALL[last]),
            points: points.collect(),
            mark: Mark::Line,
            labels: Vec::new(),
        }
    });
    let chart = Chart {
        title: "Probability of the final joint estimate".into(),
        x: Axis { label: "observations".into(), log: false },
        y: Axis { label: "probability, %".into(), log: false },
        series: series.collect(),
    };
    Figure { name: "belief".into(), drawing: Drawing::Chart(chart) }
}
