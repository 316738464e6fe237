//! Training task of the belief regulator.

use std::path::PathBuf;

use pushplan::internals::network::{Parameters, Statistics};
use pushplan::internals::progress::Progress;
use pushplan::internals::seeded::generator;
use pushplan_act::regulator::{Regulator, RegulatorCard, RegulatorWeights, fresh_regulator};
use pushplan_bench::store::FolderLock;
use rand::Rng;

use crate::dataset::Lesson;
use crate::network::RegulatorGraph;
use crate::train::{Descent, REPLICAS, TrainError, Trainable, Trainer, gradients_of};

use super::batch::{Examples, Heard};
use super::{RegulatorScore, RegulatorSettings, score};

/// Probability that a lesson is used up to the end of a draft instead of its end, because beliefs
/// are also used at such moments.
const DRAFTS: f64 = 0.4;

/// Trains a regulator in `folder`, see [`Trainer::run`].
///
/// # Errors
/// Returns [`TrainError`]; files saved before are kept.
pub fn train_regulator(
    settings: &RegulatorSettings,
    lessons: &[Lesson],
    held_out: &[Lesson],
    folder: &FolderLock,
    progress: &dyn Progress,
) -> Result<Option<PathBuf>, TrainError> {
    // Lessons without informative windows are skipped.
    let lessons = lessons.iter().filter(|lesson| !lesson.windows.is_empty()).collect();
    Trainer::open(Task { settings, lessons, held_out }, folder)?.run(progress)
}

struct Task<'a> {
    settings: &'a RegulatorSettings,
    lessons: Vec<&'a Lesson>,
    held_out: &'a [Lesson],
}

impl Task<'_> {
    /// Draws the lessons of a step.
    fn drawn(&self, step: u64) -> Vec<Heard<'_>> {
        let mut rng = generator(self.settings.seed, step);
        let mut draw = |_| {
            let lesson = self.lessons[rng.random_range(0..self.lessons.len())];
            let drafts = lesson.drafts.len();
            let draft =
                (drafts > 0 && rng.random_bool(DRAFTS)).then(|| rng.random_range(0..drafts));
            (lesson, lesson.windows(draft))
        };
        (0..self.settings.descent.batch).map(&mut draw).collect()
    }
}

impl Trainable for Task<'_> {
    const KEY: &'static str = "pushplan-regulator-checkpoint";
    type Settings = RegulatorSettings;
    type Scales = Statistics;
    type Score = RegulatorScore;
    type Card = RegulatorCard;

    fn settings(&self) -> RegulatorSettings {
        self.settings.clone()
    }

    fn descent(&self) -> Descent {
        self.settings.descent
    }

    fn is_empty(&self) -> bool {
        self.lessons.is_empty()
    }

    fn scales(&self) -> Statistics {
        let (mut table, mut columns) = (Vec::new(), 1);
        let drafts = self.lessons.iter().flat_map(|lesson| &lesson.drafts);
        let first = drafts.flat_map(|draft| &draft.windows);
        for window in first.chain(self.lessons.iter().flat_map(|lesson| &lesson.windows)) {
            columns = window.features.len() / window.informative.len().max(1);
            let rows = window.features.chunks_exact(columns.max(1)).zip(&window.informative);
            rows.filter(|(_, informative)| **informative)
                .for_each(|(row, _)| table.extend_from_slice(row));
        }
        Statistics::measure(&table, columns, true)
    }

    fn fresh(&self, scales: &Statistics) -> Parameters {
        fresh_regulator(scales.mean.len(), self.settings.width, self.settings.seed)
    }

    fn gradient(
        &self,
        weights: &Parameters,
        scales: &Statistics,
        (step, replica): (u64, usize),
    ) -> candle_core::Result<(f64, Parameters)> {
        let drawn = self.drawn(step);
        let part = &drawn[replica * drawn.len() / REPLICAS..(replica + 1) * drawn.len() / REPLICAS];
        let network = RegulatorGraph::new(scales.mean.len(), self.settings.width, weights)?;
        let loss = Examples::new(part, scales)?.loss(&network)?;
        gradients_of(&loss, network.variables())
    }

    fn score(&self, weights: &RegulatorWeights) -> RegulatorScore {
        score(&Regulator::new(weights), self.held_out)
    }

    fn is_better(score: &RegulatorScore, than: &RegulatorScore) -> bool {
        score.nll[1] < than.nll[1]
    }

    fn card(&self, scales: &Statistics, step: u64, _: Option<&RegulatorScore>) -> RegulatorCard {
        RegulatorCard {
            features: scales.mean.len(),
            width: self.settings.width,
            scales: scales.clone(),
            data_seed: self.settings.data_seed,
            episodes: self.settings.lessons,
            steps: step,
        }
    }
}
