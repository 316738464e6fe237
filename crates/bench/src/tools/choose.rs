//! First choice for a goal: the best of all chained sequences and stops, by prediction only, as in
//! the reference.

use pushplan::{
    effect::EffectModel,
    outcome::Record,
    task::{Job, PushForm, Task},
};

use super::{execute::Action, sequences::Sequences, setup::ReferenceSetup};

/// Choice with its predicted error.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// Chosen action.
    pub action: Action,
    /// Predicted distance from the goal, metres; `None` without a prediction.
    pub predicted: Option<f64>,
}

/// Number of stops rolled out to rest before the first choice. Free sliding estimates the final
/// position to a millimetre, and many sequences have similar ends.
const LOOKED_AT: usize = 16;

/// Returns the choice not to push.
pub fn nothing(task: &Task) -> Choice {
    let action = Action { pose: 0, form: PushForm::Chained, pushes: Vec::new() };
    Choice { action, predicted: Some(task.goals[0].error(&task.scene.start())) }
}

/// Returns the best action of `sequences` with one of `poses` for the goal of `task`, by the final
/// position predicted by `model`. Not pushing is included, so that there is always a choice.
pub fn first_choice(
    setup: &ReferenceSetup,
    model: &dyn EffectModel,
    task: &Task,
    sequences: &Sequences,
    poses: &[usize],
) -> Choice {
    let best = sequences.best(&task.goals[0], LOOKED_AT, poses);
    let actions = best.into_iter().map(|(_, action)| action).collect();
    rested(setup, model, task, actions).into_iter().fold(nothing(task), |best, choice| match choice
        .predicted
        < best.predicted
    {
        true => choice,
        false => best,
    })
}

/// Returns the predicted errors of actions; actions that do not end at rest are omitted.
pub fn rested(
    setup: &ReferenceSetup,
    model: &dyn EffectModel,
    task: &Task,
    actions: Vec<Action>,
) -> Vec<Choice> {
    let job = |action: &Action| Job::stated(&task.scene, action.motion(setup));
    let jobs: Vec<Job> = actions.iter().map(job).collect();
    let trajectories = model.rollout(&task.scene, &jobs, Record::Outcome);
    let pairs = actions.into_iter().zip(trajectories);
    pairs
        .filter_map(|(action, trajectory)| {
            let sound = trajectory.warnings.iter().all(|warning| !warning.forbids_success());
            let state = trajectory.frames.last().map(|frame| &frame.state);
            let state = state.filter(|state| sound && state.is_finite())?;
            Some(Choice { action, predicted: Some(task.goals[0].error(state)) })
        })
        .collect()
}
