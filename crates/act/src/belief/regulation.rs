//! Belief regulator as part of a belief: it receives the filter's windows and their propagation
//! effects.

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

use super::regulator_features::{Draft, EVIDENCE, RegulatorFeatures};

/// Error of creating a regulator.
#[derive(Debug, Error)]
pub enum RegulatorError {
    /// The weights of the regulator are unusable.
    #[error(transparent)]
    Weights(#[from] WeightsError),
    /// The propagation network is unusable.
    #[error(transparent)]
    Network(#[from] ModelError),
    /// The weights were trained on other features.
    #[error("the regulator was trained on {found} features per pair, but this run has {expected}")]
    Features {
        /// Number of features of the weights.
        found: usize,
        /// Number of features of this version.
        expected: usize,
    },
}

/// Belief regulator: a recurrent network on the evidence of every pair and the effects of a frozen
/// propagation network.
///
/// The propagation network shares its weights with the physics predictor (Tekden 2020, section
/// 7.2.3).
#[derive(Clone)]
pub struct BeliefRegulator {
    network: Arc<Network>,
    /// Recurrent cell; `None` only records features for training.
    cell: Option<Arc<Regulator>>,
}

impl BeliefRegulator {
    /// Creates a regulator from a propagation network and regulator weights.
    ///
    /// # Errors
    /// Returns [`RegulatorError::Features`] if the weights are for other features.
    pub fn new(network: Arc<Network>, weights: &RegulatorWeights) -> Result<Self, RegulatorError> {
        let (found, expected) = (weights.card.features, EVIDENCE + network.effect_width());
        if found != expected {
            return Err(RegulatorError::Features { found, expected });
        }
        Ok(Self { network, cell: Some(Arc::new(Regulator::new(weights))) })
    }

    /// Returns the shipped regulator on the shipped propagation network.
    ///
    /// # Errors
    /// Returns [`RegulatorError`] if the library was built with damaged weights files.
    pub fn shipped() -> Result<Self, RegulatorError> {
        Self::on_shipped_network(&Self::shipped_weights()?)
    }

    /// Creates a regulator from these weights and the shipped propagation network.
    ///
    /// # Errors
    /// Returns [`RegulatorError`] if the weights do not fit the network.
    pub fn on_shipped_network(weights: &RegulatorWeights) -> Result<Self, RegulatorError> {
        Self::new(Arc::new(Network::new(EffectModels::weights()?)), weights)
    }

    /// Returns the shipped weights with their card.
    ///
    /// # Errors
    /// Returns an error if the library was built with a damaged weights file.
    pub fn shipped_weights() -> Result<RegulatorWeights, WeightsError> {
        RegulatorWeights::from_bytes(pushplan_models::REGULATOR)
    }

    /// Creates a regulator that only records the features of windows, for training.
    pub fn listening(network: Arc<Network>) -> Self {
        Self { network, cell: None }
    }
}

/// State of a regulator in a belief.
#[derive(Clone)]
pub(super) struct Regulation {
    by: BeliefRegulator,
    memory: Memory,
    /// Probabilities of [`JointType::ALL`] for every pair; `None` if not corrected.
    pub shares: Vec<Option<[f64; 4]>>,
    /// Recorded windows of a listening regulator, and first versions of repeated pushes.
    pub recorded: Vec<RegulatorFeatures>,
    pub drafts: Vec<Draft>,
}

impl Regulation {
    pub fn new(by: BeliefRegulator) -> Self {
        Self {
            by,
            memory: Memory::default(),
            shares: Vec::new(),
            recorded: Vec::new(),
            drafts: Vec::new(),
        }
    }

    /// Keeps what `first` recorded since this state as a draft, because these windows are processed
    /// again. Earlier drafts are kept too.
    pub fn keep(&mut self, first: &Self) {
        self.drafts.clone_from(&first.drafts);
        let after = self.recorded.len();
        let windows = first.recorded[after..].to_vec();
        if !windows.is_empty() {
            self.drafts.push(Draft { after, windows });
        }
    }

    /// Processes a window and corrects the filter's probabilities.
    ///
    /// `evidence` is `None` for pairs without information; `job` is the rollout of the window.
    pub fn take(
        &mut self,
        (scene, job): (&Scene, &Job),
        pairs: &[[usize; 2]],
        evidence: &[Option<[f32; EVIDENCE]>],
        filtered: Vec<[f64; 4]>,
    ) {
        let informative: Vec<bool> = evidence.iter().map(Option::is_some).collect();
        if !informative.contains(&true) {
            return;
        }
        let effects = self.by.network.effects(scene, job, pairs);
        let mut features = Vec::new();
        for (evidence, effects) in evidence.iter().zip(effects) {
            features.extend(evidence.unwrap_or([0.0; EVIDENCE]));
            features.extend(effects.iter().map(|x| if evidence.is_some() { *x } else { 0.0 }));
        }
        let Some(cell) = &self.by.cell else {
            self.recorded.push(RegulatorFeatures { features, informative, filtered });
            return;
        };
        let objects = scene.objects.len();
        let corrections = cell.step(&features, &informative, (pairs, objects), &mut self.memory);
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
