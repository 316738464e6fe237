//! Construction of goals in code.

use crate::geometry::{Pose, Shape, Vector};
use crate::scene::{Joint, Scene};

use super::Goal;
use super::demand::{Area, AtPlace, Coverage, Demand, Facing, Fall, Gap, InArea, Outside};

impl Goal {
    /// Demands the centre of object `object` in an area.
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

    /// Demands a gap between object `object` and another object or obstacle, at the final poses of
    /// both.
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

    /// Demands that object `object` with all its parts covers at least `share` (0 to 1) of its
    /// outline at `pose`. Returns `None` if the object does not exist in `scene`.
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

    /// Demands object `object` off the table. The scene states which objects may fall, see
    /// [`Scene::let_fall`].
    ///
    /// ```
    /// use pushplan::scenes::TableTop;
    /// use pushplan::{Edge, Fall};
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

    /// Demands object `object` outside of an obstacle, an index into [`Scene::obstacles`]; `None`
    /// if the obstacle does not exist.
    pub fn outside(scene: &Scene, object: usize, obstacle: usize) -> Option<Self> {
        Some(Self::of(object).with(Demand::Outside(Outside::of(scene, obstacle)?)))
    }

    /// Adds a demand on the heading with an error of at most `tolerance`, radians.
    pub fn facing(self, heading: f64, tolerance: f64) -> Self {
        self.with(Demand::Heading(Facing::new(heading, tolerance)))
    }

    /// Puts the goal in the frame of another object, at that object's final pose.
    pub fn relative_to(self, other: usize) -> Self {
        self.mapped(|demand| demand.kind().relative_to(other))
    }

    /// Accepts every heading at which an object of this `shape` looks the same, as in task files:
    /// any quarter turn of a square, any half turn of a rectangle.
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

    /// Applies the [symmetry](Self::looking_like) of its object in `scene`. A joined or compound
    /// object looks the same only after a full turn.
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

    /// Sets the number of equivalent headings in a full turn.
    pub fn alike(mut self, count: usize) -> Self {
        let facing = self.demands.iter_mut().filter_map(Demand::facing_mut);
        facing.for_each(|facing| facing.symmetry = count);
        self
    }

    /// Applies the limits of the joint that holds its object in `scene`, to the world or to the
    /// object to which the goal is relative. The heading is then reached within the limits,
    /// possibly by the longer way.
    ///
    /// ```
    /// use pushplan::{Goal, JointKind, Object, Pose, Scene, State, Vector};
    /// use pushplan::scenes::Span;
    ///
    /// let limits = Some(Span::new(0.0, 4.0));
    /// let door = Object::cuboid("door", [0.2, 0.02, 0.1]).at(0.5, 0.0, 0.0);
    /// let hinge = JointKind::Revolute { at: Vector::new(0.6, 0.0), limits };
    /// let scene = Scene::new([door]).with_mount(0, hinge);
    /// let goal = Goal::of(0).facing(3.5, 0.1);
    /// let off = |goal: &Goal| goal.turned(&scene.start()).expect("a heading");
    /// assert!((off(&goal) - (std::f64::consts::TAU - 3.5)).abs() < 1e-9, "to the right");
    /// let within = goal.within_limits(&scene);
    /// assert!((off(&within) + 3.5).abs() < 1e-9, "only a rotation to the left is possible");
    /// ```
    pub fn within_limits(mut self, scene: &Scene) -> Self {
        let facing = self.demands.iter_mut().filter_map(Demand::facing_mut);
        facing.for_each(|facing| facing.limit(self.object, scene));
        self
    }

    /// Removes the demands on the position.
    pub fn anywhere(mut self) -> Self {
        self.demands.retain(|demand| demand.kind().tolerance().is_none());
        self
    }

    /// Sets the position of its demands on the position, metres.
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

    /// Sets the tolerance of its demands on the position, metres.
    pub fn set_tolerance(&mut self, to: f64) {
        for demand in &mut self.demands {
            if let Demand::Place(place) = demand {
                place.tolerance = to;
            }
        }
    }
}
