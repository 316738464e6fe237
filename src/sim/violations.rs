//! Violations of rigidity, checked in every time step: overlaps with bodies that do not yield, the
//! force that the tool needs, and the force on fragile objects.
//!
//! Tool and obstacles do not yield. If the tool travels farther than an object has room, the
//! engines' soft contacts let the object sink into one of them. Finally the object passes through,
//! at any setting of the solver. On a real table the arm stops, or something breaks. The depth
//! separates the two cases. Over 300 solved random tasks no object entered an obstacle at all, and
//! none was deeper than 0.6 mm in the tool. Squeezed through gaps that are too narrow, objects sank
//! at least 2.5 mm into a wall.
//!
//! Rounded bodies pass gaps that are narrower by less than twice that, without becoming any
//! thinner. An object inside two facing obstacles is therefore jammed at any depth.

use crate::geometry::Vector;
use crate::{
    outcome::{Force, Warning},
    scene::{Body, Scene},
};

use super::world::World;

/// Number of consecutive time steps after which a force counts as lasting. A first touch reads m v
/// / dt, 10 N for 0.4 kg at 0.1 m/s, and ends after one or two.
const LASTING: usize = 3;

/// Sum of overlaps with two facing obstacles from which on an object is jammed, metres: their gap
/// is narrower than the object by that.
const SQUEEZED: f64 = 1.5e-4;

/// Cosine between the outward directions of two obstacles below which they face each other.
const FACING: f64 = -0.5;

/// An object inside another body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Overlap {
    pub object: usize,
    pub with: Body,
    /// Depth, metres.
    pub depth: f64,
    /// Direction in which the object would leave the body, a unit vector seen from above; zero for
    /// upwards.
    pub out: Vector,
}

/// A check of a world after every time step.
#[derive(Debug, Default)]
pub(super) struct Violations {
    /// Overlaps before any motion, which are excused as long as they do not deepen; `None` before
    /// the first step.
    excused: Option<Vec<Overlap>>,
    /// Whether no overlap is excused.
    strict: bool,
    /// Force of the tool on all objects together.
    all: Pressed,
    /// Forces on fragile objects, each with the indices of its solids, its own first.
    fragile: Vec<(Vec<usize>, Pressed)>,
}

/// A force over time.
#[derive(Debug, Default)]
struct Pressed {
    /// Forces in the last steps, newest first, newtons.
    recent: [f64; LASTING],
    /// The largest forces so far.
    force: Force,
}

impl Pressed {
    fn note(&mut self, force: f64) {
        self.recent.rotate_right(1);
        self.recent[0] = force;
        let lasting = self.recent.iter().copied().fold(f64::INFINITY, f64::min);
        self.force.peak = self.force.peak.max(force);
        self.force.lasting = self.force.lasting.max(lasting);
    }
}

impl Violations {
    /// Creates the check of a motion in `scene`. A `strict` check excuses nothing, because the
    /// motion then begins in a state that rigid bodies can have.
    pub fn new(scene: &Scene, strict: bool) -> Self {
        let fragile = scene.things().filter(|(_, object)| object.max_force.is_some());
        let solids = |k: usize| std::iter::once(k).chain(scene.parts_of(k)).collect();
        let fragile = fragile.map(|(k, _)| (solids(k), Pressed::default())).collect();
        Self { strict, fragile, ..Self::default() }
    }

    /// Returns the largest forces of the tool so far.
    pub fn force(&self) -> Force {
        self.all.force
    }

    /// Returns warnings about objects that the tool has pressed harder than allowed.
    pub fn too_hard<'a>(&'a self, scene: &'a Scene) -> impl Iterator<Item = Warning> + 'a {
        self.fragile.iter().filter_map(|(solids, pressed)| {
            let object = scene.objects.get(*solids.first()?)?;
            let (needed, limit) = (pressed.force.lasting, object.max_force?);
            let object = Some(object.name.clone());
            (needed > limit).then_some(Warning::TooMuchForce { object, needed, limit })
        })
    }

    /// Restarts the check after the world was rebuilt from its state.
    pub fn begin(&mut self) {
        self.excused = None;
        let fragile = self.fragile.iter_mut().map(|(_, pressed)| pressed);
        fragile.chain([&mut self.all]).for_each(|pressed| pressed.recent = [0.0; LASTING]);
    }

