//! Objects that a plan moves in addition to the goal's object.

use serde_json::{Value as Json, json};

use pushplan::geometry::wrap_angle;
use pushplan::{
    outcome::{Outcome, Verdict, Warning},
    task::Task,
};

use super::number::{degrees, millimetres};

/// Smallest displacement that is reported, metres.
const MOVED: f64 = 1e-3;

/// An object that is not the goal's, with its displacement in the replay that moves it most, or in
/// the prediction without replays.
pub(super) struct Bystander<'a> {
    name: &'a str,
    /// Displacement, metres.
    moved: f64,
    /// Rotation, radians.
    turned: f64,
    fell: bool,
}

/// Returns all objects that a plan moves except the goal's object, farthest first.
pub(super) fn bystanders<'a>(
    task: &'a Task,
    predicted: Option<&Outcome>,
    verdict: Option<&Verdict>,
) -> Vec<Bystander<'a>> {
    let nominal = verdict.into_iter().flat_map(super::verdict::nominal);
    let replayed: Vec<(&Outcome, &[Warning])> =
        nominal.map(|evidence| (&evidence.outcome, &evidence.warnings[..])).collect();
    let ends = match replayed.is_empty() {
        true => predicted.map(|outcome| (outcome, &[][..])).into_iter().collect(),
        false => replayed,
    };
    let falls = |name: &str, warning: &Warning| match warning {
        Warning::Toppled { object } | Warning::OffTable { object } | Warning::Fell { object } => {
            object == name
        }
        _ => false,
    };
    let of = |(index, object): (usize, &'a pushplan::scene::Object)| {
        let mut found = Bystander { name: &object.name, moved: 0.0, turned: 0.0, fell: false };
        for (outcome, warnings) in &ends {
            let Some(pose) = outcome.state.poses.get(index) else { continue };
            found.moved = found.moved.max((pose.position - object.pose.position).norm());
            found.turned = found.turned.max(wrap_angle(pose.heading - object.pose.heading).abs());
            found.fell |= warnings.iter().any(|warning| falls(&object.name, warning));
        }
        found
    };
    let others = task.scene.things().filter(|(k, _)| !task.has_goal(*k));
    let mut moved: Vec<Bystander> =
        others.map(of).filter(|one| one.moved > MOVED || one.fell).collect();
    moved.sort_by(|a, b| b.moved.total_cmp(&a.moved));
    moved
}

/// Formats all bystanders in one line; `None` if there are none.
pub(super) fn line(moved: &[Bystander<'_>]) -> Option<String> {
    let of = |one: &Bystander| {
        let fell = if one.fell { " and falls" } else { "" };
        let turned = match one.turned > 0.02 {
            true => format!(", rotated by {}", degrees(one.turned)),
            false => String::new(),
        };
        format!("{} by {}{turned}{fell}", one.name, millimetres(one.moved))
    };
    let all: Vec<String> = moved.iter().map(of).collect();
    (!all.is_empty()).then(|| format!("also moves: {}", all.join("; ")))
}

/// Converts all bystanders to JSON, in metres and radians.
pub(super) fn json(moved: &[Bystander<'_>]) -> Json {
    let of = |one: &Bystander| {
        json!({
            "object": one.name, "moved": one.moved, "turned": one.turned, "fell": one.fell,
        })
    };
    moved.iter().map(of).collect()
}
