//! Compound objects: a mug with its handle, a T, a tray with its rim.
//!
//! Every solid is an object of the scene, and fixed joints connect the solids of a compound object,
//! as with the parts of a tool. Models and engines treat connected solids as one rigid body. Users
//! see only the compound object, under the name and at the pose of its first solid. All parts
//! follow after all first solids, so that these keep their indices.

use crate::geometry::{Pose, Vector};

use super::feet::fewer;
use super::raised::{bearings, by_mass};
use super::{
    Feet, Joint, JointKind, Object, ObservedPose, PairFriction, Physics, Scene, State, Support,
    Surface, Whole,
};

impl Scene {
    /// Adds a solid to the object with this index, joined to it at `place` in its frame; `part` has
    /// its own mass.
    ///
    /// ```
    /// use pushplan::{Object, Pose, Scene};
    ///
    /// let mug = Object::cylinder("mug", 0.04, 0.1).mass(0.25).at(0.5, 0.0, 0.0);
    /// let handle = Object::cuboid("mug/handle", [0.03, 0.015, 0.1]).mass(0.05);
    /// let scene = Scene::new([mug]).with_part(0, handle, Pose::new(0.055, 0.0, 0.0));
    /// assert_eq!((scene.mass(0), scene.things().count()), (0.3, 1));
    /// ```
    pub fn with_part(mut self, object: usize, part: Object, place: Pose) -> Self {
        let pose = self.objects[object].pose * place;
        debug_assert!(!self.objects[object].is_part());
        let part = Object { pose, whole: Some(Whole { object, place }), ..part };
        self.joints.push(Joint::new([object, self.objects.len()], JointKind::Fixed));
        self.objects.push(part);
        self
    }

    /// Extends stated frictions of compound objects to all their solids.
    pub fn rubbing_all_over(mut self) -> Self {
        let solids = |thing: usize| std::iter::once(thing).chain(self.parts_of(thing));
        let mut all = Vec::new();
        for pair in &self.frictions {
            let others: Vec<Surface> = match pair.with {
                Surface::Object(other) => solids(other).map(Surface::Object).collect(),
                other => vec![other],
            };
            for object in solids(pair.object) {
                all.extend(others.iter().map(|with| PairFriction { object, with: *with, ..*pair }));
            }
        }
        self.frictions = all;
        self
    }

    /// Returns `true` if the friction of a pair belongs to whole objects, not only to parts.
    pub fn is_of_things(&self, pair: &PairFriction) -> bool {
        let is_part = |object: usize| self.objects[object].is_part();
        !is_part(pair.object) && !matches!(pair.with, Surface::Object(other) if is_part(other))
    }

    /// Returns the objects that are not parts of others, with their indices: single objects and the
    /// first solids of compound objects.
    pub fn things(&self) -> impl Iterator<Item = (usize, &Object)> {
        self.objects.iter().enumerate().filter(|(_, object)| !object.is_part())
    }

    /// Returns the indices of the parts of an object, without the object itself.
    pub fn parts_of(&self, object: usize) -> impl Iterator<Item = usize> {
        let of =
            move |k: &usize| self.objects[*k].whole.is_some_and(|whole| whole.object == object);
        (0..self.objects.len()).filter(of)
    }

    /// Returns the compound object of which object `index` is a part; otherwise `index`.
    pub fn thing(&self, index: usize) -> usize {
        self.objects[index].whole.map_or(index, |whole| whole.object)
    }

    /// Returns the name of the object to which solid `index` belongs.
    pub fn thing_name(&self, index: usize) -> &str {
        &self.objects[self.thing(index)].name
    }

    /// Returns the mass of an object with all its parts, kg.
    pub fn mass(&self, object: usize) -> f64 {
        let parts: f64 = self.parts_of(object).map(|k| self.objects[k].mass).sum();
        self.objects[object].mass + parts
    }

    /// Returns the mass of an object with all its parts, kg, with the masses of `physics`.
    pub fn mass_in(&self, physics: &Physics, object: usize) -> f64 {
        let parts: f64 = self.parts_of(object).map(|k| physics.masses[k]).sum();
        physics.masses[object] + parts
    }

    /// Sets the mass of an object with its parts, kg; the distribution stays.
    pub fn weigh(&mut self, object: usize, mass: f64) {
        let parts: Vec<usize> = self.parts_of(object).collect();
        let heavier = mass / self.mass(object);
        match parts.is_empty() {
            true => self.objects[object].mass = mass,
            false => {
                parts.into_iter().chain([object]).for_each(|k| self.objects[k].mass *= heavier);
            }
        }
    }

