//! Demand: an object falls off the table, over any edge or a part of an edge.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Vector};

use crate::scene::is_zero;
use crate::scene::{Scene, Span, State, TableTop};
use crate::task::Goal;

use super::check::name;
use super::{Check, Demand, End, Kind, Mark, Quantity, less};

/// Distance of the targets of search and refinement beyond the edge and from the ends of its
/// demanded part, metres. Simulations differ by millimetres.
const BEYOND: f64 = 0.02;

/// An edge of the table, from the viewpoint of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Edge {
    /// Ahead, +x.
    Far,
    /// Behind objects in front of the robot, -x.
    Near,
    /// +y.
    Left,
    /// -y.
    Right,
}

impl Edge {
    /// Every edge.
    pub const ALL: [Self; 4] = [Self::Far, Self::Near, Self::Left, Self::Right];

    /// Returns its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Far => "far",
            Self::Near => "near",
            Self::Left => "left",
            Self::Right => "right",
        }
    }

    /// Returns the direction off the table over it, a unit vector.
    pub fn outwards(self) -> Vector {
        match self {
            Self::Far => Vector::x(),
            Self::Near => -Vector::x(),
            Self::Left => Vector::y(),
            Self::Right => -Vector::y(),
        }
    }

    /// Returns the direction along it, a unit vector: +x or +y.
    pub fn along(self) -> Vector {
        let out = self.outwards();
        Vector::new(out.y.abs(), out.x.abs())
    }
}

/// A demand that an object falls off the table: its centre of mass must come beyond an edge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fall {
    /// The table.
    pub top: TableTop,
    /// The edge; `None` for any edge.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over: Option<Edge>,
    /// Range along that edge, metres of the world's x or y; `None` for the whole edge.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between: Option<Span>,
    /// Minimum distance of its centre beyond the edge, metres.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub by: f64,
    /// The centre of mass in the object's frame, metres.
    centre: Vector,
    /// Maximum distance from the nearest target position, metres.
    tolerance: f64,
    /// Offset of the centre from its place of falling, a target of refinement, metres.
    shift: Vector,
}

impl Fall {
    /// Demands that object `object` falls; `None` if it does not exist in `scene`, or if the table
    /// has no edge.
    pub fn of(scene: &Scene, object: usize, over: Option<Edge>) -> Option<Box<Self>> {
        let (top, pose) = (scene.table_top?, scene.objects.get(object)?.pose);
        let centre = pose.local_point(scene.centre(object, &scene.start()));
        let (shift, tolerance) = (Vector::zeros(), BEYOND);
        Some(Box::new(Self { top, over, between: None, by: 0.0, centre, tolerance, shift }))
    }

    /// Restricts the fall to this range along the edge, metres, for example above a box.
    pub fn between(self, span: Span) -> Self {
        let fall = Self { between: Some(span), ..self };
        Self { tolerance: fall.depth(), ..fall }
    }

    /// Returns the edges over which it may fall.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        Edge::ALL.into_iter().filter(|edge| self.over.is_none_or(|over| over == *edge))
    }

    /// Returns the distance of this edge along its [outward direction](Edge::outwards), metres.
    pub fn place(&self, edge: Edge) -> f64 {
        let half = 0.5 * Vector::from(self.top.size);
        edge.outwards().dot(&self.top.middle) + edge.outwards().abs().dot(&half)
    }

    /// Returns the ends of this edge, or of its demanded part, metres.
    pub fn ends(&self, edge: Edge) -> [Vector; 2] {
        let half = 0.5 * Vector::from(self.top.size);
        let (out, along) = (edge.outwards(), edge.along());
        [1.0, -1.0].map(|side| {
            let end = self.top.middle + (out + side * along).component_mul(&half);
            let at = along.dot(&end);
            let kept = self.between.map_or(at, |span| at.max(span.low).min(span.high));
            end + (kept - at) * along
        })
    }

    /// Returns the centre of mass of an object at `own`, metres.
    pub fn centre(&self, own: &Pose) -> Vector {
        own.point(self.centre)
    }

    /// Returns the largest distance of a centre beyond an edge, metres, negative on the table, and
    /// the outward direction over that edge.
    fn beyond(&self, centre: Vector) -> (f64, Vector) {
        let of = |edge: Edge| (edge.outwards().dot(&centre) - self.place(edge), edge.outwards());
        let farther = |a: (f64, Vector), b: (f64, Vector)| if b.0 > a.0 { b } else { a };
        self.edges().map(of).reduce(farther).unwrap_or((f64::NEG_INFINITY, Vector::zeros()))
    }

    /// Returns `true` if an object with its centre at `centre` falls at a demanded place.
    fn holds(&self, centre: Vector) -> bool {
        self.beyond(centre).0 > self.by && self.aside(centre, 0.0) == Vector::zeros()
    }

    /// Returns the offset of a centre from the nearest target position, metres.
    fn missing(&self, centre: Vector) -> Vector {
        let (beyond, out) = self.beyond(centre);
        let depth = self.depth();
        (beyond - self.by - depth).min(0.0) * out + self.aside(centre, depth)
    }

    /// Returns the offset of a centre, along the edge, from the demanded part of the edge, reduced
    /// by `inside` at both ends, metres.
    fn aside(&self, centre: Vector, inside: f64) -> Vector {
        let (Some(edge), Some(Span { low, high })) = (self.over, self.between) else {
            return Vector::zeros();
        };
        let at = edge.along().dot(&centre);
        (at - at.max(low + inside).min(high - inside)) * edge.along()
    }

    /// Returns the distance of target positions beyond the demanded limits, metres; half-way to the
    /// middle of a short part of an edge.
    pub fn depth(&self) -> f64 {
        self.between.map_or(BEYOND, |span| BEYOND.min(0.25 * span.width()))
    }

    /// Returns the demand farther out and farther from the ends of the demanded part by `margin`
    /// metres; at least half of that part remains.
    fn farther(&self, margin: f64) -> Self {
        let between = self.between.map(|span| {
            let less = margin.min(0.25 * span.width());
            Span::new(span.low + less, span.high - less)
        });
        Self { by: self.by + margin, between, ..self.clone() }
    }
}

