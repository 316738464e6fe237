//! The continuous parameters of a candidate: offset, direction and length of every push, counted
//! in steps of about equal effect.

use crate::geometry::wrap_angle;
use crate::scene::State;

use super::workspace::MIN_LENGTH;
use super::{Candidate, Start, Workspace};

/// Step of the lateral offset, metres.
pub(super) const OFFSET_STEP: f64 = 0.005;

/// Step of the direction, radians: moves the end of a 0.1 m push by as much as an offset.
pub(super) const DIRECTION_STEP: f64 = 0.05;

/// Step of the length, metres.
pub(super) const LENGTH_STEP: f64 = 0.005;

/// A direction is turned by at most this against the one that was searched, radians (25
/// degrees): past half the spacing of principal directions another candidate is the better start.
const LARGEST_TURN: f64 = 0.436;

/// A placed push may be lengthened to this share of the task's length.
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

/// The parameters of one candidate with their steps and bounds, fixed when refinement begins.
pub(super) struct Parameters(Vec<Parameter>);

impl Parameters {
    /// Parameters and bounds around a candidate as searched.
    pub fn new(workspace: &Workspace, start: &State, candidate: &Candidate) -> Self {
        let longest = workspace.task.pushes.length;
        let mut list = Vec::new();
        for (k, push) in candidate.pushes.iter().enumerate() {
            let mut add = |quantity, step, low, high| {
                list.push(Parameter { push: k, quantity, step, low, high });
            };
            let mut longest = longest;
            if let Start::Placed { part, offset } = push.start {
                // The span depends on the object's heading only, and little on that.
                let object = (start, push.object);
                let span = workspace.largest_offset(push.grip(), object, part, push.direction);
                let span = span.max(offset.abs());
                add(Quantity::Offset, OFFSET_STEP, -span, span);
                longest *= LONGEST;
            }
            // However often it was turned before, as plans are that are aimed again.
            let from = push.direction - turned(workspace, push.direction);
            let low = (from - LARGEST_TURN).min(push.direction);
            let high = (from + LARGEST_TURN).max(push.direction);
            add(Quantity::Direction, DIRECTION_STEP, low, high);
            add(Quantity::Length, LENGTH_STEP, MIN_LENGTH.min(longest), longest);
        }
        Self(list)
    }

    /// Returns their number.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Returns the bounds of each below and above `candidate`, in steps.
    pub fn room(&self, candidate: &Candidate) -> Vec<(f64, f64)> {
        let range = |p: &Parameter| {
            let value = read(candidate, p);
            ((p.low - value) / p.step, (p.high - value) / p.step)
        };
        self.0.iter().map(range).collect()
    }

    /// `candidate` moved by `steps`, cut to the bounds, and the steps really made.
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
