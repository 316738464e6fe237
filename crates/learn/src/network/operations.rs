//! Parity layers as candle operations, with their gradients.

use std::sync::Arc;

use candle_core::{CpuStorage, CustomOp2, CustomOp3, DType, Layout, Result, Shape, Tensor, bail};
use pushplan::internals::network::{Sum, rectify_rows};

/// Operation `rectify(x + bias)` with the bias added to the even half: x [2, M, h], bias [h].
pub(super) struct BiasRectify;

impl CustomOp2 for BiasRectify {
    fn name(&self) -> &'static str {
        "bias-rectify"
    }

    fn cpu_fwd(
        &self,
        x: &CpuStorage,
        x_layout: &Layout,
        bias: &CpuStorage,
        bias_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let (x, bias) = (floats(x, x_layout)?, floats(bias, bias_layout)?);
        let mut y = x.to_vec();
        rectify_rows(&mut y, bias);
        Ok((CpuStorage::F32(y), x_layout.shape().clone()))
    }

    fn bwd(
        &self,
        x: &Tensor,
        bias: &Tensor,
        _: &Tensor,
        gradient: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>)> {
        let of_x = with_floats(x, |x| {
            with_floats(bias, |bias| {
                with_floats(gradient, |g| {
                    let mut of_x = vec![0.0; x.len()];
                    let mut of_bias = vec![0.0; bias.len()];
                    let half = x.len() / 2;
                    let (x_even, x_odd) = x.split_at(half);
                    let (g_even, g_odd) = g.split_at(half);
                    let (d_even, d_odd) = of_x.split_at_mut(half);
                    let h = bias.len();
                    for row in 0..half / h {
                        let at = row * h..(row + 1) * h;
                        let (e, o) = (&x_even[at.clone()], &x_odd[at.clone()]);
                        let (ge, go) = (&g_even[at.clone()], &g_odd[at.clone()]);
                        let (de, d_o) = (&mut d_even[at.clone()], &mut d_odd[at]);
                        for k in 0..h {
                            (de[k], d_o[k]) = rectify_gradient(e[k] + bias[k], o[k], ge[k], go[k]);
                        }
                        for k in 0..h {
                            of_bias[k] += de[k];
                        }
                    }
                    Ok((
                        Tensor::from_vec(of_x, gradient.shape(), gradient.device())?,
                        Tensor::from_vec(of_bias, h, gradient.device())?,
                    ))
                })
            })
        })?;
        Ok((Some(of_x.0), Some(of_x.1)))
    }
}

/// Messages summed at their receivers.
///
/// The message of every relation k from s to r is `rectify(a_k + b_r + c_s)`. Shapes: a [2, R, h],
/// b [2, N, h], c [2, M, h], result [2, N, h]. A sender beyond the last row of c has no term of its
/// own.
pub(super) struct Messages {
    pub receivers: Arc<[u32]>,
    pub senders: Arc<[u32]>,
}

impl CustomOp3 for Messages {
    fn name(&self) -> &'static str {
        "messages"
    }

    fn cpu_fwd(
        &self,
        a: &CpuStorage,
        a_layout: &Layout,
        b: &CpuStorage,
        b_layout: &Layout,
        c: &CpuStorage,
        c_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let (a, b, c) = (floats(a, a_layout)?, floats(b, b_layout)?, floats(c, c_layout)?);
        let h = a_layout.shape().dims()[2];
        let mut sum = vec![0.0; b.len()];
        let (receivers, senders) = (&self.receivers, &self.senders);
        Sum { a, b, c, receivers, senders, h, sum: &mut sum }.run();
        Ok((CpuStorage::F32(sum), b_layout.shape().clone()))
    }

    fn bwd(
        &self,
        a: &Tensor,
        b: &Tensor,
        c: &Tensor,
        _: &Tensor,
        gradient: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>, Option<Tensor>)> {
        let h = a.dims()[2];
        let (of_a, of_b, of_c) = with_floats(a, |av| {
            with_floats(b, |bv| {
                with_floats(c, |cv| with_floats(gradient, |g| Ok(self.gradients(av, bv, cv, g, h))))
            })
        })?;
        Ok((
            Some(Tensor::from_vec(of_a, a.shape(), a.device())?),
            Some(Tensor::from_vec(of_b, b.shape(), b.device())?),
            Some(Tensor::from_vec(of_c, c.shape(), c.device())?),
        ))
    }
}

