//! The closed loop.

use std::sync::Arc;

use crate::belief::{Belief, BeliefRegulator, BeliefSettings, generator};
use pushplan::asset::{Faults, ToolLibrary};
use pushplan::effect::{ModelError, Prior};
use pushplan::progress::{NoProgress, Progress};
use pushplan::solve::{Planner, SolveError};
use pushplan::{
    geometry::Pose,
    outcome::{Record, Trajectory, Warning},
    scene::{ObservedPose, Scene, Situation, State, TableFit, Tool},
    task::{Goal, Job, Observation, Plan, Push, PushForm, Task},
};

use super::decide::Decision;
use super::error::ActError;
use super::gather::{Gatherer, Note};
use super::judge::{Chance, Samples};
use super::learning::Learner;
use super::rules::{broken_at_rest, broken_in};
use super::settings::RunSettings;
use super::trace::{End, Step, Trace, Why};
use super::world::{Look, World};

/// Maximum number of further observations at rest if an object is missing.
const LOOKS: usize = 3;

/// Maximum distance between two agreeing observations at rest, in addition to the noise, metres.
const AGREE: f64 = 0.01;

/// Required margin at the goal, in standard deviations of the pose; it is limited to half of the
/// tolerance.
const SURE: f64 = 1.645;

/// Runner of the closed loop of planning, pushing, observing and updating the belief.
#[derive(Clone)]
pub struct Runner<'a> {
    pub(super) planner: &'a Planner,
    pub(super) library: &'a ToolLibrary,
    /// Model for rollouts of the belief's hypotheses.
    model: Prior,
    regulator: Option<BeliefRegulator>,
    /// Shared because a runner is cloned for every decision.
    learner: Option<Arc<Learner>>,
}

impl<'a> Runner<'a> {
    /// Creates a runner that plans with `planner` and the tools of `library`. Its belief is the
    /// filter over hypotheses, uncorrected.
    pub fn new(planner: &'a Planner, library: &'a ToolLibrary) -> Self {
        Self { planner, library, model: Prior::default(), regulator: None, learner: None }
    }

    /// Enables correction of the filter by `regulator`.
    pub fn regulated(self, regulator: BeliefRegulator) -> Self {
        Self { regulator: Some(regulator), ..self }
    }

    /// Enables adaptation of the planner's network after every push, starting from the fit `given`.
    ///
    /// This applies if the task has no unknowns and the planner has a network; the result is
    /// [`Trace::learnt`]. The planner should be [fitted](Planner::fitted) with `given`.
    ///
    /// # Errors
    /// Returns [`ModelError`] if the network's weights cannot be read.
    pub fn learning(self, given: Option<TableFit>) -> Result<Self, ModelError> {
        let learner = Learner::new(self.planner.model().spec(), given)?;
        Ok(Self { learner: learner.map(Arc::new), ..self })
    }

    /// Runs a task in `world` to its end with the default settings and returns the record.
    ///
    /// # Errors
    /// Returns the errors of [`Runner::run_with`].
    pub fn run(&self, task: &Task, world: &mut dyn World) -> Result<Trace, ActError> {
        let by = self.planner.model().spec().to_string();
        let mut trace = Trace::new(task.clone(), RunSettings::default(), by, None);
        self.run_with(&mut trace, world, &mut |_| Ok(()), &NoProgress)?;
        Ok(trace)
    }

