//! A task: a scene, a robot, the steps that are allowed, and goals.

use super::PushRules;
use crate::scene::Robot;
use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::geometry::Vector;

use super::arm::{self, RobotArm};
use super::demand::MOST_CHOICES;
use super::{Goal, LeverRules, ShownGoal};
use crate::scene::{Plate, Scene, State, Unknowns};

/// Which tools a task allows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToolChoice {
    /// Every tool of the library.
    All,
    /// These, by name.
    Named(Vec<String>),
}

/// Everything that a planner needs to know besides the tools themselves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Task {
    /// From the file's name or its `name` key.
    pub name: String,
    /// One line for people.
    pub description: String,
    /// The table.
    pub scene: Scene,
    /// What of it is only a guess.
    #[serde(default)]
    pub unknown: Unknowns,
    /// The robot.
    pub robot: Robot,
    /// Its arm, if that is known.
    #[serde(default, skip_serializing_if = "Option::is_none", with = "arm")]
    pub arm: Option<Arc<dyn RobotArm>>,
    /// Allowed tools.
    pub tools: ToolChoice,
    /// Cost of using a tool, by its name; 0 where it is not named. Of equally good plans with as many pushes
    /// the cheaper is preferred.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub tool_costs: BTreeMap<String, f64>,
    /// Allowed pushes.
    pub pushes: PushRules,
    /// Allowed lever-ups, if any are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub levers: Option<LeverRules>,
    /// Goals of different objects, at least one; all count.
    pub goals: Vec<Goal>,
    /// Share of the disturbed replays that must reach the goal for a plan to count, 0 to 1.
    pub robustness: f64,
}

impl Task {
    /// The robustness of a task that does not state one.
    pub const ROBUSTNESS: f64 = 0.75;

    /// A task that allows every tool of the library and one push, see [`PushRules::default`].
    ///
    /// ```
    /// use pushplan::{Goal, Object, PushRules, Robot, Scene, Task};
    ///
    /// let scene = Scene::new([Object::cylinder("can", 0.05, 0.10).at(0.62, 0.10, 0.0)]);
    /// let goal = Goal::new(0, [0.45, 0.10], 0.02);
    /// let task = Task::new("pull", scene, Robot::reaching(0.1, 0.5), goal)
    ///     .choosing(["stick", "l-hook"])
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

    /// The task with one goal more; demands on an object that has a goal already are added to it.
    ///
    /// ```
    /// use pushplan::{Goal, Object, Robot, Scene, Task};
    ///
    /// let [can, cup] = ["can", "cup"].map(|name| Object::cylinder(name, 0.04, 0.10));
    /// let scene = Scene::new([can.at(0.5, 0.1, 0.0), cup.at(0.5, -0.1, 0.0)]);
    /// let task = Task::new("both", scene, Robot::reaching(0.1, 0.9), Goal::new(0, [0.7, 0.1], 0.02))
    ///     .and(Goal::new(1, [0.7, -0.1], 0.02));
    /// assert_eq!(task.goals.len(), 2);
    /// ```
    pub fn and(mut self, goal: Goal) -> Self {
        self.scene.let_fall(&goal);
        goal.join(&mut self.goals);
        self
    }

    /// The marks of all goals in pictures, with everything at its start.
    pub fn shown_goals(&self) -> Vec<ShownGoal> {
        self.goals.iter().map(|goal| goal.shown(&self.scene)).collect()
    }

    /// The same task with other goals in their places; those that are missing stay.
    pub fn aiming(&self, goals: &[Goal]) -> Self {
        let mut task = self.clone();
        task.goals.iter_mut().zip(goals).for_each(|(own, goal)| *own = goal.clone());
        task
    }

    /// The same with these of its goals alone, by their indices, in order; `None` for none.
    pub fn only(&self, goals: &[usize]) -> Option<Self> {
        let goals: Vec<Goal> = goals.iter().filter_map(|k| self.goals.get(*k).cloned()).collect();
        (!goals.is_empty()).then(|| Self { goals, ..self.clone() })
    }

