//! Belief regulator as a candle graph, unrolled over the windows of episodes for training.

use std::collections::BTreeMap;

use candle_core::{DType, Device, Result, Tensor, Var};
use pushplan::internals::network::Parameters;
use pushplan_act::regulator::{TYPES, regulator_layout};

use crate::network::variables::variables;

/// Batch of the pairs of several episodes, window by window.
pub struct Unrolled {
    /// T tensors [P, F] of normalised features.
    pub features: Vec<Tensor>,
    /// T tensors [P, 1]: 1 if the window is informative about the pair, otherwise 0.
    pub informative: Vec<Tensor>,
    /// Indices `[P]` of the two objects of every pair, numbered over all episodes.
    pub ends: [Tensor; 2],
    /// Total number of objects of all episodes.
    pub objects: usize,
}

/// Regulator with its variables.
pub struct RegulatorGraph {
    width: usize,
    variables: BTreeMap<String, Var>,
}

impl RegulatorGraph {
    /// Creates a regulator of F `features` and hidden `width` with the given parameters.
    ///
    /// # Errors
    /// Returns an error if a parameter is missing or its shape differs from [`regulator_layout`].
    pub fn new(features: usize, width: usize, parameters: &Parameters) -> Result<Self> {
        let variables = variables(regulator_layout(features, width), parameters)?;
        Ok(Self { width, variables })
    }

    /// Returns the variables by name.
    pub fn variables(&self) -> &BTreeMap<String, Var> {
        &self.variables
    }

    /// Returns the outputs [P, 5] after every window and the sum of squared changes of hidden
    /// states.
    ///
    /// Outputs are the logits, then the trust before its sigmoid.
    ///
    /// # Errors
    /// Returns errors of candle.
    pub fn forward(&self, of: &Unrolled) -> Result<(Vec<Tensor>, Tensor)> {
        let pairs = of.ends[0].dims1()?;
        let h = self.width;
        let mut hidden = Tensor::zeros((pairs, h), DType::F32, &Device::Cpu)?;
        let mut changes = Tensor::zeros((), DType::F32, &Device::Cpu)?;
        let mut all = Vec::new();
        for (features, informative) in of.features.iter().zip(&of.informative) {
            let message = messages(&hidden, of)?;
            let given = features
                .matmul(self.get("gates.input"))?
                .add(&message.matmul(self.get("gates.message"))?)?
                .broadcast_add(self.get("gates.bias"))?;
            let held = hidden.matmul(self.get("gates.hidden"))?;
            let part = |table: &Tensor, k: usize| table.narrow(1, k * h, h);
            let reset = sigmoid(&(part(&given, 0)? + part(&held, 0)?)?)?;
            let update = sigmoid(&(part(&given, 1)? + part(&held, 1)?)?)?;
            let old = part(&held, 2)?.broadcast_add(self.get("gates.candidate_bias"))?;
            let candidate = (part(&given, 2)? + (reset * old)?)?.tanh()?;
            // h' - h = (1 - z) (c - h)
            let change = ((1.0 - update)? * (candidate - &hidden)?)?.broadcast_mul(informative)?;
            changes = (changes + change.sqr()?.sum_all()?)?;
            hidden = (hidden + change)?;
            let first = hidden
                .matmul(self.get("head.hidden"))?
                .add(&messages(&hidden, of)?.matmul(self.get("head.message"))?)?
                .broadcast_add(self.get("head.bias"))?
                .relu()?;
            all.push(
                first
                    .matmul(self.get("head.logits"))?
                    .broadcast_add(self.get("head.logits_bias"))?,
            );
        }
        Ok((all, changes))
    }

    /// Returns the logarithms [P, 4] of the filter's probabilities, corrected by `outputs` [P, 5].
    ///
    /// A common constant is omitted. `Correction::of_filtered` computes the normalised
    /// probabilities.
    ///
    /// # Errors
    /// Returns errors of candle.
    pub fn corrected(outputs: &Tensor, filtered: &Tensor) -> Result<Tensor> {
        let trust = (sigmoid(&outputs.narrow(1, TYPES, 1)?)? * 2.0)?;
        outputs.narrow(1, 0, TYPES)? + filtered.broadcast_mul(&trust)?
    }

    /// Returns a variable inserted by the constructor.
    fn get(&self, name: &str) -> &Tensor {
        self.variables[name].as_tensor()
    }
}

fn messages(hidden: &Tensor, of: &Unrolled) -> Result<Tensor> {
    let (_, h) = hidden.dims2()?;
    let [a, b] = &of.ends;
    let sums = Tensor::zeros((of.objects, h), DType::F32, &Device::Cpu)?
        .index_add(a, hidden, 0)?
        .index_add(b, hidden, 0)?;
    sums.index_select(a, 0)? + sums.index_select(b, 0)? - (hidden * 2.0)?
}

fn sigmoid(x: &Tensor) -> Result<Tensor> {
    ((x * 0.5)?.tanh()? * 0.5)? + 0.5
}
