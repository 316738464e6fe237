//! A goal: demands on the final state of an object.

use serde::{Deserialize, Serialize};

use crate::geometry::Vector;
use crate::scene::{Body, Scene, State};

use super::demand::{AtPlace, Check, Demand, End, Facing, ShownGoal};

/// Demands on the final state of an object; all must be satisfied.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Goal {
    /// Index into [`Scene::objects`](crate::scene::Scene::objects).
    pub object: usize,
    /// The demands, at least one.
    pub demands: Vec<Demand>,
    /// Weight against other goals, used if not all goals of a task can be reached.
    #[serde(default = "unit", skip_serializing_if = "is_unit")]
    pub weight: f64,
}

fn unit() -> f64 {
    1.0
}

fn is_unit(weight: &f64) -> bool {
    *weight == 1.0
}

/// A position and a heading that are searched together, with the demands that state them.
#[derive(Clone, Copy, Debug)]
pub struct Aspect<'a> {
    /// Demand with the position.
    pub place: Option<&'a Demand>,
    /// Demand with the heading.
    pub turn: Option<&'a Demand>,
}

/// # Goals in code
impl Goal {
    /// Demands the centre of object `object` (an index into
    /// [`Scene::objects`](crate::scene::Scene::objects)) at (`x`, `y`), with an error of at most
    /// `tolerance`; all metres.
    pub fn new(object: usize, [x, y]: [f64; 2], tolerance: f64) -> Self {
        let position = Vector::new(x, y);
        Self::of(object).with(Demand::Place(AtPlace { position, tolerance, relative: None }))
    }

    /// Creates a goal of object `object` without demands.
    ///
    /// ```
    /// use pushplan::Goal;
    /// use pushplan::goals::{Demand, Flipped};
    ///
    /// let turned = Goal::of(0).with(Demand::Flipped(Flipped { flipped: true }));
    /// assert!(!turned.has_place());
    /// ```
    pub fn of(object: usize) -> Self {
        Self { object, demands: Vec::new(), weight: 1.0 }
    }

    /// Adds a demand.
    pub fn with(mut self, demand: Demand) -> Self {
        self.demands.push(demand);
        self
    }

    /// Adds the goal to a list that has one goal for every object, with all demands on it.
    pub(super) fn join(self, goals: &mut Vec<Self>) {
        match goals.iter_mut().find(|goal| goal.object == self.object) {
            Some(goal) => goal.demands.extend(self.demands),
            None => goals.push(self),
        }
    }

    /// Merges goals so that every object has one goal with all demands on it.
    pub fn joined(goals: Vec<Self>) -> Vec<Self> {
        let mut joined = Vec::with_capacity(goals.len());
        goals.into_iter().for_each(|goal| goal.join(&mut joined));
        joined
    }

    pub(super) fn mapped(&self, with: impl Fn(&Demand) -> Demand) -> Self {
        Self { demands: self.demands.iter().map(with).collect(), ..*self }
    }

    /// Returns the goal in world coordinates, with objects as in `state`.
    pub fn in_world(&self, state: &State) -> Self {
        self.mapped(|demand| demand.in_world(state))
    }

    /// Moves the goal by `shift`, metres, in its own frame.
    pub fn shifted(&self, shift: Vector) -> Self {
        self.mapped(|demand| demand.kind().shifted(shift))
    }

    /// Returns a goal that is harder to reach. Tolerances shrink by these margins (metres and
    /// radians), and areas by the same margin on every side; at least half of each remains.
    pub fn stricter(&self, place: f64, turn: f64) -> Self {
        self.mapped(|demand| demand.kind().stricter(place, turn))
    }
}

/// # Properties
impl Goal {
    /// Returns the objects that it may move, and the objects to which it demands a gap.
    pub fn objects(&self) -> impl Iterator<Item = usize> {
        let others = self.demands.iter().filter_map(|demand| match demand.kind().to() {
            Some(Body::Object(other)) => Some(other),
            _ => None,
        });
        self.movers().into_iter().chain(others)
    }

    /// Returns the objects that may be moved for it, its own first.
    pub fn movers(&self) -> Vec<usize> {
        let others = self.demands.iter().flat_map(|demand| demand.kind().movers());
        let mut movers = vec![self.object];
        for other in others {
            if !movers.contains(&other) {
                movers.push(other);
            }
        }
        movers
    }

    /// Returns the object to which its errors refer: its own, or another that it may move.
    pub fn subject(&self, state: &State) -> usize {
        let end = End::resting(self.object, state);
        let mut subjects = self.demands.iter().map(|demand| demand.kind().subject(&end));
        subjects.find(|subject| *subject != self.object).unwrap_or(self.object)
    }

    /// Returns sets of goals without choices, at least one set, the nearest first; reaching one set
    /// reaches this goal.
    pub fn choices(&self, state: &State) -> Vec<Vec<Self>> {
        let chosen: Vec<Vec<Vec<Self>>> =
            self.demands.iter().map(|demand| demand.kind().choices(state)).collect();
        let mut plain = self.clone();
        let mut open = chosen.iter().map(|choices| !choices.is_empty());
        plain.demands.retain(|_| open.next() == Some(false));
        let own = if plain.demands.is_empty() { Vec::new() } else { vec![plain] };
        let mut sets = vec![own];
        for choices in chosen.iter().filter(|choices| !choices.is_empty()) {
            let with = |set: &Vec<Self>| {
                let longer = |choice: &Vec<Self>| set.iter().chain(choice).cloned().collect();
                choices.iter().map(longer).collect::<Vec<Vec<Self>>>()
            };
            sets = sets.iter().flat_map(with).collect();
        }
        sets
    }

