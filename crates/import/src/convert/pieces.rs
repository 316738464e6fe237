//! Solids of one body as few pieces: those that together cover hardly more than the body does become
//! one.

use nalgebra::Point3;

use pushplan::geometry::Vector;

use super::draft::Standing;
use super::shadow::area;
use super::upright::Upright;

/// The most pieces of a thing: itself and its parts.
pub(super) const MOST: usize = 17;

/// Up to this many exact solids are kept as they are.
const FEW: usize = 8;

/// Cells along the longer side of what a body covers.
const CELLS: f64 = 160.0;

/// What pieces may cover in addition when they become one, as a share of all.
const MORE: f64 = 0.01;

/// Pieces whose tops differ by more of the higher one stay apart.
const LEVEL: f64 = 0.2;

/// Solids with what each weighs, kg.
pub(super) type Weighed<'a> = Vec<(Standing<'a>, f64)>;

/// Fewer pieces that cover the same; and the area that they cover in addition, as a share.
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

/// One piece around two.
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

/// The table under a body in cells: those that it covers, and those that nothing gets into.
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
        // What cannot be reached from outside is as good as solid.
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

    /// Cells whose middle a convex outline covers.
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

    /// How much of a convex outline the body does not cover, as a share of what it does.
    fn beyond(&self, outline: &[Vector]) -> f64 {
        let free = self.under(outline).into_iter().filter(|k| !self.held[*k]).count();
        free as f64 / self.count as f64
    }
}
