//! What is believed about the objects of a scene: masses, frictions, supports
//! and joints.

use std::sync::Arc;

use super::{Feet, Joint, Object, PairFriction, Scene, Support, Surface, Tool};

/// Physical parameters under which a motion is played. Effect models read these and not what the
/// scene states, so that several beliefs about one scene can be rolled out side by side.
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
    /// Whether that is known, rather than one guess of many.
    pub supports_known: bool,
    /// How high the tool presses on objects, as a share of the mean height of where their faces
    /// meet: 0 at the table, 1 in the middle. `None` where flat faces leave it open. The higher,
    /// the more of the weight moves ahead, see [`Self::lean`].
    pub push_height: Option<f64>,
    /// Joints between objects; their anchors, axes and limits are given where the objects stand
    /// at the poses that the scene states.
    pub joints: Vec<Joint>,
}

impl Physics {
    /// The value of [`Self::push_height`] where none is stated. A flat face can press anywhere on
    /// another; this is the middle.
    pub const PUSH_HEIGHT: f64 = 0.5;

    /// Exactly what the scene states.
    pub fn stated(scene: &Scene) -> Self {
        Self {
            masses: scene.objects.iter().map(|object| object.mass).collect(),
            frictions: scene.objects.iter().map(|object| object.friction).collect(),
            table_friction: scene.table_friction,
            pairs: scene.frictions.clone(),
            feet: scene.objects.iter().map(|object| Arc::new(object.feet())).collect(),
            supports_known: true,
            push_height: scene.push_height,
            joints: scene.joints.clone(),
        }
    }

    /// How far the centre of the load of `object` moves ahead when this tool, `lift` metres above
    /// the table, pushes it as hard as `friction` resists, metres. A push R at height z must not
    /// tip the object of mass m, so its load moves by z R / (m g).
    pub fn lean(&self, object: &Object, friction: f64, (tool, lift): (&Tool, f64)) -> f64 {
        self.push_height.unwrap_or(Self::PUSH_HEIGHT) * face_height(object, (tool, lift)) * friction
    }

    /// What an object may rest on: its underside cannot be seen, but most are somewhere in this
    /// range.
    pub const PLAUSIBLE_SUPPORTS: [Support; 3] =
        [Support::Spread(0.75), Support::Even, Support::Corners];

    /// Lets all objects rest on the table in another plausible way, in turn for each `draw`; every
    /// fourth one leaves them as they are believed to be.
    pub fn doubt_supports(&mut self, scene: &Scene, draw: usize) {
        if let Some(support) = Self::doubted(draw) {
            self.support_all(scene, support);
        }
    }

    /// What objects rest on in this draw, if not as they are believed to.
    pub fn doubted(draw: usize) -> Option<&'static Support> {
        const SUPPORTS: &[Support] = &Physics::PLAUSIBLE_SUPPORTS;
        (draw % (SUPPORTS.len() + 1)).checked_sub(1).map(|number| &SUPPORTS[number])
    }

    /// Lets all objects rest on the table in this way.
    pub fn support_all(&mut self, scene: &Scene, support: &Support) {
        (0..scene.objects.len()).for_each(|index| self.support(scene, index, support));
    }

    /// Lets object `index` rest on the table in this way.
    pub fn support(&mut self, scene: &Scene, index: usize, support: &Support) {
        let footprint = scene.objects[index].shape.footprint();
        self.feet[index] = Arc::new(Feet::new(support, &footprint));
    }

    /// Coefficient of friction between object `index` and the table.
    pub fn support_friction(&self, index: usize) -> f64 {
        self.friction(index, Surface::Table, self.table_friction)
    }
}

/// Mean height of where the faces of an object and a tool `lift` metres above the table meet,
/// metres; zero where the tool passes over it.
pub fn face_height(object: &Object, (tool, lift): (&Tool, f64)) -> f64 {
    let tallest = tool.outline().iter().map(|piece| piece.shape.height()).fold(0.0, f64::max);
    let top = object.shape.height().min(lift + tallest);
    if top > lift { 0.5 * (lift + top) } else { 0.0 }
}
