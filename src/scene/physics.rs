//! Assumed physical parameters of a scene: masses, frictions, supports and joints.

use std::sync::Arc;

use super::{Feet, Joint, Object, PairFriction, Scene, Support, Surface, Tool, pair_friction};

/// Physical parameters of a rollout. Effect models read these instead of the values in the scene,
/// so that a scene can be rolled out with several assumptions side by side.
///
/// The friction value of a tool is stored in the tool.
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
    /// Support points of every object.
    pub feet: Vec<Arc<Feet>>,
    /// Whether the supports are known; otherwise they are one guess of many.
    pub supports_known: bool,
    /// Height at which the tool presses on objects: 0 at the table, 1 at the mean height of the
    /// common face. `None` if flat faces leave it open. With greater height, more of the weight
    /// moves ahead, see [`Self::lean`].
    pub push_height: Option<f64>,
    /// Joints between objects. Anchors, axes and limits refer to the stated poses of the objects.
    pub joints: Vec<Joint>,
}

impl Physics {
    /// Default of [`Self::push_height`]. A flat face can press anywhere on another; this is the
    /// middle.
    pub const PUSH_HEIGHT: f64 = 0.5;

    /// Returns exactly the values that the scene states.
    pub fn stated(scene: &Scene) -> Self {
        Self {
            masses: scene.objects.iter().map(|object| object.mass).collect(),
            frictions: scene.objects.iter().map(|object| object.friction).collect(),
            table_friction: scene.table_friction,
            pairs: scene.frictions.clone(),
            feet: (0..scene.objects.len())
                .map(|k| Arc::new(scene.feet(k, &scene.objects[k].support)))
                .collect(),
            supports_known: true,
            push_height: scene.push_height,
            joints: scene.joints.clone(),
        }
    }

    /// Returns the forward shift of the centre of load of object `index`, metres, while this tool,
    /// `lift` metres above the table, pushes it against full friction.
    ///
    /// A push R at height z must not tip an object of mass m, so its load shifts by z R / (m g).
    pub fn lean(&self, scene: &Scene, index: usize, tool: (&Tool, f64)) -> f64 {
        let [low, middle] = face_height(scene, index, tool);
        let height = low + self.push_height.unwrap_or(Self::PUSH_HEIGHT) * (middle - low);
        height * self.support_friction(index)
    }

    /// Plausible supports of an object: its underside is not visible, but most objects are in this
    /// range.
    pub const PLAUSIBLE_SUPPORTS: [Support; 3] =
        [Support::Spread(0.75), Support::Even, Support::Corners];

    /// Replaces the supports of all objects by another plausible support, in turn for each `draw`;
    /// every fourth draw keeps the believed supports.
    pub fn doubt_supports(&mut self, scene: &Scene, draw: usize) {
        if let Some(support) = Self::doubted(draw) {
            self.support_all(scene, support);
        }
    }

    /// Returns the support of all objects in this draw; `None` if it keeps the believed supports.
    pub fn doubted(draw: usize) -> Option<&'static Support> {
        const SUPPORTS: &[Support] = &Physics::PLAUSIBLE_SUPPORTS;
        (draw % (SUPPORTS.len() + 1)).checked_sub(1).map(|number| &SUPPORTS[number])
    }

    /// Sets the support of all objects.
    pub fn support_all(&mut self, scene: &Scene, support: &Support) {
        (0..scene.objects.len()).for_each(|index| self.support(scene, index, support));
    }

    /// Sets the support of object `index`.
    pub fn support(&mut self, scene: &Scene, index: usize, support: &Support) {
        self.feet[index] = Arc::new(scene.feet(index, support));
    }

    /// Returns the coefficient of friction between an object and a body with this friction `value`.
    pub fn friction(&self, object: usize, with: Surface, value: f64) -> f64 {
        pair_friction(&self.pairs, object, with, [self.frictions[object], value])
    }

    /// Sets the coefficient of friction between an object and another body.
    pub fn with_pair(mut self, object: usize, with: Surface, coefficient: f64) -> Self {
        self.pairs.retain(|pair| !pair.is_of(object, with));
        self.pairs.push(PairFriction { object, with, coefficient });
        self
    }

    /// Returns the coefficient of friction between object `index` and the table.
    pub fn support_friction(&self, index: usize) -> f64 {
        self.friction(index, Surface::Table, self.table_friction)
    }
}

/// Returns two heights for object `index` and a tool `lift` metres above the table, metres: the
/// underside of the touched solid, and the middle of the common face.
///
/// A tool that passes over the standing solids may touch a part above the table; the heights are
/// then at that part. Both are zero if the tool passes over everything.
pub fn face_height(scene: &Scene, index: usize, (tool, lift): (&Tool, f64)) -> [f64; 2] {
    let tallest = tool.outline().iter().map(|piece| piece.shape.height()).fold(0.0, f64::max);
    let of = |object: &Object| {
        let [underside, top] = object.span();
        let (low, top) = (underside.max(lift), top.min(lift + tallest));
        if top > low { [underside, 0.5 * (low + top)] } else { [0.0; 2] }
    };
    let own = of(&scene.objects[index]);
    if own[1] > 0.0 || !scene.has_raised(index) {
        return own;
    }
    let parts = scene.parts_of(scene.thing(index)).map(|k| &scene.objects[k]);
    let raised = parts.filter(|part| part.is_raised()).map(of).find(|face| face[1] > 0.0);
    raised.unwrap_or(own)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_friction_is_symmetric_and_applies_to_its_pair_only() {
        let object = |name: &str| Object::cylinder(name, 0.05, 0.1).friction(0.4);
        let scene = Scene::new([object("a"), object("b"), object("c")]).on_table(0.6);
        let physics = Physics::stated(&scene).with_pair(0, Surface::Object(1), 0.02).with_pair(
            2,
            Surface::Table,
            0.3,
        );
        assert_eq!(physics.friction(0, Surface::Object(1), 0.4), 0.02);
        assert_eq!(physics.friction(1, Surface::Object(0), 0.4), 0.02);
        assert_eq!(physics.friction(0, Surface::Object(2), 0.4), 0.4);
        assert_eq!(physics.friction(1, Surface::Tool, 0.2), 0.5 * (0.4 + 0.2));
        assert_eq!((physics.support_friction(1), physics.support_friction(2)), (0.5, 0.3));
        let again = physics.with_pair(1, Surface::Object(0), 0.1);
        assert_eq!((again.pairs.len(), again.friction(0, Surface::Object(1), 0.4)), (2, 0.1));
    }
}
