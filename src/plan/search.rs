//! Rollout search over push sequences: all first pushes, then a beam of the most promising states,
//! one more push at a time.
//!
//! Every rollout is recorded frame by frame. The tool may stop after any frame, so that one rollout
//! also scores every shorter push. The budget counts rollouts and not seconds, and ties go to the
//! lower index, so that a search is deterministic on any machine. [`variants`] are searches for
//! other kinds of plans.

mod continuation;
mod gate;
mod variants;

use std::sync::Arc;

use rayon::prelude::*;

use crate::progress::Progress;
use crate::{
    outcome::{Record, Trajectory},
    scene::Situation,
    task::{Job, PushForm, ToolMotion},
};

use super::beam::Stop;
use super::cost_to_go::CostToGo;
use super::enumerate::{Extension, Grips, Resolution, by_promise, extensions};
use super::node::Node;
use super::reached::Reached;
use super::rollouts::{single_push, stops};
use super::score::{final_score, finite_score, is_blocked};
use super::scored::Scores;
use super::statistics::SearchStatistics;
use super::uncertainty::Uncertainty;
use super::workspace::MIN_LENGTH;
use super::{Candidate, Rollouts, ScoredPush, SearchResult, Workspace};
use gate::Gate;

/// Number of rollouts per batch: enough for every thread, and few enough that their recorded frames
/// stay in the cache.
const BATCH: usize = 256;

/// Number of frames between the stops offered to the beam, in addition to the best and last stop.
const BEAM_STRIDE: usize = 5;

/// Budgets of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchSettings {
    /// Number of lateral offsets per contacting face, if the task lists none.
    pub offsets: usize,
    /// Whether offsets between infeasible ones are tried as well.
    pub fine_offsets: bool,
    /// Number of states from which sequences are continued.
    pub beam: usize,
    /// Maximum number of rollouts for each further push of a sequence.
    pub rollouts: usize,
    /// Number of scored candidates kept.
    pub kept: usize,
    /// Number of best kinds of candidates that must be certain before a level ends. A level has
    /// fewer kinds than the largest number, with which it never ends early.
    pub kinds: usize,
    /// Occasional error of the effect model, metres. Later pushes keep this additional clearance.
    pub model_error: f64,
}

/// Search in progress.
pub struct Search<'a> {
    workspace: Workspace<'a>,
    situation: Situation,
    settings: SearchSettings,
    field: CostToGo<'a>,
    grips: Grips,
    reached: Reached<'a>,
    nodes: Vec<Node>,
    /// Last pushes and their possible stops, from which the next level starts. They become nodes on
    /// demand, because rolling them out is wasted if shorter plans work.
    ends: (Vec<Extension>, Vec<Stop>),
    /// Indices of the last pushes that are rolled out only if longer sequences are needed.
    waiting: Vec<usize>,
    spread: Uncertainty,
    depth: usize,
    statistics: SearchStatistics,
    scores: Scores,
}

impl<'a> Search<'a> {
    /// Prepares a search without any rollout.
    pub fn new(workspace: Workspace<'a>, situation: &Situation, settings: SearchSettings) -> Self {
        let laid = (CostToGo::new(workspace.task), Uncertainty::around(situation));
        Self::laid(workspace, situation, settings, laid)
    }

