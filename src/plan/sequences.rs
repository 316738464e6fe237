//! Every chained sequence of a scene, rolled out once and asked for any goal.
//!
//! Sequences that begin alike share their beginning: with g grips and d directions,
//! g (d + d^2 + d^3) pushes are rolled out for three-push sequences and not 3 g d^3. For an
//! effect model whose state is poses and velocities alone this is exact: going on from the
//! state kept at the end of a push is the same computation as never having paused there. A
//! simulator also remembers contact forces, so its sequences can be played whole instead.
//!
//! The tool may stop after any of a number of equal steps of a push. Where the object then
//! comes to rest is estimated by free sliding, which ranks the stops; whoever acts on one
//! rolls it out (see [`super::evaluate`]).

use std::sync::Arc;

use crate::effect::Job;
use crate::geometry::{Pose, Vector};
use crate::scene::{Goal, Push, Record, Situation, State, ToolMotion, Trajectory};

use super::rollouts::{coasted, finite_score};
use super::{Candidate, CandidatePush, Found, Rollouts, Start, Workspace};

/// All chained sequences of up to the task's number of pushes, for some grips.
#[derive(Clone, Debug, PartialEq)]
pub struct SequenceTree {
    start: State,
    /// Index of the goal object.
    object: usize,
    length: f64,
    /// Equal steps of a push after each of which the tool may stop.
    steps: usize,
    /// Level by level; a sequence of pushes is the way from a root to a branch.
    branches: Vec<Branch>,
}

/// The last push of a sequence.
#[derive(Clone, Debug, PartialEq)]
struct Branch {
    grip: (usize, f64),
    before: Option<usize>,
    direction: f64,
    /// Where the goal object would come to rest had the tool stopped after each step.
    rests: Vec<Pose>,
}

/// A state from which sequences go on.
struct Node {
    grip: (usize, f64),
    branch: Option<usize>,
    state: State,
    end: Vector,
}

impl SequenceTree {
    /// Rolls out all sequences of `grips` (tool and grip yaw), each beginning once. The tool may
    /// stop after each of `steps` equal steps of a push.
    pub fn roll(
        workspace: &Workspace,
        rollouts: &mut Rollouts,
        grips: &[(usize, f64)],
        steps: usize,
    ) -> Self {
        let mut tree = Self::empty(workspace, rollouts.situation(), steps);
        let (rules, home) = (&workspace.task.pushes, workspace.task.robot.home);
        let root = |&grip| Node { grip, branch: None, state: tree.start.clone(), end: home };
        let mut nodes: Vec<Node> = grips.iter().map(root).collect();
        for level in 1..=rules.max_count {
            let last = level == rules.max_count;
            let pushes: Vec<(&Node, Push)> = nodes
                .iter()
                .flat_map(|node| headings(workspace).map(move |way| (node, way)))
                .map(|(node, way)| (node, straight(workspace, node.end, way)))
                .collect();
            let jobs: Vec<Job> = pushes
                .iter()
                .map(|(node, push)| {
                    let motion = motion(workspace, node.grip, &[*push]);
                    let mut job = rollouts.job(motion, node.state.clone());
                    // Only the end of a sequence waits for rest.
                    job.motion.strokes[0].settle = last;
                    job
                })
                .collect();
            let trajectories = rollouts.run(&jobs, Record::Frames);
            let mut next = Vec::new();
            for (((node, push), job), trajectory) in pushes.iter().zip(&jobs).zip(&trajectories) {
                let moving = job.motion.strokes[0].frames();
                let states = states(trajectory, 0);
                let played = Played { states: &states, moving, settled: last };
                let rests = played.rests(rollouts.situation(), tree.object, steps);
                let (grip, before, direction) = (node.grip, node.branch, push.direction);
                tree.branches.push(Branch { grip, before, direction, rests });
                if let Some(state) = states.get(moving).filter(|state| state.is_finite()) {
                    next.push(Node {
                        grip: node.grip,
                        branch: Some(tree.branches.len() - 1),
                        state: (*state).clone(),
                        end: push.end(),
                    });
                }
            }
            nodes = next;
        }
        tree
    }

