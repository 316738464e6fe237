//! Errors of outcomes relative to every goal, in units of the tolerances.

use nalgebra::Vector3;

use crate::{
    scene::State,
    task::{Goal, Task},
};

/// Where every goal's object is relative to its goal: x, y and the heading; zero where none is asked
/// for.
pub(super) fn goal_errors(task: &Task, outcome: &State) -> Vec<Vector3<f64>> {
    let of = |goal: &Goal| {
        let apart = goal.off(outcome) / goal.tolerance;
        let turned = match (goal.heading, goal.turned(outcome)) {
            (Some((_, tolerance)), Some(turned)) => turned / tolerance,
            _ => 0.0,
        };
        Vector3::new(apart.x, apart.y, turned)
    };
    task.goals.iter().map(of).collect()
}

/// From the misses `from` to `to`, the shorter way round unless a joint with limits leaves one only.
pub(super) fn apart(task: &Task, to: &[Vector3<f64>], from: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let of = |((goal, to), from): ((&Goal, &Vector3<f64>), &Vector3<f64>)| {
        let mut apart = to - from;
        if let Some((_, tolerance)) = goal.heading {
            let turn = apart.z * tolerance;
            let turn = if goal.middle.is_some() { turn } else { goal.least_turn(turn) };
            apart.z = turn / tolerance;
        }
        apart
    };
    task.goals.iter().zip(to).zip(from).map(of).collect()
}

/// Returns errors relative to `middles`, one for every goal.
pub(super) fn beside(misses: &[Vector3<f64>], middles: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    misses.iter().zip(middles).map(|(miss, middle)| miss + middle).collect()
}

/// The largest miss.
pub(super) fn largest(misses: &[Vector3<f64>]) -> f64 {
    misses.iter().map(|miss| miss.xy().norm().max(miss.z.abs())).fold(0.0, f64::max)
}

/// The largest distance from a goal, metres.
pub(super) fn farthest(task: &Task, misses: &[Vector3<f64>]) -> f64 {
    let off = task.goals.iter().zip(misses).map(|(goal, miss)| goal.tolerance * miss.xy().norm());
    off.fold(0.0, f64::max)
}

/// The numbers of misses that goals ask for, goal by goal: x, y and, where one is asked for, the heading.
pub(super) fn asked(task: &Task, misses: &[Vector3<f64>]) -> Vec<f64> {
    let of = |(goal, miss): (&Goal, &Vector3<f64>)| {
        let count = if goal.heading.is_some() { 3 } else { 2 };
        (0..count).map(|k| miss[k]).collect::<Vec<_>>()
    };
    task.goals.iter().zip(misses).flat_map(of).collect()
}
