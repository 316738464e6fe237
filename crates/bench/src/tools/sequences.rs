//! The reference protocol: all chained sequences of pushes of a task, each with every stop.
//!
//! The pushes start from a fixed home, and each continues from the end of the last one. The tool
//! may stop after any of a number of equal steps. This is not a planner but the selection of the
//! reference, so its rows evaluate a *model*. It needs only an [`EffectModel`].
//!
//! Sequences with a common beginning share it. For t tool poses and d directions, three-push
//! sequences need t (d + d^2 + d^3) rolled-out pushes instead of 3 t d^3. This is exact for an
//! effect model whose state consists of poses and velocities only, because resuming from the state
//! at the end of a push is the same computation. The network, which corrects a motion as a
//! whole, differs by tenths of a millimetre. A simulator also has contact forces as state, so its
//! sequences can be executed from their beginnings instead.
//!
//! The final position of the cylinder after a stop is estimated by free sliding, which ranks the
//! stops; users of a stop roll it out.

use pushplan::{
    effect::EffectModel,
    geometry::{Pose, Vector},
    outcome::{Record, Trajectory},
    scene::{Situation, State},
    task::{Goal, Job, Push, PushForm, Task},
};

use super::{execute::Action, setup::ReferenceSetup};

/// Chained sequences of up to the task's number of pushes, for some tool poses.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequences {
    situation: Situation,
    /// Index of the goal object.
    object: usize,
    /// Number of equal steps of a push, after each of which the tool may stop.
    steps: usize,
    /// Pushes, level by level; a sequence is the path from a root to a branch.
    branches: Vec<Branch>,
}

/// Last push of a sequence.
#[derive(Clone, Debug, PartialEq)]
struct Branch {
    /// Index of the tool pose.
    pose: usize,
    before: Option<usize>,
    push: Push,
    /// Final pose of the goal object for a stop after each step.
    rests: Vec<Pose>,
}

/// State from which sequences continue.
struct Node {
    pose: usize,
    branch: Option<usize>,
    state: State,
    end: Vector,
}

/// Tasks and model of the rollouts.
#[derive(Clone, Copy)]
pub struct Rolling<'a> {
    pub setup: &'a ReferenceSetup,
    pub task: &'a Task,
    pub model: &'a dyn EffectModel,
    /// Indices of the tool poses.
    pub poses: &'a [usize],
    /// Number of equal steps of a push, after each of which the tool may stop.
    pub steps: usize,
}

