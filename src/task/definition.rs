//! A task: a scene, a robot, rules for steps, and goals.

use super::PushRules;
use crate::scene::Robot;
use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::geometry::Vector;

use super::arm::{self, RobotArm};
use super::demand::MOST_CHOICES;
use super::{Goal, LeverRules, ShownGoal};
use crate::scene::{Annulus, Plate, Scene, State, Unknowns};

/// The tools that a task allows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToolChoice {
    /// Every tool of the library.
    All,
    /// The tools with these names.
    Named(Vec<String>),
}

/// The complete input of a planner, except for the tools themselves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Task {
    /// Name: the file's `name` key, otherwise the name of the file.
    pub name: String,
    /// Description of one line.
    pub description: String,
    /// Scene.
    pub scene: Scene,
    /// Properties of the scene that are only guesses.
    #[serde(default)]
    pub unknown: Unknowns,
    /// Robot.
    pub robot: Robot,
    /// Arm of the robot, if known.
    #[serde(default, skip_serializing_if = "Option::is_none", with = "arm")]
    pub arm: Option<Arc<dyn RobotArm>>,
    /// Allowed tools.
    pub tools: ToolChoice,
    /// Cost of using a tool, by its name; 0 for other tools. The cheapest of equally good plans
    /// with equal numbers of pushes is preferred.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub tool_costs: BTreeMap<String, f64>,
    /// Allowed pushes.
    pub pushes: PushRules,
    /// Allowed lever-ups, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub levers: Option<LeverRules>,
    /// Goals of different objects, at least one; all must be reached.
    pub goals: Vec<Goal>,
    /// Share of the perturbed replays that must reach the goal for a plan to count, 0 to 1.
    pub robustness: f64,
}

impl Task {
    /// Returns the annulus within reach: about the base of an arm, otherwise about the origin.
    pub fn annulus(&self) -> Annulus {
        let Robot { reach_min, reach_max, .. } = self.robot;
        let about_origin = Annulus { centre: Vector::zeros(), radii: [reach_min, reach_max] };
        self.arm.as_ref().map_or(about_origin, |arm| arm.annulus())
    }

    /// Default robustness of a task.
    pub const ROBUSTNESS: f64 = 0.75;

    /// Creates a task that allows every tool of the library and the pushes of
    /// [`PushRules::default`].
    ///
    /// ```
    /// use pushplan::{Goal, Object, PushRules, Robot, Scene, Task};
    ///
    /// let scene = Scene::new([Object::cylinder("can", 0.05, 0.10).at(0.62, 0.10, 0.0)]);
    /// let goal = Goal::new(0, [0.45, 0.10], 0.02);
    /// let task = Task::new("pull", scene, Robot::reaching(0.1, 0.5), goal)
    ///     .with_tools(["stick", "l-hook"])
    ///     .pushing(PushRules { max_count: 2, ..PushRules::default() });
    /// assert_eq!(task.pushes.speed, 0.10);
    /// ```
    pub fn new(name: impl Into<String>, mut scene: Scene, robot: Robot, goal: Goal) -> Self {
        scene.obstacles.extend(robot.column());
        scene.let_fall(&goal);
        Self {
            name: name.into(),
            description: String::new(),
            scene,
            unknown: Unknowns::NONE,
            robot,
            arm: None,
            tools: ToolChoice::All,
            tool_costs: BTreeMap::new(),
            pushes: PushRules::default(),
            levers: None,
            goals: vec![goal],
            robustness: Self::ROBUSTNESS,
        }
    }

    /// Adds a goal; demands on an object that already has a goal are added to that goal.
    ///
    /// ```
    /// use pushplan::{Goal, Object, Robot, Scene, Task};
    ///
    /// let [can, cup] = ["can", "cup"].map(|name| Object::cylinder(name, 0.04, 0.10));
    /// let scene = Scene::new([can.at(0.5, 0.1, 0.0), cup.at(0.5, -0.1, 0.0)]);
    /// let robot = Robot::reaching(0.1, 0.9);
    /// let task = Task::new("both", scene, robot, Goal::new(0, [0.7, 0.1], 0.02))
    ///     .and(Goal::new(1, [0.7, -0.1], 0.02));
    /// assert_eq!(task.goals.len(), 2);
    /// ```
    pub fn and(mut self, goal: Goal) -> Self {
        self.scene.let_fall(&goal);
        goal.join(&mut self.goals);
        self
    }

    /// Returns the marks of all goals for drawings, with every object at its start.
    pub fn shown_goals(&self) -> Vec<ShownGoal> {
        self.goals.iter().map(|goal| goal.shown(&self.scene)).collect()
    }

    /// Replaces goals by `goals`, in order; further goals of the task stay.
    pub fn with_goals(&self, goals: &[Goal]) -> Self {
        let mut task = self.clone();
        task.goals.iter_mut().zip(goals).for_each(|(own, goal)| *own = goal.clone());
        task
    }

    /// Keeps only the goals with these indices, in order; `None` if no goal remains.
    pub fn only(&self, goals: &[usize]) -> Option<Self> {
        let goals: Vec<Goal> = goals.iter().filter_map(|k| self.goals.get(*k).cloned()).collect();
        (!goals.is_empty()).then(|| Self { goals, ..self.clone() })
    }

