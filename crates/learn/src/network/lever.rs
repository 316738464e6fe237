//! The network as a candle graph: what training differentiates.

use std::collections::BTreeMap;

use candle_core::{DType, Device, Result, Tensor, Var};
use pushplan::internals::network::{LeverSizes, Parameters, lever_layout};

use crate::network::variables::variables;

/// Lever-ups side by side.
pub struct LeverTensors {
    /// Normalised features [B, S].
    pub still: Tensor,
    /// Of every frame normalised features [B, M].
    pub moving: Vec<Tensor>,
    /// Of every frame the pose before it [B, 9], if that is told.
    pub before: Vec<Tensor>,
}

/// The network with its variables.
pub struct LeverGraph {
    sizes: LeverSizes,
    variables: BTreeMap<String, Var>,
}

impl LeverGraph {
    /// A network of these sizes with the given parameters.
    ///
    /// # Errors
    /// If a parameter is missing or has another shape than [`lever_layout`] says.
    pub fn new(sizes: &LeverSizes, parameters: &Parameters) -> Result<Self> {
        Ok(Self { sizes: *sizes, variables: variables(lever_layout(sizes), parameters)? })
    }

    /// The variables by name.
    pub fn variables(&self) -> &BTreeMap<String, Var> {
        &self.variables
    }

    /// Poses [B, 9] of every frame, and the ends [B, 13]. The gates may be told something `beside`
    /// features, [B, 4 H].
    ///
    /// # Errors
    /// Those of candle.
    pub fn forward(
        &self,
        of: &LeverTensors,
        beside: Option<&Tensor>,
    ) -> Result<(Vec<Tensor>, Tensor)> {
        let (batch, h) = (of.still.dims2()?.0, self.sizes.width);
        let mut told =
            of.still.matmul(self.get("gates.still"))?.broadcast_add(self.get("gates.bias"))?;
        if let Some(beside) = beside {
            told = (told + beside)?;
        }
        let mut hidden = Tensor::zeros((batch, h), DType::F32, &Device::Cpu)?;
        let mut memory = hidden.clone();
        let mut poses = Vec::with_capacity(of.moving.len());
        for (frame, moving) in of.moving.iter().enumerate() {
            let mut gates = (moving.matmul(self.get("gates.moving"))? + &told)?
                .add(&hidden.matmul(self.get("gates.hidden"))?)?;
            if let Some(before) = of.before.get(frame) {
                gates = (gates + before.matmul(self.get("gates.pose"))?)?;
            }
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
