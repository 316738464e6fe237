//! The scene of spatial motions, in reality and as planned.

use std::sync::Arc;

use crate::geometry::{Pose3, Vector};
use crate::scene::{Body, Physics, Plate, Scene, Situation, Weight, stands_on};
use crate::task::LeverJob;

/// The real scene, the objects as observed when the motions were planned, and the real poses of the
/// objects.
pub(super) struct Scenery {
    /// Scene on the table. Plates of data sets cannot be stated in a scene, so theirs has none.
    pub scene: Arc<Scene>,
    pub physics: Arc<Physics>,
    /// Objects with all their solids, with their real masses and frictions.
    pub plates: Vec<Plate>,
    pub planned: Vec<Plate>,
    pub starts: Vec<Pose3>,
}

impl Scenery {
    /// Takes a real scene; the motions follow the poses of `planned`.
    pub fn new(really: &Situation, planned: &Scene) -> Self {
        let Situation { scene, start, physics } = really;
        let plate = |(k, _): (usize, _)| Plate {
            mass: scene.mass_in(physics, k),
            friction: physics.frictions[k],
            ..Plate::of(scene, k)
        };
        let plates: Vec<Plate> = scene.things().map(plate).collect();
        let starts = match &start.space {
            Some(space) => space.clone(),
            None => {
                let stands = plates.iter().zip(&start.poses);
                stands.map(|(plate, pose)| Pose3::upright(*pose, plate.z)).collect()
            }
        };
        let (scene, physics) = (Arc::clone(scene), Arc::clone(physics));
        Self { scene, physics, plates, planned: planned.plates().collect(), starts }
    }

    /// Takes the plates of a job of a data set.
    pub fn of_job(job: &LeverJob) -> Self {
        let plates = job.scene.plates.clone();
        let scene = Scene {
            table_friction: job.scene.table_friction,
            obstacles: job.scene.blocks.clone(),
            ..Scene::default()
        };
        let starts = plates.iter().map(Plate::start).collect();
        let (planned, physics) = (plates.clone(), Arc::new(Physics::stated(&scene)));
        Self { scene: Arc::new(scene), physics, plates, planned, starts }
    }

    /// Returns the index of a solid of an object into the objects of the scene.
    fn solid(&self, plate: usize, slab: usize) -> usize {
        match slab.checked_sub(1) {
            Some(part) => self.scene.parts_of(plate).nth(part).unwrap_or(plate),
            None => plate,
        }
    }

    /// Returns the body of a solid of an object in the rules of contacts, and its friction value.
    pub fn surface(&self, plate: usize, slab: usize) -> (Body, f64) {
        let solid = self.solid(plate, slab);
        let own = self.physics.frictions.get(solid).copied();
        (Body::Object(solid), own.unwrap_or(self.plates[plate].friction))
    }

    /// Returns the mass distribution of an object.
    pub fn weight(&self, plate: usize) -> Weight {
        let (own, masses) = (&self.plates[plate], &self.physics.masses);
        let masses: Option<Vec<f64>> =
            (0..own.slabs.len()).map(|slab| masses.get(self.solid(plate, slab)).copied()).collect();
        masses.map_or_else(|| own.weight(), |masses| own.weight_of(&masses))
    }

    /// Returns the points on which an object stands, in its frame, see [`stands_on`].
    pub fn stands_on(&self, plate: usize) -> Option<Vec<Vector>> {
        if plate < self.scene.objects.len() {
            return stands_on(&self.scene, plate, &self.physics);
        }
        let own = &self.plates[plate];
        (own.has_feet() && own.z > 0.0).then(|| own.corners().to_vec())
    }
}
