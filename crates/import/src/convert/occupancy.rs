//! Occupancy grid of the table under a body.

use crate::mesh::Mesh;
use pushplan::geometry::{Vector, planar_hull};

use super::shadow::area;

/// Number of grid cells along the longer side of the covered area.
const CELLS: f64 = 160.0;

/// Share of additional area in the hull of a body below which it counts as convex.
const CONVEX: f64 = 0.03;

/// Cells that a body covers, and cells enclosed by them.
pub(super) struct Occupancy {
    low: Vector,
    cell: f64,
    size: [usize; 2],
    /// Number of free cells before each column, row by row.
    free: Vec<Vec<u32>>,
    count: usize,
}

impl Occupancy {
    /// Creates the grid of a body with convex outlines.
    pub fn filled(outlines: &[Vec<Vector>]) -> Self {
        Self::within(outlines, outlines.iter().flatten())
    }

    /// Returns the areas that only the second and only the first of two bodies covers, relative to
    /// the area of the first.
    pub fn differences(one: &[Vec<Vector>], other: &[Vec<Vector>]) -> [f64; 2] {
        let all = || one.iter().chain(other).flatten();
        let [one, other] = [one, other].map(|outlines| Self::within(outlines, all()));
        let only = |a: &Self, b: &Self| {
            let rows = a.free.iter().zip(&b.free);
            let is_free = |row: &[u32], x: usize| row[x + 1] > row[x];
            let cells = rows.map(|(a, b)| {
                (0..a.len() - 1).filter(|x| !is_free(a, *x) && is_free(b, *x)).count()
            });
            cells.sum::<usize>() as f64
        };
        [only(&other, &one), only(&one, &other)].map(|count| count / one.count as f64)
    }

    /// Creates the grid of a body with convex outlines that extends over all points.
    fn within<'a>(outlines: &[Vec<Vector>], all: impl Iterator<Item = &'a Vector> + Clone) -> Self {
        let low = all.clone().fold(Vector::repeat(f64::INFINITY), |least, point| least.inf(point));
        let high = all.fold(Vector::repeat(f64::NEG_INFINITY), |most, point| most.sup(point));
        let cell = (high - low).max() / CELLS;
        let low = low - Vector::repeat(1.5 * cell);
        let size = [0, 1].map(|axis| ((high[axis] - low[axis]) / cell) as usize + 3);
        let mut grid = Self { low, cell, size, free: Vec::new(), count: 0 };
        let mut held = vec![false; size[0] * size[1]];
        for outline in outlines {
            grid.each_row(outline, |y, columns| {
                held[y * size[0]..][columns[0]..columns[1]].fill(true);
            });
        }
        let outside = outside(&held, size);
        grid.count = outside.iter().filter(|outside| !**outside).count().max(1);
        grid.free = outside.chunks(size[0]).map(counts).collect();
        grid
    }

    /// Returns the area of a convex outline outside the body, relative to the body's area.
    pub fn beyond(&self, outline: &[Vector]) -> f64 {
        let mut free = 0;
        self.each_row(outline, |y, [from, to]| {
            free += self.free[y][to] - self.free[y][from];
        });
        f64::from(free) / self.count as f64
    }

    /// Passes every row, with the range of columns whose centres a convex outline covers.
    fn each_row(&self, outline: &[Vector], mut row: impl FnMut(usize, [usize; 2])) {
        if outline.len() < 3 || area(outline) <= 0.0 {
            return;
        }
        let ends = outline.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| {
            [low.min(point.y), high.max(point.y)]
        });
        let rows = ends.map(|y| ((y - self.low.y) / self.cell).max(0.0) as usize);
        for y in rows[0].saturating_sub(1)..(rows[1] + 2).min(self.size[1]) {
            let height = self.low.y + (y as f64 + 0.5) * self.cell;
            let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
            for (a, b) in outline.iter().zip(outline.iter().cycle().skip(1)) {
                if (a.y - height) * (b.y - height) <= 0.0 && a.y != b.y {
                    let x = a.x + (b.x - a.x) * (height - a.y) / (b.y - a.y);
                    (from, to) = (from.min(x), to.max(x));
                }
            }
            let columns = self.columns(from, to);
            if columns[0] < columns[1] {
                row(y, columns);
            }
        }
    }

    /// Returns the range of columns whose centres are from `from` to `to`.
    fn columns(&self, from: f64, to: f64) -> [usize; 2] {
        let middle = |x: usize| self.low.x + (x as f64 + 0.5) * self.cell;
        let near = |x: f64| ((x - self.low.x) / self.cell - 2.0).max(0.0) as usize;
        let first = |inside: &dyn Fn(f64) -> bool, start: usize| {
            (start..self.size[0]).find(|x| inside(middle(*x))).unwrap_or(self.size[0])
        };
        if from > to {
            return [0, 0];
        }
        [first(&|x| x >= from, near(from)), first(&|x| x > to, near(to))]
    }
}