impl Kind for Fall {
    fn demand(&self) -> Demand {
        Demand::Fall(Box::new(self.clone()))
    }

    fn is_met(&self, end: &End) -> bool {
        self.holds(self.centre(end.pose()) - self.shift)
    }

    fn words(&self, _: usize, _: &Scene) -> String {
        let over = self.over.map(|edge| format!(", over its {} edge", edge.name()));
        let part = |span: Span| format!(" from {:.3} to {:.3} m", span.low, span.high);
        let part = self.between.map(part).unwrap_or_default();
        format!("off the table{}{part}", over.unwrap_or_default())
    }

    fn off(&self, end: &End) -> Option<Vector> {
        Some(self.missing(self.centre(end.pose()) - self.shift))
    }

    fn tolerance(&self) -> Option<f64> {
        Some(self.tolerance)
    }

    fn anchor(&self) -> Vector {
        self.shift
    }

    fn stricter(&self, place: f64, _: f64) -> Demand {
        Self { tolerance: less(self.tolerance, place), ..self.farther(place) }.demand()
    }

    fn shifted(&self, shift: Vector) -> Demand {
        Self { shift: self.shift + shift, ..self.clone() }.demand()
    }

    fn is_relation(&self) -> bool {
        true
    }

    fn falls(&self) -> bool {
        true
    }

    fn fault(&self, _: usize, _: &Scene) -> Option<String> {
        let sound = self.tolerance.is_finite() && self.tolerance > 0.0;
        (!sound).then(|| "the part of the edge must be finite".to_owned())
    }

    fn check(&self, object: usize, scene: &Scene) -> Check {
        let edges = self.edges().map(|edge| {
            let out = edge.outwards();
            [out.x, out.y, self.place(edge) + self.by]
        });
        let quantity = Quantity::Over {
            object: name(object, scene),
            centre: self.centre(&Pose::default()),
            edges: edges.collect(),
            part: self.between.map(|span| [span.low, span.high]),
        };
        Check::from(quantity, 0.0)
    }

    fn marks(&self, _: usize, _: &Scene) -> Vec<Mark> {
        self.edges().map(|edge| Mark::Edge(self.ends(edge))).collect()
    }
}

impl Scene {
    /// Lets the goal's object fall, with all its parts, if the goal demands a fall.
    pub fn let_fall(&mut self, goal: &Goal) {
        if !goal.falls() {
            return;
        }
        for object in goal.movers() {
            let solids: Vec<usize> = self.parts_of(object).chain([object]).collect();
            for k in solids {
                if let Some(object) = self.objects.get_mut(k) {
                    object.may_fall = true;
                }
            }
        }
    }

    /// Returns the table's extent if some object may fall off it; any other object that leaves the
    /// table ends a replay.
    pub fn brink(&self) -> Option<TableTop> {
        self.table_top.filter(|_| self.objects.iter().any(|object| object.may_fall))
    }

