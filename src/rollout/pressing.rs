//! Detection of objects pressed between the tool and an obstacle.
//!
//! The outcome then depends on quantities that no model of rigid bodies contains: two engines, or
//! one engine at two time steps, place the object differently.

use crate::{
    geometry::Vector,
    scene::{Body, TOUCHING},
};

/// Cosine below which two normals oppose each other; at larger values an object slips out.
const OPPOSED: f64 = -0.5;

/// Contacts of objects in the current frame, and the result.
#[derive(Clone, Debug, Default)]
pub(super) struct Pressing {
    /// Object, part or obstacle, and the unit normal into the object.
    held: Vec<(usize, Body, Vector)>,
    /// The first pressed object, and the two bodies between which it is pressed.
    pub found: Option<(usize, [Body; 2])>,
}

impl Pressing {
    /// Begins a new frame.
    pub fn begin(&mut self) {
        self.held.clear();
    }

    /// Records that `object` penetrates a part or an obstacle by `depth` metres, with `normal`
    /// pointing into the object, while the tool moves by `travel`.
    pub fn touch(&mut self, object: usize, with: Body, depth: f64, normal: Vector, travel: Vector) {
        let comes = match with {
            Body::Part(_) => normal.dot(&travel) > 0.0,
            Body::Obstacle(_) => true,
            Body::Object(_) => false,
        };
        if self.found.is_some() || depth < -TOUCHING || !comes {
            return;
        }
        let is_part = |body: Body| matches!(body, Body::Part(_));
        let other = self.held.iter().find(|(held, body, other)| {
            *held == object && is_part(*body) != is_part(with) && other.dot(&normal) < OPPOSED
        });
        self.found = other.map(|&(_, other, _)| (object, [other, with]));
        self.held.push((object, with, normal));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_comes_from_opposite_sides_presses() {
        let (ahead, back, left) = (Vector::x(), -Vector::x(), Vector::y());
        let (part, wall) = (Body::Part(0), Body::Obstacle(3));
        let after = |touches: &[(usize, Body, f64, Vector)], travel: Vector| {
            let mut pressing = Pressing::default();
            for &(object, with, depth, normal) in touches {
                pressing.touch(object, with, depth, normal, travel);
            }
            pressing.found
        };
        let pressed = [(1, part, 0.0, ahead), (1, wall, 1e-3, back)];
        assert_eq!(after(&pressed, ahead), Some((1, [part, wall])));
        assert_eq!(after(&pressed, back), None, "the tool leaves");
        assert_eq!(after(&[(1, part, 0.0, ahead), (2, wall, 0.0, back)], ahead), None);
        assert_eq!(after(&[(1, part, 0.0, ahead), (1, wall, 0.0, left)], ahead), None, "slides");
        assert_eq!(after(&[(1, part, 0.0, ahead), (1, wall, -1e-3, back)], ahead), None, "not yet");
    }
}
