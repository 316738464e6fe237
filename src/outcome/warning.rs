//! Typed warnings: what happened, what it means, which option helps.

use serde::{Deserialize, Serialize};

use super::{LeverFault, PushFault};
use crate::scene::planar_only;
use crate::scene::{ArmFault, ModelSpec, Quantity, Unknowns};

mod words;

/// Something that lowers the trust in a result without making it an error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Warning {
    /// A quantity lies outside the range for which the model was trained or measured.
    OutsideRange {
        /// Which body, or `scene` or `push`.
        of: String,
        /// Which quantity.
        quantity: Quantity,
        /// Its value.
        value: f64,
        /// Smallest value of the range.
        low: f64,
        /// Largest value of the range.
        high: f64,
    },
    /// No model that was asked takes this job; the last of them predicted it all the same.
    Declined {
        /// The last.
        model: ModelSpec,
    },
    /// Something still moved when waiting was given up.
    NotAtRest {
        /// How long was waited, seconds.
        waited: f64,
    },
    /// The model expects to be far off.
    Doubtful {
        /// Name of the object.
        object: String,
        /// What nine of ten ends of such pushes are within, metres.
        within: f64,
    },
    /// A number became infinite or undefined and the rollout stopped at the last good frame.
    NotFinite,
    /// The replay was stopped before it was over.
    Stopped,
    /// An object fell over or leans, so that its planar pose no longer tells where it is.
    Toppled {
        /// Its name.
        object: String,
    },
    /// An object was pressed into something that does not give way: rigid bodies get stuck there,
    /// and an arm stops or something breaks. The replay ended.
    Jammed {
        /// Its name.
        object: String,
        /// The name of the obstacle, the tool's part or the other object.
        against: String,
        /// How deep it was inside, metres.
        depth: f64,
    },
    /// An object's centre left the table, so that it falls. The replay ended.
    OffTable {
        /// Its name.
        object: String,
    },
    /// An object was moved farther than the task lets it.
    NotKept {
        /// Its name.
        object: String,
        /// How far, metres.
        moved: f64,
        /// How far it may be, metres.
        within: f64,
    },
    /// An object came where objects keep out. The replay ended.
    KeptOut {
        /// Its name.
        object: String,
        /// The region's name.
        region: String,
    },
    /// An object toppled or left the table, which it may.
    Fell {
        /// Its name.
        object: String,
    },
    /// An object's centre left the table, and yet something holds it up.
    Hangs {
        /// Its name.
        object: String,
    },
    /// The tool pressed harder than the robot's arm can, or an object may be pressed.
    TooMuchForce {
        /// The object, where it is the one that may not be.
        #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
        object: Option<String>,
        /// How hard, newtons; to within a factor of two.
        needed: f64,
        /// What the arm can, or the object may, newtons.
        limit: f64,
    },
    /// The tool pressed harder than an ordinary arm can, and the task does not say what its can.
    HardPush {
        /// How hard, newtons; to within a factor of two.
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
    /// The hand, or the handle that it holds the tool by, passes through an obstacle.
    HandThrough {
        /// Index of the push.
        push: usize,
        /// Name of the obstacle.
        obstacle: String,
    },
    /// The lifted tool does not get to a push from the one before.
    NoWay {
        /// Index of the push.
        push: usize,
        /// What is in the way and taller than it is lifted.
        obstacle: String,
    },
    /// The arm cannot make a push, or does not get there.
    Arm {
        /// Index of the push.
        push: usize,
        /// Why.
        fault: ArmFault,
    },
    /// The task does not allow the tool.
    ForbiddenTool {
        /// Its name.
        tool: String,
    },
    /// The task does not allow the grip yaw.
    ForbiddenYaw {
        /// The yaw, radians.
        yaw: f64,
    },
    /// The task does not allow so many pushes in a row.
    TooManyPushes {
        /// How many there are.
        pushes: usize,
        /// How many are allowed.
        allowed: usize,
    },
    /// The task does not allow to take another tool so often.
    TooManyToolChanges {
        /// How often.
        changes: usize,
        /// How often it is allowed.
        allowed: usize,
    },
    /// A push that is not of the form that the task allows.
    ForbiddenPush {
        /// Index of the push.
        push: usize,
        /// What of it is not.
        fault: PushFault,
    },
    /// A lever-up that no robot can make, or that the task does not allow.
    CannotLever {
        /// Index of the step.
        step: usize,
        /// Why.
        fault: LeverFault,
    },
    /// An object slid off the blade during the turn.
    Slipped {
        /// Its name.
        object: String,
    },
    /// Forces grew as they do when something is jammed. The replay ended.
    Strained,
    /// The tool came down on an object instead of next to it.
    SetDownOn {
        /// Name of the object.
        object: String,
        /// Index of the stroke that the tool came down for.
        stroke: usize,
    },
    /// An object was pressed between the tool and an obstacle.
    Pressed {
        /// Its name.
        object: String,
        /// The names of the part and the obstacle.
        between: [String; 2],
    },
    /// Two bodies overlap: pressed together by something that does not give way, or left so by the
    /// model.
    Overlap {
        /// Their names.
        between: [String; 2],
        /// How deep, metres.
        depth: f64,
    },
    /// A joint ended away from what it allows.
    LooseJoint {
        /// The names of its two objects.
        between: [String; 2],
        /// How far, metres (a turn at 5 cm).
        distance: f64,
    },
    /// The prediction and the planar engine differ on the same motion: the measured consequence of
    /// another warning.
    Differs {
        /// The object on which they differ most.
        object: String,
        /// How far its final positions are apart, metres.
        distance: f64,
    },
    /// The planar engine took the model's place.
    Simulated {
        /// Why.
        reason: Box<Warning>,
    },
    /// No prediction was made, because of the other warnings.
    Refused,
    /// The task does not know its scene, so that this rests on guesses.
    Guessed {
        /// What is unknown.
        unknown: Unknowns,
    },
}