    /// Returns `true` if an object, or its compound object, may fall and has left the table.
    pub fn has_left(&self, object: usize, state: &State) -> bool {
        let thing = self.thing(object);
        self.objects[thing].may_fall
            && self.table_top.is_some_and(|top| !top.holds(self.centre(thing, state)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Object;

    /// A table from 0.2 to 1.0 m ahead and 0.3 m to either side; a box with a bar on its left.
    fn scene() -> Scene {
        let box_ = Object::cuboid("box", [0.06, 0.06, 0.05]).at(0.5, 0.0, 0.0);
        let bar = Object::cuboid("box/bar", [0.02, 0.10, 0.05]).mass(0.2);
        let mut scene = Scene::new([box_]).with_part(0, bar, Pose::new(0.0, 0.08, 0.0));
        scene.table_top = Some(TableTop { size: [0.8, 0.6], middle: Vector::new(0.6, 0.0) });
        scene
    }

    #[test]
    fn it_falls_once_its_centre_of_mass_is_beyond_the_edge_and_not_over_another_one() {
        let scene = scene();
        let start = scene.start();
        let centre = scene.centre(0, &start).y;
        assert!(centre > 0.01, "the bar counts");
        let at = |x: f64, y: f64| State::at_rest(vec![Pose::new(x, y, 0.0); 2]);
        let goal = |over| Goal::falling(0, Fall::of(&scene, 0, over).expect("it ends"));
        let left = goal(Some(Edge::Left));
        for (y, falls) in [(0.31 - centre, true), (0.29 - centre, false), (-0.4, false)] {
            assert_eq!(left.reached(&at(0.5, y)), falls, "{y}");
            assert_eq!(left.score(&at(0.5, y)) < 1.0, falls, "{y}");
        }
        assert!((left.error(&at(0.5, 0.30 - centre)) - BEYOND).abs() < 1e-12);
        assert!((left.score(&at(0.5, 0.30 - centre)) - 1.0).abs() < 1e-12);
        let any = goal(None);
        for (x, y) in [(0.5, -0.33 - centre), (0.17, 0.0), (1.01, 0.0), (0.6, 0.31 - centre)] {
            assert!(
                any.reached(&at(x, y))
                    && !scene.table_top.unwrap().holds(Vector::new(x, y + centre))
            );
        }
        assert!(!any.reached(&start));
        assert!((any.off(&at(0.3, 0.0)) - Vector::new(0.12, 0.0)).norm() < 1e-12, "the near edge");
        let strict = any.stricter(0.005, 0.0);
        assert!(!strict.reached(&at(1.004, 0.0)) && any.reached(&at(1.004, 0.0)));
    }

    #[test]
    fn only_over_the_part_of_the_edge_that_is_asked_for() {
        let scene = scene();
        let centre = scene.centre(0, &scene.start()).y;
        let at = |x: f64| State::at_rest(vec![Pose::new(x, 0.33 - centre, 0.0); 2]);
        let fall = Fall::of(&scene, 0, Some(Edge::Left)).expect("it ends");
        let goal =
            |low, high| Goal::falling(0, Box::new(fall.clone().between(Span::new(low, high))));
        for (low, high) in [(0.4, 0.6), (0.47, 0.53)] {
            let goal = goal(low, high);
            for (x, falls) in [(low - 0.002, false), (low + 0.002, true), (high + 0.002, false)] {
                assert_eq!(goal.reached(&at(x)), falls, "{x}");
                assert_eq!(goal.score(&at(x)) < 1.0, falls, "{x}");
            }
            assert_eq!(goal.off(&at(0.5)), Vector::zeros());
            assert!(!goal.stricter(0.005, 0.0).reached(&at(low + 0.004)));
        }
        let [high, low] = fall.clone().between(Span::new(0.1, 0.6)).ends(Edge::Left);
        assert!((high - Vector::new(0.6, 0.3)).norm() < 1e-12, "{high}");
        assert!((low - Vector::new(0.2, 0.3)).norm() < 1e-12, "the table ends there: {low}");
    }

    #[test]
    fn only_what_is_to_fall_may() {
        let mut scene = scene();
        assert!(scene.brink().is_none() && Fall::of(&scene, 7, None).is_none());
        scene.let_fall(&Goal::new(0, [0.5, 0.0], 0.02));
        assert!(scene.brink().is_none());
        scene.let_fall(&Goal::falling(0, Fall::of(&scene, 0, None).expect("it ends")));
        assert!(scene.brink().is_some() && scene.objects.iter().all(|object| object.may_fall));
        scene.table_top = None;
        assert!(Fall::of(&scene, 0, None).is_none());
    }
}
