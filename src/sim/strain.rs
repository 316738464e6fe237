//! What rigid bodies cannot do, looked for in every time step: objects inside something that does
//! not give way, and the force that the tool needs.
//!
//! Tool and obstacles do not yield, so when the tool travels farther than an object has room, the
//! engines' soft contacts let the object sink into one of them, and in the end through it, at any
//! setting of the solver. On a real table the arm stops, or something breaks. Depth tells the two
//! apart: over 300 solved random tasks no object came into an obstacle at all and none deeper than
//! 0.6 mm into the tool; squeezed through gaps too narrow for them, objects sank at least 2.5 mm
//! into a wall.

use crate::scene::{Body, Force};

use super::drive::World;

/// A force lasts when it is there for this many time steps in a row: a first touch reads m v / dt,
/// 10 N for 0.4 kg at 0.1 m/s, and is over in one or two.
const LASTING: usize = 3;

/// An object inside another body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Overlap {
    pub object: usize,
    pub with: Body,
    /// Metres.
    pub depth: f64,
}

/// Looks at a world after every time step.
#[derive(Debug, Default)]
pub(super) struct Strain {
    /// Overlaps from before anything moved: no fault of the motion, as long as they get no deeper.
    /// Nothing is known before the first step.
    excused: Option<Vec<Overlap>>,
    /// Forces in the last steps, newest first, newtons.
    recent: [f64; LASTING],
    /// The largest forces so far.
    pub force: Force,
}

impl Strain {
    /// The world is built again, from the state it had reached.
    pub fn begin(&mut self) {
        self.excused = None;
        self.recent = [0.0; LASTING];
    }

    /// Looks at the step that was just made; an object that is jammed, if there is one.
    pub fn look<W: World>(&mut self, world: &W) -> Option<Overlap> {
        self.recent.rotate_right(1);
        self.recent[0] = world.force_on_tool();
        let lasting = self.recent.iter().copied().fold(f64::INFINITY, f64::min);
        self.force.peak = self.force.peak.max(self.recent[0]);
        self.force.lasting = self.force.lasting.max(lasting);
        let mut overlaps = Vec::new();
        world.overlaps(&mut |found| {
            if found.depth > found.with.most_overlap() {
                overlaps.push(found);
            }
        });
        // The engines report depths from before the step: the first are those of the start.
        let Some(excused) = &self.excused else {
            self.excused = Some(overlaps);
            return None;
        };
        overlaps.into_iter().find(|found| {
            let same = |known: &&Overlap| known.object == found.object && known.with == found.with;
            let before = excused.iter().find(same).map_or(0.0, |known| known.depth);
            found.depth > before + found.with.most_overlap()
        })
    }
}

/// Tells `found` of bodies `a` and `b`, `depth` metres inside each other: an object
/// and what it is in.
pub(super) fn overlap(a: Body, b: Body, depth: f64, found: &mut dyn FnMut(Overlap)) {
    match (a, b) {
        (Body::Object(object), with) | (with, Body::Object(object)) => {
            found(Overlap { object, with, depth });
        }
        _ => {}
    }
}

/// Force (newtons) from the impulse (newton seconds) that rapier shows after a step of `dt`
/// seconds. It adds up one more than its small steps, so a contact that holds a sliding object
/// reads (n + 1) / n of what it is.
pub(super) fn force(impulse: f64, dt: f64, small_steps: usize) -> f64 {
    let n = small_steps as f64;
    impulse / dt * n / (n + 1.0)
}
