//! Measuring the tasks one by one; those of one start share its rollouts.

use std::time::Instant;

use rand::Rng;

use crate::{
    dataset::generator,
    effect::{EffectModel, Simulated},
    geometry::Vector,
    plan::{Candidate, CandidatePush, Rollouts, SequenceTree, Start},
    scene::{Engine, Push, PushForm, Task},
    sim::Simulator,
};

use super::super::store::{Measured, Seconds};
use super::{
    choose::{Choice, first_choices, nothing, placed_choices, refined_choices},
    execute::{Action, Executions, Landing},
    goals::GoalSet,
    record::{Executed, Method, ToolRecord, ToolTrial},
    setup::{FINE, PUSHES, ReferenceSetup, STEPS, TRAVEL},
};

/// Plans that are tried at most.
const VERIFIED: usize = 8;

/// A plan that ends this near to the goal ends the trying, metres.
const GOOD: f64 = 2e-3;

/// The best stops of the planar engine that the oracle tries.
const ORACLE: usize = 16;

/// Distinguishes the random choices from other uses of a seed.
const SALT: u64 = 0x7001;

/// The benchmark: goals, the model that is measured, and what tasks of the last start share.
pub struct ToolBench<'a> {
    setup: ReferenceSetup,
    goals: GoalSet,
    model: &'a dyn EffectModel,
    seed: u64,
    shared: Option<Shared>,
}

/// What the tasks of one start share.
struct Shared {
    start: usize,
    /// Poses that can be set down.
    free: Vec<usize>,
    /// All sequences as the model predicts them, as the planar engine does when it shares
    /// beginnings, and as it plays them.
    predicted: SequenceTree,
    planar: SequenceTree,
    played: SequenceTree,
    executions: Executions,
    /// Time of the first tree, seconds.
    seconds: f64,
}

impl<'a> ToolBench<'a> {
    /// Measures `model` on `goals`; `seed` is of the random choices.
    pub fn new(
        setup: ReferenceSetup,
        goals: GoalSet,
        model: &'a dyn EffectModel,
        seed: u64,
    ) -> Self {
        Self { setup, goals, model, seed, shared: None }
    }

    /// Number of tasks.
    pub fn tasks(&self) -> usize {
        self.goals.len()
    }

    /// Measures task `index`: every method, for all tool poses together and each alone, on the
    /// current rayon pool. Tasks of one start follow each other and share its rollouts.
    /// Nothing if there is no such task.
    pub fn measure(&mut self, index: usize) -> Option<Measured<ToolRecord>> {
        let (start, goal) = self.goals.task(index)?;
        let task = self.setup.task(Vector::from(self.goals.starts[start].start), goal);
        if self.shared.as_ref().is_none_or(|shared| shared.start != start) {
            self.shared = Some(Shared::new(&self.setup, self.model, &task, start));
        }
        let mut record = ToolRecord { start, goal: goal.into(), trials: Vec::new() };
        let mut seconds = Seconds::new();
        if let Some(shared) = &mut self.shared {
            let mut run = Run { setup: &self.setup, model: self.model, task: &task, shared };
            let seed = self.seed;
            for pose in std::iter::once(None).chain((0..self.setup.poses.len()).map(Some)) {
                let trials = run.trials(pose, index as u64, seed, &mut seconds);
                record.trials.extend(trials);
            }
        }
        Some(Measured { record, seconds })
    }
}

impl Shared {
    fn new(setup: &ReferenceSetup, model: &dyn EffectModel, task: &Task, start: usize) -> Self {
        let workspace = setup.workspace(task);
        let free = setup.free_poses(task.scene.objects[0].pose.position);
        let grips = setup.grips(&free);
        let began = Instant::now();
        let mut rollouts = Rollouts::new(model, &task.scene);
        let predicted = SequenceTree::roll(&workspace, &mut rollouts, &grips, STEPS);
        let seconds = began.elapsed().as_secs_f64();
        let planar = Simulated::new(Simulator::planar());
        let mut rollouts = Rollouts::new(&planar, &task.scene);
        Self {
            start,
            predicted,
            planar: SequenceTree::roll(&workspace, &mut rollouts, &grips, STEPS),
            played: SequenceTree::roll_whole(&workspace, &mut rollouts, &grips, STEPS),
            free,
            executions: Executions::default(),
            seconds,
        }
    }
}

