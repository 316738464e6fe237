//! Demand: a gap between two bodies, seen from above: touching, side by side, or apart.

use serde::{Deserialize, Serialize};

use crate::geometry::{ContactPoint, Pose, Shape, Vector, contact_points};

use crate::scene::{Body, Scene, State};

use super::check::name;
use super::words::millimetres;
use super::{Area, Check, Demand, End, Kind, Mark, Quantity, anywhere, less};

/// Distance of target gaps of search and refinement inside of the limits, metres, but at most the
/// middle between narrow limits. Simulations differ by millimetres.
const INSIDE: f64 = 0.02;

/// A demand on the smallest distance between the outlines of two bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gap {
    /// The other body: an object or an obstacle.
    pub to: Body,
    /// Smallest gap, metres; at 0 the bodies may touch.
    pub min: f64,
    /// Largest gap, metres; may be infinite.
    #[serde(with = "anywhere")]
    pub max: f64,
    /// Solids of both bodies, each in the frame of its own body, or in the world for an obstacle.
    solids: [Vec<(Shape, Pose)>; 2],
    /// Maximum distance from the nearest target gap, metres.
    tolerance: f64,
    /// Offset of the object from its place with the right gap, a target of refinement, metres.
    shift: Vector,
}

impl Gap {
    /// Demands a gap from `min` to `max` metres between object `object` with all its parts and the
    /// body `to`; `None` if one of them does not exist in `scene`.
    pub fn between(
        scene: &Scene,
        object: usize,
        to: Body,
        [min, max]: [f64; 2],
    ) -> Option<Box<Self>> {
        let other = match to {
            Body::Object(other) => scene.solids(other)?,
            Body::Obstacle(other) => {
                let obstacle = scene.obstacles.get(other)?;
                vec![(obstacle.shape(), obstacle.pose)]
            }
            Body::Part(_) => return None,
        };
        let solids = [scene.solids(object)?, other];
        let mut gap = Self { to, min, max, solids, tolerance: 0.0, shift: Vector::zeros() };
        gap.tolerance = gap.depth();
        Some(Box::new(gap))
    }

    /// Returns the name of the other body.
    pub fn name<'a>(&self, scene: &'a Scene) -> &'a str {
        let name = match self.to {
            Body::Object(other) => scene.objects.get(other).map(|object| &object.name),
            Body::Obstacle(other) => scene.obstacles.get(other).map(|obstacle| &obstacle.name),
            Body::Part(_) => None,
        };
        name.map_or("?", String::as_str)
    }

    /// Returns the gap for the goal's object at `own` and other objects as in `state`, metres,
    /// negative for an overlap. The result includes the ends of the gap and the direction from the
    /// other body to the object.
    pub fn nearest(&self, own: &Pose, state: &State) -> Option<ContactPoint> {
        let other = match self.to {
            Body::Object(other) => *state.poses.get(other)?,
            _ => Pose::default(),
        };
        let mut nearest: Option<ContactPoint> = None;
        for (first, at) in &self.solids[0] {
            for (second, there) in &self.solids[1] {
                let first = (&first.footprint(), &(*own * *at));
                let second = (&second.footprint(), &(other * *there));
                let (points, _) = contact_points(first, second, f64::INFINITY);
                let nearer =
                    |found: &ContactPoint| nearest.is_none_or(|known| found.gap < known.gap);
                nearest = points[0].filter(nearer).or(nearest);
            }
        }
        nearest
    }

    /// Returns the outlines of all solids of the goal's object and of the other body, each in the
    /// frame of its own body, or in the world for an obstacle.
    pub fn outlines(&self) -> [impl Iterator<Item = Area> + '_; 2] {
        self.solids
            .each_ref()
            .map(|solids| solids.iter().map(|(shape, pose)| Area { shape: *shape, pose: *pose }))
    }

    /// Returns `true` if a gap of this many metres is allowed; touching bodies may overlap slightly
    /// in a simulation.
    pub fn holds(&self, gap: f64) -> bool {
        self.beyond(gap, 0.0) == 0.0
    }

    /// Returns the distance of target gaps inside of the limits, metres.
    pub fn depth(&self) -> f64 {
        INSIDE.min(0.5 * (self.max - self.min))
    }

    /// Returns the excess of a gap over the nearest one that is `depth` inside of the limits,
    /// metres; negative for smaller gaps.
    fn beyond(&self, gap: f64, depth: f64) -> f64 {
        let low = if self.min > 0.0 { self.min + depth } else { f64::NEG_INFINITY };
        gap - gap.max(low).min(self.max - depth)
    }

    /// Tightens the limits by `margin` metres, or by a quarter of the range between them if that is
    /// less.
    fn tighter(&self, margin: f64) -> Self {
        let margin = margin.min(0.25 * (self.max - self.min));
        let min = if self.min > 0.0 { self.min + margin } else { 0.0 };
        Self { min, max: self.max - margin, ..self.clone() }
    }
}

