//! Pair frictions for pairs whose coefficient in the file is not the mean of the two values.

use crate::diagnostic::Ledger;
use crate::model::{Model, Solid};
use pushplan::scene::{PairFriction, Scene, Surface};

use super::objects::Draft;
use super::statics::Statics;

/// Difference below which two coefficients are equal.
const SAME: f64 = 1e-9;

/// Maximum number of pair frictions in a task file.
const MOST: usize = 256;

/// Returns the pair frictions that a task file must state, because MuJoCo uses the larger of two
/// values, or the value stated for the pair.
pub(super) fn frictions(
    model: &Model,
    drafts: &[Draft<'_>],
    statics: &Statics<'_>,
    ledger: &mut Ledger,
) -> Vec<PairFriction> {
    let mut found = Vec::new();
    for (index, draft) in drafts.iter().enumerate() {
        let own = draft.object.friction;
        let mut add = |with: Surface, solids: [&[&Solid]; 2], value: f64| {
            let Some(coefficient) = coefficient(model, solids, [own, value], ledger, draft) else {
                return;
            };
            if (coefficient - Scene::pair_friction(own, value)).abs() > SAME {
                found.push(PairFriction { object: index, with, coefficient });
            }
        };
        if let Some(table) = statics.table {
            // On feet, only the feet touch the table.
            let below: &[&Solid] = if draft.feet.is_empty() { &[draft.solid] } else { &draft.feet };
            add(Surface::Table, [below, &[table]], statics.table_friction);
        }
        for (k, (obstacle, solid)) in statics.obstacles.iter().enumerate() {
            add(Surface::Obstacle(k), [&[draft.solid], &[solid]], obstacle.friction);
        }
        for (k, other) in drafts.iter().enumerate().skip(index + 1) {
            if other.group != draft.group {
                let solids: [&[&Solid]; 2] = [&[draft.solid], &[other.solid]];
                add(Surface::Object(k), solids, other.object.friction);
            }
        }
    }
    if found.len() > MOST {
        let message = format!(
            "{} pairs have a friction coefficient that is not the mean of their values",
            found.len()
        );
        ledger.fault_of_file(
            message,
            format!("a task can state at most {MOST} of them; use fewer different values"),
        );
    }
    found
}

/// Returns the friction coefficient of two bodies; reports a fault if the file contradicts itself.
fn coefficient(
    model: &Model,
    solids: [&[&Solid]; 2],
    values: [f64; 2],
    ledger: &mut Ledger,
    draft: &Draft<'_>,
) -> Option<f64> {
    let is = |name: &str, side: usize| solids[side].iter().any(|solid| solid.name == name);
    let of_them = |[a, b]: &[String; 2]| is(a, 0) && is(b, 1) || is(b, 0) && is(a, 1);
    let mut stated =
        model.pairs.iter().filter(|(names, _)| of_them(names)).map(|(_, value)| *value);
    if let Some(first) = stated.next() {
        if stated.any(|other| (other - first).abs() > SAME) {
            let message =
                format!("pairs of `{}` state different friction coefficients", draft.object.name);
            ledger.fault(draft.place, message, "state one for all solids of the two bodies");
            return None;
        }
        return Some(first);
    }
    if !model.larger_friction {
        return Some(Scene::pair_friction(values[0], values[1]));
    }
    // The friction of a foot may differ from the friction of its solid.
    let of = |side: usize| {
        let first = solids[side].first()?;
        Some((first.material.rank, first.material.friction.unwrap_or(values[side])))
    };
    let [(rank, a), (other, b)] = [of(0)?, of(1)?];
    Some(match rank.cmp(&other) {
        std::cmp::Ordering::Greater => a,
        std::cmp::Ordering::Less => b,
        std::cmp::Ordering::Equal => a.max(b),
    })
}
