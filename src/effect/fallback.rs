//! Several models for one task: each job is given to the first model that accepts it, with a policy
//! for jobs outside its ranges.

use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::progress::NoProgress;
use crate::sim::Simulator;
use crate::{
    outcome::{Record, Trajectory, Warning},
    scene::{ModelSpec, Scene, State},
    task::Job,
};

use super::{EffectModel, Quantiles, Simulated, Trust};

/// Policy for jobs outside a model's ranges, and for rollouts that question the model themselves
/// (see [`Warning::questions_model`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OutOfRange {
    /// Simulate in 2-D instead, at the cost of the engine for these jobs.
    Simulate,
    /// Predict, and add a warning.
    #[default]
    Warn,
    /// Return no prediction.
    Refuse,
}

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            OutOfRange::Simulate => "simulate",
            OutOfRange::Warn => "warn",
            OutOfRange::Refuse => "refuse",
        })
    }
}

/// Difference between prediction and 2-D simulation below which no warning is added, metres. The
/// 2-D and the 3-D engine differ by more.
const SAME: f64 = 1e-3;

/// Models in order of preference: a job is given to the first that accepts it, otherwise to the
/// last.
#[derive(Clone)]
pub struct Fallback {
    models: Vec<Arc<dyn EffectModel>>,
    spec: ModelSpec,
    out_of_range: OutOfRange,
    planar: Simulated,
}

/// The model of a job, and its warnings.
struct Route {
    model: usize,
    error: Option<Quantiles>,
    warnings: Vec<Warning>,
}

impl Fallback {
    /// Uses `model` for all jobs.
    pub fn new(model: Arc<dyn EffectModel>) -> Self {
        let spec = model.spec().clone();
        let planar = Simulated::new(Simulator::planar());
        Self { models: vec![model], spec, out_of_range: OutOfRange::default(), planar }
    }

    /// Adds `other` for jobs that no model so far accepts.
    pub fn or(mut self, other: Arc<dyn EffectModel>) -> Self {
        self.spec = self.spec.or(other.spec().clone());
        self.models.push(other);
        self
    }

    /// Sets the policy for jobs outside a model's ranges; [`OutOfRange::Warn`] by default.
    pub fn out_of_range(self, out_of_range: OutOfRange) -> Self {
        Self { out_of_range, ..self }
    }

    fn route(&self, scene: &Scene, job: &Job) -> Route {
        for (model, one) in self.models.iter().enumerate() {
            if let Trust::Mine { error, warnings } = one.trust(scene, job) {
                return Route { model, error, warnings };
            }
        }
        let last = self.models.len() - 1;
        let declined = Warning::Declined { model: self.models[last].spec().clone() };
        Route { model: last, error: None, warnings: vec![declined] }
    }

    /// Rolls out by `model` the `jobs` whose index is `wanted`, and stores the results in their
    /// `places`.
    fn fill(
        model: &dyn EffectModel,
        (scene, jobs, record): (&Scene, &[Job], Record),
        wanted: impl Fn(usize) -> bool,
        places: &mut [Option<Trajectory>],
    ) {
        let picked: Vec<usize> = (0..jobs.len()).filter(|&k| wanted(k)).collect();
        if picked.is_empty() {
            return;
        }
        let few: Vec<Job> = picked.iter().map(|&k| jobs[k].clone()).collect();
        for (k, trajectory) in picked.into_iter().zip(model.rollout(scene, &few, record)) {
            places[k] = Some(trajectory);
        }
    }
}

