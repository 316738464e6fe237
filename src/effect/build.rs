//! Construction of a model from its name; the shipped weights, available from any directory.

use std::path::Path;
use std::sync::Arc;

use crate::{
    network::PredictorWeights,
    scene::{Engine, ModelKind, ModelPart, ModelSpec, TableFit},
    sim::Simulator,
};

use super::{
    Assuming, ByMotion, CrowdLimit, EffectModel, Fallback, LeverNetwork, LeverPrior, ModelError,
    Network, Prior, Simulated, Still,
};

/// Factory of effect models.
pub struct EffectModels;

impl EffectModels {
    /// Returns the shipped weights with their card.
    ///
    /// # Errors
    /// Returns [`ModelError::Shipped`] if the library was built with a damaged weights file.
    #[doc(hidden)]
    pub fn weights() -> Result<PredictorWeights, ModelError> {
        PredictorWeights::from_bytes(pushplan_models::BRDPN).map_err(ModelError::Shipped)
    }

    /// Returns the weights of the first part of `spec` that is a network, if there is one.
    ///
    /// # Errors
    /// Returns [`ModelError`] if they cannot be used.
    #[doc(hidden)]
    pub fn weights_of(spec: &ModelSpec) -> Result<Option<PredictorWeights>, ModelError> {
        let file = spec.parts().find_map(|part| match &part.kind {
            ModelKind::Network { weights, .. } => Some(weights.as_deref()),
            _ => None,
        });
        file.map(load).transpose()
    }

    /// Builds the model described by `spec`.
    ///
    /// ```
    /// use pushplan::{EffectModel, models::EffectModels};
    ///
    /// let model = EffectModels::build(&"prior,up-to=2|planar,step=1/120".parse()?)?;
    /// assert_eq!(model.spec().parts().count(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns [`ModelError`] if it needs weights that cannot be used.
    pub fn build(spec: &ModelSpec) -> Result<Fallback, ModelError> {
        Self::fitted(spec, None)
    }

    /// Builds the model described by `spec`, with a table fit for its networks. Other models use
    /// only the statements of a scene, see [`TableFit::state`].
    ///
    /// # Errors
    /// Returns [`ModelError`] if it needs weights that cannot be used, or if the weights of a
    /// network differ from the fit's.
    pub fn fitted(spec: &ModelSpec, fit: Option<&TableFit>) -> Result<Fallback, ModelError> {
        let first = Fallback::new(levering(spec.first(), fit)?);
        spec.others().iter().try_fold(first, |routed, other| Ok(routed.or(part(other, fit)?)))
    }
}

/// Returns a part that also accepts lever-ups: by the lever-up network if the part is a network,
/// otherwise by the analytic model. A weights file of lever-ups contains only these, and pushes
/// then use the analytic model.
fn levering(part: &ModelPart, fit: Option<&TableFit>) -> Result<Arc<dyn EffectModel>, ModelError> {
    let levers: Arc<dyn EffectModel> = match &part.kind {
        ModelKind::Simulated { engine: Engine::Spatial, .. } => return self::part(part, fit),
        ModelKind::Network { weights: Some(file), .. } => {
            if let Ok(levers) = LeverNetwork::load(Path::new(file)) {
                let (prior, levers) = (Arc::new(Prior::default()), Arc::new(levers));
                return Ok(Arc::new(ByMotion::new(prior, levers)));
            }
            Arc::new(LeverPrior::default())
        }
        ModelKind::Network { weights: None, .. } => match LeverNetwork::shipped() {
            Ok(network) => Arc::new(network),
            Err(_) => Arc::new(LeverPrior::default()),
        },
        _ => Arc::new(LeverPrior::default()),
    };
    Ok(Arc::new(ByMotion::new(self::part(part, fit)?, levers)))
}

fn load(file: Option<&str>) -> Result<PredictorWeights, ModelError> {
    let Some(path) = file else { return EffectModels::weights() };
    PredictorWeights::load(Path::new(path))
        .map_err(|error| ModelError::File { path: path.to_owned(), error })
}

fn part(part: &ModelPart, fit: Option<&TableFit>) -> Result<Arc<dyn EffectModel>, ModelError> {
    let ModelPart { kind, assumptions, up_to } = part;
    let model: Arc<dyn EffectModel> = match kind {
        ModelKind::Network { weights: file, steps, stride } => {
            let weights = load(file.as_deref())?;
            let network = Network::with(weights, file.clone(), *steps, *stride);
            Arc::new(match fit {
                Some(fit) => network.fitted(fit)?,
                None => network,
            })
        }
        ModelKind::Prior { stride } => Arc::new(Prior::new(*stride)),
        ModelKind::Simulated { engine, rate } => {
            Arc::new(Simulated::new(Simulator::new(*engine, *rate)))
        }
        ModelKind::Still => Arc::new(Still),
        ModelKind::Custom(name) => return Err(ModelError::Custom(name)),
    };
    let model: Arc<dyn EffectModel> = match assumptions.are_none() {
        true => model,
        false => Arc::new(Assuming::new(model, *assumptions)),
    };
    Ok(match up_to {
        None => model,
        Some(most) => Arc::new(CrowdLimit::new(model, *most)),
    })
}
