//! Lever-ups that a task's rules allow, on a grid.

use crate::task::{LeverRules, LeverUp, Pivot, Place, Task};

/// Maximum number of lever points along the outline.
const MOST: f64 = 256.0;

/// Distances tried for axes derived from the plate, as multiples of the distance of its support
/// line. Slips are fewest at the line itself. Slightly other distances lift boards out of pockets
/// that hold their far edge.
const AUTO: [f64; 3] = [1.0, 0.85, 1.2];

/// Number of depths tried within the task's range.
const DEPTHS: usize = 3;

/// Number of angles tried within the task's range.
const ANGLES: usize = 6;

/// Lever-up with its cell of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeverCandidate {
    /// Index of the tool.
    pub tool: usize,
    /// Indices of the lever point along the outline, depth, axis and angle.
    pub cell: [usize; 4],
    /// The lever-up.
    pub lever: LeverUp,
}

/// Grid of the lever-ups of one tool in a task.
pub struct LeverGrid<'a> {
    /// The task.
    pub task: &'a Task,
    /// Index of the tool.
    pub tool: usize,
    /// Distance between lever points, metres.
    pub apart: f64,
}

impl LeverGrid<'_> {
    /// Returns all lever-ups in order. The pivot is NaN if no axis follows from the plate.
    pub fn candidates(&self) -> Vec<LeverCandidate> {
        let (plate, rules) = (self.task.plate(), self.task.lever_rules());
        let depths = spread(rules.depth, DEPTHS);
        let angles = spread(rules.angle, ANGLES);
        let (plate, rules) = (&plate, &rules);
        let axes = |place: Place| {
            rules.pivots.iter().flat_map(move |pivot| match *pivot {
                Pivot::Auto => {
                    let line = plate.auto_pivot(place).unwrap_or(f64::NAN);
                    AUTO.map(|factor| factor * line).to_vec()
                }
                Pivot::At(distance) => vec![distance],
            })
        };
        let mut found = Vec::new();
        for (p, place) in self.places().into_iter().enumerate() {
            for (d, &depth) in depths.iter().enumerate() {
                for (q, pivot) in axes(place).enumerate() {
                    for (a, &angle) in angles.iter().enumerate() {
                        let lever = LeverUp {
                            plate: self.task.levered().object,
                            place,
                            depth,
                            pivot,
                            angle,
                            speed: rules.speed,
                            hold: rules.hold,
                            retreat: rules.retreat,
                        };
                        let cell = [p, d, q, a];
                        found.push(LeverCandidate { tool: self.tool, cell, lever });
                    }
                }
            }
        }
        found
    }

    /// Returns lever points along the outline, away from its corners and evenly spaced on each
    /// edge.
    fn places(&self) -> Vec<Place> {
        let plate = self.task.plate();
        let corners = plate.corners();
        let side = |k: usize| (corners[(k + 1) % corners.len()] - corners[k]).norm();
        let around: f64 = (0..corners.len()).map(side).sum();
        let apart = self.apart.max(around / MOST);
        let mut places = Vec::new();
        for edge in 0..corners.len() {
            let length = side(edge);
            let free = length - 2.0 * LeverRules::CORNER;
            if free < 0.0 {
                continue;
            }
            let gaps = (free / apart).floor() as usize;
            let used = gaps as f64 * apart;
            let first = LeverRules::CORNER + 0.5 * (free - used);
            places.extend((0..=gaps).map(|k| {
                let along = first + k as f64 * apart;
                Place { edge, fraction: (along / length).clamp(0.0, 1.0) }
            }));
        }
        places
    }
}

/// Returns `count` evenly spaced numbers from the lowest to the highest, or a single number if both
/// are equal.
fn spread([low, high]: [f64; 2], count: usize) -> Vec<f64> {
    if high - low < 1e-12 {
        return vec![low];
    }
    (0..count).map(|k| low + (high - low) * k as f64 / (count - 1) as f64).collect()
}
