//! The belief regulator beside the filter: the same windows, and what propagation says of them.

use std::fmt;
use std::sync::Arc;

use thiserror::Error;

use pushplan::{
    effect::{EffectModels, ModelError, Network},
    network::WeightsError,
    scene::Scene,
    task::Job,
};

use crate::regulator::{Memory, Regulator, RegulatorWeights};

use super::testimony::{Draft, EVIDENCE, Testimony};

/// Why a regulator cannot be made.
#[derive(Debug, Error)]
pub enum RegulatorError {
    /// Its weights cannot be used.
    #[error(transparent)]
    Weights(#[from] WeightsError),
    /// The propagation network cannot be used.
    #[error(transparent)]
    Network(#[from] ModelError),
    /// They were trained on other features.
    #[error("the regulator was trained on {found} features of a pair, here there are {expected}")]
    Features {
        /// Those of the weights.
        found: usize,
        /// Those of this version.
        expected: usize,
    },
}

/// The belief regulator: a recurrent network on the evidence of every pair and on the effects of a
/// frozen propagation network, whose weights it shares with the physics predictor (thesis 7.2.3).
#[derive(Clone)]
pub struct BeliefRegulator {
    network: Arc<Network>,
    /// `None` only listens, to make training data.
    cell: Option<Arc<Regulator>>,
}

impl BeliefRegulator {
    /// Of this propagation network and these weights.
    ///
    /// # Errors
    /// [`RegulatorError::Features`] if the weights are for other features.
    pub fn new(network: Arc<Network>, weights: &RegulatorWeights) -> Result<Self, RegulatorError> {
        let (found, expected) = (weights.card.features, EVIDENCE + network.effect_width());
        if found != expected {
            return Err(RegulatorError::Features { found, expected });
        }
        Ok(Self { network, cell: Some(Arc::new(Regulator::new(weights))) })
    }

    /// The shipped one, on the shipped propagation network.
    ///
    /// # Errors
    /// [`RegulatorError`] if the library was built around damaged weights files.
    pub fn shipped() -> Result<Self, RegulatorError> {
        Self::on_shipped_network(&Self::shipped_weights()?)
    }

    /// These weights on the shipped propagation network.
    ///
    /// # Errors
    /// [`RegulatorError`] if they do not fit it.
    pub fn on_shipped_network(weights: &RegulatorWeights) -> Result<Self, RegulatorError> {
        Self::new(Arc::new(Network::new(EffectModels::weights()?)), weights)
    }

    /// The shipped weights with their card.
    ///
    /// # Errors
    /// If the library was built around a damaged weights file.
    pub fn shipped_weights() -> Result<RegulatorWeights, WeightsError> {
        RegulatorWeights::from_bytes(pushplan_models::REGULATOR)
    }

    /// One that leaves the belief alone and only keeps what windows tell, for training.
    pub fn listening(network: Arc<Network>) -> Self {
        Self { network, cell: None }
    }
}

/// A regulator at work in a belief.
#[derive(Clone)]
pub(super) struct Regulation {
    by: BeliefRegulator,
    memory: Memory,
    /// Of every pair the probabilities of [`JointType::ALL`]; `None` of what it did not tell of.
    pub shares: Vec<Option<[f64; 4]>>,
    /// What windows told, if it only listens; and of pushes that were taken again, the first time.
    pub heard: Vec<Testimony>,
    pub drafts: Vec<Draft>,
}

impl Regulation {
    pub fn new(by: BeliefRegulator) -> Self {
        Self {
            by,
            memory: Memory::default(),
            shares: Vec::new(),
            heard: Vec::new(),
            drafts: Vec::new(),
        }
    }

    /// Keeps what `first` heard since this one, where all of that is taken again from here on, and what it
    /// had kept when the same push was taken again before.
    pub fn keep(&mut self, first: &Self) {
        self.drafts.clone_from(&first.drafts);
        let after = self.heard.len();
        let windows = first.heard[after..].to_vec();
        if !windows.is_empty() {
            self.drafts.push(Draft { after, windows });
        }
    }

    /// Takes a window: the evidence of every pair of which anything was told, the `job` that was played,
    /// and the filter's probabilities, which are corrected.
    pub fn take(
        &mut self,
        (scene, job): (&Scene, &Job),
        pairs: &[[usize; 2]],
        evidence: &[Option<[f32; EVIDENCE]>],
        filtered: Vec<[f64; 4]>,
    ) {
        let told: Vec<bool> = evidence.iter().map(Option::is_some).collect();
        if !told.contains(&true) {
            return;
        }
        let effects = self.by.network.effects(scene, job, pairs);
        let mut features = Vec::new();
        for (evidence, effects) in evidence.iter().zip(effects) {
            features.extend(evidence.unwrap_or([0.0; EVIDENCE]));
            features.extend(effects.iter().map(|x| if evidence.is_some() { *x } else { 0.0 }));
        }
        let Some(cell) = &self.by.cell else {
            self.heard.push(Testimony { features, told, filtered });
            return;
        };
        let objects = scene.objects.len();
        let corrections = cell.step(&features, &told, (pairs, objects), &mut self.memory);
        self.shares.resize(pairs.len(), None);
        for ((shares, correction), filtered) in
            self.shares.iter_mut().zip(corrections).zip(&filtered)
        {
            if let Some(correction) = correction {
                *shares = Some(correction.of_filtered(filtered));
            }
        }
    }
}

impl fmt::Debug for Regulation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Regulation").field("memory", &self.memory).finish_non_exhaustive()
    }
}