    /// Starts or resumes the run of `trace` and continues it to its end.
    ///
    /// `keep` receives the trace after the first observation and after every step. An interrupted
    /// run resumes from there and yields bit-identical results.
    ///
    /// # Errors
    /// Returns an error if the run cannot continue or is cancelled by `progress`; the trace holds
    /// the finished steps.
    pub fn run_with(
        &self,
        trace: &mut Trace,
        world: &mut dyn World,
        keep: &mut dyn FnMut(&Trace) -> Result<(), Faults>,
        progress: &dyn Progress,
    ) -> Result<(), ActError> {
        if trace.first.is_none() {
            trace.first = Some(world.look()?.with_parts(&trace.task.scene));
            trace.before = world.save();
            let (belief, notes) = self.begin(trace)?;
            trace.notes = notes;
            trace.pairs = belief.pairs().collect();
            trace.prior = belief.probabilities();
            trace.prior_numbers = belief.numbers();
            trace.stop_at(broken_at_rest(&belief, trace.settings.noise));
            keep(trace)?;
        }
        let (mut belief, _) = self.begin(trace)?;
        let start = belief.situation().start;
        for step in &trace.steps {
            self.again(trace, &mut belief, step)?;
        }
        let mut learnt = self.learnt(trace, &start)?;
        let saved = match trace.steps.last() {
            Some(step) => step.world.as_ref(),
            None => trace.before.as_ref(),
        };
        if let Some(saved) = saved {
            world.restore(saved);
        }
        while trace.end.is_none() {
            if progress.cancelled() {
                return Err(ActError::Stopped { pushes: trace.pushes() });
            }
            let planner = learnt.as_ref().unwrap_or(self.planner);
            let now = Runner { planner, ..self.clone() };
            let decision = now.next(trace, &belief, progress)?;
            // A decision under a time limit would not be reproducible.
            if progress.cancelled() {
                return Err(ActError::Stopped { pushes: trace.pushes() });
            }
            match decision {
                Decision::Done => trace.end = Some(End::Reached),
                Decision::Nothing => trace.end = Some(End::NoImprovingPush),
                Decision::Do { .. } if trace.steps.len() >= trace.settings.max_pushes => {
                    trace.end = Some(End::BudgetExhausted);
                }
                Decision::Do { why, plan, tool, chance } => {
                    let decided = (why, plan, tool, chance);
                    let (step, broken) = now.step(trace, &mut belief, world, decided)?;
                    trace.steps.push(step);
                    trace.stop_at(broken);
                    learnt = self.learnt(trace, &start)?;
                    progress.update(trace.steps.len() as u64, trace.settings.max_pushes as u64);
                }
            }
            keep(trace)?;
        }
        Ok(())
    }

    /// Learns from all steps of a trace that began at `start` and returns the adapted planner.
    fn learnt(&self, trace: &mut Trace, start: &State) -> Result<Option<Planner>, ActError> {
        let Some(learner) = &self.learner else { return Ok(None) };
        trace.learnt = learner.learn(trace, start)?;
        // No new planner is needed if the fit changes no decision.
        let news = trace.learnt.as_ref().filter(|fit| fit.head.iter().any(|value| *value != 0.0));
        Ok(news.map(|fit| self.planner.fitted_anew(fit)).transpose()?)
    }

    /// Returns the belief after the first observation, with notes on corrections.
    fn begin(&self, trace: &Trace) -> Result<(Belief, Vec<Note>), ActError> {
        let Trace { task, settings, first, .. } = trace;
        if task.levers.is_some() {
            let what = "`run` observes no objects after lever-ups, and does not support them";
            return Err(SolveError::bad_task(task, "levers", what).into());
        }
        let stated = task.scene.start();
        let mut gatherer = Gatherer::new(&stated, &stated);
        let look = first
            .as_ref()
            .ok_or_else(|| ActError::Trace("the first observation is missing".into()))?;
        let seen = gatherer.first(look)?;
        if let Some(pair) = gatherer.exchanged(task, &seen) {
            let objects = pair.map(|object| task.scene.objects[object].name.clone());
            return Err(ActError::Ambiguous { objects });
        }
        let poses = seen.iter().zip(&stated.poses).map(|(sight, stated)| match sight {
            Some(ObservedPose { position, heading }) => Pose {
                position: *position,
                heading: heading.map_or(stated.heading, |heading| near(heading, stated.heading)),
            },
            None => *stated,
        });
        let start = State::at_rest(poses.collect());
        let mut scene = seen_at(&task.scene, &start);
        // Displacements before the first observation do not count.
        scene.objects.iter_mut().for_each(|object| object.kept_from = None);
        let tools = task.tools(self.library).map_err(SolveError::from)?;
        let tool = tools.first().ok_or_else(|| ActError::Trace("its task has no tool".into()))?;
        let belief_settings = BeliefSettings::new(settings.noise);
        let held = (Arc::clone(tool), task.pushes.lift);
        let belief = Belief::about(&scene, task.unknown, held, belief_settings, settings.seed);
        let belief = match &self.regulator {
            Some(regulator) => belief.regulated(regulator.clone()),
            None => belief,
        };
        Ok((belief, gatherer.notes))
    }

