//! A goal: demands on the final state of one object.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Shape, Vector};
use crate::scene::{Body, Joint, Scene, State};

use super::demand::{Area, AtPlace, Coverage, Demand, End, Facing, Fall, Gap, InArea, Outside};

/// Demands on where and how one object ends; all of them count.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Goal {
    /// Index into [`Scene::objects`](crate::scene::Scene::objects).
    pub object: usize,
    /// The demands, at least one.
    pub demands: Vec<Demand>,
    /// Weight against other goals where not all of a task can be met.
    #[serde(default = "unit", skip_serializing_if = "is_unit")]
    pub weight: f64,
}

fn unit() -> f64 {
    1.0
}

fn is_unit(weight: &f64) -> bool {
    *weight == 1.0
}

/// A position and a heading that are searched together, each of the demand that asks for it.
#[derive(Clone, Copy, Debug)]
pub struct Aspect<'a> {
    /// The demand with the position.
    pub place: Option<&'a Demand>,
    /// The demand with the heading.
    pub turn: Option<&'a Demand>,
}

/// # Goals in code
impl Goal {
    /// The centre of object `object` (an index into [`Scene::objects`](crate::scene::Scene::objects)) at
    /// (`x`, `y`), off by at most `tolerance`; all metres.
    pub fn new(object: usize, [x, y]: [f64; 2], tolerance: f64) -> Self {
        let position = Vector::new(x, y);
        Self::of(object).with(Demand::Place(AtPlace { position, tolerance, relative: None }))
    }

    /// A goal of object `object` without any demand yet.
    ///
    /// ```
    /// use pushplan::Goal;
    /// use pushplan::task::{Demand, Flipped};
    ///
    /// let turned = Goal::of(0).with(Demand::Flipped(Flipped { flipped: true }));
    /// assert!(!turned.has_place());
    /// ```
    pub fn of(object: usize) -> Self {
        Self { object, demands: Vec::new(), weight: 1.0 }
    }

    /// The goal with one demand more.
    pub fn with(mut self, demand: Demand) -> Self {
        self.demands.push(demand);
        self
    }

    /// The centre of object `object` anywhere in an area.
    ///
    /// ```
    /// use pushplan::{Goal, Pose, Shape, State};
    ///
    /// let tray = Shape::Cuboid { size: [0.3, 0.2, 0.01] };
    /// let goal = Goal::within(0, tray, Pose::new(0.5, 0.1, 0.0));
    /// let at = |x: f64, y: f64| State::at_rest(vec![Pose::new(x, y, 0.0)]);
    /// assert!(goal.reached(&at(0.36, 0.19)) && !goal.reached(&at(0.34, 0.1)));
    /// ```
    pub fn within(object: usize, shape: Shape, pose: Pose) -> Self {
        let area = InArea::new(Area { shape, pose });
        Self::of(object).with(Demand::Area(Box::new(area)))
    }

    /// Object `object` so far from another object or obstacle, wherever both come to.
    ///
    /// ```
    /// use pushplan::{Body, Gap, Goal, Object, Pose, Scene, State};
    ///
    /// let [can, cup] = ["can", "cup"].map(|name| Object::cylinder(name, 0.04, 0.10));
    /// let scene = Scene::new([can.at(0.5, 0.1, 0.0), cup.at(0.5, -0.1, 0.0)]);
    /// let gap = Gap::between(&scene, 0, Body::Object(1), [0.0, 0.002]).expect("they exist");
    /// let touching = Goal::beside(0, gap);
    /// let at = |y: f64| State::at_rest(vec![Pose::new(0.5, y, 0.0), Pose::new(0.5, -0.1, 0.0)]);
    /// assert!(touching.reached(&at(-0.019)) && !touching.reached(&at(-0.01)));
    /// ```
    pub fn beside(object: usize, gap: Box<Gap>) -> Self {
        Self::of(object).with(Demand::Gap(gap))
    }

