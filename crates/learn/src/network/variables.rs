//! Parameters as variables of a candle graph.

use std::collections::BTreeMap;

use candle_core::{Device, Result, Tensor, Var, bail};
use pushplan::internals::network::{Layout, Parameters};

/// Creates a variable for every parameter of a layout, by name.
///
/// # Errors
/// Returns an error if a parameter is missing or its shape differs from the layout.
pub fn variables(layout: Layout, parameters: &Parameters) -> Result<BTreeMap<String, Var>> {
    let variable = |(name, shape): (&str, Vec<usize>)| {
        let Some(values) = parameters.values.get(name) else {
            bail!("the parameter {name} is missing")
        };
        let tensor = Tensor::from_slice(values, shape.as_slice(), &Device::Cpu)?;
        Ok((name.to_owned(), Var::from_tensor(&tensor)?))
    };
    layout.into_iter().map(variable).collect()
}
