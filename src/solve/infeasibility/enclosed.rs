//! Walls around an object or its goal, found by filling the free space of a grid.

use crate::geometry::{Footprint, Grid, Pose, Vector, clearance};
use crate::scene::Obstacle;
use crate::task::Task;

/// Grid spacing, metres: finer than any wall with the object's width around it.
const SPACING: f64 = 0.01;

/// Maximum number of cells along a side; a larger scene gets coarser cells.
const MOST_CELLS: usize = 200;

/// Margin of the grid around all obstacles, metres.
const BORDER: f64 = 0.3;

/// Steps from a cell to its neighbours, in columns and rows.
const STEPS: [[i32; 2]; 4] = [[1, 0], [-1, 0], [0, 1], [0, -1]];

/// Enclosed body or place, and the names of the walls.
pub(super) struct Walls {
    pub subject: String,
    pub by: Vec<String>,
}

/// Returns the walls around the object of the first goal, or around the goal, if no path connects
/// them.
pub(super) fn enclosed(task: &Task) -> Option<Walls> {
    let (goal, scene) = (&task.goals[0], &task.scene);
    let own = &scene.objects[goal.object];
    let walls: Vec<&Obstacle> =
        scene.obstacles.iter().filter(|obstacle| obstacle.meets(own.span())).collect();
    if walls.is_empty() || !goal.has_place() {
        return None;
    }
    let (from, to) = (own.pose.position, goal.place(&scene.start()));
    let disc = Footprint::Disc { radius: own.shape.footprint().inner_radius() };
    let grid = covering(&walls, [from, to])?;
    let met = |cell: usize| {
        let at = Pose { position: grid.position(cell), heading: 0.0 };
        walls.iter().filter(move |wall| {
            let still = (&wall.shape().footprint(), &wall.pose);
            clearance((&disc, &at), still, SPACING) <= 0.0
        })
    };
    let fill = |start: Vector| {
        let (mut seen, mut by) = (vec![false; grid.count()], Vec::new());
        let mut open = vec![grid.nearest(start)];
        seen[open[0]] = true;
        let mut closed = true;
        while let Some(cell) = open.pop() {
            for step in STEPS {
                let Some(next) = grid.next(cell, step) else {
                    closed = false;
                    continue;
                };
                if std::mem::replace(&mut seen[next], true) {
                    continue;
                }
                let before = by.len();
                by.extend(met(next).map(|wall| wall.name.clone()));
                if by.len() == before {
                    open.push(next);
                }
                by.sort();
                by.dedup();
            }
        }
        (seen, by, closed)
    };
    let (seen, by, closed) = fill(from);
    if seen[grid.nearest(to)] {
        return None;
    }
    if closed {
        return Some(Walls { subject: format!("`{}`", own.name), by });
    }
    let (_, by, closed) = fill(to);
    closed.then(|| Walls { subject: format!("the goal of `{}`", own.name), by })
}

/// Returns a grid around the walls and two places.
fn covering(walls: &[&Obstacle], places: [Vector; 2]) -> Option<Grid> {
    let (mut low, mut high) = (places[0].inf(&places[1]), places[0].sup(&places[1]));
    for wall in walls {
        let reach = Vector::repeat(wall.shape().footprint().bounding_radius() + BORDER);
        low = low.inf(&(wall.pose.position - reach));
        high = high.sup(&(wall.pose.position + reach));
    }
    let size = high - low;
    let spacing = SPACING.max(size.max() / (MOST_CELLS - 1) as f64);
    let count = |length: f64| (length / spacing).ceil() as usize + 1;
    size.max().is_finite().then(|| Grid::new(low, spacing, [count(size.x), count(size.y)]))
}