impl Messages {
    fn gradients(
        &self,
        a: &[f32],
        b: &[f32],
        c: &[f32],
        gradient: &[f32],
        h: usize,
    ) -> (Vec<f32>, Vec<f32>, Vec<f32>) {
        let (relations, nodes, speakers) =
            (a.len() / (2 * h), b.len() / (2 * h), c.len() / (2 * h));
        let mut of_a = vec![0.0; a.len()];
        let mut of_b = vec![0.0; b.len()];
        let mut of_c = vec![0.0; c.len()];
        let zeros = vec![0.0; h];
        let none = &zeros[..];
        for k in 0..relations {
            let (r, s) = (self.receivers[k] as usize, self.senders[k] as usize);
            let row = |parity: usize, index: usize, rows: usize| {
                let start = (parity * rows + index) * h;
                start..start + h
            };
            let sender = |parity| if s < speakers { &c[row(parity, s, speakers)] } else { none };
            let (a_e, a_o) = (&a[row(0, k, relations)], &a[row(1, k, relations)]);
            let (b_e, b_o) = (&b[row(0, r, nodes)], &b[row(1, r, nodes)]);
            let (c_e, c_o) = (sender(0), sender(1));
            let (g_e, g_o) = (&gradient[row(0, r, nodes)], &gradient[row(1, r, nodes)]);
            let (of_even, of_odd) = of_a.split_at_mut(relations * h);
            let (d_e, d_o) =
                (&mut of_even[row(0, k, relations)], &mut of_odd[row(0, k, relations)]);
            for i in 0..h {
                (d_e[i], d_o[i]) = rectify_gradient(
                    a_e[i] + b_e[i] + c_e[i],
                    a_o[i] + b_o[i] + c_o[i],
                    g_e[i],
                    g_o[i],
                );
            }
            for (target, index, rows) in [(&mut of_b, r, nodes), (&mut of_c, s, speakers)] {
                if index < rows {
                    add(&mut target[row(0, index, rows)], d_e);
                    add(&mut target[row(1, index, rows)], d_o);
                }
            }
        }
        (of_a, of_b, of_c)
    }
}

/// Returns the gradients of [`rectify`]'s inputs, given the gradients of its outputs.
#[inline(always)]
fn rectify_gradient(even: f32, odd: f32, of_even: f32, of_odd: f32) -> (f32, f32) {
    let as_is = if even + odd > 0.0 { 0.5 * (of_even + of_odd) } else { 0.0 };
    let mirrored = if even - odd > 0.0 { 0.5 * (of_even - of_odd) } else { 0.0 };
    (as_is + mirrored, as_is - mirrored)
}

fn add(target: &mut [f32], value: &[f32]) {
    for (t, v) in target.iter_mut().zip(value) {
        *t += v;
    }
}

/// Returns the values of a contiguous tensor on the CPU.
///
/// # Errors
/// Returns an error if the tensor is not contiguous `f32` on the CPU.
pub fn floats<'a>(storage: &'a CpuStorage, layout: &Layout) -> Result<&'a [f32]> {
    match (storage, layout.contiguous_offsets()) {
        (CpuStorage::F32(values), Some((start, end))) => Ok(&values[start..end]),
        _ => bail!("expected contiguous f32"),
    }
}

/// Calls `f` with a tensor's values, which are copied only if they are not contiguous.
///
/// # Errors
/// Returns errors of candle and of `f`.
pub fn with_floats<R>(tensor: &Tensor, f: impl FnOnce(&[f32]) -> Result<R>) -> Result<R> {
    let tensor = tensor.to_dtype(DType::F32)?.contiguous()?;
    let (storage, layout) = tensor.storage_and_layout();
    match &*storage {
        candle_core::Storage::Cpu(cpu) => f(floats(cpu, layout)?),
        _ => bail!("the predictor runs on the CPU only"),
    }
}
