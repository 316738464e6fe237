//! Legs: the pushes of a sequence in metres, each no longer than a push may be.

use crate::geometry::Vector;

use super::lattice::Shift;
use super::moves::{Move, Train, pushing, train_after};
use super::reach::Transport;

/// Distance between starts of pushes that count as the same, and of their lengths, metres.
const NEAR: f64 = 0.03;

/// Push that carries a group straight along.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// Tool and grip yaw (radians).
    pub pair: (usize, f64),
    /// Index of the pushed object.
    pub object: usize,
    /// Direction, radians from world +x.
    pub direction: f64,
    /// Start, metres.
    pub from: Vector,
    /// End, metres.
    pub to: Vector,
    /// Whether the end is the goal.
    pub last: bool,
    /// Corners of the way of a tool that stays down to the start of the push, metres.
    pub travel: Vec<Vector>,
    /// Position of the end effector relative to the object in contact, metres.
    pub contact: Vector,
    /// Objects that are carried along, with their positions at the end, metres.
    pub carried: Vec<(usize, Vector)>,
}

/// Push that failed in rollouts, so that it is not planned again.
#[derive(Clone, Debug)]
pub(super) struct Failed {
    pub object: usize,
    pub step: [i32; 2],
    pub from: Vector,
    /// Length, metres; `None` if no push was feasible.
    pub length: Option<f64>,
}

impl Failed {
    /// Creates the record of a leg of which all pushes, or none, were feasible.
    pub fn of(leg: &Leg, feasible: bool) -> Self {
        let step = [leg.direction.cos().round() as i32, leg.direction.sin().round() as i32];
        let length = feasible.then(|| (leg.to - leg.from).norm());
        Self { object: leg.object, step, from: leg.from, length }
    }
}

/// Returns `true` if nearly the same push has failed before.
pub(super) fn is_like(
    transport: &Transport,
    failed: &Failed,
    one: &Move,
    shifts: &[Shift],
) -> bool {
    let (group, hold) = pushing(transport, one);
    let (from, length) = (group.position(shifts[one.group]), transport.length(one.steps));
    (failed.object, failed.step) == (group.thing, hold.step)
        && (failed.from - from).norm() < NEAR
        && failed.length.is_none_or(|other| (other - length).abs() < NEAR)
}

/// Returns the legs of a push from a state, after a way of the tool along `travel`. A tool that
/// stays down makes one leg of a long push.
pub(super) fn legs_of(
    transport: &Transport,
    one: &Move,
    shifts: &[Shift],
    travel: Vec<Vector>,
) -> Vec<Leg> {
    let (group, hold) = pushing(transport, one);
    let count = match transport.floor {
        Some(_) => 1,
        None => transport.pushes(transport.length(one.steps)) as i16,
    };
    let at = |n: i16| train_after(transport, one, one.steps * n / count, shifts);
    let position = |(k, at): (usize, Shift)| transport.groups[k].position(at);
    let first = |train: &Train| train.movers().next().unwrap_or((one.group, [0, 0]));
    let leg = |n: i16| {
        let (before, after) = (at(n), at(n + 1));
        let end = first(&after);
        let goal = group.goal.filter(|_| n + 1 == count && group.is_at_goal(end.1));
        let carried = after.movers().skip(1);
        Leg {
            pair: transport.grips[hold.grip],
            object: group.thing,
            direction: hold.direction,
            from: position(first(&before)),
            to: goal.map_or_else(|| position(end), |(goal, _)| goal),
            last: goal.is_some(),
            travel: if n == 0 { travel.clone() } else { Vec::new() },
            contact: hold.effector + hold.ahead() * hold.approach,
            carried: carried.map(|one| (transport.groups[one.0].thing, position(one))).collect(),
        }
    };
    (0..count).map(leg).collect()
}
