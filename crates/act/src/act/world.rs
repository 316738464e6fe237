//! Interface of the environment.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use pushplan::{
    scene::{ObservedPose, Scene, State, Tool},
    task::ToolMotion,
};

/// Environment in which objects can be pushed and observed, for example a robot's table.
pub trait World {
    /// Returns an observation of the table at rest.
    ///
    /// # Errors
    /// Returns an error if no observation is available.
    fn look(&mut self) -> Result<Look, WorldError>;

    /// Changes the tool before its first motion.
    ///
    /// Robots with an automatic tool changer implement this. The default does nothing because every
    /// motion names its tool.
    ///
    /// # Errors
    /// Returns an error if the tool was not changed.
    fn change_tool(&mut self, tool: &Tool) -> Result<(), WorldError> {
        let _ = tool;
        Ok(())
    }

    /// Carries out a motion and returns the observations during it and at rest.
    ///
    /// The tool is set down where the first stroke begins and moved along all strokes; only the
    /// last one settles. After all objects rest, the tool [retreats](ToolMotion::retreat) and is
    /// lifted. More observations give more information, but one per 10 mm of travel is sufficient.
    ///
    /// # Errors
    /// Returns an error if the motion was not carried out as requested.
    fn act(&mut self, motion: &ToolMotion) -> Result<Vec<Look>, WorldError>;

    /// Returns where and why the last motion ended early.
    ///
    /// Returns `None` if the motion was completed or its end is unknown. The observations cover the
    /// shortened motion.
    fn stopped(&self) -> Option<Stop> {
        None
    }

    /// Returns the state needed to resume an interrupted run; `None` for a real world.
    fn save(&self) -> Option<WorldState> {
        None
    }

    /// Restores a [saved](Self::save) state.
    fn restore(&mut self, state: &WorldState) {
        let _ = state;
    }
}

/// Observation of the table at one instant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Look {
    /// Time since the start of the motion, seconds. It is later than the end of the motion at rest.
    pub time: f64,
    /// Observed pose of every object of the scene, `None` if the object is not observed. Parts of
    /// compound objects may be omitted.
    pub seen: Vec<Option<ObservedPose>>,
}

impl Look {
    /// Adds the poses of parts of compound objects, which are not observed separately.
    pub(super) fn with_parts(self, scene: &Scene) -> Self {
        Self { seen: scene.sights_with_parts(self.seen), ..self }
    }
}

/// Early end of a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stop {
    /// Index of the interrupted stroke.
    pub stroke: usize,
    /// Completed share of this stroke, 0 to 1.
    pub share: f64,
    /// Reason for the early end.
    pub why: String,
}

impl Stop {
    /// Returns the completed part of `motion`.
    pub fn made(&self, motion: &ToolMotion) -> ToolMotion {
        let mut made = motion.clone();
        made.strokes.truncate(self.stroke + 1);
        let share = self.share.clamp(0.0, 1.0);
        if let Some(last) = made.strokes.get_mut(self.stroke) {
            last.to = last.from.towards(&last.to, share);
            last.duration *= share;
            last.settle = true;
        }
        // Strokes that have hardly begun are dropped.
        made.strokes.retain(|stroke| stroke.duration > 0.0);
        made
    }
}

/// State of a simulated world at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WorldState {
    /// True state.
    pub state: State,
    /// Number of observations taken.
    pub looks: u64,
}

/// Error of a world in which motions can no longer be executed.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct WorldError(pub String);
