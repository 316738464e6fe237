//! Typed warnings: the fact, its consequence and the option that helps.

use serde::{Deserialize, Serialize};

use super::{LeverFault, PushFault};
use crate::scene::planar_only;
use crate::scene::{ArmFault, ModelSpec, Quantity, Unknowns};

mod merged;
mod shown;
mod words;

pub use shown::{SHOWN_WARNINGS, warning_lines};

/// Fact that lowers the trust in a result without being an error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Warning {
    /// A quantity lies outside the range in which the model was trained or measured.
    OutsideRange {
        /// Name of the body, or `scene` or `push`.
        of: String,
        /// The quantity.
        quantity: Quantity,
        /// Value of the quantity.
        value: f64,
        /// Smallest value of the range.
        low: f64,
        /// Largest value of the range.
        high: f64,
    },
    /// No available model supports this job; the last one predicted it regardless.
    Declined {
        /// The last model.
        model: ModelSpec,
    },
    /// A body still moved at the end of the time limit for settling.
    NotAtRest {
        /// Time limit for settling, seconds.
        waited: f64,
    },
    /// The model expects a large error.
    Doubtful {
        /// Name of the object.
        object: String,
        /// Error not exceeded by 90 % of such pushes, metres.
        within: f64,
    },
    /// A number became infinite or undefined and the rollout stopped at the last good frame.
    NotFinite,
    /// The replay was stopped early.
    Stopped,
    /// An object fell over or leans, so that its planar pose no longer locates it.
    Toppled {
        /// Name of the object.
        object: String,
    },
    /// An object was pressed into a rigid body. Simulated bodies get stuck there; a real arm stops
    /// or something breaks. The replay ended.
    Jammed {
        /// Name of the object.
        object: String,
        /// Name of the obstacle, of the tool's part or of the other object.
        against: String,
        /// Penetration depth, metres.
        depth: f64,
    },
    /// An object's centre left the table, so that the object falls. The replay ended.
    OffTable {
        /// Name of the object.
        object: String,
    },
    /// An object was moved farther than the task allows. The replay ended.
    NotKept {
        /// Name of the object.
        object: String,
        /// Displacement of the farthest corner of its outline, metres.
        moved: f64,
        /// Allowed distance, metres.
        within: f64,
    },
    /// An object entered a keep-out region. The replay ended.
    KeptOut {
        /// Name of the object.
        object: String,
        /// Name of the region.
        region: String,
    },
    /// An object toppled or left the table, which the task allows.
    Fell {
        /// Name of the object.
        object: String,
    },
    /// An object's centre left the table, but another body holds the object up.
    Hangs {
        /// Name of the object.
        object: String,
    },
    /// The tool pressed harder than the robot's arm can, or than an object allows.
    TooMuchForce {
        /// Name of the object whose limit is exceeded, or `None` for the arm.
        #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
        object: Option<String>,
        /// Force, newtons, to within a factor of two.
        needed: f64,
        /// Limit of the arm or of the object, newtons.
        limit: f64,
    },
    /// The tool pressed harder than an ordinary arm can, and the task states no limit.
    HardPush {
        /// Force, newtons, to within a factor of two.
        needed: f64,
    },
    /// The end effector leaves the robot's reach.
    OutOfReach {
        /// Index of the push.
        push: usize,
    },
    /// The tool passes through an obstacle.
    ThroughObstacle {
        /// Index of the push.
        push: usize,
        /// Name of the obstacle.
        obstacle: String,
    },
    /// The hand, or the handle by which it holds the tool, passes through an obstacle or an object.
    HandThrough {
        /// Index of the push.
        push: usize,
        /// Name of the obstacle or object.
        obstacle: String,
    },
    /// The lifted tool has no free path to a step, or from it home.
    NoWay {
        /// Index of the step.
        push: usize,
        /// Whether the path leads home.
        back: bool,
        /// Name of the obstruction, which is taller than the travel height.
        obstacle: String,
    },
    /// The tool ends below a body and cannot be lifted.
    NotLifted {
        /// Index of the push.
        push: usize,
        /// Name of the body above the tool.
        obstacle: String,
    },
    /// The arm cannot make a push or reach its start.
    Arm {
        /// Index of the push.
        push: usize,
        /// The fault.
        fault: ArmFault,
    },
    /// The task does not allow the tool.
    ForbiddenTool {
        /// Name of the tool.
        tool: String,
    },
    /// The task does not allow the grip yaw.
    ForbiddenYaw {
        /// The yaw, radians.
        yaw: f64,
    },
    /// The plan has more pushes than the task allows.
    TooManyPushes {
        /// Number of pushes.
        pushes: usize,
        /// Allowed number of pushes.
        allowed: usize,
    },
    /// The plan changes the tool more often than the task allows.
    TooManyToolChanges {
        /// Number of tool changes.
        changes: usize,
        /// Allowed number of tool changes.
        allowed: usize,
    },
    /// A push violates a rule of the task.
    ForbiddenPush {
        /// Index of the push.
        push: usize,
        /// The violated rule.
        fault: PushFault,
    },
    /// The robot cannot make a lever-up, or the task does not allow it.
    CannotLever {
        /// Index of the step.
        step: usize,
        /// The fault.
        fault: LeverFault,
    },
    /// An object slid off the blade during the rotation.
    Slipped {
        /// Name of the object.
        object: String,
    },
    /// Forces grew as in a jam. The replay ended.
    Strained,
    /// The tool came down on an object instead of next to it.
    SetDownOn {
        /// Name of the object.
        object: String,
        /// Index of the stroke for which the tool came down.
        stroke: usize,
    },
    /// An object was pressed between the tool and an obstacle.
    Pressed {
        /// Name of the object.
        object: String,
        /// Names of the part and the obstacle.
        between: [String; 2],
    },
    /// Two bodies overlap: pressed together by a rigid body, or left so by the model.
    Overlap {
        /// Names of the bodies.
        between: [String; 2],
        /// Penetration depth, metres.
        depth: f64,
    },
    /// A joint ended outside its constraint.
    LooseJoint {
        /// Names of the two jointed objects.
        between: [String; 2],
        /// Distance from the constraint, metres; a rotation counts at a radius of 5 cm.
        distance: f64,
    },
    /// The prediction and the 2-D engine differ on the same motion: the measured consequence of
    /// another warning.
    Differs {
        /// Name of the object with the largest difference.
        object: String,
        /// Distance between its two final positions, metres.
        distance: f64,
    },
    /// The 2-D engine replaced the model.
    Simulated {
        /// Warning that led to the replacement.
        reason: Box<Warning>,
    },
    /// No prediction was made, because of the other warnings.
    Refused,
    /// The task leaves values of its scene unknown, so that the result rests on guesses.
    Guessed {
        /// The unknown quantities.
        unknown: Unknowns,
    },
    /// The tool pressed far harder than friction requires, so that it squeezes an object against
    /// something fixed.
    Squeezed {
        /// Name of the obstacle, if a moved object touches one.
        #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
        against: Option<String>,
        /// Force, newtons, to within a factor of two.
        needed: f64,
        /// Friction of all moved objects, newtons.
        friction: f64,
    },
    /// An object ends closer to the edge of the table than the uncertainty of its final position.
    NearEdge {
        /// Name of the object.
        object: String,
        /// Distance of its centre from the edge, metres.
        inside: f64,
    },
}

