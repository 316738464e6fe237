//! What must come of a plan: where an object lies at rest, and how.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Shape, Vector, wrap_angle};

use super::{Area, Coverage, Fall, Gap};
use crate::scene::{Body, Joint, Scene, Span, State};

/// Where an object must come to rest, and how; every stated demand counts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Goal {
    /// Index into [`Scene::objects`](crate::scene::Scene::objects).
    pub object: usize,
    /// Wanted position of its centre, metres; of a [relation](Self::is_relation), how far the object may be
    /// from where that is right.
    pub position: Vector,
    /// Largest distance that still counts as success, metres; infinite where it may lie anywhere.
    #[serde(with = "anywhere")]
    pub tolerance: f64,
    /// Wanted heading and its tolerance, radians, where one is asked for.
    pub heading: Option<(f64, f64)>,
    /// Where the wanted heading is that of a joint with limits: the heading in the middle of what they allow,
    /// radians. Headings are told from those a full turn away by being nearest to it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub middle: Option<f64>,
    /// Where its centre may be instead of near the position, which is then the middle of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area: Option<Area>,
    /// How far it is from another thing, instead of near the position.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap: Option<Box<Gap>>,
    /// How much of its own outline at position and heading it covers, instead of both within tolerances.
    /// Those are what search and refinement go by: each alone loses half of what may be missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coverage: Option<Box<Coverage>>,
    /// Over which edge of the table it is to fall, instead of coming to rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fall: Option<Box<Fall>>,
    /// Index of the object in whose frame position, heading and area are, wherever that has come to; in
    /// the world where none is named.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relative: Option<usize>,
    /// The number of equal turns in a full turn after each of which the object looks the same, where
    /// all those headings count as the wanted one; else 1.
    #[serde(default = "one")]
    pub alike: usize,
    /// Index into [`Scene::obstacles`](crate::scene::Scene::obstacles): the object's centre lies outside of
    /// it, seen from above.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outside: Option<usize>,
    /// At the end of a lever-up's turn the edge lies on the blade, this much higher than at its
    /// start, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub raised: Option<f64>,
    /// It lies upside down, or on its underside.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flipped: Option<bool>,
    /// How much it counts where not all goals of a task can be met: those that weigh most together are.
    #[serde(default = "unit", skip_serializing_if = "is_unit")]
    pub weight: f64,
}

fn unit() -> f64 {
    1.0
}

fn is_unit(weight: &f64) -> bool {
    *weight == 1.0
}

fn one() -> usize {
    1
}

/// JSON has no infinity.
pub(super) mod anywhere {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(tolerance: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        tolerance.is_finite().then_some(*tolerance).serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    }
}

impl Goal {
    /// The centre of object `object` (an index into [`Scene::objects`](crate::scene::Scene::objects)) at
    /// (`x`, `y`), off by at most `tolerance`; all metres.
    pub fn new(object: usize, [x, y]: [f64; 2], tolerance: f64) -> Self {
        Self { position: Vector::new(x, y), tolerance, ..Self::of(object) }
    }

    /// A goal of object `object` without any demand yet.
    ///
    /// ```
    /// use pushplan::Goal;
    ///
    /// let turned = Goal { flipped: Some(true), ..Goal::of(0) };
    /// assert!(turned.in_space() && !turned.has_place());
    /// ```
    pub fn of(object: usize) -> Self {
        Self {
            object,
            position: Vector::zeros(),
            tolerance: f64::INFINITY,
            heading: None,
            middle: None,
            area: None,
            gap: None,
            coverage: None,
            fall: None,
            relative: None,
            alike: 1,
            outside: None,
            raised: None,
            flipped: None,
            weight: 1.0,
        }
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
        let area = Area { shape, pose };
        let tolerance = area.depth();
        Self { position: pose.position, tolerance, area: Some(area), ..Self::of(object) }
    }

