//! Eliminated joints against all equations solved at once.

use super::*;

use nalgebra::{DMatrix, DVector, Vector2};

use crate::geometry::{Vector, perpendicular};

use super::super::twist::along;

/// Pseudo-random numbers from -1 to 1.
fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Seven groups: a tree of five in no order, and two single ones. If `held`, a leaf of the tree and
/// one single group are tied to the world.
fn forest(seed: &mut u64, held: bool) -> (Vec<Unknown>, Vec<Tie>) {
    let unknowns = (0..7).map(|_| {
        let root = Matrix3::from_fn(|_, _| noise(seed));
        let size = Vector3::new(100.0, 100.0, 3.0);
        let resistance =
            Matrix3::from_diagonal(&size) * (root * root.transpose() + Matrix3::identity());
        let resistance = resistance * Matrix3::from_diagonal(&size);
        let mut unknown = Unknown::default();
        unknown.inverse = resistance.try_inverse().expect("positive definite");
        unknown.resistance = resistance;
        unknown.free = 1e-3 * Vector3::new(noise(seed), noise(seed), 20.0 * noise(seed));
        unknown
    });
    let unknowns = unknowns.collect();
    let pairs = [(Some(4), 2), (Some(6), 4), (Some(2), 0), (Some(2), 5), (None, 5), (None, 3)];
    let pairs = &pairs[..if held { 6 } else { 4 }];
    let ties = pairs.iter().map(|&(a, b): &(Option<usize>, usize)| {
        let mut rows = || {
            let (sin, cos) = (2.0 * noise(seed)).sin_cos();
            let (normal, arm) =
                (Vector::new(cos, sin), 0.03 * Vector::new(noise(seed), noise(seed)));
            [normal, perpendicular(normal)].map(|direction| along(direction, arm))
        };
        let (to, from) = (rows(), if a.is_some() { rows() } else { Default::default() });
        let target = [1e-3 * noise(seed), 1e-3 * noise(seed)];
        let (a, b) = (a.map(GroupIndex), GroupIndex(b));
        Tie { a, b, to, from, target, force: Vector2::zeros() }
    });
    let ties = ties.collect();
    (unknowns, ties)
}

/// Compares with all equations at once: [A J^T; J 0].
#[test]
fn the_tree_answers_as_all_equations_at_once_do() {
    for (seed, held) in (1..40).map(|k| (k / 2, k % 2 == 1)) {
        let seed = &mut (seed * 7919);
        let (mut unknowns, mut ties) = forest(seed, held);
        let groups = unknowns.len();
        let (wide, all) = (3 * groups, 3 * groups + 2 * ties.len());
        let mut whole = DMatrix::zeros(all, all);
        let mut asked = DVector::zeros(all);
        for (k, unknown) in unknowns.iter().enumerate() {
            whole.fixed_view_mut::<3, 3>(3 * k, 3 * k).copy_from(&unknown.resistance);
            let pull = unknown.resistance * unknown.free;
            asked.fixed_rows_mut::<3>(3 * k).copy_from(&pull);
        }
        for (n, tie) in ties.iter().enumerate() {
            for (row, (to, from)) in tie.to.iter().zip(&tie.from).enumerate() {
                let line = wide + 2 * n + row;
                for (group, side) in [(Some(tie.b), *to), (tie.a, -from)] {
                    let Some(group) = group else { continue };
                    for axis in 0..3 {
                        whole[(line, 3 * group.0 + axis)] = side[axis];
                        whole[(3 * group.0 + axis, line)] = -side[axis];
                    }
                }
                asked[line] = tie.target[row];
            }
        }
        let inverse = whole.clone().try_inverse().expect("independent");
        let mut joints = Eliminated::default();
        joints.hang(groups, &ties);
        joints.prepare(&unknowns, &ties);
        joints.spread(&mut unknowns, &[], &mut ties);
        let answer = &inverse * asked;
        for (k, unknown) in unknowns.iter().enumerate() {
            let off = unknown.twist - answer.fixed_rows::<3>(3 * k);
            assert!(off.amax() < 1e-12, "{k}: {off}");
            let settled = unknown.free + unknown.inverse * unknown.pressed;
            assert!((settled - unknown.twist).amax() < 1e-12);
        }
        for (n, tie) in ties.iter().enumerate() {
            let off = tie.force - answer.fixed_rows::<2>(wide + 2 * n);
            assert!(off.amax() < 1e-9 * tie.force.amax().max(1.0), "{n}: {off}");
        }
        for (one, other) in (0..groups * groups).map(|k| (k / groups, k % groups)) {
            let mut felt = vec![Vector3::zeros(); groups];
            let value = Vector3::new(1.0, -2.0, 0.03);
            joints.feel(GroupIndex(one), &value, &mut felt);
            let block = inverse.fixed_view::<3, 3>(3 * one, 3 * other);
            let off = felt[other] - block.tr_mul(&value);
            assert!(off.amax() < 1e-9 * block.amax().max(1e-6), "{one} {other}: {off}");
        }
    }
}

#[test]
fn joints_that_close_a_loop_are_left_out() {
    let (unknowns, mut ties) = forest(&mut 5, false);
    let mut last = ties[0];
    (last.a, last.b) = (Some(GroupIndex(0)), GroupIndex(6));
    ties.push(last);
    let mut joints = Eliminated::default();
    joints.hang(unknowns.len(), &ties);
    assert_eq!(joints.links.len(), 4);
    assert_eq!(joints.mechanism, [0, 1, 0, 3, 0, 0, 0]);
}