/// Returns the triangles of a mesh seen from above, counter-clockwise.
pub(super) fn seen(mesh: &Mesh) -> impl Iterator<Item = Vec<Vector>> + '_ {
    mesh.faces.iter().map(|face| {
        let point = |corner: u32| mesh.points[corner as usize];
        let mut corners = face.map(|corner| Vector::new(point(corner).x, point(corner).y)).to_vec();
        if area(&corners) < 0.0 {
            corners.reverse();
        }
        corners
    })
}

/// Returns `true` for a mesh whose area seen from above, holes included, is convex.
pub(crate) fn is_convex_above(mesh: &Mesh) -> bool {
    let triangles: Vec<Vec<Vector>> = seen(mesh).collect();
    let hull = planar_hull(&triangles.concat(), 0.0);
    hull.len() > 2 && Occupancy::filled(&triangles).beyond(&hull) < CONVEX
}

/// Returns the cells that are reached from the corner of the grid without a crossing of held cells.
fn outside(held: &[bool], [wide, high]: [usize; 2]) -> Vec<bool> {
    let mut outside = vec![false; held.len()];
    let mut waiting = vec![0];
    while let Some(k) = waiting.pop() {
        if outside[k] || held[k] {
            continue;
        }
        outside[k] = true;
        let (x, y) = (k % wide, k / wide);
        waiting.extend((x > 0).then(|| k - 1));
        waiting.extend((x + 1 < wide).then_some(k + 1));
        waiting.extend((y > 0).then(|| k - wide));
        waiting.extend((y + 1 < high).then_some(k + wide));
    }
    outside
}

/// Returns the number of `true` before each position, up to the end.
fn counts(row: &[bool]) -> Vec<u32> {
    let mut sum = 0;
    let before = row.iter().map(|free| {
        sum += u32::from(*free);
        sum
    });
    std::iter::once(0).chain(before).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle([x, y]: [f64; 2], [wide, high]: [f64; 2]) -> Vec<Vector> {
        [[x, y], [x + wide, y], [x + wide, y + high], [x, y + high]].map(Vector::from).to_vec()
    }

    #[test]
    fn areas_outside_count_without_enclosed_holes() {
        // A frame around a hole, and a bar beside it.
        let frame = [
            rectangle([0.0, 0.0], [0.1, 0.02]),
            rectangle([0.0, 0.08], [0.1, 0.02]),
            rectangle([0.0, 0.0], [0.02, 0.1]),
            rectangle([0.08, 0.0], [0.02, 0.1]),
        ];
        let grid = Occupancy::filled(&frame);
        assert_eq!(grid.beyond(&rectangle([0.01, 0.01], [0.08, 0.08])), 0.0);
        let beside = grid.beyond(&rectangle([0.0, 0.0], [0.15, 0.1]));
        assert!(beside < 0.02, "the grid ends beside the body: {beside}");
        let ell = [frame[0].clone(), frame[2].clone()];
        let beyond = Occupancy::filled(&ell).beyond(&rectangle([0.0, 0.0], [0.1, 0.1]));
        // Both edges of a bar are centres of cells, so it covers 33 of 161 columns.
        let free = 128.0 * 128.0;
        assert!((beyond - free / (161.0 * 161.0 - free)).abs() < 1e-12, "{beyond}");
    }
}
