//! Elimination of joints: the response of joined groups to forces at fixed weights.
//!
//! Joints close no loop, so every mechanism is a tree of groups. A group without children can be
//! eliminated by its effect on its parent (like articulated bodies: Featherstone 1983,
//! doi:10.1177/027836498300200102, here of first order). With the resistance A of the child, its
//! rows C of the joint and the rows P of its parent,
//!
//! ```text
//! A x = f + C^T force,  C x - P x_parent = target
//! S = (C A^-1 C^T)^-1,  W = A^-1 C^T,  G = W S P
//! x = (A^-1 - W S W^T) f + W S target + G x_parent
//! A_parent + P^T S P  and  f_parent + G^T f - P^T S target  then apply to the parent
//! ```
//!
//! from the leaves to the root, and back for the twists: as many steps as there are joints. The
//! parent of a joint to the world does not move: x_parent = 0. Its group is the root of its
//! mechanism.

use nalgebra::{Matrix2, Matrix3, Vector3};

use super::{
    constraint::{Constraint, Tie, apply, product},
    index::GroupIndex,
    tree_link::{TreeLink, inverse, pull},
    unknown::Unknown,
};

/// Eliminated joints, with reusable memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Eliminated {
    /// Ties with the groups that they join, from the roots of all mechanisms to their leaves.
    links: Vec<TreeLink>,
    /// Ties to the world, each of a different root; each root is entered as its own parent, and no
    /// effect is passed on.
    anchors: Vec<TreeLink>,
    /// Whether each group is a root, or already connected to one.
    reached: Vec<bool>,
    /// Root of the mechanism of each group.
    mechanism: Vec<usize>,
    /// Resistance of every group with its descendants, and the force on it.
    resistance: Vec<Matrix3<f64>>,
    load: Vec<Vector3<f64>>,
    /// Difference of the groups' twists from their free twists.
    moved: Vec<Vector3<f64>>,
    /// Twist of every group per force on every other, row by row; empty without ties.
    blocks: Vec<Matrix3<f64>>,
}

impl Eliminated {
    /// Finds the groups that `ties` join. A tie that closes a loop is left out; valid input has
    /// none.
    pub fn hang(&mut self, groups: usize, ties: &[Tie]) {
        let Self { links, anchors, reached, mechanism, .. } = self;
        links.clear();
        anchors.clear();
        mechanism.clear();
        mechanism.extend(0..groups);
        if ties.is_empty() {
            return;
        }
        reached.clear();
        reached.resize(groups, false);
        let to_world = ties.iter().enumerate().filter(|(_, tie)| tie.a.is_none());
        anchors.extend(to_world.map(|(index, tie)| TreeLink::new(index, [tie.b.0; 2], false)));
        // No mechanism has two, because they would close a loop.
        let held = anchors.iter().map(|anchor| anchor.child);
        for root in held.chain(0..groups) {
            if std::mem::replace(&mut reached[root], true) {
                continue;
            }
            let mut first = links.len();
            let mut parent = root;
            loop {
                for (index, tie) in ties.iter().enumerate() {
                    let Some(GroupIndex(a)) = tie.a else { continue };
                    let turned = tie.b.0 == parent;
                    let child = if turned { a } else { tie.b.0 };
                    if (turned || a == parent) && !reached[child] {
                        reached[child] = true;
                        mechanism[child] = root;
                        links.push(TreeLink::new(index, [parent, child], turned));
                    }
                }
                let Some(link) = links.get(first) else { break };
                parent = link.child;
                first += 1;
            }
        }
    }

    /// Computes the responses at the present weights.
    pub fn prepare(&mut self, unknowns: &[Unknown], ties: &[Tie]) {
        let nothing = self.is_empty();
        let Self { links, anchors, mechanism, resistance, blocks, .. } = self;
        blocks.clear();
        if nothing {
            return;
        }
        resistance.clear();
        resistance.extend(unknowns.iter().map(|unknown| unknown.resistance));
        for link in links.iter_mut().rev() {
            let felt = link.weigh(&ties[link.tie], &inverse(&resistance[link.child]));
            resistance[link.parent] += felt;
        }
        let count = unknowns.len();
        blocks.resize(count * count, Matrix3::zeros());
        for root in (0..count).filter(|&group| mechanism[group] == group) {
            blocks[root * count + root] = inverse(&resistance[root]);
        }
        for anchor in anchors {
            let root = anchor.child;
            anchor.weigh(&ties[anchor.tie], &blocks[root * count + root]);
            blocks[root * count + root] = anchor.held;
        }
        for (k, link) in links.iter().enumerate() {
            let TreeLink { parent, child, carried, held, .. } = link;
            let root = mechanism[*child];
            // Groups of one root are adjacent, parents before children.
            let above = links[..k].iter().rev().take_while(|other| mechanism[other.child] == root);
            for other in above.map(|other| other.child).chain([root]) {
                let block = carried * blocks[parent * count + other];
                blocks[child * count + other] = block;
                blocks[other * count + child] = block.transpose();
            }
            let own = held + blocks[child * count + parent] * carried.transpose();
            blocks[child * count + child] = own;
        }
    }

