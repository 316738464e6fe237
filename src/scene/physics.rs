//! What is believed about the objects of a scene: masses, frictions, supports
//! and joints.

use std::sync::Arc;

use super::{Feet, Joint, PairFriction, Scene, Support, Surface};

/// Physical parameters under which a motion is played. What computes effects reads these and not
/// what the scene states, so that several beliefs about one scene can be rolled out side by side.
///
/// A tool's friction belongs to the tool.
#[derive(Clone, Debug, PartialEq)]
pub struct Physics {
    /// Mass of every object, kg.
    pub masses: Vec<f64>,
    /// Friction value of every object.
    pub frictions: Vec<f64>,
    /// Friction value of the table.
    pub table_friction: f64,
    /// Frictions of pairs that are not the mean of the two values.
    pub pairs: Vec<PairFriction>,
    /// What every object stands on.
    pub feet: Vec<Arc<Feet>>,
    /// Joints between objects; their anchors, axes and limits are given where the objects stand
    /// at the poses that the scene states.
    pub joints: Vec<Joint>,
}

impl Physics {
    /// Exactly what the scene states.
    pub fn stated(scene: &Scene) -> Self {
        Self {
            masses: scene.objects.iter().map(|object| object.mass).collect(),
            frictions: scene.objects.iter().map(|object| object.friction).collect(),
            table_friction: scene.table_friction,
            pairs: scene.frictions.clone(),
            feet: scene.objects.iter().map(|object| Arc::new(object.feet())).collect(),
            joints: scene.joints.clone(),
        }
    }

    /// Lets all objects rest on the table in another plausible way, in turn for each `draw`.
    ///
    /// Nobody sees the underside of an object; most rest somewhere between even pressure and their
    /// corners. Every fourth draw leaves them as they are believed to be.
    pub fn doubt_supports(&mut self, scene: &Scene, draw: usize) {
        let support = match draw % 4 {
            0 => return,
            1 => Support::Spread(0.75),
            2 => Support::Even,
            _ => Support::Corners,
        };
        for (feet, object) in self.feet.iter_mut().zip(&scene.objects) {
            *feet = Arc::new(Feet::new(&support, &object.shape.footprint()));
        }
    }

    /// Coefficient of friction between object `index` and the table.
    pub fn support_friction(&self, index: usize) -> f64 {
        self.friction(index, Surface::Table, self.table_friction)
    }
}
