//! Square grids of points in the plane, and the frontier of a shortest-path search on them.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::Vector;

/// Grid points at equal distances along both axes, numbered row by row.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// A point of the grid, metres in the world.
    pub origin: Vector,
    /// Distance between neighbours, metres.
    pub spacing: f64,
    /// Column and row of the first point, counted from the origin.
    low: [i32; 2],
    columns: usize,
    rows: usize,
}

impl Grid {
    /// Creates a grid whose first point is `origin`.
    pub fn new(origin: Vector, spacing: f64, [columns, rows]: [usize; 2]) -> Self {
        Self { origin, spacing, low: [0, 0], columns, rows }
    }

    /// Creates a grid with a point at `origin` that covers the box between two corners, metres.
    pub fn covering(origin: Vector, [low, high]: [Vector; 2], spacing: f64) -> Self {
        let steps = |v: f64| v / spacing;
        let [low, high] = [low - origin, high - origin];
        let low = [steps(low.x).floor().min(0.0) as i32, steps(low.y).floor().min(0.0) as i32];
        let high = [steps(high.x).ceil().max(0.0) as i32, steps(high.y).ceil().max(0.0) as i32];
        let [columns, rows] = [high[0] - low[0] + 1, high[1] - low[1] + 1].map(|n| n as usize);
        Self { origin, spacing, low, columns, rows }
    }

    /// Returns the number of points.
    pub fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// Returns the position of a point, metres in the world.
    pub fn position(&self, place: usize) -> Vector {
        let [column, row] = self.offset(place);
        self.origin + Vector::new(f64::from(column), f64::from(row)) * self.spacing
    }

    /// Returns the point nearest to a position.
    pub fn nearest(&self, position: Vector) -> usize {
        let local = (position - self.origin) / self.spacing;
        let index = |v: f64, low: i32, count: usize| {
            (v.round() - f64::from(low)).clamp(0.0, (count - 1) as f64) as usize
        };
        index(local.y, self.low[1], self.rows) * self.columns
            + index(local.x, self.low[0], self.columns)
    }

    /// Returns the point at this offset in columns and rows, if it is inside the grid.
    pub fn next(&self, place: usize, [x, y]: [i32; 2]) -> Option<usize> {
        let [column, row] = self.offset(place);
        self.at([column + x, row + y])
    }

    /// Returns the numbers of columns and rows.
    pub fn sides(&self) -> [usize; 2] {
        [self.columns, self.rows]
    }

    /// Returns the columns and rows of a point, counted from the origin.
    pub fn offset(&self, place: usize) -> [i32; 2] {
        let (column, row) = (place % self.columns, place / self.columns);
        [self.low[0] + column as i32, self.low[1] + row as i32]
    }

    /// Returns the point at this offset from the origin, if it is inside the grid.
    pub fn at(&self, [x, y]: [i32; 2]) -> Option<usize> {
        let (column, row) = (x - self.low[0], y - self.low[1]);
        let inside =
            (0..self.columns as i32).contains(&column) && (0..self.rows as i32).contains(&row);
        inside.then(|| row as usize * self.columns + column as usize)
    }

    /// Returns a value at a position by bilinear interpolation between the values at all points;
    /// `None` outside the grid.
    pub fn interpolated(&self, values: &[f32], position: Vector) -> Option<f64> {
        let local = (position - self.origin) / self.spacing;
        let local = [local.x - f64::from(self.low[0]), local.y - f64::from(self.low[1])];
        let (column, row) = (local[0].floor(), local[1].floor());
        let inside = column >= 0.0
            && row >= 0.0
            && column + 1.0 < self.columns as f64
            && row + 1.0 < self.rows as f64;
        if !inside {
            return None;
        }
        let (x, y) = (local[0] - column, local[1] - row);
        let first = row as usize * self.columns + column as usize;
        let at = |place: usize| f64::from(values[place]);
        let lower = at(first) * (1.0 - x) + at(first + 1) * x;
        let upper = at(first + self.columns) * (1.0 - x) + at(first + self.columns + 1) * x;
        Some(lower * (1.0 - y) + upper * y)
    }

    /// Returns the points in the box between two corners, row by row.
    pub fn within(&self, [low, high]: [Vector; 2]) -> impl Iterator<Item = usize> + use<> {
        let range = |k: usize, count: usize| {
            let step = |v: f64| (v - self.origin[k]) / self.spacing - f64::from(self.low[k]);
            let from = step(low[k]).ceil().clamp(0.0, count as f64) as usize;
            let to = (step(high[k]).floor() + 1.0).clamp(0.0, count as f64) as usize;
            from..to
        };
        let (columns, count) = (range(0, self.columns), self.columns);
        range(1, self.rows)
            .flat_map(move |row| columns.clone().map(move |column| row * count + column))
    }
}

/// Priority queue of reached points, lowest cost first (Dijkstra 1959).
///
/// Costs are compared as bits, which order like the numbers because none is negative.
#[derive(Debug, Default)]
pub struct Frontier(BinaryHeap<Reverse<(u64, usize)>>);

impl Frontier {
    /// Adds a point that is reached at this cost.
    pub fn push(&mut self, cost: f64, place: usize) {
        self.0.push(Reverse((cost.to_bits(), place)));
    }

    /// Takes the point with the lowest cost; a point is returned once for every time it was added.
    pub fn pop(&mut self) -> Option<(f64, usize)> {
        self.0.pop().map(|Reverse((bits, place))| (f64::from_bits(bits), place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_again_and_end_at_the_border() {
        let corners = [Vector::new(-0.05, 0.0), Vector::new(0.1, 0.12)];
        let grid = Grid::covering(Vector::new(0.02, 0.03), corners, 0.05);
        for place in 0..grid.count() {
            assert_eq!(grid.nearest(grid.position(place)), place);
        }
        let (first, last) = (0, grid.count() - 1);
        let (low, high) = (grid.position(first), grid.position(last));
        assert!(low.x <= corners[0].x && low.y <= corners[0].y, "{low:?}");
        assert!(high.x >= corners[1].x && high.y >= corners[1].y, "{high:?}");
        assert_eq!((grid.next(first, [-1, 0]), grid.next(last, [0, 1])), (None, None));
        assert_eq!(grid.next(first, [1, 1]).map(|place| grid.next(place, [-1, -1])), Some(Some(0)));
        let all: Vec<usize> = grid.within([Vector::repeat(-1.0), Vector::repeat(1.0)]).collect();
        assert_eq!(all, (0..grid.count()).collect::<Vec<_>>());
        let at = grid.position(4);
        assert_eq!(grid.within([at, at]).collect::<Vec<_>>(), [4]);
    }

    #[test]
    fn a_frontier_gives_the_nearest_place_first() {
        let mut frontier = Frontier::default();
        for (cost, place) in [(2.0, 1), (0.5, 7), (0.5, 3), (0.0, 9)] {
            frontier.push(cost, place);
        }
        let order: Vec<usize> = std::iter::from_fn(|| frontier.pop()).map(|(_, k)| k).collect();
        assert_eq!(order, [9, 3, 7, 1]);
    }
}