    /// Returns the index of the mechanism of a group.
    #[inline]
    pub fn mechanism(&self, group: GroupIndex) -> usize {
        self.mechanism[group.0]
    }

    /// Returns `true` if joints transmit forces between two groups.
    #[inline]
    fn couples(&self, one: GroupIndex, other: GroupIndex) -> bool {
        !self.is_empty() && self.mechanism[one.0] == self.mechanism[other.0]
    }

    /// Returns `true` if there are no joints.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.links.is_empty() && self.anchors.is_empty()
    }

    /// Adds to `felt` the contribution of force and torque on every group to `value` times the
    /// twist of `group`. Without joints only the group itself contributes.
    #[inline]
    pub fn feel(&self, group: GroupIndex, value: &Vector3<f64>, felt: &mut [Vector3<f64>]) {
        let own = self.mechanism[group.0];
        let line = &self.blocks[group.0 * self.mechanism.len()..];
        for ((felt, mechanism), block) in felt.iter_mut().zip(&self.mechanism).zip(line) {
            if *mechanism == own {
                *felt += block.tr_mul(value);
            }
        }
    }

    /// Returns the twist of `one` per force and torque on `other`, which it
    /// [couples](Self::couples).
    #[inline]
    fn block(&self, one: GroupIndex, other: GroupIndex) -> &Matrix3<f64> {
        &self.blocks[one.0 * self.mechanism.len() + other.0]
    }

    /// Computes the response of a constraint's bodies to its forces, unless it is valid at the
    /// present weights.
    #[inline]
    pub fn weigh(&self, constraint: &mut Constraint, unknowns: &[Unknown]) {
        if !constraint.weighed {
            constraint.weigh(unknowns);
            if !self.is_empty() {
                constraint.own = self.own(constraint);
            }
        }
    }

    /// Returns J M J^T of either side of a constraint, where M is the response of the groups. If
    /// both belong to one mechanism, the first side contains everything.
    #[inline]
    pub fn own(&self, constraint: &Constraint) -> [Matrix2<f64>; 2] {
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

    /// Computes twists without contact forces, with the ties satisfied.
    pub fn release(&mut self, unknowns: &mut [Unknown], ties: &mut [Tie]) {
        match self.is_empty() {
            true => unknowns.iter_mut().for_each(|unknown| unknown.twist = unknown.free),
            false => self.spread(unknowns, &[], ties),
        }
    }

    /// Computes twists from trial forces, with the ties satisfied.
    pub fn spread(
        &mut self,
        unknowns: &mut [Unknown],
        constraints: &[Constraint],
        ties: &mut [Tie],
    ) {
        let nothing = self.is_empty();
        let Self { links, anchors, mechanism, load, moved, blocks, .. } = self;
        for unknown in unknowns.iter_mut() {
            (unknown.pressed, unknown.touched) = (Vector3::zeros(), false);
        }
        constraints.iter().for_each(|constraint| constraint.press(unknowns));
        if nothing {
            unknowns.iter_mut().for_each(Unknown::settle);
            return;
        }
        load.clear();
        load.extend(unknowns.iter().map(|unknown| unknown.pressed));
        for link in links.iter_mut().rev() {
            link.ask(&ties[link.tie], unknowns);
            let felt = link.carried.tr_mul(&load[link.child])
                - pull(&link.on_parent, &(link.stiffness * link.left));
            load[link.parent] += felt;
        }
        let count = unknowns.len();
        moved.clear();
        moved.extend((0..count).map(|group| match mechanism[group] == group {
            true => blocks[group * count + group] * load[group],
            false => Vector3::zeros(),
        }));
        for anchor in anchors {
            let root = anchor.child;
            anchor.ask(&ties[anchor.tie], unknowns);
            let gap = anchor.left - apply(&anchor.answer, &load[root]);
            let tie = &mut ties[anchor.tie];
            tie.force = anchor.stiffness * gap;
            tie.press(unknowns);
            moved[root] += pull(&anchor.drawn, &anchor.left);
        }
        for link in links.iter() {
            let (load, above) = (&load[link.child], moved[link.parent]);
            let gap = link.left + apply(&link.on_parent, &above) - apply(&link.answer, load);
            let force = link.stiffness * gap;
            let tie = &mut ties[link.tie];
            tie.force = if link.turned { -force } else { force };
            tie.press(unknowns);
            moved[link.child] =
                link.held * load + pull(&link.drawn, &link.left) + link.carried * above;
        }
        for (unknown, moved) in unknowns.iter_mut().zip(moved) {
            unknown.twist = unknown.free + *moved;
        }
    }
}

#[cfg(test)]
mod tests;
