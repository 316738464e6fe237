//! Accuracy of inferred joints, as tables and curves.

use pushplan_report::Align::{Left, Right};
use pushplan_report::{
    Align, Axis, Chart, Document, Figure, Mark, NONE, Section, Series, Table, millimetres,
};
use serde_json::json;

use crate::bench::{
    BeliefStep, BeliefSummary, CrowdFamily, JointMethod, Sighting, UpdateTimes, When,
};

/// Explanation of the columns.
const LEGEND: &str = "The pairs have a gap below 3 cm at the start, because only such pairs are \
    joined, and at least one object that has moved by more than 1 cm; *not moved* contains the \
    other pairs. The types are the most probable joints without a loop. *nll* is the mean \
    negative log probability of the true type, *calibration* the expected calibration error of \
    all four probabilities. *All ordered pairs* counts every pair of bodies, as in the thesis, \
    including far objects and the hand. Anchors and axes need a rotation by 15 degrees or a \
    translation by 2 cm.";

/// Explanation of the table of recordings.
const RECORDED: &str = "Mean distance between predicted and recorded final positions of all \
    objects. The prediction starts from the believed poses, the given number of observations \
    after the first observation with motion, and covers the remaining motion of the tool.";

/// Accuracy over all ordered pairs of sparse scenes of nine objects with mixed joints after a
/// number of frames, read off figure 4 of Tekden et al. (ICRA 2020); a stroke has about 29 frames.
const PUBLISHED: [[f64; 2]; 3] = [[50.0, 0.942], [100.0, 0.959], [240.0, 0.976]];
const FRAMES_A_STROKE: f64 = 30.0;

/// Returns the belief benchmark, with the times of updates, if known.
pub fn joints_document(summaries: &[BeliefSummary], times: &UpdateTimes) -> Document {
    let mut sections = vec![
        Section { title: "Types at the end".into(), table: types(summaries), ..Section::default() },
        Section {
            title: "Probabilities, anchors and axes".into(),
            table: sure(summaries),
            ..Section::default()
        },
        Section {
            title: "Types over time".into(),
            table: over_time(summaries),
            figures: vec![Figure::chart("joints-over-time", chart(summaries))],
            ..Section::default()
        },
    ];
    if summaries.iter().flat_map(|one| &one.steps).any(|step| !step.rest.is_empty()) {
        sections.push(Section {
            title: "Remaining motion: final error under the belief at that time".into(),
            table: rest(summaries),
            figures: rest_charts(summaries),
            ..Section::default()
        });
    }
    if !times.is_empty() {
        sections.push(Section {
            title: "Processor time per update".into(),
            table: update_table(times),
            ..Section::default()
        });
    }
    let trajectories: usize = summaries.iter().map(|one| one.trajectories).sum();
    Document {
        title: format!("Joints inferred from {trajectories} observed trajectories"),
        notes: vec![LEGEND.to_owned()],
        sections,
        json: json!({"beliefs": summaries}),
        ..Document::default()
    }
}

fn update_table(times: &UpdateTimes) -> Table {
    let mut table =
        Table::new([("set", Left), ("seen", Left), ("belief", Left), ("per observation", Right)]);
    for (case, spent) in times {
        let set = format!("{} {}", case.set.family.title(), case.set.objects);
        for (by, each) in spent {
            let time = format!("{:.1} ms", 1e3 * each);
            table.row([&set, case.sight.title(), by.title(), &time]);
        }
    }
    table
}

fn percent(share: f64) -> String {
    format!("{:.1}", 1e2 * share)
}

fn name(summary: &BeliefSummary) -> String {
    let set = &summary.case.set;
    format!("{} {}", set.family.title(), set.objects)
}

fn end(summary: &BeliefSummary) -> Option<&BeliefStep> {
    summary.steps.iter().find(|step| step.when == When::End)
}

/// Returns the methods with types, in order.
fn methods(summaries: &[BeliefSummary]) -> Vec<JointMethod> {
    let steps = summaries.iter().filter_map(end);
    let known: Vec<JointMethod> = steps.flat_map(|end| end.right.iter().map(|r| r.by)).collect();
    JointMethod::ALL.into_iter().filter(|by| known.contains(by)).collect()
}

/// Returns the methods with beliefs: the filter, and the regulator, if any.
fn believers(summaries: &[BeliefSummary]) -> Vec<JointMethod> {
    let believes = |by: &JointMethod| matches!(by, JointMethod::Filter | JointMethod::Regulator);
    methods(summaries).into_iter().filter(believes).collect()
}

