//! Remaining distance of objects to their goals around obstacles, and the obstructions to clear
//! first. It ranks the beam over push sequences, because the straight distance leads into every
//! dead end.
//!
//! If the straight path to the goal is free, the distance is Euclidean and exact. Otherwise it is
//! computed by Dijkstra's algorithm on a grid with sixteen neighbours.

use std::sync::Arc;

use crate::geometry::{Footprint, Frontier, Grid, Pose, Vector, clearance, swept_clearance};
use crate::{
    scene::{Obstacle, State},
    task::{Demand, End, Goal, Task},
};

use super::SweptRegion;

/// Grid spacing for scenes of normal size, metres: finer than any pushed object.
const SPACING: f64 = 0.02;

/// Steps from a cell to its neighbours, in columns and rows.
const STEPS: [[i32; 2]; 16] = [
    [1, 0],
    [-1, 0],
    [0, 1],
    [0, -1],
    [1, 1],
    [1, -1],
    [-1, 1],
    [-1, -1],
    [2, 1],
    [2, -1],
    [-2, 1],
    [-2, -1],
    [1, 2],
    [1, -2],
    [-1, 2],
    [-1, -2],
];

/// Maximum number of cells along a side; a larger scene gets coarser cells.
const MOST_CELLS: usize = 128;

/// Margin of the grid around all obstacles and goals, metres.
const BORDER: f64 = 0.3;

/// Cost added if no path leads to the goal, metres: higher than any path, yet still ordered.
const CUT_OFF: f64 = 10.0;

/// Weight of a heading error in units of its tolerance. The weight is small because the last push
/// can rotate the object.
const HEADING_WEIGHT: f64 = 0.5;

/// Weight of obstructions: higher than the weight of moving the goal's object while clearing them.
const ASIDE_WEIGHT: f64 = 4.0;

/// Scale of obstructions if the goal states no place, metres.
const FREE: f64 = 0.02;

/// Cost to go: distances of the objects' centres to their goals.
#[derive(Clone)]
pub struct CostToGo<'a> {
    task: &'a Task,
    /// Goals in the world frame for the start state.
    goals: Arc<[Goal]>,
    /// Distance grids of the demands of every goal, if there are obstacles.
    grids: Arc<[Vec<Option<Ways>>]>,
    /// Region that must be cleared before the goal's object is pushed.
    corridor: Option<SweptRegion>,
}

impl<'a> CostToGo<'a> {
    /// Computes the cost to go of a task; cheap if there are no obstacles.
    pub fn new(task: &'a Task) -> Self {
        let start = task.scene.start();
        let goals: Vec<Goal> = task.goals.iter().map(|goal| goal.in_world(&start)).collect();
        let grid = |goal: &Goal, demand: &Demand| {
            // A relation has no unique goal position.
            let place = demand.kind().position()?;
            let met = in_the_way(task, goal);
            (!met.is_empty()).then(|| Ways::new(task, (goal.object, place), &met))
        };
        let of = |goal: &Goal| goal.demands.iter().map(|demand| grid(goal, demand)).collect();
        Self { task, grids: goals.iter().map(of).collect(), goals: goals.into(), corridor: None }
    }

    /// Adds a region that must be cleared first.
    pub fn clearing(self, corridor: SweptRegion) -> Self {
        Self { corridor: Some(corridor), ..self }
    }

    /// Returns the objects to push from a state: the obstructions, otherwise the objects not yet at
    /// their goals. If all objects are at their goals, returns all of them.
    pub fn movers(&self, state: &State) -> Vec<usize> {
        let blocking = self.blocking(state);
        if !blocking.is_empty() {
            return blocking;
        }
        let goals = || self.task.goals.iter();
        let left: Vec<usize> =
            goals().filter(|goal| !goal.reached(state)).map(|goal| goal.object).collect();
        match left.is_empty() {
            true => goals().map(|goal| goal.object).collect(),
            false => left,
        }
    }

    fn blocking(&self, state: &State) -> Vec<usize> {
        self.corridor.as_ref().map_or(Vec::new(), |corridor| corridor.blocking(state))
    }

