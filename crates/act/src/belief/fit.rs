//! Estimate of a joint's geometry: a Gaussian over the geometry and the errors of unobserved
//! headings, and observations in joint coordinates.
//!
//! The second object has position r and heading h in the frame of the first; R is a rotation by h:
//!
//! | type | geometry | held | free |
//! |---|---|---|---|
//! | none | | | r, h |
//! | fixed | r0, h0 | r - r0, h - h0 | |
//! | revolute | anchor c in the first frame, d in the second | r + R d - c | h |
//! | prismatic | angle p of the axis u in the first frame, offset o, h0 | n.r - o, h - h0 | u.r |
//!
//! The change to these coordinates preserves volume, so their densities compare between types. The
//! held coordinates follow a Kalman filter, extended for the axis.
//!
//! Its state also contains the errors of the two headings if these are not observed. Such headings
//! are rolled out under the joint type and drift slightly in every window. They are corrected by
//! the held coordinates, even if a heading is held relative to another unobserved one.

use nalgebra::{
    Matrix3, Matrix3x4, Matrix3x6, Matrix4, Matrix6, SMatrix, Vector2, Vector3, Vector4,
};

use pushplan::geometry::{Vector, perpendicular};

use super::{
    pair::JointType,
    window::{Instant, Look},
};

/// Standard deviations of the play of joints: metres and radians. Real joints have play, and
/// simulated joints drift.
const PLAY: [f64; 2] = [1.2e-4, 2e-3];

/// Gaussian over the geometry of a joint and the errors of unobserved headings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fit {
    pub kind: JointType,
    /// Geometry parameters, see the table above; unused ones are zero.
    pub mean: Vector4<f64>,
    /// Corrections to the tracked headings, for headings that are not observed.
    pub errors: Vector2<f64>,
    /// Covariance of the geometry and the heading errors.
    pub covariance: Matrix6<f64>,
}

/// Observation at one instant in joint coordinates.
pub(super) struct Row {
    /// Observation minus the value of the geometry for held coordinates, otherwise minus the
    /// prediction.
    pub off: Vector3<f64>,
    /// Jacobian with respect to the geometry and the errors of unobserved headings.
    pub by_state: Matrix3x6<f64>,
    /// Jacobian with respect to the observation.
    pub by_seen: Matrix3<f64>,
    /// Coordinates held by the joint.
    pub held: [bool; 3],
}

impl Fit {
    /// Creates the fit for two objects without a joint.
    pub fn none() -> Self {
        Self::new(JointType::None, Vector4::zeros(), Matrix4::zeros())
    }

    /// Creates the fit of a fixed joint at the relative pose `seen` with covariance `spread`.
    pub fn fixed(seen: &Vector3<f64>, spread: &Matrix3<f64>) -> Self {
        let mut covariance = Matrix4::zeros();
        covariance.fixed_view_mut::<3, 3>(0, 0).copy_from(spread);
        Self::new(JointType::Fixed, seen.push(0.0), covariance)
    }

    /// Creates the fit of a revolute joint near `anchor`, in the frame of the first object. The
    /// standard deviation of either coordinate is `far`, metres.
    pub fn revolute(seen: &Vector3<f64>, spread: &Matrix3<f64>, anchor: Vector, far: f64) -> Self {
        let turn = turn(seen.z);
        let other = turn.transpose() * (anchor - seen.xy());
        // The anchor in the second frame follows from the first anchor and the observation.
        let by_anchor = SMatrix::<f64, 4, 2>::from_fn(|row, column| match row {
            0 | 1 => f64::from(u8::from(row == column)),
            _ => turn[(column, row - 2)],
        });
        let arm = perpendicular(other);
        let by_seen = SMatrix::<f64, 4, 3>::from_fn(|row, column| match (row, column) {
            (0 | 1, _) => 0.0,
            (_, 2) => -arm[row - 2],
            _ => -turn[(column, row - 2)],
        });
        let covariance =
            far * far * by_anchor * by_anchor.transpose() + by_seen * spread * by_seen.transpose();
        let mean = Vector4::new(anchor.x, anchor.y, other.x, other.y);
        Self::new(JointType::Revolute, mean, covariance)
    }

    /// Creates the fit of a prismatic joint near the axis `angle`, in the frame of the first
    /// object. The standard deviation of the angle is `wide`, radians.
    pub fn prismatic(seen: &Vector3<f64>, spread: &Matrix3<f64>, angle: f64, wide: f64) -> Self {
        let (axis, normal) = frame(angle);
        let mean = Vector4::new(angle, normal.dot(&seen.xy()), seen.z, 0.0);
        // At every angle the offset passes through the observation.
        let by_angle = Vector4::new(1.0, -axis.dot(&seen.xy()), 0.0, 0.0);
        let by_seen = SMatrix::<f64, 4, 3>::from_fn(|row, column| match (row, column) {
            (1, 0 | 1) => normal[column],
            (2, 2) => 1.0,
            _ => 0.0,
        });
        let covariance =
            wide * wide * by_angle * by_angle.transpose() + by_seen * spread * by_seen.transpose();
        Self::new(JointType::Prismatic, mean, covariance)
    }

    /// Creates a fit without heading errors: unobserved headings are measured from the tracked
    /// start.
    fn new(kind: JointType, mean: Vector4<f64>, geometry: Matrix4<f64>) -> Self {
        let mut covariance = Matrix6::zeros();
        covariance.fixed_view_mut::<4, 4>(0, 0).copy_from(&geometry);
        Self { kind, mean, errors: Vector2::zeros(), covariance }
    }

