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
            Warning::Declined { model } => format!("model `{model}` does not support this motion"),
            Warning::Pressed { object, between: [a, b] } => {
                format!("{object} is pressed between {a} and {b}")
            }
            Warning::Overlap { between: [a, b], depth } => {
                format!("the prediction makes {a} and {b} overlap by {:.1} mm", depth * 1e3)
            }
            Warning::LooseJoint { between: [a, b], distance } => {
                let millimetres = distance * 1e3;
                format!("the prediction separates the joint of {a} and {b} by {millimetres:.1} mm")
            }
            Warning::Doubtful { object, within } => {
                format!(
                    "the predicted position of {object} may be wrong by up to {:.0} mm",
                    within * 1e3
                )
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
                "{}, so predictions may be wrong; `--out-of-range simulate` simulates instead",
                self.fact()
            ),
            Warning::Pressed { .. } => write!(
                f,
                "{}, which makes its motion unpredictable; `--out-of-range simulate` simulates \
                 instead",
                self.fact()
            ),
            Warning::Doubtful { .. } => write!(
                f,
                "{} (the model's own estimate); `--out-of-range simulate` simulates instead",
                self.fact()
            ),
            Warning::Overlap { .. } | Warning::LooseJoint { .. } => write!(
                f,
                "{}, which is physically impossible; `--out-of-range simulate` simulates instead",
                self.fact()
            ),
            Warning::Differs { object, distance } => write!(
                f,
                "prediction and 2-D simulation of {object} differ by {:.1} mm",
                distance * 1e3
            ),
            Warning::Simulated { reason } => {
                write!(f, "{}; the 2-D simulation was used instead", reason.fact())
            }
            Warning::Refused => write!(
                f,
                "no prediction was made; use `--out-of-range simulate` to simulate, or \
                 `--out-of-range warn` to predict anyway"
            ),
            Warning::Guessed { unknown } => write!(
                f,
                "the task leaves {unknown} unknown, so the middle of the range is assumed; \
                 `pushplan run` finds the values by pushing"
            ),
            Warning::NotAtRest { waited } => write!(
                f,
                "an object still moved {waited:.1} s after the end of the push, so the outcome is \
                 not at rest; raise the friction"
            ),
            Warning::SetDownOn { object, stroke } => write!(
                f,
                "{object} is below the tool when it is set down for push {}, so the nominal replay \
                 fails",
                stroke + 1
            ),
            Warning::Jammed { object, against, depth } => write!(
                f,
                "{object} jams against {against} and would have to penetrate it by {:.1} mm, so \
                 the tool cannot continue",
                depth * 1e3
            ),
            Warning::Stopped => write!(f, "the replay was stopped before its end"),
            Warning::OffTable { object } => {
                write!(f, "{object} is pushed off the table")
            }
            Warning::NotKept { object, moved, within } => write!(
                f,
                "{object} is moved by {:.1} mm, but `keep` allows only {:.1} mm",
                moved * 1e3,
                within * 1e3
            ),
            Warning::KeptOut { object, region } => {
                write!(f, "{object} enters the keep-out region {region}")
            }
            Warning::Hangs { object } => {
                write!(f, "{object} hangs over the edge of the table, held up by another body")
            }
            Warning::Fell { object } => write!(f, "{object} falls, which the task allows"),
            Warning::TooMuchForce { object: Some(object), needed, limit } => write!(
                f,
                "the tool presses on {object} with about {needed:.1} N for longer than an impact; \
                 its `max_force` is {limit:.1} N"
            ),
            Warning::TooMuchForce { object: None, needed, limit } => write!(
                f,
                "pushing takes about {} N for longer than an impact; `robot.max_force` is \
                 {limit} N",
                above(*needed, *limit)
            ),
            Warning::HardPush { needed } => write!(
                f,
                "pushing takes about {needed:.0} N for longer than an impact, more than most arms \
                 can exert; state `robot.max_force`"
            ),
            Warning::Squeezed { against, needed, friction } => write!(
                f,
                "pushing takes about {needed:.0} N for longer than an impact, but friction only \
                 {friction:.1} N: an object is squeezed against {}; leave more room there",
                against.as_deref().unwrap_or("something fixed")
            ),
            Warning::NearEdge { object, inside } => write!(
                f,
                "{object} ends {:.1} mm inside the edge of the table, where it may fall; move its \
                 goal farther inside",
                inside * 1e3
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
            Warning::NoWay { push, back, obstacle } => {
                let which = match (push, back) {
                    (push, true) => format!("from push {} home", push + 1),
                    (0, false) => "from home to push 1".to_owned(),
                    (push, false) => format!("from push {push} to push {}", push + 1),
                };
                write!(
                    f,
                    "{obstacle} obstructs the path of the lifted tool {which}; there is no way \
                     around at `robot.travel`"
                )
            }
            Warning::NotLifted { push, obstacle } => write!(
                f,
                "the tool cannot be lifted after push {}, because {obstacle} is above it",
                push + 1
            ),
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
                write!(f, "the plan has {pushes} pushes in a row, but the task allows {allowed}")
            }
            Warning::TooManyToolChanges { changes, allowed } => {
                write!(
                    f,
                    "the plan changes the tool {changes} times, but the task allows {allowed}"
                )
            }
            Warning::ForbiddenPush { push, fault } => write!(f, "push {} {fault}", push + 1),
            Warning::CannotLever { step, fault } => write!(f, "step {}: {fault}", step + 1),
            Warning::Slipped { object } => write!(f, "{object} slipped off the blade"),
            Warning::Strained => write!(f, "an object is jammed"),
            Warning::Toppled { object } => write!(
                f,
                "{object} toppled, so its pose on the table is unreliable; push lower or slower"
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

/// Returns one text for warnings about the same quantity of several bodies.
pub(super) fn out_of_range<'a>(warnings: impl Iterator<Item = &'a Warning> + Clone) -> String {
    let mut values = warnings.clone().filter_map(|warning| match warning {
        Warning::OutsideRange { of, value, low, high, .. } => {
            Some(format!("of {of} = {}", distinguished(*value, [*low, *high])))
        }
        _ => None,
    });
    match (warnings.clone().next(), values.next(), values.collect::<Vec<String>>()) {
        (Some(Warning::OutsideRange { quantity, low, high, .. }), Some(first), others)
            if !others.is_empty() =>
        {
            let others = others.join(" and ");
            format!(
                "{quantity} {first} and {others} is outside the model's range {low} to {high}, so \
                 predictions may be wrong; `--out-of-range simulate` simulates instead"
            )
        }
        (first, ..) => first.map(ToString::to_string).unwrap_or_default(),
    }
}

/// Formats `value` with the fewest decimals that show that it is greater than `limit`.
fn above(value: f64, limit: f64) -> String {
    let greater = |text: &String| text.parse().is_ok_and(|shown: f64| shown > limit);
    (0..6)
        .map(|digits| format!("{value:.digits$}"))
        .find(greater)
        .unwrap_or_else(|| value.to_string())
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

#[cfg(test)]
mod tests {
    use super::above;

    #[test]
    fn a_value_is_shown_above_its_limit() {
        assert_eq!(above(8.2, 5.0), "8");
        assert_eq!(above(0.42, 0.1), "0.4");
        assert_eq!(above(5.2, 5.1), "5.2");
    }
}
