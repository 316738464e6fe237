//! Things of several solids: a mug with its handle, a T, a tray with its rim.
//!
//! Every solid is an object of the scene, and those of one thing are joined by fixed joints, as the
//! parts of a tool are. Models and engines make one rigid body of what is joined so; people see the
//! thing alone, under the name and at the pose of its first solid. All parts come after all things, so
//! that these keep their numbers.

use crate::geometry::{Pose, Vector};

use super::feet::fewer;
use super::raised::{bearings, by_mass};
use super::{
    Feet, Joint, JointKind, Object, PairFriction, Physics, Scene, Sight, State, Support, Surface,
    Whole,
};

impl Scene {
    /// The scene in which the object with this index has one more solid, joined to it at `place` in its
    /// frame; `part` has its own mass.
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

    /// The scene in which the frictions that are stated of things are those of all their solids.
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

    /// Whether the friction of a pair is that of things, and not only of parts of theirs.
    pub fn is_of_things(&self, pair: &PairFriction) -> bool {
        let is_part = |object: usize| self.objects[object].is_part();
        !is_part(pair.object) && !matches!(pair.with, Surface::Object(other) if is_part(other))
    }

    /// The objects that are no parts of others, with their indices: what a person would count.
    pub fn things(&self) -> impl Iterator<Item = (usize, &Object)> {
        self.objects.iter().enumerate().filter(|(_, object)| !object.is_part())
    }

    /// The indices of the parts of an object, itself not among them.
    pub fn parts_of(&self, object: usize) -> impl Iterator<Item = usize> {
        let of =
            move |k: &usize| self.objects[*k].whole.is_some_and(|whole| whole.object == object);
        (0..self.objects.len()).filter(of)
    }

    /// The object that number `index` is, or is a part of.
    pub fn thing(&self, index: usize) -> usize {
        self.objects[index].whole.map_or(index, |whole| whole.object)
    }

    /// Mass of an object with all its parts, kg.
    pub fn mass(&self, object: usize) -> f64 {
        let parts: f64 = self.parts_of(object).map(|k| self.objects[k].mass).sum();
        self.objects[object].mass + parts
    }

    /// The same where masses are not as stated, kg.
    pub fn mass_in(&self, physics: &Physics, object: usize) -> f64 {
        let parts: f64 = self.parts_of(object).map(|k| physics.masses[k]).sum();
        physics.masses[object] + parts
    }

    /// Gives an object with its parts this mass, kg, spread over them as before.
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

    /// The centre of mass of an object with its parts where these are in `state`, metres.
    pub fn centre(&self, object: usize, state: &State) -> Vector {
        // This is asked in every frame, and most scenes have no parts, which would come last.
        if self.objects.last().is_none_or(|last| !last.is_part()) {
            return state.poses[object].position;
        }
        let solids = self.parts_of(object).chain([object]);
        let moments = solids.map(|k| self.objects[k].mass * state.poses[k].position);
        moments.sum::<Vector>() / self.mass(object)
    }

    /// Poses of all solids where things are at `poses`.
    pub fn with_parts(&self, mut poses: Vec<Pose>) -> Vec<Pose> {
        let parts = self.objects.iter().skip(poses.len()).map_while(|object| object.whole);
        let parts: Vec<Pose> = parts.map(|part| poses[part.object] * part.place).collect();
        poses.extend(parts);
        poses
    }

    /// What is seen of all solids where `seen` is of things: their parts are where they must be.
    pub fn sights_with_parts(&self, mut seen: Vec<Option<Sight>>) -> Vec<Option<Sight>> {
        let parts = self.objects.iter().skip(seen.len()).map_while(|object| object.whole);
        let of = |part: Whole| {
            let Sight { position, heading } = seen[part.object]?;
            let pose = Pose { position, heading: heading? } * part.place;
            Some(Sight::new(&pose, true))
        };
        let parts: Vec<Option<Sight>> = parts.map(of).collect();
        seen.extend(parts);
        seen
    }

    /// Moves all parts to where their objects are.
    pub fn place_parts(&mut self) {
        for k in 0..self.objects.len() {
            if let Some(Whole { object, place }) = self.objects[k].whole {
                self.objects[k].pose = self.objects[object].pose * place;
            }
        }
    }

    /// The points that object `index` stands on in engines that load all points of a body alike, where
    /// it stands on `feet`: as few as there should be of a part, see [`fewer`], and none of one above
    /// the table.
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

    /// Whether an object is of several solids, or one of these.
    pub fn is_compound(&self, index: usize) -> bool {
        self.objects[index].is_part() || self.parts_of(index).next().is_some()
    }

    /// The joints that make one thing of its solids.
    pub fn seams(&self) -> impl Iterator<Item = Joint> {
        let seam = |(k, object): (usize, &Object)| {
            object.whole.map(|whole| Joint::new([whole.object, k], JointKind::Fixed))
        };
        self.objects.iter().enumerate().filter_map(seam)
    }

    /// Whether a joint is one of these.
    pub fn is_seam(&self, joint: &Joint) -> bool {
        let [a, b] = joint.between;
        let whole = |k: usize| self.objects[k].whole.map(|whole| whole.object);
        joint.kind == JointKind::Fixed && (whole(a) == Some(b) || whole(b) == Some(a))
    }

    /// Whether two objects are solids of one thing.
    pub fn same_thing(&self, [a, b]: [usize; 2]) -> bool {
        self.thing(a) == self.thing(b)
    }

    /// Returns `true` if an object has parts above the table, or is such a part.
    pub fn has_raised(&self, object: usize) -> bool {
        // Most scenes have no parts, which would come last.
        self.objects.last().is_some_and(Object::is_part)
            && self.parts_of(self.thing(object)).any(|k| self.objects[k].is_raised())
    }

    /// The points under object `index`, and what they carry, if it rests on the table in this way.
    pub fn feet(&self, index: usize, support: &Support) -> Feet {
        let feet = support.feet(&self.objects[index].shape.footprint());
        if !self.has_raised(index) {
            return feet;
        }
        let thing = self.thing(index);
        let solids: Vec<usize> = [thing].into_iter().chain(self.parts_of(thing)).collect();
        let objects: Vec<&Object> = solids.iter().map(|&k| &self.objects[k]).collect();
        let own = solids.iter().position(|&k| k == index);
        // What would fall is no fault of those who ask; files with such things are refused.
        let bearings = bearings(&objects).unwrap_or_else(|| by_mass(&objects));
        own.map_or(feet.clone(), |own| feet.loaded(bearings[own].share, bearings[own].centre))
    }
}
