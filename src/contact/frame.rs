//! One frame: what is awake in it, and how that moves.

use crate::{
    geometry::{Pose, Turn, Vector},
    scene::State,
    task::FrameStep,
};
use pushplan_kernel::{LoneSolution, Motion};

use super::{
    awake::{Awake, View},
    bodies::Bodies,
    coast::coast,
    index::{AwakeIndex, ListIndex},
    pairs::PairId,
    points::{Contact, MARGIN, Scenery, find_contacts},
};

/// What a frame begins with, and what the tool does in it.
#[derive(Clone, Copy, Debug)]
pub struct FrameProblem<'a> {
    /// The bodies that matter.
    pub bodies: &'a Bodies,
    /// Where their objects are and how they move.
    pub state: &'a State,
    /// What the tool does.
    pub step: &'a FrameStep,
    /// Unit vector of the tool's motion, the last one while it stands still.
    pub axis: Vector,
}

/// Memory of a frame, which it leaves for the next.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    coasts: Vec<Motion>,
    turns: Vec<Turn>,
    pub(super) contacts: Vec<Contact>,
    awake: Awake,
    /// Of the objects that are awake.
    pub(super) motions: Vec<Motion>,
    /// Its solution, if it is a frame of a lone object.
    pub(super) lone: Option<LoneSolution>,
}

/// A solved frame. Only objects that may do anything but coast enter its equations; everything
/// public here is about those objects, under their numbers in `bodies`.
#[derive(Clone, Copy, Debug)]
pub struct FrameSolution<'a> {
    /// The objects that are awake, the tool's parts and the obstacles.
    pub bodies: &'a Bodies,
    /// The objects' state as the frame begins.
    pub state: &'a State,
    /// What the tool does.
    pub step: &'a FrameStep,
    /// Unit vector of the tool's motion, the last one while it stands still.
    pub axis: Vector,
    /// What the objects would do if nothing touched or held them.
    pub coasts: &'a [Motion],
    /// What they do.
    pub motions: &'a [Motion],
    /// Where bodies touch or may come to.
    pub contacts: &'a [Contact],
    all: &'a [Motion],
    awake: &'a Awake,
}

/// Two bodies that touch, or come to touch, in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// The two.
    pub pair: PairId,
    /// Whether they would overlap if the first of them (see [`super::Pairs::bodies`]) only
    /// coasted, and whether if the second did; one of it at least.
    pub stops: [bool; 2],
    /// How deep they are inside each other as the frame begins, metres; negative before they
    /// touch.
    pub depth: f64,
    /// Unit, into the first.
    pub normal: Vector,
}

impl Frame {
    /// Finds how everything coasts, what touches and what is awake, and takes that by itself;
    /// returns whether anything is.
    pub(super) fn wake(&mut self, FrameProblem { bodies, state, step, .. }: FrameProblem) -> bool {
        let Self { coasts, turns, contacts, awake, motions, lone } = self;
        *lone = None;
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

    /// What is awake, by itself.
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
    /// Which of the frame's objects an object that is awake is.
    pub fn listed(&self, object: AwakeIndex) -> ListIndex {
        self.awake.listed(object)
    }

    /// Fills `motions` with those of all of the frame's objects, awake or not.
    pub fn fill(&self, motions: &mut Vec<Motion>) {
        motions.clear();
        motions.extend_from_slice(self.all);
        for (object, motion) in self.motions.iter().enumerate() {
            motions[self.listed(AwakeIndex(object)).0] = *motion;
        }
    }

    /// What touches, or comes to.
    pub fn touches(&self) -> impl Iterator<Item = Touch> {
        self.contacts.iter().filter_map(|contact| {
            let stops = contact.sights().map(|sight| {
                sight.is_some_and(|sight| {
                    sight.overlap(&self.coasts[sight.receiver], self.motions) > 0.0
                })
            });
            let Contact { pair, gap, normal, .. } = *contact;
            stops.contains(&true).then_some(Touch { pair, stops, depth: -gap, normal })
        })
    }
}
