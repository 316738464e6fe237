//! The verifier: plan in, verdict out.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use crate::geometry::Pose;
use crate::sim::{LeverSimulator, Simulator};
use crate::watch::{Unwatched, Watch};
use crate::{
    outcome::{Disturbance, Evidence, Outcome, Record, Trajectory, Verdict, Warning, never_on},
    scene::{Engine, JointTrajectory, Scene, Situation, Tool},
    task::{Job, Plan, Task, ToolMotion},
};

use super::arm::arm_faults;
use super::clear;
use super::disturbance::{disturbed, lifted, wary};
use super::rules::{broken_rules, unplayable};
use super::space;

/// Processor time of a time step for each object, seconds: with one object 1 and 6 us were measured,
/// with nine 0.5 and 5.
const PLANAR_STEP: f64 = 1e-6;
const SPATIAL_STEP: f64 = 6e-6;

/// What an ordinary arm keeps up, newtons: those that stand beside people have 50 to 150.
const ORDINARY_ARM: f64 = 150.0;

/// How thoroughly to verify.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VerifySettings {
    /// Disturbed replays in each engine, the fewest after which the answer may be clear; none in 3-D of
    /// plans that clearly fail in the planar engine.
    pub disturbed: usize,
    /// Seed of the disturbances.
    pub seed: u64,
}

/// Replays plans in both engines.
#[derive(Clone)]
pub struct Verifier<'a> {
    settings: VerifySettings,
    planar: Simulator,
    spatial: Simulator,
    watch: &'a dyn Watch,
    /// Whether replays are added until the answer is clear.
    until_clear: bool,
    /// Whether none are added to those of a plan that has not worked on one of the supports.
    giving_up: bool,
    /// Whether disturbed replays are those of the planar engine alone.
    in_plane: bool,
    /// How an arm carries the plan out, if that was made with it.
    joints: Option<&'a JointTrajectory>,
}

impl<'a> Verifier<'a> {
    /// A verifier on the engines at their default steps.
    pub fn new(settings: VerifySettings) -> Self {
        let [planar, spatial] =
            [Simulator::planar(), Simulator::spatial()].map(Simulator::retreating);
        let watch = &Unwatched;
        Self {
            settings,
            planar,
            spatial,
            watch,
            until_clear: false,
            giving_up: false,
            in_plane: false,
            joints: None,
        }
    }

    /// The same, which `watch` can stop. Replays that are not over then say so, and the plan does
    /// not pass.
    pub fn watched(self, watch: &'a dyn Watch) -> Self {
        Self { watch, ..self }
    }

    /// The same, which goes on with disturbed pushes until it is clear whether the wanted share of them
    /// reaches the goal, or 64 have been replayed in each engine; one clear answer in a hundred is wrong
    /// on average, see `clear`.
    pub fn until_clear(self) -> Self {
        Self { until_clear: true, ..self }
    }

    /// The same, which makes no more replays where those of an engine on one support, four at least, all
    /// fail: reason enough to look for another plan, not for a verdict, as one in 64 may still work.
    pub fn giving_up(self) -> Self {
        Self { giving_up: true, ..self }
    }

    /// The same, whose disturbed replays are those of the planar engine alone: a plan works no more often
    /// than it works there.
    pub fn in_plane(self) -> Self {
        Self { in_plane: true, ..self }
    }

    /// The same of plans that came with this motion of an arm's joints: it is judged rather than another
    /// one made.
    pub fn moving(self, joints: Option<&'a JointTrajectory>) -> Self {
        Self { joints, ..self }
    }

    /// About how long verifying a plan takes on one core, seconds: right to within a factor of
    /// three unless everything is pushed into everything.
    pub fn seconds(&self, scene: &Scene, plan: &Plan) -> f64 {
        let pushing = plan.push_steps().map(|step| step.push.duration());
        let levering = plan.lever_steps().map(|step| step.lever.duration());
        let moving: f64 = pushing.chain(levering).sum();
        let each = [(&self.planar, PLANAR_STEP), (&self.spatial, SPATIAL_STEP)];
        let replay: f64 = each.iter().map(|(engine, cost)| moving / engine.step() * cost).sum();
        replay * scene.objects.len() as f64 * (self.settings.disturbed + 1) as f64
    }