    /// Returns the residual of an observation with its Jacobians.
    pub fn read(&self, look: &Look) -> Row {
        let m = &self.mean;
        let identity = Matrix3::identity();
        let Look { seen, predicted, .. } = look;
        let (off, by_geometry, by_seen, held) = match self.kind {
            JointType::None => (seen - predicted, Matrix3x4::zeros(), identity, [false; 3]),
            JointType::Fixed => (seen - m.xyz(), -Matrix3x4::identity(), identity, [true; 3]),
            JointType::Revolute => {
                let turn = turn(seen.z);
                let other = turn * Vector::new(m.z, m.w);
                let held = seen.xy() + other - m.xy();
                let mut by_geometry = -Matrix3x4::identity();
                by_geometry.fixed_view_mut::<2, 2>(0, 2).copy_from(&turn);
                by_geometry[(2, 2)] = 0.0;
                let arm = perpendicular(other);
                let mut by_seen = identity;
                (by_seen[(0, 2)], by_seen[(1, 2)]) = (arm.x, arm.y);
                let off = Vector3::new(held.x, held.y, seen.z - predicted.z);
                (off, by_geometry, by_seen, [true, true, false])
            }
            JointType::Prismatic => {
                let (axis, normal) = frame(m.x);
                let mut by_geometry = Matrix3x4::zeros();
                by_geometry[(0, 0)] = -axis.dot(&seen.xy());
                by_geometry[(0, 1)] = -1.0;
                by_geometry[(2, 2)] = -1.0;
                let off = Vector3::new(
                    normal.dot(&seen.xy()) - m.y,
                    axis.dot(&(seen.xy() - predicted.xy())),
                    seen.z - m.z,
                );
                let by_seen =
                    Matrix3::new(normal.x, normal.y, 0.0, axis.x, axis.y, 0.0, 0.0, 0.0, 1.0);
                (off, by_geometry, by_seen, [true, false, true])
            }
        };
        // Free coordinates are compared with a rollout of equal headings.
        let mut by_errors = by_seen * look.seen_by_errors;
        let rolled = by_seen * look.predicted_by_errors;
        for (k, _) in held.iter().enumerate().filter(|(_, held)| !**held) {
            let mut row = by_errors.row_mut(k);
            row -= rolled.row(k);
        }
        let mut by_state = Matrix3x6::zeros();
        by_state.fixed_columns_mut::<4>(0).copy_from(&by_geometry);
        by_state.fixed_columns_mut::<2>(4).copy_from(&by_errors);
        Row { off, by_state, by_seen, held }
    }

    /// Updates the geometry and the heading errors with a window.
    pub fn learn(&mut self, instants: &[Instant]) {
        let mut before = [0.0f64; 2];
        for now in instants {
            for (k, before) in std::mem::replace(&mut before, now.drift).into_iter().enumerate() {
                if now.headings[k] {
                    let error = now.seen[k].heading - now.rolled[k].heading;
                    self.forget(k, error, now.variance[k][1]);
                } else {
                    let grown = now.drift[k].powi(2) - before.powi(2);
                    self.covariance[(4 + k, 4 + k)] += grown;
                }
            }
            self.correct(&now.look(&self.errors));
        }
    }

    /// Replaces the error of one of the two headings, discarding its correlations.
    pub fn forget(&mut self, which: usize, error: f64, variance: f64) {
        self.errors[which] = error;
        self.covariance.row_mut(4 + which).fill(0.0);
        self.covariance.column_mut(4 + which).fill(0.0);
        self.covariance[(4 + which, 4 + which)] = variance;
    }

    fn correct(&mut self, look: &Look) {
        let row = self.read(look);
        if row.held == [false; 3] {
            return;
        }
        let free = row.held.map(|held| if held { 0.0 } else { 1e6 });
        let noise = row.noise(&look.spread) + Matrix3::from_diagonal(&Vector3::from(free));
        let across = self.covariance * row.by_state.transpose();
        let Some(inverse) = (row.by_state * across + noise).try_inverse() else { return };
        let gain = across * inverse;
        let off =
            row.off.zip_map(&Vector3::from(row.held), |off, held| if held { off } else { 0.0 });
        let change = gain * off;
        self.mean -= change.fixed_rows::<4>(0);
        self.errors -= change.fixed_rows::<2>(4);
        let left = Matrix6::identity() - gain * row.by_state;
        // The Joseph form keeps the matrix positive semidefinite.
        self.covariance =
            left * self.covariance * left.transpose() + gain * noise * gain.transpose();
    }
}

impl Row {
    /// Returns the covariance of observation noise and play in joint coordinates.
    pub fn noise(&self, spread: &Matrix3<f64>) -> Matrix3<f64> {
        let play = |k: usize| match (self.held[k], k) {
            (false, _) => 0.0,
            // The last coordinate of all types is an angle.
            (true, 2) => PLAY[1] * PLAY[1],
            (true, _) => PLAY[0] * PLAY[0],
        };
        let play = Matrix3::from_diagonal(&Vector3::new(play(0), play(1), play(2)));
        self.by_seen * spread * self.by_seen.transpose() + play
    }
}

/// Returns the rotation matrix of an angle.
pub(super) fn turn(angle: f64) -> nalgebra::Matrix2<f64> {
    let (sin, cos) = angle.sin_cos();
    nalgebra::Matrix2::new(cos, -sin, sin, cos)
}

/// Returns the axis and the normal at an angle.
fn frame(angle: f64) -> (Vector, Vector) {
    let axis = Vector::new(angle.cos(), angle.sin());
    (axis, perpendicular(axis))
}
