//! The page of a solved task: its plans, its tools, and the considered pushes.

use crate::number::millimetres;
use crate::plan_text::{engine_name, moves_line, plan_line};
use crate::solution::{headline, model_words, moved_by};
use crate::table::NONE;
use crate::verdict::verdict_line;
use pushplan::plan::{ScoredPush, bare, is_behind};
use pushplan::solve::{PlanStatus, RankedPlan, Solution};
use pushplan::{
    outcome::{Outcome, Verdict, warning_lines},
    scene::Engine,
    task::Task,
};

use super::candidates::{candidates, frequent};
use super::data::{Choice, Data, Layer, Standing};
use super::html::{self, PageView};
use super::recipe::Recipe;
use super::replay::{ends, replays};
use super::replayed::{Making, shown_replay, standing};

/// Names of the columns of the table of plans.
const COLUMNS: [&str; 6] = ["plan", "predicted", "2-D", "3-D", "perturbed", "outcome"];

/// Returns the page of a solution. `nominal` holds the replays of the first plan, even if it was
/// not verified; `recipe` returns the recipe for a plan's replays.
pub fn solution_page(
    task: &Task,
    solution: &Solution,
    nominal: &Verdict,
    recipe: &dyn Fn(&RankedPlan) -> Recipe,
    view: PageView,
) -> String {
    html::page(&solved(task, solution, nominal, recipe), view)
}

/// Returns the content of the page of a solution.
pub(super) fn solved(
    task: &Task,
    solution: &Solution,
    nominal: &Verdict,
    recipe: &dyn Fn(&RankedPlan) -> Recipe,
) -> Data {
    let mut making = Making::of(task, headline(task, solution));
    making.data.drawing =
        solution.best().and_then(|best| making.drawing(&best.plan, &best.tools, nominal));
    for (k, ranked) in solution.plans.iter().enumerate() {
        let verdict = ranked.verdict.as_ref();
        let replayed = if k == 0 { Some(nominal) } else { verdict };
        let mut list = Vec::new();
        let predicted = (Layer::Predicted, &ranked.predicted, ranked.outcome.reached);
        // For motions that leave the plane only the end is predicted.
        let predicted = Some(predicted)
            .filter(|(_, shown, _)| ranked.outcome.state.space.is_none() || shown.frames.len() > 1);
        let shown = predicted.into_iter().chain(replayed.into_iter().flat_map(replays));
        let own = (&ranked.plan, &ranked.tools[..]);
        list.extend(shown.filter_map(|one| shown_replay(task, own, one)));
        let why = why(task, solution, k);
        let plan = making.plan(&ranked.tools, &ranked.plan, recipe(ranked));
        plan.standing = verdict.map_or(Standing::Open, standing);
        plan.verdict = if k == 0 { verdict_line(task, verdict) } else { why.clone() };
        plan.cells = cells(task, ranked, replayed, why);
        plan.ends = verdict.map_or(Vec::new(), |verdict| ends(task, verdict));
        plan.replays = list;
    }
    making.data.columns = COLUMNS.to_vec();
    making.data.models = format!("Model: {}.", model_words(task, solution));
    // For lever-ups only the plans are kept.
    if solution.statistics.levers.is_none() {
        making.data.choice = choice(solution);
    }
    making.data.candidates = candidates(solution);
    making.data.warnings = warning_lines(&solution.warnings);
    making.data
}

pub(super) fn cells(
    task: &Task,
    ranked: &RankedPlan,
    replayed: Option<&Verdict>,
    why: String,
) -> Vec<String> {
    let error = |outcome: Option<&Outcome>| {
        outcome.map_or(NONE.to_owned(), |outcome| {
            match (outcome.state.space.is_some(), outcome.reached) {
                (false, _) => millimetres(outcome.error()),
                (true, true) => "reaches the goal".to_owned(),
                (true, false) => "misses the goal".to_owned(),
            }
        })
    };
    let nominal = |engine| replayed.and_then(|verdict| verdict.nominal(engine));
    let end = |engine| error(nominal(engine).map(|evidence| &evidence.outcome));
    let [planar, spatial] = Engine::ALL.map(end);
    let disturbed = ranked.verdict.as_ref().and_then(fewest).map_or(NONE.to_owned(), |found| {
        let (reached, replays, _) = found;
        format!("{reached} of {replays}")
    });
    let words = [plan_line(&ranked.plan), moves_line(&moved_by(task, ranked))];
    let plan = words.into_iter().filter(|words| !words.is_empty()).collect::<Vec<_>>().join("; ");
    vec![plan, error(Some(&ranked.outcome)), planar, spatial, disturbed, why]
}

