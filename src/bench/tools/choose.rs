//! Choosing what to do for a goal: the first choice among all chained sequences and their stops,
//! chained sequences refined, and placed pushes searched and refined.

use crate::{
    effect::EffectModel,
    plan::{
        Candidate, Evaluation, Found, RefineSettings, RefineStatistics, Refined, Rollouts, Search,
        SearchSettings, SequenceTree, Workspace, evaluate, kinds, refine,
    },
    scene::{Directions, PushForm, Situation, Task},
};

use super::{execute::Action, setup::ReferenceSetup};

/// A choice, and where the cylinder is then predicted to rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// What to do.
    pub action: Action,
    /// Predicted distance from the goal, metres; nothing where nobody predicted.
    pub predicted: Option<f64>,
}

/// Stops that are rolled out to rest before the first choice is made: free sliding estimates
/// where one rests to a millimetre, and many sequences end alike.
const LOOKED_AT: usize = 16;

/// Different sequences that are refined, and rounds of refinement.
const REFINED: usize = 6;
const ROUNDS: usize = 4;

/// Refinement goes to longer sequences only while the best misses by more than this, metres.
const GOOD: f64 = 2e-3;

/// The search of placed pushes.
const PLACED: SearchSettings = SearchSettings { offsets: 5, beam: 12, rollouts: 600, kept: 512 };

/// Ways round the circle for placed pushes: refinement turns them by more than half their
/// spacing.
const WAYS: usize = 8;

/// Not pushing.
pub fn nothing(setup: &ReferenceSetup, task: &Task) -> Choice {
    let action = Action { grip: setup.poses[0].grip, form: task.pushes.form, pushes: Vec::new() };
    let start = task.scene.objects[task.goal.object].pose.position;
    Choice { action, predicted: Some((start - task.goal.position).norm()) }
}

/// The best candidates of `tree` for the goal of `workspace`, rolled out to rest, best first, at
/// most `count`. Not pushing is one of them, here and below, so that there is always a choice.
pub fn first_choices(
    setup: &ReferenceSetup,
    workspace: &Workspace,
    rollouts: &mut Rollouts,
    tree: &SequenceTree,
    grips: &[(usize, f64)],
    count: usize,
) -> Vec<Choice> {
    let best = tree.best(&workspace.task.goal, count.max(LOOKED_AT), |g| grips.contains(&g));
    let candidates: Vec<Candidate> = best.into_iter().map(|found| found.candidate).collect();
    let evaluated = evaluate(workspace, rollouts, &candidates);
    ranked(setup, workspace.task, evaluated.into_iter().flatten(), count)
}

/// The best different chained sequences of `tree`, their directions and lengths refined.
pub fn refined_choices(
    setup: &ReferenceSetup,
    workspace: &Workspace,
    rollouts: &mut Rollouts,
    tree: &SequenceTree,
    grips: &[(usize, f64)],
    count: usize,
) -> Vec<Choice> {
    let best = tree.best(&workspace.task.goal, usize::MAX, |g| grips.contains(&g));
    let refined = refined(workspace, rollouts, &best, 0);
    ranked(setup, workspace.task, refined.into_iter().map(|refined| refined.best), count)
}

/// Placed pushes, as many as it takes: searched, refined, best first.
pub fn placed_choices(
    setup: &ReferenceSetup,
    model: &dyn EffectModel,
    task: &Task,
    grips: &[(usize, f64)],
    count: usize,
) -> Vec<Choice> {
    let mut task = task.clone();
    task.pushes.form = PushForm::Placed;
    task.pushes.directions = Directions::Count(WAYS);
    let workspace = setup.workspace(&task);
    let mut rollouts = Rollouts::new(model, Situation::stated(&task.scene));
    let mut search = Search::with_grips(workspace, rollouts.situation(), grips.to_vec(), PLACED);
    let mut all: Vec<Evaluation> = Vec::new();
    while search.can_deepen() {
        let found = search.deepen(&mut rollouts, &mut |_, _| {});
        let refined = refined(&workspace, &mut rollouts, &found, search.depth() as u64);
        all.extend(refined.into_iter().map(|refined| refined.best));
        if all.iter().any(|one| task.goal.error(&one.outcome) <= GOOD) {
            break;
        }
    }
    ranked(setup, &task, all.into_iter(), count)
}

fn refined(
    workspace: &Workspace,
    rollouts: &mut Rollouts,
    found: &[Found],
    seed: u64,
) -> Vec<Refined> {
    let settings = RefineSettings { rounds: ROUNDS, extra: 2, seed, enough: 2 };
    let mut statistics = RefineStatistics::default();
    let kinds: Vec<Candidate> =
        kinds(found, REFINED).into_iter().map(|k| found[k].candidate.clone()).collect();
    refine(workspace, rollouts, &kinds, settings, &mut statistics, &mut |_, _| {})
}

/// Choices by predicted distance, not pushing among them; equal ones keep their order.
fn ranked(
    setup: &ReferenceSetup,
    task: &Task,
    evaluations: impl Iterator<Item = Evaluation>,
    count: usize,
) -> Vec<Choice> {
    let mut choices = vec![nothing(setup, task)];
    choices.extend(evaluations.filter(|one| one.is_feasible() && one.score.is_finite()).map(
        |one| {
            let action = Action {
                grip: (one.candidate.tool, one.candidate.grip_yaw),
                form: task.pushes.form,
                pushes: one.pushes,
            };
            Choice { action, predicted: Some(task.goal.error(&one.outcome)) }
        },
    ));
    let miss = |choice: &Choice| choice.predicted.unwrap_or(f64::INFINITY);
    choices.sort_by(|a, b| miss(a).total_cmp(&miss(b)));
    choices.truncate(count);
    choices
}
