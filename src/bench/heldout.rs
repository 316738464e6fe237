//! Errors of effect models on held-out pushes, against both engines.
//!
//! Counted are objects whose true (planar) motion exceeds 1 cm; the others have their own
//! numbers, because predicting that nothing happens is another skill. Evaluating the simulated
//! 3-D model gives the table of how far the two engines differ.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::{
    asset::ToolLibrary,
    dataset::generator,
    effect::{EffectModel, Job, Simulated},
    geometry::{Vector, wrap_angle},
    scene::{Record, State, Warning},
    sim::Simulator,
};

use super::{
    statistics::Summary,
    suite::{Case, Suite, SuiteKind},
};

/// An object moved if its centre ends farther than this from its start, metres.
pub const MOVED: f64 = 0.01;

/// How far the start is shifted to see the planar truth's own spread, metres.
pub const DISTURBANCE: f64 = 1e-4;

/// A suite with its truths.
#[derive(Clone, Debug)]
pub struct HeldOut {
    suite: Suite,
    seed: u64,
    planar: Vec<State>,
    /// Nothing where the 3-D engine's outcome has no planar meaning: an object fell over.
    spatial: Vec<Option<State>>,
}

/// Errors of one model on one suite.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeldOutErrors {
    /// Name of the model.
    pub model: String,
    /// All objects first, then by shape and by number of objects on the table.
    pub rows: Vec<ErrorRow>,
}

/// Errors over one group of objects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorRow {
    /// Which objects.
    pub group: String,
    /// Distance of the predicted from the planar final position, moved objects, metres.
    pub position: Option<Summary>,
    /// Heading error of moved cuboids, degrees.
    pub heading_deg: Option<Summary>,
    /// Distance from the 3-D engine's final position, the same objects, metres.
    pub position_3d: Option<Summary>,
    /// Heading error against the 3-D engine, moved cuboids, degrees.
    pub heading_3d_deg: Option<Summary>,
    /// Distance from the planar final position of objects that did not move, metres.
    pub unmoved: Option<Summary>,
    /// Objects for which the model gave no finite answer; they are in no other number.
    pub failed: usize,
}

/// Errors of several models on one suite, beside the truth's own spread.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeldOutReport {
    /// Which pushes.
    pub suite: SuiteKind,
    /// Seed of the pushes.
    pub seed: u64,
    /// Number of pushes.
    pub pushes: usize,
    /// Pushes in which an object fell over in the 3-D engine; left out against it.
    pub toppled: usize,
    /// True motion of the moved objects, metres.
    pub motion: Option<Summary>,
    /// One entry a model; the planar engine from a disturbed start comes first.
    pub models: Vec<HeldOutErrors>,
}

