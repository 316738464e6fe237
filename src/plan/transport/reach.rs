//! Transport of groups by the grips of one tool, with everything else at rest.

use std::cell::OnceCell;

use crate::geometry::{Grid, Vector};
use crate::plan::Workspace;
use crate::scene::Situation;

use super::collision::Collisions;
use super::distance::{Distances, pushes_for};
use super::group::{Group, Hold, groups, holds, step_of};
use super::held::Held;
use super::lattice::Shift;
use super::room::{BESIDE, Room};
use super::travel::{Flood, Floor};

/// Distance between positions for which the way of a lifted tool is examined, metres.
const SAMPLE: f64 = 0.02;

/// Tolerance for rounding, metres.
const SLACK: f64 = 1e-6;

/// Maximum number of holds of a group.
const HOLDS: usize = 64;

/// Groups that can be carried, with any tool.
pub struct Groups(Vec<Group>);

impl Groups {
    /// Returns the groups of a situation; `None` if a goal requires more than a change of position.
    pub fn of(workspace: &Workspace, situation: &Situation) -> Option<Self> {
        groups(workspace, situation).map(Self)
    }
}

/// Transport of groups by one tool.
pub struct Transport<'a> {
    pub(super) groups: &'a [Group],
    /// Directions of pushes, in columns and rows.
    pub(super) steps: Vec<[i32; 2]>,
    pub(super) longest: f64,
    workspace: Workspace<'a>,
    /// Tool and grip yaw (radians) of every grip.
    pub(super) grips: Vec<(usize, f64)>,
    situation: &'a Situation,
    free: Vec<FreeRoom<'a>>,
    /// Positions of a tool that stays down, and its collisions with every group.
    pub(super) floor: Option<Floor>,
    beside_floor: Vec<OnceCell<Collisions>>,
    /// Position of the end effector at the start.
    pub(super) home: Vector,
    /// Holds of every group, computed on demand.
    held: Vec<OnceCell<Held>>,
    /// Collisions of every pair of groups, computed on demand.
    between: Vec<OnceCell<Collisions>>,
    /// Room of every grip beside every group, computed on demand.
    rooms: Vec<OnceCell<Room>>,
    /// Distances to the goal, for groups with a goal.
    pub(super) distances: Vec<Option<Distances>>,
}

impl<'a> Transport<'a> {
    /// Creates the transport with one tool, with these grip yaws (radians) and pushes of at most
    /// `longest` metres. A tool that stays down begins at `home`. Returns `None` if a goal's object
    /// has no path even without other objects.
    pub fn new(
        workspace: Workspace<'a>,
        situation: &'a Situation,
        Groups(groups): &'a Groups,
        (tool, yaws): (usize, &[f64]),
        (home, longest): (Vector, f64),
    ) -> Option<Self> {
        let grips: Vec<(usize, f64)> = yaws.iter().map(|yaw| (tool, *yaw)).collect();
        let free = |grip: &(usize, f64)| FreeRoom::of(workspace, *grip, (situation, groups));
        let steps = workspace.task.pushes.directions.headings().into_iter().filter_map(step_of);
        let free: Vec<FreeRoom> = grips.iter().map(free).collect();
        let first = groups.first()?;
        let floor = (!workspace.is_placed()).then(|| {
            let (spacing, corners) = (first.lattice.spacing, free[0].room.corners());
            Floor::around(home, corners, spacing, |at| free[0].is_free(at))
        });
        let mut own = Self {
            groups,
            floor,
            beside_floor: groups.iter().map(|_| OnceCell::new()).collect(),
            home,
            steps: steps.map(|(step, _)| step).collect(),
            longest,
            workspace,
            situation,
            free,
            held: groups.iter().map(|_| OnceCell::new()).collect(),
            between: (0..groups.len().pow(2)).map(|_| OnceCell::new()).collect(),
            rooms: (0..groups.len() * grips.len()).map(|_| OnceCell::new()).collect(),
            distances: Vec::new(),
            grips,
        };
        let distances = |k: usize| {
            let group = &groups[k];
            group.goal?;
            let at_goal =
                |place: &usize| group.is_at_goal(group.lattice.offset(*place).map(|v| v as i16));
            let goals: Vec<usize> = (0..group.lattice.count()).filter(at_goal).collect();
            Some(Distances::to(&goals, (group, own.held(k)), &own.steps, longest))
        };
        own.distances = (0..groups.len()).map(distances).collect();
        own.least().is_finite().then_some(own)
    }

    /// Returns an estimate of the cost without obstructions, in pushes.
    pub fn least(&self) -> f64 {
        (0..self.groups.len()).map(|k| self.distance(k, [0, 0])).sum()
    }

    /// Returns the distance of a group to its goal, in pushes; 0 without a goal.
    pub(super) fn distance(&self, k: usize, at: Shift) -> f64 {
        let of = |distances: &Distances| {
            self.groups[k].place(at).map_or(f64::INFINITY, |place| distances.cost(place))
        };
        self.distances[k].as_ref().map_or(0.0, of)
    }