fn types(summaries: &[BeliefSummary]) -> Table {
    let methods = methods(summaries);
    let believers = believers(summaries);
    let mut columns: Vec<(String, _)> =
        vec![("set".into(), Left), ("seen".into(), Left), ("pairs".into(), Right)];
    columns.extend(methods.iter().map(|by| (format!("{}, %", by.title()), Right)));
    columns.extend(believers.iter().map(|by| (format!("{}: joined, %", by.title()), Right)));
    let mut table = Table::new(columns.iter().map(|(name, align)| (name.as_str(), *align)));
    for summary in summaries {
        let Some(end) = end(summary) else { continue };
        let mut cells =
            vec![name(summary), summary.case.sight.title().to_owned(), end.pairs.to_string()];
        let of = |by: &JointMethod| end.right.iter().find(|right| right.by == *by);
        let cell = |share: Option<f64>| share.map_or(NONE.to_owned(), percent);
        cells.extend(methods.iter().map(|by| cell(of(by).map(|right| right.moved))));
        cells.extend(believers.iter().map(|by| cell(of(by).map(|right| right.joined))));
        table.row(cells);
    }
    table
}

fn sure(summaries: &[BeliefSummary]) -> Table {
    let mut table = Table::new([
        ("set", Left),
        ("seen", Left),
        ("belief", Left),
        ("nll", Right),
        ("calibration, %", Right),
        ("not moved, %", Right),
        ("all ordered pairs, %", Right),
        ("anchor, median", Right),
        ("axis, median", Right),
    ]);
    let believers = believers(summaries);
    for summary in summaries {
        let Some(end) = end(summary) else { continue };
        for by in &believers {
            let (Some(sure), Some(right)) = (
                end.sure.iter().find(|one| one.by == *by),
                end.right.iter().find(|one| one.by == *by),
            ) else {
                continue;
            };
            // Anchors and axes are known for the last method alone.
            let placed = believers.last() == Some(by);
            let anchor = summary.anchors.as_ref().filter(|_| placed);
            let axis = summary.axes.as_ref().filter(|_| placed);
            table.row(vec![
                name(summary),
                summary.case.sight.title().to_owned(),
                by.title().to_owned(),
                format!("{:.3}", sure.nll),
                percent(sure.calibration),
                percent(right.unmoved),
                percent(right.all),
                anchor.map_or(NONE.to_owned(), |one| millimetres(one.median)),
                axis.map_or(NONE.to_owned(), |one| format!("{:.2}°", one.median.to_degrees())),
            ]);
        }
    }
    table
}

fn when(step: &BeliefStep) -> String {
    match step.when {
        When::Observations(count) => format!("{count} observations"),
        When::Strokes(1) => "1 stroke".to_owned(),
        When::Strokes(count) => format!("{count} strokes"),
        When::AfterContact(count) => format!("contact + {count}"),
        When::End => "the end".to_owned(),
    }
}

fn over_time(summaries: &[BeliefSummary]) -> Table {
    let believers = believers(summaries);
    let mut columns: Vec<(String, _)> = vec![
        ("set".into(), Left),
        ("seen".into(), Left),
        ("after".into(), Left),
        ("pairs".into(), Right),
        ("last window, %".into(), Right),
    ];
    for by in &believers {
        columns.push((format!("{}, %", by.title()), Right));
        columns.push((format!("{}: all ordered pairs, %", by.title()), Right));
    }
    let mut table = Table::new(columns.iter().map(|(name, align)| (name.as_str(), *align)));
    for (summary, step) in
        summaries.iter().flat_map(|one| one.steps.iter().map(move |step| (one, step)))
    {
        let of = |by: JointMethod| step.right.iter().find(|right| right.by == by);
        let cell = |share: Option<f64>| share.map_or(NONE.to_owned(), percent);
        let mut cells = vec![
            name(summary),
            summary.case.sight.title().to_owned(),
            when(step),
            step.pairs.to_string(),
            cell(of(JointMethod::LastWindow).map(|right| right.moved)),
        ];
        for by in &believers {
            cells.push(cell(of(*by).map(|right| right.moved)));
            cells.push(cell(of(*by).map(|right| right.all)));
        }
        table.row(cells);
    }
    table
}

fn rest(summaries: &[BeliefSummary]) -> Table {
    let mut by: Vec<JointMethod> = Vec::new();
    for rest in summaries.iter().flat_map(|one| &one.steps).flat_map(|step| &step.rest) {
        if !by.contains(&rest.by) {
            by.push(rest.by);
        }
    }
    let believers = believers(summaries);
    let lead = [("set", Left), ("seen", Left), ("after", Left)];
    let mut table = rest_table(&lead, &by, &believers);
    for summary in summaries {
        for step in summary.steps.iter().filter(|step| !step.rest.is_empty()) {
            let lead = vec![name(summary), summary.case.sight.title().to_owned(), when(step)];
            table.row(rest_cells(lead, step, &by, &believers));
        }
    }
    table
}