impl Gap {
    fn nearest_shifted(&self, end: &End) -> Option<ContactPoint> {
        let mut shifted = end.state.poses.get(end.object).copied()?;
        shifted.position -= self.shift;
        self.nearest(&shifted, end.state)
    }
}

impl Kind for Gap {
    fn demand(&self) -> Demand {
        Demand::Gap(Box::new(self.clone()))
    }

    fn is_met(&self, end: &End) -> bool {
        self.nearest_shifted(end).is_some_and(|nearest| self.holds(nearest.gap))
    }

    fn words(&self, _: usize, scene: &Scene) -> String {
        let [min, max] = [self.min, self.max].map(millimetres);
        let far = match (self.min > 0.0, self.max.is_finite()) {
            (_, false) => format!("at least {min}"),
            (false, true) => format!("at most {max}"),
            (true, true) => format!("{min} to {max}"),
        };
        format!("{far} from {}", self.name(scene))
    }

    fn off(&self, end: &End) -> Option<Vector> {
        let nearest = self.nearest_shifted(end);
        let off = |nearest: ContactPoint| self.beyond(nearest.gap, self.depth()) * nearest.normal;
        Some(nearest.map_or(Vector::zeros(), off))
    }

    fn tolerance(&self) -> Option<f64> {
        Some(self.tolerance)
    }

    fn anchor(&self) -> Vector {
        self.shift
    }

    fn stricter(&self, place: f64, _: f64) -> Demand {
        let tolerance = less(self.tolerance, place);
        Self { tolerance, ..self.tighter(place) }.demand()
    }

    fn shifted(&self, shift: Vector) -> Demand {
        Self { shift: self.shift + shift, ..self.clone() }.demand()
    }

    fn to(&self) -> Option<Body> {
        Some(self.to)
    }

    fn is_relation(&self) -> bool {
        true
    }

    fn fault(&self, object: usize, _: &Scene) -> Option<String> {
        let sound = self.min >= 0.0 && self.max > self.min && self.to != Body::Object(object);
        (!sound).then(|| "a gap needs another body and limits in ascending order".to_owned())
    }

    fn check(&self, object: usize, scene: &Scene) -> Check {
        let [own, others] = self.outlines().map(|areas| areas.map(|area| area.corners()).collect());
        let other = match self.to {
            Body::Object(other) => Some(name(other, scene)),
            _ => None,
        };
        let high = self.max.is_finite().then_some(self.max);
        let quantity = Quantity::Gap { object: name(object, scene), own, other, others };
        Check::Within { quantity, low: Some(self.min), high }
    }

    fn marks(&self, object: usize, scene: &Scene) -> Vec<Mark> {
        let object = scene.objects.get(object);
        let nearest = object.and_then(|object| self.nearest(&object.pose, &scene.start()));
        let line = nearest.map(|nearest| Mark::Distance([nearest.on_first, nearest.on_second]));
        let frame = match self.to {
            Body::Object(other) => scene.objects.get(other).map(|object| object.pose),
            _ => Some(Pose::default()),
        };
        let [_, others] = self.outlines();
        let band = frame.filter(|_| self.max.is_finite()).map(|frame| Mark::Band {
            pieces: others.map(|area| area.seen_from(&frame).corners()).collect(),
            from: self.min,
            to: self.max,
        });
        band.into_iter().chain(line).collect()
    }
}

