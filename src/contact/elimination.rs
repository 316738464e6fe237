//! Gaussian elimination with pivots of a few dense equations.

/// Solves n equations of n + 1 numbers each, row by row; the last number of equation k becomes the
/// k-th unknown. Returns whether all of them are finite.
pub(super) fn solve_in_place(matrix: &mut [f64], n: usize) -> bool {
    // Most frames have no more; with three objects these save a twelfth of all instructions.
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

/// The unknowns of `matrix` x = `target`, if all of them are finite: those of [`solve_many`] to the bit, in
/// less time as the compiler knows how many they are.
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
            // What is before the pivot is not looked at again.
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
mod tests {
    use super::*;

    /// Numbers that look random.
    fn noise(seed: &mut u64) -> f64 {
        *seed =
            seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    #[test]
    fn equations_that_need_their_rows_swapped_are_solved() {
        // 2 y = 4; x + y + z = 6; x - z = -2.
        for solve in [solve_in_place, solve_many] {
            let mut matrix = [0.0, 2.0, 0.0, 4.0, 1.0, 1.0, 1.0, 6.0, 1.0, 0.0, -1.0, -2.0];
            assert!(solve(&mut matrix, 3));
            assert_eq!([matrix[3], matrix[7], matrix[11]], [1.0, 2.0, 3.0]);
            let mut none = [1.0, 1.0, 1.0, 1.0, 1.0, 2.0];
            assert!(!solve(&mut none, 2));
        }
    }

    #[test]
    fn equations_whose_number_is_known_are_solved_alike() {
        agree::<0>();
        agree::<1>();
        agree::<2>();
        agree::<3>();
        agree::<4>();
        agree::<7>();
    }

    fn agree<const N: usize>() {
        let mut seed = 5;
        let mut solved = 0;
        for round in 0..100 {
            let mut matrix: Vec<f64> = (0..N * (N + 1)).map(|_| noise(&mut seed)).collect();
            // Every other time some are zero, as where groups do not touch.
            let zeros = if round % 2 == 0 { 0 } else { matrix.len() };
            matrix.iter_mut().skip(1).step_by(5).take(zeros).for_each(|entry| *entry = 0.0);
            let lines = || matrix.chunks_exact(N + 1);
            let rows = std::array::from_fn(|k| {
                std::array::from_fn(|j| lines().nth(k).map_or(0.0, |line| line[j]))
            });
            let target = std::array::from_fn(|k| lines().nth(k).map_or(0.0, |line| line[N]));
            let known = solve::<N>(rows, target);
            let mut any = matrix.clone();
            assert_eq!(solve_many(&mut any, N), known.is_some());
            let Some(known) = known else { continue };
            let any: Vec<f64> = any.chunks_exact(N + 1).map(|line| line[N]).collect();
            assert_eq!(
                known.map(f64::to_bits).to_vec(),
                any.iter().map(|v| v.to_bits()).collect::<Vec<_>>()
            );
            solved += 1;
        }
        assert!(solved >= 50, "{solved} of {N} equations");
    }
}
