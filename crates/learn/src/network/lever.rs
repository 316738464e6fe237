//! Lever-up network as a candle graph for training.

use std::collections::BTreeMap;

use candle_core::{DType, Device, Result, Tensor, Var};
use pushplan::internals::network::{LeverSizes, Parameters, lever_layout};

use crate::network::variables::variables;

/// Batch of lever-ups.
pub struct LeverTensors {
    /// Normalised features [B, S].
    pub still: Tensor,
    /// Normalised features [B, M] of every frame.
    pub moving: Vec<Tensor>,
    /// Previous pose [B, 9] of every frame, if it is an input.
    pub before: Vec<Tensor>,
}

/// Lever-up network with its variables.
pub struct LeverGraph {
    sizes: LeverSizes,
    variables: BTreeMap<String, Var>,
}

impl LeverGraph {
    /// Creates a network of these sizes with the given parameters.
    ///
    /// # Errors
    /// Returns an error if a parameter is missing or its shape differs from [`lever_layout`].
    pub fn new(sizes: &LeverSizes, parameters: &Parameters) -> Result<Self> {
        Ok(Self { sizes: *sizes, variables: variables(lever_layout(sizes), parameters)? })
    }

    /// Returns the variables by name.
    pub fn variables(&self) -> &BTreeMap<String, Var> {
        &self.variables
    }

    /// Returns the poses [B, 9] of every frame and the ends [B, 13].
    ///
    /// `beside` is an optional additional input of the gates, [B, 4 H].
    ///
    /// # Errors
    /// Returns errors of candle.
    pub fn forward(
        &self,
        of: &LeverTensors,
        beside: Option<&Tensor>,
    ) -> Result<(Vec<Tensor>, Tensor)> {
        let (batch, h) = (of.still.dims2()?.0, self.sizes.width);
        let mut constant =
            of.still.matmul(self.get("gates.still"))?.broadcast_add(self.get("gates.bias"))?;
        if let Some(beside) = beside {
            constant = (constant + beside)?;
        }
        let mut hidden = Tensor::zeros((batch, h), DType::F32, &Device::Cpu)?;
        let mut memory = hidden.clone();
        let mut poses = Vec::with_capacity(of.moving.len());
        for (frame, moving) in of.moving.iter().enumerate() {
            let mut gates = (moving.matmul(self.get("gates.moving"))? + &constant)?
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

    /// Returns a variable inserted by the constructor.
    fn get(&self, name: &str) -> &Tensor {
        self.variables[name].as_tensor()
    }
}

fn sigmoid(x: &Tensor) -> Result<Tensor> {
    ((x * 0.5)?.tanh()? * 0.5)? + 0.5
}
