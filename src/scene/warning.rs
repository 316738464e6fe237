//! Typed warnings: what happened, what it means, which option helps.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::{LeverFault, ModelSpec, Quantity, Unknowns};

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
    /// The tool pressed harder than the robot's arm can.
    TooMuchForce {
        /// How hard, newtons; to within a factor of two.
        needed: f64,
        /// What the arm can, newtons.
        limit: f64,
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

/// What of a push a task does not allow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PushFault {
    /// The task's pushes begin in another way: from above, or where the last one ended.
    Form,
    /// The tool's underside is not as high as the task says, but at this height, metres.
    Lift(f64),
    /// It is the first of chained pushes and begins so far from the robot's home, metres.
    Home(f64),
    /// It is chained and begins so far from where the last push ended, metres.
    Apart(f64),
    /// It goes where no direction of the task goes, nor a refined one: radians.
    Direction(f64),
    /// It is longer than refinement may make it, metres.
    Length(f64),
}

impl fmt::Display for PushFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Form => write!(f, "is not of the form that the task allows"),
            Self::Lift(lift) => {
                write!(
                    f,
                    "holds the tool {:.1} mm above the table, which the task does not",
                    lift * 1e3
                )
            }
            Self::Home(distance) => {
                write!(
                    f,
                    "begins {:.1} mm from the robot's home, where chained pushes begin",
                    distance * 1e3
                )
            }
            Self::Apart(distance) => write!(
                f,
                "begins {:.1} mm from where the last one ended, and the tool stays down",
                distance * 1e3
            ),
            Self::Direction(direction) => write!(
                f,
                "goes along {:.1} degrees, far from any direction that the task allows",
                direction.to_degrees()
            ),
            Self::Length(length) => {
                write!(f, "is {:.1} mm long, longer than the task allows", length * 1e3)
            }
        }
    }
}

