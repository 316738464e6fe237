//! The network as a candle graph: what training differentiates.

use std::collections::BTreeMap;

use candle_core::{DType, Device, Result, Tensor, Var, bail};

use crate::network::Parameters;

use super::layout::{LeverSizes, lever_layout};

/// Lever-ups side by side.
pub struct LeverTensors {
    /// Normalised features [B, S].
    pub still: Tensor,
    /// Of every frame normalised features [B, M].
    pub moving: Vec<Tensor>,
}

/// The network with its variables.
pub struct LeverGraph {
    width: usize,
    variables: BTreeMap<String, Var>,
}

impl LeverGraph {
    /// A network of these sizes with the given parameters.
    ///
    /// # Errors
    /// If a parameter is missing or has another shape than [`lever_layout`] says.
    pub fn new(sizes: &LeverSizes, parameters: &Parameters) -> Result<Self> {
        let mut variables = BTreeMap::new();
        for (name, shape) in lever_layout(sizes) {
            let Some(values) = parameters.values.get(name) else {
                bail!("the parameter {name} is missing")
            };
            let tensor = Tensor::from_slice(values, shape.as_slice(), &Device::Cpu)?;
            variables.insert(name.to_owned(), Var::from_tensor(&tensor)?);
        }
        Ok(Self { width: sizes.width, variables })
    }

    /// The variables by name.
    pub fn variables(&self) -> &BTreeMap<String, Var> {
        &self.variables
    }

    /// Poses [B, 9] of every frame, and the ends [B, 13].
    ///
    /// # Errors
    /// Those of candle.
    pub fn forward(&self, of: &LeverTensors) -> Result<(Vec<Tensor>, Tensor)> {
        let (batch, h) = (of.still.dims2()?.0, self.width);
        let told =
            of.still.matmul(self.get("gates.still"))?.broadcast_add(self.get("gates.bias"))?;
        let mut hidden = Tensor::zeros((batch, h), DType::F32, &Device::Cpu)?;
        let mut memory = hidden.clone();
        let mut poses = Vec::with_capacity(of.moving.len());
        for moving in &of.moving {
            let gates = (moving.matmul(self.get("gates.moving"))? + &told)?
                .add(&hidden.matmul(self.get("gates.hidden"))?)?;
            let part = |k: usize| gates.narrow(1, k * h, h);
            let new = (sigmoid(&part(0)?)? * part(2)?.tanh()?)?;
            memory = ((sigmoid(&part(1)?)? * memory)? + new)?;
            hidden = (sigmoid(&part(3)?)? * memory.tanh()?)?;
            poses.push(
                hidden.matmul(self.get("pose.hidden"))?.broadcast_add(self.get("pose.bias"))?,
            );
        }
        let last = hidden
            .matmul(self.get("end.hidden"))?
            .broadcast_add(self.get("end.hidden_bias"))?
            .relu()?;
        let end = last.matmul(self.get("end.told"))?.broadcast_add(self.get("end.told_bias"))?;
        Ok((poses, end))
    }

    /// A variable that the constructor put there.
    fn get(&self, name: &str) -> &Tensor {
        self.variables[name].as_tensor()
    }
}

fn sigmoid(x: &Tensor) -> Result<Tensor> {
    ((x * 0.5)?.tanh()? * 0.5)? + 0.5
}
