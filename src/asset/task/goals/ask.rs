//! Form of an entry that states a demand in a goal.

use serde_json::Value as Json;

use crate::asset::node::Node;
use crate::asset::spec::Key;
use crate::asset::strict::Ledger;
use crate::{
    scene::Scene,
    task::{Demand, Goal},
};

/// Kind of demand that a goal can state.
pub(in crate::asset::task) struct Ask {
    /// Main key of the demand, followed by its additional keys.
    pub keys: &'static [Key],
    /// Property of the object that the demand concerns.
    pub about: About,
    /// Reads the demand on an object (index into the scene's objects) from the goal's node; returns
    /// `None` if a key is faulty.
    pub read: fn(&Node, usize, &Scene) -> Option<Demand>,
    /// Returns the keys of a demand of this kind in a file.
    pub write: fn(&Demand, &Goal, &Scene) -> Option<Json>,
    /// Reports faults that span several keys.
    pub check: fn(&Asked, &mut Ledger),
}

/// Property of the object that a demand concerns. No goal asks for two positions or two headings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::asset::task) enum About {
    /// Position, with any heading or a heading given by another key.
    Place,
    /// Position and heading at once.
    Pose,
    /// Heading.
    Turn,
    /// State reached by a lever-up.
    Lifted,
}

/// Goal under check: its node, the name of its object, and the scene.
pub(in crate::asset::task) struct Asked<'a> {
    /// Node of the goal.
    pub goal: &'a Node,
    /// Name of the goal's object.
    pub name: &'a Node,
    /// Node of the scene.
    pub scene: &'a Node,
}

impl<'a> Asked<'a> {
    /// Returns the items of a list in the scene.
    pub fn section(&self, key: &str) -> &'a [Node] {
        self.scene.get(key).map(Node::items).unwrap_or_default()
    }
}
