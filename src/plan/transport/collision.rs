//! Collisions between bodies that only translate: tables over their relative displacement.

use crate::geometry::{Grid, Vector};

use super::lattice::{Shift, Solid};
use super::room::Room;

/// Relative displacements at which two bodies are too close to each other.
pub(super) struct Collisions {
    low: [i32; 2],
    columns: i32,
    rows: i32,
    near: Vec<bool>,
}

impl Collisions {
    /// Computes the table of a moving body, whose displacement is zero at the position `start`, and
    /// a body at rest, metres. Bodies nearer than `apart` are too close.
    pub fn of(
        (moving, start): (&[Solid], Vector),
        (still, at): (&[Solid], Vector),
        spacing: f64,
        apart: f64,
    ) -> Self {
        let wide = |solids: &[Solid]| {
            let far = |one: &Solid| one.pose.position.norm() + one.footprint.bounding_radius();
            solids.iter().map(far).fold(0.0, f64::max)
        };
        let reach = Vector::repeat(wide(moving) + wide(still) + apart.max(0.0) + spacing);
        let base = ((at - start) / spacing).map(f64::round);
        let middle = start + base * spacing;
        let grid = Grid::covering(middle, [middle - reach, middle + reach], spacing);
        let ([columns, rows], first) = (grid.sides(), grid.offset(0));
        let low = [base.x as i32 + first[0], base.y as i32 + first[1]];
        let mut near = vec![false; grid.count()];
        for own in moving {
            for other in still.iter().filter(|other| other.meets(own)) {
                let body = (&other.footprint, &other.at(at));
                own.near(&grid, body, apart.max(0.0) + spacing, |place, gap| {
                    near[place] |= gap < apart;
                });
            }
        }
        Self { low, columns: columns as i32, rows: rows as i32, near }
    }

    /// Samples the table of a tool and a body at rest from the room beside it. The end effector is
    /// at `start` where the displacement is zero, metres.
    pub fn sampled(room: &Room, start: Vector, spacing: f64) -> Self {
        let [low, high] = room.corners().map(|corner| (corner - start) / spacing);
        let low = [low.x.floor() as i32, low.y.floor() as i32];
        let [columns, rows] =
            [high.x.ceil() as i32 - low[0] + 1, high.y.ceil() as i32 - low[1] + 1];
        let near = |k: i32| {
            let [x, y] = [low[0] + k % columns, low[1] + k / columns].map(f64::from);
            !room.is_free(start + Vector::new(x, y) * spacing)
        };
        Self { low, columns, rows, near: (0..columns * rows).map(near).collect() }
    }

    /// Returns `true` if the bodies are too close at these displacements.
    pub fn meet(&self, moving: Shift, still: Shift) -> bool {
        let at = |k: usize| i32::from(moving[k]) - i32::from(still[k]) - self.low[k];
        let [x, y] = [at(0), at(1)];
        (0..self.columns).contains(&x)
            && (0..self.rows).contains(&y)
            && self.near[(y * self.columns + x) as usize]
    }
}
