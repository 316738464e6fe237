//! The active-set method against the iterative method, and against the contact laws.

use super::*;
use pushplan_kernel::{SolverStats, settings::ROUNDS};

use nalgebra::Matrix3;

use crate::contact::{constraint::Law, iterative::IterativeSolver, twist::along};
use crate::geometry::{Vector, perpendicular};

/// Pseudo-random numbers from -1 to 1.
fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Four bodies of a few centimetres, each touching the next in two points, of which the first is
/// pushed. Two of them are joined if `jointed`.
fn frame(seed: u64, jointed: bool) -> (Vec<Unknown>, Vec<Constraint>, Vec<Tie>) {
    let seed = &mut seed.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let mut unknowns = vec![Unknown::default(); 4];
    for unknown in &mut unknowns {
        let soft = 1.5 + noise(seed);
        let soft = Vector3::new(soft, soft, 900.0 * soft);
        unknown.inverse = Matrix3::from_diagonal(&soft);
        unknown.resistance = Matrix3::from_diagonal(&soft.map(f64::recip));
        unknown.free = 1e-3 * Vector3::new(noise(seed), noise(seed), 10.0 * noise(seed));
    }
    let mut rows = |turn: f64| {
        let (sin, cos) = turn.sin_cos();
        let (normal, arm) = (Vector::new(cos, sin), 0.03 * Vector::new(noise(seed), noise(seed)));
        [normal, perpendicular(normal)].map(|direction| along(direction, arm))
    };
    let law = Law::Contact { friction: 0.3 };
    let mut constraints = Vec::new();
    for k in 0..4 {
        for turn in [0.2 * k as f64, 0.2 * k as f64 + 0.3] {
            let other = (k > 0).then(|| GroupIndex(k - 1));
            let (to, from) = (rows(turn), if k > 0 { rows(turn) } else { Default::default() });
            let target = [if k > 0 { 0.0 } else { 4e-3 }, 0.0];
            constraints.push(Constraint::new((GroupIndex(k), to), (other, from), target, law));
        }
    }
    let (a, b) = (GroupIndex(1), GroupIndex(3));
    let tie = Tie {
        a: Some(a),
        b,
        to: rows(0.0),
        from: rows(0.0),
        target: [0.0; 2],
        force: Vector2::zeros(),
    };
    constraints.iter_mut().for_each(|constraint| constraint.weigh(&unknowns));
    (unknowns, constraints, if jointed { vec![tie] } else { Vec::new() })
}

fn joints(unknowns: &[Unknown], constraints: &mut [Constraint], ties: &[Tie]) -> Eliminated {
    let mut joints = Eliminated::default();
    joints.hang(unknowns.len(), ties);
    joints.prepare(unknowns, ties);
    if !joints.is_empty() {
        constraints.iter_mut().for_each(|c| c.own = joints.own(c));
    }
    joints
}

fn solved(seed: u64, jointed: bool) -> Option<(Vec<Unknown>, Vec<Constraint>)> {
    let (found, unknowns, constraints, tally) = tried(seed, jointed);
    assert!(tally.rounds > 0 && tally.rows > 0);
    found.then_some((unknowns, constraints))
}

fn tried(seed: u64, jointed: bool) -> (bool, Vec<Unknown>, Vec<Constraint>, SolverStats) {
    let (mut unknowns, mut constraints, mut ties) = frame(seed, jointed);
    let (mut active, mut tally) = (ActiveSet::default(), SolverStats::default());
    let mut joints = joints(&unknowns, &mut constraints, &ties);
    let found = active.solve(&mut unknowns, &mut constraints, &mut ties, &mut joints, &mut tally);
    (found, unknowns, constraints, tally)
}

#[test]
fn a_search_that_goes_in_circles_ends() {
    let all = (0..100).map(|k| tried(k, k % 2 == 1));
    let lost = all.filter_map(|(found, .., tally)| (!found).then_some(tally.rounds));
    let rounds: Vec<u64> = lost.collect();
    let early = rounds.iter().filter(|&&rounds| rounds < ROUNDS as u64).count();
    // 8 of the 18 failures; the others change their set until the last round.
    assert!(early >= 6, "{rounds:?}");
}

/// The iteration converges to the solution of the active set, ten steps at a time.
#[test]
fn the_set_is_what_the_iteration_approaches() {
    let (mut found, mut far) = (0, 0);
    for (seed, jointed) in (0..100).map(|k| (k, k % 2 == 1)) {
        let Some((exact, _)) = solved(seed, jointed) else { continue };
        found += 1;
        let (mut unknowns, mut constraints, mut ties) = frame(seed, jointed);
        let mut iterative = IterativeSolver::default();
        let mut joints = joints(&unknowns, &mut constraints, &ties);
        for _ in 0..200 {
            iterative.run(&mut unknowns, &mut constraints, &mut ties, &mut joints);
        }
        for (a, b) in exact.iter().zip(&unknowns) {
            let off = a.twist - b.twist;
            let off = off.xy().norm() + 0.03 * off.z.abs();
            far += usize::from(off > 1e-4);
        }
    }
    // Nearly undetermined slipping takes the iteration thousands of steps.
    assert!(found >= 80 && far <= 8, "{found} of 100 found, {far} of their bodies far off");
}

#[test]
fn solutions_satisfy_every_law() {
    for (seed, jointed) in (0..100).map(|k| (k, k % 2 == 1)) {
        let Some((_, constraints)) = solved(seed, jointed) else { continue };
        for Constraint { force, value, target, give, .. } in constraints {
            // The additional compliance of a force is no error.
            let left = Vector2::from(target) - value - force * give;
            assert!(force.x >= 0.0 && force.y.abs() <= 0.3 * force.x * (1.0 + 1e-9));
            assert!(left.x < 1e-9, "{seed}: {left}");
            assert!(force.x == 0.0 || left.x.abs() < 1e-9, "{seed}: {left}");
            let sticks = force.y.abs() < 0.3 * force.x * (1.0 - 1e-9);
            assert!(!sticks || left.y.abs() < 1e-9, "{seed}: {left}");
        }
    }
}