/// Returns the number of perturbed replays that reach the goal, the number of replays, and the
/// engine, for the engine with the lower share.
fn fewest(verdict: &Verdict) -> Option<(usize, usize, Engine)> {
    let counts = Engine::ALL.map(|engine| {
        let reached = verdict.perturbed(engine).filter(|evidence| evidence.outcome.reached);
        (reached.count(), verdict.perturbed(engine).count(), engine)
    });
    let made = counts.into_iter().filter(|(_, replays, _)| *replays > 0);
    made.min_by(|a, b| (a.0 * b.1).cmp(&(b.0 * a.1)))
}

/// Describes the result of the plan of rank `k`: the verdict for the first plan, otherwise the
/// reason why it is not first.
pub(super) fn why(task: &Task, solution: &Solution, k: usize) -> String {
    let ranked = &solution.plans[k];
    let Some(verdict) = &ranked.verdict else {
        return match (ranked.plan.is_empty(), ranked.outcome.reached) {
            (true, _) => "moves nothing".to_owned(),
            (false, true) => "predicted to reach the goal; not replayed".to_owned(),
            (false, false) => "predicted to miss the goal".to_owned(),
        };
    };
    let best = solution.best().and_then(|best| best.verdict.as_ref());
    if k == 0 || !verdict.passed {
        return verdict_line(task, Some(verdict));
    }
    match (verdict.robustness, best.and_then(|best| best.robustness)) {
        (None, Some(_)) => "works as written; not replayed with perturbations".to_owned(),
        (Some(own), Some(best)) if own < best => {
            let found = fewest(verdict);
            let engine = found.map_or("", |(_, _, engine)| engine_name(engine));
            format!("passes, but fewer perturbed replays reach the goal ({engine})")
        }
        _ => "also passes".to_owned(),
    }
}

/// Returns all offered tools: those with a plan first, then by predicted score.
pub(super) fn choice(solution: &Solution) -> Vec<Choice> {
    let mut found: Vec<(Option<usize>, f64, Choice)> = Vec::new();
    for (index, tool) in solution.tools.iter().enumerate() {
        let own = |push: &&ScoredPush| push.tool == index;
        let pushes: Vec<&ScoredPush> = solution.candidates.iter().filter(own).collect();
        let best = pushes.iter().filter_map(|push| push.score).reduce(f64::min);
        let of_tool = |plan: &RankedPlan| plan.plan.tools().contains(&tool.name.as_str());
        let plan = solution.plans.iter().position(of_tool);
        let refused = pushes.iter().filter(|push| push.score.is_none() && push.refused.is_some());
        let choice = Choice {
            tool: tool.name.clone(),
            considered: pushes.len(),
            refused: refused.count(),
            best: best.map_or(NONE.to_owned(), |best| format!("{:.2}", bare(best))),
            why: lost(solution, plan, best, &pushes),
            plan,
        };
        found.push((plan, best.unwrap_or(f64::INFINITY), choice));
    }
    let place = |plan: Option<usize>| plan.unwrap_or(usize::MAX);
    found.sort_by(|a, b| place(a.0).cmp(&place(b.0)).then(a.1.total_cmp(&b.1)));
    found.into_iter().map(|(.., choice)| choice).collect()
}

/// Explains why a tool was chosen or rejected.
fn lost(
    solution: &Solution,
    plan: Option<usize>,
    best: Option<f64>,
    pushes: &[&ScoredPush],
) -> String {
    let ranked = plan.map(|plan| (plan, &solution.plans[plan]));
    match (ranked, best) {
        (Some((0, _)), _) => match solution.status {
            PlanStatus::Solved | PlanStatus::Fragile => "chosen".to_owned(),
            PlanStatus::FailedVerification => {
                "best by prediction, but fails in a replay".to_owned()
            }
            PlanStatus::Partial => "chosen: it meets some of the goals".to_owned(),
            PlanStatus::NoPlan => "closest, but misses the goal".to_owned(),
        },
        (Some((k, plan)), _) => match &plan.verdict {
            Some(verdict) if verdict.passed => format!("also works, as plan {}", k + 1),
            Some(_) => format!("fails in a replay, as plan {} shows", k + 1),
            None if plan.outcome.reached => format!("predicted to work, as plan {}", k + 1),
            None => format!("predicted to miss, as plan {} shows", k + 1),
        },
        (None, None) => match frequent(pushes) {
            Some(reason) => format!("no push is feasible, mostly because {reason}"),
            None => "no push was tried".to_owned(),
        },
        (None, Some(best)) if is_behind(best) => {
            "an immovable body blocks every way to the goal".to_owned()
        }
        (None, Some(best)) if best > 1.0 => "predicted to end too far from the goal".to_owned(),
        (None, Some(_)) => "predicted to end close, but not selected for refinement".to_owned(),
    }
}
