//! The points on which 3-D objects stand.

use crate::geometry::{Pose, Vector};
use crate::scene::{Feet, Physics, Scene, Support};

use super::Plate;

/// Returns the points on which object `index` stands, in its frame, metres: the corners of an
/// object with feet, or its stated support. Returns `None` for an object that lies on its
/// underside.
pub fn stands_on(scene: &Scene, index: usize, physics: &Physics) -> Option<Vec<Vector>> {
    let plate = Plate::of(scene, index);
    let solids = || scene.parts_of(index).chain([index]);
    let stated = solids().any(|k| scene.objects[k].support != Support::Even);
    if !(stated && plate.has_feet()) {
        return (plate.has_feet() && plate.z > 0.0).then(|| plate.corners().to_vec());
    }
    let points = |k: usize| {
        let place = scene.objects[k].whole.map_or_else(Pose::default, |whole| whole.place);
        let feet = match k == index {
            true => Feet::clone(&physics.feet[k]),
            false => scene.contacts(k, &physics.feet[k], &physics.masses),
        };
        feet.each().map(|(at, _)| place.point(at)).collect::<Vec<_>>()
    };
    Some(solids().flat_map(points).collect())
}