    /// The same, every sequence of the greatest length played from its beginning to rest: exact
    /// for any model, and 3 d^3 / (d + d^2 + d^3) times as dear for three pushes.
    pub fn roll_whole(
        workspace: &Workspace,
        rollouts: &mut Rollouts,
        grips: &[(usize, f64)],
        steps: usize,
    ) -> Self {
        let mut tree = Self::empty(workspace, rollouts.situation(), steps);
        let count = workspace.task.pushes.max_count as u32;
        let ways: Vec<f64> = headings(workspace).collect();
        let sequences = ways.len().pow(count);
        let digit = |sequence: usize, level: u32| sequence / ways.len().pow(count - 1 - level);
        let mut jobs = Vec::with_capacity(grips.len() * sequences);
        for &grip in grips {
            for sequence in 0..sequences {
                let mut end = workspace.task.robot.home;
                let pushes: Vec<Push> = (0..count)
                    .map(|level| {
                        let push =
                            straight(workspace, end, ways[digit(sequence, level) % ways.len()]);
                        end = push.end();
                        push
                    })
                    .collect();
                let motion = motion(workspace, grip, &pushes);
                jobs.push((pushes, rollouts.job(motion, tree.start.clone())));
            }
        }
        let (pushes, jobs): (Vec<Vec<Push>>, Vec<Job>) = jobs.into_iter().unzip();
        let trajectories = rollouts.run(&jobs, Record::Frames);
        let mut before: Vec<Option<usize>> = vec![None; jobs.len()];
        for level in 0..count {
            // Sequences that begin alike are the same up to there: the first stands for all.
            let alike = ways.len().pow(count - 1 - level);
            for first in (0..jobs.len()).step_by(alike) {
                let states = states(&trajectories[first], level as usize);
                let moving = jobs[first].motion.strokes[level as usize].frames();
                let grip = grips[first / sequences];
                let direction = pushes[first][level as usize].direction;
                let played = Played { states: &states, moving, settled: level + 1 == count };
                let rests = played.rests(rollouts.situation(), tree.object, steps);
                tree.branches.push(Branch { grip, before: before[first], direction, rests });
                before[first..first + alike].fill(Some(tree.branches.len() - 1));
            }
        }
        tree
    }

    /// The best stop of every sequence and of every beginning of one, the best `count` of them,
    /// best first; the score is estimated. Only grips that `allowed` lets through.
    pub fn best(
        &self,
        goal: &Goal,
        count: usize,
        allowed: impl Fn((usize, f64)) -> bool,
    ) -> Vec<Found> {
        let mut state = self.start.clone();
        let mut scored: Vec<(f64, usize, usize)> = Vec::with_capacity(self.branches.len());
        for (index, branch) in self.branches.iter().enumerate() {
            if !allowed(branch.grip) {
                continue;
            }
            let mut best = (f64::INFINITY, index, 0);
            for (step, rest) in branch.rests.iter().enumerate() {
                state.poses[goal.object] = *rest;
                let score = finite_score(goal, &state);
                if score < best.0 {
                    best = (score, index, step);
                }
            }
            if best.0.is_finite() {
                scored.push(best);
            }
        }
        // Stable, so that of equal ones the shortest sequence comes first.
        scored.sort_by(|a, b| a.0.total_cmp(&b.0));
        scored.truncate(count);
        scored
            .into_iter()
            .map(|(score, branch, step)| Found { candidate: self.candidate(branch, step), score })
            .collect()
    }

