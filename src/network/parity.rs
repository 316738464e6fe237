//! Mirror-exact layers: features in an even and an odd half.
//!
//! A hidden row is a function on the two-element group {as is, mirrored}, stored by its even and
//! odd parts e and o. This is a group-equivariant network for the group of one reflection (Cohen
//! and Welling 2016). A linear map that commutes with mirroring acts on e and o separately, at half
//! the cost of a dense one. The rectifier acts on the two values e + o and e - o. Tensors are
//! [2, M, h]: parity, rows, half the width.

use pulp::{Arch, Simd, WithSimd};

/// Rectifies a pair of numbers that is given by its even and odd part.
#[inline(always)]
pub(super) fn rectify(even: f32, odd: f32) -> (f32, f32) {
    let as_is = (even + odd).max(0.0);
    let mirrored = (even - odd).max(0.0);
    (0.5 * (as_is + mirrored), 0.5 * (as_is - mirrored))
}

/// Rectifies the rows of x [2, M, h] after adding `bias`, `h` numbers, to the even half. Both the
/// candle graph and the fused pass use it as their forward pass.
pub fn rectify_rows(x: &mut [f32], bias: &[f32]) {
    Arch::new().dispatch(Rows { x, bias });
}

struct Rows<'a> {
    x: &'a mut [f32],
    bias: &'a [f32],
}

// Uses the widest vectors of the processor, not only those that all processors have, with the same
// bits. A closure would do, but it is not always inlined, and then silently uses the narrowest
// vectors.
impl WithSimd for Rows<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { x, bias } = self;
        let h = bias.len();
        let (even, odd) = x.split_at_mut(x.len() / 2);
        for (e, o) in even.chunks_exact_mut(h).zip(odd.chunks_exact_mut(h)) {
            for k in 0..h {
                (e[k], o[k]) = rectify(e[k] + bias[k], o[k]);
            }
        }
    }
}

/// Messages summed at their receivers: `rectify(a_k + b_r + c_s)` for every relation k from s to r.
///
/// Shapes are a [2, R, h], b and sum [2, N, h], c [2, M, h]; `h` is half the width. A sender past
/// the last row contributes no term of its own. `sum` must be zero on entry. Both the candle graph
/// and the fused pass use it as their forward pass.
pub struct Sum<'a> {
    /// Term of each relation, [2, R, h].
    pub a: &'a [f32],
    /// Term of each receiver, [2, N, h].
    pub b: &'a [f32],
    /// Term of each sender, [2, M, h]: nodes, then bodies with prescribed motion.
    pub c: &'a [f32],
    /// Receiver of each relation, `[R]`.
    pub receivers: &'a [u32],
    /// Sender of each relation, `[R]`.
    pub senders: &'a [u32],
    /// Half the width.
    pub h: usize,
    /// Sums at the receivers, [2, N, h].
    pub sum: &'a mut [f32],
}

impl Sum<'_> {
    /// Adds all messages.
    pub fn run(self) {
        Arch::new().dispatch(self);
    }
}

impl WithSimd for Sum<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { a, b, c, receivers, senders, h, sum } = self;
        let (relations, nodes, speakers) = (receivers.len(), b.len() / (2 * h), c.len() / (2 * h));
        let (a_even, a_odd) = a.split_at(relations * h);
        let (b_even, b_odd) = b.split_at(nodes * h);
        let (c_even, c_odd) = c.split_at(speakers * h);
        let (sum_even, sum_odd) = sum.split_at_mut(nodes * h);
        for k in 0..relations {
            let (r, s) = (receivers[k] as usize * h, senders[k] as usize);
            let (ae, ao) = (&a_even[k * h..][..h], &a_odd[k * h..][..h]);
            let (be, bo) = (&b_even[r..][..h], &b_odd[r..][..h]);
            let (se, so) = (&mut sum_even[r..][..h], &mut sum_odd[r..][..h]);
            if s < speakers {
                let (ce, co) = (&c_even[s * h..][..h], &c_odd[s * h..][..h]);
                for i in 0..h {
                    let (e, o) = rectify(ae[i] + be[i] + ce[i], ao[i] + bo[i] + co[i]);
                    se[i] += e;
                    so[i] += o;
                }
            } else {
                for i in 0..h {
                    let (e, o) = rectify(ae[i] + be[i], ao[i] + bo[i]);
                    se[i] += e;
                    so[i] += o;
                }
            }
        }
    }
}
