//! The network as an effect model: the BRDPN physics predictor corrects the analytic model.

use std::sync::Arc;

use rayon::prelude::*;

use crate::{
    graph::{Batch, Corrections},
    network::{Buffers, Forward, Head, PredictorWeights},
    outcome::{Record, Spread, Trajectory, Warning, in_turn},
    rollout::{PairMeans, RollSettings, Roller, reachable},
    scene::{CORRECTED, ModelKind, ModelSpec, OTHER_OBJECTS, Scene, Stride, TableFit},
    task::Job,
};

use super::{EffectModel, ModelError, Quantiles, Trust, measured::measured, trust::outside};

/// Number of jobs that share a network batch: enough rows to keep the matrix products busy, few
/// enough that the cores share a search evenly. In solves in which the network computes every
/// rollout, it adds 46 us a rollout with 32, 44 with 64, 40 with 128 and 42 with 256. From 128 on,
/// a batch of the search occupies at most two cores. The number is fixed, so that results do not
/// depend on the number of threads.
const CHUNK: usize = 64;

/// A model that predicts with trained weights.
#[derive(Clone)]
pub struct Network {
    spec: ModelSpec,
    forward: Forward,
    weights: PredictorWeights,
    settings: RollSettings,
    error: Option<Quantiles>,
    strange: Option<Strange>,
}

/// A table fit and the forward pass for objects unlike the objects of the fit.
#[derive(Clone)]
struct Strange {
    fit: TableFit,
    less: Forward,
}

impl Network {
    /// Returns the model with the shipped weights.
    ///
    /// # Errors
    /// Returns [`ModelError::Shipped`] if the library was built with a damaged weights file.
    pub fn shipped() -> Result<Self, ModelError> {
        let weights = PredictorWeights::from_bytes(pushplan_models::BRDPN);
        weights.map(Self::new).map_err(ModelError::Shipped)
    }

    /// Creates a model with these weights, which [`EffectModel::spec`] reports as the shipped ones.
    #[doc(hidden)]
    pub fn new(weights: PredictorWeights) -> Self {
        let errors = weights.card.errors.as_ref();
        Self {
            spec: ModelKind::NETWORK.into(),
            forward: Forward::new(&weights),
            error: errors.map(|errors| Quantiles { median: errors.median, p95: errors.p95 }),
            weights,
            strange: None,
            settings: RollSettings { corrected: CORRECTED, ..RollSettings::default() },
        }
    }

    /// Creates a model with weights from a file. `steps` replaces the number of propagation steps
    /// of the training, and `stride` frames are predicted as one. Measured errors apply to the
    /// weights as trained, frame by frame.
    #[doc(hidden)]
    pub fn with(
        weights: PredictorWeights,
        file: Option<String>,
        steps: Option<u8>,
        stride: Stride,
    ) -> Self {
        let mut model = Self::new(weights);
        if steps.is_some() || stride != Stride::ONE {
            model.error = None;
        }
        if let Some(steps) = steps {
            model.forward = model.forward.with_steps(usize::from(steps));
        }
        model.settings.stride = stride.frames();
        model.spec = ModelKind::Network { weights: file, steps, stride }.into();
        model
    }

    /// Adds `head` to the corrections; measured errors are without it.
    ///
    /// # Panics
    /// Panics if the head has another width, see [`Self::effect_width`].
    #[doc(hidden)]
    pub fn adapted(mut self, head: &Head) -> Self {
        self.forward = self.forward.with_head(head);
        self
    }

    /// Applies a table fit. If an object of the scene resembles none of the objects of the fit,
    /// only the share [`OTHER_OBJECTS`] of the fit applies.
    ///
    /// # Errors
    /// Returns [`ModelError::Fit`] if the fit was learned with other weights.
    pub fn fitted(mut self, fit: &TableFit) -> Result<Self, ModelError> {
        let foreign = || ModelError::Fit { weights: fit.weights.clone() };
        let own = self.weights.checksum().map_err(ModelError::Shipped)?;
        let head = Head::new(fit.head.clone(), self.effect_width());
        let head = head.filter(|_| own == fit.weights).ok_or_else(foreign)?;
        let less = self.forward.clone().with_head(&head.scaled(OTHER_OBJECTS));
        self.strange = Some(Strange { fit: fit.clone(), less });
        self.forward = self.forward.with_head(&head);
        Ok(self)
    }

    /// Returns the forward pass for `scene`.
    fn forward_in(&self, scene: &Scene) -> &Forward {
        match &self.strange {
            Some(Strange { fit, less }) if !fit.strange(scene).is_empty() => less,
            _ => &self.forward,
        }
    }

    /// Returns the weights.
    #[doc(hidden)]
    pub fn weights(&self) -> &PredictorWeights {
        &self.weights
    }
}

