//! One contact, limit or joint as equations between two rigid groups, and the force that would
//! meet a contact alone.

use nalgebra::{Matrix2, Vector2, Vector3};
use pushplan_kernel::settings::{GIVE, MIN_COMPLIANCE, OPEN};

use super::{index::GroupIndex, unknown::Unknown};

/// What a constraint allows for its two forces.
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
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Status {
    /// Nothing presses.
    #[default]
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
    /// What it does, as far as is known.
    pub status: Status,
    pub force: Vector2<f64>,
    /// The force that the next iteration starts from.
    pub trial: Vector2<f64>,
    /// `to . twist(a) - from . twist(b)` under the trial forces, metres.
    pub value: Vector2<f64>,
    /// A^-1 J^T of either body: its twists by forces of one.
    pub moved: [[Vector3<f64>; 2]; 2],
    /// J A^-1 J^T of either body.
    pub own: [Matrix2<f64>; 2],
    /// By how much a force of one gives way.
    pub give: f64,
    /// Whether these three are known at the present weights.
    pub weighed: bool,
}

impl Constraint {
    #[inline]
    pub fn new(
        (a, to): (GroupIndex, [Vector3<f64>; 2]),
        (b, from): (Option<GroupIndex>, [Vector3<f64>; 2]),
        target: [f64; 2],
        law: Law,
    ) -> Self {
        let none = Vector2::zeros();
        Self {
            a,
            b,
            to,
            from,
            target,
            law,
            status: Status::default(),
            force: none,
            trial: none,
            value: none,
            moved: [[Vector3::zeros(); 2]; 2],
            own: [Matrix2::zeros(); 2],
            give: 0.0,
            weighed: false,
        }
    }

    /// Takes how its bodies answer its forces from their present weights.
    #[inline]
    pub fn weigh(&mut self, unknowns: &[Unknown]) {
        self.moved[0] = self.to.map(|row| unknowns[self.a.0].inverse * row);
        self.own[0] = product(&self.to, &self.moved[0]);
        if let Some(b) = self.b {
            self.moved[1] = self.from.map(|row| unknowns[b.0].inverse * -row);
            self.own[1] = -product(&self.from, &self.moved[1]);
        }
        self.give = 0.5 * GIVE * self.alone().trace();
        self.weighed = true;
    }

    /// J A^-1 J^T of both bodies.
    #[inline]
    pub fn alone(&self) -> Matrix2<f64> {
        self.own[0] + self.own[1]
    }

    /// Adds its trial forces to what presses on its bodies.
    #[inline]
    pub fn press(&self, unknowns: &mut [Unknown]) {
        let trial = &self.trial;
        if *trial == Vector2::zeros() {
            return;
        }
        let first = &mut unknowns[self.a.0];
        first.pressed += self.to[0] * trial.x + self.to[1] * trial.y;
        first.touched = true;
        if let Some(b) = self.b {
            let second = &mut unknowns[b.0];
            second.pressed -= self.from[0] * trial.x + self.from[1] * trial.y;
            second.touched = true;
        }
    }

    /// By how much more than it should a force along the normal gives way where the contact slides
    /// and wedges.
    #[inline]
    pub fn wedge(&self, edge: f64) -> f64 {
        let k = self.alone();
        let knn = k.m11 + self.give;
        (MIN_COMPLIANCE * knn - (knn + edge * k.m12)).max(0.0)
    }

    /// Takes its value from how the bodies move.
    #[inline]
    pub fn read(&mut self, unknowns: &[Unknown]) {
        self.value = apply(&self.to, &unknowns[self.a.0].twist);
        if let Some(b) = self.b {
            self.value -= apply(&self.from, &unknowns[b.0].twist);
        }
    }

    /// Whether its forces move its bodies by more than rounding does.
    #[inline]
    pub fn presses(&self) -> bool {
        self.trial.x * (self.own[0].m11 + self.own[1].m11) > OPEN
    }

    /// Whether it is one of a joint's limits.
    #[inline]
    pub fn is_limit(&self) -> bool {
        matches!(self.law, Law::AtLeast)
    }

    /// Whether it is violated by more than rounding.
    #[inline]
    pub fn asks(&self) -> bool {
        self.target[0] > self.value.x + OPEN
    }

    /// What this constraint would do, and the forces that would meet it, if nothing else changed,
    /// the compliance being `k` and the trial forces and its value what they are.
    #[inline]
    pub fn respond(&self, k: &Matrix2<f64>) -> (Status, Vector2<f64>) {
        let pressed = |normal: f64, edge: f64| match normal > 0.0 {
            true => (Status::Slides(edge), Vector2::new(normal, edge * normal)),
            false => (Status::Open, Vector2::zeros()),
        };
        let give = self.give;
        let left = Vector2::from(self.target) - self.value - self.trial * give;
        let (knn, ktt, knt) = (k.m11 + give, k.m22 + give, k.m12);
        match self.law {
            Law::AtLeast => pressed(self.trial.x + left.x / knn, 0.0),
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
                pressed((left.x + knn * self.trial.x + knt * self.trial.y) / compliance, edge)
            }
        }
    }
}

/// Two scalar equations that a joint keeps exactly: `to . twist(b) - from . twist(a) = target`,
/// metres. Without `a` it holds its group to the world.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tie {
    pub a: Option<GroupIndex>,
    pub b: GroupIndex,
    pub to: [Vector3<f64>; 2],
    pub from: [Vector3<f64>; 2],
    pub target: [f64; 2],
    pub force: Vector2<f64>,
}

impl Tie {
    /// Adds its forces to what presses on its groups.
    #[inline]
    pub fn press(&self, unknowns: &mut [Unknown]) {
        unknowns[self.b.0].pressed += self.to[0] * self.force.x + self.to[1] * self.force.y;
        if let Some(a) = self.a {
            unknowns[a.0].pressed -= self.from[0] * self.force.x + self.from[1] * self.force.y;
        }
    }
}

/// J W^T of two pairs of rows.
#[inline]
pub(super) fn product(j: &[Vector3<f64>; 2], w: &[Vector3<f64>; 2]) -> Matrix2<f64> {
    Matrix2::new(j[0].dot(&w[0]), j[0].dot(&w[1]), j[1].dot(&w[0]), j[1].dot(&w[1]))
}

/// J twist.
#[inline]
pub(super) fn apply(j: &[Vector3<f64>; 2], twist: &Vector3<f64>) -> Vector2<f64> {
    Vector2::new(j[0].dot(twist), j[1].dot(twist))
}
