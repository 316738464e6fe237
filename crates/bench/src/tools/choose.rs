//! The first choice for a goal: the best of all chained sequences and their stops, by prediction
//! alone, as the reference chooses.

use pushplan::{
    effect::EffectModel,
    outcome::Record,
    task::{Job, PushForm, Task},
};

use super::{execute::Action, sequences::Sequences, setup::ReferenceSetup};

/// A choice, and where the cylinder is then predicted to rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// What to do.
    pub action: Action,
    /// Predicted distance from the goal, metres; `None` without a prediction.
    pub predicted: Option<f64>,
}

/// Stops that are rolled out to rest before the first choice is made: free sliding estimates
/// where one rests to a millimetre, and many sequences end alike.
const LOOKED_AT: usize = 16;

/// Not pushing.
pub fn nothing(task: &Task) -> Choice {
    let action = Action { pose: 0, form: PushForm::Chained, pushes: Vec::new() };
    Choice { action, predicted: Some(task.goals[0].error(&task.scene.start())) }
}

/// The best action of `sequences` with one of `poses` for the goal of `task`, by where `model`
/// predicts it to come to rest. Not pushing is one of them, so that there is always a choice.
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

/// Where actions are predicted to come to rest; without those that do not.
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