    /// Notes the forces of the last step: `force` returns the force on the tool of the objects that
    /// its argument selects, newtons.
    pub fn press(&mut self, force: impl Fn(&dyn Fn(usize) -> bool) -> f64) {
        self.all.note(force(&|_| true));
        for (solids, pressed) in &mut self.fragile {
            pressed.note(force(&|object| solids.contains(&object)));
        }
    }

    /// Checks the last step; returns a jammed object, if there is one.
    pub fn look<W: World>(&mut self, world: &W) -> Option<Overlap> {
        self.press(|of| world.force_on_tool(of));
        let mut overlaps = Vec::new();
        world.overlaps(&mut |found| overlaps.push(found));
        // The engines report depths before the step, so the first ones belong to the start.
        let Some(excused) = &self.excused else {
            self.excused = Some(if self.strict { Vec::new() } else { overlaps });
            return None;
        };
        let deep = overlaps.iter().copied().find(|found| {
            let same = |known: &&Overlap| known.object == found.object && known.with == found.with;
            // A mere touch at the start excuses nothing.
            let touch = found.with.most_overlap();
            let before = excused.iter().filter(same).map(|known| known.depth).find(|d| *d > touch);
            found.depth > before.unwrap_or(0.0) + touch
        });
        let squeezed = || {
            let found = squeezed(&overlaps)?;
            let before = squeezed_of(excused, found.object).map_or(0.0, |known| known.depth);
            (found.depth > before + SQUEEZED).then_some(found)
        };
        deep.or_else(squeezed)
    }
}

/// Returns the object that is deepest inside two facing obstacles, if any, with the sum of both
/// depths.
fn squeezed(overlaps: &[Overlap]) -> Option<Overlap> {
    let all = overlaps.iter().filter_map(|one| squeezed_of(overlaps, one.object));
    all.max_by(|a, b| a.depth.total_cmp(&b.depth))
}

fn squeezed_of(overlaps: &[Overlap], object: usize) -> Option<Overlap> {
    let fixed = |one: &&Overlap| one.object == object && matches!(one.with, Body::Obstacle(_));
    let own = overlaps.iter().filter(fixed);
    let pairs = own.clone().flat_map(|one| own.clone().map(move |other| (one, other)));
    let facing = pairs.filter(|(one, other)| one.out.dot(&other.out) < FACING);
    let sums = facing.map(|(one, other)| Overlap { depth: one.depth + other.depth, ..*one });
    sums.max_by(|a, b| a.depth.total_cmp(&b.depth))
}

/// Calls `found` with the overlap of bodies `a` and `b`, `depth` metres inside each other, for each
/// object. `normal` points from `a` to `b`, seen from above.
pub(super) fn overlap(
    (a, b): (Body, Body),
    depth: f64,
    normal: Vector,
    found: &mut dyn FnMut(Overlap),
) {
    match (a, b) {
        (Body::Object(object), with) => found(Overlap { object, with, depth, out: -normal }),
        (with, Body::Object(object)) => found(Overlap { object, with, depth, out: normal }),
        _ => {}
    }
}

/// Returns the force (newtons) for the impulse (newton seconds) that rapier reports after a step of
/// `dt` seconds.
///
/// The reported impulse includes one solver iteration too many, so the contact of a sliding object
/// reads (n + 1) / n of its true value.
pub(super) fn force(impulse: f64, dt: f64, small_steps: usize) -> f64 {
    let n = small_steps as f64;
    impulse / dt * n / (n + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_between_two_walls_are_squeezed_and_objects_in_a_corner_are_not() {
        let inside = |wall: usize, depth: f64, out: Vector| Overlap {
            object: 0,
            with: Body::Obstacle(wall),
            depth,
            out,
        };
        let gap = [inside(0, 2e-4, Vector::y()), inside(1, 1e-4, -Vector::y())];
        let found = squeezed(&gap).expect("it is too narrow");
        assert!((found.depth - 3e-4).abs() < 1e-12);
        let corner = [inside(0, 2e-4, Vector::y()), inside(1, 1e-4, Vector::x())];
        assert_eq!(squeezed(&corner), None);
        let pushed = Overlap { with: Body::Part(0), ..inside(1, 1e-4, -Vector::y()) };
        assert_eq!(squeezed(&[inside(0, 2e-4, Vector::y()), pushed]), None);
    }
}
