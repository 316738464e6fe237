//! The goals: where the planar engine brings the cylinder with any tool pose and sequence.
//!
//! Made once and kept in `goals-*.json`, so that every run and every model meets the same tasks;
//! [`GoalSet::make`] makes them again.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::json;

use pushplan::{effect::Simulated, geometry::Vector, sim::Simulator};

use super::{
    execute::Action,
    sequences::Rolling,
    setup::{Layout, ReferenceSetup, STEPS},
};

/// The goals of every layout.
const GRID: &str = include_str!("goals-grid.json");
const SCATTERED: &str = include_str!("goals-scattered.json");

/// What the numbers of a goal file mean; raised when the layout changes.
pub const GOALS_VERSION: u32 = 1;

/// Goals lie farther than this from the start and from each other, metres.
const APART: f64 = 0.05;

/// Positions are kept to a micrometre: far below what anything here can tell apart.
const DIGITS: f64 = 1e6;

/// All tasks of the benchmark.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GoalSet {
    /// The version of how goals are made.
    pub version: u32,
    /// How they were made, for a reader of the file.
    pub made_by: String,
    /// Start by start.
    pub starts: Vec<StartGoals>,
}

/// The goals of one start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StartGoals {
    /// Where the cylinder stands, metres.
    pub start: [f64; 2],
    /// The goals.
    pub goals: Vec<GoalMade>,
}

/// A goal and what reaches it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GoalMade {
    /// Metres.
    pub at: [f64; 2],
    /// Name of the tool pose that ends there.
    pub pose: String,
    /// Its pushes.
    pub pushes: String,
}

impl GoalSet {
    /// The goals that every published number is about.
    ///
    /// # Errors
    /// Only if the library was built around a damaged file.
    pub fn shipped(layout: Layout) -> Result<Self, serde_json::Error> {
        serde_json::from_str(match layout {
            Layout::Grid => GRID,
            Layout::Scattered => SCATTERED,
        })
    }

    /// Makes the goals of all starts.
    pub fn make(setup: &ReferenceSetup) -> Self {
        let starts = setup.starts.par_iter().map(|&start| StartGoals::make(setup, start));
        Self {
            version: GOALS_VERSION,
            made_by: "pushplan bench tools --make-goals".into(),
            starts: starts.collect(),
        }
    }

    /// Number of tasks.
    pub fn len(&self) -> usize {
        self.starts.iter().map(|start| start.goals.len()).sum()
    }

    /// Whether there are no tasks.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Index of the start and the goal (metres) of task `index`, counted through all starts.
    pub fn task(&self, index: usize) -> Option<(usize, Vector)> {
        let each = self.starts.iter().enumerate();
        let mut all = each.flat_map(|(k, start)| start.goals.iter().map(move |goal| (k, goal)));
        all.nth(index).map(|(start, goal)| (start, Vector::from(goal.at)))
    }

    /// As a file: one goal a line.
    pub fn to_text(&self) -> String {
        // Numbers and texts cannot fail to be written.
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
    /// Plays all sequences with all tool poses that can be set down, and keeps the end points
    /// that are farther than 5 cm from the start, thinned from the last on until none is within
    /// 5 cm of another.
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

fn rounded(at: Vector) -> [f64; 2] {
    // The sum turns a negative zero into zero.
    [at.x, at.y].map(|value| (value * DIGITS).round() / DIGITS + 0.0)
}

/// `+x -y +x`: the directions of a sequence.
fn spelled(action: &Action) -> String {
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
