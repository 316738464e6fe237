//! The kinds of random tasks, and their criteria.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

use pushplan::internals::geometry::{Pose, Vector, wrap_angle};
use pushplan::internals::scene::Span;
use serde::{Deserialize, Serialize};

use super::one_push::TRAVEL;

/// A kind of random task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TaskKind {
    /// An object beyond the end effector's reach, which comes no nearer.
    Reach,
    /// An object that comes nearer to the robot.
    Pull,
    /// An object that goes sideways.
    Sweep,
    /// An obstacle on the straight path.
    Obstacle,
    /// A cuboid with a heading to reach, at least 15 degrees from its own.
    Heading,
    /// Two joined objects, one with a goal.
    Pair,
    /// A goal behind a gap too narrow for the object: no plan can be right.
    Gap,
    /// Four close objects, some of them joined, one with a goal. Drawn only if named.
    Cluster,
    /// A door that stands ajar, and must be opened farther or nearly shut.
    Door,
    /// A drawer with a bar to pull it by, in walls or in a heavy cabinet that is free to move.
    Drawer,
    /// A compound object with a heading to reach.
    Compound,
    /// A goal heading alone.
    Turn,
    /// A goal region on the table.
    Region,
    /// A goal beside another object, relative to its final pose.
    Relative,
    /// Two objects, each with a goal.
    TwoGoals,
    /// Three objects, each with a goal.
    ThreeGoals,
    /// Two objects, one of them beyond the reach of the tool that the other one needs.
    TwoTools,
    /// A goal before a wall, obstructed by an object.
    OneAside,
    /// A goal before a wall, obstructed by two objects.
    TwoAside,
    /// A goal before a wall, obstructed by three objects.
    ThreeAside,
}

/// Layout ranges and difficulty of a kind.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rules {
    /// Distances of the object from the robot's base, metres.
    pub places: Span,
    /// Largest reach of the end effector, metres.
    pub reach: f64,
    /// Minimum and maximum number of pushes of the plan behind the goal.
    pub made_with: [usize; 2],
    /// Travel of each of its pushes, metres. Refinement may go from 0.10 to 0.30.
    pub travel: Span,
    /// Maximum number of pushes of a plan.
    pub max_count: usize,
    /// Minimum displacement of the object, metres.
    pub least_way: f64,
}

/// Smallest rotation to a goal heading, radians.
const LEAST_TURN: f64 = PI / 12.0;

/// Largest angle between the path and straight inwards or sideways, radians.
const LEANING: f64 = PI / 6.0;

impl TaskKind {
    /// Default kinds.
    pub const ALL: [TaskKind; 6] = [
        TaskKind::Reach,
        TaskKind::Pull,
        TaskKind::Sweep,
        TaskKind::Obstacle,
        TaskKind::Heading,
        TaskKind::Pair,
    ];

    /// Everyday kinds, drawn only if named.
    pub const EVERYDAY: [TaskKind; 12] = [
        TaskKind::Door,
        TaskKind::Drawer,
        TaskKind::Compound,
        TaskKind::Turn,
        TaskKind::Region,
        TaskKind::Relative,
        TaskKind::TwoGoals,
        TaskKind::ThreeGoals,
        TaskKind::TwoTools,
        TaskKind::OneAside,
        TaskKind::TwoAside,
        TaskKind::ThreeAside,
    ];

    /// Iterates over every kind, in the order of presentation.
    pub fn each() -> impl Iterator<Item = TaskKind> {
        let asked_for = [TaskKind::Cluster, TaskKind::Gap];
        TaskKind::ALL.into_iter().chain(asked_for).chain(TaskKind::EVERYDAY)
    }

