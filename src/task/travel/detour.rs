//! Detours around tall bodies, found on a grid of positions of the end effector.

use std::collections::VecDeque;

use crate::geometry::{Grid, Vector};
use crate::scene::Robot;

use super::space::Space;

/// Distance from which a position is joined to the grid, metres.
const NEAR: f64 = 0.08;

/// Resolution of the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Resolution {
    /// Distance between cells, metres.
    spacing: f64,
    /// Maximum number of cells along a side.
    cells: usize,
    /// Clearance of a free cell, in cells. Neighbours are at most 1.5 cells apart, so half of that
    /// at two free cells keeps the path between them free.
    room: f64,
}

impl Resolution {
    /// Resolution of a test that refuses no reachable position: free cells only have to be free
    /// themselves. A C-obstacle is at least as thick as a hand or a tool.
    pub const ROUGH: Self = Self { spacing: 0.02, cells: 160, room: 0.0 };

    /// Resolutions of paths, tried in order.
    pub const PATHS: [Self; 2] = [
        Self { spacing: 0.02, cells: 160, room: 0.75 },
        Self { spacing: 0.01, cells: 320, room: 0.75 },
    ];

    fn grid(&self, reach: f64) -> Grid {
        let spacing = self.spacing.max(2.0 * reach / (self.cells - 1) as f64);
        let count = (2.0 * reach / spacing).ceil() as usize + 1;
        Grid::new(Vector::repeat(-reach), spacing, [count, count])
    }

    /// Returns the free cells of a grid.
    fn free(&self, space: &Space, grid: &Grid) -> Vec<bool> {
        let room = self.room * grid.spacing;
        (0..grid.count()).map(|cell| space.is_free(grid.position(cell), room)).collect()
    }
}

/// Positions to which a lifted tool can travel.
pub struct ReachablePositions<'a> {
    space: Space<'a>,
    grid: Grid,
    /// Cells without a collision.
    free: Vec<bool>,
    /// Position from which the tool travels.
    home: Vector,
    /// Previous cell on the path from home, for each cell that it reaches.
    before: Vec<Option<usize>>,
}

impl<'a> ReachablePositions<'a> {
    /// Computes the positions that a tool reaches from `home`. If it does not fit there, it is held
    /// with its yaw at the nearest position that fits and that the `hand` alone reaches.
    pub(super) fn from_home(
        space: Space<'a>,
        hand: impl FnOnce() -> Space<'a>,
        resolution: Resolution,
    ) -> Self {
        let grid = resolution.grid(space.robot.reach_max);
        let free = resolution.free(&space, &grid);
        let mut own = Self { home: home(space.robot), grid, free, before: Vec::new(), space };
        if !own.space.is_free(own.home, 0.0) {
            own.home = own.fitting(hand(), resolution).unwrap_or(own.home);
        }
        own.before = own.flood(own.home);
        own
    }

    /// Returns the position from which the tool travels.
    pub fn home(&self) -> Vector {
        self.home
    }

    /// Returns `true` if the tool can travel from home to a position.
    pub fn reach(&self, position: Vector) -> bool {
        self.space.met([self.home, position]).is_none() || self.joined(position).is_some()
    }