impl Scene {
    /// Returns the solids of an object with its parts, in its frame; `None` if it does not exist.
    pub(super) fn solids(&self, object: usize) -> Option<Vec<(Shape, Pose)>> {
        let own = (self.objects.get(object)?.shape, Pose::default());
        let parts = self.parts_of(object).map(|k| &self.objects[k]);
        let parts = parts.filter_map(|part| Some((part.shape, part.whole?.place)));
        Some(std::iter::once(own).chain(parts).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        scene::{Object, Obstacle},
        task::Goal,
    };

    /// A mug with a handle on its right, a box beside it and a wall behind it.
    fn scene() -> Scene {
        let mug = Object::cylinder("mug", 0.04, 0.1).at(0.5, 0.0, 0.0);
        let block = Object::cuboid("block", [0.06, 0.04, 0.05]).at(0.7, 0.0, 0.0);
        let handle = Object::cuboid("mug/handle", [0.04, 0.01, 0.08]);
        Scene::new([mug, block])
            .with_part(0, handle, Pose::new(0.06, 0.0, 0.0))
            .with_obstacle(Obstacle::cuboid("wall", [0.02, 0.4, 0.1]).at(0.3, 0.0, 0.0))
    }

    #[test]
    fn the_gap_is_that_of_the_nearest_parts_in_whatever_order() {
        let scene = scene();
        let start = scene.start();
        let gap = |object, to| {
            let gap = Gap::between(&scene, object, to, [0.0, 0.1]).unwrap();
            gap.nearest(&start.poses[object], &start).unwrap().gap
        };
        // The handle ends 0.08 m from the mug's middle, the block begins 0.03 m from its own.
        for gap in [gap(0, Body::Object(1)), gap(1, Body::Object(0))] {
            assert!((gap - (0.2 - 0.08 - 0.03)).abs() < 1e-9, "{gap}");
        }
        assert!((gap(0, Body::Obstacle(0)) - (0.2 - 0.04 - 0.01)).abs() < 1e-9);
        assert!(Gap::between(&scene, 0, Body::Object(7), [0.0, 0.1]).is_none());
        assert!(Gap::between(&scene, 0, Body::Part(0), [0.0, 0.1]).is_none());
    }

    /// Moved against its offset, the mug reaches the demanded gap, deep enough inside of the
    /// limits. This takes a few steps, because other parts may become the nearest.
    #[test]
    fn the_remaining_distance_leads_to_the_right_gap() {
        let scene = scene();
        for limits in [[0.1, f64::INFINITY], [0.0, 0.002], [0.03, 0.05], [0.0, 0.3]] {
            let goal = Goal::beside(0, Gap::between(&scene, 0, Body::Object(1), limits).unwrap());
            for turn in [0.0, 0.4, 1.5, 3.1] {
                for distance in [0.08, 0.16, 0.2, 0.5] {
                    let mut state = scene.start();
                    state.poses[0] = Pose::new(0.7 - distance, 0.02, turn);
                    for _ in 0..6 {
                        let off = goal.off(&state);
                        state.poses[0].position -= off;
                    }
                    let error = goal.error(&state);
                    assert!(error < 1e-4, "{limits:?} {turn} {distance}: {error}");
                    assert!(goal.reached(&state), "{limits:?} {turn} {distance}");
                }
            }
        }
    }

    #[test]
    fn the_score_is_one_at_the_limits() {
        let scene = scene();
        let goal =
            |limits| Goal::beside(1, Gap::between(&scene, 1, Body::Obstacle(0), limits).unwrap());
        let at = |gap: f64| {
            let mut state = scene.start();
            state.poses[1] = Pose::new(0.3 + 0.01 + gap + 0.03, 0.0, 0.0);
            state
        };
        for (limits, inside, rim, outside) in [
            ([0.1, f64::INFINITY], 0.121, 0.1, 0.09),
            ([0.0, 0.05], 0.0, 0.05, 0.06),
            ([0.0, 0.05], -1e-4, 0.05, 0.06),
            ([0.04, 0.06], 0.05, 0.06, 0.03),
        ] {
            let goal = goal(limits);
            assert!(goal.score(&at(inside)) < 1e-6 && goal.reached(&at(inside)), "{limits:?}");
            assert!((goal.score(&at(rim)) - 1.0).abs() < 1e-6, "{limits:?}");
            assert!(goal.score(&at(outside)) > 1.0 && !goal.reached(&at(outside)), "{limits:?}");
            let strict = goal.stricter(0.005, 0.0);
            assert!(strict.reached(&at(inside)) && !strict.reached(&at(rim)), "{limits:?}");
        }
    }
}
