//! The forces of a frame's contacts at fixed weights, approached where [`super::active`] finds
//! none: where much jams.
//!
//! Accelerated projected Jacobi steps, each body's mass split among its constraints (Tonge,
//! Benevolenski and Voroshilov 2012, doi:10.1145/2185520.2185601; Nesterov 1983), which unlike
//! Gauss-Seidel do not depend on the order of anything. Joints are eliminated.

use nalgebra::{DMatrix, DVector, Matrix2, Vector2, Vector3};

use crate::scene::DisjointSets;

use super::{
    constraint::{Constraint, Tie, product},
    index::GroupIndex,
    unknown::Unknown,
};

/// Most steps.
const ITERATIONS: usize = 10;

/// A change of a whole round of steps below this ends them, metres.
const SETTLED: f64 = 5e-6;

/// Memory that is reused.
#[derive(Clone, Debug, Default)]
pub(super) struct Approach {
    /// (J A^-1 J^T)^-1 of all ties.
    tied: DMatrix<f64>,
    asked: DVector<f64>,
    /// Which groups hang together by ties: the number of the mechanism of each.
    mechanism: Vec<usize>,
    sets: DisjointSets,
    active: Vec<f64>,
    /// J M J^T of either side of every constraint, M being A^-1 with the ties eliminated; all of it
    /// on the first side where both belong to one mechanism.
    compliance: Vec<[Matrix2<f64>; 2]>,
}

impl Approach {
    /// Forces and twists, beginning with the forces that the constraints have.
    pub fn run(
        &mut self,
        unknowns: &mut [Unknown],
        constraints: &mut [Constraint],
        ties: &mut [Tie],
    ) {
        self.find_mechanisms(unknowns, ties);
        self.tie(unknowns, ties);
        self.compliance.clear();
        for constraint in constraints.iter_mut() {
            constraint.trial = constraint.force;
            self.compliance.push(self.compliance(unknowns, ties, constraint));
        }
        let mut momentum = 1.0f64;
        for _ in 0..ITERATIONS {
            self.spread(unknowns, constraints, ties);
            let Self { mechanism, active, compliance, .. } = self;
            active.fill(0.0);
            for constraint in constraints.iter_mut() {
                constraint.read(unknowns);
                if constraint.presses() || constraint.asks() {
                    let first = mechanism[constraint.a.0];
                    active[first] += 1.0;
                    match constraint.b.map(|b| mechanism[b.0]) {
                        Some(second) if second != first => active[second] += 1.0,
                        _ => {}
                    }
                }
            }
            let previous = momentum;
            momentum = 0.5 * (1.0 + (1.0 + 4.0 * momentum * momentum).sqrt());
            let carry = (previous - 1.0) / momentum;
            let (mut against, mut largest) = (0.0, 0.0f64);
            for (constraint, own) in constraints.iter_mut().zip(compliance) {
                let mut k = own[0] * active[mechanism[constraint.a.0]].max(1.0);
                if let Some(b) = constraint.b {
                    k += own[1] * active[mechanism[b.0]].max(1.0);
                }
                let force = constraint.respond(&k).1;
                let change = force - constraint.force;
                let moved = k * change;
                against += (constraint.trial - force).dot(&moved);
                largest = largest.max(moved.amax());
                constraint.trial = force + carry * change;
                constraint.force = force;
            }
            // Momentum that points away from the answer is dropped (O'Donoghue and Candes
            // 2015, doi:10.1007/s10208-013-9150-3).
            if against > 0.0 {
                momentum = 1.0;
                constraints.iter_mut().for_each(|c| c.trial = c.force);
            }
            if largest < SETTLED {
                break;
            }
        }
        constraints.iter_mut().for_each(|c| c.trial = c.force);
        self.spread(unknowns, constraints, ties);
    }

    fn find_mechanisms(&mut self, unknowns: &[Unknown], ties: &[Tie]) {
        self.sets.reset(unknowns.len());
        for tie in ties {
            self.sets.join([tie.a.0, tie.b.0]);
        }
        self.mechanism.clear();
        self.mechanism.extend_from_slice(self.sets.names());
        self.active.resize(unknowns.len(), 0.0);
    }

