//! A task of levering: what lies there, with which blades and turns, and what must come of it.

use serde::{Deserialize, Serialize};

use crate::scene::{PushRules, Robot, ToolChoice};

use super::{Blade, Block, FollowUp, LeverGoal, LeverScene, LeverUp, Plate};

/// A tool with a blade, held by the end effector at the end of its shaft.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BladeTool {
    /// Unique within a library, among all tools.
    pub name: String,
    /// One line for people.
    pub description: String,
    /// What goes under an edge.
    pub blade: Blade,
}

impl BladeTool {
    /// Friction value of most blades: plain steel.
    pub const FRICTION: f64 = 0.4;
}

/// Where the axis lies that a blade is turned about.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pivot {
    /// At the support line, so that the plate's tilt is the blade's turn.
    Auto,
    /// At this signed distance from the edge, inward, metres: see [`LeverUp::pivot`].
    At(f64),
}

/// The lever-ups that a plan may contain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverRules {
    /// Smallest and largest depth of the tip behind the edge, metres.
    pub depth: [f64; 2],
    /// Smallest and largest turn, radians.
    pub angle: [f64; 2],
    /// Where the axis may lie.
    pub pivots: Vec<Pivot>,
    /// Speed of the tip, m/s.
    pub speed: f64,
    /// How long the blade then stands still, seconds.
    pub hold: f64,
    /// How far it is then drawn back, metres; it comes from as far away.
    pub retreat: f64,
}

impl LeverRules {
    /// Usual depths, metres; slips become frequent below.
    pub const DEPTH: [f64; 2] = [0.008, 0.02];
    /// Usual turns, degrees: beyond a right angle a blade pushes over what a wall holds upright.
    pub const ANGLE_DEG: [f64; 2] = [30.0, 150.0];
    /// How near to a corner a blade is still set, metres.
    pub const CORNER: f64 = 0.012;
    /// A long arc that suits plates of the size of a hand, metres.
    pub const LIFT: f64 = 0.16;
    /// A fulcrum just outside of the edge, metres.
    pub const PRY: f64 = -0.012;
}

/// The support line, a fixed arc and prying.
impl Default for LeverRules {
    fn default() -> Self {
        Self {
            depth: Self::DEPTH,
            angle: Self::ANGLE_DEG.map(f64::to_radians),
            pivots: vec![Pivot::Auto, Pivot::At(Self::LIFT), Pivot::At(Self::PRY)],
            speed: LeverUp::SPEED,
            hold: LeverUp::HOLD,
            retreat: LeverUp::RETREAT,
        }
    }
}

/// Everything that a planner needs to know to lever something, besides the tools themselves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverTask {
    /// From the file's name or its `name` key.
    pub name: String,
    /// One line for people.
    pub description: String,
    /// Friction value of the table.
    pub table_friction: f64,
    /// What can move.
    pub plates: Vec<Plate>,
    /// What cannot.
    pub blocks: Vec<Block>,
    /// The robot.
    pub robot: Robot,
    /// Allowed tools: those with blades, and where pushes may follow those that push.
    pub tools: ToolChoice,
    /// Allowed lever-ups, all of the goal's plate.
    pub levers: LeverRules,
    /// The pushes that may follow a lever-up; none if nothing is said.
    pub pushes: Option<PushRules>,
    /// What to reach.
    pub goal: LeverGoal,
    /// Share of the disturbed replays that must reach the goal for a plan to count, 0 to 1.
    pub robustness: f64,
}

impl LeverTask {
    /// The scene with one of the blades.
    pub fn scene(&self, blade: Blade) -> LeverScene {
        LeverScene {
            plates: self.plates.clone(),
            blocks: self.blocks.clone(),
            table_friction: self.table_friction,
            blade,
        }
    }

    /// The plate that is levered.
    pub fn plate(&self) -> &Plate {
        &self.plates[self.goal.plate]
    }
}

/// A lever-up and the tool that makes it, and perhaps pushes that follow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverPlan {
    /// Name of the tool.
    pub tool: String,
    /// The lever-up.
    pub lever: LeverUp,
    /// The pushes that follow. Plan files hold them beside the plan, with their tool.
    #[serde(skip)]
    pub follow_up: Option<FollowUp>,
}