impl Network {
    /// Adds to a trajectory the constant expected error of every moved object, and a warning if the
    /// expected error is large.
    fn doubted(&self, scene: &Scene, mut trajectory: Trajectory) -> Trajectory {
        let Some(doubt) = self.forward.doubts() else { return trajectory };
        let Trajectory { spreads, warnings, .. } = &mut trajectory;
        let all = spreads.iter_mut().enumerate();
        for (object, spread) in all.filter(|(_, spread)| spread.position > 0.0) {
            *spread += doubt.floor();
            // The noise of a fitted table is independent of the network's error.
            spread.position = spread.position.hypot(self.noise());
            let within = spread.within_90().position;
            if within > Spread::DOUBTFUL {
                let object = scene.thing_name(object).to_owned();
                match warnings.iter_mut().find_map(|warning| warning.doubt_of(&object)) {
                    Some(known) => *known = known.max(within),
                    None => warnings.push(Warning::Doubtful { object, within }),
                }
            }
        }
        trajectory
    }

    /// Returns the noise of the fitted table, metres; zero without a fit.
    fn noise(&self) -> f64 {
        self.strange.as_ref().map_or(0.0, |strange| strange.fit.noise)
    }

    /// Returns the forward pass.
    #[doc(hidden)]
    pub fn forward(&self) -> &Forward {
        &self.forward
    }

    /// Returns the settings of the rollouts.
    #[doc(hidden)]
    pub fn settings(&self) -> RollSettings {
        self.settings
    }

    /// Returns the number of [`Self::effects`] of a pair.
    pub fn effect_width(&self) -> usize {
        self.forward.half()
    }

    /// Returns the propagation effects of these pairs of objects in a rollout of `job`, one row for
    /// each pair.
    ///
    /// These are the effects of Li et al., ICRA 2019, eq. 3, in the last propagation step. The rows
    /// contain their even half, summed over both directions and averaged over the frames read.
    pub fn effects(&self, scene: &Scene, job: &Job, pairs: &[[usize; 2]]) -> Vec<Vec<f32>> {
        let job = if has_guesses(job) { &without_guesses(job) } else { job };
        let mut means = PairMeans::new(scene, job, self.effect_width());
        let settings = RollSettings { corrected: usize::MAX, ..self.settings };
        let mut roller = Roller::new(self.spec.clone(), settings);
        let (_, batch) = roller.read(scene, std::slice::from_ref(job), Record::Outcome);
        let mut buffers = Buffers::default();
        self.forward.run(batch, &mut buffers, &mut Corrections::default());
        means.add(batch, batch.graphs, |k, row| self.forward.add_effect(batch, &buffers, k, row));
        pairs.iter().map(|pair| means.mean(*pair)).collect()
    }
}

impl EffectModel for Network {
    fn spec(&self) -> &ModelSpec {
        &self.spec
    }

    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        if job.in_space() {
            return Trust::NotMine;
        }
        let warnings = outside(&self.weights.card.ranges, scene, job);
        let measured = measured(&self.spec.first().kind, || reachable(scene, job).len());
        Trust::Mine { error: measured.or(self.error), warnings }
    }

    fn takes(&self, _: &Scene, job: &Job) -> bool {
        !job.in_space()
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        let known: Vec<Job>;
        let jobs = match jobs.iter().any(has_guesses) {
            true => {
                known = jobs.iter().map(without_guesses).collect();
                &known
            }
            false => jobs,
        };
        let forward = self.forward_in(scene);
        jobs.par_chunks(CHUNK)
            .map_init(
                || (Roller::new(self.spec.clone(), self.settings), Buffers::default()),
                |(roller, buffers), chunk| {
                    // Later pushes start from corrected poses.
                    let stages: Vec<Vec<Job>> = chunk.iter().map(Job::stages).collect();
                    in_turn(&stages, record, |jobs| {
                        let mut correct = |batch: &Batch, corrections: &mut Corrections| {
                            forward.run(batch, buffers, corrections);
                        };
                        roller.roll(scene, jobs, record, Some(&mut correct))
                    })
                },
            )
            .flatten_iter()
            .map(|trajectory| self.doubted(scene, trajectory))
            .collect()
    }
}

fn has_guesses(job: &Job) -> bool {
    job.physics.joints.iter().any(|joint| joint.guessed)
}

/// Returns the job with guessed anchors and axes treated as known ones.
///
/// Neither analytic model nor projection restores a guessed joint, and the errors of the network
/// accumulate. Its errors on 60 dense and 60 sparse scenes of nine objects are 44.5 and 60.4 mm.
/// Treating the same geometry as known reduces them to 21.0 and 39.0, as for the analytic model.
pub fn without_guesses(job: &Job) -> Job {
    let mut job = job.clone();
    if has_guesses(&job) {
        let physics = Arc::make_mut(&mut job.physics);
        physics.joints.iter_mut().for_each(|joint| joint.guessed = false);
    }
    job
}
