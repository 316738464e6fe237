//! Several models for one task: each job goes to the first that takes it, and what happens where
//! that one should not be trusted.

use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::scene::{Job, ModelSpec, Record, Scene, State, Trajectory, Warning};
use crate::sim::Simulator;

use super::{EffectModel, Quantiles, Simulated, Trust};

/// What to do outside of a model's ranges, and where its own rollout shows that it went wrong (see
/// [`Warning::questions_model`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outside {
    /// Simulate in the plane instead: as expensive as the planar engine, where it is needed.
    Simulate,
    /// Predict, and say so.
    #[default]
    Warn,
    /// Give no prediction.
    Refuse,
}

impl fmt::Display for Outside {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Outside::Simulate => "simulate",
            Outside::Warn => "warn",
            Outside::Refuse => "refuse",
        })
    }
}

/// Models of which each job gets the first that takes it, or else the last.
pub struct Routed {
    models: Vec<Arc<dyn EffectModel>>,
    spec: ModelSpec,
    outside: Outside,
    planar: Simulated,
}

/// Which model a job goes to, and the warnings about that.
struct Route {
    model: usize,
    error: Option<Quantiles>,
    warnings: Vec<Warning>,
}

impl Routed {
    /// `model` for all jobs.
    pub fn new(model: Arc<dyn EffectModel>) -> Self {
        let spec = model.spec().clone();
        let planar = Simulated::new(Simulator::planar());
        Self { models: vec![model], spec, outside: Outside::default(), planar }
    }

    /// The same, and `other` for jobs that none of them takes.
    pub fn or(mut self, other: Arc<dyn EffectModel>) -> Self {
        self.spec = self.spec.or(other.spec().clone());
        self.models.push(other);
        self
    }

