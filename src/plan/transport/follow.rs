//! Real pushes along the legs of a transport. For each leg, the search and refinement start from
//! the state left by the previous pushes.

use crate::effect::EffectModel;
use crate::geometry::Footprint;
use crate::plan::uncertainty::{Uncertainty, room};
use crate::plan::{
    Candidate, CandidatePush, Evaluation, RefineSettings, RefineStatistics, Rollouts, Search,
    SearchSettings, Workspace, kinds, refine,
};
use crate::progress::Progress;
use crate::{
    outcome::Record,
    scene::{Situation, State},
    task::{Directions, Goal, PushRules, Task},
};

use super::Leg;

/// Tolerance of an object's position at the end of a leg, metres. An object further off would not
/// pass the next gap.
const NEAR: f64 = 0.01;

/// Tolerance of an object's heading at the end of a leg relative to the start, radians.
const TURNED: f64 = 0.1;

/// Score above which a leg is lost, so that the next legs do not start.
const LOST: f64 = 1.5;

/// Motion of other objects that counts as one unit of the score, metres.
const BESIDE: f64 = 0.02;

/// Length of a push beyond its leg, metres, because the tool starts farther away.
const LONGER: f64 = 0.05;

/// Budgets of the pushes along legs.
#[derive(Clone, Copy, Debug)]
pub struct FollowSettings {
    /// Settings of the search for each push.
    pub search: SearchSettings,
    /// Number of candidates to refine for each push.
    pub candidates: usize,
    /// Settings of the refinement.
    pub refine: RefineSettings,
}

/// Legs that pushes could follow.
#[derive(Clone, Debug)]
pub struct Followed {
    /// Pushes along the legs.
    pub candidate: Candidate,
    /// Number of legs followed to their ends.
    pub legs: usize,
    /// State at the end of these legs.
    pub state: State,
}

/// Finds pushes along `legs` with one tool and grip yaw; `used` counts the rollouts of the model.
pub fn follow(
    workspace: &Workspace,
    situation: &Situation,
    (tool, grip_yaw): (usize, f64),
    legs: &[Leg],
    (model, settings): (&dyn EffectModel, FollowSettings),
    used: &mut usize,
    progress: &dyn Progress,
) -> Followed {
    let mut followed =
        Followed { candidate: Candidate::default(), legs: 0, state: situation.start.clone() };
    let spread = Uncertainty::around(situation);
    let mut others = spread.starts().to_vec();
    for (k, leg) in legs.iter().enumerate() {
        let now = Situation { start: followed.state.clone(), ..situation.clone() };
        let task = towards(workspace.task, leg, situation, grip_yaw);
        let own = Workspace { task: &task, tools: &workspace.tools[tool..=tool] };
        let error = settings.search.model_error;
        let first_room = match k {
            0 => 0.0,
            _ => room(&situation.scene, leg.object, &now.start, &others, error),
        };
        let Some(best) = push(&own, &now, first_room, (model, settings), used, progress) else {
            break;
        };
        if best.score > LOST {
            break;
        }
        let mut rollouts = Rollouts::new(model, now);
        let jobs: Vec<_> =
            best.motions(&own).iter().flat_map(|motion| spread.jobs(motion, &others)).collect();
        let ends = rollouts.run(&jobs, Record::Outcome);
        *used += rollouts.used();
        others = ends.iter().map(|end| end.outcome().clone()).collect();
        // The search had a single tool, at index 0.
        let pushes = best.candidate.pushes.iter().map(|push| CandidatePush { tool, ..*push });
        followed.candidate.pushes.extend(pushes);
        followed.state = best.outcome;
        followed.legs += 1;
    }
    followed
}

/// Returns the task of carrying one object to the end of a leg.
fn towards(task: &Task, leg: &Leg, situation: &Situation, grip_yaw: f64) -> Task {
    let object = &task.scene.objects[leg.object];
    let own = task.goals.iter().find(|goal| leg.last && goal.object == leg.object);
    let tolerance = own.map_or(NEAR, |goal| goal.tolerance().min(NEAR));
    let goal = Goal::new(leg.object, [leg.to.x, leg.to.y], tolerance);
    let turns = !matches!(object.shape.footprint(), Footprint::Disc { .. });
    let goal = match turns {
        true => goal.facing(situation.start.poses[leg.object].heading, TURNED),
        false => goal,
    };
    let pushes = PushRules {
        directions: Directions::List(vec![leg.direction]),
        grip_yaws: vec![grip_yaw],
        length: (leg.to - leg.from).norm() + LONGER,
        max_count: 1,
        ..task.pushes.clone()
    };
    Task { goals: vec![goal], pushes, ..task.clone() }
}

/// Returns the best single push for a task from the current situation.
fn push(
    workspace: &Workspace,
    now: &Situation,
    first_room: f64,
    (model, settings): (&dyn EffectModel, FollowSettings),
    used: &mut usize,
    progress: &dyn Progress,
) -> Option<Evaluation> {
    let mut rollouts = Rollouts::new(model, now.clone());
    let mut search = Search::new(*workspace, now, settings.search).with_first_room(first_room);
    let found = search.deepen(&mut rollouts, progress);
    let chosen = kinds(&found, settings.candidates);
    let candidates: Vec<Candidate> = match chosen.len() {
        0 => return None,
        _ => {
            let others = (0..found.len()).filter(|k| !chosen.contains(k));
            let all = chosen.iter().copied().chain(others).take(settings.candidates);
            all.map(|k| found[k].candidate.clone()).collect()
        }
    };
    let mut statistics = RefineStatistics::default();
    let refined =
        refine(workspace, &mut rollouts, &candidates, settings.refine, &mut statistics, progress);
    *used += rollouts.used();
    let moved = |one: &Evaluation| {
        let goal = workspace.task.goals[0].object;
        let others = now.scene.things().map(|(k, _)| k).filter(|k| *k != goal);
        let ways =
            others.map(|k| (one.outcome.poses[k].position - now.start.poses[k].position).norm());
        ways.sum::<f64>() / BESIDE
    };
    let sound = refined.into_iter().map(|one| one.best).filter(Evaluation::is_sound);
    sound.min_by(|a, b| (a.score + moved(a)).total_cmp(&(b.score + moved(b))))
}
