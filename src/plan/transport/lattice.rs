//! The places to which one thing may be carried: a grid about where it stands.

use crate::geometry::{Footprint, Pose, Vector, contact_points};

/// Grid spacing where the scene is small enough, metres: half of the play in which things are still
/// pushed past each other.
const SPACING: f64 = 0.01;

/// At most this many places along a side; a larger scene gets coarser ones.
const MOST_PLACES: usize = 256;

/// A solid that moves along with a thing: one of its own, or of the tool behind it.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    pub footprint: Footprint,
    /// Against where the thing is, turned as in the world.
    pub pose: Pose,
    /// Heights above the table between which it is, metres.
    pub span: [f64; 2],
    /// What it keeps clear of everything, metres.
    pub apart: f64,
}

impl Solid {
    /// The same with the thing there.
    pub fn at(&self, position: Vector) -> Pose {
        Pose { position: self.pose.position + position, ..self.pose }
    }

    /// Whether another is partly as high.
    pub fn meets(&self, other: &Self) -> bool {
        self.span[0] < other.span[1] && other.span[0] < self.span[1]
    }

    /// Gap to something that stands still, with the thing at `position`, metres; at most `reach`.
    pub fn gap(&self, position: Vector, still: (&Footprint, &Pose), reach: f64) -> f64 {
        let (points, _) = contact_points((&self.footprint, &self.at(position)), still, reach);
        points[0].map_or(reach, |point| point.gap)
    }
}

/// A box in the world, metres along the grid's axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub low: Vector,
    pub high: Vector,
}

impl Extent {
    pub fn around(point: Vector) -> Self {
        Self { low: point, high: point }
    }

    pub fn include(&mut self, point: Vector) {
        self.low = self.low.inf(&point);
        self.high = self.high.sup(&point);
    }

    /// The spacing of grids in it, metres.
    pub fn spacing(&self) -> f64 {
        SPACING.max((self.high - self.low).max() / (MOST_PLACES - 1) as f64)
    }
}

/// The grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lattice {
    /// Where the thing stands, metres in the world: a place of its own.
    origin: Vector,
    pub spacing: f64,
    /// Of the first place, in steps from the origin.
    low: [i32; 2],
    columns: usize,
    rows: usize,
}

impl Lattice {
    pub fn new(origin: Vector, extent: &Extent, spacing: f64) -> Self {
        let steps = |v: f64| v / spacing;
        let [low, high] = [extent.low - origin, extent.high - origin];
        let low = [steps(low.x).floor().min(0.0) as i32, steps(low.y).floor().min(0.0) as i32];
        let high = [steps(high.x).ceil().max(0.0) as i32, steps(high.y).ceil().max(0.0) as i32];
        let [columns, rows] = [high[0] - low[0] + 1, high[1] - low[1] + 1].map(|n| n as usize);
        Self { origin, spacing, low, columns, rows }
    }

    pub fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// Where the thing stands, metres in the world.
    pub fn position_of_origin(&self) -> Vector {
        self.origin
    }

    /// Where a place is, metres in the world.
    pub fn position(&self, place: usize) -> Vector {
        let column = self.low[0] + (place % self.columns) as i32;
        let row = self.low[1] + (place / self.columns) as i32;
        self.origin + Vector::new(f64::from(column), f64::from(row)) * self.spacing
    }

    /// The nearest place.
    pub fn nearest(&self, position: Vector) -> usize {
        let local = (position - self.origin) / self.spacing;
        let index = |v: f64, low: i32, count: usize| {
            (v.round() - f64::from(low)).clamp(0.0, (count - 1) as f64) as usize
        };
        index(local.y, self.low[1], self.rows) * self.columns
            + index(local.x, self.low[0], self.columns)
    }

    /// The place one step further, if there is one.
    pub fn next(&self, place: usize, [x, y]: [i32; 2]) -> Option<usize> {
        let column = (place % self.columns) as i32 + x;
        let row = (place / self.columns) as i32 + y;
        let inside =
            (0..self.columns as i32).contains(&column) && (0..self.rows as i32).contains(&row);
        inside.then(|| row as usize * self.columns + column as usize)
    }

    /// Tells of every place from which `solid` is nearer than `reach` to what stands still, and its gap.
    pub fn near(
        &self,
        solid: &Solid,
        still: (&Footprint, &Pose),
        reach: f64,
        mut tell: impl FnMut(usize, f64),
    ) {
        // The other way round: where the thing may be for the boxes around both to meet.
        let wide = |(footprint, pose): (&Footprint, &Pose), axis: Vector| {
            footprint.extent(pose.local_vector(axis))
        };
        let (mut from, mut to) = ([0; 2], [0; 2]);
        for (k, axis) in [Vector::x(), Vector::y()].into_iter().enumerate() {
            let own = (&solid.footprint, &solid.pose);
            let (at, off) = (still.1.position[k], solid.pose.position[k]);
            let high = at + wide(still, axis) + wide(own, -axis) + reach - off;
            let low = at - wide(still, -axis) - wide(own, axis) - reach - off;
            let count = [self.columns, self.rows][k] as f64;
            let step = |v: f64| (v - self.origin[k]) / self.spacing - f64::from(self.low[k]);
            from[k] = step(low).ceil().clamp(0.0, count) as usize;
            to[k] = (step(high).floor() + 1.0).clamp(0.0, count) as usize;
        }
        for row in from[1]..to[1] {
            for column in from[0]..to[0] {
                let place = row * self.columns + column;
                let gap = solid.gap(self.position(place), still, reach);
                if gap < reach {
                    tell(place, gap);
                }
            }
        }
    }
}
