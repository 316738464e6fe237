//! Ways of a tool that stays down between pushes: straight stretches among all bodies, with the
//! fewest turns.

use std::collections::VecDeque;

use crate::geometry::{Grid, Vector};

use super::collision::Collisions;
use super::lattice::Shift;

/// Number of steps by which a tool backs away from the group that it has pushed.
const BACK: usize = 2;

/// Positions of a tool that stays down, on a grid around its home.
pub(super) struct Floor {
    grid: Grid,
    /// Positions that are free among fixed bodies.
    free: Vec<bool>,
}

/// Positions that a tool reaches, each with the one before the last turn.
pub(super) struct Flood {
    before: Vec<Option<u32>>,
}

impl Floor {
    /// Computes the free positions around `home` within a box.
    pub fn around(
        home: Vector,
        corners: [Vector; 2],
        spacing: f64,
        is_free: impl Fn(Vector) -> bool,
    ) -> Self {
        let grid = Grid::covering(home, corners, spacing);
        let free = (0..grid.count()).map(|place| is_free(grid.position(place))).collect();
        Self { grid, free }
    }

    /// Returns the cell of a position, as columns and rows from home.
    pub fn cell(&self, position: Vector) -> Shift {
        self.grid.offset(self.grid.nearest(position)).map(|v| v as i16)
    }

    /// Computes the positions that the tool reaches from a position, by levels of equally many
    /// turns. `pushed` is the direction of the push before, if any, from which it backs away, and
    /// `tables` are its collisions with every group, each at its displacement in `shifts`.
    pub fn flood(
        &self,
        from: Vector,
        pushed: Option<[i32; 2]>,
        (tables, shifts): (&[&Collisions], &[Shift]),
    ) -> Flood {
        let grid = &self.grid;
        let first = grid.nearest(from);
        let is_free = |place: usize| {
            let at = grid.offset(place).map(|v| v as i16);
            self.free[place]
                && !tables.iter().zip(shifts).any(|(table, there)| table.meet(at, *there))
        };
        let mut flood = Flood { before: vec![None; grid.count()] };
        let mut levels = vec![u32::MAX; grid.count()];
        let mut queue = VecDeque::from([first]);
        (levels[first], flood.before[first]) = (0, Some(first as u32));
        let mut at = first;
        for _ in 0..BACK {
            let back = pushed.and_then(|step| grid.next(at, step.map(|s| -s)));
            let Some(next) = back.filter(|next| self.free[*next]) else { break };
            at = next;
            (levels[at], flood.before[at]) = (0, Some(first as u32));
            queue.push_back(at);
        }
        while let Some(place) = queue.pop_front() {
            for step in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
                let mut at = place;
                while let Some(next) = grid.next(at, step)
                    && levels[next] > levels[place]
                    && (levels[next] != u32::MAX || is_free(next))
                {
                    at = next;
                    if levels[at] == u32::MAX {
                        levels[at] = levels[place] + 1;
                        flood.before[at] = Some(place as u32);
                        queue.push_back(at);
                    }
                }
            }
        }
        flood
    }

    /// Returns the corners of the way to a position, the start excluded; `None` if there is none.
    pub fn corners(&self, flood: &Flood, to: Vector) -> Option<Vec<Vector>> {
        let grid = &self.grid;
        let place = grid.nearest(to);
        let mut at = [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]]
            .into_iter()
            .filter_map(|step| grid.next(place, step))
            .find(|at| flood.before[*at].is_some())?;
        let mut corners = vec![grid.position(at)];
        while let Some(before) = flood.before[at].map(|before| before as usize)
            && before != at
        {
            at = before;
            corners.push(grid.position(at));
        }
        // The last one is the start.
        corners.pop();
        corners.reverse();
        Some(corners)
    }
}