impl Warning {
    /// Returns `true` if an outcome with this warning cannot count as success. A new kind of
    /// warning returns `true` unless it is listed here.
    pub fn forbids_success(&self) -> bool {
        !matches!(
            self,
            Warning::OutsideRange { .. }
                | Warning::Declined { .. }
                | Warning::Pressed { .. }
                | Warning::Overlap { .. }
                | Warning::LooseJoint { .. }
                | Warning::Doubtful { .. }
                | Warning::Differs { .. }
                | Warning::Simulated { .. }
                | Warning::HardPush { .. }
                | Warning::Squeezed { .. }
                | Warning::NearEdge { .. }
                | Warning::Slipped { .. }
                | Warning::Fell { .. }
                | Warning::Guessed { .. }
        )
    }

    /// Returns `true` if `other` is of the same kind, for any object and value.
    pub fn is_like(&self, other: &Warning) -> bool {
        match (self, other) {
            (
                Warning::OutsideRange { quantity, .. },
                Warning::OutsideRange { quantity: other, .. },
            ) => quantity == other,
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }

    /// Returns `true` if the motion is blocked. An engine ends a replay there, and an effect model
    /// records only the last frame after it.
    pub fn blocks(&self) -> bool {
        matches!(
            self,
            Warning::Jammed { .. }
                | Warning::Strained
                | Warning::OffTable { .. }
                | Warning::NotKept { .. }
                | Warning::KeptOut { .. }
        )
    }

    /// Returns `true` if the warning concerns the model, so that simulation would help.
    pub fn questions_model(&self) -> bool {
        matches!(
            self,
            Warning::OutsideRange { .. }
                | Warning::Declined { .. }
                | Warning::Pressed { .. }
                | Warning::Overlap { .. }
                | Warning::LooseJoint { .. }
                | Warning::Doubtful { .. }
                | Warning::NotFinite
        )
    }

    /// Returns `true` if the tool presses harder than an ordinary arm, or far harder than friction
    /// requires.
    pub fn presses(&self) -> bool {
        matches!(self, Warning::HardPush { .. } | Warning::Squeezed { .. })
    }

    /// Returns a short name of the warning, for tables.
    pub fn word(&self) -> &'static str {
        match self {
            Warning::OutsideRange { .. } => "out of range",
            Warning::Declined { .. } => "declined",
            Warning::NotAtRest { .. } => "not at rest",
            Warning::Doubtful { .. } => "doubtful",
            Warning::NotFinite => "not finite",
            Warning::Stopped => "stopped",
            Warning::Toppled { .. } => "toppled",
            Warning::Jammed { .. } => "jammed",
            Warning::OffTable { .. } => "off the table",
            Warning::NotKept { .. } => "kept object moved",
            Warning::KeptOut { .. } => "in a keep-out region",
            Warning::Fell { .. } => "fallen",
            Warning::Hangs { .. } => "hanging",
            Warning::TooMuchForce { .. } => "too much force",
            Warning::HardPush { .. } => "high force",
            Warning::Squeezed { .. } => "squeezed",
            Warning::NearEdge { .. } => "near the table's edge",
            Warning::OutOfReach { .. } => "out of reach",
            Warning::ThroughObstacle { .. } => "through an obstacle",
            Warning::HandThrough { .. } => "hand through an obstacle",
            Warning::NoWay { .. } => "no path to a push",
            Warning::NotLifted { .. } => "tool below a body",
            Warning::Arm { .. } => "infeasible for the arm",
            Warning::ForbiddenTool { .. }
            | Warning::ForbiddenYaw { .. }
            | Warning::TooManyPushes { .. }
            | Warning::TooManyToolChanges { .. }
            | Warning::ForbiddenPush { .. }
            | Warning::CannotLever { .. } => "forbidden",
            Warning::Slipped { .. } => "slipped off the blade",
            Warning::Strained => "jammed",
            Warning::SetDownOn { .. } => "tool set down on it",
            Warning::Pressed { .. } => "pressed",
            Warning::Overlap { .. } => "overlapping",
            Warning::LooseJoint { .. } => "loose joint",
            Warning::Differs { .. } => "differing",
            Warning::Simulated { .. } => "simulated",
            Warning::Refused => "refused",
            Warning::Guessed { .. } => "guessed",
        }
    }
}

#[cfg(test)]
mod tests;
