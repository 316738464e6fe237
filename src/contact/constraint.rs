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

/// What a constraint does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Status {
    /// Nothing presses.
    Open,
    /// Both of its equations hold.
    Sticks,
    /// The first does, and the second force is this share of the first: an edge of the friction
    /// cone, or nothing where there is no second.
    Slides(f64),
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

    /// J A^-1 J^T of both bodies.
    pub fn alone(&self) -> Matrix2<f64> {
        self.own[0] + self.own[1]
    }

    /// The rows of its forces on its groups.
    pub fn sides(&self) -> impl Iterator<Item = (GroupIndex, [Vector3<f64>; 2])> {
        let from = self.b.map(|b| (b, self.from.map(|from| -from)));
        std::iter::once((self.a, self.to)).chain(from)
    }

    /// Those on `group`.
    pub fn side(&self, group: GroupIndex) -> Option<[Vector3<f64>; 2]> {
        self.sides().find_map(|(of, side)| (of == group).then_some(side))
    }

    /// By how much more than it should a force along the normal gives way where the contact slides
    /// and wedges.
    pub fn wedge(&self, edge: f64) -> f64 {
        let k = self.alone();
        let knn = k.m11 + self.give;
        (MIN_COMPLIANCE * knn - (knn + edge * k.m12)).max(0.0)
    }

    /// The forces that would meet this constraint if nothing else changed, the compliance
    /// being `k` and the trial forces and its value what they are.
    pub fn answer(&self, k: &Matrix2<f64>) -> Vector2<f64> {
        self.respond(k).1
    }

    /// What it would then do, and the forces.
    pub fn respond(&self, k: &Matrix2<f64>) -> (Status, Vector2<f64>) {
        let pressed = |force: Vector2<f64>, edge: f64| match force.x > 0.0 {
            true => (Status::Slides(edge), force),
            false => (Status::Open, force),
        };
        let give = self.give;
        let left = Vector2::from(self.target) - self.value - self.trial * give;
        let (knn, ktt, knt) = (k.m11 + give, k.m22 + give, k.m12);
        match self.law {
            Law::AtLeast => pressed(Vector2::new((self.trial.x + left.x / knn).max(0.0), 0.0), 0.0),
            Law::Contact { friction } => {
                let det = knn * ktt - knt * knt;
                let step =
                    Vector2::new(ktt * left.x - knt * left.y, knn * left.y - knt * left.x) / det;
                let stick = self.trial + step;
                if stick.x >= 0.0 && stick.y.abs() <= friction * stick.x {
                    return (Status::Sticks, stick);
                }
                // Sliding: on the edge of the cone that the sticking force lies beyond.
                let edge = friction * stick.y.signum();
                let compliance = (knn + edge * knt).max(MIN_COMPLIANCE * knn);
                let asked = left.x + knn * self.trial.x + knt * self.trial.y;
                let normal = (asked / compliance).max(0.0);
                pressed(Vector2::new(normal, edge * normal), edge)
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