    /// Object `object` so far from another thing, wherever both come to.
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
        Self { tolerance: gap.depth(), gap: Some(gap), ..Self::of(object) }
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
        let coverage = Coverage::of(scene, object, share)?;
        let (tolerance, turn) = coverage.tolerances();
        let goal = Self::new(object, pose.position.into(), tolerance);
        let goal = match turn {
            Some(turn) => goal.facing(pose.heading, turn).looking_alike(scene),
            None => goal,
        };
        Some(Self { coverage: Some(coverage), ..goal })
    }

    /// Object `object` off the table. What may fall in a scene is said there, see [`Scene::let_fall`].
    ///
    /// ```
    /// use pushplan::{scene::TableTop, task::{Edge, Fall}};
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
        Self { tolerance: fall.depth(), fall: Some(fall), ..Self::of(object) }
    }

    /// The same in the frame of another object, wherever that has come to.
    pub fn relative_to(self, other: usize) -> Self {
        Self { relative: Some(other), ..self }
    }

    /// The same goal in the world, with everything where it is in `state`.
    pub fn in_world(&self, state: &State) -> Self {
        let Some(frame) = self.relative.and_then(|other| state.poses.get(other)) else {
            return self.clone();
        };
        let position = match self.is_relation() {
            true => self.position,
            false => frame.point(self.position),
        };
        Self {
            position,
            heading: self.heading.map(|(heading, within)| (frame.heading + heading, within)),
            middle: self.middle.map(|middle| frame.heading + middle),
            area: self.area.map(|area| area.seen_from(frame)),
            relative: None,
            ..self.clone()
        }
    }

    /// The same goal moved by `shift`, metres, of its own frame.
    pub fn shifted(&self, shift: Vector) -> Self {
        let area = self.area.map(|area| area.shifted(shift));
        Self { position: self.position + shift, area, ..self.clone() }
    }

    /// A goal that is harder to reach: by these shares of tolerances (metres and radians) or, of an area,
    /// by as much around it; at least half of each is left.
    pub fn stricter(&self, place: f64, turn: f64) -> Self {
        let less = |tolerance: f64, by: f64| (tolerance - by).max(0.5 * tolerance);
        let area = self.area.map(|area| area.shrunk(place));
        let gap = self.gap.as_ref().map(|gap| Box::new(gap.tighter(place)));
        let fall = self.fall.as_ref().map(|fall| Box::new(fall.farther(place)));
        let heading = self.heading.map(|(heading, tolerance)| (heading, less(tolerance, turn)));
        let tolerance = less(self.tolerance, place);
        let left = tolerance / self.tolerance;
        let coverage = self.coverage.as_ref().map(|coverage| Box::new(coverage.stricter(left)));
        Self { tolerance, heading, area, gap, coverage, fall, ..self.clone() }
    }

    /// The objects that it speaks of: its own, and the one to which there is to be a gap.
    pub fn objects(&self) -> impl Iterator<Item = usize> {
        let other = self.gap.as_ref().and_then(|gap| match gap.to {
            Body::Object(other) => Some(other),
            _ => None,
        });
        std::iter::once(self.object).chain(other)
    }

    /// Whether the object must come to a place.
    pub fn has_place(&self) -> bool {
        self.tolerance != f64::INFINITY
    }

    /// Whether it asks how the object is to something else, a gap to it or off the table, and for no place of
    /// its own: the position is then an offset.
    pub fn is_relation(&self) -> bool {
        self.gap.is_some() || self.fall.is_some()
    }

    /// Whether it speaks of more than where the object lies in the plane.
    pub fn in_space(&self) -> bool {
        self.outside.is_some() || self.raised.is_some() || self.flipped.is_some()
    }

    /// Whether it speaks of how the object comes to lie.
    pub fn turns(&self) -> bool {
        self.flipped.is_some() || self.has_place()
    }

    /// The goal with a heading that may be off by at most `tolerance`, radians.
    pub fn facing(self, heading: f64, tolerance: f64) -> Self {
        Self { heading: Some((heading, tolerance)), ..self }
    }

    /// The goal at which every heading counts as the wanted one that looks the same on an object of
    /// this `shape`, as in task files: any quarter turn of a square, any half turn of a rectangle.
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
        Self { alike: shape.footprint().symmetry().unwrap_or(1), ..self }
    }

    /// The same of the goal's object as it stands in `scene`: what is joined to something else, or has
    /// several solids, looks the same after a full turn alone.
    pub fn looking_alike(self, scene: &Scene) -> Self {
        let joined = |joint: &Joint| joint.between.contains(&self.object);
        match scene.objects.get(self.object) {
            Some(object)
                if scene.mount(self.object).is_none() && !scene.joints.iter().any(joined) =>
            {
                self.looking_like(&object.shape)
            }
            _ => Self { alike: 1, ..self },
        }
    }

    /// The same where a joint with limits holds the goal's object in `scene`, to the world or to what the
    /// goal is relative to: the heading is then come to within the limits, if by the longer way.
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
    pub fn within_limits(self, scene: &Scene) -> Self {
        let Some((wanted, within)) = self.heading else { return self };
        let middle = |span: Span| 0.5 * (span.low + span.high);
        let start = |object: usize| scene.objects.get(object).map(|object| object.pose.heading);
        let of = |object: usize| start(object).unwrap_or_default();
        let middle = match self.relative {
            None => {
                let mount = scene.mounts.iter().find(|mount| mount.object == self.object);
                let turns = mount.and_then(|mount| mount.kind.turns());
                turns.map(|span| of(self.object) + middle(span))
            }
            Some(other) => scene.joints.iter().find_map(|joint| {
                // Joints count how far the second object has turned against the first.
                let sign = match joint.between {
                    [first, second] if [first, second] == [other, self.object] => 1.0,
                    [first, second] if [first, second] == [self.object, other] => -1.0,
                    _ => return None,
                };
                let start = of(self.object) - of(other);
                Some(start + sign * middle(joint.kind.turns()?))
            }),
        };
        let Some(middle) = middle else { return self };
        let off = wanted - middle;
        let wanted = if off.abs() > PI { middle + wrap_angle(off) } else { wanted };
        Self { heading: Some((wanted, within)), middle: Some(middle), ..self }
    }
}