    /// Returns the remaining distance, metres, after moving an object by `shift`. For the goals'
    /// objects this is the path length; for other objects, the depth inside the region to clear.
    pub fn carried(&self, (state, object): (&State, usize), shift: Vector) -> f64 {
        let object = self.task.scene.thing(object);
        let Pose { position, heading } = state.poses[object];
        let there = Pose { position: position + shift, heading };
        match &self.corridor {
            Some(corridor) if !self.task.has_goal(object) => corridor.depth_of(object, &there),
            _ => {
                let mut carried = state.clone();
                carried.poses[object] = there;
                self.ways(&carried)
            }
        }
    }

    /// Returns the sum of the path lengths of all goals' objects from `state`, metres.
    fn ways(&self, state: &State) -> f64 {
        let way = |(goal, grids): (&Goal, &Vec<Option<Ways>>)| {
            let end = End::resting(goal.object, state);
            let ways = goal.demands.iter().zip(grids);
            ways.filter_map(|(demand, grid)| distance(demand, grid, &end)).reduce(f64::max)
        };
        self.goals.iter().zip(self.grids.iter()).map(|one| way(one).unwrap_or(0.0)).sum()
    }

    /// Returns the cost of a state, in units of the tolerances: the larger of remaining distance
    /// and rotation, summed over all goals, plus the weighted depth of the obstructions.
    pub fn cost(&self, state: &State) -> f64 {
        let cost = |(goal, grids): (&Goal, &Vec<Option<Ways>>)| {
            let end = End::resting(goal.object, state);
            let costs = goal.demands.iter().zip(grids).flat_map(|(demand, grid)| {
                let kind = demand.kind();
                let way = distance(demand, grid, &end).zip(kind.tolerance());
                let turn = kind.turned(&end).zip(kind.turn_tolerance());
                let way = way.map(|(way, within)| way / within);
                let turn = turn.map(|(turn, within)| HEADING_WEIGHT * turn.abs() / within);
                way.into_iter().chain(turn)
            });
            costs.reduce(f64::max).unwrap_or(0.0)
        };
        let cost: f64 = self.goals.iter().zip(self.grids.iter()).map(cost).sum();
        let tolerance = self.task.goals[0].tolerance();
        let tolerance = if tolerance.is_finite() { tolerance } else { FREE };
        let depths = self.corridor.iter().flat_map(|corridor| corridor.depths(state));
        let aside: f64 = depths.map(|(_, depth)| depth / tolerance).sum();
        let cost = cost + ASIDE_WEIGHT * aside;
        if cost.is_nan() { f64::INFINITY } else { cost }
    }
}

/// Returns the path length of a goal's object to its place, metres, if the demand states one.
fn distance(demand: &Demand, grid: &Option<Ways>, end: &End) -> Option<f64> {
    let straight = demand.kind().off(end)?.norm();
    Some(grid.as_ref().map_or(straight, |grid| grid.distance(end.pose().position, straight)))
}

/// Returns the obstacles that a goal's object cannot pass below.
fn in_the_way<'a>(task: &'a Task, goal: &Goal) -> Vec<&'a Obstacle> {
    let scene = &task.scene;
    let raised = scene.parts_of(goal.object).filter(|&k| scene.objects[k].is_raised());
    let solids: Vec<usize> = raised.chain([goal.object]).collect();
    let met =
        |obstacle: &&Obstacle| solids.iter().any(|&k| obstacle.meets(scene.objects[k].span()));
    scene.obstacles.iter().filter(met).collect()
}

/// Paths to a goal from the cells of a grid.
struct Ways {
    grid: Grid,
    /// Path length, metres, and whether the straight path is free, for every cell.
    cells: Vec<(f64, bool)>,
}

