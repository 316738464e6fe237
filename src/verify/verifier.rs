//! Verifier of plans.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use crate::geometry::Pose;
use crate::progress::{NoProgress, Progress};
use crate::sim::{LeverSimulator, Simulator};
use crate::{
    outcome::{
        Evidence, Outcome, Perturbation, Record, Trajectory, Verdict, Warning, never_on,
        step_states,
    },
    scene::{Engine, JointTrajectory, Scene, Situation, Tool},
    task::{Job, Plan, Task},
};

use super::arm::arm_faults;
use super::conditions::Conditions;
use super::force::force_warnings;
use super::perturbation::{perturbed, perturbed_spatial, wary};
use super::rules::{hand_meets, rule_violations, travel_faults, unplayable};
use super::sequential_test;
use super::space;
use super::table_edge::near_edge;

/// Processor time of a 2-D time step for each object, seconds: 1 us measured with one object and
/// 0.5 with nine.
const PLANAR_STEP: f64 = 1e-6;

/// Processor time of a 3-D time step for each object, seconds: 6 us measured with one object and 5
/// with nine.
const SPATIAL_STEP: f64 = 6e-6;

/// Settings of the verification.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VerifySettings {
    /// Minimum number of perturbed replays in each engine before a decision. Plans that clearly
    /// fail in 2-D have no perturbed replays in 3-D.
    pub replays: usize,
    /// Seed of the perturbations.
    pub seed: u64,
}

/// Verifier that replays plans in both engines.
#[derive(Clone)]
pub struct Verifier<'a> {
    settings: VerifySettings,
    planar: Simulator,
    spatial: Simulator,
    progress: &'a dyn Progress,
    /// Whether replays are added until the verdict is clear.
    until_clear: bool,
    /// Whether replays end once a plan has never worked with one of the support models.
    giving_up: bool,
    /// Whether perturbed replays are made in 2-D only.
    in_plane: bool,
    /// Joint trajectory stated with the plan, if any.
    joints: Option<&'a JointTrajectory>,
}

impl<'a> Verifier<'a> {
    /// Creates a verifier with the engines at their default time steps.
    pub fn new(settings: VerifySettings) -> Self {
        let [planar, spatial] =
            [Simulator::planar(), Simulator::spatial()].map(Simulator::retreating);
        let progress = &NoProgress;
        Self {
            settings,
            planar,
            spatial,
            progress,
            until_clear: false,
            giving_up: false,
            in_plane: false,
            joints: None,
        }
    }

    /// Sets a progress observer that can stop the replays. Stopped replays carry
    /// [`Warning::Stopped`], and the plan does not pass.
    pub fn with_progress(self, progress: &'a dyn Progress) -> Self {
        Self { progress, ..self }
    }

    /// Adds perturbed replays until the sequential test decides whether the required share reaches
    /// the goal, or until each engine has made 64. One decision in a hundred is wrong on average,
    /// see `sequential_test`.
    pub fn until_clear(self) -> Self {
        Self { until_clear: true, ..self }
    }

    /// Ends the replays if all replays of one engine with one support model, at least four, fail.
    /// This suffices for trying another plan but not for a verdict, because one in 64 such plans
    /// may still work.
    pub fn giving_up(self) -> Self {
        Self { giving_up: true, ..self }
    }

    /// Limits perturbed replays to the 2-D engine. The resulting share is an upper bound, because a
    /// plan cannot succeed more often than it does there.
    pub fn in_plane(self) -> Self {
        Self { in_plane: true, ..self }
    }

    /// Sets the joint trajectory stated with the plan, which is then judged in place of a computed
    /// one.
    pub fn moving(self, joints: Option<&'a JointTrajectory>) -> Self {
        Self { joints, ..self }
    }

    /// Estimates the processor time of verifying a plan on one core, seconds. The estimate is right
    /// to within a factor of three unless all objects are pushed into each other.
    pub fn seconds(&self, scene: &Scene, plan: &Plan) -> f64 {
        let pushing = plan.push_steps().map(|step| step.push.duration());
        let levering = plan.lever_steps().map(|step| step.lever.duration());
        let moving: f64 = pushing.chain(levering).sum();
        let each = [(&self.planar, PLANAR_STEP), (&self.spatial, SPATIAL_STEP)];
        let replay: f64 = each.iter().map(|(engine, cost)| moving / engine.step() * cost).sum();
        replay * scene.objects.len() as f64 * (self.settings.replays + 1) as f64
    }

