//! Joints eliminated: how groups that hang together answer forces at fixed weights.
//!
//! With the resistance A of the groups and the rows J of the joints, whatever presses, twists that
//! keep the joints follow from
//!
//! ```text
//! M = A^-1 - A^-1 J^T (J A^-1 J^T)^-1 J A^-1
//! ```
//!
//! which has blocks between all groups of a mechanism, and none between mechanisms.

use nalgebra::{DMatrix, DVector, Matrix2, Matrix3, Vector2, Vector3};

use crate::scene::DisjointSets;

use super::{
    constraint::{Constraint, Tie, product},
    index::GroupIndex,
    unknown::Unknown,
};

/// Memory that is reused.
#[derive(Clone, Debug, Default)]
pub(super) struct Eliminated {
    /// (J A^-1 J^T)^-1 of all ties.
    tied: DMatrix<f64>,
    asked: DVector<f64>,
    /// Which groups hang together by ties: the number of the mechanism of each.
    mechanism: Vec<usize>,
    sets: DisjointSets,
    /// The blocks of M, row by row; empty without ties.
    blocks: Vec<Matrix3<f64>>,
}

impl Eliminated {
    /// Takes the present weights.
    pub fn prepare(&mut self, unknowns: &[Unknown], ties: &[Tie]) {
        self.sets.reset(unknowns.len());
        for tie in ties {
            self.sets.join([tie.a.0, tie.b.0]);
        }
        self.mechanism.clear();
        self.mechanism.extend_from_slice(self.sets.names());
        self.blocks.clear();
        if !ties.is_empty() {
            self.tie(unknowns, ties);
            self.find_blocks(unknowns, ties);
        }
    }

    /// The number of the mechanism that a group belongs to.
    pub fn mechanism(&self, group: GroupIndex) -> usize {
        self.mechanism[group.0]
    }

    /// Whether the joints make anything of forces on one of two groups that the other feels.
    fn couples(&self, one: GroupIndex, other: GroupIndex) -> bool {
        !self.blocks.is_empty() && self.mechanism[one.0] == self.mechanism[other.0]
    }

    /// Adds to `felt` what force and torque on every group make of `value` times the twist of `group`.
    pub fn feel(
        &self,
        (group, value): (GroupIndex, &Vector3<f64>),
        unknowns: &[Unknown],
        felt: &mut [Vector3<f64>],
    ) {
        if self.blocks.is_empty() {
            felt[group.0] += unknowns[group.0].inverse * value;
            return;
        }
        let own = self.mechanism[group.0];
        let line = &self.blocks[group.0 * self.mechanism.len()..];
        for ((felt, mechanism), block) in felt.iter_mut().zip(&self.mechanism).zip(line) {
            if *mechanism == own {
                *felt += block.tr_mul(value);
            }
        }
    }

    /// The twist that force and torque on `other` give to `one`, which it [couples](Self::couples).
    fn block(&self, one: GroupIndex, other: GroupIndex) -> &Matrix3<f64> {
        &self.blocks[one.0 * self.mechanism.len() + other.0]
    }

    /// J M J^T of either side of a constraint; all of it on the first side where both belong to one
    /// mechanism.
    pub fn own(&self, constraint: &Constraint) -> [Matrix2<f64>; 2] {
        if self.blocks.is_empty() {
            return constraint.own;
        }
        let between = |(g, to): (GroupIndex, &[Vector3<f64>; 2]),
                       (h, from): (GroupIndex, &[Vector3<f64>; 2])| {
            product(to, &from.map(|row| self.block(g, h) * row))
        };
        let first = (constraint.a, &constraint.to);
        let own = between(first, first);
        let Some(b) = constraint.b else { return [own, Matrix2::zeros()] };
        let second = (b, &constraint.from);
        let other = between(second, second);
        if !self.couples(constraint.a, b) {
            return [own, other];
        }
        let across = between(first, second);
        [own + other - across - across.transpose(), Matrix2::zeros()]
    }

    /// Twists from trial forces, the ties met.
    pub fn spread(
        &mut self,
        unknowns: &mut [Unknown],
        constraints: &[Constraint],
        ties: &mut [Tie],
    ) {
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

    fn tie(&mut self, unknowns: &[Unknown], ties: &[Tie]) {
        let count = ties.len();
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

    fn find_blocks(&mut self, unknowns: &[Unknown], ties: &[Tie]) {
        let Self { tied, mechanism, blocks, .. } = self;
        let count = unknowns.len();
        blocks.resize(count * count, Matrix3::zeros());
        for (k, unknown) in unknowns.iter().enumerate() {
            blocks[k * count + k] = unknown.inverse;
        }
        // What every tie does to its two groups.
        let moved = ties.iter().map(|tie| {
            [tie.a, tie.b].map(|group| {
                let side = tie.side(group).unwrap_or_default();
                (group.0, side.map(|row| unknowns[group.0].inverse * row))
            })
        });
        let moved: Vec<[(usize, [Vector3<f64>; 2]); 2]> = moved.collect();
        for (k, first) in moved.iter().enumerate() {
            for (l, second) in moved.iter().enumerate() {
                if mechanism[first[0].0] != mechanism[second[0].0] {
                    continue;
                }
                let between = tied.fixed_view::<2, 2>(2 * k, 2 * l);
                for (g, [u0, u1]) in first {
                    for (h, [v0, v1]) in second {
                        let w0 = v0 * between[(0, 0)] + v1 * between[(0, 1)];
                        let w1 = v0 * between[(1, 0)] + v1 * between[(1, 1)];
                        blocks[g * count + h] -= u0 * w0.transpose() + u1 * w1.transpose();
                    }
                }
            }
        }
    }
}
