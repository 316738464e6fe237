//! Texts of causes: the cause and the remedy.

use std::fmt;

use super::Cause;

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cause::Beyond { subject, distance, possible, needed, length } => {
                write!(
                    f,
                    "{subject} is {} m from the base, but arm and longest tool have an effect up \
                     to {} m only; move it nearer, or raise `robot.reach.max` to {} m",
                    cm(*distance),
                    cm(*possible),
                    cm(*needed)
                )?;
                match length {
                    Some(length) => write!(f, " and `pushes.length` to {} m", cm(*length)),
                    None => Ok(()),
                }
            }
            Cause::TooFewPushes { distance, allowed, length, needed } => {
                let most = *allowed as f64 * longest(*length);
                let more = (distance / length).ceil() as usize;
                let who = match allowed {
                    1 => "one push reaches".to_owned(),
                    count => format!("{count} pushes reach"),
                };
                write!(
                    f,
                    "{who} {} m at most, but {} m is needed; raise `pushes.length` to {} m or \
                     `pushes.max_count` to {more}",
                    cm(most),
                    cm(*distance),
                    cm(*needed)
                )
            }
            Cause::Enclosed { subject, by, open } => {
                write!(f, "{subject} is enclosed by {}; remove {}", list(by), list(open))
            }
            Cause::Force { object, allowed, needed } => {
                let key = match object {
                    Some(object) => format!("`max_force` of `{object}`"),
                    None => "`robot.max_force`".to_owned(),
                };
                write!(f, "pushing takes about {needed:.0} N, but {key} is {allowed} N")
            }
            Cause::Kept { names } => {
                let list = list(names);
                write!(f, "{list}, protected by `keep` or `keep_out`, obstructs every plan")
            }
            Cause::Hand { meets } => write!(
                f,
                "the hand or the handle of the tool collides with {} in every plan; see \
                 `robot.hand`",
                list(meets)
            ),
            Cause::Clear { objects, allowed } => write!(
                f,
                "{} must be cleared first, which `pushes.max_count` {allowed} does not suffice \
                 for; remove {}",
                counted(objects),
                if objects.len() > 1 { "them" } else { "it" }
            ),
            Cause::Obstructed { names } => {
                let (verb, them) = match names.len() {
                    1 => ("obstructs", "it"),
                    _ => ("obstruct", "them"),
                };
                write!(f, "{} {verb} every plan; move or remove {them}", list(names))
            }
            Cause::Base => f.write_str("the robot's base obstructs every plan; see `robot.base`"),
            Cause::Arm { fault } => {
                write!(f, "plans exist, but the arm cannot execute them; in the best one {fault}")
            }
            Cause::Several => f.write_str("relaxing any single limit is not enough"),
            limit => limit.limit(f),
        }
    }
}

impl Cause {
    /// Writes a limit of the task and the value that suffices.
    fn limit(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cause::Pushes { allowed, needed } => {
                write!(f, "the task needs {needed} pushes, but `pushes.max_count` is {allowed}")
            }
            Cause::Length { allowed, needed } => write!(
                f,
                "pushes are too short: one push reaches {} m, but {} m is needed; raise \
                 `pushes.length` from {allowed} m to {} m or allow more pushes",
                cm(longest(*allowed)),
                cm(*needed),
                cm(*needed)
            ),
            Cause::Directions { needed } => write!(
                f,
                "no allowed direction leads to the goal, but others do; widen \
                 `pushes.directions`, for example to {needed}"
            ),
            Cause::GripYaws { needed } => write!(
                f,
                "no allowed grip yaw works, but {:.0} degrees would; add it to \
                 `pushes.grip_yaws_deg`",
                needed.to_degrees()
            ),
            Cause::Far { allowed, needed } => write!(
                f,
                "the pushes are too far away: the end effector would have to reach {} m, but \
                 `robot.reach.max` is {allowed} m",
                cm(*needed)
            ),
            Cause::Near { allowed, needed } => write!(
                f,
                "the pushes are too near: the end effector would have to come within {} m of the \
                 base, but `robot.reach.min` is {allowed} m",
                cm(*needed)
            ),
            Cause::Tool { needed } => {
                write!(f, "no allowed tool works, but `{needed}` does; add it to `tools`")
            }
            Cause::Joined { needed } => write!(
                f,
                "`goal.object` cannot be pushed there directly, but `{needed}`, which is joined to \
                 it, can"
            ),
            Cause::Lift { allowed, needed } => write!(
                f,
                "the tool cannot push at `pushes.lift` {allowed} m, but at {:.3} m; change \
                 `pushes.lift`",
                needed
            ),
            Cause::Travel { allowed, needed } => write!(
                f,
                "the lifted tool cannot pass at `robot.travel` {allowed} m, but at {} m; raise \
                 `robot.travel`",
                cm(*needed)
            ),
            _ => Ok(()),
        }
    }
}

/// Returns the length of a push that refinement may make of `length`, metres.
fn longest(length: f64) -> f64 {
    1.5 * length
}

/// Rounds to centimetres, metres.
fn cm(metres: f64) -> f64 {
    (metres * 100.0).round() / 100.0
}

/// Joins names in words.
fn list(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match &quoted[..] {
        [] => "another body".to_owned(),
        [one] => one.clone(),
        [all @ .., last] => format!("{} and {last}", all.join(", ")),
    }
}

/// Returns the number of objects with their names.
fn counted(names: &[String]) -> String {
    match names.len() {
        1 => list(names),
        count => format!("{count} objects, {},", list(names)),
    }
}
