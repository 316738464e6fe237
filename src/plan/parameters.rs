//! Continuous parameters of a candidate: offset, direction and length of every push, in steps of
//! about equal effect.

use crate::geometry::wrap_angle;
use crate::scene::State;

use super::workspace::MIN_LENGTH;
use super::{Candidate, Start, Workspace};

/// Step of the lateral offset, metres.
pub(super) const OFFSET_STEP: f64 = 0.005;

/// Step of the direction, radians. It moves the end of a 0.1 m push by as much as an offset step.
pub(super) const DIRECTION_STEP: f64 = 0.05;

/// Step of the length, metres.
pub(super) const LENGTH_STEP: f64 = 0.005;

/// Largest rotation of a direction from the searched one, radians (25 degrees). Beyond half the
/// spacing of principal directions, another candidate is the better start.
const LARGEST_TURN: f64 = 0.436;

/// Maximum length of a placed push as a multiple of the task's length.
const LONGEST: f64 = 1.5;

#[derive(Clone, Copy)]
enum Quantity {
    Offset,
    Direction,
    Length,
}

#[derive(Clone, Copy)]
struct Parameter {
    push: usize,
    quantity: Quantity,
    step: f64,
    low: f64,
    high: f64,
}

/// Parameters of one candidate with their steps and bounds, fixed at the start of refinement.
pub(super) struct Parameters(Vec<Parameter>);

impl Parameters {
    /// Creates the parameters and bounds around a candidate found by the search.
    pub fn new(workspace: &Workspace, start: &State, candidate: &Candidate) -> Self {
        let longest = workspace.task.pushes.length;
        let mut list = Vec::new();
        for (k, push) in candidate.pushes.iter().enumerate() {
            let mut add = |quantity, step, low, high| {
                list.push(Parameter { push: k, quantity, step, low, high });
            };
            let mut longest = longest;
            if let Start::Placed { part, offset } = push.start {
                // The span depends only on the object's heading, and only weakly.
                let object = (start, push.object);
                let span = workspace.largest_offset(push.grip(), object, part, push.direction);
                let span = span.max(offset.abs());
                add(Quantity::Offset, OFFSET_STEP, -span, span);
                longest *= LONGEST;
            }
            // Earlier rotations count, so that repeated refinement stays within the bounds.
            let from = push.direction - turned(workspace, push.direction);
            let low = (from - LARGEST_TURN).min(push.direction);
            let high = (from + LARGEST_TURN).max(push.direction);
            add(Quantity::Direction, DIRECTION_STEP, low, high);
            add(Quantity::Length, LENGTH_STEP, MIN_LENGTH.min(longest), longest);
        }
        Self(list)
    }

    /// Returns the number of parameters.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Returns the distances of `candidate` from the lower and upper bounds of each parameter, in
    /// steps.
    pub fn room(&self, candidate: &Candidate) -> Vec<(f64, f64)> {
        let range = |p: &Parameter| {
            let value = read(candidate, p);
            ((p.low - value) / p.step, (p.high - value) / p.step)
        };
        self.0.iter().map(range).collect()
    }

    /// Returns `candidate` moved by `steps` and clamped to the bounds, with the steps made.
    pub fn moved(&self, candidate: &Candidate, steps: &[f64]) -> (Candidate, Vec<f64>) {
        let mut next = candidate.clone();
        let mut made = Vec::with_capacity(steps.len());
        for (parameter, step) in self.0.iter().zip(steps) {
            let value = read(candidate, parameter);
            let moved = (value + step * parameter.step).clamp(parameter.low, parameter.high);
            write(&mut next, parameter, moved);
            made.push((moved - value) / parameter.step);
        }
        (next, made)
    }
}

/// Returns the angle to the nearest direction that the task allows, radians.
fn turned(workspace: &Workspace, direction: f64) -> f64 {
    let allowed = workspace.task.pushes.directions.headings();
    let turns = allowed.iter().map(|heading| wrap_angle(direction - heading));
    turns.min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0)
}

fn read(candidate: &Candidate, parameter: &Parameter) -> f64 {
    let push = &candidate.pushes[parameter.push];
    match (parameter.quantity, push.start) {
        (Quantity::Offset, Start::Placed { offset, .. }) => offset,
        (Quantity::Offset, Start::Chained) => 0.0,
        (Quantity::Direction, _) => push.direction,
        (Quantity::Length, _) => push.length,
    }
}

fn write(candidate: &mut Candidate, parameter: &Parameter, value: f64) {
    let push = &mut candidate.pushes[parameter.push];
    match (parameter.quantity, &mut push.start) {
        (Quantity::Offset, Start::Placed { offset, .. }) => *offset = value,
        (Quantity::Offset, Start::Chained) => {}
        (Quantity::Direction, _) => push.direction = value,
        (Quantity::Length, _) => push.length = value,
    }
}
