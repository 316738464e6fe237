//! Tests of `elimination`.

use super::*;

/// Pseudo-random numbers.
fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
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
        // Every other time some entries are zero, like for groups that do not touch.
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