impl Rolling<'_> {
    /// Rolls out all sequences, each common beginning once.
    pub fn shared(&self) -> Sequences {
        let mut sequences = self.none();
        let (start, home) = (&sequences.situation.start, self.task.robot.home);
        let root = |&pose| Node { pose, branch: None, state: start.clone(), end: home };
        let mut nodes: Vec<Node> = self.poses.iter().map(root).collect();
        let most = self.task.pushes.max_count;
        for level in 1..=most {
            let last = level == most;
            let pushes: Vec<(&Node, Push)> = nodes
                .iter()
                .flat_map(|node| self.headings().into_iter().map(move |way| (node, way)))
                .map(|(node, way)| (node, self.push(node.end, way)))
                .collect();
            let jobs: Vec<Job> = pushes
                .iter()
                .map(|(node, push)| {
                    let mut motion = chained(node.pose, vec![*push]).motion(self.setup);
                    // Only the end of a sequence waits for rest.
                    motion.strokes[0].settle = last;
                    let job = Job::new(&sequences.situation, motion);
                    Job { start: node.state.clone(), ..job }
                })
                .collect();
            let trajectories = self.roll(&sequences.situation, &jobs);
            let mut next = Vec::new();
            for (((node, push), job), trajectory) in pushes.iter().zip(&jobs).zip(&trajectories) {
                let states = states(trajectory, 0);
                let moving = job.motion.slide().strokes[0].frames();
                let played = Played { states: &states, moving, settled: last };
                let rests = played.rests(&sequences);
                let (pose, before) = (node.pose, node.branch);
                sequences.branches.push(Branch { pose, before, push: *push, rests });
                if let Some(state) = states.get(moving).filter(|state| state.is_finite()) {
                    let branch = Some(sequences.branches.len() - 1);
                    next.push(Node { pose, branch, state: (*state).clone(), end: push.end() });
                }
            }
            nodes = next;
        }
        sequences
    }

    /// Executes every sequence of maximum length from its beginning to rest. This is exact for any
    /// model, and 3 d^3 / (d + d^2 + d^3) times as expensive as [`Self::shared`] for three pushes.
    pub fn whole(&self) -> Sequences {
        let mut sequences = self.none();
        let count = self.task.pushes.max_count as u32;
        let ways = self.headings();
        let each = ways.len().pow(count);
        let digit = |sequence: usize, level: u32| sequence / ways.len().pow(count - 1 - level);
        let mut played = Vec::with_capacity(self.poses.len() * each);
        for &pose in self.poses {
            for sequence in 0..each {
                let mut end = self.task.robot.home;
                let pushes = (0..count).map(|level| {
                    let push = self.push(end, ways[digit(sequence, level) % ways.len()]);
                    end = push.end();
                    push
                });
                played.push(chained(pose, pushes.collect()));
            }
        }
        let job = |action: &Action| Job::new(&sequences.situation, action.motion(self.setup));
        let jobs: Vec<Job> = played.iter().map(job).collect();
        let trajectories = self.roll(&sequences.situation, &jobs);
        let mut before: Vec<Option<usize>> = vec![None; jobs.len()];
        for level in 0..count {
            // Sequences with a common beginning are equal up to there, so the first represents all.
            let alike = ways.len().pow(count - 1 - level);
            for first in (0..jobs.len()).step_by(alike) {
                let states = states(&trajectories[first], level as usize);
                let moving = jobs[first].motion.slide().strokes[level as usize].frames();
                let settled = level + 1 == count;
                let rests = Played { states: &states, moving, settled }.rests(&sequences);
                let Action { pose, pushes, .. } = &played[first];
                sequences.branches.push(Branch {
                    pose: *pose,
                    before: before[first],
                    push: pushes[level as usize],
                    rests,
                });
                before[first..first + alike].fill(Some(sequences.branches.len() - 1));
            }
        }
        sequences
    }

    fn none(&self) -> Sequences {
        let situation = Situation::stated(&self.task.scene);
        let (object, steps) = (self.task.goals[0].object, self.steps);
        Sequences { situation, object, steps, branches: Vec::new() }
    }

    fn headings(&self) -> Vec<f64> {
        self.task.pushes.directions.headings()
    }

    fn push(&self, start: Vector, direction: f64) -> Push {
        let rules = &self.task.pushes;
        Push { start, direction, length: rules.length, speed: rules.speed }
    }

    fn roll(&self, situation: &Situation, jobs: &[Job]) -> Vec<Trajectory> {
        self.model.rollout(&situation.scene, jobs, Record::Frames)
    }
}

impl Sequences {
    /// Returns the best `count` sequences, best first, each with its best stop and its score by the
    /// estimated final position. Beginnings of sequences are included, and only the given tool
    /// poses are considered.
    pub fn best(&self, goal: &Goal, count: usize, poses: &[usize]) -> Vec<(f64, Action)> {
        let mut state = self.situation.start.clone();
        let mut scored: Vec<(f64, usize, usize)> = Vec::with_capacity(self.branches.len());
        for (index, branch) in self.branches.iter().enumerate() {
            if !poses.contains(&branch.pose) {
                continue;
            }
            let mut best = (f64::INFINITY, index, 0);
            for (step, rest) in branch.rests.iter().enumerate() {
                state.poses[goal.object] = *rest;
                let score = if state.is_finite() { goal.score(&state) } else { f64::INFINITY };
                if score < best.0 {
                    best = (score, index, step);
                }
            }
            if best.0.is_finite() {
                scored.push(best);
            }
        }
        // The sort is stable, so that among equal ones the shortest sequence comes first.
        scored.sort_by(|a, b| a.0.total_cmp(&b.0));
        scored.truncate(count);
        scored.into_iter().map(|(score, branch, step)| (score, self.action(branch, step))).collect()
    }

