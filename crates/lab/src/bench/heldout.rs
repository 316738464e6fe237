//! Errors of effect models on held-out pushes, against both engines.
//!
//! Objects whose true (2-D) motion exceeds 1 cm are counted. The others have their own numbers,
//! because predicting rest is another skill. Evaluating the simulated 3-D model gives the table of
//! differences between the two engines.
//!
//! The 2-D engine presses at a stated height, which models receive. In 3-D, faces meet flat and the
//! height of the contact force is open.

use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::effect::{EffectModel, shifted_start};
use pushplan::internals::seeded::generator;
use pushplan::internals::sim::Simulator;
use pushplan::internals::{
    outcome::{Record, Warning},
    scene::{Physics, Scene},
    task::Job,
};
use pushplan_act::judge::{Comparison, MOVED, ObjectError, Summary, Trial};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::suite::{Suite, SuiteKind};

/// Perturbation of the start for the spread of the 2-D ground truth, metres.
pub const PERTURBATION: f64 = 1e-4;

/// A suite with its ground truths.
#[derive(Clone, Debug)]
pub struct HeldOut {
    kind: SuiteKind,
    seed: u64,
    planar: Vec<Trial>,
    /// The pushes in 3-D; `None` where an object fell over, because its pose has no 2-D meaning.
    spatial: Vec<Option<Trial>>,
}

/// Errors of a model on a suite.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeldOutErrors {
    /// Name of the model.
    pub model: String,
    /// Rows for all objects first, then by shape and by number of objects on the table.
    pub rows: Vec<ErrorRow>,
}

/// Errors over a group of objects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorRow {
    /// Name of the group.
    pub group: String,
    /// Distance of the predicted from the 2-D final position, moved objects, metres.
    pub position: Option<Summary>,
    /// Rotation error of moved cuboids, degrees.
    pub heading_deg: Option<Summary>,
    /// Distance from the 3-D engine's final position, moved objects, metres.
    pub position_3d: Option<Summary>,
    /// Rotation error against the 3-D engine, moved cuboids, degrees.
    pub heading_3d_deg: Option<Summary>,
    /// Distance from the 2-D final position, unmoved objects, metres.
    pub unmoved: Option<Summary>,
    /// Number of objects without a finite answer of the model, which are excluded from all other
    /// numbers.
    pub failed: usize,
}

/// Errors of several models on a suite, and the spread of the ground truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeldOutReport {
    /// Kind of the pushes.
    pub suite: SuiteKind,
    /// Seed of the pushes.
    pub seed: u64,
    /// Number of pushes.
    pub pushes: usize,
    /// Number of pushes in which an object fell over in the 3-D engine, excluded from its
    /// comparison.
    pub toppled: usize,
    /// True motion of the moved objects, metres.
    pub motion: Option<Summary>,
    /// Errors of each model; the 2-D engine from a perturbed start comes first.
    pub models: Vec<HeldOutErrors>,
}

/// Errors of an object in a push.
struct Judged {
    cylinder: bool,
    objects: usize,
    error: ObjectError,
    against_3d: Option<ObjectError>,
}

impl HeldOut {
    /// Draws a suite with the tools of `library` and simulates it in both engines, on all
    /// threads of the current rayon pool.
    pub fn prepare(kind: SuiteKind, library: &ToolLibrary, seed: u64, pushes: usize) -> Self {
        let suite = Suite::draw(kind, library, seed, pushes);
        let (planar, spatial) = suite
            .cases
            .par_iter()
            .map(|case| {
                let trial = |simulator: Simulator, push_height: Option<f64>| {
                    let scene = Scene { push_height, ..case.scene.clone() };
                    let job = Job::stated(&scene, case.motion.clone());
                    let played = simulator.run(&scene, &job, Record::Outcome);
                    let sound = !played.warnings.iter().any(Warning::forbids_success);
                    let poses = played.outcome().poses.clone();
                    (Trial::to_rest(scene, case.motion.clone(), poses), sound)
                };
                let (planar, _) = trial(Simulator::planar(), Some(Physics::PUSH_HEIGHT));
                let (spatial, sound) = trial(Simulator::spatial(), None);
                (planar, sound.then_some(spatial))
            })
            .unzip();
        Self { kind, seed, planar, spatial }
    }