    /// Makes the nominal replays in both engines, or only in 3-D for plans that leave the plane.
    /// They show whether a plan works as written.
    ///
    /// `tools` holds the tools that the plan names.
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
        let mut forbidden = rule_violations(task, scene, tools, plan);
        if in_space(task, plan) {
            let evidence = vec![self.replay_in_space(task, situation, (tools, plan), None)];
            forbidden.extend(hand_faults((task, scene), tools, plan, &evidence));
            let states = step_states(&situation.start, plan.steps.len(), &evidence);
            forbidden.extend(travel_faults((task, scene), tools, plan, &states));
            forbidden.extend(arm_faults((task, situation), tools, plan, &evidence, self.joints));
            return Verdict::judge(forbidden, evidence, task.robustness);
        }
        let motions = plan.slides(tools).unwrap_or_default();
        let jobs = Job::sequence(situation, &motions);
        let mut evidence: Vec<Evidence> = [&self.spatial, &self.planar]
            .into_par_iter()
            .map(|engine| self.replay(engine, task, scene, &jobs, Perturbation::Nominal))
            .collect();
        // The 2-D engine comes first, because people compare predictions with it.
        evidence.reverse();
        forbidden.extend(hand_faults((task, scene), tools, plan, &evidence));
        let states = step_states(&situation.start, plan.steps.len(), &evidence);
        forbidden.extend(travel_faults((task, scene), tools, plan, &states));
        forbidden.extend(arm_faults((task, situation), tools, plan, &evidence, self.joints));
        Verdict::judge(forbidden, evidence, task.robustness)
    }

    /// Adds the perturbed replays to a verdict of [`Verifier::nominal`]. Replays that the verdict
    /// already holds are not repeated.
    pub fn perturb(
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
            let replays: Vec<Evidence> = (0..self.settings.replays)
                .into_par_iter()
                .map(|draw| {
                    if self.progress.cancelled() {
                        let perturbation = Perturbation::Perturbed { draw: draw + 1 };
                        return stopped(&self.spatial, task, situation, perturbation);
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
        let (nominal, replays): (Vec<Evidence>, Vec<Evidence>) =
            evidence.into_iter().partition(|one| one.perturbation == Perturbation::Nominal);
        let (mut planar, mut spatial): (Vec<Evidence>, Vec<Evidence>) =
            replays.into_iter().partition(|one| one.engine == Engine::Planar);
        let conditions = Conditions::of(task, &situation.scene, motions, &nominal);
        let asked = (task, situation, &conditions);
        // The 2-D engine comes first. If the plan fails there, the slower engine is skipped.
        self.add_perturbed(&self.planar, asked, &mut planar);
        let refused = never(&planar, task)
            || sequential_test::answer(&planar, task.robustness) == Some(false);
        if !(refused || self.in_plane) {
            let engine = &perturbed_spatial(situation);
            self.add_perturbed(engine, asked, &mut spatial);
        }
        let evidence = nominal.into_iter().chain(planar).chain(spatial).collect();
        Verdict::judge(forbidden, evidence, task.robustness)
    }

    /// Adds perturbed replays in one engine until they suffice.
    fn add_perturbed(
        &self,
        engine: &Simulator,
        asked: (&Task, &Situation, &Conditions),
        own: &mut Vec<Evidence>,
    ) {
        let least = self.settings.replays;
        loop {
            let done = own.len();
            let is_clear = || {
                let failed = self.giving_up && never(own, asked.0);
                failed || sequential_test::answer(own, asked.0.robustness).is_some()
            };
            // Replays that were stopped fail, so that no unclear verdict passes.
            let wanted = match done < least {
                true => least,
                false if self.until_clear && least > 0 && !is_clear() => {
                    (done + sequential_test::LOOK).min(sequential_test::MOST)
                }
                false => done,
            };
            if done >= wanted {
                return;
            }
            own.extend(self.perturbed(engine, asked, done..wanted));
        }
    }

    /// Makes the perturbed replays of these draws in an engine.
    fn perturbed(
        &self,
        engine: &Simulator,
        (task, situation, conditions): (&Task, &Situation, &Conditions),
        draws: Range<usize>,
    ) -> Vec<Evidence> {
        draws
            .into_par_iter()
            .map(|draw| {
                let perturbation = Perturbation::Perturbed { draw: draw + 1 };
                if self.progress.cancelled() {
                    return stopped(engine, task, situation, perturbation);
                }
                let scene = &conditions.scene;
                let motions = conditions.motions(draw);
                let jobs = perturbed(situation, motions, self.settings.seed, draw);
                // An observation with errors is still the pose from which `keep` counts.
                let start = jobs.first().map_or(&situation.start, |job| &job.start);
                self.replay(engine, task, &scene.keeping_from(start), &jobs, perturbation)
            })
            .collect()
    }

    /// Makes all replays of a plan: nominal, then perturbed.
    pub fn verify(
        &self,
        task: &Task,
        situation: &Situation,
        tools: &[Arc<Tool>],
        plan: &Plan,
    ) -> Verdict {
        let nominal = self.nominal(task, situation, tools, plan);
        self.perturb(task, situation, tools, plan, nominal)
    }

    /// Replays a plan in 3-D, as written or perturbed by this draw.
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
            space::perturbed(&wary, &mut motions, about, (self.settings.seed, draw))
        });
        let really = really.as_ref().unwrap_or(situation);
        let record = if draw.is_none() { Record::Frames } else { Record::Outcome };
        let watched = (record, self.progress);
        let trajectory = LeverSimulator::default().run_all(really, scene, &motions, watched);
        // The obstacles have been displaced as well.
        let scene = Scene { obstacles: really.scene.obstacles.clone(), ..scene.clone() };
        let perturbation = match draw {
            None => Perturbation::Nominal,
            Some(draw) => Perturbation::Perturbed { draw: draw + 1 },
        };
        evidence(&self.spatial, task, &scene, trajectory, perturbation)
    }

    /// Replays jobs in order; a job without pushes leaves everything in place.
    fn replay(
        &self,
        engine: &Simulator,
        task: &Task,
        scene: &Scene,
        jobs: &[Job],
        perturbation: Perturbation,
    ) -> Evidence {
        let nominal = perturbation == Perturbation::Nominal;
        let record = if nominal { Record::Frames } else { Record::Outcome };
        let trajectory = engine.run_in_turn(scene, jobs, record, self.progress);
        evidence(engine, task, scene, trajectory, perturbation)
    }
}

