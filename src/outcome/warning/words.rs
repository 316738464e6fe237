//! Texts of warnings: the fact, its consequence and the option that helps.

use std::fmt;

use super::Warning;

impl Warning {
    /// Returns the fact, without its consequence or the option that helps.
    pub(super) fn fact(&self) -> String {
        match self {
            Warning::OutsideRange { of, quantity, value, low, high } => {
                let value = distinguished(*value, [*low, *high]);
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
                "{}; predictions may be wrong, `--out-of-range simulate` simulates instead",
                self.fact()
            ),
            Warning::Pressed { .. } => write!(
                f,
                "{}; its motion is then unpredictable, `--out-of-range simulate` simulates instead",
                self.fact()
            ),
            Warning::Doubtful { .. } => write!(
                f,
                "{}, says the model itself; `--out-of-range simulate` simulates instead",
                self.fact()
            ),
            Warning::Overlap { .. } | Warning::LooseJoint { .. } => write!(
                f,
                "{}, which cannot happen on a table; `--out-of-range simulate` simulates instead",
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
                "no prediction was made; `--out-of-range simulate` simulates instead, `--out-of-range warn` \
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
            Warning::NotKept { object, moved, within } => write!(
                f,
                "{object} is moved by {:.1} mm, and the task keeps it within {:.1}",
                moved * 1e3,
                within * 1e3
            ),
            Warning::KeptOut { object, region } => {
                write!(f, "{object} comes into {region}, which objects keep out of")
            }
            Warning::Hangs { object } => {
                write!(f, "{object} hangs over the edge of the table: something holds it up")
            }
            Warning::Fell { object } => write!(f, "{object} falls, which it may"),
            Warning::TooMuchForce { object: Some(object), needed, limit } => write!(
                f,
                "the tool presses on {object} with about {needed:.1} N for longer than an impact, and may \
                 with {limit:.1}"
            ),
            Warning::TooMuchForce { object: None, needed, limit } => write!(
                f,
                "pushing takes about {needed:.0} N for longer than an impact, and the robot has {limit:.0}"
            ),
            Warning::HardPush { needed } => write!(
                f,
                "pushing takes about {needed:.0} N for longer than an impact, more than most arms have; \
                 state `robot.max_force`"
            ),
            Warning::OutOfReach { push } => {
                write!(f, "the end effector leaves the robot's reach in push {}", push + 1)
            }
            Warning::ThroughObstacle { push, obstacle } => {
                write!(f, "the tool passes through {obstacle} in push {}", push + 1)
            }
            Warning::HandThrough { push, obstacle } => {
                write!(f, "the hand passes through {obstacle} in push {}", push + 1)
            }
            Warning::NoWay { push, obstacle } => {
                let (before, push) = (push, push + 1);
                write!(
                    f,
                    "the tool does not get from push {before} to push {push}: {obstacle} is in the way, \
                     and higher than `robot.travel`"
                )
            }
            Warning::Arm { push, fault } => {
                write!(f, "the arm cannot make push {}: {fault}", push + 1)
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
            Warning::TooManyToolChanges { changes, allowed } => {
                write!(f, "the tool is changed {changes} times, and {allowed} are allowed")
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
                write!(
                    f,
                    "{} and was stopped; `--out-of-range simulate` simulates instead",
                    self.fact()
                )
            }
        }
    }
}

/// Formats `value` with four decimals, or with as many as distinguish it from these bounds.
fn distinguished(value: f64, bounds: [f64; 2]) -> String {
    let same = |text: &str| text.parse().is_ok_and(|shown: f64| bounds.contains(&shown));
    let short = (4..12).map(|digits| format!("{value:.digits$}")).find(|text| !same(text));
    let text = short.unwrap_or_else(|| value.to_string());
    // Trailing zeros are removed, as in the bounds.
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}
