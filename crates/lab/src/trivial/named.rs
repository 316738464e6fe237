//! Trivial models by name.

use std::sync::Arc;

use pushplan::internals::effect::{Assuming, EffectModel, EffectModels, Fallback, ModelError};
use pushplan::internals::scene::{ModelKind, ModelSpec, SpecError};

use super::{Follow, Projection};

impl Follow {
    /// Kind of this model.
    pub const KIND: ModelKind = ModelKind::Custom("follow");
}

impl Projection {
    /// Kind of this model.
    pub const KIND: ModelKind = ModelKind::Custom("projection");
}

/// Parses the name of a model: a library model with its settings, or a trivial one.
///
/// # Errors
/// Returns an error if the text names no model.
pub fn spec(text: &str) -> Result<ModelSpec, SpecError> {
    let trivial = [Projection::KIND, Follow::KIND].map(ModelSpec::of);
    match trivial.into_iter().find(|spec| spec.to_string() == text.trim()) {
        Some(spec) => Ok(spec),
        None => text.parse(),
    }
}

/// Builds the model of `spec`.
///
/// # Errors
/// Returns [`ModelError`] if it needs weights that cannot be used.
pub fn load(spec: &ModelSpec) -> Result<Fallback, ModelError> {
    let part = spec.first();
    let model: Arc<dyn EffectModel> = match &part.kind {
        kind if *kind == Projection::KIND => Arc::new(Projection),
        kind if *kind == Follow::KIND => Arc::new(Follow),
        _ => return EffectModels::build(spec),
    };
    Ok(match part.assumptions.are_none() {
        true => Fallback::new(model),
        false => Fallback::new(Arc::new(Assuming::new(model, part.assumptions))),
    })
}