    /// Prepares a search with the task's cost to go and the situation's uncertainty, which can be
    /// shared by several searches.
    pub fn laid(
        workspace: Workspace<'a>,
        situation: &Situation,
        settings: SearchSettings,
        laid: (CostToGo<'a>, Uncertainty),
    ) -> Self {
        let yaws = &workspace.task.pushes.grip_yaws;
        let grips = (0..workspace.tools.len())
            .flat_map(|tool| yaws.iter().map(move |&yaw| (tool, yaw)))
            .collect();
        let grips = Grips { all: grips, changes: None };
        Self::from_start(workspace, situation, settings, laid, grips)
    }

    fn from_start(
        workspace: Workspace<'a>,
        situation: &Situation,
        settings: SearchSettings,
        (field, spread): (CostToGo<'a>, Uncertainty),
        grips: Grips,
    ) -> Self {
        let start = Node {
            candidate: None,
            state: situation.start.clone(),
            end: None,
            others: spread.starts().to_vec(),
            room: 0.0,
        };
        let reached = Reached::new(workspace, &situation.start, &grips.all);
        Self {
            workspace,
            reached,
            situation: situation.clone(),
            settings,
            field,
            grips,
            nodes: vec![start],
            ends: Default::default(),
            waiting: Vec::new(),
            spread,
            depth: 0,
            statistics: SearchStatistics::default(),
            scores: Scores::default(),
        }
    }

    /// Returns the limits for pushes.
    pub fn workspace(&self) -> Workspace<'a> {
        self.workspace
    }

    /// Returns the budgets of the search.
    pub fn settings(&self) -> SearchSettings {
        self.settings
    }

    /// Returns the tools and grip yaws (radians) that the search tries.
    pub fn grips(&self) -> &[(usize, f64)] {
        &self.grips.all
    }

    /// Returns the number of pushes per candidate in the last call of [`Search::deepen`].
    pub fn depth(&self) -> usize {
        self.depth
    }

    /// Returns the statistics of the search so far.
    pub fn statistics(&self) -> &SearchStatistics {
        &self.statistics
    }

    /// Returns every kind of push considered so far, with its best score.
    pub fn scored(&self) -> &[ScoredPush] {
        self.scores.list()
    }

    /// Returns `true` if sequences with one more push are allowed, and a state remains from which
    /// to continue.
    pub fn can_deepen(&self) -> bool {
        let any = self.depth == 0 || !self.ends.1.is_empty() || !self.waiting.is_empty();
        self.depth < self.workspace.task.pushes.max_count && any
    }

    /// Searches all sequences with one more push and returns the best ones, best first. `progress`
    /// receives the numbers of completed and total rollouts. If it stops the search, the best
    /// results so far are returned.
    pub fn deepen(
        &mut self,
        rollouts: &mut Rollouts,
        progress: &dyn Progress,
    ) -> Vec<SearchResult> {
        if self.depth > 0 {
            let (list, mut offers) = std::mem::take(&mut self.ends);
            let waiting = std::mem::take(&mut self.waiting);
            for batch in waiting.chunks(BATCH).take_while(|_| !progress.cancelled()) {
                self.roll(rollouts, &list, batch, &mut offers);
            }
            offers.sort_by_key(|stop| stop.extension);
            let before = rollouts.used();
            self.nodes = self.continue_from(rollouts, &list, offers);
            self.statistics.rollouts += rollouts.used() - before;
        }
        self.scores.deepen();
        let mut list = extensions(
            &self.workspace,
            &self.field,
            &self.nodes,
            (&self.grips, &self.reached),
            Resolution { coarse: self.settings.offsets, fine: self.settings.fine_offsets },
            &mut self.statistics,
            &mut self.scores,
        );
        // The search with coarse offsets alone has been made before.
        if self.settings.fine_offsets && self.depth == 0 && !list.iter().any(|one| one.fine) {
            list.clear();
        }
        let order = by_promise(&list, self.settings.rollouts);
        self.statistics.beyond_budget += list.len() - order.len();
        let mut found: Vec<(usize, SearchResult)> = Vec::new();
        let mut offers = Vec::new();
        let mut done = 0;
        // The tree of chained pushes is kept whole.
        let mut gate = self.workspace.is_placed().then(|| Gate::new(self.settings.kinds));
        let size = gate.as_ref().map_or(BATCH, |_| Gate::batch(order.len()).min(BATCH));
        for batch in order.chunks(size) {
            if progress.cancelled() || gate.as_ref().is_some_and(Gate::is_closed) {
                break;
            }
            progress.update(done as u64, order.len() as u64);
            found.extend(self.roll(rollouts, &list, batch, &mut offers));
            done += batch.len();
            // Equal scores are in the order of enumeration.
            found.sort_by(|a, b| a.1.score.total_cmp(&b.1.score).then(a.0.cmp(&b.0)));
            if let Some(gate) = &mut gate {
                gate.look(&found);
            }
        }
        progress.update(order.len() as u64, order.len() as u64);
        self.depth += 1;
        offers.sort_by_key(|stop| stop.extension);
        let stopped = progress.cancelled();
        self.waiting = if stopped { Vec::new() } else { order[done..].to_vec() };
        self.ends = if stopped { Default::default() } else { (list, offers) };
        found.truncate(self.settings.kept);
        found.into_iter().map(|(_, one)| one).collect()
    }

    /// Rolls out the pushes `batch` of `list`. Returns the resulting candidates with their indices,
    /// and adds the stops worth continuing from to `offers`.
    fn roll(
        &mut self,
        rollouts: &mut Rollouts,
        list: &[Extension],
        batch: &[usize],
        offers: &mut Vec<Stop>,
    ) -> Vec<(usize, SearchResult)> {
        let before = rollouts.used();
        let jobs: Vec<_> = batch.iter().map(|&k| self.job(&list[k])).collect();
        let trajectories = rollouts.run(&jobs, Record::Frames);
        let rated: Vec<_> = batch
            .par_iter()
            .zip(&trajectories)
            .map(|(&k, trajectory)| self.rate(&list[k], trajectory))
            .collect();
        let mut found = Vec::new();
        for (position, (&k, (best, stops))) in batch.iter().zip(rated).enumerate() {
            if let Some((score, length)) = best {
                self.statistics.improve(self.statistics.rollouts + position + 1, score);
                self.scores.improve(list[k].scored, score);
                let candidate = self.candidate(&list[k], length);
                // The search without changes already finds candidates with one grip.
                if self.grips.changes.is_none() || !candidate.has_one_grip() {
                    found.push((k, SearchResult { candidate, score }));
                }
            }
            offers.extend(stops.into_iter().map(|stop| stop.of(k)));
        }
        self.statistics.rollouts += rollouts.used() - before;
        found
    }

    fn job(&self, extension: &Extension) -> Job {
        let start = self.nodes[extension.node].state.clone();
        let physics = Arc::clone(&self.situation.physics);
        Job { start, motion: self.motion(extension).into(), physics }
    }

    fn motion(&self, extension: &Extension) -> ToolMotion {
        single_push(
            &self.workspace.tools[extension.planned.tool],
            self.workspace.task.pushes.lift,
            extension.planned.grip_yaw,
            &extension.push,
        )
    }

    fn candidate(&self, extension: &Extension, length: f64) -> Candidate {
        let before = self.nodes[extension.node].candidate.clone().unwrap_or_default();
        before.then(super::CandidatePush { length, ..extension.planned })
    }

    /// Returns the best stop of a rollout as `(score, length)`, and the stops worth continuing
    /// from.
    fn rate(
        &self,
        extension: &Extension,
        trajectory: &Trajectory,
    ) -> (Option<(f64, f64)>, Vec<Stop>) {
        let (task, length) = (self.workspace.task, extension.push.length);
        let Some(last) = trajectory.frames.last() else { return (None, Vec::new()) };
        let object = extension.planned.object;
        let counts = task.has_goal(task.scene.thing(object));
        let mut best = match counts {
            true => (final_score(task, trajectory), length),
            // Moving an obstruction is not yet a plan.
            false => (f64::INFINITY, length),
        };
        let before = self.nodes[extension.node].candidate.as_ref();
        let deeper = before.map_or(0, |one| one.pushes.len()) + 1 < task.pushes.max_count;
        let placed = task.pushes.form == PushForm::Placed;
        let stroke = &self.motion(extension).strokes[0];
        let mut offers: Vec<Stop> = Vec::new();
        let mut cheapest: Option<Stop> = None;
        let moving = stroke.frames();
        // A blocked trajectory holds the frames up to the obstruction, followed by the outcome.
        let blocked = is_blocked(trajectory);
        let recorded = trajectory.frames.len() - usize::from(blocked);
        for (frame, travel) in stops(stroke, recorded) {
            if travel < MIN_LENGTH {
                continue;
            }
            let state = &trajectory.frames[frame].state;
            let rest = self.situation.coasted(state);
            let score = finite_score(task, &rest);
            if frame < moving && score < best.0 && counts {
                best = (score, travel);
            }
            // A chained push is continued only from its end; refinement varies its turning point
            // later.
            if deeper && (placed && frame < moving) {
                let cost = self.field.cost(&rest);
                let stop = Stop::new(extension, travel, cost, &rest, None);
                if cheapest.as_ref().is_none_or(|c| cost < c.cost) {
                    cheapest = Some(stop.clone());
                }
                if frame % BEAM_STRIDE == 0 {
                    offers.push(stop);
                }
            }
        }
        if deeper {
            // The state after the whole push is known exactly and needs no further rollout.
            let index = if placed { trajectory.frames.len() - 1 } else { moving };
            let known = trajectory.frames.get(index).unwrap_or(last).state.clone();
            if known.is_finite() && !blocked {
                let rest = self.situation.coasted(&known);
                let cost = self.field.cost(&rest);
                offers.push(Stop::new(extension, length, cost, &rest, Some(known)));
            }
            offers.extend(cheapest);
        }
        (best.0.is_finite().then_some(best), offers)
    }
}
