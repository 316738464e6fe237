//! Errors of outcomes relative to every goal, in units of the tolerances.

use nalgebra::Vector3;

use crate::{
    geometry::Vector,
    scene::State,
    task::{Aspect, Demand, End, Task},
};

/// Returns the error of every pair of a demanded position and heading: x, y and heading. Components
/// without a demand are zero.
pub(super) fn goal_errors(task: &Task, outcome: &State) -> Vec<Vector3<f64>> {
    let of = |(object, aspect): (usize, Aspect)| {
        let end = End::resting(object, outcome);
        let off = |demand: &Demand| Some(demand.kind().off(&end)? / demand.kind().tolerance()?);
        let turn = |demand: &Demand| Some(demand.kind().turned(&end)? / turn_tolerance(demand)?);
        let apart = aspect.place.and_then(off).unwrap_or_else(Vector::zeros);
        Vector3::new(apart.x, apart.y, aspect.turn.and_then(turn).unwrap_or(0.0))
    };
    aspects(task).map(of).collect()
}

/// Returns the demanded positions and headings of all goals in pairs, each with its object.
fn aspects(task: &Task) -> impl Iterator<Item = (usize, Aspect<'_>)> {
    task.goals.iter().flat_map(|goal| goal.aspects().map(|aspect| (goal.object, aspect)))
}

fn turn_tolerance(demand: &Demand) -> Option<f64> {
    demand.kind().turn_tolerance()
}

/// Returns the differences of goal errors from `from` to `to`. Headings differ by the shorter
/// rotation, unless the limits of a joint allow only one.
pub(super) fn apart(task: &Task, to: &[Vector3<f64>], from: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let of = |aspect: Aspect, to: &Vector3<f64>, from: &Vector3<f64>| {
        let mut apart = to - from;
        if let Some(facing) = aspect.turn.and_then(|demand| demand.kind().facing()) {
            let turn = apart.z * facing.tolerance;
            let limited = facing.limit_middle.is_some();
            let turn = if limited { turn } else { facing.least_turn(turn) };
            apart.z = turn / facing.tolerance;
        }
        apart
    };
    let all = aspects(task).zip(to).zip(from);
    all.map(|(((_, aspect), to), from)| of(aspect, to, from)).collect()
}

/// Returns the sums of errors and `middles`, one for every goal.
pub(super) fn beside(misses: &[Vector3<f64>], middles: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    misses.iter().zip(middles).map(|(miss, middle)| miss + middle).collect()
}

/// Returns the largest error.
pub(super) fn largest(misses: &[Vector3<f64>]) -> f64 {
    misses.iter().map(|miss| miss.xy().norm().max(miss.z.abs())).fold(0.0, f64::max)
}

/// Returns the largest distance from a goal, metres.
pub(super) fn farthest(task: &Task, misses: &[Vector3<f64>]) -> f64 {
    let off = aspects(task).zip(misses).filter_map(|((_, aspect), miss)| {
        Some(aspect.place?.kind().tolerance()? * miss.xy().norm())
    });
    off.fold(0.0, f64::max)
}

/// Returns the demanded components of the errors, goal by goal: x, y and, if a heading is demanded,
/// the heading.
pub(super) fn asked(task: &Task, misses: &[Vector3<f64>]) -> Vec<f64> {
    let of = |((_, aspect), miss): ((usize, Aspect), &Vector3<f64>)| {
        let count = if aspect.turn.is_some() { 3 } else { 2 };
        (0..count).map(|k| miss[k]).collect::<Vec<_>>()
    };
    aspects(task).zip(misses).flat_map(of).collect()
}
