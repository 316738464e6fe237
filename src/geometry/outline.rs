//! Decomposition of the union of rectangles into a few rectangles, such that each straight stretch
//! of the boundary belongs entirely to one of them.
//!
//! The sides of all rectangles lie along the axes, and their edges divide the plane into a grid.
//! The decomposition takes the largest rectangles in the union, as far as they are needed to hold
//! every stretch of its boundary from end to end, and every cell.

use super::Rim;
use super::rim::corner;

/// Distance below which edges are aligned, metres: rounding, and gaps that do not count.
const IN_LINE: f64 = 1e-4;

/// An axis-aligned rectangle: its lower left and upper right corner, metres.
pub type Extent = [[f64; 2]; 2];

/// A rectangle of the decomposition.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlinePiece {
    /// Extent of the rectangle.
    pub extent: Extent,
    /// Boundary exposed to contact, in the frame of its centre.
    pub rim: Rim,
}

/// Decomposes the union of `extents`.
pub fn outline(extents: &[Extent]) -> Vec<OutlinePiece> {
    let grid = Grid::new(extents);
    let stretches = grid.stretches();
    let largest = grid.largest();
    let mut taken: Vec<Cells> = Vec::new();
    for stretch in &stretches {
        if !taken.iter().any(|cells| stretch.lies_on(cells)) {
            // The stretch lies on the boundary, so one of the largest rectangles holds it.
            taken.extend(largest.iter().find(|cells| stretch.lies_on(cells)));
        }
    }
    for cells in &largest {
        if !cells.each().all(|cell| taken.iter().any(|other| other.holds(cell))) {
            taken.push(*cells);
        }
    }
    let mut pieces: Vec<OutlinePiece> = taken.iter().map(|cells| grid.piece(cells)).collect();
    for stretch in stretches {
        if let Some(owner) = taken.iter().position(|cells| stretch.lies_on(cells)) {
            grid.give(&stretch, &taken[owner], &mut pieces[owner]);
        }
    }
    pieces
}

/// A rectangle of grid cells: per axis from the first up to, but not including, the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Cells {
    from: [usize; 2],
    to: [usize; 2],
}

impl Cells {
    fn holds(&self, cell: [usize; 2]) -> bool {
        (0..2).all(|axis| self.from[axis] <= cell[axis] && cell[axis] < self.to[axis])
    }

    fn each(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        (self.from[0]..self.to[0])
            .flat_map(|column| (self.from[1]..self.to[1]).map(move |row| [column, row]))
    }
}

/// A straight stretch of the boundary.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    /// Index of the side: the body lies on its -x, -y, +x, +y side for 0 to 3.
    side: usize,
    /// Index of its grid line, and the range of lines of the other axis.
    line: usize,
    from: usize,
    to: usize,
}

impl Stretch {
    /// Returns the axis across the stretch.
    fn across(&self) -> usize {
        self.side % 2
    }

    /// Returns `true` if the stretch is part of the boundary of `cells`, which lie on its inner
    /// side.
    fn lies_on(&self, cells: &Cells) -> bool {
        let (across, along) = (self.across(), 1 - self.across());
        let line = if self.side < 2 { cells.to[across] } else { cells.from[across] };
        line == self.line && cells.from[along] <= self.from && self.to <= cells.to[along]
    }
}

/// The plane divided along all edges.
struct Grid {
    /// Coordinates of the grid lines across each axis.
    lines: [Vec<f64>; 2],
    filled: Vec<bool>,
}

impl Grid {
    fn new(extents: &[Extent]) -> Self {
        let lines = [0, 1].map(|axis| {
            let mut edges: Vec<f64> =
                extents.iter().flat_map(|extent| [extent[0][axis], extent[1][axis]]).collect();
            edges.sort_by(f64::total_cmp);
            edges.dedup_by(|next, kept| *next - *kept <= IN_LINE);
            edges
        });
        let mut grid = Self { filled: vec![false; lines[0].len() * lines[1].len()], lines };
        for extent in extents {
            let at = |corner: usize| [0, 1].map(|axis| grid.nearest(axis, extent[corner][axis]));
            let cells = Cells { from: at(0), to: at(1) };
            for cell in cells.each() {
                let index = grid.index(cell);
                grid.filled[index] = true;
            }
        }
        grid
    }

    /// Returns the grid line of an edge.
    fn nearest(&self, axis: usize, edge: f64) -> usize {
        // Lines are sorted, and each edge lies at most IN_LINE above its line.
        self.lines[axis].partition_point(|line| *line <= edge).saturating_sub(1)
    }

    fn index(&self, [column, row]: [usize; 2]) -> usize {
        row * self.lines[0].len() + column
    }

