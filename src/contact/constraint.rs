//! Equations of a contact, limit or joint between two rigid groups, and the force that would
//! satisfy a contact alone.

use nalgebra::{Matrix2, Vector2, Vector3};
use pushplan_kernel::settings::{GIVE, MIN_COMPLIANCE, OPEN};

use super::{index::GroupIndex, unknown::Unknown};

/// Complementarity law of a constraint's two forces.
#[derive(Clone, Copy, Debug)]
pub(super) enum Law {
    /// Inequality: the first force is not negative and its value is at least the target; the second
    /// is unused.
    AtLeast,
    /// Inequality with friction: the second force also lies within the friction cone of the first
    /// and draws its value to the target.
    Contact { friction: f64 },
}

/// State of a constraint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Status {
    /// Open: no force.
    #[default]
    Open,
    /// Sticking: both equations are satisfied.
    Sticks,
    /// Sliding: the first equation is satisfied. The second force is this share of the first: an
    /// edge of the friction cone, or zero without a second equation.
    Slides(f64),
}

/// Two scalar equations between groups `a` and `b`: `to . twist(a) - from . twist(b)` against
/// `target`, metres. Without `b` the other body's motion is prescribed, and part of the target.
#[derive(Clone, Copy, Debug)]
pub(super) struct Constraint {
    pub a: GroupIndex,
    pub b: Option<GroupIndex>,
    pub to: [Vector3<f64>; 2],
    pub from: [Vector3<f64>; 2],
    pub target: [f64; 2],
    pub law: Law,
    /// Assumed or last known state.
    pub status: Status,
    pub force: Vector2<f64>,
    /// The force that the next iteration starts from.
    pub trial: Vector2<f64>,
    /// `to . twist(a) - from . twist(b)` under the trial forces, metres.
    pub value: Vector2<f64>,
    /// A^-1 J^T of either body: its twists under unit forces.
    pub moved: [[Vector3<f64>; 2]; 2],
    /// J A^-1 J^T of either body.
    pub own: [Matrix2<f64>; 2],
    /// Additional compliance of a force.
    pub give: f64,
    /// Whether `moved`, `own` and `give` are valid at the present weights.
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

    /// Computes the response of its bodies to its forces at their present weights.
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

    /// Returns J A^-1 J^T of both bodies.
    #[inline]
    pub fn alone(&self) -> Matrix2<f64> {
        self.own[0] + self.own[1]
    }

    /// Adds its trial forces to the forces on its bodies.
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

    /// Returns the additional compliance along the normal of a contact that slides and wedges.
    #[inline]
    pub fn wedge(&self, edge: f64) -> f64 {
        let k = self.alone();
        let knn = k.m11 + self.give;
        (MIN_COMPLIANCE * knn - (knn + edge * k.m12)).max(0.0)
    }

    /// Computes its value from the motion of the bodies.
    #[inline]
    pub fn read(&mut self, unknowns: &[Unknown]) {
        self.value = apply(&self.to, &unknowns[self.a.0].twist);
        if let Some(b) = self.b {
            self.value -= apply(&self.from, &unknowns[b.0].twist);
        }
    }

    /// Returns `true` if its forces move its bodies by more than rounding.
    #[inline]
    pub fn presses(&self) -> bool {
        self.trial.x * (self.own[0].m11 + self.own[1].m11) > OPEN
    }

    /// Returns `true` for a limit of a joint.
    #[inline]
    pub fn is_limit(&self) -> bool {
        matches!(self.law, Law::AtLeast)
    }

    /// Returns `true` if it is violated by more than rounding.
    #[inline]
    pub fn asks(&self) -> bool {
        self.target[0] > self.value.x + OPEN
    }

    /// Returns the state and forces that would satisfy this constraint alone, for the compliance
    /// `k` and the present trial forces and value.
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
                // Sliding: on the edge of the cone beyond which the sticking force lies.
                let edge = friction * stick.y.signum();
                let compliance = (knn + edge * knt).max(MIN_COMPLIANCE * knn);
                pressed((left.x + knn * self.trial.x + knt * self.trial.y) / compliance, edge)
            }
        }
    }
}

/// Two scalar equations that a joint satisfies exactly: `to . twist(b) - from . twist(a) = target`,
/// metres. Without `a` it connects its group to the world.
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
    /// Adds its forces to the forces on its groups.
    #[inline]
    pub fn press(&self, unknowns: &mut [Unknown]) {
        unknowns[self.b.0].pressed += self.to[0] * self.force.x + self.to[1] * self.force.y;
        if let Some(a) = self.a {
            unknowns[a.0].pressed -= self.from[0] * self.force.x + self.from[1] * self.force.y;
        }
    }
}

/// Returns J W^T of two pairs of rows.
#[inline]
pub(super) fn product(j: &[Vector3<f64>; 2], w: &[Vector3<f64>; 2]) -> Matrix2<f64> {
    Matrix2::new(j[0].dot(&w[0]), j[0].dot(&w[1]), j[1].dot(&w[0]), j[1].dot(&w[1]))
}

/// Returns J twist.
#[inline]
pub(super) fn apply(j: &[Vector3<f64>; 2], twist: &Vector3<f64>) -> Vector2<f64> {
    Vector2::new(j[0].dot(twist), j[1].dot(twist))
}