    /// Object `object` so that it covers at least `share` (0 to 1) of the outline that it has at `pose`, with
    /// all its parts; `None` where it does not exist in `scene`.
    ///
    /// ```
    /// use pushplan::{Goal, Object, Pose, Scene, State};
    ///
    /// let scene = Scene::new([Object::cuboid("box", [0.1, 0.1, 0.05])]);
    /// let goal = Goal::covering(&scene, 0, Pose::new(0.5, 0.0, 0.0), 0.9).expect("it exists");
    /// let at = |x: f64| State::at_rest(vec![Pose::new(x, 0.0, 0.0)]);
    /// assert!(goal.reached(&at(0.509)) && !goal.reached(&at(0.511)));
    /// ```
    pub fn covering(scene: &Scene, object: usize, pose: Pose, share: f64) -> Option<Self> {
        let coverage = Coverage::of(scene, object, pose, share)?;
        Some(Self::of(object).with(Demand::Coverage(coverage)).looking_alike(scene))
    }

    /// Object `object` off the table. A scene states which objects may fall, see [`Scene::let_fall`].
    ///
    /// ```
    /// use pushplan::scene::TableTop;
    /// use pushplan::task::{Edge, Fall};
    /// use pushplan::{Goal, Object, Pose, Robot, Scene, State, Task, Vector};
    ///
    /// let mut scene = Scene::new([Object::cylinder("can", 0.04, 0.10).at(0.5, 0.1, 0.0)]);
    /// scene.table_top = Some(TableTop { size: [0.8, 0.6], middle: Vector::new(0.6, 0.0) });
    /// let fall = Fall::of(&scene, 0, Some(Edge::Left)).expect("the table ends");
    /// let task = Task::new("clear", scene, Robot::reaching(0.1, 0.9), Goal::falling(0, fall));
    /// assert!(task.scene.objects[0].may_fall);
    /// assert!(task.reached(&State::at_rest(vec![Pose::new(0.5, 0.31, 0.0)])));
    /// ```
    pub fn falling(object: usize, fall: Box<Fall>) -> Self {
        Self::of(object).with(Demand::Fall(fall))
    }

    /// Object `object` outside of an obstacle, an index into [`Scene::obstacles`]; `None` where it does not
    /// exist.
    pub fn outside(scene: &Scene, object: usize, obstacle: usize) -> Option<Self> {
        Some(Self::of(object).with(Demand::Outside(Outside::of(scene, obstacle)?)))
    }

    /// The goal with a heading that may be off by at most `tolerance`, radians.
    pub fn facing(self, heading: f64, tolerance: f64) -> Self {
        self.with(Demand::Heading(Facing::new(heading, tolerance)))
    }

    /// The goal in the frame of another object, wherever that has come to.
    pub fn relative_to(self, other: usize) -> Self {
        self.mapped(|demand| demand.kind().relative_to(other))
    }

    /// The goal at which every heading counts that looks the same on an object of this `shape`, as in task
    /// files: any quarter turn of a square, any half turn of a rectangle.
    ///
    /// ```
    /// use pushplan::{Goal, Pose, Shape, State};
    ///
    /// let square = Shape::Cuboid { size: [0.08, 0.08, 0.05] };
    /// let goal = Goal::new(0, [0.5, 0.0], 0.02).facing(0.1, 0.05);
    /// let turned = State::at_rest(vec![Pose::new(0.5, 0.0, 0.1 + std::f64::consts::FRAC_PI_2)]);
    /// assert!(!goal.reached(&turned) && goal.looking_like(&square).reached(&turned));
    /// ```
    pub fn looking_like(self, shape: &Shape) -> Self {
        self.alike(shape.footprint().symmetry().unwrap_or(1))
    }