impl Warning {
    /// Whether an outcome with this warning cannot count as success.
    pub fn forbids_success(&self) -> bool {
        match self {
            Warning::OutsideRange { .. }
            | Warning::Declined { .. }
            | Warning::Pressed { .. }
            | Warning::Overlap { .. }
            | Warning::LooseJoint { .. }
            | Warning::Doubtful { .. }
            | Warning::Differs { .. }
            | Warning::Simulated { .. }
            | Warning::Slipped { .. }
            | Warning::Guessed { .. } => false,
            Warning::NotAtRest { .. }
            | Warning::NotFinite
            | Warning::Stopped
            | Warning::Toppled { .. }
            | Warning::TooManyPushes { .. }
            | Warning::ForbiddenPush { .. }
            | Warning::CannotLever { .. }
            | Warning::Strained
            | Warning::Jammed { .. }
            | Warning::OffTable { .. }
            | Warning::TooMuchForce { .. }
            | Warning::OutOfReach { .. }
            | Warning::ThroughObstacle { .. }
            | Warning::ForbiddenTool { .. }
            | Warning::ForbiddenYaw { .. }
            | Warning::SetDownOn { .. }
            | Warning::Refused => true,
        }
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
        matches!(self, Warning::Jammed { .. } | Warning::Strained | Warning::OffTable { .. })
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
            Warning::TooMuchForce { .. } => "too much force",
            Warning::OutOfReach { .. } => "out of reach",
            Warning::ThroughObstacle { .. } => "through an obstacle",
            Warning::ForbiddenTool { .. }
            | Warning::ForbiddenYaw { .. }
            | Warning::TooManyPushes { .. }
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

    /// The fact, without what it means or what helps.
    fn fact(&self) -> String {
        match self {
            Warning::OutsideRange { of, quantity, value, low, high } => {
                let value = told_apart(*value, [*low, *high]);
                format!("{of}: {quantity} = {value} is outside the model's range {low} to {high}")
            }
            Warning::Declined { model } => format!("`{model}` does not take this motion"),
            Warning::Pressed { object, between: [a, b] } => {
                format!("{object} is pressed between {a} and {b}")
            }
            Warning::Overlap { between: [a, b], depth } => {
                format!("{a} and {b} are predicted {:.1} mm inside each other", depth * 1e3)
            }
            Warning::LooseJoint { between: [a, b], distance } => {
                let millimetres = distance * 1e3;
                format!("the joint of {a} and {b} is predicted {millimetres:.1} mm off")
            }
            Warning::Doubtful { object, within } => {
                format!("{object} may end up to {:.0} mm from where it is predicted", within * 1e3)
            }
            Warning::NotFinite => "the prediction became NaN or infinite".to_owned(),
            other => other.to_string(),
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Warning::OutsideRange { .. } | Warning::Declined { .. } => write!(
                f,
                "{}; predictions may be wrong, `--outside simulate` simulates instead",
                self.fact()
            ),
            Warning::Pressed { .. } => write!(
                f,
                "{}; its motion is then unpredictable, `--outside simulate` simulates instead",
                self.fact()
            ),
            Warning::Doubtful { .. } => write!(
                f,
                "{}, says the model itself; `--outside simulate` simulates instead",
                self.fact()
            ),
            Warning::Overlap { .. } | Warning::LooseJoint { .. } => write!(
                f,
                "{}, which cannot happen on a table; `--outside simulate` simulates instead",
                self.fact()
            ),
            Warning::Differs { object, distance } => write!(
                f,
                "the planar simulation of this motion puts {object} {:.1} mm from where it is \
                 predicted",
                distance * 1e3
            ),
            Warning::Simulated { reason } => {
                write!(f, "{}; simulated in the plane instead", reason.fact())
            }
            Warning::Refused => write!(
                f,
                "no prediction was made; `--outside simulate` simulates instead, `--outside warn` \
                 predicts all the same"
            ),
            Warning::Guessed { unknown } => write!(
                f,
                "the task does not know its {unknown}, so this assumes the middle of what they may \
                 be; `pushplan run` finds out by pushing"
            ),
            Warning::NotAtRest { waited } => write!(
                f,
                "something still moved {waited:.1} s after the push ended; the outcome is not at \
                 rest; raise the friction"
            ),
            Warning::SetDownOn { object, stroke } => write!(
                f,
                "the tool came down on {object} for push {} instead of next to it, so the plan does \
                 not work as written",
                stroke + 1
            ),
            Warning::Jammed { object, against, depth } => write!(
                f,
                "{object} jams against {against}: it would have to go {:.1} mm into it, so the tool \
                 cannot go on",
                depth * 1e3
            ),
            Warning::Stopped => write!(f, "the replay was stopped before it was over"),
            Warning::OffTable { object } => {
                write!(f, "{object} is pushed off the table")
            }
            Warning::TooMuchForce { needed, limit } => write!(
                f,
                "pushing takes about {needed:.0} N for longer than an impact, and the robot has {limit:.0}"
            ),
            Warning::OutOfReach { push } => {
                write!(f, "the end effector leaves the robot's reach in push {}", push + 1)
            }
            Warning::ThroughObstacle { push, obstacle } => {
                write!(f, "the tool passes through {obstacle} in push {}", push + 1)
            }
            Warning::ForbiddenTool { tool } => {
                write!(f, "the task does not allow the tool {tool}")
            }
            Warning::ForbiddenYaw { yaw } => {
                write!(f, "the task does not allow a grip yaw of {:.1} degrees", yaw.to_degrees())
            }
            Warning::TooManyPushes { pushes, allowed } => {
                write!(f, "{pushes} pushes in a row, and the task allows {allowed}")
            }
            Warning::ForbiddenPush { push, fault } => write!(f, "push {} {fault}", push + 1),
            Warning::CannotLever { step, fault } => write!(f, "step {}: {fault}", step + 1),
            Warning::Slipped { object } => write!(f, "{object} slipped off the blade"),
            Warning::Strained => write!(f, "something is jammed"),
            Warning::Toppled { object } => write!(
                f,
                "{object} toppled; its pose on the table means little; push lower or slower"
            ),
            Warning::NotFinite => {
                write!(f, "{} and was stopped; `--outside simulate` simulates instead", self.fact())
            }
        }
    }
}

/// `value` with four digits after the point, or with as many as tell it from these bounds.
fn told_apart(value: f64, bounds: [f64; 2]) -> String {
    let same = |text: &str| text.parse().is_ok_and(|shown: f64| bounds.contains(&shown));
    let short = (4..12).map(|digits| format!("{value:.digits$}")).find(|text| !same(text));
    let text = short.unwrap_or_else(|| value.to_string());
    // As short as the bounds are.
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests;
