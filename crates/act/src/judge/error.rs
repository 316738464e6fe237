//! Pose errors of objects.

use pushplan::{
    geometry::{Pose, wrap_angle},
    scene::Scene,
};

/// Minimum true displacement of an object that counts as moved, metres.
pub const MOVED: f64 = 0.01;

/// Pose error of one object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectError {
    /// Distance of the true position from the start, metres.
    pub motion: f64,
    /// Distance from the true to the predicted position, metres; undefined without a prediction.
    pub position: f64,
    /// Absolute heading error, radians, 0 to pi; `None` for cylinders and if the true heading is
    /// unknown.
    pub heading: Option<f64>,
}

impl ObjectError {
    /// Returns `true` if the true displacement exceeds [`MOVED`].
    pub fn moved(&self) -> bool {
        self.motion > MOVED
    }

    /// Returns the heading error in degrees.
    pub fn heading_deg(&self) -> Option<f64> {
        self.heading.map(f64::to_degrees)
    }

    /// Returns `true` if the errors are finite.
    pub fn is_known(&self) -> bool {
        self.position.is_finite() && self.heading.is_none_or(f64::is_finite)
    }
}

/// Returns the errors of all objects of `scene`, in their order; undefined without a prediction.
/// The arguments are the poses at the start, as predicted, and in truth.
pub fn object_errors(
    scene: &Scene,
    start: &[Pose],
    predicted: Option<&[Pose]>,
    truth: &[Pose],
) -> Vec<ObjectError> {
    (0..scene.objects.len())
        .map(|k| {
            let (from, to) = (start[k], truth[k]);
            let apart = predicted.map(|poses| {
                let guess = poses[k];
                let turned = wrap_angle(guess.heading - to.heading).abs();
                ((guess.position - to.position).norm(), turned)
            });
            let (position, turned) = apart.unwrap_or((f64::NAN, f64::NAN));
            let turns = !scene.objects[k].shape.is_cylinder();
            ObjectError {
                motion: (to.position - from.position).norm(),
                position,
                heading: turns.then_some(turned),
            }
        })
        .collect()
}