    /// The same with this done where a model should not be trusted; [`Outside::Warn`] by
    /// default.
    pub fn outside(self, outside: Outside) -> Self {
        Self { outside, ..self }
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

    /// The rollouts of those of `jobs` that `wanted` picks, by `model`, into their places.
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

impl EffectModel for Routed {
    fn spec(&self) -> &ModelSpec {
        &self.spec
    }

    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        let Route { error, warnings, .. } = self.route(scene, job);
        if self.outside != Outside::Simulate || warnings.is_empty() {
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
        if self.outside == Outside::Warn {
            if let [only] = &self.models[..] {
                return only.rollout(scene, jobs, record);
            }
            // Only which model it is counts here; what speaks against it is not asked for.
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
        // What a model itself got wrong on the way counts as well.
        let doubt = |place: &Option<Trajectory>| {
            let warnings = place.iter().flat_map(|place| &place.warnings);
            warnings.clone().find(|warning| warning.questions_model()).cloned()
        };
        let doubts: Vec<Option<Warning>> = places.iter().map(doubt).collect();
        let out = |k: usize| !inside(k) || doubts[k].is_some();
        if self.outside == Outside::Simulate {
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

impl Routed {
    /// No prediction: the start alone, with all that speaks against one.
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

/// How far the planar engine ends from what is predicted for `job`, as a warning, for the object on
/// which the two differ most: what it means for this motion that the model is outside its range.
pub fn consequence(scene: &Scene, job: &Job, predicted: &State) -> Option<Warning> {
    let run = Simulator::planar().run(scene, job, Record::Outcome);
    let apart = |k: usize| (run.outcome().poses[k].position - predicted.poses[k].position).norm();
    let far = (0..scene.objects.len()).max_by(|&a, &b| apart(a).total_cmp(&apart(b)))?;
    Some(Warning::Differs { object: scene.objects[far].name.clone(), distance: apart(far) })
}

fn simulated(reason: Warning) -> Warning {
    Warning::Simulated { reason: Box::new(reason) }
}

#[cfg(test)]
mod tests {
    use crate::effect::{Prior, UpTo};
    use crate::geometry::{Pose, Vector};
    use crate::scene::{Object, Part, Push, Quantity, Tool, ToolMotion};

    use super::*;

    /// A row of three cans, and one far from them; a push into the row, and one of the can alone.
    fn row() -> (Scene, [Job; 2]) {
        let can = |x: f64, y: f64| Object {
            mass: 0.5,
            friction: 0.4,
            pose: Pose::new(x, y, 0.0),
            ..Object::cylinder(format!("{x} {y}"), 0.03, 0.1)
        };
        let objects = vec![can(0.1, 0.0), can(0.165, 0.0), can(0.23, 0.0), can(0.1, 0.5)];
        let scene = Scene { table_friction: 0.4, objects, ..Scene::default() };
        let bar = Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::default());
        let tool = Arc::new(Tool::new("bar", [bar]).expect("one piece").friction(0.3));
        let job = |y: f64| {
            let push =
                Push { start: Vector::new(0.0, y), direction: 0.0, length: 0.15, speed: 0.1 };
            Job::stated(&scene, ToolMotion::pushes(tool.clone(), 0.002, 0.0, &[push], true))
        };
        let jobs = [job(0.0), job(0.5)];
        (scene, jobs)
    }

    #[test]
    fn pushes_into_a_crowd_are_simulated_and_those_beside_it_are_not() {
        let (scene, jobs) = row();
        let (prior, planar) = (Prior::default(), Simulator::planar());
        let roll = |model: &dyn EffectModel| model.rollout(&scene, &jobs, Record::Outcome);
        let [own, engine] = [roll(&prior), roll(&Simulated::new(planar))];
        assert!(own != engine);
        let to = |most: u16| {
            let few = Arc::new(UpTo::new(prior.clone(), most));
            Routed::new(few).or(Arc::new(Simulated::new(planar)))
        };
        let model = to(2);
        assert_eq!(model.spec().to_string(), "prior,up-to=2|planar");
        let mixed = roll(&model);
        assert_eq!([&mixed[0], &mixed[1]], [&engine[0], &own[1]]);
        assert_eq!(
            mixed.iter().map(|one| one.by.to_string()).collect::<Vec<_>>(),
            ["planar", "prior"]
        );
        // The planar engine, where it stands in, is exact; the prior is not.
        let errors = [0, 1].map(|k| model.trust(&scene, &jobs[k]).error().map(|error| error.p95));
        assert!(errors[0] == Some(0.0) && errors[1].is_some_and(|p95| p95 > 0.0), "{errors:?}");
        assert_eq!(roll(&to(3)), own);
        assert_eq!(roll(&to(0)), engine);
    }

    #[test]
    fn routing_asks_for_the_start_of_the_job_and_not_of_the_scene() {
        let (scene, jobs) = row();
        let model = Routed::new(Arc::new(UpTo::new(Prior::default(), 2)))
            .or(Arc::new(Simulated::new(Simulator::planar())));
        // The row has been cleared away: what the push reaches is one can.
        let mut job = jobs[0].clone();
        for k in [1, 2] {
            job.start.poses[k].position.x += 5.0;
        }
        assert_eq!(
            model.trust(&scene, &jobs[0]).error(),
            Some(Quantiles { median: 0.0, p95: 0.0 })
        );
        assert!(model.trust(&scene, &job).error().is_some_and(|error| error.p95 > 0.0));
        let by = model.rollout(&scene, &[job], Record::Outcome)[0].by.to_string();
        assert_eq!(by, "prior");
    }

    #[test]
    fn what_no_model_takes_is_said_simulated_or_refused() {
        let (scene, jobs) = row();
        let alone = |outside| {
            let model = UpTo::new(Prior::default(), 2);
            assert_eq!(model.trust(&scene, &jobs[0]), Trust::NotMine);
            Routed::new(Arc::new(model)).outside(outside)
        };
        let declined = |warning: &Warning| matches!(warning, Warning::Declined { .. });
        assert!(alone(Outside::Warn).trust(&scene, &jobs[0]).warnings().iter().all(declined));
        let roll = |outside| alone(outside).rollout(&scene, &jobs[..1], Record::Outcome).remove(0);
        assert_eq!(roll(Outside::Warn).by.to_string(), "prior");
        assert_eq!(roll(Outside::Simulate).by.to_string(), "planar");
        assert_eq!(roll(Outside::Refuse).outcome(), &jobs[0].start);
    }

    #[test]
    fn trust_is_asked_under_the_physics_of_the_job() {
        let (scene, jobs) = row();
        let prior = Prior::default();
        assert_eq!(prior.trust(&scene, &jobs[1]).warnings(), []);
        let mut heavy = jobs[1].clone();
        Arc::make_mut(&mut heavy.physics).masses[3] = 20.0;
        let found = prior.trust(&scene, &heavy).warnings();
        let quantity = |warning: &Warning| match warning {
            Warning::OutsideRange { quantity, .. } => Some(*quantity),
            _ => None,
        };
        assert_eq!(found.iter().map(quantity).collect::<Vec<_>>(), [Some(Quantity::Mass)]);
    }
}
