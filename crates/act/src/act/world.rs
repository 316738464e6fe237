//! What can be acted in.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use pushplan::{
    scene::{Scene, Sight, State, Tool},
    task::ToolMotion,
};

/// A table on which objects can be pushed and looked at; a robot can implement it.
pub trait World {
    /// Looks at the table at rest.
    ///
    /// # Errors
    /// If nothing can be seen at all.
    fn look(&mut self) -> Result<Look, WorldError>;

    /// Takes another tool, before the first motion with it; what a robot does that changes tools by itself.
    /// By default nothing, as every motion says which tool makes it.
    ///
    /// # Errors
    /// If the tool was not taken.
    fn change_tool(&mut self, tool: &Tool) -> Result<(), WorldError> {
        let _ = tool;
        Ok(())
    }

    /// Carries out a motion, of whose strokes only the last one settles: sets the tool down where
    /// the first stroke begins, moves it along all of them, waits until everything rests, goes
    /// [back](ToolMotion::retreat) and lifts it. Gives what was seen meanwhile and at rest, as much as there is; the more instants the more
    /// can be learnt, one for each 10 mm of travel being enough.
    ///
    /// # Errors
    /// If the motion was not carried out as it is.
    fn act(&mut self, motion: &ToolMotion) -> Result<Vec<Look>, WorldError>;

    /// Where and why the last motion ended before its end; `None` if it was carried out whole, or if
    /// nobody can say. What was seen is then of the shorter motion.
    fn stopped(&self) -> Option<Stop> {
        None
    }

    /// What an interrupted run needs to go on in a world that ends with it; `None` for a real one.
    fn save(&self) -> Option<WorldState> {
        None
    }

    /// Goes back to what was [saved](Self::save).
    fn restore(&mut self, state: &WorldState) {
        let _ = state;
    }
}

/// What is seen of the table at one instant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Look {
    /// Since the motion began, seconds. What is seen at rest after it has a later time than its end.
    pub time: f64,
    /// Every object of the scene, with or without the parts of those of several solids; `None` where it
    /// is not seen.
    pub seen: Vec<Option<Sight>>,
}

impl Look {
    /// The look with the parts of all things, which nobody sees by themselves.
    pub(super) fn with_parts(self, scene: &Scene) -> Self {
        Self { seen: scene.sights_with_parts(self.seen), ..self }
    }
}

/// A motion that ended before its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stop {
    /// The index of the stroke that was under way.
    pub stroke: usize,
    /// How much of it was made, 0 to 1.
    pub share: f64,
    /// Why it was not gone on with.
    pub why: String,
}

impl Stop {
    /// As much of `motion` as was made.
    pub fn made(&self, motion: &ToolMotion) -> ToolMotion {
        let mut made = motion.clone();
        made.strokes.truncate(self.stroke + 1);
        let share = self.share.clamp(0.0, 1.0);
        if let Some(last) = made.strokes.get_mut(self.stroke) {
            last.to = last.from.towards(&last.to, share);
            last.duration *= share;
            last.settle = true;
        }
        // What was hardly begun was not made.
        made.strokes.retain(|stroke| stroke.duration > 0.0);
        made
    }
}

/// A simulated world at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WorldState {
    /// Where everything really is.
    pub state: State,
    /// How often was looked.
    pub looks: u64,
}

/// Why it is no longer possible to act in a world.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct WorldError(pub String);
