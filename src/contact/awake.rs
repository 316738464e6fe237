//! Which objects a frame's equations are about: those that may do anything but coast.

use crate::scene::{DisjointSets, FrameStep, State};

use super::{
    bodies::{Bodies, Partner},
    contact::Contact,
    index::{AwakeIndex, ListIndex},
    motion::Motion,
    subset::Subset,
};

/// The objects that are awake in a frame, and memory to look at them by themselves.
///
/// Nothing else enters the equations, so that a prediction cannot depend, not even in its last
/// bit, on what stands elsewhere.
#[derive(Clone, Debug, Default)]
pub(super) struct Awake {
    flags: Vec<bool>,
    /// Whether some of the objects sleep, so that the others are gathered.
    some_sleep: bool,
    /// What touches or is joined.
    sets: DisjointSets,
    subset: Subset<ListIndex, AwakeIndex>,
    state: State,
    coasts: Vec<Motion>,
}

/// Bodies under numbers of their own, with their state and how they would coast.
#[derive(Clone, Copy, Debug)]
pub(super) struct View<'a> {
    pub bodies: &'a Bodies,
    pub state: &'a State,
    pub coasts: &'a [Motion],
}

impl Awake {
    /// Finds those near a moving part, those that move near anything or in a joint, and those in
    /// touch or jointed with such an object.
    pub fn find(
        &mut self,
        bodies: &Bodies,
        contacts: &[Contact],
        coasts: &[Motion],
        step: &FrameStep,
    ) {
        let Self { flags: awake, sets, .. } = self;
        let tool_moves = step.from != step.to;
        let moving = |object: usize| coasts[object] != Motion::default();
        awake.clear();
        awake.resize(coasts.len(), false);
        sets.reset(coasts.len());
        for contact in contacts {
            let pushed = matches!(contact.with, Partner::Part(_)) && tool_moves;
            if pushed || moving(contact.object) {
                awake[contact.object] = true;
            }
            if let Partner::Object(other) = contact.with {
                awake[other] |= moving(other);
                sets.join([contact.object, other]);
            }
        }
        for joint in &bodies.joints {
            sets.join(joint.between);
            for object in joint.between {
                awake[object] |= moving(object);
            }
        }
        // What wakes one wakes all that it hangs together with.
        let lowest = sets.names();
        for object in 0..awake.len() {
            awake[lowest[object]] |= awake[object];
        }
        for object in 0..awake.len() {
            awake[object] = awake[lowest[object]];
        }
    }

    /// Whether nothing is awake.
    pub fn is_empty(&self) -> bool {
        !self.flags.contains(&true)
    }

    /// Takes the objects that are awake by themselves; `contacts` are reduced to theirs.
    pub fn gather(
        &mut self,
        bodies: &Bodies,
        state: &State,
        coasts: &[Motion],
        contacts: &mut Vec<Contact>,
    ) {
        let Self { flags, some_sleep, subset, state: own, coasts: own_coasts, .. } = self;
        *some_sleep = flags.contains(&false);
        if !*some_sleep {
            return;
        }
        contacts.retain(|contact| flags[contact.object]);
        subset.objects.clear();
        subset.objects.extend((0..flags.len()).filter(|&k| flags[k]).map(ListIndex));
        subset.parts.clear();
        subset.parts.extend(0..bodies.parts.len());
        subset.obstacles.clear();
        subset.obstacles.extend(0..bodies.obstacles.len());
        subset.gather(bodies);
        let renumber = |object: &mut usize| *object = subset.own(ListIndex(*object)).0;
        for contact in contacts {
            renumber(&mut contact.object);
            if let Partner::Object(other) = &mut contact.with {
                renumber(other);
            }
        }
        subset.gather_state(state, own);
        own_coasts.clear();
        own_coasts.extend(subset.objects.iter().map(|k| coasts[k.0]));
    }

    /// Those of the given objects that were gathered.
    pub fn view<'a>(
        &'a self,
        bodies: &'a Bodies,
        state: &'a State,
        coasts: &'a [Motion],
    ) -> View<'a> {
        match self.some_sleep {
            true => View { bodies: &self.subset.bodies, state: &self.state, coasts: &self.coasts },
            false => View { bodies, state, coasts },
        }
    }

    /// The number on the list of an object that was gathered.
    pub fn listed(&self, object: AwakeIndex) -> ListIndex {
        if self.some_sleep { self.subset.outer(object) } else { ListIndex(object.0) }
    }
}