    /// The goal with the [symmetry](Self::looking_like) of its object as it stands in `scene`: a joined
    /// object, or one of several solids, looks the same after a full turn alone.
    pub fn looking_alike(self, scene: &Scene) -> Self {
        let joined = |joint: &Joint| joint.between.contains(&self.object);
        match scene.objects.get(self.object) {
            Some(object)
                if scene.mount(self.object).is_none() && !scene.joints.iter().any(joined) =>
            {
                self.looking_like(&object.shape)
            }
            _ => self.alike(1),
        }
    }

    /// The goal with this number of headings in a full turn that count alike.
    pub fn alike(mut self, count: usize) -> Self {
        let facing = self.demands.iter_mut().filter_map(Demand::facing_mut);
        facing.for_each(|facing| facing.symmetry = count);
        self
    }

    /// The goal where a joint with limits holds its object in `scene`, to the world or to the object that
    /// the goal is relative to: the heading is reached within the limits, if by the longer way.
    ///
    /// ```
    /// use pushplan::{Goal, JointKind, Object, Pose, Scene, State, Vector};
    /// use pushplan::scene::Span;
    ///
    /// let limits = Some(Span::new(0.0, 4.0));
    /// let door = Object::cuboid("door", [0.2, 0.02, 0.1]).at(0.5, 0.0, 0.0);
    /// let hinge = JointKind::Revolute { at: Vector::new(0.6, 0.0), limits };
    /// let scene = Scene::new([door]).with_mount(0, hinge);
    /// let goal = Goal::of(0).facing(3.5, 0.1);
    /// let off = |goal: &Goal| goal.turned(&scene.start()).expect("a heading");
    /// assert!((off(&goal) - (std::f64::consts::TAU - 3.5)).abs() < 1e-9, "to the right");
    /// assert!((off(&goal.within_limits(&scene)) + 3.5).abs() < 1e-9, "it turns to the left alone");
    /// ```
    pub fn within_limits(mut self, scene: &Scene) -> Self {
        let facing = self.demands.iter_mut().filter_map(Demand::facing_mut);
        facing.for_each(|facing| facing.limit(self.object, scene));
        self
    }

    /// The goal without its demands on the position.
    pub fn anywhere(mut self) -> Self {
        self.demands.retain(|demand| demand.kind().tolerance().is_none());
        self
    }

    /// Sets the point of its demands for a place, metres.
    pub fn set_position(&mut self, to: Vector) {
        for demand in &mut self.demands {
            let shift = demand.kind().position().map(|position| to - position);
            *demand = match (demand.clone(), shift) {
                (Demand::Place(place), _) => Demand::Place(AtPlace { position: to, ..place }),
                (other, Some(shift)) => other.kind().shifted(shift),
                (other, None) => other,
            };
        }
    }

    /// Sets the tolerance of its demands for a place, metres.
    pub fn set_tolerance(&mut self, to: f64) {
        for demand in &mut self.demands {
            if let Demand::Place(place) = demand {
                place.tolerance = to;
            }
        }
    }

    /// Joins a goal to a list that has one goal for every object, each with all demands on it.
    pub(super) fn join(self, goals: &mut Vec<Self>) {
        match goals.iter_mut().find(|goal| goal.object == self.object) {
            Some(goal) => goal.demands.extend(self.demands),
            None => goals.push(self),
        }
    }

    /// Joins goals so that there is one for every object, with all demands on it.
    pub fn joined(goals: Vec<Self>) -> Vec<Self> {
        let mut joined = Vec::with_capacity(goals.len());
        goals.into_iter().for_each(|goal| goal.join(&mut joined));
        joined
    }

    fn mapped(&self, with: impl Fn(&Demand) -> Demand) -> Self {
        Self { demands: self.demands.iter().map(with).collect(), ..*self }
    }

    /// The goal in the world, with everything where it is in `state`.
    pub fn in_world(&self, state: &State) -> Self {
        self.mapped(|demand| demand.in_world(state))
    }

    /// The goal moved by `shift`, metres, of its own frame.
    pub fn shifted(&self, shift: Vector) -> Self {
        self.mapped(|demand| demand.kind().shifted(shift))
    }

