//! Trials of every method on one task, with all tool poses or one alone: choose, then execute in
//! both engines.

use std::sync::Arc;

use rand::Rng;

use crate::store::Seconds;
use pushplan::geometry::Vector;
use pushplan::{
    asset::ToolLibrary,
    effect::{EffectModel, Simulated},
    scene::Engine,
    seeded::generator,
    sim::Simulator,
    solve::{Planner, Solution, SolveError},
    task::{Directions, Push, PushForm, Task},
};

use super::{
    choose::{Choice, first_choice, nothing},
    execute::{Action, Landing},
    measure::Shared,
    record::{Executed, Method, ToolTrial},
    setup::{ReferenceSetup, STEPS, TRAVEL},
    spent::{PROCESSOR, Spent},
};

/// Number of best stops that the oracle executes to rest, because the estimate of the final
/// position does not rank them to the millimetre.
const ORACLE: usize = 16;

/// Number of directions of the planner's search; refinement rotates pushes by more than half their
/// spacing.
const WAYS: usize = 8;

/// Salt that separates the random choices from other uses of a seed.
const SALT: u64 = 0x7001;

/// Trials of one task with some of the tool poses.
pub(super) struct Trials<'a> {
    setup: &'a ReferenceSetup,
    model: &'a dyn EffectModel,
    planner: &'a Planner,
    task: &'a Task,
    shared: &'a mut Shared,
    /// Prescribed pose, if any.
    pose: Option<usize>,
    /// Allowed poses that can be set down at home.
    poses: Vec<usize>,
}

impl<'a> Trials<'a> {
    pub fn new(
        setup: &'a ReferenceSetup,
        (model, planner): (&'a dyn EffectModel, &'a Planner),
        task: &'a Task,
        shared: &'a mut Shared,
        pose: Option<usize>,
    ) -> Self {
        let allowed = |free: &&usize| pose.is_none_or(|pose| pose == **free);
        let poses: Vec<usize> = shared.free.iter().filter(allowed).copied().collect();
        Self { setup, model, planner, task, shared, pose, poses }
    }

    /// Runs every method. The random choice is draw number `draw.1` of seed `draw.0`; wall times
    /// are added to `seconds`, if given.
    ///
    /// # Errors
    /// Returns errors of the planner.
    pub fn run(
        &mut self,
        draw: (u64, u64),
        seconds: Option<&mut Seconds>,
    ) -> Result<Vec<ToolTrial>, SolveError> {
        let (setup, task) = (self.setup, self.task);
        let mut stopwatch = Stopwatch { seconds };
        let first = stopwatch.time("first", self.shared.spent, || {
            first_choice(setup, self.model, task, &self.shared.predicted, &self.poses)
        });
        let solution = stopwatch.time("planned", Spent::default(), || self.plan())?;
        let truth = Simulated::new(Simulator::planar());
        let planar = first_choice(setup, &truth, task, &self.shared.planar, &self.poses);
        let still = nothing(task);
        let choices = [
            (Method::Nothing, still.clone()),
            (Method::Random, self.random(draw).unwrap_or_else(|| still.clone())),
            (Method::Oracle, self.oracle()),
            (Method::Planar, planar),
            (Method::First, first),
            (Method::Planned, self.planned(&solution).unwrap_or(still)),
        ];
        let mut trials: Vec<ToolTrial> =
            choices.iter().map(|(method, choice)| self.trial(*method, choice)).collect();
        if let Some(planned) = trials.last_mut() {
            planned.attempts = Some(solution.statistics.verified);
        }
        Ok(trials)
    }

    fn trial(&mut self, method: Method, choice: &Choice) -> ToolTrial {
        let action = &choice.action;
        let [planar, spatial] = [Engine::Planar, Engine::Spatial].map(|engine| {
            let landing = self.play(engine, &[action])[0];
            self.executed(&landing)
        });
        ToolTrial {
            method,
            pose: self.pose,
            taken: (!action.pushes.is_empty()).then_some(action.pose),
            predicted: choice.predicted,
            planar,
            spatial,
            pushes: action.pushes.len(),
            travel: action.travel(),
            attempts: None,
        }
    }

    fn play(&mut self, engine: Engine, actions: &[&Action]) -> Vec<Landing> {
        self.shared.executions.run(self.setup, self.task, engine, actions)
    }

    /// Returns the goal position, metres.
    fn wanted(&self) -> Vector {
        self.task.goals[0].position().unwrap_or_default()
    }