    /// Returns the corners of a path between two positions, ends included.
    ///
    /// # Errors
    /// Returns the name of the first body on the straight line if there is no path.
    pub(super) fn path(
        &self,
        ends: [Vector; 2],
    ) -> Result<(Vec<Vector>, Option<&'a str>), &'a str> {
        let Some(what) = self.space.met(ends) else { return Ok((ends.to_vec(), None)) };
        let around = || {
            if ends[0] == self.home {
                return self.back_from(&self.before, ends);
            }
            if ends[1] == self.home {
                let mut path = self.back_from(&self.before, [ends[1], ends[0]])?;
                path.reverse();
                return Some(path);
            }
            self.back_from(&self.flood(ends[0]), ends)
        };
        around().map(|path| (path, Some(what))).ok_or(what)
    }

    /// Returns the nearest cell to home in which the tool fits and which the hand reaches. The hand
    /// begins at home, or at the nearest position at which it fits itself.
    fn fitting(&self, hand: Space<'a>, resolution: Resolution) -> Option<Vector> {
        let free = resolution.free(&hand, &self.grid);
        let off = |k: &usize| (self.grid.position(*k) - self.home).norm();
        let nearest = |cells: &mut dyn Iterator<Item = usize>| {
            let found = cells.min_by(|a, b| off(a).total_cmp(&off(b)))?;
            Some(self.grid.position(found))
        };
        let cells = 0..self.grid.count();
        let from = match hand.is_free(self.home, 0.0) {
            true => self.home,
            false => nearest(&mut cells.clone().filter(|&k| free[k]))?,
        };
        let alone = Self { home: from, grid: self.grid, free, before: Vec::new(), space: hand };
        let reached = alone.flood(from);
        nearest(&mut cells.filter(|&k| self.free[k] && reached[k].is_some()))
    }

    /// Returns the previous cell for each cell that a path from a position reaches.
    fn flood(&self, from: Vector) -> Vec<Option<usize>> {
        let mut before = vec![None; self.grid.count()];
        let mut queue: VecDeque<usize> = VecDeque::new();
        for cell in self.seen_from(from) {
            before[cell] = Some(cell);
            queue.push_back(cell);
        }
        while let Some(cell) = queue.pop_front() {
            for next in NEIGHBOURS.into_iter().filter_map(|step| self.grid.next(cell, step)) {
                if self.free[next] && before[next].is_none() {
                    before[next] = Some(cell);
                    queue.push_back(next);
                }
            }
        }
        before
    }

    /// Returns the free cells near a position to which a straight path is free.
    fn seen_from(&self, position: Vector) -> impl Iterator<Item = usize> {
        let corners = [position - Vector::repeat(NEAR), position + Vector::repeat(NEAR)];
        self.grid.within(corners).filter(move |&cell| {
            let at = self.grid.position(cell);
            self.free[cell]
                && (at - position).norm() < NEAR
                && self.space.met([position, at]).is_none()
        })
    }

    /// Returns the first cell near a position that a path from home reaches.
    fn joined(&self, position: Vector) -> Option<usize> {
        self.seen_from(position).find(|&cell| self.before[cell].is_some())
    }

    /// Returns the corners of the path found by a flood from its first end to the last.
    fn back_from(&self, before: &[Option<usize>], ends: [Vector; 2]) -> Option<Vec<Vector>> {
        let mut cell = self.seen_from(ends[1]).find(|&cell| before[cell].is_some())?;
        let mut path = vec![ends[1], self.grid.position(cell)];
        while let Some(earlier) = before[cell].filter(|earlier| *earlier != cell) {
            cell = earlier;
            path.push(self.grid.position(cell));
        }
        path.push(ends[0]);
        path.reverse();
        Some(self.straightened(&path))
    }

    /// Removes unnecessary corners of a path.
    fn straightened(&self, path: &[Vector]) -> Vec<Vector> {
        let (mut corners, mut here) = (vec![path[0]], 0);
        while here + 1 < path.len() {
            let sees = |next: &usize| {
                let along = |k: i32| path[here].lerp(&path[*next], f64::from(k) / 8.0);
                let within = (1..8).all(|k| self.space.robot.reaches(along(k)));
                within && self.space.met([path[here], path[*next]]).is_none()
            };
            here = (here + 2..path.len()).rev().find(sees).unwrap_or(here + 1);
            corners.push(path[here]);
        }
        corners
    }
}

/// Returns the home of a robot: the stated one, or the nearest position within reach and beside its
/// column.
pub(super) fn home(robot: &Robot) -> Vector {
    let home = robot.home;
    let least = robot.reach_min.max(Robot::usual_reach_min(robot.base, robot.hand));
    match home.norm() {
        near if near >= least => home,
        near if near > 0.0 => home * (least / near),
        _ => Vector::new(least, 0.0),
    }
}

const NEIGHBOURS: [[i32; 2]; 8] =
    [[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [1, -1], [-1, 1], [-1, -1]];