/// Returns `true` if a plan is fragile, because it fails in all replays with one support model.
fn never(replays: &[Evidence], task: &Task) -> bool {
    task.robustness > 0.0 && never_on(replays.iter()).is_some()
}

/// Returns `true` if a plan is replayed in 3-D only.
fn in_space(task: &Task, plan: &Plan) -> bool {
    task.in_space() || plan.levers()
}

/// Returns the first object that the hand passes through in these replays.
fn hand_faults<'e>(
    asked: (&Task, &Scene),
    tools: &[Arc<Tool>],
    plan: &Plan,
    replays: impl IntoIterator<Item = &'e Evidence>,
) -> Option<Warning> {
    let mut played = replays.into_iter().filter_map(|replay| replay.trajectory.as_ref());
    played.find_map(|trajectory| hand_meets(asked, tools, plan, &trajectory.frames))
}

/// Returns the evidence of a replay.
fn evidence(
    engine: &Simulator,
    task: &Task,
    scene: &Scene,
    mut trajectory: Trajectory,
    perturbation: Perturbation,
) -> Evidence {
    let nominal = perturbation == Perturbation::Nominal;
    trajectory.warnings.extend(force_warnings(task, scene, &trajectory));
    // Falls that a goal requires need no warning.
    let wanted = |name: &str| {
        let goals = task.goals.iter().filter(|goal| goal.falls());
        let mut movers = goals.flat_map(|goal| goal.movers());
        movers.any(|k| scene.objects.get(k).is_some_and(|object| object.name == name))
    };
    let reported =
        |warning: &Warning| !matches!(warning, Warning::Fell { object } if wanted(object));
    trajectory.warnings.retain(reported);
    let mut outcome = Outcome::judge(scene, task, &trajectory);
    let near = near_edge(task, scene, trajectory.outcome());
    outcome.reached &= nominal || near.is_none();
    trajectory.warnings.extend(near);
    Evidence {
        engine: engine.engine(),
        perturbation,
        outcome,
        warnings: trajectory.warnings.clone(),
        force: trajectory.force,
        trajectory: nominal.then_some(trajectory),
    }
}

/// Returns the evidence of a replay that was stopped before its start. Setting up thousands of
/// draws would otherwise take a minute.
fn stopped(
    engine: &Simulator,
    task: &Task,
    situation: &Situation,
    perturbation: Perturbation,
) -> Evidence {
    let start = situation.start.clone();
    let mut trajectory = Trajectory::standing(engine.spec(), Pose::default(), start);
    trajectory.warnings.push(Warning::Stopped);
    Evidence {
        engine: engine.engine(),
        perturbation,
        outcome: Outcome::judge(&situation.scene, task, &trajectory),
        warnings: trajectory.warnings,
        force: None,
        trajectory: None,
    }
}
