//! Reduction of the number of solids of a body: solids are merged if the result covers hardly more
//! area than the body.
//!
//! The cost of every pair is computed once, and again only for pairs with a merged solid. The time
//! therefore grows with the square of the number of solids.

use nalgebra::Point3;

use pushplan::geometry::{Vector, planar_hull};

use super::draft::Standing;
use super::occupancy::Occupancy;
use super::shadow::{FLAT, area};
use super::upright::{THIN, Upright};

/// Maximum number of solids of an object, including its parts.
pub(super) const MOST: usize = 17;

/// Number of exact solids up to which nothing is merged.
const FEW: usize = 8;

/// Maximum additional area of a merge, relative to the covered area.
const MORE: f64 = 0.01;

/// Maximum difference in height of merged solids, relative to the higher one.
const LEVEL: f64 = 0.2;

/// Solids with their masses, kg.
pub(super) type Weighed<'a> = Vec<(Standing<'a>, f64)>;

/// Returns fewer solids that cover nearly the same area, and the additional area as a share.
pub(super) fn fewer(pieces: Weighed<'_>) -> (Weighed<'_>, f64) {
    let rough = pieces.iter().any(|(piece, _)| piece.upright.rough.is_some());
    if pieces.len() < 2 || !rough && pieces.len() <= FEW {
        return (pieces, 0.0);
    }
    let mut merging = Merging::of(pieces);
    let mut more = 0.0;
    while let Some(Merge { cost, pair }) = merging.best() {
        if cost > 2.0 * MORE && merging.count <= MOST {
            break;
        }
        more += merging.merge(pair);
    }
    (merging.pieces.into_iter().flatten().collect(), more)
}

/// Merge of two solids, the first before the second.
#[derive(Clone, Copy)]
struct Merge {
    cost: f64,
    pair: [usize; 2],
}

/// Solids during their merging.
struct Merging<'a> {
    /// Solids in order; `None` for those merged into an earlier one.
    pieces: Vec<Option<(Standing<'a>, f64)>>,
    count: usize,
    outlines: Vec<Vec<Vector>>,
    grid: Occupancy,
    /// Cost of the merge of each pair, infinite if it is impossible: for every solid, those with
    /// later solids.
    costs: Vec<Vec<f64>>,
    /// Cheapest merge of every solid with a later one.
    cheapest: Vec<Option<Merge>>,
}

impl<'a> Merging<'a> {
    fn of(pieces: Weighed<'a>) -> Self {
        let outlines: Vec<Vec<Vector>> =
            pieces.iter().map(|(piece, _)| piece.upright.outline()).collect();
        let (grid, count) = (Occupancy::filled(&outlines), pieces.len());
        let pieces = pieces.into_iter().map(Some).collect();
        let (costs, cheapest) = (Vec::new(), vec![None; count]);
        let mut merging = Self { pieces, count, outlines, grid, costs, cheapest };
        let row = |a: usize| (a + 1..count).map(|b| merging.cost([a, b])).collect();
        merging.costs = (0..count).map(row).collect();
        merging.compare_all();
        merging
    }

    /// Returns the cheapest merge, the first of equals.
    fn best(&self) -> Option<Merge> {
        let merges = self.cheapest.iter().flatten();
        merges.copied().reduce(|best, other| if other.cost < best.cost { other } else { best })
    }

    /// Replaces the first of two solids by the solid around both; returns the additional area. If
    /// there is none, the pair is not merged any more.
    fn merge(&mut self, [a, b]: [usize; 2]) -> f64 {
        let both = self.upright(a).zip(self.upright(b));
        let Some(both) = both.and_then(|(one, other)| joined(one, other)) else {
            self.costs[a][b - a - 1] = f64::INFINITY;
            self.compare(a);
            return 0.0;
        };
        let outline = both.outline();
        let more = self.grid.beyond(&outline);
        let mass = self.pieces[b].take().map_or(0.0, |(_, mass)| mass);
        if let Some((piece, own)) = &mut self.pieces[a] {
            piece.upright = both;
            *own += mass;
        }
        self.outlines[a] = outline;
        self.count -= 1;
        for other in (0..self.pieces.len()).filter(|other| *other != a) {
            let pair = [a.min(other), a.max(other)];
            self.costs[pair[0]][pair[1] - pair[0] - 1] = self.cost(pair);
        }
        // With few solids, fewer merges are permitted.
        if self.count <= MOST {
            self.compare_all();
            return more;
        }
        self.cheapest[b] = None;
        self.compare(a);
        for row in 0..b {
            let lost = self.cheapest[row].is_some_and(|merge| [a, b].contains(&merge.pair[1]));
            if lost || row < a && self.is_cheaper([row, a]) {
                self.compare(row);
            }
        }
        more
    }

    /// Returns `true` if a pair is as cheap as the cheapest merge of its first solid.
    fn is_cheaper(&self, pair: [usize; 2]) -> bool {
        let cost = self.costs[pair[0]][pair[1] - pair[0] - 1];
        cost.is_finite() && self.cheapest[pair[0]].is_none_or(|merge| cost <= merge.cost)
    }

    fn compare_all(&mut self) {
        (0..self.pieces.len()).for_each(|row| self.compare(row));
    }

    /// Finds the cheapest permitted merge of a solid with a later one.
    fn compare(&mut self, a: usize) {
        let mut best: Option<Merge> = None;
        for (k, cost) in self.costs[a].iter().enumerate() {
            let pair = [a, a + 1 + k];
            let cheaper = cost.is_finite() && best.is_none_or(|best| *cost < best.cost);
            if cheaper && (self.count > MOST || !self.is_uneven(pair)) {
                best = Some(Merge { cost: *cost, pair });
            }
        }
        self.cheapest[a] = best;
    }

    fn upright(&self, piece: usize) -> Option<&Upright> {
        self.pieces[piece].as_ref().map(|(piece, _)| &piece.upright)
    }

    fn is_uneven(&self, pair: [usize; 2]) -> bool {
        self.uneven(pair) > LEVEL
    }

    /// Returns the differences in height of the tops and undersides of two solids, relative to the
    /// higher one.
    fn uneven(&self, pair: [usize; 2]) -> f64 {
        let [Some(one), Some(other)] = pair.map(|piece| self.upright(piece)) else {
            return f64::INFINITY;
        };
        let tops = [one, other].map(Upright::top);
        let low = one.low.min(other.low);
        let off = (tops[0] - tops[1]).abs() + (one.low - other.low).abs();
        off / (tops[0].max(tops[1]) - low)
    }

    /// Returns the cost of a merge: the additional area, and a little for uneven tops. The cost is
    /// infinite if there is no solid around both, or one of them has feet.
    fn cost(&self, [a, b]: [usize; 2]) -> f64 {
        let [Some((one, _)), Some((other, _))] = [&self.pieces[a], &self.pieces[b]] else {
            return f64::INFINITY;
        };
        if !one.feet.is_empty() || !other.feet.is_empty() {
            return f64::INFINITY;
        }
        let [one, other] = [&one.upright, &other.upright];
        // Every corner counts twice, as in `joined`, at the bottom and at the top.
        let twice = |corner: &Vector| [*corner; 2];
        let corners: Vec<Vector> =
            self.outlines[a].iter().chain(&self.outlines[b]).flat_map(twice).collect();
        let outline = planar_hull(&corners, 0.0);
        let height = one.top().max(other.top()) - one.low.min(other.low);
        if outline.len() < 3 || area(&outline) < FLAT || height < THIN {
            return f64::INFINITY;
        }
        self.grid.beyond(&outline) + self.uneven([a, b]).max(0.0) * MORE
    }
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
