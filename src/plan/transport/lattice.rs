//! Solids that move with a carried object, and the grid of places to which it may be carried.

use crate::geometry::{Footprint, Grid, Pose, Vector, contact_points};

/// Grid spacing for scenes of normal size, metres: half of the smallest play with which objects are
/// still pushed past each other.
const SPACING: f64 = 0.01;

/// Maximum number of places along a side; a larger scene gets a coarser grid.
const MOST_PLACES: usize = 256;

/// Displacement of a group from its start, in columns and rows of the grid.
pub(super) type Shift = [i16; 2];

/// Solid that moves with a carried object: one of its own, or one of the tool behind it.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    pub footprint: Footprint,
    /// Pose relative to the position of the object, with the heading in the world frame.
    pub pose: Pose,
    /// Lowest and highest height above the table, metres.
    pub span: [f64; 2],
    /// Required clearance to all other bodies, metres.
    pub apart: f64,
}

impl Solid {
    /// Returns the pose of the solid with the group at `position`.
    pub fn at(&self, position: Vector) -> Pose {
        Pose { position: self.pose.position + position, ..self.pose }
    }

    /// Returns `true` if the height ranges of both solids overlap.
    pub fn meets(&self, other: &Self) -> bool {
        self.span[0] < other.span[1] && other.span[0] < self.span[1]
    }

    /// Returns the gap to a fixed body, with the object at `position`, metres; at most `reach`.
    pub fn gap(&self, position: Vector, still: (&Footprint, &Pose), reach: f64) -> f64 {
        let (points, _) = contact_points((&self.footprint, &self.at(position)), still, reach);
        points[0].map_or(reach, |point| point.gap)
    }

    /// Calls `found` for every place of a grid at which the solid is nearer than `reach` to a fixed
    /// body, with the gap, metres.
    pub fn near(
        &self,
        grid: &Grid,
        still: (&Footprint, &Pose),
        reach: f64,
        mut found: impl FnMut(usize, f64),
    ) {
        // The bounding boxes of both bodies limit the places of the object.
        let wide = |(footprint, pose): (&Footprint, &Pose), axis: Vector| {
            footprint.extent(pose.local_vector(axis))
        };
        let (mut low, mut high) = (Vector::zeros(), Vector::zeros());
        for (k, axis) in [Vector::x(), Vector::y()].into_iter().enumerate() {
            let own = (&self.footprint, &self.pose);
            let (at, off) = (still.1.position[k], self.pose.position[k]);
            high[k] = at + wide(still, axis) + wide(own, -axis) + reach - off;
            low[k] = at - wide(still, -axis) - wide(own, axis) - reach - off;
        }
        for place in grid.within([low, high]) {
            let gap = self.gap(grid.position(place), still, reach);
            if gap < reach {
                found(place, gap);
            }
        }
    }
}

/// Axis-aligned box in the world frame, metres.
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

    /// Returns the grid over the box with `origin` as a place.
    pub fn grid(&self, origin: Vector, spacing: f64) -> Grid {
        Grid::covering(origin, [self.low, self.high], spacing)
    }

    /// Returns the spacing of grids in the box, metres.
    pub fn spacing(&self) -> f64 {
        SPACING.max((self.high - self.low).max() / (MOST_PLACES - 1) as f64)
    }
}