/// One object of one case, judged.
struct Judged {
    cylinder: bool,
    objects: usize,
    moved: bool,
    position: f64,
    heading: f64,
    position_3d: Option<f64>,
    heading_3d: Option<f64>,
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
                let job = Job::stated(&case.scene, case.motion.clone());
                let run = |simulator: Simulator| simulator.run(&case.scene, &job, Record::Outcome);
                let (planar, spatial) = (run(Simulator::planar()), run(Simulator::spatial()));
                let sound = !spatial.warnings.iter().any(Warning::forbids_success);
                (planar.outcome().clone(), sound.then(|| spatial.outcome().clone()))
            })
            .unzip();
        Self { suite, seed, planar, spatial }
    }

    /// The pushes.
    pub fn suite(&self) -> &Suite {
        &self.suite
    }

    /// Where every push ends by the planar engine, in the order of the cases.
    pub fn planar(&self) -> &[State] {
        &self.planar
    }

    /// Errors of all models and the planar truth's own spread.
    pub fn report(&self, models: &[&dyn EffectModel]) -> HeldOutReport {
        let mut errors = vec![self.spread()];
        errors.extend(models.iter().map(|model| self.evaluate(*model)));
        let motions: Vec<f64> = self
            .suite
            .cases
            .iter()
            .zip(&self.planar)
            .flat_map(|(case, truth)| (0..truth.poses.len()).map(|k| travelled(case, truth, k)))
            .filter(|motion| *motion > MOVED)
            .collect();
        HeldOutReport {
            suite: self.suite.kind,
            seed: self.seed,
            pushes: self.suite.cases.len(),
            toppled: self.spatial.iter().filter(|state| state.is_none()).count(),
            motion: Summary::of(&motions),
            models: errors,
        }
    }

    /// Errors of one model.
    pub fn evaluate(&self, model: &dyn EffectModel) -> HeldOutErrors {
        self.judge(model.name(), model, |case, _| case.scene.start())
    }

    /// The planar engine against itself, every object's start shifted by 0.1 mm in a random
    /// direction: errors that no model can be expected to undercut.
    pub fn spread(&self) -> HeldOutErrors {
        let planar = Simulated::new(Simulator::planar());
        self.judge("planar, start off by 0.1 mm", &planar, |case, index| {
            let mut rng = generator(self.seed ^ 0xD157, index as u64);
            let mut start = case.scene.start();
            for pose in &mut start.poses {
                let angle = rand::Rng::random_range(&mut rng, 0.0..std::f64::consts::TAU);
                pose.position += DISTURBANCE * Vector::new(angle.cos(), angle.sin());
            }
            start
        })
    }

    fn judge(
        &self,
        name: &str,
        model: &dyn EffectModel,
        start: impl Fn(&Case, usize) -> State + Sync,
    ) -> HeldOutErrors {
        let judged: Vec<Judged> = (0..self.suite.cases.len())
            .into_par_iter()
            .flat_map_iter(|index| {
                let case = &self.suite.cases[index];
                let job = Job {
                    start: start(case, index),
                    ..Job::stated(&case.scene, case.motion.clone())
                };
                let rolled = model.rollout(&case.scene, &[job], Record::Outcome);
                let given = rolled.first().filter(|t| !t.warnings.contains(&Warning::Refused));
                self.judge_case(index, given.map(|trajectory| trajectory.outcome()))
            })
            .collect();
        HeldOutErrors { model: name.to_owned(), rows: rows(&judged) }
    }

    fn judge_case(&self, index: usize, predicted: Option<&State>) -> Vec<Judged> {
        let (case, truth) = (&self.suite.cases[index], &self.planar[index]);
        let objects = case.scene.objects.len();
        (0..objects)
            .map(|k| {
                let to = |state: &State| match predicted {
                    Some(predicted) => {
                        let (ours, theirs) = (predicted.poses[k], state.poses[k]);
                        let turned = wrap_angle(ours.heading - theirs.heading).abs().to_degrees();
                        ((ours.position - theirs.position).norm(), turned)
                    }
                    None => (f64::NAN, f64::NAN),
                };
                let (position, heading) = to(truth);
                let against_3d = self.spatial[index].as_ref().map(to);
                Judged {
                    cylinder: case.scene.objects[k].shape.is_cylinder(),
                    objects,
                    moved: travelled(case, truth, k) > MOVED,
                    position,
                    heading,
                    position_3d: against_3d.map(|pair| pair.0),
                    heading_3d: against_3d.map(|pair| pair.1),
                }
            })
            .collect()
    }
}

fn travelled(case: &Case, truth: &State, object: usize) -> f64 {
    (truth.poses[object].position - case.scene.objects[object].pose.position).norm()
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
    // A suite without a group needs no row of nothing.
    rows.retain(|row| row.position.is_some() || row.unmoved.is_some() || row.failed > 0);
    rows
}

fn row(group: &str, judged: &[Judged], member: impl Fn(&Judged) -> bool) -> ErrorRow {
    let (known, unknown): (Vec<&Judged>, Vec<&Judged>) = judged
        .iter()
        .filter(|one| member(one))
        .partition(|one| one.position.is_finite() && one.heading.is_finite());
    let over = |moved: bool, cuboids: bool, value: &dyn Fn(&Judged) -> Option<f64>| {
        let values: Vec<f64> = known
            .iter()
            .filter(|one| one.moved == moved && !(cuboids && one.cylinder))
            .filter_map(|one| value(one))
            .collect();
        Summary::of(&values)
    };
    ErrorRow {
        group: group.to_owned(),
        position: over(true, false, &|one| Some(one.position)),
        heading_deg: over(true, true, &|one| Some(one.heading)),
        position_3d: over(true, false, &|one| one.position_3d),
        heading_3d_deg: over(true, true, &|one| one.heading_3d),
        unmoved: over(false, false, &|one| Some(one.position)),
        failed: unknown.len(),
    }
}
