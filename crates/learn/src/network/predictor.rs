//! Physics predictor as a candle graph, for training and as the reference.
//!
//! Propagation networks (Li et al., ICRA 2019, eq. 3-5; Tekden et al., ICRA 2020): relations
//! are encoded as c_k, objects as h_i, and for L steps
//!
//! ```text
//! e_k = f_R(c_k, p_r, p_s)        p_i <- f_O(h_i, sum_k e_k, p_i)
//! ```
//!
//! where p_i starts at h_i and the motion is read from p_i after the last step. f_R is one layer of
//! three matrices, whose p parts are computed per node before gathering. The matrix after its
//! rectifier is merged with the matrix of f_O because it commutes with the sum. B graphs are
//! processed together as N nodes and R relations.

use std::collections::BTreeMap;
use std::sync::Arc;

use candle_core::{Device, Result, Tensor, Var};
use pushplan::internals::network::{
    Config, Normaliser, Parameters, Rows, Statistics, Tables, layout_of,
};

use crate::network::operations::{BiasRectify, Messages};
use crate::network::variables::variables;

/// Batch as normalised tensors.
pub struct Inputs {
    node_even: Tensor,
    node_odd: Tensor,
    given: Option<[Tensor; 2]>,
    relation_even: Tensor,
    relation_odd: Tensor,
    receivers: Arc<[u32]>,
    senders: Arc<[u32]>,
}

impl Inputs {
    /// Normalises the feature tables of a batch.
    ///
    /// # Errors
    /// Returns errors of candle; tables of complete rows cause none.
    pub fn new<'a>(batch: impl Into<Rows<'a>>, normaliser: &Normaliser) -> Result<Self> {
        let rows = batch.into();
        let table = |values: &[f32], scales: &Statistics| {
            let columns = scales.mean.len();
            let shape = (values.len() / columns, columns);
            Tensor::from_vec(scales.apply(values), shape, &Device::Cpu)
        };
        let nodes = rows.node_even.len() / normaliser.node_even.mean.len();
        let mut senders = Vec::new();
        rows.senders_after(nodes, &mut senders);
        let given = match rows.given_even.is_empty() {
            true => None,
            false => Some([
                table(rows.given_even, &normaliser.given_even)?,
                table(rows.given_odd, &normaliser.given_odd)?,
            ]),
        };
        Ok(Self {
            given,
            node_even: table(rows.node_even, &normaliser.node_even)?,
            node_odd: table(rows.node_odd, &normaliser.node_odd)?,
            relation_even: table(rows.relation_even, &normaliser.relation_even)?,
            relation_odd: table(rows.relation_odd, &normaliser.relation_odd)?,
            receivers: rows.receivers.into(),
            senders: senders.into(),
        })
    }
}

/// Network with its variables.
pub struct Predictor {
    config: Config,
    variables: BTreeMap<String, Var>,
}

impl Predictor {
    /// Creates a network for pushes with the given parameters.
    ///
    /// # Errors
    /// Returns errors of [`Predictor::of`].
    pub fn new(config: Config, parameters: &Parameters) -> Result<Self> {
        Self::of(&Tables::PUSHES, config, parameters)
    }

    /// Creates a network on these tables with the given parameters.
    ///
    /// # Errors
    /// Returns an error if a parameter is missing or its shape differs from [`layout_of`].
    pub fn of(tables: &Tables, config: Config, parameters: &Parameters) -> Result<Self> {
        let variables = variables(layout_of(tables, &config), parameters)?;
        Ok(Self { config, variables })
    }

    /// Returns the variables by name.
    pub fn variables(&self) -> &BTreeMap<String, Var> {
        &self.variables
    }

    /// Returns a copy of the current values.
    ///
    /// # Errors
    /// Returns errors of candle.
    pub fn parameters(&self) -> Result<Parameters> {
        let values = self
            .variables
            .iter()
            .map(|(name, var)| Ok((name.clone(), var.flatten_all()?.to_vec1()?)))
            .collect::<Result<_>>()?;
        Ok(Parameters { values })
    }

    /// Returns the outputs of every node, even columns first.
    ///
    /// The outputs for pushes are corrections of the analytic model in output units, [N, 6] in the
    /// order of [`pushplan::internals::graph::Node::prior`].
    ///
    /// # Errors
    /// Returns errors of candle.
    pub fn forward(&self, inputs: &Inputs) -> Result<Tensor> {
        let h = self.object(inputs)?;
        let nodes = h.dims()[1];
        if nodes == 0 {
            return Tensor::zeros((0, 6), candle_core::DType::F32, &Device::Cpu);
        }
        let relation = self.relation(inputs)?.matmul(self.get("message.relation"))?;
        let keep = h.matmul(self.get("update.object"))?;
        let given = self.given(inputs)?;
        let mut p = h;
        for _ in 0..self.config.steps {
            let sent = p.matmul(self.get("message.sender"))?;
            let sent = match &given {
                Some(given) => Tensor::cat(&[&sent, given], 1)?,
                None => sent,
            };
            let sum = relation.apply_op3(
                &p.matmul(self.get("message.receiver"))?,
                &sent,
                Messages { receivers: inputs.receivers.clone(), senders: inputs.senders.clone() },
            )?;
            let own = p.matmul(self.get("update.own"))?;
            let next = ((sum.matmul(self.get("update.effect"))? + &keep)? + own)?;
            p = self.rectify(&next, "update.bias")?;
        }
        let hidden = self.rectify(&p.matmul(self.get("motion.hidden"))?, "motion.hidden_bias")?;
        let even = hidden.get(0)?.matmul(self.get("motion.even"))?;
        let odd = hidden.get(1)?.matmul(self.get("motion.odd"))?;
        Tensor::cat(&[even, odd], 1)
    }

    /// Returns the messages of bodies with prescribed motion, [2, K, h], which are constant over
    /// the steps.
    fn given(&self, inputs: &Inputs) -> Result<Option<Tensor>> {
        let Some([even, odd]) = &inputs.given else { return Ok(None) };
        let row = self.first(even, odd, "given")?;
        row.matmul(self.get("message.sender")).map(Some)
    }

    fn relation(&self, inputs: &Inputs) -> Result<Tensor> {
        let first = self.first(&inputs.relation_even, &inputs.relation_odd, "relation")?;
        self.rectify(&first.matmul(self.get("relation.second"))?, "relation.second_bias")
    }

    fn object(&self, inputs: &Inputs) -> Result<Tensor> {
        let first = self.first(&inputs.node_even, &inputs.node_odd, "object")?;
        self.rectify(&first.matmul(self.get("object.second"))?, "object.second_bias")
    }

    fn first(&self, even: &Tensor, odd: &Tensor, layer: &str) -> Result<Tensor> {
        let even = even.matmul(self.get(&format!("{layer}.even")))?;
        let odd = odd.matmul(self.get(&format!("{layer}.odd")))?;
        self.rectify(&Tensor::stack(&[even, odd], 0)?, &format!("{layer}.bias"))
    }

    fn rectify(&self, x: &Tensor, bias: &str) -> Result<Tensor> {
        x.apply_op2(self.get(bias), BiasRectify)
    }

    /// Returns a variable inserted by the constructor.
    fn get(&self, name: &str) -> &Tensor {
        self.variables[name].as_tensor()
    }
}
