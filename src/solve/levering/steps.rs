//! The loop over steps: a lever-up alone; where that does not do, pushes after one; where there is
//! none, pushes to where one can be made.

use crate::watch::Instant;
use std::f64::consts::TAU;
use std::sync::Arc;

use crate::asset::ToolLibrary;
use crate::geometry::{Pose3, Solid, Vector};
use crate::sim::LeverSimulator;
use crate::solve::grade::{Class, Grade};
use crate::solve::solution::LeverStatistics;
use crate::solve::{PlanStatus, Planner, RankedPlan, Solution, SolveError, Statistics, Timing};
use crate::verify::{Verifier, VerifySettings};
use crate::watch::{Until, Unwatched, Watch};
use crate::{
    outcome::{Outcome, Record, Trajectory, Verdict},
    scene::{LeverScene, Models, Obstacle, Scene, Situation, Tool},
    task::{Goal, Plan, Task, ToolChoice},
};

use super::LeverSettings;
use super::search::rank;

/// How far an object is pushed to where it can be levered, metres, and in how many directions.
const AWAY: [f64; 3] = [0.08, 0.14, 0.2];
const WAYS: usize = 8;

/// At most this many plans come back: what a reader looks at.
const REPORTED: usize = 8;

/// How near it must come to there, metres: the blade goes where the replay as written has it then.
const NEAR: f64 = 0.01;

/// A task in which something leaves the plane, being solved.
pub(in crate::solve) struct Steps<'a> {
    pub(super) planner: &'a Planner,
    pub(super) task: &'a Task,
    situation: Situation,
    library: &'a ToolLibrary,
    blades: &'a [Arc<Tool>],
    pub(super) settings: LeverSettings,
    pub(super) until: &'a Until<'a>,
    pub(super) statistics: LeverStatistics,
    timing: Timing,
}

/// What was done before a step, with its tools.
#[derive(Default)]
pub(super) struct Made {
    pub plan: Plan,
    pub tools: Vec<Arc<Tool>>,
}

impl Made {
    /// Its tools and these, each once.
    pub fn with(&self, more: &[Arc<Tool>]) -> Vec<Arc<Tool>> {
        let mut tools = self.tools.clone();
        for tool in more {
            if !tools.iter().any(|known| known.name == tool.name) {
                tools.push(Arc::clone(tool));
            }
        }
        tools
    }
}

