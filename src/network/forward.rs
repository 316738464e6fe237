//! Fused inference: the predictor on preallocated buffers, with direct calls of `gemm` kernels.
//!
//! The results equal the results of the graph that training differentiates, which a test checks. No
//! tensors are used and, except for single rows, no memory is allocated. The normaliser is folded
//! into the first layers. Rows are stored [2, M, h], parity first, so every half is one dense
//! matrix.

use crate::graph::{Batch, Correction, Corrections, GIVEN, OUTPUT_EVEN, OUTPUT_ODD};

use super::{
    Config, Doubt, Head, Normaliser, Parameters, PredictorWeights, Rows, Statistics,
    parity::{Sum, rectify, rectify_rows},
    product::{dense, multiply, product, product_into},
};

/// Immutable weights in the layout of the fused pass; shared between threads.
#[derive(Clone, Debug)]
pub struct Forward {
    half: usize,
    steps: usize,
    relation: Encoder,
    object: Encoder,
    given: Option<Layer>,
    message_relation: Vec<f32>,
    message_receiver: Vec<f32>,
    message_sender: Vec<f32>,
    update_effect: Vec<f32>,
    update_object: Vec<f32>,
    update_own: Vec<f32>,
    update_bias: Vec<f32>,
    motion_hidden: Vec<f32>,
    motion_hidden_bias: Vec<f32>,
    motion_even: Vec<f32>,
    motion_odd: Vec<f32>,
    /// Factor on the rows that heads and the estimate of errors read.
    row_scale: f32,
    doubt: Option<Doubt>,
    head: Option<Head>,
}

/// A layer from features to a hidden row, with the normaliser folded in.
#[derive(Clone, Debug)]
struct Layer {
    even: Vec<f32>,
    odd: Vec<f32>,
    bias: Vec<f32>,
}

#[derive(Clone, Debug)]
struct Encoder {
    first: Layer,
    second: Vec<f32>,
    second_bias: Vec<f32>,
}

/// Buffers of one thread; they grow to the largest batch seen and are then reused.
#[derive(Clone, Debug, Default)]
pub struct Buffers {
    relations: Vec<f32>,
    messages: Vec<f32>,
    objects: Vec<f32>,
    given: Vec<f32>,
    senders: Vec<u32>,
    keep: Vec<f32>,
    state: Vec<f32>,
    next: Vec<f32>,
    to_receiver: Vec<f32>,
    to_sender: Vec<f32>,
    sum: Vec<f32>,
    even: Vec<f32>,
    odd: Vec<f32>,
}

impl Buffers {
    /// Returns the propagated states of the nodes in the last [`Forward::read`], [2, N, h], scaled
    /// to a mean square of one over training data.
    pub fn rows(&self) -> &[f32] {
        &self.state
    }
}

impl Forward {
    /// Converts the weights into the layout of the fused pass.
    pub fn new(weights: &PredictorWeights) -> Self {
        let card = &weights.card;
        let whole = Self::of(&card.config, &card.normaliser, &weights.parameters);
        Self { doubt: card.doubt.clone(), row_scale: card.row_scale, ..whole }
    }

    /// Converts parameters in the layout of [`super::layout_of`].
    ///
    /// # Panics
    /// Panics if a parameter is missing.
    pub fn of(config: &Config, normaliser: &Normaliser, parameters: &Parameters) -> Self {
        let get = |name: &str| parameters.values[name].clone();
        let layer = |name: &str, even: &Statistics, odd: &Statistics| {
            let mut bias = get(&format!("{name}.bias"));
            Layer {
                even: fold(get(&format!("{name}.even")), even, &mut bias),
                odd: fold(get(&format!("{name}.odd")), odd, &mut []),
                bias,
            }
        };
        let encoder = |name: &str, even: &Statistics, odd: &Statistics| Encoder {
            first: layer(name, even, odd),
            second: get(&format!("{name}.second")),
            second_bias: get(&format!("{name}.second_bias")),
        };
        let Normaliser { given_even, given_odd, .. } = normaliser;
        let has_given = !given_even.mean.is_empty();
        Self {
            half: config.half(),
            steps: config.steps,
            relation: encoder("relation", &normaliser.relation_even, &normaliser.relation_odd),
            object: encoder("object", &normaliser.node_even, &normaliser.node_odd),
            given: has_given.then(|| layer("given", given_even, given_odd)),
            message_relation: get("message.relation"),
            message_receiver: get("message.receiver"),
            message_sender: get("message.sender"),
            update_effect: get("update.effect"),
            update_object: get("update.object"),
            update_own: get("update.own"),
            update_bias: get("update.bias"),
            motion_hidden: get("motion.hidden"),
            motion_hidden_bias: get("motion.hidden_bias"),
            motion_even: get("motion.even"),
            motion_odd: get("motion.odd"),
            row_scale: 1.0,
            doubt: None,
            head: None,
        }
    }

    /// Returns the width of the even half of a row.
    pub fn half(&self) -> usize {
        self.half
    }