    /// Whether the end effector can stand at `position` (metres), turned by `yaw` (radians), as far as that
    /// is cheap to tell.
    pub fn stands(&self, position: Vector, yaw: f64) -> bool {
        self.robot.reaches(position)
            && self.arm.as_deref().is_none_or(|arm| arm.allows(position, yaw))
    }

    /// Returns `true` if a goal may move an object (an index into [`Scene::objects`]).
    pub fn wants(&self, object: usize) -> bool {
        self.goals.iter().any(|goal| goal.movers().contains(&object))
    }

    /// Tasks of plainer goals any of which reaches all goals of this one, the nearest first; none where
    /// no goal leaves a [choice](super::Kind::choices).
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
            // Those that are left out would be left out in the end, and groups multiply.
            sets = sets.iter().flat_map(with).take(MOST_CHOICES).collect();
        }
        sets.into_iter().map(|goals| Self { goals: Goal::joined(goals), ..self.clone() }).collect()
    }

    /// Whether every goal is reached, see [`Goal::reached`].
    pub fn reached(&self, state: &State) -> bool {
        self.goals.iter().all(|goal| goal.reached(state))
    }

    /// The largest [`Goal::score`]: at most 1 where every goal is reached.
    pub fn score(&self, state: &State) -> f64 {
        // NaN counts as one.
        let larger = |a: f64, b: f64| if a >= b { a } else { b };
        self.goals.iter().map(|goal| goal.score(state)).reduce(larger).unwrap_or(0.0)
    }

    /// The task with one line about it for people.
    pub fn described(self, description: impl Into<String>) -> Self {
        Self { description: description.into(), ..self }
    }

    /// The task with a choice of these tools only, by name.
    pub fn choosing<N: Into<String>>(self, tools: impl IntoIterator<Item = N>) -> Self {
        Self { tools: ToolChoice::Named(tools.into_iter().map(Into::into).collect()), ..self }
    }

    /// The task with plans that work in this share of the disturbed replays, 0 to 1.
    pub fn robust(self, share: f64) -> Self {
        Self { robustness: share, ..self }
    }

    /// The task with this unknown about its scene.
    pub fn guessing(self, unknown: Unknowns) -> Self {
        Self { unknown, ..self }
    }

    /// The task with lever-ups. Whether pushes may follow them is for [`Task::pushes`] to say.
    ///
    /// ```
    /// use pushplan::task::{Demand, Flipped};
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
        // Of the robot's body lever-ups know nothing yet.
        self.scene.obstacles.retain(|obstacle| obstacle.name != Robot::BASE);
        let robot = self.robot.without_body();
        Self { levers: Some(levers), robot, ..self }
    }

    /// The goal whose object is levered: the first that leaves the plane, or else the first of an object
    /// with room for a blade.
    pub fn levered(&self) -> &Goal {
        let has_room = |goal: &&Goal| {
            self.scene.objects.get(goal.object).is_some_and(|object| object.in_space())
        };
        let lifted = self.goals.iter().find(|goal| !goal.is_pose());
        lifted.or_else(|| self.goals.iter().find(has_room)).unwrap_or(&self.goals[0])
    }

    /// The object that is levered with all its solids.
    pub fn plate(&self) -> Plate {
        Plate::of(&self.scene, self.levered().object)
    }

    /// The lever-ups that are allowed, or would be.
    pub fn lever_rules(&self) -> LeverRules {
        self.levers.clone().unwrap_or_default()
    }

    /// Whether something of it leaves the plane, or may.
    pub fn in_space(&self) -> bool {
        self.levers.is_some() || self.scene.in_space()
    }

    /// The task with other rules for pushes.
    pub fn pushing(self, pushes: PushRules) -> Self {
        Self { pushes, ..self }
    }
}