    /// Nominal replays in both engines, or in 3-D of what leaves the plane; enough to tell whether a
    /// plan works as written.
    ///
    /// `tools` are those that the plan names.
    pub fn nominal(
        &self,
        task: &Task,
        situation: &Situation,
        tools: &[Arc<Tool>],
        plan: &Plan,
    ) -> Verdict {
        let scene = &*situation.scene;
        if let Some(fault) = unplayable(scene, tools, plan) {
            return Verdict::judge(vec![fault], Vec::new(), task.robustness);
        }
        let mut forbidden = broken_rules(task, scene, tools, plan);
        if in_space(task, plan) {
            let evidence = self.replay_in_space(task, situation, (tools, plan), None);
            return Verdict::judge(forbidden, vec![evidence], task.robustness);
        }
        let motions = plan.slides(tools).unwrap_or_default();
        let jobs = Job::sequence(situation, &motions);
        let mut evidence: Vec<Evidence> = [&self.spatial, &self.planar]
            .into_par_iter()
            .map(|engine| self.replay(engine, task, scene, &jobs, Disturbance::Nominal))
            .collect();
        // The planar engine is the one that people compare predictions with: it comes first.
        evidence.reverse();
        if let Some(first) = motions.first() {
            let asked = (task, situation);
            forbidden.extend(arm_faults(asked, &first.tool, plan, &evidence, self.joints));
        }
        Verdict::judge(forbidden, evidence, task.robustness)
    }

    /// The verdict of [`Verifier::nominal`] together with the disturbed replays; those that it holds
    /// already are not made again.
    pub fn disturb(
        &self,
        task: &Task,
        situation: &Situation,
        tools: &[Arc<Tool>],
        plan: &Plan,
        verdict: Verdict,
    ) -> Verdict {
        let Verdict { forbidden, mut evidence, .. } = verdict;
        if evidence.is_empty() {
            return Verdict::judge(forbidden, evidence, task.robustness);
        }
        if in_space(task, plan) {
            let replays: Vec<Evidence> = (0..self.settings.disturbed)
                .into_par_iter()
                .map(|draw| {
                    if self.watch.cancelled() {
                        let disturbance = Disturbance::Disturbed { draw: draw + 1 };
                        return stopped(&self.spatial, task, situation, disturbance);
                    }
                    self.replay_in_space(task, situation, (tools, plan), Some(draw))
                })
                .collect();
            evidence.extend(replays);
            return Verdict::judge(forbidden, evidence, task.robustness);
        }
        let Some(motions) = plan.slides(tools) else {
            return Verdict::judge(forbidden, evidence, task.robustness);
        };
        let scene = wary(task, &situation.scene);
        let motions: Vec<ToolMotion> =
            motions.into_iter().map(|motion| lifted(&scene, motion)).collect();
        let (nominal, replays): (Vec<Evidence>, Vec<Evidence>) =
            evidence.into_iter().partition(|one| one.disturbance == Disturbance::Nominal);
        let (mut planar, mut spatial): (Vec<Evidence>, Vec<Evidence>) =
            replays.into_iter().partition(|one| one.engine == Engine::Planar);
        let asked = (task, situation, &scene, &motions[..]);
        // The planar engine comes first. If it says no, there is no need for the slower one.
        self.add_disturbed(&self.planar, asked, &mut planar);
        let refused =
            never(&planar, task) || clear::answer(&planar, task.robustness) == Some(false);
        if !(refused || self.in_plane) {
            self.add_disturbed(&self.spatial, asked, &mut spatial);
        }
        let evidence = nominal.into_iter().chain(planar).chain(spatial).collect();
        Verdict::judge(forbidden, evidence, task.robustness)
    }

    /// Adds disturbed replays to those that an engine has made, until they are enough.
    fn add_disturbed(
        &self,
        engine: &Simulator,
        asked: (&Task, &Situation, &Scene, &[ToolMotion]),
        own: &mut Vec<Evidence>,
    ) {
        let least = self.settings.disturbed;
        loop {
            let done = own.len();
            let is_clear = || {
                let failed = self.giving_up && never(own, asked.0);
                failed || clear::answer(own, asked.0.robustness).is_some()
            };
            let goes_on = self.until_clear && least > 0 && !self.watch.cancelled();
            let wanted = match done < least {
                true => least,
                false if goes_on && !is_clear() => (done + clear::LOOK).min(clear::MOST),
                false => done,
            };
            if done >= wanted {
                return;
            }
            own.extend(self.disturbed(engine, asked, done..wanted));
        }
    }

    /// These disturbed replays in an engine.
    fn disturbed(
        &self,
        engine: &Simulator,
        (task, situation, scene, motions): (&Task, &Situation, &Scene, &[ToolMotion]),
        draws: Range<usize>,
    ) -> Vec<Evidence> {
        draws
            .into_par_iter()
            .map(|draw| {
                let disturbance = Disturbance::Disturbed { draw: draw + 1 };
                if self.watch.cancelled() {
                    return stopped(engine, task, situation, disturbance);
                }
                let jobs = disturbed(situation, motions, self.settings.seed, draw);
                self.replay(engine, task, scene, &jobs, disturbance)
            })
            .collect()
    }

