//! A joint between a group and its parent, with the response that it transmits; see
//! [`super::eliminated`] for the symbols.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::{
    constraint::{Tie, apply, product},
    unknown::Unknown,
};

/// A tie, and the response of the child group.
#[derive(Clone, Copy, Debug)]
pub(super) struct TreeLink {
    pub tie: usize,
    pub parent: usize,
    pub child: usize,
    /// Whether the child is the tie's first group, which changes the sign of its equations.
    pub turned: bool,
    /// Rows of the parent, P.
    pub on_parent: [Vector3<f64>; 2],
    /// Rows of the child, C.
    pub on_child: [Vector3<f64>; 2],
    /// Stiffness of the joint, S.
    pub stiffness: Matrix2<f64>,
    /// Columns of W, and of W S.
    pub answer: [Vector3<f64>; 2],
    pub drawn: [Vector3<f64>; 2],
    /// Twists per force with the parent fixed.
    pub held: Matrix3<f64>,
    /// G: the child's twist per twist of its parent.
    pub carried: Matrix3<f64>,
    /// Residual of the joint if all groups move freely, metres.
    pub left: Vector2<f64>,
}

impl TreeLink {
    /// Creates a link for the tie with this index, without weights.
    #[inline]
    pub fn new(tie: usize, [parent, child]: [usize; 2], turned: bool) -> Self {
        let (rows, none) = ([Vector3::zeros(); 2], Matrix3::zeros());
        Self {
            tie,
            parent,
            child,
            turned,
            on_parent: rows,
            on_child: rows,
            stiffness: Matrix2::zeros(),
            answer: rows,
            drawn: rows,
            held: none,
            carried: none,
            left: Vector2::zeros(),
        }
    }

    /// Computes the child's response from the inverse resistance of the child with its descendants.
    /// Returns the resistance that this adds to the parent.
    #[inline]
    pub fn weigh(&mut self, tie: &Tie, inverse: &Matrix3<f64>) -> Matrix3<f64> {
        (self.on_parent, self.on_child) =
            if self.turned { (tie.to, tie.from) } else { (tie.from, tie.to) };
        self.answer = self.on_child.map(|row| inverse * row);
        let k = product(&self.on_child, &self.answer);
        let det = k.m11 * k.m22 - k.m12 * k.m12;
        self.stiffness = Matrix2::new(k.m22, -k.m12, -k.m12, k.m11) / det;
        self.drawn = times(&self.answer, &self.stiffness);
        self.held = inverse - outer(&self.drawn, &self.answer);
        self.carried = outer(&self.drawn, &self.on_parent);
        outer(&times(&self.on_parent, &self.stiffness), &self.on_parent)
    }

    /// Computes the residual of its tie if all groups move freely.
    #[inline]
    pub fn ask(&mut self, tie: &Tie, unknowns: &[Unknown]) {
        let target = Vector2::from(tie.target) * if self.turned { -1.0 } else { 1.0 };
        self.left = target - apply(&self.on_child, &unknowns[self.child].free)
            + apply(&self.on_parent, &unknowns[self.parent].free);
    }
}

/// Inverts a resistance to displacements and rotations.
#[inline]
pub(super) fn inverse(weight: &Matrix3<f64>) -> Matrix3<f64> {
    let det = weight.m11 * weight.m22 - weight.m12 * weight.m12;
    let shifts = Matrix2::new(weight.m22, -weight.m12, -weight.m12, weight.m11) / det;
    let coupled = Vector2::new(weight.m13, weight.m23);
    // Compliance of a rotation about the centre of resistance.
    let about = -shifts * coupled;
    let turn = 1.0 / (weight.m33 + coupled.dot(&about));
    let shifts = shifts + about * about.transpose() * turn;
    let about = about * turn;
    Matrix3::new(
        shifts.m11, shifts.m12, about.x, shifts.m21, shifts.m22, about.y, about.x, about.y, turn,
    )
}

/// Returns J^T force.
#[inline]
pub(super) fn pull(j: &[Vector3<f64>; 2], force: &Vector2<f64>) -> Vector3<f64> {
    j[0] * force.x + j[1] * force.y
}

/// Returns the columns of J^T S.
#[inline]
fn times(j: &[Vector3<f64>; 2], s: &Matrix2<f64>) -> [Vector3<f64>; 2] {
    [pull(j, &s.column(0).into_owned()), pull(j, &s.column(1).into_owned())]
}

/// Returns the sum of u v^T over two columns of each.
#[inline]
fn outer(u: &[Vector3<f64>; 2], v: &[Vector3<f64>; 2]) -> Matrix3<f64> {
    u[0] * v[0].transpose() + u[1] * v[1].transpose()
}
