//! A frame: its awake objects and their motion.

use crate::{
    geometry::{Pose, Turn, Vector},
    scene::State,
    task::FrameStep,
};
use pushplan_kernel::{Motion, SingleBodySolution};

use super::{
    awake::{Awake, View},
    bodies::Bodies,
    free_sliding::coast,
    index::{AwakeIndex, ListIndex},
    pairs::PairId,
    points::{Contact, MARGIN, Scenery, find_contacts},
};

/// Initial state of a frame, and the tool's motion in it.
#[derive(Clone, Copy, Debug)]
pub struct FrameProblem<'a> {
    /// Relevant bodies.
    pub bodies: &'a Bodies,
    /// Poses and velocities of their objects.
    pub state: &'a State,
    /// Motion of the tool.
    pub step: &'a FrameStep,
    /// Unit vector of the tool's motion; the last one while the tool stands still.
    pub axis: Vector,
}

/// Memory of a frame, reused by the next.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    coasts: Vec<Motion>,
    turns: Vec<Turn>,
    pub(super) contacts: Vec<Contact>,
    awake: Awake,
    /// Motions of the awake objects.
    pub(super) motions: Vec<Motion>,
    /// Solution of the kernel, for a frame of a single object.
    pub(super) single: Option<SingleBodySolution>,
}

/// A solved frame.
///
/// Its equations contain only awake objects, which may do more than slide freely. The public fields
/// describe these objects, in the numbering of `bodies`.
#[derive(Clone, Copy, Debug)]
pub struct FrameSolution<'a> {
    /// Awake objects, tool parts and obstacles.
    pub bodies: &'a Bodies,
    /// Initial state of the objects.
    pub state: &'a State,
    /// Motion of the tool.
    pub step: &'a FrameStep,
    /// Unit vector of the tool's motion; the last one while the tool stands still.
    pub axis: Vector,
    /// Motions of the objects in free sliding, without contacts and joints.
    pub coasts: &'a [Motion],
    /// Actual motions of the objects.
    pub motions: &'a [Motion],
    /// Contact points that are closed or may close.
    pub contacts: &'a [Contact],
    all: &'a [Motion],
    awake: &'a Awake,
}

/// Two bodies that touch, or come to touch, in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Id of the pair.
    pub pair: PairId,
    /// Whether the bodies would overlap if the first of them (see [`super::Pairs::bodies`]) only
    /// slid freely, and if the second did; at least one entry is true.
    pub stops: [bool; 2],
    /// Initial penetration, metres; negative before the bodies touch.
    pub depth: f64,
    /// Unit normal, into the first body.
    pub normal: Vector,
}

impl Frame {
    /// Computes free sliding, contacts and awake objects, and gathers the awake objects. Returns
    /// `true` if there are any.
    pub(super) fn wake(&mut self, FrameProblem { bodies, state, step, .. }: FrameProblem) -> bool {
        let Self { coasts, turns, contacts, awake, motions, single } = self;
        *single = None;
        motions.clear();
        coasts.clear();
        let objects = bodies.objects.iter().zip(&state.velocities);
        coasts.extend(objects.map(|(body, velocity)| coast(body, velocity, step.duration)));
        turns.clear();
        turns.extend(state.poses.iter().map(Pose::turn));
        find_contacts(Scenery { bodies, state, step, coasts, turns, margin: MARGIN }, contacts);
        awake.find(bodies, contacts, coasts, step);
        awake.gather(bodies, state, (coasts, turns), contacts)
    }

    /// Returns the awake objects and their surroundings.
    pub(super) fn scenery<'a>(&'a self, problem: FrameProblem<'a>) -> Scenery<'a> {
        let View { bodies, state, coasts, turns } =
            self.awake.view(problem.bodies, problem.state, &self.coasts, &self.turns);
        Scenery { bodies, state, step: problem.step, coasts, turns, margin: MARGIN }
    }

    pub(super) fn solution<'a>(&'a self, problem: FrameProblem<'a>) -> FrameSolution<'a> {
        let Scenery { bodies, state, step, coasts, .. } = self.scenery(problem);
        FrameSolution {
            bodies,
            state,
            step,
            axis: problem.axis,
            coasts,
            motions: &self.motions,
            contacts: &self.contacts,
            all: &self.coasts,
            awake: &self.awake,
        }
    }
}

impl FrameSolution<'_> {
    /// Returns the index of an awake object on the frame's list.
    pub fn listed(&self, object: AwakeIndex) -> ListIndex {
        self.awake.listed(object)
    }

    /// Fills `motions` with the motions of all objects of the frame, awake or not.
    pub fn fill(&self, motions: &mut Vec<Motion>) {
        motions.clear();
        motions.extend_from_slice(self.all);
        for (object, motion) in self.motions.iter().enumerate() {
            motions[self.listed(AwakeIndex(object)).0] = *motion;
        }
    }

    /// Returns the contacts that are closed or close in the frame.
    pub fn touches(&self) -> impl Iterator<Item = Touch> {
        self.contacts.iter().filter_map(|contact| {
            let stops = contact.sides().map(|side| {
                side.is_some_and(|side| {
                    side.overlap(&self.coasts[side.receiver], self.motions) > 0.0
                })
            });
            let Contact { pair, gap, normal, .. } = *contact;
            stops.contains(&true).then_some(Touch { pair, stops, depth: -gap, normal })
        })
    }
}