    /// Returns the centre of mass of an object with its parts in `state`, metres.
    pub fn centre(&self, object: usize, state: &State) -> Vector {
        // A fast path, because this is called in every frame; parts come last, and most scenes have
        // none.
        if self.objects.last().is_none_or(|last| !last.is_part()) {
            return state.poses[object].position;
        }
        let solids = self.parts_of(object).chain([object]);
        let moments = solids.map(|k| self.objects[k].mass * state.poses[k].position);
        moments.sum::<Vector>() / self.mass(object)
    }

    /// Returns the poses of all solids for these poses of the first solids.
    pub fn with_parts(&self, mut poses: Vec<Pose>) -> Vec<Pose> {
        let parts = self.objects.iter().skip(poses.len()).map_while(|object| object.whole);
        let parts: Vec<Pose> = parts.map(|part| poses[part.object] * part.place).collect();
        poses.extend(parts);
        poses
    }

    /// Returns the observations of all solids for these observations of the first solids; the poses
    /// of parts follow from them.
    pub fn sights_with_parts(
        &self,
        mut seen: Vec<Option<ObservedPose>>,
    ) -> Vec<Option<ObservedPose>> {
        let parts = self.objects.iter().skip(seen.len()).map_while(|object| object.whole);
        let of = |part: Whole| {
            let ObservedPose { position, heading } = seen[part.object]?;
            let pose = Pose { position, heading: heading? } * part.place;
            Some(ObservedPose::new(&pose, true))
        };
        let parts: Vec<Option<ObservedPose>> = parts.map(of).collect();
        seen.extend(parts);
        seen
    }

    /// Moves all parts to the poses that follow from their objects.
    pub fn place_parts(&mut self) {
        for k in 0..self.objects.len() {
            if let Some(Whole { object, place }) = self.objects[k].whole {
                self.objects[k].pose = self.objects[object].pose * place;
            }
        }
    }

    /// Returns the contact points of object `index`, whose support is `feet`, for engines that load
    /// all points of a body alike. Parts get fewer points, see [`fewer`], and parts above the table
    /// none.
    pub fn contacts(&self, index: usize, feet: &Feet, masses: &[f64]) -> Feet {
        if self.objects[index].is_raised() {
            return Feet::none();
        }
        let footprint = self.objects[index].shape.footprint();
        let thing = self.thing(index);
        let solids = self.parts_of(thing).chain([thing]).filter(|&k| !self.objects[k].is_raised());
        let heaviest = solids.map(|k| masses[k]).fold(0.0, f64::max);
        fewer(feet, &footprint, masses[index] / heaviest)
    }

    /// Returns `true` if an object is a compound object or a part of one.
    pub fn is_compound(&self, index: usize) -> bool {
        self.objects[index].is_part() || self.parts_of(index).next().is_some()
    }

    /// Returns the fixed joints that connect the solids of compound objects.
    pub fn seams(&self) -> impl Iterator<Item = Joint> {
        let seam = |(k, object): (usize, &Object)| {
            object.whole.map(|whole| Joint::new([whole.object, k], JointKind::Fixed))
        };
        self.objects.iter().enumerate().filter_map(seam)
    }

    /// Returns `true` if a joint connects solids of one compound object.
    pub fn is_seam(&self, joint: &Joint) -> bool {
        let [a, b] = joint.between;
        let whole = |k: usize| self.objects[k].whole.map(|whole| whole.object);
        joint.kind == JointKind::Fixed && (whole(a) == Some(b) || whole(b) == Some(a))
    }

    /// Returns `true` if two objects are solids of one compound object.
    pub fn same_thing(&self, [a, b]: [usize; 2]) -> bool {
        self.thing(a) == self.thing(b)
    }

    /// Returns `true` if an object has parts above the table, or is such a part.
    pub fn has_raised(&self, object: usize) -> bool {
        // A fast path: parts come last, and most scenes have none.
        self.objects.last().is_some_and(Object::is_part)
            && self.parts_of(self.thing(object)).any(|k| self.objects[k].is_raised())
    }

    /// Returns the points under object `index` and their loads for this support.
    pub fn feet(&self, index: usize, support: &Support) -> Feet {
        let feet = support.feet(&self.objects[index].shape.footprint());
        if !self.has_raised(index) {
            return feet;
        }
        let thing = self.thing(index);
        let solids: Vec<usize> = [thing].into_iter().chain(self.parts_of(thing)).collect();
        let objects: Vec<&Object> = solids.iter().map(|&k| &self.objects[k]).collect();
        let own = solids.iter().position(|&k| k == index);
        // Objects that would fall are not rejected here; readers of files reject them.
        let bearings = bearings(&objects).unwrap_or_else(|| by_mass(&objects));
        own.map_or(feet.clone(), |own| feet.loaded(bearings[own].share, bearings[own].centre))
    }
}
