//! Parts of things above the table, as the handle of a pot is: what passes below them, and what carries
//! their weight.

use crate::geometry::{Pose, Vector, clearance};

use super::balance::balanced;
use super::{Feet, JOIN_GAP, Object, Scene, Support};

/// What the points under a solid carry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bearing {
    /// As a share of the solid's own weight; nothing of a part above the table.
    pub share: f64,
    /// Where the centre of the load is in the solid's frame, metres.
    pub centre: Vector,
}

impl Object {
    /// A part with its underside this high above that of its object, metres.
    ///
    /// ```
    /// use pushplan::{Object, Pose, Scene};
    ///
    /// let pot = Object::cylinder("pot", 0.08, 0.1).mass(0.9);
    /// let handle = Object::cuboid("pot/handle", [0.05, 0.06, 0.02]).mass(0.1).raised(0.06);
    /// let scene = Scene::new([pot]).with_part(0, handle, Pose::new(0.1, 0.0, 0.0));
    /// assert!(scene.objects[1].meets([0.002, 0.07]) && !scene.objects[1].meets([0.002, 0.05]));
    /// ```
    pub fn raised(self, z: f64) -> Self {
        Self { z, ..self }
    }

    /// Whether it is a part above the table.
    pub fn is_raised(&self) -> bool {
        self.is_part() && self.z > 0.0
    }

    /// Heights above the table between which it is while its object stands there, metres.
    pub fn span(&self) -> [f64; 2] {
        let low = if self.is_raised() { self.z } else { 0.0 };
        [low, low + self.shape.height()]
    }

    /// Height of its top above the table, metres: what comes from above must be clear of it.
    pub fn top(&self) -> f64 {
        self.span()[1]
    }

    /// Height of its middle above the table, metres.
    pub fn middle(&self) -> f64 {
        self.span()[0] + self.shape.height() / 2.0
    }

    /// Whether what is between these two heights above the table is as high as some of it.
    pub fn meets(&self, [low, high]: [f64; 2]) -> bool {
        let [underside, top] = self.span();
        low < top && underside < high
    }
}

impl Scene {
    /// Whether an object has parts above the table, or is such a part.
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

/// The solids of a thing that nothing holds: above the table, and not in touch with what stands there or
/// is held by it.
pub fn hanging(solids: &[Object]) -> Vec<usize> {
    let touch = |a: &Object, b: &Object| {
        let [one, other] = [a, b].map(|solid| (solid.shape.footprint(), solid.pose));
        let gap = clearance((&one.0, &one.1), (&other.0, &other.1), 2.0 * JOIN_GAP);
        let [low, high] = a.span();
        gap <= JOIN_GAP && b.meets([low - JOIN_GAP, high + JOIN_GAP])
    };
    let (mut held, mut hanging): (Vec<usize>, Vec<usize>) =
        (0..solids.len()).partition(|&k| !solids[k].is_raised());
    let mut next = 0;
    while let Some(&holds) = held.get(next) {
        let (more, left) =
            hanging.into_iter().partition::<Vec<_>, _>(|&k| touch(&solids[k], &solids[holds]));
        held.extend(more);
        hanging = left;
        next += 1;
    }
    hanging
}

/// What every solid of a thing carries, so that its weight is carried below its centre of mass; `None`
/// where what stands cannot.
pub fn bearings(solids: &[&Object]) -> Option<Vec<Bearing>> {
    let place = |object: &Object| object.whole.map_or(Pose::default(), |whole| whole.place);
    let mass: f64 = solids.iter().map(|solid| solid.mass).sum();
    let moment = |solid: &&Object| solid.mass * place(solid).position;
    let centre = solids.iter().map(moment).sum::<Vector>() / mass;
    let feet: Vec<Feet> = solids.iter().map(|solid| solid.feet()).collect();
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    let stands = |solid: &Object| !solid.is_raised();
    for (solid, feet) in solids.iter().zip(&feet).filter(|(solid, _)| stands(solid)) {
        points.extend(feet.each().map(|(at, _)| place(solid).point(at) - centre));
        weights.extend(feet.each().map(|(_, load)| solid.mass / mass * load));
    }
    let mut loads = balanced(&points, &weights)?.into_iter();
    let bearing = |(solid, feet): (&&Object, &Feet)| {
        let count = if stands(solid) { feet.count } else { 0 };
        let own: Vec<(Vector, f64)> =
            feet.each().map(|(at, _)| at).zip(loads.by_ref().take(count)).collect();
        let load: f64 = own.iter().map(|(_, load)| load).sum();
        let moment: Vector = own.iter().map(|(at, load)| *load * at).sum();
        let centre = if load > 0.0 { moment / load } else { Vector::zeros() };
        Bearing { share: load * mass / solid.mass, centre }
    };
    Some(solids.iter().zip(&feet).map(bearing).collect())
}

/// The weight of what is above the table on what stands, by mass.
fn by_mass(solids: &[&Object]) -> Vec<Bearing> {
    let sum = |raised: bool| -> f64 {
        let those = solids.iter().filter(|solid| raised || !solid.is_raised());
        those.map(|solid| solid.mass).sum()
    };
    let share = sum(true) / sum(false);
    let of = |solid: &&Object| if solid.is_raised() { 0.0 } else { share };
    let bearing = |solid| Bearing { share: of(solid), centre: Vector::zeros() };
    solids.iter().map(bearing).collect()
}