    fn executed(&self, landing: &Landing) -> Executed {
        let error = (landing.at - self.wanted()).norm();
        Executed { error, sound: landing.sound }
    }

    /// Returns the planner's solution with these tool poses. Its pushes are placed, so that a pose
    /// need not be free at home.
    fn plan(&self) -> Result<Solution, SolveError> {
        let mut task = self.task.clone();
        task.pushes.form = PushForm::Placed;
        task.pushes.directions = Directions::Count(WAYS);
        let mut poses = self.setup.poses.iter().enumerate();
        let library = poses.try_fold(ToolLibrary::default(), |library, (k, tool)| {
            let allowed = self.pose.is_none_or(|pose| pose == k);
            if allowed { library.with(Arc::clone(tool)) } else { Ok(library) }
        })?;
        self.planner.solve(&task, &library)
    }

    /// Returns the choice of the planner.
    fn planned(&self, solution: &Solution) -> Option<Choice> {
        let best = solution.best()?;
        let pose = self.setup.pose(best.plan.tool())?;
        let pushes = best.plan.pushes().clone();
        let action = Action { pose, form: PushForm::Placed, pushes };
        Some(Choice { action, predicted: Some(best.outcome.error()) })
    }

    /// Returns a random sequence and stop, uniformly distributed; `None` if no pose can be set
    /// down.
    fn random(&self, (seed, index): (u64, u64)) -> Option<Choice> {
        // Each set of poses has its own random stream.
        let stream = self.poses.iter().fold(0u64, |bits, pose| bits | 1 << pose);
        let mut random = generator(seed ^ SALT ^ (stream << 32), index);
        let pose = *self.poses.get(random.random_range(0..self.poses.len().max(1)))?;
        let ways = self.task.pushes.directions.headings();
        let (mut start, speed) = (self.task.robot.home, self.task.pushes.speed);
        let most = self.task.pushes.max_count;
        let mut pushes: Vec<Push> = (0..most)
            .map(|_| {
                let direction = ways[random.random_range(0..ways.len())];
                let push = Push { start, direction, length: TRAVEL, speed };
                start = push.end();
                push
            })
            .collect();
        let stop = random.random_range(1..=most * STEPS);
        pushes.truncate(stop.div_ceil(STEPS));
        if let Some(last) = pushes.last_mut() {
            last.length = TRAVEL * ((stop - 1) % STEPS + 1) as f64 / STEPS as f64;
        }
        let action = Action { pose, form: PushForm::Chained, pushes };
        Some(Choice { action, predicted: None })
    }

    /// Returns the best executed choice among the stops nearest to the goal in the 2-D engine.
    fn oracle(&mut self) -> Choice {
        let best = self.shared.played.best(&self.task.goals[0], ORACLE, &self.poses);
        let still = nothing(self.task).action;
        let best = best.into_iter().map(|(_, action)| action);
        // Stops are ranked by an estimate, but the ends of whole sequences are known.
        let goal = self.wanted();
        let ends =
            self.shared.played.ends().filter(|(action, _)| self.poses.contains(&action.pose));
        let end = ends.min_by(|a, b| (a.1 - goal).norm().total_cmp(&(b.1 - goal).norm()));
        let end = end.map(|(action, _)| action);
        let mut actions: Vec<Action> = std::iter::once(still).chain(end).chain(best).collect();
        let landings = self.play(Engine::Planar, &actions.iter().collect::<Vec<_>>());
        let errors = landings.iter().map(|landing| {
            if landing.sound { self.executed(landing).error } else { f64::INFINITY }
        });
        let best = errors.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        let (index, error) = best.unwrap_or((0, f64::INFINITY));
        Choice { action: actions.swap_remove(index), predicted: Some(error) }
    }
}

/// Collector of a task's times, if wanted: wall time, and processor time of single-threaded work.
struct Stopwatch<'a> {
    seconds: Option<&'a mut Seconds>,
}

impl Stopwatch<'_> {
    /// Runs `work` and records its cost in addition to `before`.
    fn time<T>(&mut self, what: &str, before: Spent, work: impl FnOnce() -> T) -> T {
        let (done, spent) = Spent::on(work);
        if let Some(seconds) = &mut self.seconds {
            let Spent { wall, processor } = spent.after(before);
            seconds.insert(what.to_owned(), wall);
            seconds.extend(processor.map(|time| (format!("{what}{PROCESSOR}"), time)));
        }
        done
    }
}