    /// Returns `true` if it demands a position.
    pub fn has_place(&self) -> bool {
        self.demands.iter().any(|demand| demand.kind().tolerance().is_some())
    }

    /// Returns `true` if it relates the object to another body, so that no single position is
    /// wanted.
    pub fn is_relation(&self) -> bool {
        self.demands.iter().any(|demand| demand.kind().is_relation())
    }

    /// Returns `true` if all its demands are positions and headings, which pushes achieve.
    pub fn is_pose(&self) -> bool {
        self.demands.iter().all(Demand::is_pose)
    }

    /// Returns `true` if the object leaves the table.
    pub fn falls(&self) -> bool {
        self.demands.iter().any(|demand| demand.kind().falls())
    }

    /// Returns the first wanted position that is a point of a frame or the centre of an area,
    /// metres.
    pub fn position(&self) -> Option<Vector> {
        self.demands.iter().find_map(|demand| demand.kind().position())
    }

    /// Returns the smallest tolerance of its positions, metres; infinite if it demands no position.
    pub fn tolerance(&self) -> f64 {
        let tolerances = self.demands.iter().filter_map(|demand| demand.kind().tolerance());
        tolerances.reduce(f64::min).unwrap_or(f64::INFINITY)
    }

    /// Returns the first heading that it demands.
    pub fn heading(&self) -> Option<&Facing> {
        self.demands.iter().find_map(|demand| demand.kind().facing())
    }

    /// Returns the object in whose frame its first position or heading is.
    pub fn relative(&self) -> Option<usize> {
        self.demands.iter().find_map(|demand| demand.kind().relative())
    }

    /// Returns its positions and headings in pairs for the search; at least one pair.
    pub fn aspects(&self) -> impl Iterator<Item = Aspect<'_>> {
        let mut places = self.demands.iter().filter(|demand| demand.kind().tolerance().is_some());
        let mut turns = self.demands.iter().filter(|demand| demand.kind().facing().is_some());
        let count = places.clone().count().max(turns.clone().count()).max(1);
        (0..count).map(move |_| Aspect { place: places.next(), turn: turns.next() })
    }

    /// Returns the reason why no plan can be judged by it, if any.
    pub fn fault(&self, scene: &Scene) -> Option<String> {
        if self.demands.is_empty() {
            return Some("the goal has no criterion".to_owned());
        }
        let lost = |other: usize| other >= scene.objects.len() || other == self.object;
        if self.demands.iter().filter_map(|demand| demand.kind().relative()).any(lost) {
            return Some("a goal must be relative to another object of the scene".to_owned());
        }
        self.demands.iter().find_map(|demand| demand.kind().fault(self.object, scene))
    }

    /// Returns the demanded share of its own outline that the object must cover, if any.
    pub fn wanted_share(&self) -> Option<f64> {
        self.demands.iter().find_map(|demand| demand.kind().share())
    }
}

/// # Words, marks and checks
impl Goal {
    /// Returns the names of the objects that may be moved for it.
    pub fn names(&self, scene: &Scene) -> String {
        let movers = self.movers().into_iter();
        let names = movers.filter_map(|k| scene.objects.get(k)).map(|object| object.name.as_str());
        names.collect::<Vec<_>>().join(", ")
    }

    /// Returns its objects and its demands in words.
    pub fn line(&self, scene: &Scene) -> String {
        let names = self.names(scene);
        let names = if names.is_empty() { "object" } else { &names };
        let colon = if self.is_pose() { "" } else { ":" };
        format!("{names}{colon} {}", self.words(scene))
    }

    /// Returns its demands in words, without the name of its object.
    pub fn words(&self, scene: &Scene) -> String {
        let (poses, others): (Vec<&Demand>, Vec<&Demand>) =
            self.demands.iter().partition(|demand| demand.is_pose());
        let mut frames: Vec<usize> = Vec::new();
        let mut phrase = |demand: &Demand| {
            let other = demand.kind().relative().filter(|other| !frames.contains(other));
            frames.extend(other);
            let of = other.and_then(|other| scene.objects.get(other));
            let of = of.map_or(String::new(), |other| format!(" in the frame of {}", other.name));
            format!("{}{of}", demand.kind().words(self.object, scene))
        };
        others.into_iter().chain(poses).map(&mut phrase).collect::<Vec<_>>().join(", ")
    }

    /// Returns `true` if a blade must lift an edge of the object.
    pub fn raises(&self) -> bool {
        self.demands.iter().any(|demand| matches!(demand, Demand::Raised(_)))
    }

    /// Returns the check that judges exported scenes.
    pub fn check(&self, scene: &Scene) -> Check {
        let of = self.demands.iter().map(|demand| demand.kind().check(self.object, scene));
        let of: Vec<Check> = of.collect();
        Check::AtLeast { count: of.len(), of }
    }

    /// Returns its marks for drawings, with every object at its start.
    pub fn shown(&self, scene: &Scene) -> ShownGoal {
        let start = scene.start();
        let goal = self.in_world(&start);
        let own = || start.poses.get(self.object).map(|pose| pose.position);
        let marks = goal.demands.iter().flat_map(|one| one.kind().marks(self.object, scene));
        let (place, marks) = (goal.position(), marks.collect());
        let centre = place.or_else(own).unwrap_or_default();
        ShownGoal { objects: self.movers(), centre, placed: place.is_some(), marks }
    }
}
