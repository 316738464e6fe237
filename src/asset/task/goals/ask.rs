//! The form of an entry that asks for something in a goal.

use serde_json::Value as Json;

use crate::asset::node::Node;
use crate::asset::spec::Key;
use crate::asset::strict::Ledger;
use crate::{
    scene::Scene,
    task::{Demand, Goal},
};

/// One way to ask for something in a goal.
pub(in crate::asset::task) struct Ask {
    /// The key that asks, and others that come with it.
    pub keys: &'static [Key],
    /// Property of the object that is asked for.
    pub about: About,
    /// Demand on an object, an index into the scene's objects, from the goal's node; `None` if a key is
    /// faulty.
    pub read: fn(&Node, usize, &Scene) -> Option<Demand>,
    /// Keys of a demand of this kind in a file.
    pub write: fn(&Demand, &Goal, &Scene) -> Option<Json>,
    /// Notes faults that span several keys.
    pub check: fn(&Asked, &mut Ledger),
}

/// Property of the object that a demand is about: no goal asks for two places, or two headings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::asset::task) enum About {
    /// A place, with any heading or one that another key asks for.
    Place,
    /// Place and heading at once.
    Pose,
    /// A heading.
    Turn,
    /// A state that lever-ups bring about.
    Lifted,
}

/// A goal whose keys are checked: its node, the name of its object, and the scene.
pub(in crate::asset::task) struct Asked<'a> {
    /// The goal.
    pub goal: &'a Node,
    /// Name of its object.
    pub name: &'a Node,
    /// The scene.
    pub scene: &'a Node,
}

impl<'a> Asked<'a> {
    /// Returns the items of a list of the scene.
    pub fn section(&self, key: &str) -> &'a [Node] {
        self.scene.get(key).map(Node::items).unwrap_or_default()
    }
}
