//! Persistent identifiers of pairs of bodies.
//!
//! The listed, awake and touching bodies change from frame to frame, and so do all indices derived
//! from them. Data kept about a pair over time are therefore stored under its id.

use crate::scene::Body;

use super::index::SceneIndex;

/// Identifier of a pair of an object and another body of one scene and tool, constant over frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PairId(u32);

/// Numbering of all pairs of a scene with a tool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pairs {
    objects: usize,
    obstacles: usize,
    parts: usize,
}

impl Pairs {
    /// Creates the numbering for a scene with these numbers of objects and obstacles, and a tool
    /// with this number of parts.
    pub fn new(objects: usize, obstacles: usize, parts: usize) -> Self {
        Self { objects, obstacles, parts }
    }

    /// Returns the pair of `object` and `with`; two objects may be in either order.
    pub fn id(&self, object: SceneIndex, with: Body) -> PairId {
        let (row, column) = match with {
            Body::Object(other) => (object.0.min(other), object.0.max(other)),
            Body::Obstacle(index) => (object.0, self.objects + index),
            Body::Part(index) => (object.0, self.objects + self.obstacles + index),
        };
        PairId((row * self.columns() + column) as u32)
    }

    /// Returns the two bodies of a pair, for two objects the lower index first.
    pub fn bodies(&self, pair: PairId) -> (SceneIndex, Body) {
        let (row, column) = (pair.0 as usize / self.columns(), pair.0 as usize % self.columns());
        let with = if column < self.objects {
            Body::Object(column)
        } else if column < self.objects + self.obstacles {
            Body::Obstacle(column - self.objects)
        } else {
            Body::Part(column - self.objects - self.obstacles)
        };
        (SceneIndex(row), with)
    }

    /// Returns the number of columns: one for every body. Each object has a row, and pairs of
    /// objects lie above the diagonal.
    fn columns(&self) -> usize {
        self.objects + self.obstacles + self.parts
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn every_pair_has_one_id_and_every_id_one_pair() {
        let pairs = Pairs::new(4, 2, 3);
        let mut ids = HashSet::new();
        for object in (0..4).map(SceneIndex) {
            let others = (object.0 + 1..4).map(Body::Object);
            let given = (0..2).map(Body::Obstacle).chain((0..3).map(Body::Part));
            for with in others.chain(given) {
                let id = pairs.id(object, with);
                assert!(ids.insert(id), "{object:?} {with:?}");
                assert_eq!(pairs.bodies(id), (object, with));
                if let Body::Object(other) = with {
                    assert_eq!(pairs.id(SceneIndex(other), Body::Object(object.0)), id);
                }
            }
        }
        assert_eq!(ids.len(), 6 + 4 * 5);
    }
}
