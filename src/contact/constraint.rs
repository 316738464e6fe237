//! One contact, limit or joint as equations between two rigid groups, and the force that would
//! meet a contact alone.

use nalgebra::{Matrix2, Vector2, Vector3};

use super::{index::GroupIndex, unknown::Unknown};

/// Share of its own effect, joints left aside, by which a force gives way; keeps forces finite
/// where nothing fits, and where the force of a contact acts through the axis of a joint.
pub(super) const GIVE: f64 = 2e-3;

/// Smallest share of a sliding contact's own compliance along the normal that counts: below it
/// the contact wedges, which these equations cannot answer.
const MIN_COMPLIANCE: f64 = 0.2;

/// A displacement that does not count, metres: rounding must not decide anything.
const OPEN: f64 = 1e-9;

/// What a constraint allows its two forces to be.
#[derive(Clone, Copy, Debug)]
pub(super) enum Law {
    /// The first is not negative and its value becomes at least the target; the second is
    /// unused.
    AtLeast,
    /// The same, and the second lies within the friction cone of the first and draws its value
    /// to the target.
    Contact { friction: f64 },
}

/// Two scalar equations between groups `a` and `b`: `to . twist(a) - from . twist(b)` against
/// `target`, metres. Without `b` the other body's motion is given, and part of the target.
#[derive(Clone, Copy, Debug)]
pub(super) struct Constraint {
    pub a: GroupIndex,
    pub b: Option<GroupIndex>,
    pub to: [Vector3<f64>; 2],
    pub from: [Vector3<f64>; 2],
    pub target: [f64; 2],
    pub law: Law,
    pub force: Vector2<f64>,
    /// The force that the next iteration starts from.
    pub trial: Vector2<f64>,
    /// `to . twist(a) - from . twist(b)` under the trial forces, metres.
    pub value: Vector2<f64>,
    /// J A^-1 J^T of either body.
    pub own: [Matrix2<f64>; 2],
    /// By how much a force of one gives way.
    pub give: f64,
}

impl Constraint {
    pub fn new(
        (a, to): (GroupIndex, [Vector3<f64>; 2]),
        (b, from): (Option<GroupIndex>, [Vector3<f64>; 2]),
        target: [f64; 2],
        law: Law,
    ) -> Self {
        let none = Vector2::zeros();
        let own = [Matrix2::zeros(); 2];
        Self { a, b, to, from, target, law, force: none, trial: none, value: none, own, give: 0.0 }
    }

    /// Takes its value from how the bodies move.
    pub fn read(&mut self, unknowns: &[Unknown]) {
        self.value = apply(&self.to, &unknowns[self.a.0].twist);
        if let Some(b) = self.b {
            self.value -= apply(&self.from, &unknowns[b.0].twist);
        }
    }

    /// Whether `force` moves its bodies by more than rounding does.
    pub fn presses(&self, force: &Vector2<f64>) -> bool {
        force.x * (self.own[0].m11 + self.own[1].m11) > OPEN
    }

    /// Whether it is violated by more than rounding.
    pub fn asks(&self) -> bool {
        self.target[0] > self.value.x + OPEN
    }

    /// The forces that would meet this constraint if nothing else changed, the compliance
    /// being `k` and the trial forces and its value what they are.
    pub fn answer(&self, k: &Matrix2<f64>) -> Vector2<f64> {
        let give = self.give;
        let left = Vector2::from(self.target) - self.value - self.trial * give;
        let (knn, ktt, knt) = (k.m11 + give, k.m22 + give, k.m12);
        match self.law {
            Law::AtLeast => Vector2::new((self.trial.x + left.x / knn).max(0.0), 0.0),
            Law::Contact { friction } => {
                let det = knn * ktt - knt * knt;
                let step =
                    Vector2::new(ktt * left.x - knt * left.y, knn * left.y - knt * left.x) / det;
                let stick = self.trial + step;
                if stick.x >= 0.0 && stick.y.abs() <= friction * stick.x {
                    return stick;
                }
                // Sliding: on the edge of the cone that the sticking force lies beyond.
                let edge = friction * stick.y.signum();
                let compliance = (knn + edge * knt).max(MIN_COMPLIANCE * knn);
                let asked = left.x + knn * self.trial.x + knt * self.trial.y;
                let pressed = (asked / compliance).max(0.0);
                Vector2::new(pressed, edge * pressed)
            }
        }
    }
}

/// Two scalar equations that a joint keeps exactly: `to . twist(b) - from . twist(a) = target`,
/// metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tie {
    pub a: GroupIndex,
    pub b: GroupIndex,
    pub to: [Vector3<f64>; 2],
    pub from: [Vector3<f64>; 2],
    pub target: [f64; 2],
    pub force: Vector2<f64>,
}

impl Tie {
    /// The part of this tie's equations that acts on `group`.
    pub fn side(&self, group: GroupIndex) -> Option<[Vector3<f64>; 2]> {
        if group == self.b {
            Some(self.to)
        } else if group == self.a {
            Some(self.from.map(|from| -from))
        } else {
            None
        }
    }

    pub fn values(&self, unknowns: &[Unknown]) -> Vector2<f64> {
        apply(&self.to, &unknowns[self.b.0].twist) - apply(&self.from, &unknowns[self.a.0].twist)
    }
}

fn apply(j: &[Vector3<f64>; 2], twist: &Vector3<f64>) -> Vector2<f64> {
    Vector2::new(j[0].dot(twist), j[1].dot(twist))
}