impl<'a> Steps<'a> {
    pub fn new(
        planner: &'a Planner,
        (task, situation): (&'a Task, &Situation),
        library: &'a ToolLibrary,
        blades: &'a [Arc<Tool>],
        until: &'a Until<'a>,
    ) -> Self {
        Self {
            planner,
            task,
            situation: situation.clone(),
            library,
            blades,
            settings: planner.settings().levers,
            until,
            statistics: LeverStatistics::default(),
            timing: Timing::default(),
        }
    }

    pub fn run(mut self) -> Result<Solution, SolveError> {
        let (began, task) = (Instant::now(), self.task);
        let pushes = task.pushes.max_count > 0;
        let mut plans = match task.levers {
            Some(_) => self.lever_up(task, &Made::default()),
            None => Vec::new(),
        };
        if pushes && !self.is_over(&plans) {
            let alone = std::mem::take(&mut plans);
            plans = self.with_pushes()?;
            // What a lever-up alone comes to is the nearest where no push helps.
            plans.extend(alone);
            rank(&mut plans);
        }
        if pushes && task.levers.is_some() && !works(&plans) && !self.until.cancelled() {
            let found = self.after_pushes()?;
            plans.extend(found);
            rank(&mut plans);
        }
        plans.truncate(REPORTED);
        self.timing.total = began.elapsed().as_secs_f64();
        let tools = self.blades.iter().map(|tool| Tool::clone(tool)).collect();
        Ok(Solution {
            status: self.status(&plans),
            stopped: self.until.cancelled(),
            // Of lever-ups the coarse simulation decides.
            models: Models::from(LeverSimulator::COARSE.spec())
                .screened_by(self.planner.screen().spec().clone()),
            tools,
            candidates: Vec::new(),
            statistics: Statistics {
                rollouts: self.statistics.search.rollouts,
                verified: self.statistics.verified,
                depth: plans.first().map_or(0, |best| best.plan.steps.len()),
                timing: self.timing,
                levers: Some(self.statistics),
                ..Statistics::default()
            },
            partial: None,
            cause: None,
            warnings: Vec::new(),
            plans,
        })
    }

    /// Whether nothing more is to be looked for.
    fn is_over(&self, plans: &[RankedPlan]) -> bool {
        self.status(plans) == PlanStatus::Solved || self.until.cancelled()
    }

    /// How solving ended, by its plans.
    fn status(&self, plans: &[RankedPlan]) -> PlanStatus {
        let verdicts = plans.iter().filter_map(|plan| plan.verdict.as_ref());
        let best = verdicts.map(|verdict| Grade::of(self.task, verdict).class).max();
        best.map_or(PlanStatus::NoPlan, Class::status)
    }

    /// Lever-ups of `task`, after what was `made` before.
    fn lever_up(&mut self, task: &Task, made: &Made) -> Vec<RankedPlan> {
        let began = Instant::now();
        self.until.stage("searching lever-ups");
        let blades = self.blades;
        let simulated = self.look(task, blades);
        self.timing.search += began.elapsed().as_secs_f64();
        let began = Instant::now();
        self.until.stage("verifying lever-ups");
        let plans = self.confirm(task, blades, made, simulated);
        self.timing.verification += began.elapsed().as_secs_f64();
        plans
    }

    /// Plans of a lever-up with pushes that follow: the object is levered to where it lies on the
    /// table, as the goal asks for, and pushed to its place from there. Of a task without lever-ups,
    /// pushes alone.
    fn with_pushes(&mut self) -> Result<Vec<RankedPlan>, SolveError> {
        if self.task.levers.is_none() {
            let rests: Vec<Pose3> = self.task.scene.plates().map(|plate| plate.start()).collect();
            return Ok(self.pushed(&Made::default(), &rests)?.into_iter().collect());
        }
        self.followed(self.task, &Made::default())
    }

    /// Plans of what was `made`, a lever-up of `task`, and pushes that follow.
    fn followed(&mut self, task: &Task, made: &Made) -> Result<Vec<RankedPlan>, SolveError> {
        // The place is left to the pushes.
        let goal = Goal { tolerance: f64::INFINITY, ..task.goals[0].clone() };
        let lifted = Task { goals: vec![goal], ..task.clone() };
        let levered = self.lever_up(&lifted, made);
        let began = Instant::now();
        let mut plans = Vec::new();
        let mut tried = 0;
        for ranked in levered.into_iter().filter(|ranked| ranked.outcome.reached) {
            if tried == self.settings.followed || self.until.cancelled() {
                break;
            }
            let Some(rests) = self.rests(&ranked.plan, &ranked.tools) else { continue };
            if self.left(&rests).is_none() {
                continue;
            }
            tried += 1;
            self.statistics.followed += 1;
            let made = Made { plan: ranked.plan, tools: ranked.tools };
            let Some(whole) = self.pushed(&made, &rests)? else { continue };
            let passed = whole.verdict.as_ref().is_some_and(|verdict| verdict.passed);
            plans.push(whole);
            if passed {
                break;
            }
        }
        self.timing.refinement += began.elapsed().as_secs_f64();
        Ok(plans)
    }

    /// Plans that first push the object to where it can be levered.
    fn after_pushes(&mut self) -> Result<Vec<RankedPlan>, SolveError> {
        let start: Vec<Pose3> = self.task.scene.plates().map(|plate| plate.start()).collect();
        let (goal, at) =
            (self.task.goals[0].clone(), self.task.scene.objects[self.task.goals[0].object].pose);
        let mut plans = Vec::new();
        let mut tried = 0;
        let ways = AWAY
            .into_iter()
            .flat_map(|away| (0..WAYS).map(move |k| (away, TAU * k as f64 / WAYS as f64)));
        for (away, direction) in ways {
            if tried == self.settings.followed || self.until.cancelled() {
                break;
            }
            let place = at.position + away * Vector::new(direction.cos(), direction.sin());
            let mut there = self.task.clone();
            there.goals[0].tolerance = f64::INFINITY;
            there.scene.objects[goal.object].pose.position = place;
            there.scene.place_parts();
            if !self.is_free(&there) || self.promising(&there, self.blades) == 0 {
                continue;
            }
            tried += 1;
            self.until.stage("pushing to where it can be levered");
            let goals = vec![Goal::new(goal.object, place.into(), NEAR)];
            let towards = Task { goals, ..self.task.clone() };
            let Some(mut left) = towards.after(&start) else { continue };
            left.tools = self.pushers();
            let pushed = self.planner.solve_with(&left, self.library, self.until)?;
            let Some(best) = pushed.best().filter(|best| !best.plan.is_empty()) else { continue };
            if !best.verdict.as_ref().is_some_and(Verdict::works) {
                continue;
            }
            let made = Made { plan: best.plan.clone(), tools: best.tools.clone() };
            let Some(rests) = self.rests(&made.plan, &made.tools) else { continue };
            let Some(moved) = self.task.moved_to(&rests) else { continue };
            let mut found = self.lever_up(&moved, &made);
            if goal.has_place() && !works(&found) {
                found.extend(self.followed(&moved, &made)?);
            }
            let solved = works(&found);
            plans.extend(found);
            if solved {
                break;
            }
        }
        Ok(plans)
    }

    /// Whether the goal's object has room where it is put.
    fn is_free(&self, task: &Task) -> bool {
        let (scene, own) = (&task.scene, task.plate());
        let others = scene.plates().enumerate().filter(|(k, _)| *k != task.goals[0].object);
        let others = others.flat_map(|(_, plate)| plate.solids());
        let others: Vec<Solid> =
            others.chain(scene.obstacles.iter().map(Obstacle::solid)).collect();
        let clear = |solid: &Solid| others.iter().all(|other| solid.depth(other) <= 0.0);
        own.solids().iter().all(clear) && task.robot.reaches(own.pose.position)
    }

    /// Where a plan leaves all objects, as written.
    fn rests(&self, plan: &Plan, tools: &[Arc<Tool>]) -> Option<Vec<Pose3>> {
        self.simulated(LeverSimulator::FINE, plan, tools)?.outcome().space.clone()
    }

    /// A plan as written.
    fn simulated(
        &self,
        engine: LeverSimulator,
        plan: &Plan,
        tools: &[Arc<Tool>],
    ) -> Option<Trajectory> {
        let motions = plan.motions(tools)?;
        let first = plan.lever_steps().next();
        let blade =
            first.and_then(|step| tools.iter().find(|tool| tool.name == step.tool)?.blade());
        let planned = LeverScene::new(&self.task.scene, blade.unwrap_or_default());
        let watched = (Record::Outcome, &Unwatched as _);
        Some(engine.run_all((&planned, &planned), None, &motions, watched))
    }

    /// Names of the tools that push.
    fn pushers(&self) -> ToolChoice {
        self.task.pushers(self.library)
    }

    /// What is left to be pushed once all objects lie at `rests`, if it can be.
    fn left(&self, rests: &[Pose3]) -> Option<Task> {
        let left = self.task.after(rests)?;
        Some(Task { tools: self.pushers(), ..left })
    }

    /// What was `made` with the pushes that bring the object to its place from `rests`, verified as a
    /// whole; nothing if there are none.
    fn pushed(&mut self, made: &Made, rests: &[Pose3]) -> Result<Option<RankedPlan>, SolveError> {
        self.until.stage("pushing");
        let Some(left) = self.left(rests) else { return Ok(None) };
        let pushed = self.planner.solve_with(&left, self.library, self.until)?;
        let Some(best) = pushed.best() else { return Ok(None) };
        let plan = made.plan.clone().then(best.plan.clone());
        let tools = made.with(&best.tools);
        let Some(trajectory) = self.simulated(LeverSimulator::COARSE, &plan, &tools) else {
            return Ok(None);
        };
        let scene: &Scene = &self.task.scene;
        let outcome = Outcome::judge(scene, self.task, &trajectory);
        let verdict = self.verify(self.task, &plan, &tools);
        self.statistics.verified += 1;
        let mut whole = self.ranked(plan, &tools, trajectory, outcome);
        whole.verdict = Some(verdict);
        Ok(Some(whole))
    }

    /// The verdict on a plan of the whole task with this goal.
    pub(super) fn verify(&self, task: &Task, plan: &Plan, tools: &[Arc<Tool>]) -> Verdict {
        let (disturbed, seed) = (self.settings.disturbed, self.planner.seed());
        let verifier = Verifier::new(VerifySettings { disturbed, seed }).watched(self.until);
        let nominal = verifier.nominal(task, &self.situation, tools, plan);
        match nominal.passed {
            true => verifier.disturb(task, &self.situation, tools, plan, nominal),
            false => nominal,
        }
    }
}

/// Whether one of them works as written.
fn works(plans: &[RankedPlan]) -> bool {
    plans.iter().filter_map(|plan| plan.verdict.as_ref()).any(Verdict::works)
}
