//! Products of dense row-major matrices, by the kernels of `gemm`.

/// Multiplies [2, M, h] by [2, h, h] half by half; adds to `out` if `add`.
pub(super) fn product(
    x: &[f32],
    matrix: &[f32],
    rows: usize,
    h: usize,
    out: &mut Vec<f32>,
    add: bool,
) {
    out.resize(2 * rows * h, 0.0);
    let (even, odd) = out.split_at_mut(rows * h);
    product_into(x, matrix, rows, h, [even, odd], add);
}

/// Multiplies like [`product`], into separate halves, each [M, h].
pub(super) fn product_into(
    x: &[f32],
    matrix: &[f32],
    rows: usize,
    h: usize,
    [out_even, out_odd]: [&mut [f32]; 2],
    add: bool,
) {
    let (x_even, x_odd) = x.split_at(rows * h);
    let (m_even, m_odd) = matrix.split_at(h * h);
    multiply(x_even, m_even, rows, h, h, out_even, add);
    multiply(x_odd, m_odd, rows, h, h, out_odd, add);
}

pub(super) fn dense(
    x: &[f32],
    matrix: &[f32],
    rows: usize,
    inner: usize,
    columns: usize,
    out: &mut Vec<f32>,
    add: bool,
) {
    out.resize(rows * columns, 0.0);
    multiply(x, matrix, rows, inner, columns, out, add);
}

/// Computes `out [m, n] = x [m, k] matrix [k, n]`, all row-major, on one thread: the network's
/// basic operation, public for benchmarks of the machine.
///
/// # Panics
/// Panics if a length does not fit the sizes.
pub fn matrix_product(x: &[f32], matrix: &[f32], m: usize, k: usize, n: usize, out: &mut [f32]) {
    multiply(x, matrix, m, k, n, out, false);
}

/// Computes row-major `out [m, n] (+)= x [m, k] matrix [k, n]` on one thread. The bits of a row do
/// not depend on the other rows.
pub(super) fn multiply(
    x: &[f32],
    matrix: &[f32],
    m: usize,
    k: usize,
    n: usize,
    out: &mut [f32],
    add: bool,
) {
    if m != 1 {
        return multiply_rows(x, matrix, m, k, n, out, add);
    }
    // gemm takes another path for a single row, which rounds differently; a second row avoids it.
    let mut rows = x.to_vec();
    rows.resize(2 * k, 0.0);
    let mut both = out.to_vec();
    both.resize(2 * n, 0.0);
    multiply_rows(&rows, matrix, 2, k, n, &mut both, add);
    out.copy_from_slice(&both[..n]);
}

#[allow(unsafe_code)] // gemm's interface takes pointers
fn multiply_rows(
    x: &[f32],
    matrix: &[f32],
    m: usize,
    k: usize,
    n: usize,
    out: &mut [f32],
    add: bool,
) {
    assert!(x.len() == m * k && matrix.len() == k * n && out.len() == m * n);
    // SAFETY: the three lengths are checked above and the strides belong to dense row-major
    // matrices, so every access lies inside its slice. `out` is borrowed mutably and does not
    // overlap the others.
    unsafe {
        // The kernels need contiguous columns, so the transposed product out' = matrix' x' is
        // computed. Strides are given between columns, then between rows.
        gemm_f32::gemm::f32::get_gemm_fn()(
            n,
            m,
            k,
            out.as_mut_ptr(),
            n as isize,
            1,
            add,
            matrix.as_ptr(),
            n as isize,
            1,
            x.as_ptr(),
            k as isize,
            1,
            1.0,
            1.0,
            false,
            false,
            false,
            gemm_common::Parallelism::None,
        );
    }
}
