//! The suite: tasks of all kinds in turn, each a function of seed, kind and number alone.

use std::sync::Arc;

use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::effect::Simulated;
use pushplan::internals::geometry::{Pose, Vector, cross};
use pushplan::internals::plan::{Candidate, Rollouts};
use pushplan::internals::seeded::generator;
use pushplan::internals::sim::Simulator;
use pushplan::internals::verify::{Verifier, VerifySettings};
use pushplan::internals::{
    scene::{Scene, Situation, Tool},
    task::{Plan, Task, ToolChoice},
};
use rand_pcg::Pcg64;
use thiserror::Error;

use super::everyday::{all_in_the_way, as_filed};
use super::gap::gap_task;
use super::kind::TaskKind;
use super::layout::{open_task, seen, set_goals, wall};
use super::making::{carried_out, keeps_clear, plan, random_candidate, workspace};

/// Maximum number of tables that are drawn for a task. With the shipped tools about ten are enough.
const MOST_TABLES: usize = 3000;

/// Number of walls that are tried across a path.
const WALLS: usize = 12;

/// Random tasks of several kinds, in turn.
///
/// Every task is derived from a plan that it allows. Its goals are the final poses of this plan in
/// the 2-D engine, and the plan's replay in the 3-D engine reaches them within their tolerances.
/// Every task is therefore solvable by construction, under the rule by which plans are judged.
/// Pushes on whose outcome the engines disagree by more than the tolerance are discarded.
#[derive(Clone, Debug)]
pub struct RandomSuite {
    tools: Vec<Arc<Tool>>,
    seed: u64,
    kinds: Vec<TaskKind>,
}

/// A task and the plan that it was derived from.
#[derive(Clone, Debug)]
pub struct SuiteTask {
    /// Kind of the task.
    pub kind: TaskKind,
    /// The task.
    pub task: Task,
    /// Plan that reaches the goals, with its tools; `None` if there is no such plan.
    pub made: Option<(Plan, Vec<Arc<Tool>>)>,
}

/// Error of a suite whose tools allow no task of a kind.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("no task of the kind `{kind}` can be generated with these tools")]
pub struct NoTask {
    /// Kind of the task.
    pub kind: TaskKind,
}

impl RandomSuite {
    /// Version of the generator: another version has other tasks.
    pub const VERSION: u32 = 2;

    /// Creates a suite for the tools of `library`, of the given kinds ([`TaskKind::ALL`], if none
    /// is given).
    pub fn new(library: &ToolLibrary, seed: u64, kinds: &[TaskKind]) -> Self {
        let kinds = if kinds.is_empty() { &TaskKind::ALL } else { kinds };
        Self { tools: library.iter().cloned().collect(), seed, kinds: kinds.to_vec() }
    }

    /// Returns the kinds in their order of alternation.
    pub fn kinds(&self) -> &[TaskKind] {
        &self.kinds
    }

    /// Returns the seed.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Returns the tools.
    pub fn tools(&self) -> &[Arc<Tool>] {
        &self.tools
    }

    /// Returns task `index`. Apart from its index, a task does not depend on the other kinds of the
    /// suite.
    ///
    /// # Errors
    /// Returns an error if no task could be made with these tools.
    pub fn task(&self, index: usize) -> Result<SuiteTask, NoTask> {
        // The order of kinds is rotated from round to round, so that every residue class of
        // indices, as measured by a shard, has tasks of all kinds.
        let (round, place) = (index / self.kinds.len(), index % self.kinds.len());
        let kind = self.kinds[(round + place) % self.kinds.len()];
        // Kinds must not share tables.
        let seed = self.seed ^ 0x5EED ^ ((kind as u64 + 1) << 40);
        let mut rng = generator(seed, round as u64);
        if kind == TaskKind::Gap {
            return Ok(SuiteTask { kind, task: gap_task(&mut rng, round), made: None });
        }
        let tables = if self.tools.is_empty() { 0 } else { MOST_TABLES };
        (0..tables).find_map(|_| self.draw(&mut rng, kind, round)).ok_or(NoTask { kind })
    }