    /// Returns the name in task names and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            TaskKind::Reach => "reach",
            TaskKind::Pull => "pull",
            TaskKind::Sweep => "sweep",
            TaskKind::Obstacle => "obstacle",
            TaskKind::Heading => "heading",
            TaskKind::Pair => "pair",
            TaskKind::Gap => "gap",
            TaskKind::Cluster => "cluster",
            TaskKind::Door => "door",
            TaskKind::Drawer => "drawer",
            TaskKind::Compound => "compound",
            TaskKind::Turn => "turn",
            TaskKind::Region => "region",
            TaskKind::Relative => "relative",
            TaskKind::TwoGoals => "two-goals",
            TaskKind::ThreeGoals => "three-goals",
            TaskKind::TwoTools => "two-tools",
            TaskKind::OneAside => "one-aside",
            TaskKind::TwoAside => "two-aside",
            TaskKind::ThreeAside => "three-aside",
        }
    }

    /// Returns a line for the description of a task.
    pub fn title(self) -> &'static str {
        match self {
            TaskKind::Reach => "Move an object to a goal beyond the reach of the end effector.",
            TaskKind::Pull => "Pull an object towards the robot.",
            TaskKind::Sweep => "Sweep an object sideways.",
            TaskKind::Obstacle => "Move an object around an obstacle.",
            TaskKind::Heading => "Move a cuboid to a position and a heading.",
            TaskKind::Pair => "Move one of two joined objects.",
            TaskKind::Gap => "Move an object behind a gap that is too narrow.",
            TaskKind::Cluster => "Move one of several close objects, some of them joined.",
            TaskKind::Door => "Open or shut a door.",
            TaskKind::Drawer => "Pull a drawer out or push it in.",
            TaskKind::Compound => "Move a compound object to a position and a heading.",
            TaskKind::Turn => "Rotate an object; its position is free.",
            TaskKind::Region => "Move an object anywhere into a region.",
            TaskKind::Relative => "Move an object beside another object.",
            TaskKind::TwoGoals => "Move two objects to their goals.",
            TaskKind::ThreeGoals => "Move three objects to their goals.",
            TaskKind::TwoTools => "Pull one object near, and push another between rails.",
            TaskKind::OneAside => "Move an object to a goal at a wall with one obstruction.",
            TaskKind::TwoAside => "Move an object to a goal at a wall with two obstructions.",
            TaskKind::ThreeAside => "Move an object to a goal at a wall with three obstructions.",
        }
    }

    pub(super) fn rules(self) -> Rules {
        let usual = Rules {
            places: Span::new(0.40, 0.75),
            reach: 0.9,
            made_with: [1, 2],
            travel: TRAVEL,
            max_count: 2,
            least_way: 0.08,
        };
        match self {
            TaskKind::Reach => {
                Rules { places: Span::new(0.65, 0.90), reach: 0.6, made_with: [1, 1], ..usual }
            }
            TaskKind::Pull => Rules { places: Span::new(0.50, 0.85), ..usual },
            TaskKind::Sweep => Rules { least_way: 0.12, ..usual },
            // Short paths leave no room for a wall beside them.
            TaskKind::Obstacle => Rules {
                made_with: [2, 3],
                travel: Span::new(0.15, TRAVEL.high),
                max_count: 3,
                least_way: 0.12,
                ..usual
            },
            TaskKind::Heading => Rules { least_way: 0.05, ..usual },
            TaskKind::Pair | TaskKind::Gap | TaskKind::Cluster => usual,
            TaskKind::Door | TaskKind::Turn => Rules { least_way: 0.0, max_count: 3, ..usual },
            TaskKind::Drawer => Rules { least_way: 0.04, max_count: 3, ..usual },
            TaskKind::Compound | TaskKind::Region | TaskKind::Relative => {
                Rules { max_count: 3, ..usual }
            }
            TaskKind::TwoGoals | TaskKind::ThreeGoals => {
                Rules { made_with: [1, 1], least_way: 0.06, max_count: 4, ..usual }
            }
            TaskKind::TwoTools => {
                Rules { reach: 0.62, made_with: [1, 1], least_way: 0.06, ..usual }
            }
            TaskKind::OneAside | TaskKind::TwoAside | TaskKind::ThreeAside => {
                Rules { least_way: 0.12, max_count: self.aside() + 3, ..usual }
            }
        }
    }

    /// Returns the number of obstructing objects.
    pub(super) fn aside(self) -> usize {
        match self {
            TaskKind::OneAside => 1,
            TaskKind::TwoAside => 2,
            TaskKind::ThreeAside => 3,
            _ => 0,
        }
    }

    /// Returns middle and half width of the directions in which pushes are tried, radians. The
    /// object is in direction `outwards` from the base, `index` counts the pushes before, and
    /// `before` is the direction of the last one. The range only saves draws; [`TaskKind::accepts`]
    /// is the criterion.
    pub(super) fn directions(
        self,
        outwards: f64,
        index: usize,
        before: f64,
        left: bool,
    ) -> (f64, f64) {
        let side = if left { FRAC_PI_2 } else { -FRAC_PI_2 };
        match self {
            TaskKind::Reach => (outwards, 0.6 * PI),
            TaskKind::Pull => (outwards + PI, 0.8),
            TaskKind::Sweep => (outwards + side, 0.7),
            // Around a corner.
            TaskKind::Obstacle if index > 0 => (before + side, 0.4),
            // The first object is pulled near, the second pushed on between the rails.
            TaskKind::TwoTools if index == 0 => (PI, 0.4),
            TaskKind::TwoTools => (0.0, 0.2),
            _ => (0.0, PI),
        }
    }

    /// Returns `true` if the displacement of a goal's object fits this kind. Obstructions of the
    /// straight path are checked elsewhere.
    pub(super) fn accepts(self, start: &Pose, end: &Pose) -> bool {
        let way = end.position - start.position;
        if !end.is_finite() || way.norm() < self.rules().least_way {
            return false;
        }
        let angle = |v: Vector| v.y.atan2(v.x);
        let off = wrap_angle(angle(way) - angle(start.position)).abs();
        match self {
            TaskKind::Reach => end.position.norm() >= start.position.norm(),
            TaskKind::Pull => off >= PI - LEANING,
            TaskKind::Sweep => (off - FRAC_PI_2).abs() <= LEANING,
            TaskKind::Heading | TaskKind::Turn | TaskKind::Door => {
                wrap_angle(end.heading - start.heading).abs() >= LEAST_TURN
            }
            _ => true,
        }
    }
}

impl fmt::Display for TaskKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