/// Returns a table of errors of the remaining motion by method, with medians and gaps of the
/// `believers`.
fn rest_table(lead: &[(&str, Align)], by: &[JointMethod], believers: &[JointMethod]) -> Table {
    let mut columns: Vec<(String, Align)> =
        lead.iter().map(|(name, align)| ((*name).to_owned(), *align)).collect();
    columns.extend(by.iter().map(|by| (by.title().to_owned(), Right)));
    columns.extend(believers.iter().map(|by| (format!("{}: median", by.title()), Right)));
    columns.extend(believers.iter().map(|by| (format!("{}: gap closed, %", by.title()), Right)));
    Table::new(columns.iter().map(|(name, align)| (name.as_str(), *align)))
}

fn rest_cells(
    mut cells: Vec<String>,
    step: &BeliefStep,
    by: &[JointMethod],
    believers: &[JointMethod],
) -> Vec<String> {
    let of = |by: &JointMethod| step.rest.iter().find(|rest| rest.by == *by);
    let length = |value: Option<f64>| value.map_or(NONE.to_owned(), millimetres);
    cells.extend(by.iter().map(|by| length(of(by).map(|rest| rest.mean))));
    cells.extend(believers.iter().map(|by| length(of(by).map(|rest| rest.median))));
    let closed = |by| of(by).map_or(NONE.to_owned(), |rest| percent(rest.closed));
    cells.extend(believers.iter().map(closed));
    cells
}

/// Returns the errors of the predicted remaining motion of recordings with the joints by some
/// methods, from first contact on.
pub fn recorded_joints_document(
    title: &str,
    count: usize,
    steps: &[BeliefStep],
    by: &[JointMethod],
) -> Document {
    let mut table = rest_table(&[("observations", Left), ("pairs moved", Right)], by, &[]);
    for step in steps.iter().filter(|step| !step.rest.is_empty()) {
        let lead = vec![when(step), step.pairs.to_string()];
        table.row(rest_cells(lead, step, by, &[]));
    }
    let recordings = if count == 1 { "recording" } else { "recordings" };
    Document {
        title: format!("{title}: final error of {count} {recordings}, predicted during the motion"),
        notes: vec![RECORDED.to_owned()],
        sections: vec![Section { table, ..Section::default() }],
        json: json!({"rest_of_the_way": steps}),
        ..Document::default()
    }
}

/// Returns the number of strokes or observations.
fn time(step: &BeliefStep) -> Option<f64> {
    match step.when {
        When::Observations(count) | When::Strokes(count) | When::AfterContact(count) => {
            Some(count as f64)
        }
        When::End => None,
    }
}

/// Returns the accuracy over all ordered pairs in sparse scenes, with the published values.
fn chart(summaries: &[BeliefSummary]) -> Chart {
    let believers = believers(summaries);
    let mut series = Vec::new();
    for summary in summaries {
        if summary.case.set.family != CrowdFamily::Sparse {
            continue;
        }
        for by in &believers {
            let points = summary.steps.iter().filter_map(|step| {
                let right = step.right.iter().find(|right| right.by == *by)?;
                Some([time(step)?, 1e2 * right.all])
            });
            series.push(Series {
                name: format!("{}, {}, {}", name(summary), summary.case.sight.title(), by.title()),
                points: points.collect(),
                mark: Mark::Line,
                labels: Vec::new(),
            });
        }
    }
    series.push(Series {
        name: "BRDPN, sparse 9, as published".into(),
        points: PUBLISHED.map(|[frame, right]| [frame / FRAMES_A_STROKE, 1e2 * right]).to_vec(),
        mark: Mark::Dots,
        labels: Vec::new(),
    });
    Chart {
        title: "Correct types, all ordered pairs".into(),
        x: Axis::linear("strokes"),
        y: Axis::linear("correct, %"),
        series,
    }
}

/// Returns the errors of the remaining motion with true poses, a chart per family.
fn rest_charts(summaries: &[BeliefSummary]) -> Vec<Figure> {
    let mut figures = Vec::new();
    for summary in summaries.iter().filter(|one| one.case.sight == Sighting::Exact) {
        let methods: Vec<JointMethod> = summary
            .steps
            .first()
            .map_or_else(Vec::new, |step| step.rest.iter().map(|rest| rest.by).collect());
        let series = methods.into_iter().map(|by| {
            let points = summary.steps.iter().filter_map(|step| {
                let rest = step.rest.iter().find(|rest| rest.by == by)?;
                Some([time(step)?, 1e3 * rest.mean])
            });
            Series {
                name: by.title().to_owned(),
                points: points.collect(),
                mark: Mark::Line,
                labels: Vec::new(),
            }
        });
        let chart = Chart {
            title: format!("Final error, predicted during the motion: {}", name(summary)),
            x: Axis::linear(match summary.case.set.family {
                CrowdFamily::Sparse => "observed strokes",
                _ => "observations",
            }),
            y: Axis::log("mean error, mm"),
            series: series.collect(),
        };
        let set = &summary.case.set;
        let file = format!("rest-of-the-way-{}-{}", set.family.title(), set.objects);
        figures.push(Figure::chart(file, chart));
    }
    figures
}
