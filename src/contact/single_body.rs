//! Frames of a single unjointed object with at most two contacts, solved side by side by
//! [`pushplan_kernel`]. The motions equal the results of [`super::prior`] to the last bit.

use pushplan_kernel::SolverStats;
use pushplan_kernel::{Effort, MANY, MOST, SingleBodyContact, SingleBodyFrame, batch, solve};

use crate::geometry::Footprint;

use super::{
    bodies::Partner,
    frame::{Frame, FrameProblem},
    points::{Contact, Scenery},
};

/// A frame to be solved. This order minimises the waiting of lanes for each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Waiting {
    pub contacts: usize,
    /// Solver effort in the previous frame.
    pub effort: Effort,
    pub place: usize,
}

/// Returns `true` for a frame that the kernel can solve.
pub(super) fn is_single_body(scenery: &Scenery, contacts: &[Contact]) -> bool {
    let bodies = scenery.bodies;
    bodies.objects.len() == 1 && bodies.mounts.is_empty() && contacts.len() <= MOST
}

/// Solves the `waiting` frames and stores the solution in each, if its forces were found.
pub(super) fn solve_each(
    problems: &[Option<FrameProblem>],
    frames: &mut [Frame],
    mut waiting: &[Waiting],
    tally: &mut SolverStats,
) {
    while !waiting.is_empty() {
        let (now, later) = waiting.split_at(waiting.len().min(batch(waiting.len())));
        solve_together(problems, frames, now, tally);
        waiting = later;
    }
}

/// Solves the `waiting` frames side by side.
fn solve_together(
    problems: &[Option<FrameProblem>],
    frames: &mut [Frame],
    waiting: &[Waiting],
    tally: &mut SolverStats,
) {
    let mut solutions = [None; MANY];
    {
        let mut lanes = [const { None }; MANY];
        for (lane, &Waiting { place, .. }) in lanes.iter_mut().zip(waiting) {
            let frame = &frames[place];
            *lane = problems[place].map(|problem| numbers(frame.scenery(problem), &frame.contacts));
        }
        solve(&lanes[..waiting.len()], &mut solutions, tally);
    }
    for (solution, &Waiting { place, .. }) in solutions.iter().zip(waiting) {
        frames[place].single = *solution;
    }
}

/// Returns the kernel's input for a frame.
fn numbers<'a>(scenery: Scenery<'a>, contacts: &[Contact]) -> SingleBodyFrame<'a> {
    let Scenery { bodies, state, step, coasts, turns, .. } = scenery;
    let (body, coast, velocity) = (&bodies.objects[0], &coasts[0], &state.velocities[0]);
    let travel = (step.to.position - step.from.position).norm();
    let mut met = [None; MOST];
    for (met, contact) in met.iter_mut().zip(contacts) {
        // Obstacles do not move, so only faces and corners matter.
        let radius = match contact.with {
            Partner::Part(index) => radius(&bodies.parts[index].footprint),
            _ => None,
        };
        *met = Some(SingleBodyContact {
            normal: contact.normal,
            arm: contact.arm,
            given: contact.given,
            given_turn: contact.given_turn,
            gap: contact.gap,
            friction: contact.friction,
            radius,
            follows: contact.follows,
        });
    }
    SingleBodyFrame {
        feet: bodies.feet(0),
        position: state.poses[0].position,
        axis: turns[0].axis(),
        mass: body.mass,
        load: body.load(),
        lean: body.lean,
        support: body.support,
        spin: body.spin,
        duration: step.duration,
        reach: coast.shift.norm().max(travel),
        coast: coast.shift.push(coast.turn),
        velocity: velocity.linear.push(velocity.angular),
        radius: radius(&body.footprint),
        contacts: met,
    }
}

/// Returns the radius of a disc.
fn radius(footprint: &Footprint) -> Option<f64> {
    match footprint {
        Footprint::Disc { radius } => Some(*radius),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