    /// All replays of a plan: nominal, then disturbed.
    pub fn verify(
        &self,
        task: &Task,
        situation: &Situation,
        tools: &[Arc<Tool>],
        plan: &Plan,
    ) -> Verdict {
        let nominal = self.nominal(task, situation, tools, plan);
        self.disturb(task, situation, tools, plan, nominal)
    }

    /// Plays a plan that can be played in space, as written or as this draw disturbs it.
    fn replay_in_space(
        &self,
        task: &Task,
        situation: &Situation,
        (tools, plan): (&[Arc<Tool>], &Plan),
        draw: Option<usize>,
    ) -> Evidence {
        let scene = &*situation.scene;
        let first = plan.lever_steps().next();
        let about = first.map_or(task.levered().object, |step| step.lever.plate);
        let mut motions = plan.motions(tools).unwrap_or_default();
        let really = draw.map(|draw| {
            let wary = Situation { scene: Arc::new(wary(task, scene)), ..situation.clone() };
            space::disturbed(&wary, &mut motions, about, (self.settings.seed, draw))
        });
        let really = really.as_ref().unwrap_or(situation);
        let record = if draw.is_none() { Record::Frames } else { Record::Outcome };
        let watched = (record, self.watch);
        let trajectory = LeverSimulator::default().run_all(really, scene, &motions, watched);
        // What must be left has been moved as well.
        let scene = Scene { obstacles: really.scene.obstacles.clone(), ..scene.clone() };
        let disturbance = match draw {
            None => Disturbance::Nominal,
            Some(draw) => Disturbance::Disturbed { draw: draw + 1 },
        };
        evidence(&self.spatial, task, &scene, trajectory, disturbance)
    }

    /// Plays jobs in turn; one without pushes leaves everything where it is.
    fn replay(
        &self,
        engine: &Simulator,
        task: &Task,
        scene: &Scene,
        jobs: &[Job],
        disturbance: Disturbance,
    ) -> Evidence {
        let nominal = disturbance == Disturbance::Nominal;
        let record = if nominal { Record::Frames } else { Record::Outcome };
        let trajectory = engine.run_in_turn(scene, jobs, record, self.watch);
        evidence(engine, task, scene, trajectory, disturbance)
    }
}

/// Whether a plan is fragile by a support on which it works in none of these replays.
fn never(replays: &[Evidence], task: &Task) -> bool {
    task.robustness > 0.0 && never_on(replays.iter()).is_some()
}

/// Whether a plan is replayed in space.
fn in_space(task: &Task, plan: &Plan) -> bool {
    task.in_space() || plan.levers()
}

/// What a replay shows.
fn evidence(
    engine: &Simulator,
    task: &Task,
    scene: &Scene,
    mut trajectory: Trajectory,
    disturbance: Disturbance,
) -> Evidence {
    let nominal = disturbance == Disturbance::Nominal;
    if let (Some(force), Some(limit)) = (trajectory.force, task.robot.max_force)
        && force.lasting > limit
    {
        let needed = force.lasting;
        trajectory.warnings.push(Warning::TooMuchForce { object: None, needed, limit });
    }
    if let (Some(force), None) = (trajectory.force, task.robot.max_force)
        && force.lasting > ORDINARY_ARM
    {
        trajectory.warnings.push(Warning::HardPush { needed: force.lasting });
    }
    trajectory.warnings.extend(scene.not_kept(trajectory.outcome()));
    // What is to fall need not be told of.
    let wanted = |name: &str| {
        let goals = task.goals.iter().filter(|goal| goal.falls());
        let mut movers = goals.flat_map(|goal| goal.movers());
        movers.any(|k| scene.objects.get(k).is_some_and(|object| object.name == name))
    };
    let told = |warning: &Warning| !matches!(warning, Warning::Fell { object } if wanted(object));
    trajectory.warnings.retain(told);
    Evidence {
        engine: engine.engine(),
        disturbance,
        outcome: Outcome::judge(scene, task, &trajectory),
        warnings: trajectory.warnings.clone(),
        force: trajectory.force,
        trajectory: nominal.then_some(trajectory),
    }
}

/// A replay that was stopped before it began: thousands of draws would take a minute to be made for
/// nothing.
fn stopped(
    engine: &Simulator,
    task: &Task,
    situation: &Situation,
    disturbance: Disturbance,
) -> Evidence {
    let start = situation.start.clone();
    let mut trajectory = Trajectory::standing(engine.spec(), Pose::default(), start);
    trajectory.warnings.push(Warning::Stopped);
    Evidence {
        engine: engine.engine(),
        disturbance,
        outcome: Outcome::judge(&situation.scene, task, &trajectory),
        warnings: trajectory.warnings,
        force: None,
        trajectory: None,
    }
}
