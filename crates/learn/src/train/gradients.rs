//! Gradients of a loss by all variables.

use std::collections::BTreeMap;

use candle_core::{Result, Tensor, Var};
use pushplan::internals::network::Parameters;

/// Returns the value of a scalar `loss` and its gradient by `variables`, zero for variables without
/// influence.
pub fn gradients_of(loss: &Tensor, variables: &BTreeMap<String, Var>) -> Result<(f64, Parameters)> {
    let store = loss.backward()?;
    let mut gradients = Parameters::default();
    for (name, variable) in variables {
        let values = match store.get(variable) {
            Some(gradient) => gradient.flatten_all()?.to_vec1()?,
            None => vec![0.0; variable.elem_count()],
        };
        gradients.values.insert(name.clone(), values);
    }
    Ok((f64::from(loss.to_scalar::<f32>()?), gradients))
}