impl Ways {
    fn new(task: &Task, (object, wanted): (usize, Vector), obstacles: &[&Obstacle]) -> Self {
        let object = &task.scene.objects[object];
        let radius = object.shape.footprint().inner_radius();
        let disc = Footprint::Disc { radius };
        let (mut low, mut high) = (wanted, wanted);
        let mut include = |position: Vector, reach: f64| {
            low = low.inf(&(position - Vector::repeat(reach)));
            high = high.sup(&(position + Vector::repeat(reach)));
        };
        include(object.pose.position, BORDER);
        include(wanted, BORDER);
        for obstacle in obstacles {
            include(
                obstacle.pose.position,
                obstacle.shape().footprint().bounding_radius() + radius + BORDER,
            );
        }
        let size = high - low;
        let spacing = SPACING.max(size.max() / (MOST_CELLS - 1) as f64);
        let columns = ((size.x / spacing).ceil() as usize + 1).min(MOST_CELLS);
        let rows = ((size.y / spacing).ceil() as usize + 1).min(MOST_CELLS);
        let grid = Grid::new(low, spacing, [columns, rows]);
        let free: Vec<bool> = (0..grid.count())
            .map(|cell| {
                let at = Pose { position: grid.position(cell), heading: 0.0 };
                obstacles.iter().all(|o| {
                    clearance((&disc, &at), (&o.shape().footprint(), &o.pose), spacing) > 0.0
                })
            })
            .collect();
        let goal = Pose { position: wanted, heading: 0.0 };
        let seen = |position: Vector| {
            let from = Pose { position, heading: 0.0 };
            obstacles.iter().all(|o| {
                let still = (&o.shape().footprint(), &o.pose);
                swept_clearance(&disc, &from, &goal, still, spacing) > 0.0
            })
        };
        // Every cell with a free straight path to the goal is a source with its exact distance.
        let cells = free
            .iter()
            .enumerate()
            .map(|(cell, &free)| {
                let centre = grid.position(cell);
                let visible = free && seen(centre);
                let way = (wanted - centre).norm();
                (if visible { way } else { f64::INFINITY }, visible)
            })
            .collect();
        let mut ways = Self { grid, cells };
        ways.spread(&free);
        ways
    }

    /// Runs Dijkstra's algorithm from all cells with a free straight path to the goal.
    fn spread(&mut self, free: &[bool]) {
        let mut frontier = Frontier::default();
        let seen = self.cells.iter().enumerate().filter(|(_, (way, _))| way.is_finite());
        seen.for_each(|(cell, (way, _))| frontier.push(*way, cell));
        while let Some((way, cell)) = frontier.pop() {
            if way > self.cells[cell].0 {
                continue;
            }
            for step in STEPS {
                let Some(next) = self.grid.next(cell, step) else { continue };
                let [x, y] = step.map(f64::from);
                let longer = way + self.grid.spacing * x.hypot(y);
                if free[next] && longer < self.cells[next].0 {
                    self.cells[next].0 = longer;
                    frontier.push(longer, next);
                }
            }
        }
    }

    fn distance(&self, position: Vector, straight: f64) -> f64 {
        match self.cells[self.grid.nearest(position)] {
            (_, true) => straight,
            (way, false) if way.is_finite() => way.max(straight),
            _ => straight + CUT_OFF,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Task with a can behind a wall across the straight path.
    const TASK: &str = "
description: Around a wall.
scene:
  table: {friction: 0.5}
  objects:
    - {name: can, shape: {cylinder: {radius: 0.03, height: 0.1}}, mass: 0.4, friction: 0.4, position: [0.4, 0.0]}
  obstacles:
    - {name: wall, size: [0.02, 0.40, 0.10], position: [0.5, 0.0]}
robot: {home: [0.3, 0.0], reach: {max: 0.9}}
tools: all
goal: {object: can, position: [0.6, 0.0], tolerance: 0.02}
";

    #[test]
    fn the_way_leads_around_the_wall() {
        let mut task = Task::parse(TASK, "around.yaml").unwrap();
        let field = CostToGo::new(&task);
        // Path around the wall's end, dilated by the can's radius.
        let half_wall = Vector::new(0.01 + 0.03, 0.20 + 0.03);
        let around = 2.0 * (0.1 - half_wall.x).hypot(half_wall.y) + 2.0 * half_wall.x;
        let distance = |field: &CostToGo, at: Vector| {
            field.ways(&State::at_rest(vec![Pose { position: at, heading: 0.0 }]))
        };
        let found = distance(&field, Vector::new(0.4, 0.0));
        assert!((found - around).abs() < 0.05, "{found} against {around}");
        // With a free straight path, the distance is exact.
        let seen = Vector::new(0.613, 0.1);
        assert!((distance(&field, seen) - 0.013f64.hypot(0.1)).abs() < 1e-12);
        // Outside the grid the distance still grows.
        assert!(distance(&field, Vector::new(-9.0, 0.0)) > 9.0);

        task.scene.obstacles.clear();
        let free = CostToGo::new(&task);
        assert!((distance(&free, Vector::new(0.4, 0.0)) - 0.2).abs() < 1e-12);
        let mut state = task.scene.start();
        state.poses[0].position.x = f64::NAN;
        assert_eq!(free.cost(&state), f64::INFINITY);
    }
}