    /// Prepares the elimination of all ties.
    fn tie(&mut self, unknowns: &[Unknown], ties: &[Tie]) {
        let count = ties.len();
        if count == 0 {
            return;
        }
        let mut whole = DMatrix::zeros(2 * count, 2 * count);
        for (p, first) in ties.iter().enumerate() {
            for (q, second) in ties.iter().enumerate() {
                for group in [first.a, first.b] {
                    let (Some(j), Some(k)) = (first.side(group), second.side(group)) else {
                        continue;
                    };
                    let inverse = &unknowns[group.0].inverse;
                    let mut place = whole.fixed_view_mut::<2, 2>(2 * p, 2 * q);
                    place += product(&j, &k.map(|row| inverse * row));
                }
            }
        }
        for k in 0..2 * count {
            whole[(k, k)] *= 1.0 + 1e-9;
        }
        // Joints form no loops, so their equations are independent and this always succeeds;
        // were they not, going without them is what a reader would see.
        self.tied = match whole.cholesky() {
            Some(factor) => factor.inverse(),
            None => DMatrix::zeros(2 * count, 2 * count),
        };
    }

    /// J M J^T of either side of a constraint, see [`Self::compliance`].
    fn compliance(
        &self,
        unknowns: &[Unknown],
        ties: &[Tie],
        constraint: &Constraint,
    ) -> [Matrix2<f64>; 2] {
        let sides = constraint.own;
        if ties.is_empty() {
            return sides;
        }
        let first = through_ties(unknowns, ties, constraint.a, &constraint.to);
        let Some(b) = constraint.b else {
            return [sides[0] - self.taken(&first), Matrix2::zeros()];
        };
        let mut second = through_ties(unknowns, ties, b, &constraint.from);
        if self.mechanism[constraint.a.0] != self.mechanism[b.0] {
            return [sides[0] - self.taken(&first), sides[1] - self.taken(&second)];
        }
        second.iter_mut().for_each(|(_, w)| *w = -*w);
        let both = [first, second].concat();
        [sides[0] + sides[1] - self.taken(&both), Matrix2::zeros()]
    }

    /// What the ties take from the compliance of a constraint that they feel like this.
    fn taken(&self, felt: &[(usize, Matrix2<f64>)]) -> Matrix2<f64> {
        let mut taken = Matrix2::zeros();
        for (k, left) in felt {
            for (l, right) in felt {
                let between = self.tied.fixed_view::<2, 2>(2 * k, 2 * l);
                taken += left.transpose() * between * right;
            }
        }
        taken
    }

    /// Twists from trial forces, the ties met.
    fn spread(&mut self, unknowns: &mut [Unknown], constraints: &[Constraint], ties: &mut [Tie]) {
        let Self { tied, asked, .. } = self;
        unknowns.iter_mut().for_each(|unknown| unknown.pressed = Vector3::zeros());
        constraints.iter().for_each(|constraint| constraint.press(unknowns));
        unknowns.iter_mut().for_each(Unknown::settle);
        if ties.is_empty() {
            return;
        }
        if asked.len() != 2 * ties.len() {
            *asked = DVector::zeros(2 * ties.len());
        }
        for (k, tie) in ties.iter().enumerate() {
            let left = Vector2::from(tie.target) - tie.values(unknowns);
            (asked[2 * k], asked[2 * k + 1]) = (left.x, left.y);
        }
        for (k, tie) in ties.iter_mut().enumerate() {
            let force = |row: usize| tied.column(row).dot(asked);
            tie.force = Vector2::new(force(2 * k), force(2 * k + 1));
            tie.press(unknowns);
        }
        unknowns.iter_mut().for_each(Unknown::settle);
    }
}

/// How the ties of `group` feel the rows `j` of a constraint on it.
fn through_ties(
    unknowns: &[Unknown],
    ties: &[Tie],
    group: GroupIndex,
    j: &[Vector3<f64>; 2],
) -> Vec<(usize, Matrix2<f64>)> {
    let moved = j.map(|row| unknowns[group.0].inverse * row);
    let felt = ties.iter().enumerate();
    felt.filter_map(|(k, tie)| Some((k, product(&tie.side(group)?, &moved)))).collect()
}
