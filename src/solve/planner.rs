//! Planner and its builder.

use std::sync::Arc;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::effect::{
    EffectModel, EffectModels, Fallback, Job, ModelError, OutOfRange, consequence,
};
use crate::geometry::Pose;
use crate::{
    outcome::{Outcome, Record, Trajectory, Warning, in_turn},
    scene::{ModelKind, ModelSpec, Situation, State, TableFit, Tool},
    task::{Plan, Task, ToolMotion},
};

use super::check::check;
use super::error::SolveError;
use super::settings::{Effort, Settings};

/// Planner of tools and pushes for tasks, with one effort and one effect model.
///
/// ```
/// use pushplan::{Effort, PlanStatus, Planner, Simulated, Simulator, Task, ToolLibrary};
///
/// let library = ToolLibrary::embedded()?;
/// let task = Task::parse(include_str!("../../tasks/pull-back.yaml"), "pull-back.yaml")?;
/// let model = Simulated::new(Simulator::planar());
/// let planner = Planner::builder(model).effort(Effort::Draft).build();
/// let solution = planner.solve(&task, &library)?;
/// assert_eq!(solution.status, PlanStatus::Solved);
/// println!("use the {}", solution.plans[0].plan.tool());
/// # Ok::<(), pushplan::Error>(())
/// ```
pub struct Planner {
    model: Fallback,
    out_of_range: OutOfRange,
    settings: Settings,
    seed: u64,
    pub(super) time_limit: Option<Duration>,
    fit: Option<TableFit>,
}

/// Builder of a [`Planner`].
pub struct PlannerBuilder {
    model: Arc<dyn EffectModel>,
    out_of_range: OutOfRange,
    settings: Settings,
    seed: u64,
    time_limit: Option<Duration>,
    fit: Option<TableFit>,
}

/// Prediction of an effect model for a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Prediction {
    /// Predicted trajectory.
    pub trajectory: Trajectory,
    /// Outcome at the end of the trajectory.
    pub outcome: Outcome,
    /// Warnings that lower the trust in the prediction.
    pub warnings: Vec<Warning>,
}

impl PlannerBuilder {
    /// Sets the effort; [`Effort::Standard`] by default.
    pub fn effort(self, effort: Effort) -> Self {
        self.settings(effort.settings())
    }

    /// Sets the budgets individually.
    pub fn settings(mut self, settings: Settings) -> Self {
        self.settings = settings;
        self
    }

    /// Sets the seed of the samples of refinement and of the perturbations; 0 by default.
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Sets the policy if the model is not reliable; [`OutOfRange::Warn`] by default.
    pub fn out_of_range(mut self, out_of_range: OutOfRange) -> Self {
        self.out_of_range = out_of_range;
        self
    }

    /// Sets a time limit, after which the best plan so far is returned; none by default. Results
    /// then depend on the speed of the machine.
    pub fn time_limit(mut self, limit: Duration) -> Self {
        self.time_limit = Some(limit);
        self
    }

    /// Returns the planner.
    pub fn build(self) -> Planner {
        let Self { model, out_of_range, settings, seed, time_limit, fit } = self;
        let model = Fallback::new(model).out_of_range(out_of_range);
        Planner { model, out_of_range, settings, seed, time_limit, fit }
    }
}

impl Planner {
    /// Starts building a planner that predicts with `model`.
    pub fn builder(model: impl EffectModel + 'static) -> PlannerBuilder {
        let settings = Effort::default().settings();
        let (model, out_of_range) = (Arc::new(model), OutOfRange::default());
        let (seed, time_limit, fit) = (0, None, None);
        PlannerBuilder { model, out_of_range, settings, seed, time_limit, fit }
    }

    /// Starts building a planner with the model that `spec` describes.
    ///
    /// # Errors
    /// Returns [`ModelError`] if the model needs weights that cannot be used.
    pub fn with_model(spec: &ModelSpec) -> Result<PlannerBuilder, ModelError> {
        Self::fitted(spec, None)
    }

    /// Starts building a planner for a table to which a network has been fitted.
    ///
    /// # Errors
    /// Returns [`ModelError`] as [`Self::with_model`] does, or for a fit of another network.
    pub fn fitted(spec: &ModelSpec, fit: Option<&TableFit>) -> Result<PlannerBuilder, ModelError> {
        let planner = Self::builder(EffectModels::fitted(spec, fit)?);
        Ok(PlannerBuilder { fit: fit.cloned(), ..planner })
    }

    /// Returns this planner with another table fit.
    ///
    /// # Errors
    /// Returns [`ModelError`] as [`Self::fitted`] does.
    pub fn fitted_anew(&self, fit: &TableFit) -> Result<Self, ModelError> {
        let Self { out_of_range, settings, seed, time_limit, .. } = *self;
        let built = Self::fitted(self.model.spec(), Some(fit))?
            .settings(settings)
            .seed(seed)
            .out_of_range(out_of_range)
            .build();
        Ok(Self { time_limit, ..built })
    }

    /// Starts building the planner of an effort, including its effect model.
    ///
    /// # Errors
    /// Returns [`ModelError`] if the library was built with a damaged weights file.
    pub fn for_effort(effort: Effort) -> Result<PlannerBuilder, ModelError> {
        Ok(Self::with_model(&effort.model())?.effort(effort))
    }

