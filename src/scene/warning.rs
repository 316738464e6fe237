//! Typed warnings: what happened, what it means, which option helps.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Something that lowers the trust in a result without making it an error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Warning {
    /// A quantity lies outside the range that the weights were trained on.
    OutsideTraining {
        /// Which body, or `task`.
        of: String,
        /// Which quantity, with its unit.
        quantity: String,
        /// Its value.
        value: f64,
        /// Smallest trained value.
        low: f64,
        /// Largest trained value.
        high: f64,
    },
    /// Something still moved when waiting was given up.
    NotAtRest {
        /// How long was waited, seconds.
        waited: f64,
    },
    /// A number became infinite or undefined and the rollout stopped at the last good frame.
    NotFinite,
    /// An object fell over or leans, so that its planar pose no longer tells where it is.
    Toppled {
        /// Its name.
        object: String,
    },
    /// The tool came down on an object instead of beside it.
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
    /// Two bodies came inside each other: pressed together by what does not give way, or left
    /// so by the model.
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
    /// What is predicted and what the planar engine makes of the same motion differ: the measured
    /// consequence of another warning.
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
}

impl Warning {
    /// Whether an outcome with this warning cannot count as success.
    pub fn forbids_success(&self) -> bool {
        match self {
            Warning::OutsideTraining { .. }
            | Warning::Pressed { .. }
            | Warning::Overlap { .. }
            | Warning::LooseJoint { .. }
            | Warning::Differs { .. }
            | Warning::Simulated { .. } => false,
            Warning::NotAtRest { .. }
            | Warning::NotFinite
            | Warning::Toppled { .. }
            | Warning::SetDownOn { .. }
            | Warning::Refused => true,
        }
    }

    /// Whether this is about the model, so that simulating instead would help.
    pub fn questions_model(&self) -> bool {
        matches!(
            self,
            Warning::OutsideTraining { .. }
                | Warning::Pressed { .. }
                | Warning::Overlap { .. }
                | Warning::LooseJoint { .. }
                | Warning::NotFinite
        )
    }

    /// What is the matter, without what it means or helps.
    fn fact(&self) -> String {
        match self {
            Warning::OutsideTraining { of, quantity, value, low, high } => format!(
                "{of}: {quantity} = {value:.4} is outside the trained range {low:.4} to {high:.4}"
            ),
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
            Warning::NotFinite => "the prediction left the finite numbers".to_owned(),
            other => other.to_string(),
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Warning::OutsideTraining { .. } => write!(
                f,
                "{}; predictions may be wrong, `--outside simulate` simulates instead",
                self.fact()
            ),
            Warning::Pressed { .. } => write!(
                f,
                "{}; where it goes then nobody can tell, `--outside simulate` simulates instead",
                self.fact()
            ),
            Warning::Overlap { .. } | Warning::LooseJoint { .. } => write!(
                f,
                "{}, which no table shows; `--outside simulate` simulates instead",
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
            Warning::NotAtRest { waited } => write!(
                f,
                "something still moved {waited:.1} s after the push ended; the outcome is not a \
                 rest, raise the friction"
            ),
            Warning::SetDownOn { object, stroke } => write!(
                f,
                "the tool came down on {object} for push {} instead of beside it, so the plan does \
                 not work as written",
                stroke + 1
            ),
            Warning::Toppled { object } => write!(
                f,
                "{object} toppled; its pose on the table means little, push lower or slower"
            ),
            Warning::NotFinite => {
                write!(f, "{} and was stopped; `--outside simulate` simulates instead", self.fact())
            }
        }
    }
}
