//! Every method on one task, with all tool poses or one alone: choose, then execute in both
//! engines.

use rand::Rng;

use crate::{
    dataset::generator,
    effect::{EffectModel, Simulated},
    plan::{Candidate, CandidatePush, Rollouts, Start},
    scene::{Engine, Push, PushForm, Situation, Task},
    sim::Simulator,
};

use super::super::store::Seconds;
use super::{
    choose::{Choice, first_choices, nothing, placed_choices, refined_choices},
    execute::{Action, Landing},
    measure::Shared,
    record::{Executed, Method, ToolTrial},
    setup::{FINE, PUSHES, ReferenceSetup, STEPS, TRAVEL},
    spent::{PROCESSOR, Spent},
};

/// Plans that are tried at most.
const TRIED: usize = 8;

/// Plans that are tried at the same time.
const AT_ONCE: usize = 2;

/// A plan that ends this near to the goal ends the trying, metres.
const GOOD: f64 = 2e-3;

/// The best stops that the oracle plays to rest: which of them is best an estimate of where
/// gliding ends cannot tell to the last millimetre.
const ORACLE: usize = 16;

/// Distinguishes the random choices from other uses of a seed.
const SALT: u64 = 0x7001;

/// One task with some of the tool poses.
pub(super) struct Trials<'a> {
    setup: &'a ReferenceSetup,
    model: &'a dyn EffectModel,
    task: &'a Task,
    shared: &'a mut Shared,
    /// The pose that must be taken, if it is not all.
    pose: Option<usize>,
    /// Those of them that can be set down.
    poses: Vec<usize>,
    grips: Vec<(usize, f64)>,
}

impl<'a> Trials<'a> {
    pub fn new(
        setup: &'a ReferenceSetup,
        model: &'a dyn EffectModel,
        task: &'a Task,
        shared: &'a mut Shared,
        pose: Option<usize>,
    ) -> Self {
        let allowed = |free: &&usize| pose.is_none_or(|pose| pose == **free);
        let poses: Vec<usize> = shared.free.iter().filter(allowed).copied().collect();
        let grips = setup.grips(&poses);
        Self { setup, model, task, shared, pose, poses, grips }
    }

    /// Every method. The random choice is the draw number `draw.1` of seed `draw.0`; wall times
    /// go to `seconds`, where they are wanted.
    pub fn run(&mut self, draw: (u64, u64), seconds: Option<&mut Seconds>) -> Vec<ToolTrial> {
        let (setup, task, shared) = (self.setup, self.task, self.shared.spent);
        let (workspace, grips) = (setup.workspace(task), self.grips.clone());
        let mut rollouts = Rollouts::new(self.model, Situation::stated(&task.scene));
        let mut stopwatch = Stopwatch { seconds };
        let tree = &self.shared.predicted;
        let first = stopwatch.time("first", shared, || {
            first_choices(setup, &workspace, &mut rollouts, tree, &grips, 1)
        });
        let refined = stopwatch.time("refined", shared, || {
            refined_choices(setup, &workspace, &mut rollouts, tree, &grips, 1)
        });
        let placed = stopwatch.time("placed", Spent::default(), || {
            placed_choices(setup, self.model, task, &grips, TRIED)
        });
        let searched = stopwatch.kept("placed");
        let (best, spatial) =
            stopwatch.time("verified", searched, || self.verify(Engine::Spatial, &placed));
        let (_, planar) = self.verify(Engine::Planar, &placed);

        let truth = Simulated::new(Simulator::planar());
        let mut rollouts = Rollouts::new(&truth, Situation::stated(&task.scene));
        let tree = &self.shared.planar;
        let simulated = first_choices(setup, &workspace, &mut rollouts, tree, &grips, 1);
        let still = nothing(setup, task);
        let choices = [
            (Method::Nothing, still.clone()),
            (Method::Random, self.random(draw).unwrap_or_else(|| still.clone())),
            (Method::Oracle, self.oracle()),
            (Method::Planar, simulated[0].clone()),
            (Method::First, first[0].clone()),
            (Method::Refined, refined[0].clone()),
            (Method::Placed, placed[0].clone()),
        ];
        let mut trials: Vec<ToolTrial> =
            choices.iter().map(|(method, choice)| self.trial(*method, choice)).collect();
        let verified = self.trial(Method::Verified, &placed[best]);
        trials.push(ToolTrial { planar, spatial, ..verified });
        trials
    }

    fn trial(&mut self, method: Method, choice: &Choice) -> ToolTrial {
        let action = &choice.action;
        let taken = self.setup.poses.iter().position(|pose| pose.grip == action.grip);
        let [planar, spatial] = [Engine::Planar, Engine::Spatial].map(|engine| {
            let landing = self.play(engine, &[action])[0];
            self.executed(&landing)
        });
        ToolTrial {
            method,
            pose: self.pose,
            taken: taken.filter(|_| !action.pushes.is_empty()),
            predicted: choice.predicted,
            planar,
            spatial,
            pushes: action.pushes.len(),
            travel: action.travel(),
        }
    }

