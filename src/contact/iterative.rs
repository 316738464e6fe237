//! Iterative contact forces of a frame at fixed weights, for jams in which [`super::active_set`] finds
//! no solution.
//!
//! Accelerated projected Jacobi steps, with each body's mass divided among its constraints (Tonge,
//! Benevolenski and Voroshilov 2012, doi:10.1145/2185520.2185601; Nesterov 1983). Unlike
//! Gauss-Seidel steps they are independent of any order.

use super::{
    constraint::{Constraint, Tie},
    eliminated::Eliminated,
    unknown::Unknown,
};

/// Maximum number of steps.
const ITERATIONS: usize = 10;

/// Change in a step below which the iteration ends, metres.
const SETTLED: f64 = 5e-6;

/// Reusable memory of the iteration.
#[derive(Clone, Debug, Default)]
pub(super) struct IterativeSolver {
    active: Vec<f64>,
}

impl IterativeSolver {
    /// Computes forces and twists, starting from the forces of the constraints.
    pub fn run(
        &mut self,
        unknowns: &mut [Unknown],
        constraints: &mut [Constraint],
        ties: &mut [Tie],
        joints: &mut Eliminated,
    ) {
        let active = &mut self.active;
        active.resize(unknowns.len(), 0.0);
        constraints.iter_mut().for_each(|constraint| constraint.trial = constraint.force);
        let mut momentum = 1.0f64;
        for _ in 0..ITERATIONS {
            joints.spread(unknowns, constraints, ties);
            active.fill(0.0);
            for constraint in constraints.iter_mut() {
                constraint.read(unknowns);
                if constraint.presses() || constraint.asks() {
                    let first = joints.mechanism(constraint.a);
                    active[first] += 1.0;
                    match constraint.b.map(|b| joints.mechanism(b)) {
                        Some(second) if second != first => active[second] += 1.0,
                        _ => {}
                    }
                }
            }
            let previous = momentum;
            momentum = 0.5 * (1.0 + (1.0 + 4.0 * momentum * momentum).sqrt());
            let carry = (previous - 1.0) / momentum;
            let (mut against, mut largest) = (0.0, 0.0f64);
            for constraint in constraints.iter_mut() {
                let own = &constraint.own;
                let mut k = own[0] * active[joints.mechanism(constraint.a)].max(1.0);
                if let Some(b) = constraint.b {
                    k += own[1] * active[joints.mechanism(b)].max(1.0);
                }
                let force = constraint.respond(&k).1;
                let change = force - constraint.force;
                let moved = k * change;
                against += (constraint.trial - force).dot(&moved);
                largest = largest.max(moved.amax());
                constraint.trial = force + carry * change;
                constraint.force = force;
            }
            // Adaptive restart: momentum that points away from the solution is dropped (O'Donoghue
            // and Candes 2015, doi:10.1007/s10208-013-9150-3).
            if against > 0.0 {
                momentum = 1.0;
                constraints.iter_mut().for_each(|c| c.trial = c.force);
            }
            if largest < SETTLED {
                break;
            }
        }
        constraints.iter_mut().for_each(|c| c.trial = c.force);
        joints.spread(unknowns, constraints, ties);
    }
}