impl Warning {
    /// Returns `true` if an outcome with this warning cannot count as success: the default of a new kind.
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
                | Warning::Slipped { .. }
                | Warning::Fell { .. }
                | Warning::Guessed { .. }
        )
    }

    /// Whether `other` says the same of another object, or with another number.
    pub fn is_like(&self, other: &Warning) -> bool {
        match (self, other) {
            (
                Warning::OutsideRange { quantity, .. },
                Warning::OutsideRange { quantity: other, .. },
            ) => quantity == other,
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }

    /// Whether something on the way cannot pass. An engine ends a replay there; an effect model
    /// records no frames from there on but the last.
    pub fn blocks(&self) -> bool {
        matches!(
            self,
            Warning::Jammed { .. }
                | Warning::Strained
                | Warning::OffTable { .. }
                | Warning::KeptOut { .. }
        )
    }

    /// Whether this is about the model, so that simulating instead would help.
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

    /// The trouble in a word or two, for a table.
    pub fn word(&self) -> &'static str {
        match self {
            Warning::OutsideRange { .. } => "outside its range",
            Warning::Declined { .. } => "declined",
            Warning::NotAtRest { .. } => "not at rest",
            Warning::Doubtful { .. } => "doubtful",
            Warning::NotFinite => "not finite",
            Warning::Stopped => "stopped",
            Warning::Toppled { .. } => "toppled",
            Warning::Jammed { .. } => "jammed",
            Warning::OffTable { .. } => "off the table",
            Warning::NotKept { .. } => "not kept",
            Warning::KeptOut { .. } => "not kept out",
            Warning::Fell { .. } => "fallen",
            Warning::Hangs { .. } => "hanging",
            Warning::TooMuchForce { .. } => "too much force",
            Warning::HardPush { .. } => "a hard push",
            Warning::OutOfReach { .. } => "out of reach",
            Warning::ThroughObstacle { .. } => "through an obstacle",
            Warning::HandThrough { .. } => "hand through an obstacle",
            Warning::NoWay { .. } => "no way to a push",
            Warning::Arm { .. } => "not for the arm",
            Warning::ForbiddenTool { .. }
            | Warning::ForbiddenYaw { .. }
            | Warning::TooManyPushes { .. }
            | Warning::TooManyToolChanges { .. }
            | Warning::ForbiddenPush { .. }
            | Warning::CannotLever { .. } => "forbidden",
            Warning::Slipped { .. } => "slipped off the blade",
            Warning::Strained => "jammed",
            Warning::SetDownOn { .. } => "set down on it",
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