    /// Returns the effect model.
    pub fn model(&self) -> &dyn EffectModel {
        &self.model
    }

    /// Returns the table fit.
    pub fn fit(&self) -> Option<&TableFit> {
        self.fit.as_ref()
    }

    /// Returns the time limit.
    pub fn time_limit(&self) -> Option<Duration> {
        self.time_limit
    }

    /// Returns a planner for a coarse search.
    pub(super) fn first_look(&self) -> Self {
        let (model, settings) = (self.model.clone(), Effort::Draft.settings());
        Self { model, settings, time_limit: None, fit: None, ..*self }
    }

    /// Returns the budgets.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Predicts a plan of pushes with the tools of `tools` that it names.
    ///
    /// # Errors
    /// Returns [`SolveError`] for invalid input only.
    pub fn predict(
        &self,
        task: &Task,
        tools: &[Arc<Tool>],
        plan: &Plan,
    ) -> Result<Prediction, SolveError> {
        let situation = stated(task);
        check(task, &situation, tools)?;
        let motions = plan.slides(tools).ok_or_else(|| lacking(task, plan))?;
        self.refuse(task, &situation, motions.into_iter())?;
        Ok(self.predict_all(task, &situation, &[(plan, tools)]).remove(0))
    }

    /// Returns an error for motions for which the model is not reliable, if the policy refuses
    /// them.
    pub(super) fn refuse(
        &self,
        task: &Task,
        situation: &Situation,
        motions: impl Iterator<Item = ToolMotion>,
    ) -> Result<(), SolveError> {
        if self.out_of_range != OutOfRange::Refuse {
            return Ok(());
        }
        let mut warnings = Vec::new();
        for warning in motions.flat_map(|motion| self.distrust(situation, motion)) {
            // Warnings about the scene repeat for every tool.
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
        match warnings.is_empty() {
            true => Ok(()),
            false => Err(SolveError::Refused { task: task.name.clone(), warnings }),
        }
    }

    /// Returns the reasons not to rely on the model for this motion.
    pub(super) fn distrust(&self, situation: &Situation, motion: ToolMotion) -> Vec<Warning> {
        self.model.trust(&situation.scene, &Job::new(situation, motion)).warnings()
    }

    /// Returns the seed.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Predicts plans of a valid task in one batch.
    pub(super) fn predict_all(
        &self,
        task: &Task,
        situation: &Situation,
        plans: &[(&Plan, &[Arc<Tool>])],
    ) -> Vec<Prediction> {
        let scene = &*situation.scene;
        let motions = |(plan, tools): &(&Plan, &[Arc<Tool>])| {
            Job::sequence(situation, &plan.slides(tools).unwrap_or_default())
        };
        let sequences: Vec<Vec<Job>> = plans.iter().map(motions).collect();
        // A plan without pushes moves no object and needs no model.
        let moves = |jobs: &[Job]| jobs.iter().any(|job| !job.motion.slide().strokes.is_empty());
        let moving: Vec<Vec<Job>> = sequences.iter().filter(|jobs| moves(jobs)).cloned().collect();
        let rollout = |jobs: &[Job]| self.model.rollout(scene, jobs, Record::Frames);
        let mut rolled = in_turn(&moving, Record::Frames, rollout).into_iter();
        sequences
            .iter()
            .zip(plans)
            .map(|(jobs, (_, tools))| {
                let still = || still(task, &situation.start, &tools[0]);
                let trajectory = match moves(jobs) {
                    false => still(),
                    true => rolled.next().filter(|t| !t.frames.is_empty()).unwrap_or_else(still),
                };
                let mut warnings: Vec<Warning> = Vec::new();
                let asked = jobs.iter().flat_map(|job| self.model.trust(scene, job).warnings());
                for warning in asked.chain(trajectory.warnings.iter().cloned()) {
                    if !warnings.contains(&warning) {
                        warnings.push(warning);
                    }
                }
                if warnings.iter().any(Warning::questions_model) {
                    // A simulation quantifies the doubt.
                    warnings.extend(consequence(scene, jobs, trajectory.outcome()));
                }
                let outcome = Outcome::judge(scene, task, &trajectory);
                Prediction { trajectory, outcome, warnings }
            })
            .collect()
    }
}

/// Returns the situation that a task states, including whether its supports are known.
pub fn stated(task: &Task) -> Situation {
    let mut situation = Situation::stated(&task.scene);
    if task.unknown.support {
        Arc::make_mut(&mut situation.physics).supports_known = false;
    }
    situation
}

/// Returns the error of a plan that names tools that were not given.
pub(super) fn lacking(task: &Task, plan: &Plan) -> SolveError {
    let what = format!("the plan uses tools that were not given: {}", plan.tools().join(", "));
    SolveError::bad_task(task, "", what)
}

/// Returns the trajectory of no motion.
fn still(task: &Task, start: &State, tool: &Tool) -> Trajectory {
    let home = tool.pose(Pose { position: task.robot.home, heading: 0.0 });
    Trajectory::standing(ModelKind::Still.into(), home, start.clone())
}