    /// Computes the errors of all models and the spread of the 2-D ground truth.
    pub fn report(&self, models: &[&dyn EffectModel]) -> HeldOutReport {
        let mut errors = vec![self.spread()];
        errors.extend(models.iter().map(|model| self.evaluate(*model)));
        let motions: Vec<f64> =
            self.planar.iter().flat_map(Trial::motions).filter(|motion| *motion > MOVED).collect();
        HeldOutReport {
            suite: self.kind,
            seed: self.seed,
            pushes: self.planar.len(),
            toppled: self.spatial.iter().filter(|trial| trial.is_none()).count(),
            motion: Summary::of(&motions),
            models: errors,
        }
    }

    /// Computes the errors of a model.
    pub fn evaluate(&self, model: &dyn EffectModel) -> HeldOutErrors {
        self.judge(&model.spec().to_string(), |trial, _| Comparison::of(model, trial))
    }

    /// Compares the 2-D engine with itself, every object's start shifted by 0.1 mm in a random
    /// direction. No model can be expected to have smaller errors.
    pub fn spread(&self) -> HeldOutErrors {
        self.judge("planar, start off by 0.1 mm", |trial, index| {
            let mut rng = generator(self.seed ^ 0xD157, index as u64);
            let job = trial.job();
            let start = shifted_start(&job.start, &job.physics, PERTURBATION, &mut rng);
            let job = Job { start, ..job };
            Comparison::new(trial, Simulator::planar().run(&trial.scene, &job, Record::Outcome))
        })
    }

    fn judge<'a>(
        &'a self,
        name: &str,
        compare: impl Fn(&'a Trial, usize) -> Comparison<'a> + Sync,
    ) -> HeldOutErrors {
        let judged: Vec<Judged> =
            self.planar
                .par_iter()
                .zip(&self.spatial)
                .enumerate()
                .flat_map_iter(|(index, (trial, spatial))| {
                    let against_3d = spatial.as_ref().map(|trial| compare(trial, index).end());
                    let objects = &trial.scene.objects;
                    let judged = compare(trial, index).end().into_iter().enumerate().map(
                        move |(k, error)| Judged {
                            cylinder: objects[k].shape.is_cylinder(),
                            objects: objects.len(),
                            error,
                            against_3d: against_3d.as_ref().map(|errors| errors[k]),
                        },
                    );
                    judged.collect::<Vec<_>>()
                })
                .collect();
        HeldOutErrors { model: name.to_owned(), rows: rows(&judged) }
    }
}

fn rows(judged: &[Judged]) -> Vec<ErrorRow> {
    let mut rows = vec![row("all", judged, |_| true)];
    rows.push(row("cylinders", judged, |one| one.cylinder));
    rows.push(row("cuboids", judged, |one| !one.cylinder));
    let most = judged.iter().map(|one| one.objects).max().unwrap_or(0);
    for count in 1..=most {
        let name = if count == 1 { "1 object".to_owned() } else { format!("{count} objects") };
        rows.push(row(&name, judged, |one| one.objects == count));
    }
    // Empty groups need no row.
    rows.retain(|row| row.position.is_some() || row.unmoved.is_some() || row.failed > 0);
    rows
}

fn row(group: &str, judged: &[Judged], member: impl Fn(&Judged) -> bool) -> ErrorRow {
    let (known, unknown): (Vec<&Judged>, Vec<&Judged>) =
        judged.iter().filter(|one| member(one)).partition(|one| one.error.is_known());
    let over = |moved: bool, value: &dyn Fn(&Judged) -> Option<f64>| {
        let counted = known.iter().filter(|one| one.error.moved() == moved);
        Summary::of(&counted.filter_map(|one| value(one)).collect::<Vec<f64>>())
    };
    ErrorRow {
        group: group.to_owned(),
        position: over(true, &|one| Some(one.error.position)),
        heading_deg: over(true, &|one| one.error.heading_deg()),
        position_3d: over(true, &|one| Some(one.against_3d?.position)),
        heading_3d_deg: over(true, &|one| one.against_3d?.heading_deg()),
        unmoved: over(false, &|one| Some(one.error.position)),
        failed: unknown.len(),
    }
}