    /// A goal that is harder to reach: by these shares of tolerances (metres and radians) or, of an area,
    /// by as much around it; at least half of each is left.
    pub fn stricter(&self, place: f64, turn: f64) -> Self {
        self.mapped(|demand| demand.kind().stricter(place, turn))
    }
}

/// # Properties
impl Goal {
    /// The objects that it may move, and those to which it demands a gap.
    pub fn objects(&self) -> impl Iterator<Item = usize> {
        let others = self.demands.iter().filter_map(|demand| match demand.kind().to() {
            Some(Body::Object(other)) => Some(other),
            _ => None,
        });
        self.movers().into_iter().chain(others)
    }

    /// The objects that may be moved for it, its own first.
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

    /// The object that its errors are of: its own, or another that it may move.
    pub fn subject(&self, state: &State) -> usize {
        let end = End::resting(self.object, state);
        let mut subjects = self.demands.iter().map(|demand| demand.kind().subject(&end));
        subjects.find(|subject| *subject != self.object).unwrap_or(self.object)
    }

    /// Sets of plainer goals any of which reaches it, the nearest first, at least one.
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

    /// Returns `true` if the object must come to a place.
    pub fn has_place(&self) -> bool {
        self.demands.iter().any(|demand| demand.kind().tolerance().is_some())
    }

    /// Returns `true` if it relates the object to something else, so that no single place is the right one.
    pub fn is_relation(&self) -> bool {
        self.demands.iter().any(|demand| demand.kind().is_relation())
    }

    /// Returns `true` if all its demands are about positions and headings, which pushes bring about.
    pub fn is_pose(&self) -> bool {
        self.demands.iter().all(Demand::is_pose)
    }

    /// Returns `true` if the object leaves the table.
    pub fn falls(&self) -> bool {
        self.demands.iter().any(|demand| demand.kind().falls())
    }

    /// The first of its wanted positions that is one point of a frame, or the centre of an area, metres.
    pub fn position(&self) -> Option<Vector> {
        self.demands.iter().find_map(|demand| demand.kind().position())
    }

    /// The smallest tolerance of its positions, metres; infinite where the object may lie anywhere.
    pub fn tolerance(&self) -> f64 {
        let tolerances = self.demands.iter().filter_map(|demand| demand.kind().tolerance());
        tolerances.reduce(f64::min).unwrap_or(f64::INFINITY)
    }

    /// The first heading that it asks for.
    pub fn heading(&self) -> Option<&Facing> {
        self.demands.iter().find_map(|demand| demand.kind().facing())
    }

    /// The object in whose frame its first position or heading is.
    pub fn relative(&self) -> Option<usize> {
        self.demands.iter().find_map(|demand| demand.kind().relative())
    }

    /// Its positions and headings in pairs, as they are searched together; at least one pair.
    pub fn aspects(&self) -> impl Iterator<Item = Aspect<'_>> {
        let mut places = self.demands.iter().filter(|demand| demand.kind().tolerance().is_some());
        let mut turns = self.demands.iter().filter(|demand| demand.kind().facing().is_some());
        let count = places.clone().count().max(turns.clone().count()).max(1);
        (0..count).map(move |_| Aspect { place: places.next(), turn: turns.next() })
    }

    /// The reason why no plan can be judged by it.
    pub fn fault(&self, scene: &Scene) -> Option<String> {
        if self.demands.is_empty() {
            return Some("the goal asks for nothing".to_owned());
        }
        let lost = |other: usize| other >= scene.objects.len() || other == self.object;
        if self.demands.iter().filter_map(|demand| demand.kind().relative()).any(lost) {
            return Some("a goal is relative to another object of the scene".to_owned());
        }
        self.demands.iter().find_map(|demand| demand.kind().fault(self.object, scene))
    }

    /// The share of its own outline that the object must cover, where one is asked for.
    pub fn wanted_share(&self) -> Option<f64> {
        self.demands.iter().find_map(|demand| demand.kind().share())
    }
}