    fn play(&mut self, engine: Engine, actions: &[&Action]) -> Vec<Landing> {
        self.shared.executions.run(self.setup, self.task, engine, actions)
    }

    fn executed(&self, landing: &Landing) -> Executed {
        let error = (landing.at - self.task.goal.position).norm();
        Executed { error, sound: landing.sound, attempts: None }
    }

    /// Tries plans in `engine` in their order until one ends well; the best one's index and
    /// where it ended, with the number of plans until the first that ended within 5 cm.
    fn verify(&mut self, engine: Engine, choices: &[Choice]) -> (usize, Executed) {
        let mut tried: Vec<Executed> = Vec::with_capacity(choices.len());
        for some in choices.chunks(AT_ONCE) {
            let actions: Vec<&Action> = some.iter().map(|choice| &choice.action).collect();
            for landing in self.play(engine, &actions) {
                tried.push(self.executed(&landing));
            }
            if tried.iter().any(|one| one.sound && one.error <= GOOD) {
                break;
            }
        }
        let solved = tried.iter().position(|one| one.sound && one.error <= FINE);
        let attempts = Some(solved.map_or(tried.len(), |index| index + 1));
        let order = |one: &Executed| if one.sound { one.error } else { f64::INFINITY };
        let best = (0..tried.len())
            .min_by(|&a, &b| order(&tried[a]).total_cmp(&order(&tried[b])))
            .unwrap_or(0);
        (best, Executed { attempts, ..tried[best] })
    }

    /// A sequence and a stop, all equally likely; nothing if no pose can be set down.
    fn random(&self, (seed, index): (u64, u64)) -> Option<Choice> {
        // Another stream for every set of poses.
        let stream = self.poses.iter().fold(0u64, |bits, pose| bits | 1 << pose);
        let mut random = generator(seed ^ SALT ^ (stream << 32), index);
        let (tool, grip_yaw) = *self.grips.get(random.random_range(0..self.grips.len().max(1)))?;
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
        Some(self.chained(&Candidate { tool, grip_yaw, pushes }))
    }

    /// The best of the stops that the planar engine brings nearest, as played.
    fn oracle(&mut self) -> Choice {
        let tree = &self.shared.played;
        let best = tree.best(&self.task.goal, ORACLE, |grip| self.grips.contains(&grip));
        let mut choices = vec![nothing(self.setup, self.task)];
        choices.extend(best.iter().map(|found| self.chained(&found.candidate)));
        let actions: Vec<&Action> = choices.iter().map(|choice| &choice.action).collect();
        let landings = self.play(Engine::Planar, &actions);
        let errors = landings.iter().map(|landing| {
            if landing.sound { self.executed(landing).error } else { f64::INFINITY }
        });
        let best = errors.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        let (index, error) = best.unwrap_or((0, f64::INFINITY));
        Choice { predicted: Some(error), ..choices.swap_remove(index) }
    }

    /// A chained candidate, not predicted.
    fn chained(&self, candidate: &Candidate) -> Choice {
        let mut start = self.task.robot.home;
        let mut pushes = Vec::with_capacity(candidate.pushes.len());
        for &CandidatePush { direction, length, .. } in &candidate.pushes {
            let push = Push { start, direction, length, speed: self.task.pushes.speed };
            start = push.end();
            pushes.push(push);
        }
        let grip = (candidate.tool, candidate.grip_yaw);
        let action = Action { grip, form: PushForm::Chained, pushes };
        Choice { action, predicted: None }
    }
}

/// Keeps the times of a task, where they are wanted: wall time, and the processor's where a
/// single thread does all the work.
struct Stopwatch<'a> {
    seconds: Option<&'a mut Seconds>,
}

impl Stopwatch<'_> {
    /// What `work` takes on top of `before`.
    fn time<T>(&mut self, what: &str, before: Spent, work: impl FnOnce() -> T) -> T {
        let (done, spent) = Spent::on(work);
        if let Some(seconds) = &mut self.seconds {
            let Spent { wall, processor } = spent.after(before);
            seconds.insert(what.to_owned(), wall);
            seconds.extend(processor.map(|time| (format!("{what}{PROCESSOR}"), time)));
        }
        done
    }

    /// A time that was kept.
    fn kept(&self, what: &str) -> Spent {
        let kept = |name: &str| self.seconds.as_ref().and_then(|times| times.get(name)).copied();
        let processor = kept(&format!("{what}{PROCESSOR}"));
        Spent { wall: kept(what).unwrap_or_default(), processor }
    }
}