    /// Adds to `into` the even half `[h]` of the effect of relation `k` in the last propagation
    /// step of the last [`Forward::run`], which must have used this batch.
    pub fn add_effect(&self, batch: &Batch, w: &Buffers, k: usize, into: &mut [f32]) {
        let (n, r, h) = (batch.node_count(), batch.relation_count(), self.half);
        let (receiver, sender) = (batch.receivers[k] as usize, w.senders[k] as usize);
        let speakers = w.to_sender.len() / (2 * h);
        let row = |table: &[f32], rows: usize, row: usize, parity: usize, i: usize| {
            table[(parity * rows + row) * h + i]
        };
        for (i, value) in into.iter_mut().enumerate() {
            let part = |parity: usize| {
                let sent = match sender < speakers {
                    true => row(&w.to_sender, speakers, sender, parity, i),
                    false => 0.0,
                };
                row(&w.messages, r, k, parity, i)
                    + row(&w.to_receiver, n, receiver, parity, i)
                    + sent
            };
            *value += rectify(part(0), part(1)).0;
        }
    }

    /// Replaces the number of propagation steps of the training, for ablations.
    pub fn with_steps(self, steps: usize) -> Self {
        Self { steps, ..self }
    }

    /// Adds `head` to the corrections; a head that changes nothing leaves every bit.
    ///
    /// # Panics
    /// Panics if the head has another width.
    pub fn with_head(self, head: &Head) -> Self {
        assert_eq!(head.half(), self.half, "a head of another width");
        Self { head: (!head.is_none()).then(|| head.clone()), ..self }
    }

    /// Returns the floating-point operations of the matrix products in one [`Forward::run`],
    /// counting multiplications and additions separately.
    pub fn operations(&self, batch: &Batch) -> u64 {
        let (nodes, relations, h) = (batch.node_count(), batch.relation_count(), self.half);
        let square = 2 * h * h;
        let per_relation = self.relation.first.len() + 2 * square;
        let given = batch.given_count();
        let per_given = self.given.as_ref().map_or(0, Layer::len) + square;
        let per_step = if objects_send(&batch.senders) { 4 } else { 3 } * square;
        let read = self.motion_even.len() + self.motion_odd.len();
        let per_node = self.object.first.len() + read + 3 * square + self.steps * per_step;
        2 * (per_relation * relations + per_given * given + per_node * nodes) as u64
    }

    /// Fills `corrections` with the correction of every node, `[N]`.
    pub fn run(&self, batch: &Batch, w: &mut Buffers, corrections: &mut Corrections) {
        let Corrections { nodes, apart } = corrections;
        nodes.clear();
        let (even, odd) = self.read(batch, w);
        let rows = even.chunks_exact(OUTPUT_EVEN).zip(odd.chunks_exact(OUTPUT_ODD));
        nodes.extend(rows.map(|(even, odd)| Correction {
            readouts: std::array::from_fn(|k| bounded([even[k], odd[2 * k], odd[2 * k + 1]])),
            ..Correction::default()
        }));
        if let Some(head) = &self.head {
            head.add(w.rows(), nodes);
        }
        if let Some(doubt) = &self.doubt {
            *apart = doubt.apart.map(f64::from);
            // The even half of the rows, [N, h].
            let rows = w.rows().chunks_exact(self.half);
            for (correction, row) in nodes.iter_mut().zip(rows) {
                correction.doubt = Some(doubt.of_frame(row));
            }
        }
    }

    /// Returns the network's estimator of its own error, if it has one.
    pub fn doubts(&self) -> Option<&Doubt> {
        self.doubt.as_ref()
    }

    /// Returns the outputs of every node, [N, even] and [N, odd].
    pub fn read<'a, 'w>(
        &self,
        batch: impl Into<Rows<'a>>,
        w: &'w mut Buffers,
    ) -> (&'w [f32], &'w [f32]) {
        let batch = batch.into();
        let (h, r) = (self.half, batch.receivers.len());
        let n = batch.node_even.len() * h / self.object.first.even.len();
        w.even.clear();
        w.odd.clear();
        if n == 0 {
            w.state.clear();
            return (&w.even, &w.odd);
        }
        self.relation.run(
            (batch.relation_even, batch.relation_odd),
            (r, h),
            &mut w.messages,
            &mut w.relations,
        );
        product(&w.relations, &self.message_relation, r, h, &mut w.messages, false);
        self.object.run((batch.node_even, batch.node_odd), (n, h), &mut w.next, &mut w.objects);
        product(&w.objects, &self.update_object, n, h, &mut w.keep, false);
        w.state.clone_from(&w.objects);
        // With a single object per graph only bodies with prescribed motion send messages.
        let objects_send = objects_send(batch.senders);
        // Their messages are constant over the steps and follow the nodes.
        let m = n + self.given(&batch, w);
        batch.senders_after(n, &mut w.senders);
        for _ in 0..self.steps {
            product(&w.state, &self.message_receiver, n, h, &mut w.to_receiver, false);
            if objects_send {
                let (even, odd) = w.to_sender.split_at_mut(m * h);
                let into = [&mut even[..n * h], &mut odd[..n * h]];
                product_into(&w.state, &self.message_sender, n, h, into, false);
            }
            w.sum.clear();
            w.sum.resize(2 * n * h, 0.0);
            let messages = Sum {
                a: &w.messages,
                b: &w.to_receiver,
                c: &w.to_sender,
                receivers: batch.receivers,
                senders: &w.senders,
                h,
                sum: &mut w.sum,
            };
            messages.run();
            w.next.clone_from(&w.keep);
            product(&w.sum, &self.update_effect, n, h, &mut w.next, true);
            product(&w.state, &self.update_own, n, h, &mut w.next, true);
            rectify_rows(&mut w.next, &self.update_bias);
            std::mem::swap(&mut w.state, &mut w.next);
        }
        product(&w.state, &self.motion_hidden, n, h, &mut w.next, false);
        rectify_rows(&mut w.next, &self.motion_hidden_bias);
        let (even, odd) = w.next.split_at(n * h);
        dense(even, &self.motion_even, n, h, self.motion_even.len() / h, &mut w.even, false);
        dense(odd, &self.motion_odd, n, h, self.motion_odd.len() / h, &mut w.odd, false);
        w.state.iter_mut().for_each(|value| *value *= self.row_scale);
        (&w.even, &w.odd)
    }
}