/// Keeps the wall times of a task, where they are wanted.
struct Stopwatch<'a> {
    seconds: Option<&'a mut Seconds>,
}

impl Stopwatch<'_> {
    /// What `work` takes on top of `before` seconds.
    fn time<T>(&mut self, what: &str, before: f64, work: impl FnOnce() -> T) -> T {
        let began = Instant::now();
        let done = work();
        if let Some(seconds) = &mut self.seconds {
            seconds.insert(what.to_owned(), before + began.elapsed().as_secs_f64());
        }
        done
    }

    /// A time that was kept.
    fn last(&self, what: &str) -> f64 {
        let kept = self.seconds.as_ref().and_then(|seconds| seconds.get(what));
        kept.copied().unwrap_or_default()
    }
}

/// One task.
struct Run<'a> {
    setup: &'a ReferenceSetup,
    model: &'a dyn EffectModel,
    task: &'a Task,
    shared: &'a mut Shared,
}

impl Run<'_> {
    /// Every method, for one pose alone or for all.
    fn trials(
        &mut self,
        pose: Option<usize>,
        index: u64,
        seed: u64,
        seconds: &mut Seconds,
    ) -> Vec<ToolTrial> {
        let allowed = |free: &&usize| pose.is_none_or(|pose| pose == **free);
        let poses: Vec<usize> = self.shared.free.iter().filter(allowed).copied().collect();
        let grips = self.setup.grips(&poses);
        let mut stop = Stopwatch { seconds: pose.is_none().then_some(seconds) };
        let (setup, workspace) = (self.setup, self.setup.workspace(self.task));
        let mut rollouts = Rollouts::new(self.model, &self.task.scene);
        let (tree, shared) = (&self.shared.predicted, self.shared.seconds);
        let first = stop.time("first", shared, || {
            first_choices(setup, &workspace, &mut rollouts, tree, &grips, 1)
        });
        let refined = stop.time("refined", shared, || {
            refined_choices(setup, &workspace, &mut rollouts, tree, &grips, VERIFIED)
        });
        let placed = stop
            .time("placed", 0.0, || placed_choices(setup, self.model, self.task, &grips, VERIFIED));
        let searched = stop.last("placed");
        let verified = stop.time("verified", searched, || self.verify(Engine::Spatial, &placed));
        let planar_model = Simulated::new(Simulator::planar());
        let mut planar_rollouts = Rollouts::new(&planar_model, &self.task.scene);
        let planar = first_choices(
            self.setup,
            &workspace,
            &mut planar_rollouts,
            &self.shared.planar,
            &grips,
            1,
        );
        let still = nothing(self.setup, self.task);
        let random = self.random(&poses, index, seed);
        let oracle = self.oracle(&grips);
        let mut trials = Vec::new();
        for (method, choice) in [
            (Method::Nothing, &still),
            (Method::Random, random.as_ref().unwrap_or(&still)),
            (Method::Oracle, &oracle),
            (Method::Planar, planar.first().unwrap_or(&still)),
            (Method::First, first.first().unwrap_or(&still)),
            (Method::Refined, refined.first().unwrap_or(&still)),
            (Method::Placed, placed.first().unwrap_or(&still)),
        ] {
            trials.push(self.trial(method, pose, choice));
        }
        let best = verified.0;
        let planar = self.verify(Engine::Planar, &placed);
        let mut trial = self.trial(Method::Verified, pose, placed.get(best).unwrap_or(&still));
        trial.spatial = verified.1;
        trial.planar = planar.1;
        trials.push(trial);
        trials
    }

    fn trial(&mut self, method: Method, pose: Option<usize>, choice: &Choice) -> ToolTrial {
        let action = &choice.action;
        let taken = self.setup.poses.iter().position(|pose| pose.grip == action.grip);
        let predicted = match method {
            Method::Random => None,
            _ => Some(choice.predicted),
        };
        ToolTrial {
            method,
            pose,
            taken: taken.filter(|_| !action.pushes.is_empty()),
            predicted,
            planar: self.execute(Engine::Planar, action),
            spatial: self.execute(Engine::Spatial, action),
            pushes: action.pushes.len(),
            travel: action.travel(),
        }
    }

    fn execute(&mut self, engine: Engine, action: &Action) -> Executed {
        let landing = self.play(engine, &[action])[0];
        self.executed(&landing)
    }

    fn play(&mut self, engine: Engine, actions: &[&Action]) -> Vec<Landing> {
        self.shared.executions.run(self.setup, self.task, engine, actions)
    }

    fn executed(&self, landing: &Landing) -> Executed {
        let error = (landing.at - self.task.goal.position).norm();
        Executed { error, sound: landing.sound, attempts: None }
    }

    /// Tries plans in `engine`, two at a time, until one ends well; the best one's index and
    /// what it did, with the number of plans until the first that ended within 5 cm.
    fn verify(&mut self, engine: Engine, choices: &[Choice]) -> (usize, Executed) {
        let still =
            self.executed(&Landing { at: self.task.scene.objects[0].pose.position, sound: true });
        let mut best = (0, still);
        let mut tried = 0;
        let mut first = None;
        let mut found = false;
        for (pair, choices) in choices.chunks(2).enumerate() {
            let actions: Vec<&Action> = choices.iter().map(|choice| &choice.action).collect();
            for (k, landing) in self.play(engine, &actions).iter().enumerate() {
                let executed = self.executed(landing);
                tried += 1;
                if executed.sound && executed.error <= FINE && first.is_none() {
                    first = Some(tried);
                }
                if executed.sound && (!found || executed.error < best.1.error) {
                    best = (2 * pair + k, executed);
                    found = true;
                }
            }
            if found && best.1.error <= GOOD {
                break;
            }
        }
        best.1.attempts = Some(first.unwrap_or(tried));
        best
    }

    /// A sequence and a stop, all equally likely.
    fn random(&self, poses: &[usize], index: u64, seed: u64) -> Option<Choice> {
        let grip = |pose: usize| self.setup.poses[pose].grip;
        // Another stream for every set of poses.
        let stream = poses.iter().fold(0u64, |bits, pose| bits | 1 << pose);
        let mut random = generator(seed ^ SALT ^ (stream << 32), index);
        let pose = *poses.get(random.random_range(0..poses.len().max(1)))?;
        let ways = self.task.pushes.directions.headings();
        let mut pushes: Vec<CandidatePush> = (0..PUSHES)
            .map(|_| {
                let direction = ways[random.random_range(0..ways.len())];
                CandidatePush { start: Start::Chained, direction, length: TRAVEL }
            })
            .collect();
        let stop = random.random_range(1..=PUSHES * STEPS);
        pushes.truncate(stop.div_ceil(STEPS));
        if let Some(last) = pushes.last_mut() {
            last.length = TRAVEL * ((stop - 1) % STEPS + 1) as f64 / STEPS as f64;
        }
        let (tool, grip_yaw) = grip(pose);
        self.choice(&Candidate { tool, grip_yaw, pushes })
    }

    /// The best of the stops that the planar engine brings nearest, as played.
    fn oracle(&mut self, grips: &[(usize, f64)]) -> Choice {
        let goal = &self.task.goal;
        let best = self.shared.played.best(goal, ORACLE, |grip| grips.contains(&grip));
        let mut choices = vec![nothing(self.setup, self.task)];
        choices.extend(best.iter().filter_map(|found| self.choice(&found.candidate)));
        let actions: Vec<&Action> = choices.iter().map(|choice| &choice.action).collect();
        let landings = self.play(Engine::Planar, &actions);
        let errors: Vec<f64> = landings
            .iter()
            .map(|landing| if landing.sound { self.executed(landing).error } else { f64::INFINITY })
            .collect();
        let best = (0..errors.len()).min_by(|&a, &b| errors[a].total_cmp(&errors[b])).unwrap_or(0);
        Choice { predicted: errors[best], ..choices.swap_remove(best) }
    }

    /// A chained candidate as an action, not predicted.
    fn choice(&self, candidate: &Candidate) -> Option<Choice> {
        let mut start = self.task.robot.home;
        let pushes = candidate
            .pushes
            .iter()
            .map(|planned| {
                let push = Push {
                    start,
                    direction: planned.direction,
                    length: planned.length,
                    speed: self.task.pushes.speed,
                };
                start = push.end();
                push
            })
            .collect();
        let grip = (candidate.tool, candidate.grip_yaw);
        let action = Action { grip, form: PushForm::Chained, pushes };
        Some(Choice { action, predicted: f64::NAN })
    }
}