    /// Returns the next decision.
    fn next(
        &self,
        trace: &Trace,
        belief: &Belief,
        progress: &dyn Progress,
    ) -> Result<Decision, ActError> {
        let Trace { task, settings, steps, .. } = trace;
        let now = belief.situation();
        let doubt = belief.doubt();
        if task.goals.iter().all(|goal| is_sure(goal, &now.start, doubt[goal.object])) {
            return Ok(Decision::Done);
        }
        let mut rng = generator(settings.seed, steps.len() as u64);
        let physics = (0..settings.samples.max(1)).map(|_| Arc::new(belief.sample(&mut rng)));
        let samples = Samples { physics: physics.collect(), now };
        self.decide(trace, (belief, &samples), progress)
    }

    /// Carries out the first push of a plan, or all pushes of a chained plan, and updates the
    /// belief. Returns the step with the first rule that it broke.
    fn step(
        &self,
        trace: &Trace,
        belief: &mut Belief,
        world: &mut dyn World,
        (why, plan, tool, chance): (Why, Plan, Arc<Tool>, Chance),
    ) -> Result<(Step, Option<Warning>), ActError> {
        let task = &trace.task;
        let pushes = match plan.form() {
            PushForm::Placed => 1.min(plan.pushes().len()),
            PushForm::Chained => plan.pushes().len(),
        };
        let done = plan.first(pushes);
        let predicted = self.predicted(&belief.situation(), &done, &tool, Record::Frames);
        let rest = predicted.outcome();
        let motion = done.motion(&tool);
        let scene = &trace.task.scene;
        if trace.steps.last().is_none_or(|last| last.tool.name != tool.name) {
            world.change_tool(&tool)?;
        }
        let looks: Vec<Look> =
            world.act(&motion)?.into_iter().map(|look| look.with_parts(scene)).collect();
        let stop = world.stopped();
        let mut gatherer = Gatherer::new(&belief.situation().start, rest);
        let seen = gatherer.made(&motion, stop.as_ref(), looks.clone())?;
        let mut again = Vec::new();
        let mut look = || {
            let look = world.look()?.with_parts(scene);
            again.push(look.clone());
            Ok(look)
        };
        let observations = rests(trace, &mut gatherer, seen, &mut look)?;
        let noise = trace.settings.noise;
        let broken = broken_in(&belief.situation(), noise, &observations);
        self.believe(belief, (&tool, plan.lift()), observations);
        let broken = broken.or_else(|| broken_at_rest(belief, noise));
        let step = Step {
            why,
            pushes,
            chance,
            expected: rest.poses[task.goals[0].object],
            predicted: predicted.frames,
            tool: Tool::clone(&tool),
            plan,
            looks,
            again,
            stop,
            notes: gatherer.notes,
            state: belief.situation().start,
            probabilities: belief.probabilities(),
            numbers: belief.numbers(),
            world: world.save(),
        };
        Ok((step, broken))
    }

    /// Repeats the belief update of a recorded step.
    fn again(&self, trace: &Trace, belief: &mut Belief, step: &Step) -> Result<(), ActError> {
        let unfit = |why: &str| ActError::Trace(why.to_owned());
        let made = step.plan.pushes();
        let pushes = made.get(..step.pushes).filter(|pushes| !pushes.is_empty());
        let pushes =
            pushes.ok_or_else(|| unfit("a step contains pushes that are not in its plan"))?;
        let count = trace.task.scene.objects.len();
        let world = step.world.as_ref().map_or(count, |world| world.state.poses.len());
        let before = trace.before.as_ref().map_or(count, |world| world.state.poses.len());
        if [step.state.poses.len(), world, before] != [count; 3] {
            return Err(unfit("a step has a different number of objects than the task"));
        }
        let can_be = |push: &Push| push.speed > 0.0 && (0.0..=10.0).contains(&push.length);
        if !pushes.iter().all(can_be) {
            return Err(unfit("a step contains an invalid push"));
        }
        let done = step.plan.first(pushes.len());
        let tool = Arc::new(step.tool.clone());
        let motion = done.motion(&tool);
        let now = belief.situation();
        let predicted = self.predicted(&now, &done, &tool, Record::Outcome);
        let mut gatherer = Gatherer::new(&now.start, predicted.outcome());
        let seen = gatherer.made(&motion, step.stop.as_ref(), step.looks.clone())?;
        let mut again = step.again.iter().cloned();
        let mut look = || again.next().ok_or_else(|| unfit("an observation of a step is missing"));
        let observations = rests(trace, &mut gatherer, seen, &mut look)?;
        self.believe(belief, (&tool, done.lift()), observations);
        Ok(())
    }