impl EffectModel for Fallback {
    fn spec(&self) -> &ModelSpec {
        &self.spec
    }

    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        let Route { error, warnings, .. } = self.route(scene, job);
        if self.out_of_range != OutOfRange::Simulate || warnings.is_empty() {
            return Trust::Mine { error, warnings };
        }
        let error = self.planar.trust(scene, job).error();
        Trust::Mine { error, warnings: warnings.into_iter().map(simulated).collect() }
    }

    fn takes(&self, scene: &Scene, job: &Job) -> bool {
        self.models.iter().any(|model| model.takes(scene, job))
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        let work = (scene, jobs, record);
        if self.out_of_range == OutOfRange::Warn {
            if let [only] = &self.models[..] {
                return only.rollout(scene, jobs, record);
            }
            // Only the choice of the model matters here, not its warnings.
            let taker = |job| self.models.iter().position(|model| model.takes(scene, job));
            let last = self.models.len() - 1;
            let takers: Vec<usize> = jobs.iter().map(|job| taker(job).unwrap_or(last)).collect();
            let mut places: Vec<Option<Trajectory>> = vec![None; jobs.len()];
            for (index, model) in self.models.iter().enumerate() {
                Self::fill(model, work, |k| takers[k] == index, &mut places);
            }
            return places.into_iter().flatten().collect();
        }
        let routes: Vec<Route> = jobs.iter().map(|job| self.route(scene, job)).collect();
        let inside = |k: usize| routes[k].warnings.is_empty();
        let mut places: Vec<Option<Trajectory>> = vec![None; jobs.len()];
        for (index, model) in self.models.iter().enumerate() {
            let own = |k: usize| routes[k].model == index && inside(k);
            Self::fill(model, work, own, &mut places);
        }
        // Warnings of the rollout itself count as well.
        let doubt = |place: &Option<Trajectory>| {
            let warnings = place.iter().flat_map(|place| &place.warnings);
            warnings.clone().find(|warning| warning.questions_model()).cloned()
        };
        let doubts: Vec<Option<Warning>> = places.iter().map(doubt).collect();
        let out = |k: usize| !inside(k) || doubts[k].is_some();
        if self.out_of_range == OutOfRange::Simulate {
            Self::fill(&self.planar, work, out, &mut places);
            for (place, doubt) in places.iter_mut().zip(doubts) {
                let doubt = doubt.map(simulated);
                place.iter_mut().for_each(|place| place.warnings.extend(doubt.clone()));
            }
        } else {
            for k in (0..jobs.len()).filter(|&k| out(k)) {
                places[k] = Some(self.refused(&jobs[k], &routes[k], places[k].take()));
            }
        }
        places.into_iter().flatten().collect()
    }
}

impl Fallback {
    /// Returns a refusal: a trajectory with only the start, and the warnings because of which the
    /// job is not predicted.
    fn refused(&self, job: &Job, route: &Route, doubtful: Option<Trajectory>) -> Trajectory {
        let tool = job.motion.slide().strokes.first().map(|stroke| stroke.from).unwrap_or_default();
        let by = self.models[route.model].spec().clone();
        let mut refused = Trajectory::standing(by, tool, job.start.clone());
        refused.warnings = doubtful.map(|doubtful| doubtful.warnings).unwrap_or_default();
        refused.warnings.extend(route.warnings.iter().cloned());
        refused.warnings.push(Warning::Refused);
        refused
    }
}

/// Returns a warning with the difference between `predicted` and the 2-D engine's result for `jobs`
/// in turn, for the object with the largest difference. It shows the effect of leaving the model's
/// ranges.
pub fn consequence(scene: &Scene, jobs: &[Job], predicted: &State) -> Option<Warning> {
    let run = Simulator::planar().run_in_turn(scene, jobs, Record::Outcome, &NoProgress);
    let simulated = run.outcome();
    let apart = |k: usize| (simulated.poses[k].position - predicted.poses[k].position).norm();
    let far = (0..scene.objects.len()).max_by(|&a, &b| apart(a).total_cmp(&apart(b)))?;
    let object = scene.thing_name(far).to_owned();
    (apart(far) >= SAME).then(|| Warning::Differs { object, distance: apart(far) })
}

fn simulated(reason: Warning) -> Warning {
    Warning::Simulated { reason: Box::new(reason) }
}

#[cfg(test)]
mod tests;
