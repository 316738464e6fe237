//! Goals of the benchmark: end positions of the cylinder in the 2-D engine with any tool pose and
//! sequence.
//!
//! The goals are stored in `goals-*.json`, so that every run and every model gets the same tasks;
//! [`GoalSet::make`] generates them again.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::json;

use pushplan::{effect::Simulated, geometry::Vector, sim::Simulator};

use super::{
    execute::Action,
    sequences::Rolling,
    setup::{Layout, ReferenceSetup, STEPS},
    single::single_goals,
};

/// Goals of the layouts.
const GRID: &str = include_str!("goals-grid.json");
const SCATTERED: &str = include_str!("goals-scattered.json");

/// Version of the goal file format, raised when the layout changes.
pub const GOALS_VERSION: u32 = 1;

/// Minimum distance of chained goals from the start and from each other, metres.
const APART: f64 = 0.05;

/// Rounding of positions to a micrometre, far below the accuracy of the benchmark.
const DIGITS: f64 = 1e6;

/// Tasks of the benchmark.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GoalSet {
    /// Version of the generation.
    pub version: u32,
    /// Command that generated the goals, for readers of the file.
    pub made_by: String,
    /// Goals by start.
    pub starts: Vec<StartGoals>,
}

/// Goals of one start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StartGoals {
    /// Position of the cylinder, metres.
    pub start: [f64; 2],
    /// Goals.
    pub goals: Vec<GoalMade>,
}

/// Goal with the action that reaches it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GoalMade {
    /// Position, metres.
    pub at: [f64; 2],
    /// Name of the tool pose.
    pub pose: String,
    /// Directions of the pushes.
    pub pushes: String,
}

impl GoalSet {
    /// Returns the shipped goals, to which all published numbers refer.
    ///
    /// # Errors
    /// Returns an error only if the library contains a damaged file.
    pub fn shipped(layout: Layout) -> Result<Self, serde_json::Error> {
        serde_json::from_str(match layout {
            Layout::Grid => GRID,
            Layout::Scattered => SCATTERED,
        })
    }

    /// Generates the goals of all starts.
    pub fn make(setup: &ReferenceSetup) -> Self {
        let starts = setup.starts.par_iter().map(|&start| StartGoals::make(setup, start));
        Self {
            version: GOALS_VERSION,
            made_by: "pushplan bench tools --make-goals".into(),
            starts: starts.collect(),
        }
    }

    /// Generates the goals of `tasks` single pushes of a seed, each the end position of a random
    /// push with a random tool pose.
    pub fn single(setup: &ReferenceSetup, seed: u64, tasks: usize) -> Self {
        single_goals(setup, seed, tasks)
    }

    /// Keeps `count` goals, spread evenly over the starts; all goals if there are not more.
    pub fn evenly(mut self, count: usize) -> Self {
        let all = self.len();
        let mut index = 0;
        for start in &mut self.starts {
            start.goals.retain(|_| {
                index += 1;
                // The share of goals up to this one crosses a whole number `count` times.
                count >= all || index * count / all > (index - 1) * count / all
            });
        }
        self
    }

    /// Returns the number of tasks.
    pub fn len(&self) -> usize {
        self.starts.iter().map(|start| start.goals.len()).sum()
    }

    /// Returns `true` if there are no tasks.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the index of the start and the goal (metres) of task `index`, counted over all
    /// starts.
    pub fn task(&self, index: usize) -> Option<(usize, Vector)> {
        let each = self.starts.iter().enumerate();
        let mut all = each.flat_map(|(k, start)| start.goals.iter().map(move |goal| (k, goal)));
        all.nth(index).map(|(start, goal)| (start, Vector::from(goal.at)))
    }

    /// Formats the goals as a file, one goal a line.
    pub fn to_text(&self) -> String {
        // Serialization of numbers and texts cannot fail.
        let json = |value: serde_json::Value| value.to_string();
        let starts: Vec<String> = self
            .starts
            .iter()
            .map(|start| {
                let goal = |goal: &GoalMade| format!("    {}", json(json!(goal)));
                let goals: Vec<String> = start.goals.iter().map(goal).collect();
                let at = json(json!(start.start));
                format!("  {{\"start\": {at}, \"goals\": [\n{}\n  ]}}", goals.join(",\n"))
            })
            .collect();
        format!(
            "{{\"version\": {}, \"made_by\": {}, \"starts\": [\n{}\n]}}\n",
            self.version,
            json(json!(self.made_by)),
            starts.join(",\n")
        )
    }
}

impl StartGoals {
    /// Executes all sequences with all tool poses that can be set down. The end positions more than
    /// 5 cm from the start become goals, thinned from the last on so that no two are within 5 cm.
    pub fn make(setup: &ReferenceSetup, start: Vector) -> Self {
        let task = setup.task(start, start);
        let planar = Simulated::new(Simulator::planar());
        let poses = setup.free_poses(start);
        let rolling = Rolling { setup, task: &task, model: &planar, poses: &poses, steps: STEPS };
        let sequences = rolling.whole();
        let ends: Vec<(Action, Vector)> = sequences.ends().collect();
        let mut kept: Vec<(&Action, Vector)> = Vec::new();
        for (action, end) in ends.iter().rev() {
            let far = |other: Vector| (end - other).norm() > APART;
            if far(start) && kept.iter().all(|(_, other)| far(*other)) {
                kept.push((action, *end));
            }
        }
        let goals = kept
            .into_iter()
            .map(|(action, end)| GoalMade {
                at: rounded(end),
                pose: setup.poses[action.pose].name.clone(),
                pushes: spelled(action),
            })
            .collect();
        Self { start: rounded(start), goals }
    }
}

pub(super) fn rounded(at: Vector) -> [f64; 2] {
    // The sum turns a negative zero into zero.
    [at.x, at.y].map(|value| (value * DIGITS).round() / DIGITS + 0.0)
}

/// Formats the directions of a sequence: `+x -y +x`.
pub(super) fn spelled(action: &Action) -> String {
    let ways: Vec<&str> = action
        .pushes
        .iter()
        .map(|push| {
            let (sin, cos) = push.direction.sin_cos();
            match (cos.abs() > sin.abs(), cos > 0.0, sin > 0.0) {
                (true, true, _) => "+x",
                (true, false, _) => "-x",
                (false, _, true) => "+y",
                (false, _, false) => "-y",
            }
        })
        .collect();
    ways.join(" ")
}
