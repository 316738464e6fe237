//! Where a joint holds two objects, as far as was seen: a Gaussian over its geometry and the errors of
//! unseen headings, and what was seen in the joint's own coordinates.
//!
//! With the pose (r, h) of the second object in the frame of the first, R a turn by h:
//!
//! | type | geometry | held | free |
//! |---|---|---|---|
//! | none | | | r, h |
//! | fixed | r0, h0 | r - r0, h - h0 | |
//! | revolute | anchor c in the first frame, d in the second | r + R d - c | h |
//! | prismatic | angle p of the axis u in the first frame, offset o, h0 | n.r - o, h - h0 | u.r |
//!
//! The change to these coordinates keeps volumes, so densities in them compare between types. What
//! is held follows a Kalman filter, extended for the axis. Its state also has the errors of the two
//! headings where these are not seen: they are then rolled out under this type of joint, drift a
//! little in every window, and are corrected by what the joint holds, be it a heading held against
//! another unseen one.

use nalgebra::{
    Matrix3, Matrix3x4, Matrix3x6, Matrix4, Matrix6, SMatrix, Vector2, Vector3, Vector4,
};

use pushplan::geometry::{Vector, perpendicular};

use super::{
    pair::JointType,
    window::{Instant, Look},
};

/// Play of joints, as standard deviations: metres and radians. Real joints have some, and
/// simulated ones drift.
const PLAY: [f64; 2] = [1.2e-4, 2e-3];

/// A Gaussian over the geometry of a joint of some type and the errors of unseen headings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fit {
    pub kind: JointType,
    /// Numbers of the geometry, see the table above; unused ones are zero.
    pub mean: Vector4<f64>,
    /// Of headings that are not seen: what to add to those that are tracked.
    pub errors: Vector2<f64>,
    /// Of the geometry and these errors.
    pub covariance: Matrix6<f64>,
}

/// What was seen at one instant in a joint's own coordinates.
pub(super) struct Row {
    /// What was seen minus what the geometry, where it holds, or else the model says.
    pub off: Vector3<f64>,
    /// How it changes with the numbers of the geometry and the errors of unseen headings.
    pub by_state: Matrix3x6<f64>,
    /// How it changes with what was seen.
    pub by_seen: Matrix3<f64>,
    /// Which coordinates the joint holds.
    pub held: [bool; 3],
}

impl Fit {
    /// Of two objects that are not joined.
    pub fn none() -> Self {
        Self::new(JointType::None, Vector4::zeros(), Matrix4::zeros())
    }

    /// Of two that hold each other as they were `seen` with this `spread`.
    pub fn fixed(seen: &Vector3<f64>, spread: &Matrix3<f64>) -> Self {
        let mut covariance = Matrix4::zeros();
        covariance.fixed_view_mut::<3, 3>(0, 0).copy_from(spread);
        Self::new(JointType::Fixed, seen.push(0.0), covariance)
    }

    /// Of two that turn about a point somewhere around `anchor`, in the frame of the first, with
    /// the standard deviation `far` of either coordinate, metres.
    pub fn revolute(seen: &Vector3<f64>, spread: &Matrix3<f64>, anchor: Vector, far: f64) -> Self {
        let turn = turn(seen.z);
        let other = turn.transpose() * (anchor - seen.xy());
        // The second frame's anchor follows from the first's and what was seen.
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

    /// Of two that slide along an axis with about this `angle` in the frame of the first, `wide`
    /// its standard deviation, radians.
    pub fn prismatic(seen: &Vector3<f64>, spread: &Matrix3<f64>, angle: f64, wide: f64) -> Self {
        let (axis, normal) = frame(angle);
        let mean = Vector4::new(angle, normal.dot(&seen.xy()), seen.z, 0.0);
        // The offset is that of what was seen at any angle.
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

    /// Unseen headings are counted from how they are tracked at the start, so they have no errors.
    fn new(kind: JointType, mean: Vector4<f64>, geometry: Matrix4<f64>) -> Self {
        let mut covariance = Matrix6::zeros();
        covariance.fixed_view_mut::<4, 4>(0, 0).copy_from(&geometry);
        Self { kind, mean, errors: Vector2::zeros(), covariance }
    }

    /// What was seen at an instant.
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
        // What is free is compared with a rollout of the same headings.
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

    /// Takes what was seen in a window into the geometry and the errors of unseen headings.
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

    /// The heading of one of the two has this error, whatever was thought before.
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
        // Joseph's form, which stays a covariance.
        self.covariance =
            left * self.covariance * left.transpose() + gain * noise * gain.transpose();
    }
}

impl Row {
    /// Covariance of errors of what was seen, and play, in these coordinates.
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

/// A turn by an angle.
pub(super) fn turn(angle: f64) -> nalgebra::Matrix2<f64> {
    let (sin, cos) = angle.sin_cos();
    nalgebra::Matrix2::new(cos, -sin, sin, cos)
}

/// Axis and normal at an angle.
fn frame(angle: f64) -> (Vector, Vector) {
    let axis = Vector::new(angle.cos(), angle.sin());
    (axis, perpendicular(axis))
}