    /// Draws a task; returns `None` if the draw does not fit.
    fn draw(&self, rng: &mut Pcg64, kind: TaskKind, round: usize) -> Option<SuiteTask> {
        let mut task = open_task(rng, kind, round)?;
        let tools = self.tools_for(&task);
        if tools.is_empty() {
            return None;
        }
        let candidate = random_candidate(rng, &workspace(&task, &tools), kind)?;
        let mut plan = self.made(&mut task, kind, &candidate)?;
        if kind == TaskKind::Obstacle {
            plan = self.walled(rng, &mut task, &candidate, &plan)?;
        }
        if TaskKind::EVERYDAY.contains(&kind) {
            task = as_filed(&task)?;
            let start = task.scene.start();
            if task.goals.iter().any(|goal| goal.reached(&start)) {
                return None;
            }
        }
        let named = |name| tools.iter().find(|tool| tool.name == name).cloned();
        let tools: Vec<Arc<Tool>> = plan.tools().into_iter().filter_map(named).collect();
        let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
        let verdict = verifier.nominal(&task, &Situation::stated(&task.scene), &tools, &plan);
        let both = verdict.evidence.iter().all(|evidence| evidence.outcome.reached);
        (verdict.passed && both).then_some(SuiteTask { kind, task, made: Some((plan, tools)) })
    }

    /// Returns the tools that a task allows.
    pub(super) fn tools_for(&self, task: &Task) -> Vec<Arc<Tool>> {
        let allowed = |tool: &&Arc<Tool>| match &task.tools {
            ToolChoice::All => true,
            ToolChoice::Named(names) => names.contains(&tool.name),
        };
        self.tools.iter().filter(allowed).cloned().collect()
    }

    /// Sets the goals to the final poses of the candidate in the 2-D engine, if the result is a
    /// task of the kind.
    fn made(&self, task: &mut Task, kind: TaskKind, candidate: &Candidate) -> Option<Plan> {
        let planar = Simulated::new(Simulator::planar());
        let scene: Scene = task.scene.clone();
        let mut rollouts = Rollouts::new(&planar, Situation::stated(&scene));
        let tools = self.tools_for(task);
        let workspace = workspace(task, &tools);
        let made = carried_out(&workspace, &mut rollouts, candidate)?;
        let plan = plan(&workspace, candidate, made.pushes);
        let (start, ends) = (scene.start(), made.outcome);
        let accepted = |goal| kind.accepts(&seen(goal, &start), &seen(goal, &ends));
        let brought = task.goals.iter().all(accepted);
        if !brought || !all_in_the_way(task, kind, &ends.poses[task.goals[0].object]) {
            return None;
        }
        set_goals(task, &ends);
        Some(plan)
    }

    /// Places a wall across the straight path. The candidate must still bring the object around the
    /// wall to the same place; `plan` is its plan without the wall.
    fn walled(
        &self,
        rng: &mut Pcg64,
        task: &mut Task,
        candidate: &Candidate,
        plan: &Plan,
    ) -> Option<Plan> {
        let object = task.goals[0].object;
        let start = task.scene.objects[object].pose;
        let straight = Pose { position: task.goals[0].place(&task.scene.start()), ..start };
        let corner = corner(start.position, straight.position, candidate);
        for _ in 0..WALLS {
            let Some(wall) = wall(rng, &task.scene, object, corner, &straight) else { continue };
            let before = task.clone();
            // The robot comes after all other obstacles.
            task.scene.obstacles.insert(0, wall);
            let clear = keeps_clear(&workspace(task, &self.tools), candidate, &plan.pushes());
            let plan = clear.then(|| self.made(task, TaskKind::Obstacle, candidate)).flatten();
            // A wall that the object is pushed against would change the task.
            let kept = (task.goals[0].place(&task.scene.start()) - straight.position).norm() < 1e-3;
            match plan {
                Some(plan) if kept => return Some(plan),
                _ => *task = before,
            }
        }
        None
    }
}

/// Returns roughly the point at which the object is farthest from its straight path, if every push
/// moves it by its whole length.
fn corner(start: Vector, end: Vector, candidate: &Candidate) -> Vector {
    let way = end - start;
    let mut at = start;
    let mut farthest = (0.0, start);
    for push in &candidate.pushes {
        at += Vector::new(push.direction.cos(), push.direction.sin()) * push.length;
        let off = cross(way, at - start).abs();
        if off > farthest.0 {
            farthest = (off, at);
        }
    }
    farthest.1
}
