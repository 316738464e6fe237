//! The page of a designed tool: its plan, its sizes, and the ends that the existing tools reach.

use pushplan::outcome::Verdict;
use pushplan::scene::Tool;
use pushplan::solve::{PlanStatus, RankedPlan, Solution};
use pushplan::task::Task;
use pushplan_design::Design;

use crate::design::parts;
use crate::solution::headline;
use crate::table::{Align, NONE, Table};

use super::data::Found;
use super::html::{self, PageView};
use super::recipe::Recipe;
use super::solution::{cells, choice, solved, why};

/// Columns of the comparison with the existing tools.
const COLUMNS: [(&str, Align); 6] = [
    ("tool", Align::Left),
    ("predicted error", Align::Right),
    ("2-D", Align::Right),
    ("3-D", Align::Right),
    ("perturbed", Align::Right),
    ("result", Align::Left),
];

/// Returns the page of a design: the plan with the proposed tool, the sizes of that tool, and the
/// best plan of every existing tool. `nominal` and `recipe` are as for
/// [`solution_page`](super::solution_page).
pub fn design_page(
    task: &Task,
    design: &Design,
    nominal: &Verdict,
    recipe: &dyn Fn(&RankedPlan) -> Recipe,
    view: PageView,
) -> String {
    let mut data = solved(task, design.best(), nominal, recipe);
    if let Some(proposal) = &design.proposal {
        if design.known.status != PlanStatus::Solved {
            let known = headline(task, &design.known);
            let note = format!(
                "The description holds for the existing tools ({known}); the plan uses the \
                 proposed tool {}.",
                proposal.tool.name
            );
            data.description = format!("{} {note}", data.description).trim_start().to_owned();
        }
        let sizes = parts(&proposal.tool);
        data.found = vec![
            Found::of(&sizes.title, &sizes.table),
            Found::of("Proposed and existing tools", &compared(task, design, &proposal.tool)),
        ];
    }
    html::page(&data, view)
}

/// Returns a table of the best plan with each tool: the proposed one, then the existing ones, best
/// first. A tool without a plan has the reason.
fn compared(task: &Task, design: &Design, tool: &Tool) -> Table {
    let mut table = Table::new(COLUMNS);
    let mut row = |name: String, solution: &Solution, plan: Option<usize>, reason: String| {
        let mut cells = match plan {
            Some(k) => reached(task, solution, k),
            None => [NONE, NONE, NONE, NONE, &reason].map(str::to_owned).to_vec(),
        };
        cells.insert(0, name);
        table.row(cells);
    };
    let best = design.best();
    row(format!("{} (proposed)", tool.name), best, best.best().map(|_| 0), String::new());
    for choice in choice(&design.known) {
        row(choice.tool, &design.known, choice.plan, choice.why);
    }
    table
}

/// Returns the errors and the result of the plan of rank `k`, as in the table of plans.
fn reached(task: &Task, solution: &Solution, k: usize) -> Vec<String> {
    let ranked = &solution.plans[k];
    let all = cells(task, ranked, ranked.verdict.as_ref(), why(task, solution, k));
    all.into_iter().skip(1).collect()
}