    fn believe(
        &self,
        belief: &mut Belief,
        (tool, lift): (&Arc<Tool>, f64),
        observations: Vec<Observation>,
    ) {
        belief.take_tool(Arc::clone(tool), lift);
        for observation in observations {
            belief.update(&self.model, observation);
        }
        belief.settle(&self.model);
    }

    /// Returns the predicted effect of a plan on all objects; all stay in place if the model
    /// declines.
    fn predicted(
        &self,
        now: &Situation,
        plan: &Plan,
        tool: &Arc<Tool>,
        record: Record,
    ) -> Trajectory {
        let job = Job::new(now, plan.motion(tool));
        let model = self.planner.model();
        let rolled = model.rollout(&now.scene, std::slice::from_ref(&job), record).pop();
        rolled.filter(|rolled| !rolled.frames.is_empty()).unwrap_or_else(|| {
            Trajectory::standing(
                model.spec().clone(),
                job.motion.slide().strokes[0].from,
                now.start.clone(),
            )
        })
    }
}

/// Repeats observations at rest while objects are missing and returns the completed observations.
fn rests(
    trace: &Trace,
    gatherer: &mut Gatherer,
    (mut observations, mut rest): (Vec<Observation>, Option<Look>),
    look: &mut dyn FnMut() -> Result<Look, ActError>,
) -> Result<Vec<Observation>, ActError> {
    let task = &trace.task;
    let Some(last) = observations.last_mut() else { return Ok(observations) };
    for _ in 0..LOOKS {
        if last.seen.iter().all(Option::is_some) {
            break;
        }
        let now = look()?;
        let seen = gatherer.sights(&now, 0.0)?;
        let missing = last.seen.iter_mut().enumerate().filter(|(_, sight)| sight.is_none());
        for (object, sight) in missing {
            *sight = seen[object];
            let twice = [rest.as_ref().and_then(|rest| rest.seen[object]), now.seen[object]];
            if let (None, [Some(one), Some(other)]) = (&sight, twice) {
                let off = (one.position - other.position).norm();
                // The comparison is false for a NaN.
                if off <= AGREE + 6.0 * trace.settings.noise.position {
                    *sight = Some(other);
                    gatherer.note(Note::Moved { object });
                }
            }
        }
        rest = Some(now);
    }
    for (object, _) in last.seen.iter().enumerate().filter(|(_, sight)| sight.is_none()) {
        if task.has_goal(object) {
            let object = task.scene.objects[object].name.clone();
            return Err(ActError::Lost { object, looks: LOOKS });
        }
        gatherer.note(Note::Unseen { object });
    }
    Ok(observations)
}

/// Returns `true` if the goal is reached within the pose uncertainty, metres and radians.
fn is_sure(goal: &Goal, state: &State, [place, turn]: [f64; 2]) -> bool {
    goal.stricter(SURE * place, SURE * turn).reached(state)
}

/// Returns the scene with its objects at the observed poses; known joints move with them.
pub(super) fn seen_at(scene: &Scene, start: &State) -> Scene {
    let joints = crate::belief::carried(&scene.joints, scene, start);
    Scene { joints, ..scene.moved_to(start) }
}

/// Returns `heading` plus the multiple of 2π that brings it closest to `other`.
fn near(heading: f64, other: f64) -> f64 {
    other + pushplan::geometry::wrap_angle(heading - other)
}
