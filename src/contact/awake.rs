//! Selection of the objects in a frame's equations: those that may do more than slide freely.

use crate::{
    geometry::Turn,
    scene::{DisjointSets, State},
    task::FrameStep,
};
use pushplan_kernel::Motion;

use super::{
    bodies::{Bodies, Partner},
    index::{AwakeIndex, ListIndex},
    points::Contact,
    subset::Subset,
};

/// The awake objects of a frame, gathered as bodies of their own.
///
/// Other objects do not enter the equations, so that a prediction cannot depend on distant objects,
/// not even in its last bit.
#[derive(Clone, Debug, Default)]
pub(super) struct Awake {
    flags: Vec<bool>,
    share: Share,
    /// Connected sets of objects that touch or are joined.
    sets: DisjointSets,
    subset: Subset<ListIndex, AwakeIndex>,
    state: State,
    coasts: Vec<Motion>,
    turns: Vec<Turn>,
    /// Empty data for frames without awake objects.
    nothing: (Bodies, State),
}

/// Share of the objects that is awake.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Share {
    #[default]
    None,
    /// Awake objects are gathered.
    Some,
    All,
}

/// Bodies in their own numbering, with state, free sliding and rotations.
#[derive(Clone, Copy, Debug)]
pub(super) struct View<'a> {
    pub bodies: &'a Bodies,
    pub state: &'a State,
    pub coasts: &'a [Motion],
    pub turns: &'a [Turn],
}

impl Awake {
    /// Finds the awake objects: objects near a moving part, moving objects near another body or in
    /// a joint, and objects in contact or jointed with an awake one.
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
        for mount in &bodies.mounts {
            awake[mount.object] |= moving(mount.object);
        }
        // An awake object wakes all objects connected with it.
        let lowest = sets.names();
        for object in 0..awake.len() {
            awake[lowest[object]] |= awake[object];
        }
        for object in 0..awake.len() {
            awake[object] = awake[lowest[object]];
        }
    }

    /// Gathers the awake objects and reduces `contacts` to theirs; returns `true` if there are any.
    pub fn gather(
        &mut self,
        bodies: &Bodies,
        state: &State,
        (coasts, turns): (&[Motion], &[Turn]),
        contacts: &mut Vec<Contact>,
    ) -> bool {
        let Self { flags, share, subset, state: own, coasts: own_coasts, turns: own_turns, .. } =
            self;
        *share = match (flags.contains(&true), flags.contains(&false)) {
            (false, _) => Share::None,
            (true, true) => Share::Some,
            (true, false) => Share::All,
        };
        match share {
            Share::None => {
                contacts.clear();
                return false;
            }
            Share::All => return true,
            Share::Some => {}
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
        own_turns.clear();
        own_turns.extend(subset.objects.iter().map(|k| turns[k.0]));
        true
    }

    /// Returns the gathered objects.
    pub fn view<'a>(
        &'a self,
        bodies: &'a Bodies,
        state: &'a State,
        coasts: &'a [Motion],
        turns: &'a [Turn],
    ) -> View<'a> {
        let Self { nothing, subset, .. } = self;
        match self.share {
            Share::None => View { bodies: &nothing.0, state: &nothing.1, coasts: &[], turns: &[] },
            Share::Some => View {
                bodies: &subset.bodies,
                state: &self.state,
                coasts: &self.coasts,
                turns: &self.turns,
            },
            Share::All => View { bodies, state, coasts, turns },
        }
    }

    /// Returns the list index of a gathered object.
    pub fn listed(&self, object: AwakeIndex) -> ListIndex {
        match self.share {
            Share::Some => self.subset.outer(object),
            Share::None | Share::All => ListIndex(object.0),
        }
    }
}
