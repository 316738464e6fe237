//! How far objects are from where they should be.

use pushplan::{
    geometry::{Pose, wrap_angle},
    scene::Scene,
};

/// An object moved if its true position ends farther than this from its start, metres.
pub const MOVED: f64 = 0.01;

/// How far one object is from where it should be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectError {
    /// Distance of the true position from the start, metres.
    pub motion: f64,
    /// Distance of the predicted from the true position, metres; undefined without an answer.
    pub position: f64,
    /// Turn between true and predicted heading, radians, 0 to pi; `None` for cylinders and where
    /// the true heading is not known.
    pub heading: Option<f64>,
}

impl ObjectError {
    /// Whether the object truly moved, by more than [`MOVED`].
    pub fn moved(&self) -> bool {
        self.motion > MOVED
    }

    /// The heading error in degrees.
    pub fn heading_deg(&self) -> Option<f64> {
        self.heading.map(f64::to_degrees)
    }

    /// Whether there is a finite answer.
    pub fn is_known(&self) -> bool {
        self.position.is_finite() && self.heading.is_none_or(f64::is_finite)
    }
}

/// Errors of all objects of `scene`, in their order, from their poses at the start, as predicted
/// and in truth; undefined where nothing was predicted.
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