    /// Where every whole sequence of the greatest length leaves the goal object, grip by grip
    /// and in the order of directions, the last push changing fastest.
    pub fn ends(&self) -> impl Iterator<Item = (Candidate, Pose)> {
        let deepest = (0..self.branches.len()).map(|k| self.depth(k)).max().unwrap_or(0);
        (0..self.branches.len()).filter(move |&k| self.depth(k) == deepest).filter_map(|k| {
            let last = self.steps.checked_sub(1)?;
            let rest = *self.branches[k].rests.get(last)?;
            Some((self.candidate(k, last), rest))
        })
    }

    fn empty(workspace: &Workspace, situation: &Situation, steps: usize) -> Self {
        let task = workspace.task;
        Self {
            start: situation.start.clone(),
            object: task.goal.object,
            length: task.pushes.length,
            steps,
            branches: Vec::new(),
        }
    }

    fn depth(&self, branch: usize) -> usize {
        std::iter::successors(Some(branch), |&k| self.branches[k].before).count()
    }

    /// The sequence that ends with `branch`, cut after its step number `step` (from 0).
    fn candidate(&self, branch: usize, step: usize) -> Candidate {
        let (tool, grip_yaw) = self.branches[branch].grip;
        let mut pushes: Vec<CandidatePush> =
            std::iter::successors(Some(branch), |&k| self.branches[k].before)
                .map(|k| CandidatePush {
                    start: Start::Chained,
                    direction: self.branches[k].direction,
                    length: self.length,
                })
                .collect();
        pushes.reverse();
        if let Some(last) = pushes.last_mut() {
            last.length = self.length * (step + 1) as f64 / self.steps as f64;
        }
        Candidate { tool, grip_yaw, pushes }
    }
}

/// What one push of a sequence did, frame by frame.
struct Played<'a> {
    /// The state before the push, then after every frame.
    states: &'a [&'a State],
    /// Frames in which the tool moves.
    moving: usize,
    /// Whether the states go on until rest.
    settled: bool,
}

impl Played<'_> {
    /// Where the object rests if the tool stops after each of `steps` equal steps; fewer where
    /// the rollout broke off. Between two frames the state is interpolated.
    fn rests(&self, situation: &Situation, object: usize, steps: usize) -> Vec<Pose> {
        let mut rests = Vec::with_capacity(steps);
        for step in 1..=steps {
            let (place, rest) = (step * self.moving / steps, step * self.moving % steps);
            let Some(&before) = self.states.get(place) else { break };
            let state = match (rest, self.states.get(place + 1)) {
                (0, _) => before.clone(),
                (_, Some(after)) => between(before, after, rest as f64 / steps as f64),
                (_, None) => break,
            };
            rests.push(coasted(situation, &state).poses[object]);
        }
        if let (true, Some(last)) = (self.settled && rests.len() == steps, self.states.last()) {
            rests[steps - 1] = last.poses[object];
        }
        rests
    }
}

/// The states of a stroke: the one before it and those after its frames.
fn states(trajectory: &Trajectory, stroke: usize) -> Vec<&State> {
    let frames = &trajectory.frames;
    let first = frames.iter().skip(1).position(|frame| frame.stroke == stroke);
    let Some(first) = first else { return Vec::new() };
    let own = frames[first + 1..].iter().take_while(|frame| frame.stroke == stroke);
    std::iter::once(&frames[first]).chain(own).map(|frame| &frame.state).collect()
}

/// The state at the share `t` of the way from `a` to `b`, poses and velocities linear.
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

fn headings(workspace: &Workspace) -> impl Iterator<Item = f64> {
    workspace.task.pushes.directions.headings().into_iter()
}

fn straight(workspace: &Workspace, start: Vector, direction: f64) -> Push {
    let rules = &workspace.task.pushes;
    Push { start, direction, length: rules.length, speed: rules.speed }
}

fn motion(workspace: &Workspace, grip: (usize, f64), pushes: &[Push]) -> ToolMotion {
    let tool = Arc::clone(&workspace.tools[grip.0]);
    ToolMotion::pushes(tool, workspace.task.pushes.lift, grip.1, pushes, false)
}