    /// Returns `true` if the cell above and to the right of these lines is filled; outside cells
    /// are not.
    fn is_filled(&self, column: isize, row: isize) -> bool {
        match (usize::try_from(column), usize::try_from(row)) {
            (Ok(column), Ok(row)) if column < self.lines[0].len() && row < self.lines[1].len() => {
                self.filled[self.index([column, row])]
            }
            _ => false,
        }
    }

    /// Returns all maximal rectangles of filled cells, largest area first.
    fn largest(&self) -> Vec<Cells> {
        let [columns, rows] = [0, 1].map(|axis| self.lines[axis].len() - 1);
        let full = |cells: Cells| cells.each().all(|cell| self.filled[self.index(cell)]);
        let mut found = Vec::new();
        for left in 0..columns {
            // Rows that are filled from `left` up to the current column.
            let mut open: Vec<bool> = vec![true; rows];
            for right in left + 1..=columns {
                for (row, open) in open.iter_mut().enumerate() {
                    *open &= self.filled[self.index([right - 1, row])];
                }
                let mut row = 0;
                while row < rows {
                    let run = open[row..].iter().take_while(|open| **open).count();
                    let cells = Cells { from: [left, row], to: [right, row + run] };
                    let beside = |column: usize| {
                        full(Cells { from: [column, row], to: [column + 1, row + run] })
                    };
                    let wider = left > 0 && beside(left - 1) || right < columns && beside(right);
                    if run > 0 && !wider {
                        found.push(cells);
                    }
                    row += run.max(1);
                }
            }
        }
        let area = |cells: &Cells| -> f64 {
            [0, 1]
                .map(|k| self.lines[k][cells.to[k]] - self.lines[k][cells.from[k]])
                .iter()
                .product()
        };
        found.sort_by(|a, b| area(b).total_cmp(&area(a)));
        found
    }

    /// Returns the straight stretches of the boundary, longest first.
    fn stretches(&self) -> Vec<Stretch> {
        let mut found = Vec::new();
        for side in 0..4 {
            let across = side % 2;
            let along = 1 - across;
            // For the first two sides the body lies at smaller coordinates.
            let is_edge = |line: usize, place: usize| {
                let filled = |offset: isize| {
                    let mut cell = [0; 2];
                    cell[across] = line as isize + offset;
                    cell[along] = place as isize;
                    self.is_filled(cell[0], cell[1])
                };
                let (inner, outer) = if side < 2 { (-1, 0) } else { (0, -1) };
                filled(inner) && !filled(outer)
            };
            for line in 0..self.lines[across].len() {
                let mut place = 0;
                while place < self.lines[along].len() {
                    let run = (place..self.lines[along].len())
                        .take_while(|&place| is_edge(line, place))
                        .count();
                    if run > 0 {
                        found.push(Stretch { side, line, from: place, to: place + run });
                    }
                    place += run.max(1);
                }
            }
        }
        let length = |stretch: &Stretch| {
            let lines = &self.lines[1 - stretch.across()];
            lines[stretch.to] - lines[stretch.from]
        };
        found.sort_by(|a, b| length(b).total_cmp(&length(a)));
        found
    }

    fn piece(&self, cells: &Cells) -> OutlinePiece {
        let corner = |lines: [usize; 2]| [0, 1].map(|axis| self.lines[axis][lines[axis]]);
        OutlinePiece { extent: [corner(cells.from), corner(cells.to)], rim: Rim::default() }
    }

    /// Exposes a stretch, with the body's corners at its ends, on a piece.
    fn give(&self, stretch: &Stretch, cells: &Cells, piece: &mut OutlinePiece) {
        let along = 1 - stretch.across();
        let middle = 0.5 * (piece.extent[0][along] + piece.extent[1][along]);
        let [from, to] = [stretch.from, stretch.to].map(|line| self.lines[along][line] - middle);
        piece.rim.sides[stretch.side].push((from, to));
        let outwards = stretch.side < 2;
        for (line, high) in [(stretch.from, false), (stretch.to, true)] {
            let end = if high { cells.to[along] } else { cells.from[along] };
            // Beyond an inner corner of the body the piece continues.
            if line == end && self.is_corner(stretch, line, high) {
                let (right, upper) = if along == 1 { (outwards, high) } else { (high, outwards) };
                piece.rim.corners[corner(right, upper)] = true;
            }
        }
    }

    /// Returns `true` if the boundary turns around the body at an end of a stretch, as at a convex
    /// corner.
    fn is_corner(&self, stretch: &Stretch, line: usize, high: bool) -> bool {
        let (across, along) = (stretch.across(), 1 - stretch.across());
        let beyond = if high { line as isize } else { line as isize - 1 };
        [stretch.line as isize - 1, stretch.line as isize].into_iter().all(|place| {
            let mut cell = [0; 2];
            cell[across] = place;
            cell[along] = beyond;
            !self.is_filled(cell[0], cell[1])
        })
    }
}

#[cfg(test)]
mod tests;
