//! Reduction of the number of solids of a body: solids are merged if the result covers hardly more
//! area than the body.

use nalgebra::Point3;

use pushplan::geometry::Vector;

use super::draft::Standing;
use super::shadow::area;
use super::upright::Upright;

/// Maximum number of solids of an object, including its parts.
pub(super) const MOST: usize = 17;

/// Number of exact solids up to which nothing is merged.
const FEW: usize = 8;

/// Number of grid cells along the longer side of the covered area.
const CELLS: f64 = 160.0;

/// Maximum additional area of a merge, relative to the covered area.
const MORE: f64 = 0.01;

/// Maximum difference in top height of merged solids, relative to the higher one.
const LEVEL: f64 = 0.2;

/// Solids with their masses, kg.
pub(super) type Weighed<'a> = Vec<(Standing<'a>, f64)>;

/// Returns fewer solids that cover nearly the same area, and the additional area as a share.
pub(super) fn fewer(mut pieces: Weighed<'_>) -> (Weighed<'_>, f64) {
    let rough = pieces.iter().any(|(piece, _)| piece.upright.rough.is_some());
    if pieces.len() < 2 || !rough && pieces.len() <= FEW {
        return (pieces, 0.0);
    }
    let outlines: Vec<Vec<Vector>> =
        pieces.iter().map(|(piece, _)| piece.upright.outline()).collect();
    let grid = Grid::filled(&outlines);
    let mut more = 0.0;
    while pieces.len() > 1 {
        let mut best: Option<(f64, usize, usize, Upright)> = None;
        for a in 0..pieces.len() {
            for b in a + 1..pieces.len() {
                let [one, other] = [a, b].map(|k| &pieces[k].0);
                let tops = [one, other].map(|piece| piece.upright.top());
                let low = one.upright.low.min(other.upright.low);
                let uneven = (tops[0] - tops[1]).abs() / (tops[0].max(tops[1]) - low);
                let feet = !one.feet.is_empty() || !other.feet.is_empty();
                if feet || pieces.len() <= MOST && uneven > LEVEL {
                    continue;
                }
                let Some(both) = joined(&one.upright, &other.upright) else { continue };
                let cost = grid.beyond(&both.outline()) + uneven.max(0.0) * MORE;
                if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                    best = Some((cost, a, b, both));
                }
            }
        }
        let Some((cost, a, b, both)) = best else { break };
        if cost > 2.0 * MORE && pieces.len() <= MOST {
            break;
        }
        more += grid.beyond(&both.outline());
        let (_, mass) = pieces.remove(b);
        pieces[a].0.upright = both;
        pieces[a].1 += mass;
    }
    (pieces, more)
}

/// Returns a solid that encloses two solids.
fn joined(one: &Upright, other: &Upright) -> Option<Upright> {
    let (low, top) = (one.low.min(other.low), one.top().max(other.top()));
    let at = |z: f64| move |point: Vector| Point3::new(point.x, point.y, z);
    let points: Vec<Point3<f64>> = one
        .outline()
        .into_iter()
        .chain(other.outline())
        .flat_map(|p| [at(low)(p), at(top)(p)])
        .collect();
    Upright::over(&points, None, false)
}

/// Occupancy grid of the table under a body: covered cells, and cells enclosed by them.
struct Grid {
    low: Vector,
    cell: f64,
    size: [usize; 2],
    held: Vec<bool>,
    count: usize,
}

impl Grid {
    fn filled(outlines: &[Vec<Vector>]) -> Self {
        let all = || outlines.iter().flatten();
        let low = all().fold(Vector::repeat(f64::INFINITY), |least, point| least.inf(point));
        let high = all().fold(Vector::repeat(f64::NEG_INFINITY), |most, point| most.sup(point));
        let cell = (high - low).max() / CELLS;
        let low = low - Vector::repeat(1.5 * cell);
        let size = [0, 1].map(|axis| ((high[axis] - low[axis]) / cell) as usize + 3);
        let held = vec![false; size[0] * size[1]];
        let mut grid = Self { low, cell, size, held, count: 0 };
        for outline in outlines {
            for k in grid.under(outline) {
                grid.held[k] = true;
            }
        }
        // Cells that cannot be reached from outside count as occupied.
        let mut outside = vec![false; grid.held.len()];
        let mut waiting = vec![0];
        while let Some(k) = waiting.pop() {
            if outside[k] || grid.held[k] {
                continue;
            }
            outside[k] = true;
            let [wide, high] = grid.size;
            let (x, y) = (k % wide, k / wide);
            waiting.extend((x > 0).then(|| k - 1));
            waiting.extend((x + 1 < wide).then_some(k + 1));
            waiting.extend((y > 0).then(|| k - wide));
            waiting.extend((y + 1 < high).then_some(k + wide));
        }
        grid.held = outside.iter().map(|outside| !outside).collect();
        grid.count = grid.held.iter().filter(|held| **held).count().max(1);
        grid
    }

    /// Returns the cells whose centres a convex outline covers.
    fn under(&self, outline: &[Vector]) -> Vec<usize> {
        if outline.len() < 3 || area(outline) <= 0.0 {
            return Vec::new();
        }
        let mut found = Vec::new();
        for y in 0..self.size[1] {
            let height = self.low.y + (y as f64 + 0.5) * self.cell;
            let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
            for (a, b) in outline.iter().zip(outline.iter().cycle().skip(1)) {
                if (a.y - height) * (b.y - height) <= 0.0 && a.y != b.y {
                    let x = a.x + (b.x - a.x) * (height - a.y) / (b.y - a.y);
                    (from, to) = (from.min(x), to.max(x));
                }
            }
            for x in 0..self.size[0] {
                let middle = self.low.x + (x as f64 + 0.5) * self.cell;
                if (from..=to).contains(&middle) {
                    found.push(y * self.size[0] + x);
                }
            }
        }
        found
    }

    /// Returns the area of a convex outline outside the body, relative to the body's area.
    fn beyond(&self, outline: &[Vector]) -> f64 {
        let free = self.under(outline).into_iter().filter(|k| !self.held[*k]).count();
        free as f64 / self.count as f64
    }
}