    /// Returns the final position of the goal object for every sequence of maximum length. The
    /// order is by pose, then by direction, with the last push varying fastest.
    pub fn ends(&self) -> impl Iterator<Item = (Action, Vector)> {
        let deepest = (0..self.branches.len()).map(|k| self.way(k).count()).max().unwrap_or(0);
        let whole = (0..self.branches.len()).filter(move |&k| self.way(k).count() == deepest);
        whole.filter_map(|k| {
            let steps = self.branches[k].rests.len();
            (steps == self.steps)
                .then(|| (self.action(k, steps - 1), self.branches[k].rests[steps - 1].position))
        })
    }

    /// Returns the sequence that ends with `branch`, cut after its step number `step` (from 0).
    fn action(&self, branch: usize, step: usize) -> Action {
        let mut pushes: Vec<Push> = self.way(branch).map(|k| self.branches[k].push).collect();
        pushes.reverse();
        if let Some(last) = pushes.last_mut() {
            last.length = last.length * (step + 1) as f64 / self.steps as f64;
        }
        chained(self.branches[branch].pose, pushes)
    }

    /// Iterates from `branch` back to its root.
    fn way(&self, branch: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(branch), |&k| self.branches[k].before)
    }
}

fn chained(pose: usize, pushes: Vec<Push>) -> Action {
    Action { pose, form: PushForm::Chained, pushes }
}

/// States during one push of a sequence, frame by frame.
struct Played<'a> {
    /// State before the push, then after every frame.
    states: &'a [&'a State],
    /// Number of frames in which the tool moves.
    moving: usize,
    /// Whether the states continue until rest.
    settled: bool,
}

impl Played<'_> {
    /// Returns the final pose of the object for a stop after each of `steps` equal steps; fewer if
    /// the rollout ended early. Between two frames the state is interpolated.
    fn rests(&self, sequences: &Sequences) -> Vec<Pose> {
        let Sequences { situation, object, steps, .. } = sequences;
        let (object, steps) = (*object, *steps);
        let mut rests = Vec::with_capacity(steps);
        for step in 1..=steps {
            let (place, rest) = (step * self.moving / steps, step * self.moving % steps);
            let Some(&before) = self.states.get(place) else { break };
            let state = match (rest, self.states.get(place + 1)) {
                (0, _) => before.clone(),
                (_, Some(after)) => between(before, after, rest as f64 / steps as f64),
                (_, None) => break,
            };
            rests.push(situation.coasted(&state).poses[object]);
        }
        if let (true, Some(last)) = (self.settled && rests.len() == steps, self.states.last()) {
            rests[steps - 1] = last.poses[object];
        }
        rests
    }
}

/// Returns the states of a stroke: before it and after each of its frames.
fn states(trajectory: &Trajectory, stroke: usize) -> Vec<&State> {
    let frames = &trajectory.frames;
    let first = frames.iter().skip(1).position(|frame| frame.stroke == stroke);
    let Some(first) = first else { return Vec::new() };
    let own = frames[first + 1..].iter().take_while(|frame| frame.stroke == stroke);
    std::iter::once(&frames[first]).chain(own).map(|frame| &frame.state).collect()
}

/// Interpolates poses and velocities linearly, at the share `t` of the way from `a` to `b`.
fn between(a: &State, b: &State, t: f64) -> State {
    let mut state = a.clone();
    for (pose, to) in state.poses.iter_mut().zip(&b.poses) {
        *pose = pose.towards(to, t);
    }
    for (velocity, to) in state.velocities.iter_mut().zip(&b.velocities) {
        velocity.linear += (to.linear - velocity.linear) * t;
        velocity.angular += (to.angular - velocity.angular) * t;
    }
    state
}

#[cfg(test)]
mod tests;
