//! Gaussian elimination with pivoting for small dense systems.

/// Solves n equations of n + 1 numbers each, row by row; the last number of equation k becomes the
/// k-th unknown. Returns `true` if all unknowns are finite.
pub(super) fn solve_in_place(matrix: &mut [f64], n: usize) -> bool {
    // Most frames have at most eight; with three objects this saves a twelfth of all instructions.
    match n {
        1 => solve_few::<1>(matrix),
        2 => solve_few::<2>(matrix),
        3 => solve_few::<3>(matrix),
        4 => solve_few::<4>(matrix),
        5 => solve_few::<5>(matrix),
        6 => solve_few::<6>(matrix),
        7 => solve_few::<7>(matrix),
        8 => solve_few::<8>(matrix),
        _ => solve_many(matrix, n),
    }
}

fn solve_few<const N: usize>(lines: &mut [f64]) -> bool {
    let mut matrix = [[0.0; N]; N];
    let mut target = [0.0; N];
    for ((row, target), line) in matrix.iter_mut().zip(&mut target).zip(lines.chunks_exact(N + 1)) {
        row.copy_from_slice(&line[..N]);
        *target = line[N];
    }
    let Some(found) = solve(matrix, target) else { return false };
    for (line, value) in lines.chunks_exact_mut(N + 1).zip(found) {
        line[N] = value;
    }
    true
}

/// Solves `matrix` x = `target`, if all unknowns are finite. The bits equal [`solve_many`]'s, in
/// less time because the size is a constant.
#[inline(always)]
pub(super) fn solve<const N: usize>(
    mut matrix: [[f64; N]; N],
    mut target: [f64; N],
) -> Option<[f64; N]> {
    for k in 0..N {
        let mut pivot = k;
        for row in k + 1..N {
            if matrix[row][k].abs() > matrix[pivot][k].abs() {
                pivot = row;
            }
        }
        if pivot != k {
            matrix.swap(pivot, k);
            target.swap(pivot, k);
        }
        let first = matrix[k];
        let inverse = 1.0 / first[k];
        for row in k + 1..N {
            let share = matrix[row][k] * inverse;
            // Entries before the pivot are not used again.
            for (entry, above) in matrix[row].iter_mut().zip(&first) {
                *entry -= share * above;
            }
            target[row] -= share * target[k];
        }
    }
    let mut found = [0.0; N];
    for k in (0..N).rev() {
        let mut known = 0.0;
        for j in k + 1..N {
            known += matrix[k][j] * found[j];
        }
        found[k] = (target[k] - known) / matrix[k][k];
        if !found[k].is_finite() {
            return None;
        }
    }
    Some(found)
}

fn solve_many(matrix: &mut [f64], n: usize) -> bool {
    let width = n + 1;
    for k in 0..n {
        let size = |row: usize| matrix[row * width + k].abs();
        let pivot = (k + 1..n).fold(k, |best, row| if size(row) > size(best) { row } else { best });
        if pivot != k {
            let (above, below) = matrix.split_at_mut(pivot * width);
            above[k * width + k..(k + 1) * width].swap_with_slice(&mut below[k..width]);
        }
        let (above, below) = matrix.split_at_mut((k + 1) * width);
        let first = &above[k * width + k..];
        let inverse = 1.0 / first[0];
        for line in below.chunks_exact_mut(width) {
            let share = line[k] * inverse;
            if share != 0.0 {
                for (entry, above) in line[k + 1..].iter_mut().zip(&first[1..]) {
                    *entry -= share * above;
                }
            }
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| matrix[k * width + j] * matrix[j * width + n]).sum();
        let value = (matrix[k * width + n] - known) / matrix[k * width + k];
        if !value.is_finite() {
            return false;
        }
        matrix[k * width + n] = value;
    }
    true
}

#[cfg(test)]
mod tests;