    /// Returns the holds of a group.
    pub(super) fn held(&self, k: usize) -> &Held {
        self.held[k].get_or_init(|| {
            let (workspace, group) = (&self.workspace, &self.groups[k]);
            let of = |grip: (usize, &(usize, f64))| {
                holds(workspace, (grip.0, *grip.1), self.situation, group)
            };
            let mut holds: Vec<Hold> = self.grips.iter().enumerate().flat_map(of).collect();
            holds.truncate(HOLDS);
            let is_free = |hold: &Hold, position: Vector| {
                self.free[hold.grip].is_free(position + hold.effector)
            };
            Held::of(group, holds, self.groups.len(), &self.steps, is_free)
        })
    }

    /// Returns the collisions of two groups.
    pub(super) fn beside(&self, (k, other): (usize, usize)) -> &Collisions {
        self.between[k * self.groups.len() + other].get_or_init(|| {
            let (group, still) = (&self.groups[k], &self.groups[other]);
            let (start, at) = (group.lattice.origin, still.lattice.origin);
            // Groups that start nearer may slide along each other.
            let mut apart = BESIDE;
            for own in &group.solids {
                for one in still.solids.iter().filter(|one| one.meets(own)) {
                    let gap = own.gap(start, (&one.footprint, &one.at(at)), BESIDE);
                    apart = apart.min(gap - SLACK);
                }
            }
            let spacing = group.lattice.spacing;
            Collisions::of((&group.solids, start), (&still.solids, at), spacing, apart)
        })
    }

    /// Computes the positions that a tool that stays down reaches from a position, after a push in
    /// the direction `pushed`; `None` for a tool that comes from above.
    pub(super) fn flood(
        &self,
        from: Vector,
        pushed: Option<[i32; 2]>,
        shifts: &[Shift],
    ) -> Option<Flood> {
        let floor = self.floor.as_ref()?;
        let table = |k: usize| {
            self.beside_floor[k].get_or_init(|| {
                let room = Room::beside(&self.workspace, self.grips[0], &self.groups[k]);
                Collisions::sampled(&room, self.home, self.groups[k].lattice.spacing)
            })
        };
        let tables: Vec<&Collisions> = (0..self.groups.len()).map(table).collect();
        Some(floor.flood(from, pushed, (&tables, shifts)))
    }

    /// Returns the corners of the way of a tool that stays down to a position; `None` without a
    /// way. A tool that comes from above has no corners.
    pub(super) fn travel(&self, flood: Option<&Flood>, to: Vector) -> Option<Vec<Vector>> {
        match (&self.floor, flood) {
            (Some(floor), Some(flood)) => floor.corners(flood, to),
            _ => Some(Vec::new()),
        }
    }

    /// Returns the length of a number of steps, metres.
    pub(super) fn length(&self, steps: i16) -> f64 {
        f64::from(steps) * self.groups.first().map_or(0.0, |group| group.lattice.spacing)
    }

    /// Returns the number of pushes for a length, metres.
    pub(super) fn pushes(&self, length: f64) -> usize {
        pushes_for(length, self.longest)
    }

    /// Returns the collisions of the tool behind a group with another group.
    pub(super) fn beside_tool(&self, (k, hold): (usize, usize), other: usize) -> &Collisions {
        let held = self.held(k);
        held.behind[hold * self.groups.len() + other].get_or_init(|| {
            let (group, hold) = (&self.groups[k], &held.holds[hold]);
            let room = self.rooms[hold.grip * self.groups.len() + other].get_or_init(|| {
                Room::beside(&self.workspace, self.grips[hold.grip], &self.groups[other])
            });
            let start = group.lattice.origin + hold.effector;
            Collisions::sampled(room, start, group.lattice.spacing)
        })
    }
}

/// Positions of the end effector at which one grip has room and that the lifted tool reaches.
struct FreeRoom<'a> {
    workspace: Workspace<'a>,
    yaw: f64,
    room: Room,
    /// Sampled positions that the lifted tool reaches; `None` if nothing is in its way.
    reached: Option<(Grid, Vec<bool>)>,
}

impl<'a> FreeRoom<'a> {
    fn of(
        workspace: Workspace<'a>,
        pair: (usize, f64),
        (situation, groups): (&Situation, &[Group]),
    ) -> Self {
        let mut corners = [Vector::repeat(f64::INFINITY), Vector::repeat(f64::NEG_INFINITY)];
        for grid in groups.iter().map(|group| group.lattice) {
            corners[0] = corners[0].inf(&grid.position(0));
            corners[1] = corners[1].sup(&grid.position(grid.count() - 1));
        }
        let room = Room::beside_fixed(&workspace, pair, (situation, groups), corners);
        let tool = &*workspace.tools[pair.0];
        let places = workspace.task.places(&workspace.task.scene, None, (tool, pair.1));
        let reached = places.map(|places| {
            let grid = Grid::covering(corners[0], corners, SAMPLE);
            let reached = |place: usize| places.reach(grid.position(place));
            (grid, (0..grid.count()).map(reached).collect())
        });
        Self { workspace, yaw: pair.1, room, reached }
    }

    fn is_free(&self, position: Vector) -> bool {
        self.room.is_free(position)
            && self.workspace.task.is_reachable(position, self.yaw)
            && self.reached.as_ref().is_none_or(|(grid, reached)| reached[grid.nearest(position)])
    }
}
