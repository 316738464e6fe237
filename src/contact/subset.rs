//! Subsets of bodies, in a numbering of their own.

use std::marker::PhantomData;
use std::sync::Arc;

use crate::scene::State;

use super::{
    bodies::{Bodies, Mounted},
    index::{GroupIndex, Index},
};

/// A subset of bodies in their original order, with their origin. Objects have an index `Outer` in
/// the whole and `Own` in the subset.
///
/// The lists must contain all objects of a mechanism or none.
#[derive(Clone, Debug)]
pub struct Subset<Outer, Own> {
    /// Taken objects; the position in this list is their index in `bodies`.
    pub objects: Vec<Outer>,
    /// Taken parts of the tool.
    pub parts: Vec<usize>,
    /// Taken obstacles.
    pub obstacles: Vec<usize>,
    /// Data of the taken bodies.
    pub bodies: Bodies,
    /// Index in `bodies` of every taken object.
    number: Vec<usize>,
    own: PhantomData<Own>,
}

impl<Outer, Own> Default for Subset<Outer, Own> {
    fn default() -> Self {
        Self {
            objects: Vec::new(),
            parts: Vec::new(),
            obstacles: Vec::new(),
            bodies: Bodies::default(),
            number: Vec::new(),
            own: PhantomData,
        }
    }
}

impl<Outer: Index, Own: Index> Subset<Outer, Own> {
    /// Lists all bodies of `whole`.
    pub fn list_all(&mut self, whole: &Bodies) {
        self.objects.clear();
        self.objects.extend((0..whole.objects.len()).map(Outer::at));
        self.parts.clear();
        self.parts.extend(0..whole.parts.len());
        self.obstacles.clear();
        self.obstacles.extend(0..whole.obstacles.len());
    }

    /// Returns the index in `bodies` of `object`, which must be taken.
    pub fn own(&self, object: Outer) -> Own {
        Own::at(self.number[object.place()])
    }

    /// Returns the outer index of object `own` of `bodies`.
    pub fn outer(&self, own: Own) -> Outer {
        self.objects[own.place()]
    }

    /// Fills `own` with the states of the taken objects.
    pub fn gather_state(&self, whole: &State, own: &mut State) {
        own.poses.clear();
        own.poses.extend(self.objects.iter().map(|k| whole.poses[k.place()]));
        own.velocities.clear();
        own.velocities.extend(self.objects.iter().map(|k| whole.velocities[k.place()]));
    }

    /// Writes the states of the taken objects back into `whole`.
    pub fn return_state(&self, own: &State, whole: &mut State) {
        for (k, object) in self.objects.iter().enumerate() {
            whole.poses[object.place()] = own.poses[k];
            whole.velocities[object.place()] = own.velocities[k];
        }
    }

    /// Fills `bodies` with the listed bodies, reusing its memory.
    pub fn gather(&mut self, whole: &Bodies) {
        let Self { objects, parts, obstacles, bodies, number, .. } = self;
        number.resize(whole.objects.len(), 0);
        objects.iter().enumerate().for_each(|(own, object)| number[object.place()] = own);
        bodies.objects.clear();
        bodies.objects.extend(objects.iter().map(|k| whole.objects[k.place()]));
        bodies.parts.clear();
        bodies.parts.extend(parts.iter().map(|&k| whole.parts[k]));
        bodies.rims = Arc::clone(&whole.rims);
        bodies.feet = Arc::clone(&whole.feet);
        bodies.supports_known = whole.supports_known;
        bodies.push_height_known = whole.push_height_known;
        bodies.frictions = Arc::clone(&whole.frictions);
        bodies.obstacles.clear();
        bodies.obstacles.extend(obstacles.iter().map(|&k| whole.obstacles[k]));
        bodies.mechanisms.clear();
        bodies.mechanisms.extend(objects.iter().map(|k| number[whole.mechanisms[k.place()]]));
        bodies.pairs = whole.pairs;
        bodies.joints.clear();
        let taken = |object: usize| objects.get(number[object]) == Some(&Outer::at(object));
        for joint in whole.joints.iter().filter(|joint| taken(joint.between[0])) {
            let mut own = *joint;
            own.between = joint.between.map(|object| number[object]);
            bodies.joints.push(own);
        }
        bodies.mounts.clear();
        for mount in whole.mounts.iter().filter(|mount| taken(mount.object)) {
            bodies.mounts.push(Mounted { object: number[mount.object], ..*mount });
        }
        let groups = &mut bodies.groups;
        groups.places.clear();
        groups.places.extend(objects.iter().map(|k| whole.groups.places[k.place()]));
        groups.of.clear();
        let mut count = 0;
        for (own, object) in objects.iter().enumerate() {
            let first = whole.groups.members[whole.groups.of[object.place()].0][0];
            if first == object.place() {
                match groups.members.get_mut(count) {
                    Some(members) => members.clear(),
                    None => groups.members.push(Vec::new()),
                }
                groups.of.push(GroupIndex(count));
                count += 1;
            } else {
                groups.of.push(groups.of[number[first]]);
            }
            groups.members[groups.of[own].0].push(own);
        }
        groups.members.truncate(count);
    }
}

#[cfg(test)]
mod tests;