impl Forward {
    /// Clears `to_sender`, writes the terms of bodies with prescribed motion behind the nodes'
    /// rows, and returns the number of these bodies.
    fn given(&self, batch: &Rows<'_>, w: &mut Buffers) -> usize {
        let h = self.half;
        let n = batch.node_even.len() * h / self.object.first.even.len();
        let k =
            self.given.as_ref().map_or(0, |layer| batch.given_even.len() * h / layer.even.len());
        let m = n + k;
        w.to_sender.clear();
        w.to_sender.resize(2 * m * h, 0.0);
        if let Some(layer) = self.given.as_ref().filter(|_| k > 0) {
            layer.run((batch.given_even, batch.given_odd), (k, h), &mut w.given);
            let (even, odd) = w.to_sender.split_at_mut(m * h);
            let into = [&mut even[n * h..], &mut odd[n * h..]];
            product_into(&w.given, &self.message_sender, k, h, into, false);
        }
        k
    }
}

/// Largest change of a motion, relative to its length.
pub const MOST_CHANGE: f64 = 0.5;

/// Returns a readout with displacement and rotation below [`MOST_CHANGE`], v / sqrt(1 + (v / m)^2).
fn bounded(readout: [f32; 3]) -> [f64; 3] {
    let [x, y, turn] = readout.map(f64::from);
    let share = |square: f64| (1.0 + square / (MOST_CHANGE * MOST_CHANGE)).sqrt().recip();
    let shift = share(x * x + y * y);
    [x * shift, y * shift, turn * share(turn * turn)]
}

/// Returns `true` if the sender of any relation is an object, not a body with prescribed motion.
fn objects_send(senders: &[u32]) -> bool {
    senders.iter().any(|&sender| sender < GIVEN)
}

impl Layer {
    /// Returns the number of matrix elements.
    fn len(&self) -> usize {
        self.even.len() + self.odd.len()
    }

    /// Maps features [M, even] and [M, odd] to `out` [2, M, h].
    fn run(&self, (even, odd): (&[f32], &[f32]), (rows, h): (usize, usize), out: &mut Vec<f32>) {
        out.resize(2 * rows * h, 0.0);
        let (to_even, to_odd) = out.split_at_mut(rows * h);
        multiply(even, &self.even, rows, self.even.len() / h, h, to_even, false);
        multiply(odd, &self.odd, rows, self.odd.len() / h, h, to_odd, false);
        rectify_rows(out, &self.bias);
    }
}

impl Encoder {
    /// Maps features [M, even] and [M, odd] through two layers to `out` [2, M, h]; overwrites
    /// `scratch`.
    fn run(
        &self,
        features: (&[f32], &[f32]),
        (rows, h): (usize, usize),
        scratch: &mut Vec<f32>,
        out: &mut Vec<f32>,
    ) {
        self.first.run(features, (rows, h), scratch);
        product(scratch, &self.second, rows, h, out, false);
        rectify_rows(out, &self.second_bias);
    }
}

/// Folds (x - mean) / deviation into a first layer's matrix [in, out] and its bias.
fn fold(mut matrix: Vec<f32>, statistics: &Statistics, bias: &mut [f32]) -> Vec<f32> {
    let columns = matrix.len() / statistics.mean.len();
    for (row, (mean, deviation)) in
        matrix.chunks_exact_mut(columns).zip(statistics.mean.iter().zip(&statistics.deviation))
    {
        for (k, value) in row.iter_mut().enumerate() {
            *value /= deviation;
            if let Some(bias) = bias.get_mut(k) {
                *bias -= mean * *value;
            }
        }
    }
    matrix
}