    /// Returns `true` if the end effector can be at `position` (metres), rotated by `yaw`
    /// (radians), according to cheap tests.
    pub fn is_reachable(&self, position: Vector, yaw: f64) -> bool {
        self.robot.reaches(position)
            && self.arm.as_deref().is_none_or(|arm| arm.allows(position, yaw))
    }

    /// Returns `true` if a goal may move an object (an index into [`Scene::objects`]).
    pub fn has_goal(&self, object: usize) -> bool {
        self.goals.iter().any(|goal| goal.movers().contains(&object))
    }

    /// Returns tasks whose goals leave no [choice](super::Kind::choices), the nearest first; each
    /// of them reaches all goals of this task. Empty if no goal leaves a choice.
    pub fn choices(&self, state: &State) -> Vec<Self> {
        let count = self.scene.objects.len();
        let sound = |goal: &Goal| {
            goal.movers().iter().all(|k| *k < count) && goal.fault(&self.scene).is_none()
        };
        if !self.goals.iter().any(|goal| goal.movers().len() > 1) || !self.goals.iter().all(sound) {
            return Vec::new();
        }
        let mut sets = vec![Vec::new()];
        for goal in &self.goals {
            let choices = goal.choices(state);
            let with = |set: &Vec<Goal>| {
                let longer = |choice: &Vec<Goal>| set.iter().chain(choice).cloned().collect();
                choices.iter().map(longer).collect::<Vec<Vec<Goal>>>()
            };
            // Truncation here keeps the number of sets bounded, because groups multiply it; the
            // result is truncated anyway.
            sets = sets.iter().flat_map(with).take(MOST_CHOICES).collect();
        }
        sets.into_iter().map(|goals| Self { goals: Goal::joined(goals), ..self.clone() }).collect()
    }

    /// Returns `true` if every goal is reached, see [`Goal::reached`].
    pub fn reached(&self, state: &State) -> bool {
        self.goals.iter().all(|goal| goal.reached(state))
    }

    /// Returns the largest [`Goal::score`]: at most 1 if every goal is reached.
    pub fn score(&self, state: &State) -> f64 {
        // NaN counts as largest.
        let larger = |a: f64, b: f64| if a >= b { a } else { b };
        self.goals.iter().map(|goal| goal.score(state)).reduce(larger).unwrap_or(0.0)
    }

    /// Sets the description, one line.
    pub fn described(self, description: impl Into<String>) -> Self {
        Self { description: description.into(), ..self }
    }

    /// Restricts the tools to these, by name.
    pub fn with_tools<N: Into<String>>(self, tools: impl IntoIterator<Item = N>) -> Self {
        Self { tools: ToolChoice::Named(tools.into_iter().map(Into::into).collect()), ..self }
    }

    /// Sets the share of the perturbed replays in which a plan must work, 0 to 1.
    pub fn robust(self, share: f64) -> Self {
        Self { robustness: share, ..self }
    }

    /// Sets the unknown properties of the scene.
    pub fn with_unknowns(self, unknown: Unknowns) -> Self {
        Self { unknown, ..self }
    }

    /// Allows lever-ups. [`Task::pushes`] states whether pushes may follow them.
    ///
    /// ```
    /// use pushplan::goals::{Demand, Flipped};
    /// use pushplan::{Goal, LeverRules, Object, PushRules, Robot, Scene, Task};
    ///
    /// let plate = Object::cuboid("plate", [0.12, 0.08, 0.008]).on_feet(0.006).at(0.5, 0.0, 0.0);
    /// let goal = Goal::of(0).with(Demand::Flipped(Flipped { flipped: true }));
    /// let task = Task::new("turn", Scene::new([plate]), Robot::reaching(0.1, 0.9), goal)
    ///     .levering(LeverRules::default())
    ///     .pushing(PushRules::none());
    /// assert!(task.in_space());
    /// ```
    pub fn levering(mut self, levers: LeverRules) -> Self {
        // Lever-ups do not support the robot's body yet.
        self.scene.obstacles.retain(|obstacle| !obstacle.is_robot());
        let robot = self.robot.without_body();
        Self { levers: Some(levers), robot, ..self }
    }

    /// Returns the goal whose object is levered: the first goal that leaves the plane, otherwise
    /// the first goal of an object with room for a blade.
    pub fn levered(&self) -> &Goal {
        let has_room = |goal: &&Goal| {
            self.scene.objects.get(goal.object).is_some_and(|object| object.in_space())
        };
        let lifted = self.goals.iter().find(|goal| !goal.is_pose());
        lifted.or_else(|| self.goals.iter().find(has_room)).unwrap_or(&self.goals[0])
    }

    /// Returns the levered object with all its solids.
    pub fn plate(&self) -> Plate {
        Plate::of(&self.scene, self.levered().object)
    }

    /// Returns the allowed lever-ups, or the default rules if none are allowed.
    pub fn lever_rules(&self) -> LeverRules {
        self.levers.clone().unwrap_or_default()
    }

    /// Returns `true` if an object has a 3-D pose or may be levered.
    pub fn in_space(&self) -> bool {
        self.levers.is_some() || self.scene.in_space()
    }

    /// Sets the rules for pushes.
    pub fn pushing(self, pushes: PushRules) -> Self {
        Self { pushes, ..self }
    }
}
